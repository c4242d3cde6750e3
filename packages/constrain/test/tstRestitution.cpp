// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <gtest/gtest.h>

using namespace HarmosTest;

namespace
{

constexpr double V = 100.0; // closing speed of each side

PairInteraction bouncing(double restitution, double friction = 0.0)
{
  PairInteraction law;
  law.kind = friction > 0.0 ? Interaction::Friction : Interaction::Sliding;
  law.friction = friction;
  law.restitution = restitution;
  return law;
}

/// Two blocks of unequal density in a box of cells; their interface runs from (x0, 0) to (x1, 4).
TinyScene blocks(double x0, double x1, PairInteraction const &law, double gap = 0.0)
{
  TinyScene scene(rectilinearMesh(uniform(10, 10), uniform(4, 4)),
                  {polygonBody(0, {{0, 0}, {x0, 0}, {x1, 4}, {0, 4}}),
                   polygonBody(1, {{x0 + gap, 0}, {10, 0}, {10, 4}, {x1 + gap, 4}})},
                  2, open_box, Kinematics::Xfem, {2.0, 3.0});
  scene.setInteraction(0, 1, law);
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : -V, 0.0}; });
  return scene;
}

double loss(TinyScene const &scene)
{
  return scene.sums(scene.velocity_n, -2).kinetic - scene.sums(scene.half, -2).kinetic;
}

RigidBody rigidSquare(int material, RigidMotion motion, Vector2 const &centre, Vector2 const &velocity)
{
  RigidBody body;
  body.material = material;
  body.motion = motion;
  body.mass = 5.0;
  body.inertia = 3.0;
  body.centre = centre;
  body.velocity = velocity;
  return body;
}

} // namespace

// Newton's law of impact: (1 - e^2) of the energy that a plastic impact takes; none for e = 1, at any angle, with
// friction that nothing drives, too.
TEST(Restitution, blocksThatMeet_loseNoEnergyWithOne_andOneMinusItsSquareWithLess)
{
  for (double const x1 : {5.3, 4.1})
  {
    TinyScene plastic = blocks(5.3, x1, bouncing(0.0));
    plastic.constrain();
    double const most = loss(plastic);
    EXPECT_GT(most, 0.0);
    for (double const e : {0.3, 0.5, 1.0})
    {
      TinyScene scene = blocks(5.3, x1, bouncing(e));
      ConstraintReport const report = scene.constrain();
      EXPECT_TRUE(report.converged) << report.residual;
      EXPECT_NEAR(loss(scene), (1.0 - e * e) * most, 1e-9 * most);
      EXPECT_NEAR(report.contact_loss, loss(scene), 1e-10 * most);
      auto const before = scene.sums(scene.velocity_n, -2), after = scene.sums(scene.half, -2);
      EXPECT_NEAR(norm(after.momentum - before.momentum), 0.0, 1e-12 * V * before.mass);
    }
  }
}

TEST(Restitution, freeRigidBodyOnAFixedOne_partsWithItsPartOfTheSpeed)
{
  for (double const e : {0.0, 0.5, 1.0})
  {
    TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(4, 4)), {boxBody(0, 1, 1, 4.4, 3), boxBody(1, 4.4, 0, 8, 4)},
                    2, open_box);
    scene.setInteraction(0, 1, bouncing(e));
    scene.bodies_n = {rigidSquare(0, RigidMotion::Free, {2.7, 2.0}, {V, 7.0}),
                      rigidSquare(1, RigidMotion::Fixed, {6.2, 2.0}, {0.0, 0.0})};
    scene.setVelocity([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    EXPECT_NEAR(scene.bodies[0].velocity[0], -e * V, 1e-10 * V);
    EXPECT_EQ(scene.bodies[0].velocity[1], 7.0);
    EXPECT_NEAR(report.contact_loss, 0.5 * 5.0 * V * V * (1.0 - e * e), 1e-10 * V * V);
  }
}

// Bodies that rest on each other and are pressed together, and those that part, feel no restitution.
TEST(Restitution, bodiesInLastingContact_feelNoDifference)
{
  std::vector<double> impulse;
  for (double const e : {0.0, 1.0})
  {
    TinyScene scene = blocks(5.3, 4.1, bouncing(e, 0.2));
    Kokkos::deep_copy(scene.velocity_n, 0.0); // at rest, with forces that close it
    impulse.push_back(scene.constrain().pair_force[1].normal_impulse);
  }
  EXPECT_GT(impulse[0], 0.0);
  EXPECT_EQ(impulse[0], impulse[1]);
  TinyScene parting = blocks(5.3, 4.1, bouncing(1.0));
  parting.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? -V : V, 0.0}; });
  EXPECT_EQ(parting.constrain().pair_force[1].normal_impulse, 0.0);
}

// A gap that this step does not close is not felt; one that it would close reverses the approach.
TEST(Restitution, openGap_isFeltWhenTheStepWouldCloseIt)
{
  double const travel = 2.0 * V * 1e-3;
  for (double const gap : {1.01 * travel, 0.99 * travel})
  {
    TinyScene scene = blocks(5.3, 5.3, bouncing(1.0), gap);
    ConstraintReport const report = scene.constrain();
    EXPECT_EQ(report.pair_force[1].normal_impulse > 0.0, gap < travel);
    EXPECT_NEAR(loss(scene), 0.0, 1e-9 * scene.sums(scene.velocity_n, -2).kinetic);
  }
}
