// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <gtest/gtest.h>

using namespace HarmosTest;

namespace
{

constexpr double V = 100.0;

RigidBody rigid(int material, RigidMotion motion, double mass, double inertia, Vector2 const &centre, Vector2 const &v)
{
  RigidBody b;
  b.material = material;
  b.motion = motion;
  b.mass = mass;
  b.inertia = inertia;
  b.centre = centre;
  b.velocity = v;
  return b;
}

struct Balance
{
  Vector2 momentum;
  double kinetic;
};

Balance moving(TinyScene const &scene, View<double *[2]> const &velocity, std::vector<RigidBody> const &bodies)
{
  auto const s = scene.sums(velocity, -2);
  Balance sum{s.momentum, s.kinetic};
  for (RigidBody const &b : bodies)
    if (b.motion == RigidMotion::Free)
    {
      sum.momentum += b.mass * b.velocity;
      sum.kinetic += 0.5 * (b.mass * dot(b.velocity, b.velocity) + b.inertia * b.angular_velocity * b.angular_velocity);
    }
  return sum;
}

void expectBalance(TinyScene const &scene, ConstraintReport const &report)
{
  Balance const before = moving(scene, scene.velocity_n, scene.bodies_n),
                after = moving(scene, scene.half, scene.bodies);
  double const scale = 1e-13 * V * 60.0;
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d] - before.momentum[d], report.external_impulse[d], scale);
  EXPECT_NEAR(after.kinetic - before.kinetic, report.driven_work - report.contact_loss, scale * V);
  EXPECT_GE(report.contact_loss, -scale * V);
}

// Deformable block 0 in the strip's left part, rigid block 1 right of x.
TinyScene strip(double x, RigidBody const &body)
{
  TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(4, 4)), {boxBody(0, 0, 0, x, 4), boxBody(1, x, 0, 7, 4)}, 2,
                  open_box);
  scene.bodies_n = {body};
  return scene;
}

} // namespace

TEST(ConstrainBodies, freeRigidBodyHitInTheMiddle_takesTheMomentumWithoutTurning)
{
  for (double const x : {4.4, 4.0})
  {
    TinyScene scene = strip(x, rigid(1, RigidMotion::Free, 20.0, 30.0, {5.5, 2.0}, {0.0, 0.0}));
    scene.setVelocity([](int, Vector2 const &) { return Vector2{V, 0.0}; });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    EXPECT_LT(report.iterations, 60);
    EXPECT_GT(scene.bodies[0].velocity[0], 0.0);
    EXPECT_NEAR(scene.bodies[0].velocity[1], 0.0, 1e-12 * V);
    EXPECT_NEAR(scene.bodies[0].angular_velocity, 0.0, 1e-9 * V);
    EXPECT_NEAR(report.body_impulse[0][0], 20.0 * scene.bodies[0].velocity[0], 1e-10 * V);
    expectBalance(scene, report);
  }
}

