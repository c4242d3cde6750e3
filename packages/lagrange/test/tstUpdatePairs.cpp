// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <Harmos_Temperature.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

/// v_half as if the constraints had made it; forces from v^{n-1/2}.
void setHalf(Scene &s, std::function<Vector2(Vector2)> const &velocity)
{
  auto const half = onHost(s.work.half);
  auto const node = onHost(s.dof_nodes.node);
  auto const x = onHost(s.mesh.node_position);
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
  {
    Vector2 const v = velocity({x(node(dof), 0), x(node(dof), 1)});
    half(dof, 0) = v[0];
    half(dof, 1) = v[1];
  }
  Kokkos::deep_copy(s.work.half, half);
}

} // namespace

TEST(UpdatePairs, Translation_changesNothing)
{
  Scene s = makeScene(4, 3, 0.25, {elastic()}, full);
  disturb(s, 2);
  s.setVelocity([](int, Vector2) { return Vector2{2.0, -1.0}; });
  auto const before = Kokkos::create_mirror(s.state.record);
  Kokkos::deep_copy(before, s.state.record);
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  Kokkos::deep_copy(s.work.half, s.state.velocity);
  TimeStepLimit next;
  s.update(0.1, next);
  auto const after = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
    for (int field = 0; field < num_pair_fields; ++field)
      EXPECT_NEAR(after(pair, field), before(pair, field), 5e-15);
}

TEST(UpdatePairs, FiniteRotation_turnsTheStressExactly)
{
  Scene s = makeScene(4, 3, 0.25, {elastic()}, full);
  auto r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    r(pair, DeviatorXX) = 3.0;
    r(pair, DeviatorYY) = -1.0;
    r(pair, DeviatorXY) = 2.0;
  }
  Kokkos::deep_copy(s.state.record, r);
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  double const angle = 0.4, dt = 0.1, c = std::cos(angle), n = std::sin(angle);
  setHalf(s, [&](Vector2 x) { return (1.0 / dt) * Vector2{(c - 1.0) * x[0] - n * x[1], n * x[0] + (c - 1.0) * x[1]}; });
  Kokkos::deep_copy(s.state.velocity, s.work.half);
  TimeStepLimit next;
  s.update(dt, next);
  r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    EXPECT_NEAR(r(pair, DeviatorXX), c * c * 3.0 - n * n - 4.0 * c * n, 2e-13);
    EXPECT_NEAR(r(pair, DeviatorYY), n * n * 3.0 - c * c + 4.0 * c * n, 2e-13);
    EXPECT_NEAR(r(pair, DeviatorXY), 4.0 * c * n + 2.0 * (c * c - n * n), 2e-13);
    EXPECT_NEAR(r(pair, SpecificVolume), 0.5, 1e-14);
  }
}

TEST(UpdatePairs, AnyStep_keepsKineticPlusInternalEnergy)
{
  for (Kinematics const kinematics : {Kinematics::Xfem, Kinematics::Single})
  {
    Scene s = makeScene(
        5, 4, 0.25, {elastic(), fluid()},
        [](int i, int) {
          return i == 2 ? std::vector<Fill>{{0, 0.3}, {1, 1e-9}} : std::vector<Fill>{{i < 2 ? 0 : 1, 1.0}};
        },
        kinematics);
    disturb(s, 4);
    double const dt = 0.03;
    double const kinetic = kineticSums(s.mesh, s.dof_nodes, s.work.dof_mass, s.state.velocity).kinetic_energy;
    double const before = kinetic + s.internalEnergy();
    s.predict(dt);
    TimeStepLimit next;
    s.update(dt, next);
    double const after =
        kineticSums(s.mesh, s.dof_nodes, s.work.dof_mass, s.work.half).kinetic_energy + s.internalEnergy();
    EXPECT_NEAR(after / before, 1.0, 1e-14);
    EXPECT_GT(std::fabs(kinetic + s.internalEnergy() - before), 1e-4);
  }
}

TEST(UpdatePairs, Stretch_movesVolumeWithTheCellAndStrainWithTheGradient)
{
  Scene s = makeScene(2, 2, 0.0, {elastic()}, full);
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  double const rate = 0.2, dt = 0.1;
  setHalf(s, [&](Vector2 x) { return Vector2{rate * x[0], 0.0}; });
  TimeStepLimit next;
  s.update(dt, next);
  auto const r = onHost(s.state.record);
  double const strain = rate * dt / (1.0 + 0.5 * rate * dt); // at mid-step
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    EXPECT_NEAR(r(pair, SpecificVolume), 0.5 * (1.0 + rate * dt), 1e-15);
    EXPECT_NEAR(r(pair, DeviatorXX), 2.0 * 4.0 * strain * 2.0 / 3.0, 1e-15);
    EXPECT_NEAR(r(pair, DeviatorYY), -2.0 * 4.0 * strain / 3.0, 1e-15);
    EXPECT_NEAR(r(pair, DeviatorXY), 0.0, 1e-15);
  }
}

