// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <Harmos_DualProblem.hpp>

#include <gtest/gtest.h>

using namespace HarmosTest;

namespace
{

constexpr double V = 100.0; // impact speed

/// Block 0 left and block 1 right of a strip of `ny` cells, h = 1: 0 ends at x = 5 + shift, 1 begins `gap` further.
TinyScene twoBlocks(double shift, double gap, int ny = 3)
{
  double const x = 5.0 + shift;
  return TinyScene(rectilinearMesh(uniform(10, 10), uniform(ny, ny)),
                   {boxBody(0, 0, 0, x, ny), boxBody(1, x + gap, 0, 10, ny)}, 2, open_box, Kinematics::Xfem,
                   {2.0, 3.0});
}

void expectNoImpulse(TinyScene const &scene, ConstraintReport const &report)
{
  EXPECT_TRUE(report.converged);
  for (PairForce const &f : report.pair_force)
    EXPECT_EQ(f.normal_impulse, 0.0);
  auto const half = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.half);
  auto const predicted = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.predicted);
  for (int dof = 0; dof < scene.dof_nodes.num_dof_nodes; ++dof)
    for (int d = 0; d < 2; ++d)
      EXPECT_EQ(half(dof, d), predicted(dof, d));
}

void expectMomentumAndEnergy(TinyScene const &scene, ConstraintReport const &report)
{
  auto const before = scene.sums(scene.predicted, -2), after = scene.sums(scene.half, -2);
  double p = 0.0, kinetic = after.kinetic - before.kinetic;
  Vector2 change = after.momentum - before.momentum;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
  {
    RigidBody const &n = scene.bodies_n[b], &h = scene.bodies[b];
    if (n.motion != RigidMotion::Free)
      continue;
    change += n.mass * (h.velocity - n.velocity);
    kinetic += 0.5 * n.mass * (dot(h.velocity, h.velocity) - dot(n.velocity, n.velocity)) +
               0.5 * n.inertia * (h.angular_velocity * h.angular_velocity - n.angular_velocity * n.angular_velocity);
    p += n.mass * norm(n.velocity);
  }
  double const scale = before.mass * V + p;
  EXPECT_NEAR(change[0], report.external_impulse[0], 1e-13 * scale);
  EXPECT_NEAR(change[1], report.external_impulse[1], 1e-13 * scale);
  EXPECT_NEAR(kinetic, report.driven_work - report.contact_loss, 1e-13 * scale * V);
  EXPECT_GE(report.contact_loss, -1e-13 * scale * V);
}

} // namespace

// The interface lies in the middle of a cell, just inside a cell, and on a face: same impulse to the pairs' own masses,
// equal normal velocities behind.
TEST(Constrain, impact_interfaceVelocitiesBecomeEqual)
{
  for (double const shift : {0.5, 0.25, 1e-6, 0.0})
  {
    TinyScene scene = twoBlocks(shift, 0.0);
    scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : -V, 0.0}; });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    EXPECT_EQ(report.rows, 3);
    expectMomentumAndEnergy(scene, report);
    EXPECT_GT(report.pair_force[1].normal_impulse, 0.0);
    EXPECT_NEAR(report.pair_force[1].area, 3.0, 1e-12);
    EXPECT_NEAR(report.pair_force[1].impulse[0], -report.pair_force[1].normal_impulse, 1e-10);
    EXPECT_NEAR(report.pair_force[3].impulse[0], report.pair_force[1].normal_impulse, 1e-10);
    // No relative velocity at the row's point: constant along y by symmetry, so that the means over the faces agree.
    RecordProperty("iterations", report.iterations);
    EXPECT_LT(report.iterations, 60);
  }
}

// Two masses: all dofs of both blocks lie in the one cell, cut in the middle: v+ = (m0 v0 + m1 v1)/(m0 + m1).
TEST(Constrain, twoMassesInOneCell_impactPerfectlyPlastic)
{
  TinyScene scene(rectilinearMesh(uniform(1, 1), uniform(1, 1)), {boxBody(0, 0, 0, 0.5, 1), boxBody(1, 0.5, 0, 1, 1)},
                  2, open_box, Kinematics::Xfem, {2.0, 3.0});
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : -V, 7.0}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged);
  for (int material : {0, 1})
  {
    auto const s = scene.sums(scene.half, material);
    EXPECT_NEAR(s.least, -0.2 * V, 1e-9);
    EXPECT_NEAR(s.most, -0.2 * V, 1e-9);
    EXPECT_EQ(s.momentum[1], scene.sums(scene.predicted, material).momentum[1]); // frictionless
  }
  EXPECT_NEAR(report.contact_loss, 0.5 * (1.0 * 1.5 / 2.5) * 4 * V * V, 1e-9 * V * V);
  expectMomentumAndEnergy(scene, report);
}

