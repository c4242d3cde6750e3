// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

std::vector<Fill> halves(int i, int)
{
  return i == 1 ? std::vector<Fill>{{0, 0.25}, {1, 0.5}} : std::vector<Fill>{{i == 0 ? 0 : 1, 1.0}};
}

KineticSums sumsAt(Scene const &s, View<double *[2]> const &velocity)
{
  return kineticSums(s.mesh, s.dof_nodes, s.work.dof_mass, velocity);
}

} // namespace

TEST(DofMass, EveryKinematics_addsUpToTheMassOfThePairs)
{
  for (Kinematics const kinematics : {Kinematics::Xfem, Kinematics::Single})
  {
    Scene s = makeScene(3, 2, 0.2, {elastic(), fluid()}, halves, kinematics);
    double mass = 0.0;
    auto const r = onHost(s.state.record);
    for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
      mass += r(pair, Mass);
    EXPECT_NEAR(sumsAt(s, s.state.velocity).mass / mass, 1.0, 1e-15);
    auto const before = onHost(s.work.dof_mass);
    s.predict(0.01);
    auto const after = onHost(s.work.dof_mass);
    for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
      EXPECT_EQ(before(dof), after(dof));
  }
}

TEST(PredictVelocities, FreeBodies_keepMomentumAndAngularMomentum)
{
  for (Kinematics const kinematics : {Kinematics::Xfem, Kinematics::Single})
  {
    Scene s = makeScene(3, 4, 0.2, {elastic(), fluid()}, halves, kinematics);
    disturb(s, 5);
    auto const before = sumsAt(s, s.state.velocity);
    s.predict(0.05);
    auto const after = sumsAt(s, s.work.predicted);
    EXPECT_NEAR(after.momentum[0], before.momentum[0], 1e-13);
    EXPECT_NEAR(after.momentum[1], before.momentum[1], 1e-13);
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 1e-12);
    EXPECT_NE(after.kinetic_energy, before.kinetic_energy);
  }
}

TEST(PredictVelocities, SlipWalls_takeTheNormalImpulseAndBookIt)
{
  Scene s =
      makeScene(3, 3, 0.2, {elastic()}, full, Kinematics::Xfem, std::vector<BoundaryKind>(4, BoundaryKind::SlipWall));
  disturb(s, 6);
  s.options.gravity = {0.3, -2.0};
  double const dt = 0.05;
  auto const before = sumsAt(s, s.state.velocity);
  auto const sums = s.predict(dt);
  auto const after = sumsAt(s, s.work.predicted);
  auto const node = onHost(s.dof_nodes.node);
  auto const x = onHost(s.mesh.node_position);
  auto const v = onHost(s.work.predicted);
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
  {
    if (x(node(dof), 0) == 0.0 || x(node(dof), 0) == 3.0)
    {
      EXPECT_NEAR(v(dof, 0), 0.0, 1e-15);
    }
    if (x(node(dof), 1) == 0.0 || x(node(dof), 1) == 3.0)
    {
      EXPECT_NEAR(v(dof, 1), 0.0, 1e-15);
    }
  }
  for (int d = 0; d < 2; ++d)
  {
    EXPECT_NEAR(sums.gravity_impulse[d], before.mass * dt * s.options.gravity[d], 1e-14);
    EXPECT_NEAR(after.momentum[d] - before.momentum[d], sums.gravity_impulse[d] + sums.wall_impulse[d], 1e-13);
  }
}

