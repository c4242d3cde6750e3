// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_SCENE_HPP
#define HARMOS_REMAP_SCENE_HPP

#include "RemapOnHost.hpp"

#include <Harmos_Clip.hpp>
#include <Harmos_Moments.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace Harmos
{
namespace Test
{

/// One component of a scene: a material (-1: void) on the inner side of the line that what is left of a cell is cut by.
struct Layer
{
  int material;
  std::function<Plane2(Vector2 const &centre)> line; // empty: all that is left
};

inline Plane2 lineThrough(Vector2 const &point, double angle)
{
  Vector2 const normal{std::cos(angle), std::sin(angle)};
  return {normal, dot(normal, point)};
}

/// A disc's tangent-like line in the cell around `centre` (regions are cut by straight lines).
inline Layer disc(int material, Vector2 const &middle, double radius)
{
  return {material, [=](Vector2 const &centre)
          {
            Vector2 const n = normalised(centre - middle);
            return Plane2{n, dot(n, middle) + radius};
          }};
}

inline Layer halfPlane(int material, Vector2 const &point, double angle)
{
  return {material, [=](Vector2 const &) { return lineThrough(point, angle); }};
}

inline Layer rest(int material)
{
  return {material, {}};
}

using Scalar = std::function<double(int material, Vector2 const &x)>;
using VectorField = std::function<Vector2(int material, Vector2 const &x)>;

/// What a remap reads, beside the mesh.
struct RemapInput
{
  View<Boundary *> boundary;
  BoundaryConditions conditions;
  View<Material *> materials;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
  FilledRegions regions;
  View<double *[2]> half;
  RigidRows rigid;
};

/// A whole single-rank input of the remap.
struct Scene
{
  HostMesh host_mesh;
  MeshOnHost mesh;
  PairsOnHost pairs;
  DofNodesOnHost dof_nodes;
  StateOnHost state; // records and damage may be changed here: a remap begins with these
  RegionsOnHost regions;
  HostView<double *[2]> half;
  RemapInput device;
  RemapOptions options;
  RemapReport report;
  Kinematics kinematics = Kinematics::Xfem;
  double dt = 1.0;
  Geometry geometry = Geometry::Planar;
  std::vector<int> owner; // of the whole mesh's cells; empty: one rank
  int halo = 0;

  Scene(int nx, int ny, double jitter, std::vector<Material> const &laws, BoundaryKind kind = BoundaryKind::SlipWall)
  {
    host_mesh = rectilinearMesh(gradedCoordinates(0.0, 1.0, nx, 1.0), gradedCoordinates(0.0, 1.0, ny, 1.0));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-jitter, jitter);
    for (auto &x : host_mesh.node)
    {
      bool const inner = x[0] > 0.0 && x[0] < 1.0 && x[1] > 0.0 && x[1] < 1.0;
      double const dx = shift(random) / nx, dy = shift(random) / ny;
      if (inner)
        x = {x[0] + dx, x[1] + dy};
    }
    setBoundaries(std::vector<Boundary>(4,
                                        [&]
                                        {
                                          Boundary b;
                                          b.kind = kind;
                                          return b;
                                        }()));
    device.materials = deviceCopy("materials", laws);
  }

  /// The same mesh, x the radius.
  void aboutAxis()
  {
    geometry = Geometry::Axisymmetric;
    setGeometry(mesh.on_device, geometry);
    mesh = MeshOnHost(mesh.on_device);
  }

  /// See the scene as rank 0 of a partition.
  void distribute(std::vector<int> const &cell_owner, int layers)
  {
    owner = cell_owner;
    halo = layers;
    auto const boundary = onHost(device.boundary);
    std::vector<Boundary> kinds(boundary.extent(0));
    for (std::size_t i = 0; i < kinds.size(); ++i)
      kinds[i] = boundary(i);
    setBoundaries(kinds);
  }

  void setBoundaries(std::vector<Boundary> const &kinds)
  {
    Mesh built = owner.empty() ? buildMesh(host_mesh) : buildLocalMesh(host_mesh, owner, 0, halo);
    setGeometry(built, geometry);
    mesh = MeshOnHost(built);
    device.boundary = deviceCopy("boundary", kinds);
    device.conditions = buildBoundaryConditions(built, device.boundary);
  }

  /// Cut every cell into the layers, first one first; density and specific internal energy by field, sv = 1 / density.
  void paint(std::vector<Layer> const &layers, Scalar const &density, Scalar const &energy)
  {
    std::vector<int> offset(1, 0), material, cell_of, region_first(mesh.num_cells, -1), mixed;
    std::vector<Region> region, mixed_region;
    for (int cell = 0; cell < mesh.num_cells; ++cell)
    {
      std::vector<std::pair<int, Region>> parts = cut(cell, layers);
      double const whole = mesh.cell_area(cell);
      bool const pure = parts.size() == 1 && area(parts[0].second) > whole * (1.0 - 1e-13);
      if (!parts.empty() && !pure)
      {
        region_first[cell] = static_cast<int>(mixed_region.size());
        mixed.push_back(cell);
      }
      for (auto const &part : parts)
      {
        material.push_back(part.first);
        cell_of.push_back(cell);
        region.push_back(part.second);
        if (!pure)
          mixed_region.push_back(part.second);
      }
      offset.push_back(static_cast<int>(material.size()));
    }
    setPairs(offset, material, cell_of);
    setRegions(region_first, mixed, mixed_region);
    setState(region, density, energy);
    device.dof_nodes = buildDofNodes(mesh.on_device, kinematics, device.state.record, device.pairs);
    pairs = PairsOnHost(device.pairs);
    dof_nodes = DofNodesOnHost(device.dof_nodes);
    device.state.velocity = View<double *[2]>("velocity", dof_nodes.num_dof_nodes);
    state.velocity = onHost(device.state.velocity);
  }

  void move(VectorField const &velocity)
  {
    device.half = View<double *[2]>("half", dof_nodes.num_dof_nodes);
    half = Kokkos::create_mirror_view(device.half);
    auto const node_index = onHost(device.conditions.node_index);
    auto const condition = onHost(device.conditions.condition);
    for (int dof = 0; dof < dof_nodes.num_dof_nodes; ++dof)
    {
      int const node = dof_nodes.node(dof);
      Vector2 v = velocity(dof_nodes.material(dof), {mesh.node_position(node, 0), mesh.node_position(node, 1)});
      int const index = node_index(node);
      if (index >= 0)
        v = condition(index).apply(v);
      half(dof, 0) = v[0];
      half(dof, 1) = v[1];
    }
    Kokkos::deep_copy(device.half, half);
  }

  ResultOnHost remapped()
  {
    report = RemapReport{};
    upload();
    return ResultOnHost(remap(mesh.on_device, kinematics, device.pairs, device.dof_nodes, device.state, device.regions,
                              device.conditions, device.materials, device.half, dt, device.rigid, options, report));
  }

  /// The same with work arrays that live longer, and perhaps from node positions `start` to another mesh.
  ResultOnHost remapped(Mesh const &target, RemapReport &booked, RemapWork &work,
                        View<double *[2]> const &start = {}) const
  {
    upload();
    return ResultOnHost(remap(target, kinematics, device.pairs, device.dof_nodes, device.state, device.regions,
                              device.conditions, device.materials, device.half, dt, device.rigid, options, booked, work,
                              start));
  }

private:
  std::vector<std::pair<int, Region>> cut(int cell, std::vector<Layer> const &layers) const
  {
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    Vector2 const centre = 0.25 * (q[0] + q[1] + q[2] + q[3]);
    Region left;
    for (int k = 0; k < 4; ++k)
      left.push(q[k]);
    std::vector<std::pair<int, Region>> parts;
    for (Layer const &layer : layers)
    {
      Region inside = left, outside;
      if (layer.line)
      {
        Plane2 const line = layer.line(centre);
        clip(left, line, inside);
        clip(left, Plane2{-line.normal, -line.offset}, outside);
        left = outside;
      }
      else
        left.size = 0;
      if (layer.material >= 0 && area(inside) > 1e-14 * mesh.cell_area(cell))
        parts.push_back({layer.material, inside});
      if (left.size < 3)
        break;
    }
    std::sort(parts.begin(), parts.end(), [](auto const &a, auto const &b) { return a.first < b.first; });
    return parts;
  }

  void setPairs(std::vector<int> const &offset, std::vector<int> const &material, std::vector<int> const &cell_of)
  {
    device.pairs.num_pairs = static_cast<int>(material.size());
    device.pairs.offset = deviceCopy("offset", offset);
    device.pairs.material = deviceCopy("material", material);
    device.pairs.cell = deviceCopy("cell", cell_of);
    pairs = PairsOnHost(device.pairs);
  }

  void setRegions(std::vector<int> const &first, std::vector<int> const &mixed, std::vector<Region> const &polygon)
  {
    device.regions.num_mixed_cells = static_cast<int>(mixed.size());
    device.regions.mixed_cell = deviceCopy("mixed", mixed);
    device.regions.cell_region = deviceCopy("first", first);
    device.regions.polygon = deviceCopy("polygon", polygon);
    regions = RegionsOnHost(device.regions);
  }

  void setState(std::vector<Region> const &region, Scalar const &density, Scalar const &energy)
  {
    device.state.record = View<double *[num_pair_fields]>("record", pairs.num_pairs);
    device.state.centroid = View<double *[2]>("centroid", pairs.num_pairs);
    state.record = Kokkos::create_mirror_view(device.state.record);
    state.centroid = Kokkos::create_mirror_view(device.state.centroid);
    for (int pair = 0; pair < pairs.num_pairs; ++pair)
    {
      int const cell = pairs.cell(pair);
      Moments<1> const m = moments<1>(region[pair], region[pair][0], areaWeight(geometry, region[pair][0]));
      Vector2 const centroid = region[pair][0] + m.centroid();
      bool const pure = regions.cell_region(cell) < 0;
      double const volume = pure ? mesh.cell_volume(cell) : m.volume();
      double const rho = density(pairs.material(pair), centroid);
      state.record(pair, Mass) = rho * volume;
      state.record(pair, VolumeFraction) = pure ? 1.0 : volume / mesh.cell_volume(cell);
      state.record(pair, SpecificVolume) = 1.0 / rho;
      state.record(pair, InternalEnergy) = energy(pairs.material(pair), centroid);
      state.record(pair, PlasticStrain) = 0.01 * (1.0 + centroid[0]);
      state.record(pair, DeviatorXX) = 0.3 * std::sin(3.0 * centroid[1]);
      state.record(pair, DeviatorYY) = 0.2 * centroid[0];
      state.record(pair, DeviatorXY) = -0.1;
      for (int d = 0; d < 2; ++d)
        state.centroid(pair, d) = centroid[d];
    }
    Kokkos::deep_copy(device.state.centroid, state.centroid);
    upload();
  }

  /// What may be changed on the host between two remaps.
  void upload() const
  {
    Kokkos::deep_copy(device.state.record, state.record);
    Kokkos::deep_copy(device.state.damage, state.damage);
  }
};

/// Sums over all pairs: what a remap conserves.
struct Totals
{
  double mass = 0.0, internal = 0.0, thermodynamic_volume = 0.0, plastic = 0.0, volume = 0.0, kinetic = 0.0;
  Vector2 momentum = {0.0, 0.0};
};

inline Totals totals(MeshOnHost const &mesh, PairsOnHost const &pairs,
                     HostView<double *[num_pair_fields]> const &record, HostView<double *[2]> const &velocity,
                     int material = -1)
{
  Totals t;
  for (int pair = 0; pair < pairs.num_pairs; ++pair)
  {
    if (material >= 0 && pairs.material(pair) != material)
      continue;
    double const m = record(pair, Mass);
    t.mass += m;
    t.internal += m * record(pair, InternalEnergy);
    t.thermodynamic_volume += m * record(pair, SpecificVolume);
    t.plastic += m * record(pair, PlasticStrain);
    t.volume += record(pair, VolumeFraction) * mesh.cell_volume(pairs.cell(pair));
    for (int k = 0; k < 4; ++k)
    {
      int const dof = pairs.dof_node(pair, k);
      Vector2 const v{velocity(dof, 0), velocity(dof, 1)};
      double const share = mesh.corner_share(pairs.cell(pair), k);
      t.momentum += share * m * v;
      t.kinetic += 0.5 * share * m * dot(v, v);
    }
  }
  return t;
}

/// Largest deviation of the sums of volume fractions from one over cells that satisfy a condition, and the largest sum.
inline double largestSumOfFractions(MeshOnHost const &mesh, ResultOnHost const &result)
{
  double largest = 0.0;
  for (int cell = 0; cell < mesh.num_cells; ++cell)
  {
    double sum = 0.0;
    for (int pair = result.pairs.offset(cell); pair < result.pairs.offset(cell + 1); ++pair)
      sum += result.state.record(pair, VolumeFraction);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// A smooth field for every material.
inline double wave(int material, Vector2 const &x)
{
  return 1.0 + material + 0.4 * std::sin(7.0 * x[0]) * std::cos(5.0 * x[1]);
}

/// Numbers of values in which the owned cells of a part differ from the same cells of the whole: materials, records,
/// velocities.
inline long long differences(Scene const &part, ResultOnHost const &a, ResultOnHost const &b)
{
  long long count = 0;
  for (int cell = 0; cell < part.mesh.num_cells; ++cell)
  {
    if (part.mesh.cell_depth(cell) != 0)
      continue;
    int const global = static_cast<int>(part.mesh.cell_global(cell));
    int const pairs = a.pairs.offset(cell + 1) - a.pairs.offset(cell);
    if (pairs != b.pairs.offset(global + 1) - b.pairs.offset(global))
    {
      ++count;
      continue;
    }
    for (int i = 0; i < pairs; ++i)
    {
      int const pa = a.pairs.offset(cell) + i, pb = b.pairs.offset(global) + i;
      count += a.pairs.material(pa) != b.pairs.material(pb);
      for (int f = 0; f < num_pair_fields; ++f)
        count += a.state.record(pa, f) != b.state.record(pb, f);
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < 2; ++d)
          count += a.state.velocity(a.pairs.dof_node(pa, k), d) != b.state.velocity(b.pairs.dof_node(pb, k), d);
    }
  }
  return count;
}

inline std::vector<Material> twoLaws()
{
  Material a, b;
  a.density0 = 1.0;
  a.strength = StrengthKind::Elastic;
  b.density0 = 3.0;
  b.strength = StrengthKind::Elastic;
  return {a, b, a};
}

/// 4 x 4 cells, material 0 at x < 0.4 and a rigid body, material 1, at the rest, which has advanced to x = 0.39.
inline Scene sceneWithRigidBody(Scalar const &density)
{
  std::vector<Material> laws = twoLaws();
  laws[1].rigid_body = 0;
  Scene scene(4, 4, 0.0, laws);
  scene.paint({halfPlane(0, {0.4, 0.0}, 0.0), rest(1)}, density, density);
  std::vector<int> offset(1, 0);
  std::vector<double> fraction;
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
  {
    if (cell % 4 > 0)
      fraction.push_back(cell % 4 == 1 ? 0.44 : 1.0);
    offset.push_back(static_cast<int>(fraction.size()));
  }
  scene.device.rigid.offset = deviceCopy("offset", offset);
  scene.device.rigid.material = deviceCopy("material", std::vector<int>(fraction.size(), 1));
  scene.device.rigid.volume_fraction = deviceCopy("fraction", fraction);
  scene.device.rigid.centroid = View<double *[2]>("centroid", fraction.size());
  return scene;
}

} // namespace Test
} // namespace Harmos

#endif