TEST(Constrain, separatingBlocksThatTouch_areLetGo)
{
  for (double const shift : {0.5, 0.0})
  {
    TinyScene scene = twoBlocks(shift, 0.0);
    scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? -V : V, 0.0}; });
    expectNoImpulse(scene, scene.constrain());
  }
}

// Block 1 turns against block 0: pressed at the bottom, opening at the top, where nothing may hold it back.
TEST(Constrain, blocksThatPressAtOneEnd_openAtTheOther)
{
  TinyScene scene = twoBlocks(0.0, 0.0, 6);
  scene.setVelocity([](int material, Vector2 const &x) { return Vector2{material * V * (x[1] - 1.5), 0.0}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_GT(report.pair_force[1].normal_impulse, 0.0);
  EXPECT_LT(report.pair_force[1].area, 3.5);
  expectMomentumAndEnergy(scene, report);
  auto const half = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.half);
  scene.forEachDof(
      [&](int dof, int material, Vector2 const &x)
      {
        if (x[1] > 4.5)
        {
          EXPECT_EQ(half(dof, 0), material * V * (x[1] - 1.5));
        }
      });
}

// 0.3 of a cell of void between the blocks, in one cell and across a face: nothing happens while it does not close.
TEST(Constrain, gapThatStaysOpen_givesNoEarlyContact)
{
  for (double const shift : {0.2, 0.8})
  {
    TinyScene scene = twoBlocks(shift, 0.3);
    scene.dt = 0.149 / V; // 0.298 of the 0.3 close
    scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : -V, 0.0}; });
    expectNoImpulse(scene, scene.constrain());
  }
}

// Void of `gap` lies in one cell, or spans a face, or a cell and a half: it closes exactly within the step, no more.
TEST(Constrain, gapThatClosesWithinTheStep_closesExactly)
{
  struct Case
  {
    double shift, gap;
  };
  for (Case const c : {Case{0.2, 0.3}, Case{0.8, 0.5}, Case{0.0, 0.7}, Case{0.5, 0.5}, Case{0.9, 0.95}})
  {
    TinyScene scene = twoBlocks(c.shift, c.gap);
    scene.dt = 0.49 / V;
    scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : -V, 0.0}; });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged);
    EXPECT_GT(report.pair_force[1].normal_impulse, 0.0) << c.shift << " " << c.gap;
    expectMomentumAndEnergy(scene, report);
    // Relative impulse is that of the surplus of the closing speed.
    TinyScene hard = twoBlocks(c.shift, c.gap);
    hard.dt = 1e9;
    double const surplus = V - 0.5 * c.gap / scene.dt;
    hard.setVelocity(
        [surplus](int material, Vector2 const &) {
          return Vector2{material == 0 ? surplus : -surplus, 0.0};
        });
    double const impulse = hard.constrain().pair_force[1].normal_impulse;
    EXPECT_NEAR(report.pair_force[1].normal_impulse, impulse, 1e-7 * impulse);
  }
}

TEST(Constrain, gapWiderThanACell_isOutOfReach)
{
  TinyScene scene = twoBlocks(0.0, 1.5);
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : -V, 0.0}; });
  EXPECT_EQ(scene.constrain().rows, 0);
}

// Middle block 1 is hit from both sides; all three lie in one column of cells.
TEST(Constrain, threeMaterials_pushThroughTheMiddleOne)
{
  TinyScene scene(rectilinearMesh(uniform(5, 5), uniform(2, 2)),
                  {boxBody(0, 0, 0, 2.2, 2), boxBody(1, 2.2, 0, 2.7, 2), boxBody(2, 2.7, 0, 5, 2)}, 3, open_box);
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{V * (1 - material), 0.0}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_GT(report.pair_force[0 * 4 + 1].normal_impulse, 0.0);
  EXPECT_GT(report.pair_force[1 * 4 + 2].normal_impulse, 0.0);
  EXPECT_EQ(report.pair_force[0 * 4 + 2].normal_impulse, 0.0);
  expectMomentumAndEnergy(scene, report);
}