TEST(ForcesAndPrediction, pieceByPiece_giveTheBitsOfAllAtOnce)
{
  auto const contents = [](int i, int j)
  {
    return i + j > 60 ? std::vector<Fill>{{1, 1.0}} : i + j == 60 ? std::vector<Fill>{{0, 0.25}, {1, 0.5}} : full(i, j);
  };
  for (Kinematics const kinematics : {Kinematics::Xfem, Kinematics::Single})
  {
    Scene s = makeScene(83, 71, 0.2, {elastic(), fluid()}, contents, kinematics,
                        std::vector<BoundaryKind>(4, BoundaryKind::SlipWall));
    disturb(s, 8);
    s.options.gravity = {0.3, -2.0};
    double const dt = 0.05;
    PredictionSums const of_all = s.predict(dt);
    auto const copy = [](auto const &view)
    {
      auto const kept = Kokkos::create_mirror(view);
      Kokkos::deep_copy(kept, view);
      Kokkos::deep_copy(view, 0.0);
      return kept;
    };
    auto const force = copy(s.work.corner_force);
    auto const predicted = copy(s.work.predicted);
    auto const mass = copy(s.work.dof_mass);
    PredictionSums const sums =
        computeForcesAndPredict(s.mesh, s.pairs, s.dof_nodes, s.state, s.boundary, s.materials, s.options, dt, s.work);
    if (std::is_same<MemorySpace, Kokkos::HostSpace>::value) // devices take all at once
    {
      EXPECT_GT(s.work.pieces.node_end.size(), 2u);
    }
    auto const force_now = onHost(s.work.corner_force);
    auto const predicted_now = onHost(s.work.predicted);
    auto const mass_now = onHost(s.work.dof_mass);
    for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
      for (int i = 0; i < 8; ++i)
        ASSERT_EQ(force_now(pair, i), force(pair, i));
    for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
    {
      ASSERT_EQ(mass_now(dof), mass(dof));
      for (int d = 0; d < 2; ++d)
        ASSERT_EQ(predicted_now(dof, d), predicted(dof, d));
    }
    for (int d = 0; d < 2; ++d)
    {
      EXPECT_NEAR(sums.gravity_impulse[d] / of_all.gravity_impulse[d], 1.0, 1e-12);
      EXPECT_NEAR(sums.wall_impulse[d] / of_all.wall_impulse[d], 1.0, 1e-10);
    }
    EXPECT_NEAR(sums.gravity_work / of_all.gravity_work, 1.0, 1e-10);
  }
}

TEST(PredictVelocities, FreeFall_isUniformAndItsWorkIsTheKineticEnergy)
{
  Scene s = makeScene(3, 3, 0.2, {elastic(), fluid()}, halves);
  s.options.gravity = {0.0, -10.0};
  auto const sums = s.predict(0.1);
  auto const v = onHost(s.work.predicted);
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
  {
    EXPECT_NEAR(v(dof, 0), 0.0, 1e-14);
    EXPECT_NEAR(v(dof, 1), -1.0, 1e-14);
  }
  auto const after = sumsAt(s, s.work.predicted);
  EXPECT_NEAR(sums.gravity_work, after.kinetic_energy, 1e-13);
}

TEST(PredictVelocities, RigidMaterial_keepsItsVelocityAndHoldsSharedNodes)
{
  auto const contents = [](int i, int) { return std::vector<Fill>{{i < 2 ? 0 : 1, 1.0}}; };
  double const dt = 0.05;
  for (Kinematics const kinematics : {Kinematics::Xfem, Kinematics::Single})
  {
    Scene s = makeScene(4, 2, 0.0, {elastic(), rigid()}, contents, kinematics);
    disturb(s, 8);
    s.options.gravity = {0.0, -1.0};
    auto const before = sumsAt(s, s.state.velocity);
    auto const sums = s.predict(dt);
    auto const after = sumsAt(s, s.work.predicted);
    auto const v = onHost(s.state.velocity);
    auto const p = onHost(s.work.predicted);
    auto const node = onHost(s.dof_nodes.node);
    auto const x = onHost(s.mesh.node_position);
    auto const material = onHost(s.dof_nodes.material);
    for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
    {
      bool const held = kinematics == Kinematics::Xfem ? material(dof) == 1 : x(node(dof), 0) >= 2.0;
      EXPECT_EQ(p(dof, 0) == v(dof, 0) && p(dof, 1) == v(dof, 1), held);
    }
    EXPECT_NEAR(after.mass, 8.0, 1e-14); // the deformable half alone
    for (int d = 0; d < 2; ++d)
      EXPECT_NEAR(after.momentum[d] - before.momentum[d], sums.gravity_impulse[d] + sums.driven_impulse[d], 1e-13);
    EXPECT_EQ(sums.driven_work != 0.0, kinematics == Kinematics::Single);
  }
}
