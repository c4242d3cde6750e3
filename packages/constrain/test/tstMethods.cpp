// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <gtest/gtest.h>

using namespace HarmosTest;

namespace
{

constexpr double V = 100.0; // closing speed

/// A row of cells between slip walls, h = 1: block 0 left of x = 5.3, block 1 from there + gap on, densities 2 and 3.
TinyScene strip(ConstraintMethod method, double gap = 0.0)
{
  std::vector<BoundaryKind> const walls(4, BoundaryKind::SlipWall);
  TinyScene scene(rectilinearMesh(uniform(10, 10), uniform(1, 1)),
                  {boxBody(0, 0, 0, 5.3, 1), boxBody(1, 5.3 + gap, 0, 10, 1)}, 2, walls, Kinematics::Xfem, {2.0, 3.0});
  scene.options.method = method;
  scene.options.impedance = deviceCopy("impedance", std::vector<double>{2.0e3, 3.0e3});
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : -V, 0.0}; });
  return scene;
}

void expectMomentum(TinyScene const &scene)
{
  auto const before = scene.sums(scene.predicted, -2), after = scene.sums(scene.half, -2);
  EXPECT_NEAR(after.momentum[0], before.momentum[0], 1e-13 * before.mass * V);
}

double speedAt(TinyScene const &scene, int material, Vector2 const &point)
{
  double speed = 1e300;
  auto const v = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.half);
  scene.forEachDof(
      [&](int dof, int of_material, Vector2 const &x)
      {
        if (of_material == material && norm(x - point) < 1e-9)
          speed = v(dof, 0);
      });
  return speed;
}

} // namespace

// p = dt L beta Z 2 V, with Z = 2 Z1 Z2 / (Z1 + Z2).
TEST(Methods, penalty_isImpedanceTimesClosingVelocity)
{
  TinyScene scene = strip(ConstraintMethod::Penalty);
  scene.options.penalty = 0.7;
  ConstraintReport const report = scene.constrain();
  EXPECT_NEAR(report.pair_force[3 * 1].normal_impulse, scene.dt * 0.7 * 2.4e3 * 2.0 * V, 1e-9);
  expectMomentum(scene);
}

TEST(Methods, penalty_ofAPartingPair_isExactlyZero)
{
  TinyScene scene = strip(ConstraintMethod::Penalty);
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? -V : V, 0.0}; });
  EXPECT_EQ(scene.constrain().pair_force[3 * 1].normal_impulse, 0.0);
}

// Both at rest under one stress: its traction, whatever the penalty.
TEST(Methods, nitsche_ofATouchingPairUnderOneStress_isItsTraction)
{
  for (double const stress : {-5.0e6, 5.0e6})
  {
    TinyScene scene = strip(ConstraintMethod::Nitsche);
    scene.setVelocity([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
    scene.stress.cauchy = View<double *[3]>("stress", scene.pairs.num_pairs);
    Kokkos::deep_copy(Kokkos::subview(scene.stress.cauchy, Kokkos::ALL, 0), stress);
    ConstraintReport const report = scene.constrain();
    EXPECT_NEAR(report.pair_force[3 * 1].normal_impulse, scene.dt * std::max(-stress, 0.0), 1e-9 * scene.dt * 5.0e6);
    expectMomentum(scene);
  }
}

// All materials at a node get the node's mean velocity; nodes of one material keep theirs.
TEST(Methods, merged_sharesVelocitiesAtTheNodesOfTheInterface)
{
  TinyScene scene = strip(ConstraintMethod::Merged);
  EXPECT_TRUE(scene.constrain().converged);
  expectMomentum(scene);
  for (double const x : {5.0, 6.0})
    EXPECT_NEAR(speedAt(scene, 0, {x, 0.0}), speedAt(scene, 1, {x, 0.0}), 1e-9 * V);
  EXPECT_EQ(speedAt(scene, 0, {4.0, 0.0}), V);
  EXPECT_EQ(speedAt(scene, 1, {7.0, 0.0}), -V);
  TinyScene parting = strip(ConstraintMethod::Merged);
  parting.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? -V : V, 0.0}; });
  parting.constrain();
  EXPECT_NEAR(speedAt(parting, 0, {5.0, 0.0}), speedAt(parting, 1, {5.0, 0.0}), 1e-9 * V);
}

// The nodal constraint stops what closes and lets part; it acts through half a cell of void, where multipliers do not.
TEST(Methods, nodal_isOneSidedAndActsThroughAGap)
{
  for (double const gap : {0.0, 0.5})
  {
    TinyScene scene = strip(ConstraintMethod::Nodal, gap);
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged);
    EXPECT_GT(report.pair_force[3 * 1].normal_impulse, 0.0);
    expectMomentum(scene);
    EXPECT_NEAR(speedAt(scene, 0, {5.0, 0.0}), speedAt(scene, 1, {5.0, 0.0}), 1e-9 * V);
    scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? -V : V, 0.0}; });
    EXPECT_EQ(scene.constrain().pair_force[3 * 1].normal_impulse, 0.0);
  }
  TinyScene multipliers = strip(ConstraintMethod::Multipliers, 0.5);
  EXPECT_EQ(multipliers.constrain().pair_force[3 * 1].normal_impulse, 0.0);
}

// Two points a segment carry the load of one: the same impulse where the velocity is uniform.
TEST(Methods, everyPlacement_givesTheSameImpulseOnAFlatImpact)
{
  double expected = 0.0;
  for (Placement const placement : {Placement::Midpoint, Placement::GaussPoints, Placement::SegmentEnds})
  {
    TinyScene scene = strip(ConstraintMethod::Multipliers);
    scene.options.placement = placement;
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    EXPECT_EQ(report.rows, placement == Placement::Midpoint ? 1 : 2);
    EXPECT_NEAR(report.pair_force[3 * 1].area, 1.0, 1e-12);
    if (placement == Placement::Midpoint)
      expected = report.pair_force[3 * 1].normal_impulse;
    EXPECT_NEAR(report.pair_force[3 * 1].normal_impulse, expected, 1e-9 * expected);
    expectMomentum(scene);
  }
}

// Four cells of two materials each around one node: 28 pairs there. Merged needs only seven rows there.
TEST(Methods, nodal_eightMaterialsAtANode_areRefused)
{
  std::vector<Body> body;
  for (int cell = 0; cell < 4; ++cell)
    for (int half = 0; half < 2; ++half)
    {
      double const x = cell % 2 + 0.5 * half, y = cell / 2;
      body.push_back(boxBody(2 * cell + half, x, y, x + 0.5, y + 1.0));
    }
  std::vector<BoundaryKind> const walls(4, BoundaryKind::SlipWall);
  TinyScene scene(rectilinearMesh(uniform(2, 2), uniform(2, 2)), body, 8, walls);
  scene.setVelocity([](int, Vector2 const &) { return Vector2{1.0, 0.0}; });
  scene.options.method = ConstraintMethod::Merged;
  EXPECT_EQ(scene.constrain().rows, 2 * (7 + 4 * 3 + 4 * 1)); // in the middle, on the sides, at the corners
  scene.options.method = ConstraintMethod::Nodal;
  try
  {
    scene.constrain();
    FAIL() << "rows were dropped";
  }
  catch (std::runtime_error const &error)
  {
    EXPECT_STREQ(error.what(), "nodal contact: 8 materials at one node make 28 pairs, at most 16");
  }
}
