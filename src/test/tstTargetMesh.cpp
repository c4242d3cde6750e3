// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectKept.hpp"
#include <Harmos_TargetMesh.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

/// Nodes swing about their places by a third of a cell, those of walls along them.
void swingTo(double time, View<double *[2]> const &reference, View<double *[2]> const &target)
{
  double const a = 0.008 * std::sin(2.0 * Math::pi * time / 4e-5);
  Kokkos::parallel_for(
      "swing", RangePolicy(0, static_cast<int>(target.extent(0))), KOKKOS_LAMBDA(int node) {
        double const x = reference(node, 0), y = reference(node, 1);
        target(node, 0) = x + a * Math::sin(3.0 * Math::pi * x) * Math::cos(2.0 * Math::pi * y);
        target(node, 1) = y + a * Math::cos(2.0 * Math::pi * x) * Math::sin(3.0 * Math::pi * y);
      });
}

TargetMesh swing(View<double *[2]> const &reference)
{
  return [reference](Mesh const &, CycleState const &s, double dt, View<double *[2]> const &target)
  { swingTo(s.time + dt, reference, target); };
}

} // namespace

TEST(TargetMesh, thatStays_givesTheBitsOfTheEulerianCycle)
{
  Impact plain, held;
  held.scene.target_mesh = [](Mesh const &, CycleState const &, double, View<double *[2]> const &) {};
  plain.scene.max_dt = held.scene.max_dt = plain.state.dt = held.state.dt = 0.3 * plain.state.dt;
  for (int cycle = 0; cycle < 20; ++cycle)
  {
    advance(plain.scene, plain.state, plain.times);
    advance(held.scene, held.state, held.times);
  }
  ASSERT_EQ(plain.state.pairs.num_pairs, held.state.pairs.num_pairs);
  for (int pair = 0; pair < plain.state.pairs.num_pairs; ++pair)
    for (int f = 0; f < num_pair_fields; ++f)
      ASSERT_EQ(plain.state.state.record(pair, f), held.state.state.record(pair, f));
}

TEST(TargetMesh, thatSwings_keepsMassMomentumAndEnergyAndTheMotion)
{
  Impact still, moving;
  MaterialSums const before = moving.sums();
  moving.scene.target_mesh = swing(moving.scene.mesh.node_position);
  still.run(2e-4);
  moving.run(2e-4);
  ASSERT_EQ(moving.failures, 0);
  expectKept(before, moving, still, 0.01);
  double const given = still.sums()(1, SumMomentumX) / before(0, SumMomentumX);
  EXPECT_LT(given, 1.0);
  EXPECT_GT(given, 0.1);
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(moving.state.tracers[0].position[d], still.state.tracers[0].position[d], 1e-3);
  EXPECT_EQ(locatePoints(moving.scene.mesh, {moving.state.tracers[0].position}, moving.alone)[0],
            moving.state.tracers[0].cell);
}

TEST(TargetMesh, contactArises_betweenFieldsOrWithContactWallsAlone)
{
  std::vector<Boundary> walls(4);
  EXPECT_TRUE(contactCanArise(Kinematics::Xfem, 2, walls));
  EXPECT_FALSE(contactCanArise(Kinematics::Xfem, 1, walls));
  EXPECT_FALSE(contactCanArise(Kinematics::Single, 2, walls));
  walls[2].kind = BoundaryKind::ContactWall;
  EXPECT_TRUE(contactCanArise(Kinematics::Xfem, 1, walls));
  EXPECT_TRUE(contactCanArise(Kinematics::Single, 2, walls));
}

TEST(TargetMesh, thatCannotBe_isRefused)
{
  Impact folded;
  folded.scene.target_mesh = [](Mesh const &, CycleState const &, double, View<double *[2]> const &target)
  { target(41 * 20 + 20, 0) += 0.04; };
  EXPECT_THROW(folded.run(1e-6), std::runtime_error);
  Impact lagrangian;
  lagrangian.scene.target_mesh = swing(lagrangian.scene.mesh.node_position);
  lagrangian.scene.kinematics = Kinematics::Lagrangian;
  EXPECT_THROW(lagrangian.run(1e-6), std::runtime_error);
  Impact prescribed;
  prescribed.scene.target_mesh = swing(prescribed.scene.mesh.node_position);
  prescribed.scene.prescribed.kind = FieldKind::Rotation;
  EXPECT_THROW(prescribed.run(1e-6), std::runtime_error);
}
