// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LAGRANGE_SCENE_HPP
#define HARMOS_LAGRANGE_SCENE_HPP

#include <Harmos_HostMesh.hpp>
#include <Harmos_Lagrange.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_OnHost.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace Harmos
{
namespace Test
{

struct Fill
{
  int material;
  double volume_fraction;
};

/// A small problem with everything that the Lagrangian kernels need.
struct Scene
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
  View<Material *> materials;
  BoundaryConditions boundary;
  LagrangeOptions options;
  LagrangeWork work;

  void setVelocity(std::function<Vector2(int dof, Vector2 x)> const &velocity)
  {
    auto v = onHost(state.velocity);
    auto const node = onHost(dof_nodes.node);
    auto const x = onHost(mesh.node_position);
    for (int dof = 0; dof < dof_nodes.num_dof_nodes; ++dof)
    {
      Vector2 const value = velocity(dof, {x(node(dof), 0), x(node(dof), 1)});
      v(dof, 0) = value[0];
      v(dof, 1) = value[1];
    }
    Kokkos::deep_copy(state.velocity, v);
  }

  /// Forces and prediction; then v_half = v*: no constraints.
  PredictionSums predict(double dt)
  {
    computeCornerForces(mesh, pairs, state, materials, options, work);
    auto const sums = predictVelocities(mesh, pairs, dof_nodes, state, boundary, materials, options, dt, work);
    Kokkos::deep_copy(work.half, work.predicted);
    return sums;
  }

  UpdateReport update(double dt, TimeStepLimit &next)
  {
    return updatePairs(mesh, pairs, state, materials, options, dt, dt, work, next);
  }

  /// After the update: nodes to their moved places (kinematics lagrangian), velocities to v_half.
  void move(double dt)
  {
    auto const x = onHost(mesh.node_position);
    auto const half = onHost(work.half);
    auto const node = onHost(dof_nodes.node);
    for (int dof = 0; dof < dof_nodes.num_dof_nodes; ++dof)
      for (int d = 0; d < 2; ++d)
        x(node(dof), d) += dt * half(dof, d);
    Kokkos::deep_copy(mesh.node_position, x);
    takeHalf();
  }

  void takeHalf()
  {
    auto const range = std::make_pair(0, dof_nodes.num_dof_nodes);
    Kokkos::deep_copy(Kokkos::subview(state.velocity, range, Kokkos::ALL),
                      Kokkos::subview(work.half, range, Kokkos::ALL));
  }

  double internalEnergy() const
  {
    auto const r = onHost(state.record);
    double sum = 0.0;
    for (int pair = 0; pair < pairs.num_pairs; ++pair)
      sum += r(pair, Mass) * r(pair, InternalEnergy);
    return sum;
  }
};

/// The corner forces f(pair, 8) of each pair leave its momentum and its angular momentum alone.
template <class HostForces>
void expectBalanced(Scene const &s, HostForces const &f, double force_error, double moment_error)
{
  auto const cell = onHost(s.pairs.cell);
  auto const cell_node = onHost(s.mesh.cell_node);
  auto const x = onHost(s.mesh.node_position);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    double fx = 0.0, fy = 0.0, moment = 0.0, size = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      int const n = cell_node(cell(pair), k);
      fx += f(pair, 2 * k);
      fy += f(pair, 2 * k + 1);
      moment += x(n, 0) * f(pair, 2 * k + 1) - x(n, 1) * f(pair, 2 * k);
      size += std::fabs(f(pair, 2 * k)) + std::fabs(f(pair, 2 * k + 1));
    }
    EXPECT_GT(size, 0.0);
    EXPECT_NEAR(fx, 0.0, force_error * size);
    EXPECT_NEAR(fy, 0.0, force_error * size);
    EXPECT_NEAR(moment, 0.0, moment_error * size);
  }
}

inline Material elastic()
{
  Material m;
  m.strength = StrengthKind::Elastic;
  m.density0 = 2.0;
  m.sound_speed0 = 3.0;
  m.gruneisen = 0.0;
  m.shear_modulus = 4.0;
  return m;
}

inline Material fluid()
{
  Material m = elastic();
  m.strength = StrengthKind::None;
  m.shear_modulus = 0.0;
  return m;
}