// A T: 0 below, 1 and 2 above, side by side; the cell at the joint holds three materials. 1 and 2 fall onto 0 and
// slide.
TEST(Constrain, threeMaterialsMeetAtAJoint_pressedAndSlidingUnhindered)
{
  TinyScene scene(rectilinearMesh(uniform(6, 6), uniform(6, 6)),
                  {boxBody(0, 0, 0, 6, 3.4), boxBody(1, 0, 3.4, 2.3, 6), boxBody(2, 2.3, 3.4, 6, 6)}, 3, open_box);
  scene.setVelocity(
      [](int material, Vector2 const &) {
        return Vector2{material == 0 ? 0.0 : V, material == 0 ? 0.0 : -V};
      });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  expectMomentumAndEnergy(scene, report);
  EXPECT_NEAR(scene.sums(scene.half, 0).momentum[0], 0.0, 1e-9 * V); // frictionless
  EXPECT_GT(scene.sums(scene.half, 0).momentum[1] / V, -100.0);
  EXPECT_LT(scene.sums(scene.half, 0).momentum[1], -V);
}

// A block with a corner inside the mesh slides over a plane: its side carries no row, its bottom only vertical ones.
TEST(Constrain, cornerOfASlidingBlock_feelsNoHorizontalForce)
{
  for (double const x : {2.5, 2.0, 2.05, 2.95})
  {
    TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(6, 6)),
                    {boxBody(0, 0, 0, 8, 2.3), boxBody(1, x, 2.3, x + 3, 5.3)}, 2, open_box);
    scene.setVelocity(
        [](int material, Vector2 const &) {
          return Vector2{material == 0 ? 0.0 : V, material == 0 ? 0.0 : -V};
        });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged);
    expectMomentumAndEnergy(scene, report);
    EXPECT_NEAR(report.pair_force[1].impulse[0], 0.0, 1e-12 * report.pair_force[1].normal_impulse);
    EXPECT_LT(report.pair_force[1].impulse[1], 0.0);
  }
}

