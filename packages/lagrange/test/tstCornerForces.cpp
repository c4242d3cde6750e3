// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

void setUniformStress(Scene &s)
{
  auto const r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    r(pair, SpecificVolume) = 0.45;
    // force volume = filled area, as where nothing overlaps
    r(pair, Mass) *= 0.5 / 0.45;
    r(pair, DeviatorXX) = 1.0;
    r(pair, DeviatorYY) = -0.3;
    r(pair, DeviatorXY) = 0.6;
  }
  Kokkos::deep_copy(s.state.record, r);
}

auto forces(Scene &s)
{
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  return onHost(s.work.corner_force);
}

/// The cut gradients of a scene whose last cell is cut to a region.
void cutTopCell(Scene &s, int cell, std::vector<Vector2> const &vertices)
{
  Region part;
  for (Vector2 const &vertex : vertices)
    part.push(vertex);
  std::vector<int> first(cell + 1, -1);
  first[cell] = 0;
  FilledRegions regions;
  regions.num_mixed_cells = 1;
  regions.mixed_cell = deviceCopy("mixed_cell", std::vector<int>{cell});
  regions.cell_region = deviceCopy("cell_region", first);
  regions.polygon = deviceCopy("polygon", std::vector<Region>{part});
  s.options.cut_cell_stress = CutCellStress::FilledRegions;
  computeCutGradients(s.mesh, s.pairs, s.state.record, regions, s.materials, s.boundary, s.options.cut_cell_stress,
                      s.options.shortest_bent_edge, s.work.cut);
}

/// A unit cell with a film of thickness d of a fluid without pressure, void on both sides.
Scene film(double d)
{
  Scene s = makeScene(
      1, 1, 0.0, {fluid()},
      [&](int, int) {
        return std::vector<Fill>{{0, d}};
      },
      Kinematics::Xfem);
  cutTopCell(s, 0, {Vector2{0.0, 0.4}, Vector2{1.0, 0.4}, Vector2{1.0, 0.4 + d}, Vector2{0.0, 0.4 + d}});
  s.options.hourglass_viscosity = 0.0;
  prepareWork(s.pairs, s.dof_nodes, s.work);
  return s;
}

/// - sum f . (mean of the velocities before and after a step of `kick`), of one pair whose nodes have its mass alone.
double heat(Scene &s, double kick)
{
  auto const f = forces(s);
  auto const v = onHost(s.state.velocity);
  auto const dof = onHost(s.pairs.dof_node);
  double const corner_mass = 0.25 * onHost(s.state.record)(0, Mass);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 2; ++i)
      sum -= f(0, 2 * k + i) * (v(dof(0, k), i) + 0.5 * kick * f(0, 2 * k + i) / corner_mass);
  return sum;
}

} // namespace

TEST(CornerForces, UniformStressOnDistortedMesh_leavesInnerNodesInBalance)
{
  Scene s = makeScene(6, 5, 0.25, {elastic()}, full);
  setUniformStress(s);
  s.predict(1.0);
  auto const node = onHost(s.dof_nodes.node);
  auto const x = onHost(s.mesh.node_position);
  auto const v = onHost(s.work.predicted);
  auto const mass = onHost(s.work.dof_mass);
  double boundary_force = 0.0;
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
  {
    double const fx = mass(dof) * v(dof, 0), fy = mass(dof) * v(dof, 1);
    int const n = node(dof);
    if (x(n, 0) > 0.0 && x(n, 0) < 6.0 && x(n, 1) > 0.0 && x(n, 1) < 5.0)
    {
      EXPECT_NEAR(fx, 0.0, 1e-14);
      EXPECT_NEAR(fy, 0.0, 1e-14);
    }
    else
      boundary_force = std::max(boundary_force, std::fabs(fx));
  }
  EXPECT_GT(boundary_force, 0.1);
}

TEST(CornerForces, AnyState_hasNoForceAndNoMoment)
{
  Scene s = makeScene(5, 5, 0.25, {elastic(), fluid()},
                      [](int i, int) {
                        return i == 2 ? std::vector<Fill>{{0, 0.3}, {1, 0.6}} : std::vector<Fill>{{i < 2 ? 0 : 1, 1.0}};
                      });
  disturb(s, 1);
  auto const f = forces(s);
  expectBalanced(s, f, 1e-15, 2e-14);
}

TEST(CornerForces, LinearExpandingVelocity_feelsNoHourglassAndNoViscosity)
{
  Scene s = makeScene(4, 4, 0.25, {elastic()}, full);
  setUniformStress(s);
  auto const still = forces(s);
  s.setVelocity([](int, Vector2 x) { return Vector2{3.0 + 0.4 * x[0] - 2.0 * x[1], 1.0 + x[0] + 0.3 * x[1]}; });
  auto const moving = forces(s);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
    for (int i = 0; i < 8; ++i)
      EXPECT_NEAR(moving(pair, i), still(pair, i), 2e-14);
}