inline Material rigid()
{
  Material m = elastic();
  m.rigid_body = 0;
  return m;
}

/// nx x ny unit cells; inner nodes moved at random by up to `distort`; every cell filled as `contents` says, at rest
/// and free of stress. Boundaries 0 left, 1 right, 2 bottom, 3 top; free where not given.
inline Scene makeScene(int nx, int ny, double distort, std::vector<Material> const &materials,
                       std::function<std::vector<Fill>(int i, int j)> const &contents,
                       Kinematics kinematics = Kinematics::Xfem,
                       std::vector<BoundaryKind> const &kinds = std::vector<BoundaryKind>(4, BoundaryKind::Outflow),
                       Geometry geometry = Geometry::Planar)
{
  HostMesh host = rectilinearMesh(gradedCoordinates(0.0, nx, nx, 1.0), gradedCoordinates(0.0, ny, ny, 1.0));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-distort, distort);
  for (auto &node : host.node)
    if (node[0] > 0.0 && node[0] < nx && node[1] > 0.0 && node[1] < ny)
      for (double &coordinate : node)
        coordinate += shift(random);
  Scene s;
  s.mesh = buildMesh(host);
  setGeometry(s.mesh, geometry);
  s.materials = deviceCopy("materials", materials);

  std::vector<int> offset(1, 0), cell, number;
  std::vector<Fill> fill;
  for (int c = 0; c < nx * ny; ++c)
  {
    for (Fill const &f : contents(c % nx, c / nx))
    {
      fill.push_back(f);
      cell.push_back(c);
      number.push_back(f.material);
    }
    offset.push_back(static_cast<int>(fill.size()));
  }
  int const n = static_cast<int>(fill.size());
  s.pairs.num_pairs = n;
  s.pairs.offset = deviceCopy("offset", offset);
  s.pairs.material = deviceCopy("material", number);
  s.pairs.cell = deviceCopy("cell", cell);
  s.state.record = View<double *[num_pair_fields]>("record", n);
  auto const r = Kokkos::create_mirror_view(s.state.record);
  auto const volume = onHost(s.mesh.cell_volume);
  for (int pair = 0; pair < n; ++pair)
  {
    Material const &material = materials[fill[pair].material];
    r(pair, Mass) = material.density0 * fill[pair].volume_fraction * volume(cell[pair]);
    r(pair, VolumeFraction) = fill[pair].volume_fraction;
    r(pair, SpecificVolume) = 1.0 / material.density0;
  }
  Kokkos::deep_copy(s.state.record, r);
  s.dof_nodes = buildDofNodes(s.mesh, kinematics, s.state.record, s.pairs);
  s.state.velocity = View<double *[2]>("velocity", s.dof_nodes.num_dof_nodes);
  std::vector<Boundary> boundary(4);
  for (int k = 0; k < 4; ++k)
    boundary[k].kind = kinds[k];
  s.boundary = buildBoundaryConditions(s.mesh, deviceCopy("boundary", boundary));
  prepareWork(s.pairs, s.dof_nodes, s.work);
  // exact extents here, so that whole views can be copied
  Kokkos::resize(s.work.half, s.dof_nodes.num_dof_nodes);
  Kokkos::resize(s.work.predicted, s.dof_nodes.num_dof_nodes);
  Kokkos::resize(s.work.dof_mass, s.dof_nodes.num_dof_nodes);
  computeNodeAltitudes(s.mesh, s.work);
  computeDofMass(s.mesh, s.pairs, s.dof_nodes, s.state, s.materials, s.work);
  return s;
}

inline std::vector<Fill> full(int, int)
{
  return {{0, 1.0}};
}

/// Random stress, energy, specific volume and velocity, of a few per cent.
inline void disturb(Scene &s, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  auto const r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    r(pair, SpecificVolume) *= 1.0 + 0.05 * unit(random);
    r(pair, InternalEnergy) = 0.1 * unit(random);
    for (int field : {DeviatorXX, DeviatorYY, DeviatorXY})
      r(pair, field) = unit(random);
  }
  Kokkos::deep_copy(s.state.record, r);
  s.setVelocity([&](int, Vector2) { return Vector2{unit(random), unit(random)}; });
}

} // namespace Test
} // namespace Harmos

#endif