// Interface at 15 degrees: action = reaction, and no tangential impulse.
TEST(Constrain, obliqueInterface_impulseIsNormalAndExactlyOpposite)
{
  double const c = std::cos(15 * Math::pi / 180), s = std::sin(15 * Math::pi / 180);
  Vector2 const along{c, s}, n{-s, c}, o{0.0, 2.13};
  TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(8, 8)),
                  {polygonBody(0, {o - 20 * along, o - 20 * along - 20 * n, o + 20 * along - 20 * n, o + 20 * along}),
                   polygonBody(1, {o + 20 * along, o + 20 * along + 20 * n, o - 20 * along + 20 * n, o - 20 * along})},
                  2, open_box);
  scene.setVelocity([&](int material, Vector2 const &x)
                    { return (material == 0 ? 0.3 : -0.7) * V * n + (0.1 * V * std::sin(x[0] + 2 * x[1])) * along; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  expectMomentumAndEnergy(scene, report);
  Vector2 const f = report.pair_force[3 * 1].impulse; // on 1 by 0
  double const p = report.pair_force[3 * 1].normal_impulse;
  EXPECT_NEAR(dot(f, along), 0.0, 1e-12 * p);
  EXPECT_NEAR(dot(f, n), p, 1e-12 * p);
  EXPECT_NEAR(norm(report.pair_force[1].impulse + f), 0.0, 1e-12 * p);
}

TEST(Constrain, tiedBlocks_shareBothVelocitiesAndHoldWhenPulled)
{
  for (double const sign : {1.0, -1.0})
  {
    TinyScene scene(rectilinearMesh(uniform(1, 1), uniform(1, 1)), {boxBody(0, 0, 0, 0.5, 1), boxBody(1, 0.5, 0, 1, 1)},
                    2, open_box);
    scene.setInteraction(0, 1, {Interaction::Bonded, 0.0, 0.0, {}});
    scene.setVelocity(
        [sign](int material, Vector2 const &) {
          return material == 0 ? Vector2{sign * V, V} : Vector2{-sign * V, 0.0};
        });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    EXPECT_EQ(report.rows, 2);
    for (int material : {0, 1})
    {
      auto const s = scene.sums(scene.half, material);
      EXPECT_NEAR(s.momentum[0], 0.0, 1e-9 * V);
      EXPECT_NEAR(s.momentum[1] / s.mass, 0.5 * V, 1e-9 * V);
    }
    expectMomentumAndEnergy(scene, report);
  }
}

// A bond at 45 degrees between slip walls, with rows at its ends: those of neighbouring segments ask for the same, and
// at the walls n and across it ask for the same.
TEST(Constrain, tiedRowsThatAskForTheSame_bearNoMoreThanTheBond)
{
  double const c = std::sqrt(0.5);
  Vector2 const along{c, c}, n{-c, c}, o{0.0, 0.37};
  TinyScene scene(rectilinearMesh(uniform(6, 6), uniform(8, 8)),
                  {polygonBody(0, {o - 20 * along, o - 20 * along - 20 * n, o + 20 * along - 20 * n, o + 20 * along}),
                   polygonBody(1, {o + 20 * along, o + 20 * along + 20 * n, o - 20 * along + 20 * n, o - 20 * along})},
                  2, std::vector<BoundaryKind>(4, BoundaryKind::SlipWall));
  scene.options.placement = Placement::SegmentEnds;
  scene.options.tolerance = 1e-11; // dependent rows leave 0.6e-12 to 1e-12, by the last digits
  scene.setInteraction(0, 1, {Interaction::Bonded, 0.0, 0.0, {}});
  scene.setVelocity(
      [](int material, Vector2 const &x) {
        return Vector2{std::sin(x[0]) * (6.0 - x[0]), material == 0 ? V * x[1] : -V * x[1]};
      });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_LE(report.iterations, 10);
  expectMomentumAndEnergy(scene, report);
  double const most = 8.0 * V * scene.sums(scene.predicted, -2).mass;
  for (PairForce const &f : report.pair_force)
    EXPECT_LE(norm(f.impulse), most);
  EXPECT_LE(std::fabs(report.contact_loss), 8.0 * V * most);
}

// A film along a slip wall, hardly tilted: its bond has next to nothing to move across the film, and does without.
TEST(Constrain, tiedFilmAtAWall_isGivenNoEnergy)
{
  for (double const tilt : {1e-5, -1e-5})
    for (double const shear : {V, -V})
    {
      double const a = 2e-5, b = a + 3.0 * tilt, far = 4e-5 - std::min(tilt, 0.0);
      TinyScene scene(rectilinearMesh(uniform(3, 3), uniform(3, 3)),
                      {polygonBody(0, {{0, 0}, {far + a, 0}, {far + b, 3}, {0, 3}}),
                       polygonBody(1, {{far + a, 0}, {3, 0}, {3, 3}, {far + b, 3}})},
                      2, {BoundaryKind::SlipWall, BoundaryKind::Outflow, BoundaryKind::Outflow, BoundaryKind::Outflow});
      scene.setInteraction(0, 1, {Interaction::Bonded, 0.0, 0.0, {}});
      scene.setVelocity(
          [shear](int material, Vector2 const &x) {
            return material == 0 ? Vector2{20.0 * V * x[0] * x[1], shear * x[1]} : Vector2{0.0, 0.0};
          });
      ConstraintReport const report = scene.constrain();
      EXPECT_TRUE(report.converged) << report.residual;
      expectMomentumAndEnergy(scene, report);
      EXPECT_GT(report.contact_loss, 0.0);
    }
}

// Slip walls at both ends take 0.4 of the impulse on block 0 and 0.3 of that on block 1: an external impulse of 0.1.
TEST(Constrain, nodeConditions_takeTheirPartAsExternalImpulse)
{
  std::vector<BoundaryKind> kinds(4, BoundaryKind::SlipWall);
  TinyScene scene(rectilinearMesh(uniform(2, 2), uniform(1, 1)), {boxBody(0, 0, 0, 0.6, 1), boxBody(1, 1.3, 0, 2, 1)},
                  2, kinds);
  scene.dt = 1.0;
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : -V, V}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_NEAR(report.external_impulse[0], 0.1 * report.pair_force[1].normal_impulse, 1e-12 * V);
  EXPECT_GT(report.external_impulse[0], 0.001 * V);
  expectMomentumAndEnergy(scene, report);
}

