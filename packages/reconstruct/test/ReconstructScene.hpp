// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_RECONSTRUCT_SCENE_HPP
#define HARMOS_TEST_RECONSTRUCT_SCENE_HPP

#include <Harmos_Clip.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Moments.hpp>
#include <Harmos_OnHost.hpp>
#include <Harmos_Reconstruct.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <vector>

namespace Harmos::Testing
{

/// [0, 1]^2 times (nx, ny) h in nx x ny cells; inner nodes are moved at random by up to `shake` h per coordinate.
inline Mesh makeMesh(int nx, int ny, double h, double shake = 0.0, unsigned seed = 1)
{
  HostMesh host = rectilinearMesh(gradedCoordinates(0.0, nx, nx, 1.0), gradedCoordinates(0.0, ny, ny, 1.0));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-shake, shake);
  for (auto &node : host.node)
  {
    bool const inner = node[0] > 0.0 && node[0] < nx && node[1] > 0.0 && node[1] < ny;
    for (double &x : node)
      x = h * (x + (inner ? uniform(random) : 0.0));
  }
  return buildMesh(host);
}

/// A mesh about the axis, or far from it (r from `left` on).
inline Mesh ringMesh(int n, double left, double shake, unsigned seed)
{
  Mesh mesh = makeMesh(n, n, 1.0 / n, shake, seed);
  mesh.geometry = Geometry::Axisymmetric;
  auto const x = onHost(mesh.node_position);
  for (int node = 0; node < mesh.num_nodes; ++node)
    x(node, 0) += left;
  Kokkos::deep_copy(mesh.node_position, x);
  return mesh;
}

/// 7 x 7 cells over a unit square, some shaken, some on the axis, some far from it.
struct Place
{
  Mesh mesh;
  Vector2 low;

  Place(Geometry geometry, int number)
  {
    bool const ring = geometry == Geometry::Axisymmetric;
    double const left = ring && number % 2 == 0 ? 0.0 : 10.0;
    mesh = ring ? ringMesh(7, left, 0.1, number) : makeMesh(7, 7, 1.0 / 7.0, number % 2 == 0 ? 0.0 : 0.1, number);
    low = {ring ? left : 0.0, 0.0};
  }

  Vector2 inMiddleCell(std::mt19937 &random) const
  {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double const x = (3.0 + unit(random)) / 7.0, y = (3.0 + unit(random)) / 7.0;
    return low + Vector2{x, y};
  }
};

/// One material in one cell.
struct Fill
{
  int material;
  double volume; // by the mesh's geometry
  Vector2 centroid;
};

struct Scene
{
  Mesh mesh;
  CellMaterialPairs pairs;
  PairState state;
};

using CellFills = std::function<std::vector<Fill>(int, Quadrilateral const &)>;

inline Quadrilateral hostQuadrilateral(HostView<double *[2]> const &x, HostView<int *[4]> const &node, int cell)
{
  Quadrilateral quad;
  for (int k = 0; k < 4; ++k)
    quad.push({x(node(cell, k), 0), x(node(cell, k), 1)});
  return quad;
}

/// Pairs, volume fractions and centroids from what each cell holds (materials ascending); a fill within 1e-14 of the
/// whole cell makes it pure.
inline Scene paint(Mesh const &mesh, CellFills const &fills)
{
  auto const x = onHost(mesh.node_position);
  auto const node = onHost(mesh.cell_node);
  std::vector<int> offset{0}, material, cell_of, kind;
  std::vector<Fill> all;
  std::vector<double> fraction;
  for (int cell = 0; cell < mesh.num_cells; ++cell)
  {
    Quadrilateral const quad = hostQuadrilateral(x, node, cell);
    double const whole = volume(quad, mesh.geometry);
    int count = 0;
    bool pure = false;
    for (Fill const &fill : fills(cell, quad))
    {
      if (fill.volume <= 1e-15 * whole)
        continue;
      pure = fill.volume >= (1.0 - 1e-14) * whole;
      all.push_back(fill);
      fraction.push_back(pure ? 1.0 : fill.volume / whole);
      material.push_back(fill.material);
      cell_of.push_back(cell);
      ++count;
    }
    kind.push_back(count == 0 ? VoidCell : (count == 1 && pure ? PureCell : MixedCell));
    offset.push_back(static_cast<int>(all.size()));
  }
  int const num_pairs = static_cast<int>(all.size());
  Scene scene;
  scene.mesh = mesh;
  scene.pairs.num_pairs = num_pairs;
  scene.pairs.offset = deviceCopy("offset", offset);
  scene.pairs.material = deviceCopy("material", material);
  scene.pairs.cell = deviceCopy("cell", cell_of);
  scene.pairs.cell_kind = deviceCopy("cell_kind", kind);
  scene.state.record = View<double *[num_pair_fields]>("record", num_pairs);
  scene.state.centroid = View<double *[2]>("centroid", num_pairs);
  auto const record = Kokkos::create_mirror_view(scene.state.record);
  auto const centroid = Kokkos::create_mirror_view(scene.state.centroid);
  for (int pair = 0; pair < num_pairs; ++pair)
  {
    record(pair, VolumeFraction) = fraction[pair];
    for (int d = 0; d < 2; ++d)
      centroid(pair, d) = all[pair].centroid[d];
  }
  Kokkos::deep_copy(scene.state.record, record);
  Kokkos::deep_copy(scene.state.centroid, centroid);
  return scene;
}

