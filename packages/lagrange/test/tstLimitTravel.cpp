// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

/// Full cells in columns 0 and 1, slivers in column 2; v^{n-1/2}, v* and v_half as given.
Scene sliverColumn(double sliver, std::function<Vector2(Vector2)> const &velocity,
                   std::vector<BoundaryKind> const &kinds = std::vector<BoundaryKind>(4, BoundaryKind::Outflow))
{
  Scene s = makeScene(
      4, 3, 0.1, {elastic()},
      [=](int i, int) {
        return i < 2 ? std::vector<Fill>{{0, 1.0}} : i == 2 ? std::vector<Fill>{{0, sliver}} : std::vector<Fill>{};
      },
      Kinematics::Xfem, kinds);
  s.setVelocity([&](int, Vector2 x) { return velocity(x); });
  Kokkos::deep_copy(s.work.half, s.state.velocity);
  Kokkos::deep_copy(s.work.predicted, s.state.velocity);
  return s;
}

TravelReport limit(Scene &s, double dt)
{
  return limitTravel(s.mesh, s.pairs, s.dof_nodes, s.state, s.boundary, s.materials, s.options, dt, s.work);
}

KineticSums sums(Scene const &s)
{
  return kineticSums(s.mesh, s.dof_nodes, s.work.dof_mass, s.work.half);
}

} // namespace

TEST(LimitTravel, SlowNodes_areLeftAlone)
{
  Scene s = sliverColumn(1e-8, [](Vector2) { return Vector2{1.0, 0.5}; });
  auto const report = limit(s, 0.3);
  EXPECT_EQ(report.limited, 0);
  EXPECT_LT(report.largest_ratio, 1.0);
  EXPECT_GT(report.largest_ratio, 0.3);
  EXPECT_EQ(onHost(s.work.half)(0, 0), 1.0);
}

TEST(LimitTravel, LightNodes_takeTheirPairsMeanAndMomentumStays)
{
  Scene s = sliverColumn(1e-8, [](Vector2 x) { return x[0] > 2.5 ? Vector2{-30.0, 40.0 * x[1]} : Vector2{1.0, 0.5}; });
  auto const before = sums(s);
  auto const report = limit(s, 0.3);
  auto const after = sums(s);
  EXPECT_EQ(report.limited, 4);
  EXPECT_LT(report.largest_ratio, 1.0);
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d], before.momentum[d], 1e-13 * before.mass);
  EXPECT_NEAR(report.energy_loss, before.kinetic_energy - after.kinetic_energy, 1e-13 * before.kinetic_energy);
  EXPECT_GT(report.energy_loss, 0.0);
  auto const half = onHost(s.work.half);
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
    EXPECT_NEAR(half(dof, 0), 1.0, 1e-5);
}

TEST(LimitTravel, AfterForcesAndAnImpulse_energyIsBooked)
{
  Scene s = sliverColumn(1e-4, [](Vector2 x) { return x[0] > 2.5 ? Vector2{-5.0, 4.0 * x[1]} : Vector2{1.0, x[1]}; });
  double const dt = 0.2;
  double const before = sums(s).kinetic_energy + s.internalEnergy();
  s.predict(dt);
  auto const half = onHost(s.work.half);
  auto const v = onHost(s.state.velocity);
  auto const mass = onHost(s.work.dof_mass);
  double work = 0.0; // of an impulse at every dof node, with v_mean before the limit
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
  {
    half(dof, 0) += 0.1 * dof;
    work += 0.1 * dof * mass(dof) * 0.5 * (v(dof, 0) + half(dof, 0));
  }
  Kokkos::deep_copy(s.work.half, half);
  auto const report = limit(s, dt);
  EXPECT_GT(report.limited, 0);
  EXPECT_GT(report.energy_loss, 1e-4);
  TimeStepLimit next;
  s.update(dt, next);
  EXPECT_NEAR(sums(s).kinetic_energy + s.internalEnergy() + report.energy_loss - work, before, 1e-12 * before);
}

TEST(LimitTravel, FreeFlyingSliver_keepsItsMomentum)
{
  Scene s = makeScene(3, 3, 0.0, {elastic()},
                      [](int i, int j) {
                        return i == 1 && j == 1 ? std::vector<Fill>{{0, 1e-6}} : std::vector<Fill>{};
                      });
  s.setVelocity([](int dof, Vector2) { return dof == 0 ? Vector2{8.0, 0.0} : Vector2{0.5, 0.1 * dof}; });
  Kokkos::deep_copy(s.work.half, s.state.velocity);
  Kokkos::deep_copy(s.work.predicted, s.state.velocity);
  auto const before = sums(s);
  auto const report = limit(s, 0.2);
  EXPECT_EQ(report.limited, 4); // its light companions go with the node that is too fast
  auto const after = sums(s);
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d], before.momentum[d], 1e-13 * std::fabs(before.momentum[0]));
}

TEST(LimitTravel, SqueezedSplinter_takesItsMeanAndAHeavyPieceDoesNot)
{
  for (double const fill : {1e-6, 1e-2})
  {
    Scene s = makeScene(3, 3, 0.0, {elastic()},
                        [=](int i, int j) {
                          return i == 1 && j == 1 ? std::vector<Fill>{{0, fill}} : std::vector<Fill>{};
                        });
    s.setVelocity([](int, Vector2 x) { return Vector2{0.2, x[1] > 1.5 ? -1.0 : 2.0}; });
    Kokkos::deep_copy(s.work.half, s.state.velocity);
    Kokkos::deep_copy(s.work.predicted, s.state.velocity);
    auto const before = sums(s);
    auto const report = limit(s, 0.2); // travels 0.4, moves by 0.3 against the mean
    auto const after = sums(s);
    EXPECT_EQ(report.limited, fill < 1e-3 ? 4 : 0);
    for (int d = 0; d < 2; ++d)
      EXPECT_NEAR(after.momentum[d], before.momentum[d], 1e-13 * std::fabs(before.momentum[d]));
    EXPECT_NEAR(report.energy_loss, before.kinetic_energy - after.kinetic_energy, 1e-13 * before.kinetic_energy);
    EXPECT_EQ(limit(s, 0.1).limited, 0);
  }
}