// Sharing dof nodes, the two materials of `single` have nothing to constrain.
TEST(Constrain, singleKinematics_hasNoRows)
{
  TinyScene scene(rectilinearMesh(uniform(2, 2), uniform(1, 1)), {boxBody(0, 0, 0, 0.6, 1), boxBody(1, 0.6, 0, 2, 1)},
                  2, open_box, Kinematics::Single);
  scene.setVelocity([](int, Vector2 const &) { return Vector2{V, V}; });
  EXPECT_EQ(scene.constrain().rows, 0);
}

// Blocks of separate meshes, the right one twice as fine: it is the slave, whatever its number.
TEST(Constrain, separateMeshes_finerSideIsTheSlave)
{
  for (int const fine : {0, 1})
  {
    int const n0 = fine == 0 ? 8 : 4, n1 = fine == 1 ? 8 : 4;
    HostMesh host =
        mappedBlocks({{{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}}, {n0, n0}}, {{{{2, 0}, {4, 0}, {4, 2}, {2, 2}}}, {n1, n1}}})
            .mesh;
    for (auto &f : host.face_boundary)
      f = {-1, -1, -1, -1};
    TinyScene scene(host, {boxBody(0, 0, 0, 2, 2), boxBody(1, 2, 0, 4, 2)}, 2, {}, Kinematics::Lagrangian);
    scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : -V, 0.0}; });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    EXPECT_EQ(report.rows, 16); // two a face
    expectMomentumAndEnergy(scene, report);
  }
}

// Nodes of a block's face that sink into the other block and rise by turns: no midpoint of a face moves, yet it stops.
TEST(Constrain, separateMeshes_zigzagOfAFaceIsStopped)
{
  HostMesh host =
      mappedBlocks({{{{{0, 0}, {2, 0}, {2, 4}, {0, 4}}}, {2, 4}}, {{{{2, 0}, {4, 0}, {4, 4}, {2, 4}}}, {2, 4}}}).mesh;
  for (auto &f : host.face_boundary)
    f = {-1, -1, -1, -1};
  TinyScene scene(host, {boxBody(0, 0, 0, 2, 4), boxBody(1, 2, 0, 4, 4)}, 2, {}, Kinematics::Lagrangian);
  scene.setVelocity(
      [](int material, Vector2 const &x) {
        return Vector2{material == 0 && x[0] == 2.0 ? (static_cast<int>(x[1]) % 2 == 0 ? V : -V) : 0.0, 0.0};
      });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  expectMomentumAndEnergy(scene, report);
  auto const half = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.half);
  double approach[5] = {};
  scene.forEachDof(
      [&](int dof, int material, Vector2 const &x)
      {
        if (x[0] == 2.0)
          approach[static_cast<int>(x[1])] += (material == 0 ? 1.0 : -1.0) * half(dof, 0);
      });
  for (int i = 0; i < 4; ++i)
  {
    double const near = 0.5 + std::sqrt(1.0 / 12.0), far = 1.0 - near; // Gauss points
    EXPECT_LE(near * approach[i] + far * approach[i + 1], 1e-9 * V);
    EXPECT_LE(far * approach[i] + near * approach[i + 1], 1e-9 * V);
  }
}

// When the iterations run out, the report says so, and momentum holds all the same.
TEST(Constrain, tooFewIterations_areReported)
{
  for (MultiplierMethod const solver :
       {MultiplierMethod::ProjectedNewton, MultiplierMethod::ConjugateGradients, MultiplierMethod::RowSums})
  {
    TinyScene scene = twoBlocks(0.3, 0.0, 12);
    scene.options.solver = solver;
    scene.options.max_iterations = 1;
    // The blocks meet here and part there: which rows part is not known beforehand.
    scene.setVelocity(
        [](int material, Vector2 const &x) {
          return Vector2{(material == 0 ? V : -V) * std::sin(1.7 * x[1]), 0.0};
        });
    ConstraintReport const report = scene.constrain();
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.iterations, 1);
    EXPECT_GT(report.residual, scene.options.tolerance);
    auto const before = scene.sums(scene.predicted, -2), after = scene.sums(scene.half, -2);
    EXPECT_NEAR(norm(after.momentum - before.momentum), 0.0, 1e-12 * V * before.mass);
  }
}