TEST(UpdatePairs, FoldedCellAndNaN_areCountedAndTheFirstIsNamed)
{
  Scene s = makeScene(3, 3, 0.0, {elastic()}, full);
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  setHalf(s, [](Vector2 x) { return Vector2{x[0] == 1.0 && x[1] == 1.0 ? 1.2 : 0.0, 0.0}; });
  auto const r = onHost(s.state.record);
  r(8, InternalEnergy) = std::numeric_limits<double>::quiet_NaN();
  Kokkos::deep_copy(s.state.record, r);
  TimeStepLimit next;
  auto const report = s.update(1.0, next);
  EXPECT_EQ(report.inverted, 2); // cells 1 and 4
  EXPECT_EQ(report.not_a_number, 1);
  EXPECT_EQ(report.cell, 1);
  EXPECT_EQ(report.material, 0);
  EXPECT_EQ(report.out_of_range, 0);
}

TEST(UpdatePairs, MassesThatAreNegativeOrNoNumbers_areCountedAndTheFirstIsNamed)
{
  Scene s = makeScene(3, 3, 0.0, {elastic()}, full);
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  setHalf(s, [](Vector2) { return Vector2{0.0, 0.0}; });
  auto const r = onHost(s.state.record);
  r(3, Mass) = -1e-9;
  r(5, Mass) = std::numeric_limits<double>::quiet_NaN();
  Kokkos::deep_copy(s.state.record, r);
  TimeStepLimit next;
  auto const report = s.update(1e-6, next);
  EXPECT_EQ(report.not_a_number, 2);
  EXPECT_EQ(report.cell, 3);
  EXPECT_EQ(report.material, 0);
}

TEST(UpdatePairs, PairsOutOfTheirLawsRange_areCountedAndTheFirstIsNamed)
{
  Material gas = fluid();
  gas.eos = EosKind::IdealGas;
  gas.gruneisen = 1.4;
  gas.sound_speed0 = 0.0;
  Scene s = makeScene(3, 3, 0.0, {gas}, full);
  auto const r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
    r(pair, InternalEnergy) = pair == 4 || pair == 6 ? -1.0 : 1.0;
  Kokkos::deep_copy(s.state.record, r);
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  setHalf(s, [](Vector2) { return Vector2{0.0, 0.0}; });
  TimeStepLimit next;
  auto const report = s.update(1e-6, next);
  EXPECT_EQ(report.out_of_range, 2);
  EXPECT_EQ(report.range_cell, 4);
  EXPECT_EQ(report.range_material, 0);
  EXPECT_EQ(report.range_energy, -1.0);
  EXPECT_EQ(report.range_mass, onHost(s.state.record)(4, Mass));
  EXPECT_EQ(report.not_a_number, 0);
  EXPECT_EQ(report.cell, -1);
}

TEST(UpdatePairs, RateDependentShear_followsTheFlowStressOfItsRateInEveryLane)
{
  Material m = elastic();
  m.strength = StrengthKind::JohnsonCook;
  m.yield = 1e-3;
  m.hardening = 2e-3;
  m.flow.hardening_exponent = 0.5;
  m.flow.rate_coefficient = 0.02;
  m.flow.melting_temperature = 2.0;
  setThermalCurve(m, 1e6, 1.0); // does not warm
  Scene s = makeScene(3, 3, 0.0, {m}, full);
  double const rate = 10.0, dt = 1e-4; // du/dy
  TimeStepLimit next;
  for (int i = 0; i < 100; ++i)
  {
    computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
    setHalf(s, [&](Vector2 x) { return Vector2{rate * x[1], 0.0}; });
    Kokkos::deep_copy(s.state.velocity, s.work.half);
    s.update(dt, next);
  }
  auto const r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    double const eps = r(pair, PlasticStrain);
    double const xx = r(pair, DeviatorXX), yy = r(pair, DeviatorYY), xy = r(pair, DeviatorXY);
    double const stress = std::sqrt(3.0 * (xx * xx + yy * yy + xx * yy + xy * xy));
    double const expected = (1e-3 + 2e-3 * std::sqrt(eps)) * (1.0 + 0.02 * std::log(rate / std::sqrt(3.0)));
    EXPECT_GT(eps, 0.05);
    EXPECT_NEAR(stress / expected, 1.0, 2e-3);
  }
}

TEST(UpdatePairs, RigidPairs_keepTheirRecords)
{
  Scene s = makeScene(2, 2, 0.0, {rigid()}, full);
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  setHalf(s, [](Vector2 x) { return Vector2{0.1 * x[0], 0.0}; });
  TimeStepLimit next;
  s.update(0.1, next);
  auto const r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    EXPECT_EQ(r(pair, SpecificVolume), 0.5);
    EXPECT_EQ(r(pair, DeviatorXX), 0.0);
  }
  EXPECT_NEAR(next.dt, 0.45 / 0.2, 1e-14); // travel alone
}
