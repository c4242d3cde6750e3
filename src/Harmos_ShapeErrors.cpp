// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_ShapeErrors.hpp"

#include "Harmos_Setup.hpp"

#include <Harmos_Paint.hpp>
#include <Harmos_ShapeRegion.hpp>

#include <cmath>

namespace Harmos
{
namespace
{

enum ErrorColumn : int
{
  ExactArea = 0,
  VolumeError,
  FractionError,
  SymmetricDifference,
  num_error_columns
};

/// The part of a filled region that the exact shapes of its material cover: by triangles of the region.
double sharedVolume(Region const &region, std::vector<Body> const &bodies, int material)
{
  double sum = 0.0;
  for (int i = 1; i + 1 < region.size; ++i)
  {
    Quadrilateral triangle;
    triangle.push(region[0]);
    triangle.push(region[i]);
    triangle.push(region[i + 1]);
    if (!(area(triangle) > 0.0))
      continue;
    for (std::size_t b = 0; b < bodies.size(); ++b)
    {
      if (bodies[b].material != material || !bodies[b].shape.boundingBox().meets(boundingBox(triangle)))
        continue;
      ShapeRegion part(triangle);
      part.intersect(bodies[b].shape);
      for (std::size_t later = b + 1; later < bodies.size(); ++later)
        if (bodies[later].cut_from_earlier)
          part.subtract(bodies[later].shape);
      sum += part.moments().volume();
    }
  }
  return sum;
}

/// What the comparison reads, on the host.
struct Found
{
  HostView<int *> offset, material;
  HostView<double *[num_pair_fields]> record;
};

Found foundOf(View<int *> const &offset, View<int *> const &material, View<double *[num_pair_fields]> const &record)
{
  Kokkos::HostSpace const host;
  return {Kokkos::create_mirror_view_and_copy(host, offset), Kokkos::create_mirror_view_and_copy(host, material),
          Kokkos::create_mirror_view_and_copy(host, record)};
}

int findPair(Found const &found, int cell, int material)
{
  for (int pair = found.offset(cell); pair < found.offset(cell + 1); ++pair)
    if (found.material(pair) == material)
      return pair;
  return -1;
}

std::vector<double> sumErrors(Scene const &scene, CycleState const &s, std::vector<Body> const &bodies, int materials)
{
  Painting const painting = paint(scene.mesh, bodies);
  Found const exact = foundOf(painting.pairs.offset, painting.pairs.material, painting.record);
  Found const made = foundOf(s.pairs.offset, s.pairs.material, s.state.record);
  Kokkos::HostSpace const host;
  auto const cell_area = Kokkos::create_mirror_view_and_copy(host, scene.mesh.cell_area);
  auto const depth = Kokkos::create_mirror_view_and_copy(host, scene.mesh.cell_depth);
  auto const first_region = Kokkos::create_mirror_view_and_copy(host, s.regions.cell_region);
  auto const polygon = Kokkos::create_mirror_view_and_copy(host, s.regions.polygon);
  auto const cell_node = Kokkos::create_mirror_view_and_copy(host, scene.mesh.cell_node);
  auto const position = Kokkos::create_mirror_view_and_copy(host, scene.mesh.node_position);
  auto const regionOf = [&](int cell, int pair)
  {
    if (first_region(cell) >= 0)
      return polygon(first_region(cell) + pair - made.offset(cell));
    Region region;
    for (int k = 0; k < 4; ++k)
      region.push({position(cell_node(cell, k), 0), position(cell_node(cell, k), 1)});
    return region;
  };

  std::vector<double> sums(static_cast<std::size_t>(materials) * num_error_columns, 0.0);
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
    for (int m = 0; m < materials && depth(cell) == 0; ++m)
    {
      int const pair = findPair(made, cell, m), exact_pair = findPair(exact, cell, m);
      double const f = pair < 0 ? 0.0 : made.record(pair, VolumeFraction);
      double const e = exact_pair < 0 ? 0.0 : exact.record(exact_pair, VolumeFraction);
      double shared = f == 1.0 ? e : (e == 1.0 ? f : 0.0);
      if (f > 0.0 && f < 1.0 && e > 0.0 && e < 1.0)
        shared = sharedVolume(regionOf(cell, pair), bodies, m) / cell_area(cell);
      double *sum = sums.data() + static_cast<std::size_t>(m) * num_error_columns;
      sum[ExactArea] += e * cell_area(cell);
      sum[VolumeError] += (f - e) * cell_area(cell);
      sum[FractionError] += std::fabs(f - e) * cell_area(cell);
      sum[SymmetricDifference] += ((f - shared) + (e - shared)) * cell_area(cell);
    }
  scene.exchange->sum(sums.data(), static_cast<int>(sums.size()));
  return sums;
}

} // namespace

std::vector<std::pair<std::string, double>> shapeErrors(Deck const &deck, Scene const &scene, CycleState const &s)
{
  std::vector<Body> bodies;
  for (BodySpec const &spec : deck.bodies)
  {
    Body body = paintedBody(spec);
    CarriedPose const pose = carriedPose(scene.prescribed, body.shape.centroid(), s.time);
    if (!pose.known)
      return {};
    if (pose.displacement[0] != 0.0 || pose.displacement[1] != 0.0 || pose.angle != 0.0)
      body.shape = body.shape.moved(pose.displacement, pose.angle);
    bodies.push_back(body);
  }
  int const materials = static_cast<int>(deck.fields.size());
  std::vector<double> const sums = sumErrors(scene, s, bodies, materials);
  std::vector<std::pair<std::string, double>> errors;
  char const *const name[num_error_columns] = {"area", "volume_error", "l1", "symmetric_difference"};
  for (int m = 0; m < materials; ++m)
    for (int c = 0; c < num_error_columns; ++c)
      errors.emplace_back(deck.fields[m].name + "." + name[c],
                          sums[static_cast<std::size_t>(m) * num_error_columns + c]);
  return errors;
}

} // namespace Harmos