TEST(ConstrainBodies, freeRigidBodyHitOffItsCentre_turns)
{
  TinyScene scene = strip(4.4, rigid(1, RigidMotion::Free, 20.0, 30.0, {5.5, 3.5}, {-V, 0.0}));
  scene.setVelocity([](int, Vector2 const &) { return Vector2{V, 0.0}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_LT(report.iterations, 100);
  EXPECT_GT(scene.bodies[0].angular_velocity, 0.1);
  EXPECT_NEAR(report.body_torque[0], 30.0 * scene.bodies[0].angular_velocity, 1e-10 * V);
  expectBalance(scene, report);
}

// A very light and a very heavy body: the block preconditioner must not mind.
TEST(ConstrainBodies, anyMassOfTheBody_convergesInTheSameIterations)
{
  for (double const mass : {1e-4, 1.0, 1e6})
  {
    TinyScene scene = strip(4.4, rigid(1, RigidMotion::Free, mass, mass, {5.5, 2.5}, {0.0, 0.0}));
    scene.setVelocity([](int, Vector2 const &) { return Vector2{V, 0.0}; });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    EXPECT_LT(report.iterations, 100) << mass;
  }
}

TEST(ConstrainBodies, fixedBody_stopsTheBlockAndTakesExternalImpulse)
{
  TinyScene scene = strip(4.4, rigid(1, RigidMotion::Fixed, 0, 0, {5.5, 2.0}, {0.0, 0.0}));
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : 0.0, 0.0}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_LT(report.external_impulse[0], -0.1 * V);
  EXPECT_EQ(report.driven_work, 0.0);
  EXPECT_NEAR(report.body_impulse[0][0], -report.external_impulse[0], 1e-12 * V);
  expectBalance(scene, report);
  auto const s = scene.sums(scene.half, 1);
  EXPECT_EQ(s.least, 0.0);
  EXPECT_EQ(s.most, 0.0);
}

TEST(ConstrainBodies, prescribedBody_doesItsWorkOnTheBlock)
{
  TinyScene scene = strip(4.4, rigid(1, RigidMotion::Prescribed, 0, 0, {5.5, 2.0}, {-V, 0.0}));
  scene.setVelocity([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_NEAR(report.driven_work, -V * report.external_impulse[0], 1e-10 * V * V);
  EXPECT_GT(report.driven_work, 0.0);
  expectBalance(scene, report);
  EXPECT_EQ(scene.sums(scene.half, 1).least, -V); // rigid dof nodes move with their body
}

// A film in the first cells of a wall, a driven body before it: its free nodes would have to move at V over its
// thickness.
TEST(ConstrainBodies, filmBetweenADrivenBodyAndAWall_isNotAskedForMoreThanItsNodesReach)
{
  for (double const film : {1e-5, 0.2})
  {
    TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(4, 4)),
                    {boxBody(0, 0, 0, film, 4), boxBody(1, film, 0, 7, 4)}, 2,
                    {BoundaryKind::Fixed, BoundaryKind::Outflow, BoundaryKind::Outflow, BoundaryKind::Outflow});
    scene.bodies_n = {rigid(1, RigidMotion::Prescribed, 0, 0, {3.5, 2.0}, {-V, 0.0})};
    scene.setVelocity([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    EXPECT_EQ(report.rows, 4);
    EXPECT_NEAR(scene.sums(scene.half, 0).least, film < 1e-3 ? 0.0 : -V / film, 1e-6 * V);
    expectBalance(scene, report);
  }
}

TEST(ConstrainBodies, drivenBodiesAmongThemselves_haveNoRows)
{
  TinyScene scene = strip(4.4, rigid(1, RigidMotion::Prescribed, 0, 0, {5.5, 2.0}, {-V, 0.0}));
  scene.bodies_n.push_back(rigid(0, RigidMotion::Fixed, 0, 0, {0.0, 0.0}, {0.0, 0.0}));
  scene.setVelocity([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
  EXPECT_EQ(scene.constrain().rows, 0);
}

// Two free bodies: a perfectly plastic central impact.
TEST(ConstrainBodies, twoFreeBodies_impactPerfectlyPlastic)
{
  TinyScene scene = strip(4.4, rigid(1, RigidMotion::Free, 2.0, 5.0, {5.5, 2.0}, {-V, 0.0}));
  scene.bodies_n.push_back(rigid(0, RigidMotion::Free, 3.0, 7.0, {2.0, 2.0}, {V, 3.0}));
  scene.setVelocity([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_NEAR(scene.bodies[0].velocity[0], 0.2 * V, 1e-9 * V);
  EXPECT_NEAR(scene.bodies[1].velocity[0], 0.2 * V, 1e-9 * V);
  EXPECT_NEAR(scene.bodies[1].velocity[1], 3.0, 1e-12);
  expectBalance(scene, report);
}

TEST(ConstrainBodies, contactWall_stopsWhatComesAndLetsGoWhatLeaves)
{
  std::vector<BoundaryKind> kinds = open_box;
  kinds[2] = BoundaryKind::ContactWall;
  for (double const bottom : {0.0, 0.25})
    for (double const sign : {-1.0, 1.0})
    {
      TinyScene scene(rectilinearMesh(uniform(4, 4), uniform(4, 4)), {boxBody(0, 1, bottom, 3, 3)}, 1, kinds);
      scene.dt = 0.4 / V;
      scene.setVelocity([sign](int, Vector2 const &) { return Vector2{V, sign * V}; });
      ConstraintReport const report = scene.constrain();
      EXPECT_TRUE(report.converged) << report.residual;
      EXPECT_EQ(report.rows, 2);
      expectBalance(scene, report);
      if (sign > 0.0)
      {
        EXPECT_EQ(report.pair_force[1].normal_impulse, 0.0);
        EXPECT_EQ(report.external_impulse[1], 0.0);
      }
      else
      {
        EXPECT_GT(report.external_impulse[1], 0.01 * V);
        EXPECT_EQ(report.external_impulse[0], 0.0); // no friction
        EXPECT_EQ(report.pair_force[1].impulse[1], report.external_impulse[1]);
      }
    }
}
