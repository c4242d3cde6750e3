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