TEST(CornerForces, HourglassVelocityOnASquare_isDampedByTheStatedForce)
{
  Scene s = makeScene(1, 1, 0.0, {fluid()}, full);
  s.setVelocity([](int, Vector2 x) { return Vector2{x[0] == x[1] ? 1.0 : -1.0, 0.0}; });
  auto const f = forces(s);
  // C gamma (gamma . v) = kappa m c / (4 L) * 4, against the velocity
  double const expected = s.options.hourglass_viscosity * 2.0 * 3.0;
  for (int k = 0; k < 4; ++k)
  {
    EXPECT_NEAR(f(0, 2 * k), k % 2 == 0 ? -expected : expected, 1e-15);
    EXPECT_NEAR(f(0, 2 * k + 1), 0.0, 1e-15);
  }
}

TEST(CornerForces, Compression_addsLinearAndQuadraticViscosity)
{
  Scene s = makeScene(1, 1, 0.0, {fluid()}, full);
  double const rate = 0.7;
  s.setVelocity([&](int, Vector2 x) { return Vector2{-rate * x[0], 0.0}; });
  auto const f = forces(s);
  double const q = 2.0 * (0.06 * 3.0 * rate + 1.2 * rate * rate);
  EXPECT_NEAR(f(0, 2), 0.5 * q, 1e-15); // corner 1: B = (1, -1) / 2
  EXPECT_NEAR(f(0, 3), -0.5 * q, 1e-15);
}

TEST(CornerForces, ViscosityOfAFilm_worksOverItsThicknessAcrossItAndOverItsCellAlongIt)
{
  double const d = 0.01, rate = 0.7, speed = 3.0;
  for (int along : {0, 1})
  {
    Scene s = film(d);
    s.setVelocity([&](int, Vector2 x) { return along == 1 ? Vector2{-rate * x[0], 0.0} : Vector2{0.0, -rate * x[1]}; });
    double const length = along == 1 ? 1.0 : d;
    double const q = 2.0 * (0.06 * speed * length * rate + 1.2 * length * length * rate * rate);
    EXPECT_NEAR(heat(s, 0.0), q * d * rate, 1e-10 * q * d * rate) << along;
  }
}

TEST(CornerForces, ViscosityBesideAFullCell_worksOverAWholeCell)
{
  Scene s = makeScene(
      1, 2, 0.0, {fluid()},
      [](int, int j) {
        return std::vector<Fill>{{0, j == 0 ? 1.0 : 0.3}};
      },
      Kinematics::Xfem);
  cutTopCell(s, 1, {Vector2{0.0, 1.0}, Vector2{1.0, 1.0}, Vector2{1.0, 1.3}, Vector2{0.0, 1.3}});
  auto const lost = onHost(s.work.cut.lost_extent);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(lost(0, k), 0.0, 1e-14);
}

TEST(CornerForces, ViscosityOfAFilm_neverCools)
{
  Scene s = film(0.01);
  s.setVelocity([](int, Vector2 x) { return Vector2{-7.0 * x[0], -7.0 * x[1] + 3.0 * x[0]}; });
  double const free = heat(s, 0.0);
  for (double const kick : {1e-3, 0.1, 10.0})
  {
    s.options.kick = kick;
    EXPECT_GT(heat(s, kick), -1e-12 * free) << kick;
  }
  EXPECT_NEAR(heat(s, 10.0), 0.0, 1e-12 * free); // what it may take at most: the compression is reversed
}

TEST(CornerForces, EnergyThatLags_isMadeUpForInThePressure)
{
  Material gas;
  gas.eos = EosKind::IdealGas;
  gas.gruneisen = 1.4;
  gas.density0 = 2.0;
  Scene s = makeScene(1, 1, 0.0, {gas}, full);
  auto const record = onHost(s.state.record);
  record(0, SpecificVolume) = 0.5;
  record(0, InternalEnergy) = 3.0;
  Kokkos::deep_copy(s.state.record, record);
  s.setVelocity([](int, Vector2 x) { return Vector2{0.3 * x[0], 0.4 * x[1]}; });
  auto const f = forces(s);
  double const force = f(0, 0);
  s.options.energy_lag = 0.1;
  // expansion has no viscosity: p* / p = 1 - Gamma tr D lag
  EXPECT_NEAR(forces(s)(0, 0) / force, 1.0 - 0.4 * 0.7 * 0.1, 1e-14);
}

TEST(CornerForces, Sliver_hasTheForceOfItsMassShare)
{
  double const share = 1e-12;
  Scene a = makeScene(1, 1, 0.0, {elastic()}, full);
  Scene b = makeScene(1, 1, 0.0, {elastic()}, [&](int, int) { return std::vector<Fill>{{0, share}}; });
  disturb(a, 3);
  disturb(b, 3);
  auto const fa = forces(a);
  auto const fb = forces(b);
  for (int i = 0; i < 8; ++i)
    EXPECT_NEAR(fb(0, i) / share, fa(0, i), 1e-13);
}

TEST(CornerForces, RigidPair_hasNone)
{
  Scene s = makeScene(2, 2, 0.0, {rigid()}, full);
  disturb(s, 3);
  auto const f = forces(s);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
    for (int i = 0; i < 8; ++i)
      EXPECT_EQ(f(pair, i), 0.0);
}