/// A convex body: an intersection of half-planes.
using Body = std::vector<Plane2>;

inline Plane2 halfPlane(double degrees, Vector2 const &point)
{
  Vector2 const n{std::cos(degrees * Math::pi / 180.0), std::sin(degrees * Math::pi / 180.0)};
  return {n, dot(n, point)};
}

template <int Capacity>
inline Region intersection(Polygon<Capacity> const &polygon, Body const &body)
{
  Region part;
  for (int i = 0; i < polygon.size; ++i)
    part.push(polygon[i]);
  for (Plane2 const &plane : body)
  {
    Region next;
    clip(part, plane, next);
    part = next;
  }
  return part;
}

/// Disjoint bodies; body m is material m.
inline CellFills bodies(std::vector<Body> const &all, Geometry geometry = Geometry::Planar)
{
  return [all, geometry](int, Quadrilateral const &quad)
  {
    std::vector<Fill> fills;
    for (std::size_t m = 0; m < all.size(); ++m)
    {
      Region const part = intersection(quad, all[m]);
      Moments<1> const first = moments<1>(part, quad[0], areaWeight(geometry, quad[0]));
      if (first.volume() > 0.0)
        fills.push_back({static_cast<int>(m), first.volume(), quad[0] + first.centroid()});
    }
    return fills;
  };
}

/// Filled regions of a scene in which no cell fails and no interface is left unfinished.
inline FilledRegions reconstructed(Scene const &scene, double sliver = ReconstructionOptions().sliver,
                                   ReconstructionMethod method = ReconstructionMethod::MomentOfFluid,
                                   View<int *> const &fluid = {}, View<int *> const &exact = {},
                                   RigidCorners const &corners = {})
{
  ReconstructionOptions options;
  options.method = method;
  options.sliver = sliver;
  options.fluid = fluid;
  options.exact = exact;
  options.corners = corners;
  ReconstructionReport report;
  FilledRegions const regions = reconstruct(scene.mesh, scene.pairs, scene.state, options, report);
  EXPECT_EQ(report.failures, 0);
  EXPECT_EQ(report.unfinished_cells, 0);
  return regions;
}

inline Plane2 opposite(Plane2 const &plane)
{
  return {-plane.normal, -plane.offset};
}

/// By mixed cell: |region outside its body| / |cell| (with exact volumes half the symmetric difference) of its pairs.
inline std::map<int, std::vector<double>> misplacedByCell(Scene const &scene, FilledRegions const &regions,
                                                          std::vector<Body> const &all)
{
  auto const mixed = onHost(regions.mixed_cell);
  auto const first = onHost(regions.cell_region);
  auto const polygon = onHost(regions.polygon);
  auto const offset = onHost(scene.pairs.offset);
  auto const material = onHost(scene.pairs.material);
  auto const cell_area = onHost(scene.mesh.cell_area);
  std::map<int, std::vector<double>> by_cell;
  for (int i = 0; i < regions.num_mixed_cells; ++i)
  {
    int const cell = mixed(i);
    for (int pair = offset(cell); pair < offset(cell + 1); ++pair)
    {
      Region const &region = polygon(first(cell) + pair - offset(cell));
      double const outside = area(region) - area(intersection(region, all[material(pair)]));
      by_cell[cell].push_back(outside / cell_area(cell));
    }
  }
  return by_cell;
}

/// The largest of all mixed cells.
inline double misplacedVolume(Scene const &scene, FilledRegions const &regions, std::vector<Body> const &all)
{
  double worst = 0.0;
  for (auto const &[cell, misplaced] : misplacedByCell(scene, regions, all))
    worst = std::max(worst, *std::max_element(misplaced.begin(), misplaced.end()));
  return worst;
}

} // namespace Harmos::Testing

#endif