// H by the inverse row sums of A settles, by the inverse diagonal it does not: p <- max(0, p - H (A p + b)) needs
// eigenvalues of H A below two, and neighbouring rows move each other nearly as much as themselves.
TEST(Constrain, diagonalOfTheOperator_isNoStepForTheMultipliers)
{
  TinyScene scene(rectilinearMesh(uniform(12, 12), uniform(12, 12)),
                  {polygonBody(0, {{0, 0}, {4.2, 0}, {7.9, 12}, {0, 12}}),
                   polygonBody(1, {{4.2, 0}, {12, 0}, {12, 12}, {7.9, 12}})},
                  2, open_box, Kinematics::Xfem, {2.0, 3.0});
  BodyTable const none = buildBodyTable({}, 2);
  ContactRows const rows = findContactRows(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions,
                                           none, {}, scene.options, *scene.exchange);
  Motion const at_rest{scene.velocity_n, none};
  ContactSystem const system = buildContactSystem(scene.mesh, scene.pairs, rows, scene.dof_nodes, scene.conditions,
                                                  scene.dof_mass, at_rest, at_rest, {}, scene.dt, RowScale::Sums);
  DualProblem const problem =
      assembleDualProblem(scene.mesh, system, rows, Placement::Midpoint, {}, *scene.exchange, {}).rows;
  ASSERT_GT(problem.size(), 12);
  std::vector<double> diagonal(problem.b.size());
  for (int i = 0; i < problem.size(); ++i)
    for (int e = problem.matrix.offset[i]; e < problem.matrix.offset[i + 1]; ++e)
      if (problem.matrix.column[e] == i)
        diagonal[i] = problem.matrix.value[e];
  for (bool const by_diagonal : {false, true})
  {
    std::vector<double> x(problem.b.size(), 1.0), image;
    double largest = 0.0;
    for (int k = 0; k < 400; ++k)
    {
      problem.matrix.multiply(x, image);
      double size = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        image[i] /= by_diagonal ? diagonal[i] : 1.0; // A is scaled by its row sums
        size = std::max(size, std::fabs(image[i]));
      }
      largest = size;
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = image[i] / size;
    }
    if (by_diagonal)
      EXPECT_GT(largest, 2.1);
    else
      EXPECT_LE(largest, 1.0 + 1e-12);
  }
}

// Action is reaction: what an impulse gives one side it takes from the other, whatever it is found by.
TEST(Constrain, momentumIsKeptToRoundOff_whateverActs)
{
  for (ConstraintMethod const method :
       {ConstraintMethod::Multipliers, ConstraintMethod::Penalty, ConstraintMethod::Nodal, ConstraintMethod::Merged})
    for (Placement const placement : {Placement::Midpoint, Placement::GaussPoints, Placement::SegmentEnds,
                                      Placement::VitalVertices, Placement::Mortar})
    {
      if (method != ConstraintMethod::Multipliers && placement != Placement::Midpoint)
        continue;
      TinyScene scene(rectilinearMesh(uniform(12, 12), uniform(12, 12)),
                      {polygonBody(0, {{0, 0}, {4.2, 0}, {7.9, 12}, {0, 12}}),
                       polygonBody(1, {{4.2, 0}, {12, 0}, {12, 12}, {7.9, 12}})},
                      2, open_box, Kinematics::Xfem, {2.0, 3.0});
      scene.options.method = method;
      scene.options.placement = placement;
      scene.options.impedance = deviceCopy("impedance", std::vector<double>{2.0e3, 3.0e3});
      scene.setVelocity(
          [](int material, Vector2 const &x) {
            return Vector2{(material == 0 ? 60.0 : -40.0) * std::cos(0.4 * x[1]), 10.0 * std::sin(x[0])};
          });
      scene.constrain();
      auto const before = scene.sums(scene.predicted, 0), after = scene.sums(scene.half, 0);
      auto const whole_before = scene.sums(scene.predicted, -2), whole_after = scene.sums(scene.half, -2);
      double const exchanged = norm(after.momentum - before.momentum);
      EXPECT_GT(exchanged, 1.0);
      EXPECT_LE(norm(whole_after.momentum - whole_before.momentum), 1e-14 * exchanged);
    }
}