TEST(LimitTravel, WallNodes_keepTheirConditionAndTheWallsShareIsBooked)
{
  Scene s = sliverColumn(
      1e-8,
      [](Vector2 x)
      {
        double const up = x[1] == 0.0 || x[1] == 3.0 ? 0.0 : 1.0;
        return x[0] > 2.5 ? Vector2{-30.0, 40.0 * up} : Vector2{1.0, 0.5 * up};
      },
      std::vector<BoundaryKind>(4, BoundaryKind::SlipWall));
  auto const before = sums(s);
  auto const report = limit(s, 0.3);
  auto const after = sums(s);
  EXPECT_EQ(report.limited, 4);
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d] - before.momentum[d], report.wall_impulse[d], 1e-14 * before.mass);
  auto const half = onHost(s.work.half);
  auto const node = onHost(s.dof_nodes.node);
  auto const x = onHost(s.mesh.node_position);
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
    if (x(node(dof), 1) == 0.0)
    {
      EXPECT_EQ(half(dof, 1), 0.0);
    }
}

TEST(LimitTravel, SplinterInACornerOfWalls_leavesThemWhatItsNodesCannotTake)
{
  // Its four nodes are all slowed, so that no free one takes up what the walls keep from the others.
  Scene s = makeScene(
      3, 3, 0.0, {elastic()},
      [](int i, int j) {
        return i == 0 && j == 0 ? std::vector<Fill>{{0, 1e-6}} : std::vector<Fill>{};
      },
      Kinematics::Xfem, std::vector<BoundaryKind>(4, BoundaryKind::SlipWall));
  s.setVelocity([](int, Vector2 x) { return Vector2{x[0] > 0.0 ? 8.0 : 0.0, x[1] > 0.0 ? 5.0 : 0.0}; });
  Kokkos::deep_copy(s.work.half, s.state.velocity);
  Kokkos::deep_copy(s.work.predicted, s.state.velocity);
  auto const before = sums(s);
  auto const report = limit(s, 0.2);
  auto const after = sums(s);
  EXPECT_EQ(report.limited, 4);
  for (int d = 0; d < 2; ++d)
  {
    EXPECT_LT(report.wall_impulse[d], -0.1 * before.momentum[d]);
    EXPECT_NEAR(after.momentum[d] - before.momentum[d], report.wall_impulse[d], 1e-15 * before.momentum[d]);
  }
}

TEST(LimitTravel, HeavyNode_isReportedNotTouched)
{
  Scene s = sliverColumn(1.0, [](Vector2 x) { return x[0] > 2.5 ? Vector2{30.0, 0.0} : Vector2{0.0, 0.0}; });
  auto const report = limit(s, 0.3);
  EXPECT_EQ(report.limited, 0);
  EXPECT_GT(report.largest_ratio, 10.0);
  EXPECT_LT(report.largest_ratio, 15.0); // altitudes of distorted cells
  auto const again = limit(s, 0.99 * 0.3 / report.largest_ratio);
  EXPECT_LT(again.largest_ratio, 1.0);
}

TEST(LimitTravel, NodesThatWouldPassEachOther_askForAShorterStep)
{
  Scene s = makeScene(3, 3, 0.0, {elastic()}, [](int, int) { return std::vector<Fill>{{0, 1.0}}; });
  s.setVelocity([](int, Vector2 x) { return Vector2{x[0] < 1.5 ? 3.0 : -3.0, 0.0}; });
  Kokkos::deep_copy(s.work.half, s.state.velocity);
  Kokkos::deep_copy(s.work.predicted, s.state.velocity);
  EXPECT_GT(limit(s, 0.2).largest_ratio, 1.0);  // 0.6 each, towards each other
  EXPECT_LT(limit(s, 0.15).largest_ratio, 0.6); // 0.45
  s.setVelocity([](int, Vector2) { return Vector2{3.0, 0.0}; });
  Kokkos::deep_copy(s.work.half, s.state.velocity);
  EXPECT_LT(limit(s, 0.2).largest_ratio, 0.7); // 0.6, all the same way
}

TEST(LimitTravel, CornerThatWouldPassTheDiagonal_asksForAShorterStep)
{
  Scene s = makeScene(3, 3, 0.0, {elastic()}, [](int, int) { return std::vector<Fill>{{0, 1.0}}; });
  auto const set = [&](double speed)
  {
    double const along = speed / std::sqrt(2.0);
    s.setVelocity(
        [=](int, Vector2 x)
        {
          if (x[0] > 1.5 && x[0] < 2.5 && x[1] > 0.5 && x[1] < 1.5)
            return Vector2{-along, along}; // corner (2, 1) of the middle cell, towards (1, 2)
          bool const beside = x[0] > 0.5 && x[0] < 2.5 && x[1] > 0.5 && x[1] < 2.5;
          return beside ? Vector2{along, -along} : Vector2{0.0, 0.0};
        });
    Kokkos::deep_copy(s.work.half, s.state.velocity);
    Kokkos::deep_copy(s.work.predicted, s.state.velocity);
  };
  // The diagonal is 0.707 away.
  set(0.36);
  EXPECT_GT(limit(s, 1.0).largest_ratio, 1.0);
  set(0.35);
  EXPECT_LT(limit(s, 1.0).largest_ratio, 0.4);
}
