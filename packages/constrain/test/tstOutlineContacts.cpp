// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <Harmos_OutlineContacts.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace HarmosTest;

namespace
{

/// The gaps of shape a's features on shape b.
std::vector<OutlineGap> gaps(Shape const &a, Shape const &b, double reach = 1.0, bool circles = true)
{
  std::vector<OutlineGap> all;
  for (OutlinePlace const &place : outlinePlaces(a, b, reach, circles))
    all.push_back(outlineGap(a, b, place));
  return all;
}

void expectGap(OutlineGap const &g, double gap, Vector2 const &normal, Vector2 const &point)
{
  EXPECT_NEAR(g.gap, gap, 1e-14);
  for (int d = 0; d < 2; ++d)
  {
    EXPECT_NEAR(g.normal[d], normal[d], 1e-14);
    EXPECT_NEAR(g.point[d], point[d], 1e-14);
  }
}

Shape const floor_at_zero = Shape::halfPlane({3.0, 0.0}, {0.0, 2.0});
Shape const box = Shape::rectangle({0.0, 0.0}, {2.0, 1.0});

} // namespace

TEST(OutlineContacts, discOnStraightEdges_hasOneAtItsLowestPoint)
{
  for (Shape const &ground : {floor_at_zero, Shape::rectangle({0.0, -1.0}, {8.0, 2.0})})
  {
    auto const g = gaps(Shape::disc({0.3, 0.7}, 0.6), ground);
    ASSERT_EQ(g.size(), 1u);
    expectGap(g[0], 0.1, {0.0, -1.0}, {0.3, 0.1});
  }
  EXPECT_TRUE(gaps(Shape::disc({0.3, 1.7}, 0.6), floor_at_zero).empty()); // out of reach
}

TEST(OutlineContacts, discBeforeACorner_hasItsPointTowardsIt)
{
  auto const g = gaps(Shape::disc({1.3, 0.9}, 0.4), box);
  ASSERT_EQ(g.size(), 1u);
  expectGap(g[0], 0.1, {-0.6, -0.8}, {1.06, 0.58});
}

TEST(OutlineContacts, circlesMeetOnTheLineOfCentres_onceForBoth)
{
  Shape const a = Shape::disc({0.0, 0.0}, 1.0), b = Shape::disc({1.8, 2.4}, 1.75);
  auto const g = gaps(a, b);
  ASSERT_EQ(g.size(), 1u);
  expectGap(g[0], 0.25, {0.6, 0.8}, {0.6, 0.8});
  EXPECT_TRUE(gaps(b, a, 1.0, false).empty());
}

TEST(OutlineContacts, discInAHole_touchesAtTheNearestPointAndWhereItFillsTheHoleAllAround)
{
  Shape const ring = Shape::annulus({0.0, 0.0}, 2.0, 3.0);
  auto const small = gaps(Shape::disc({0.6, 0.8}, 0.9), ring, 0.2);
  ASSERT_GE(small.size(), 1u);
  expectGap(small[0], 0.1, {0.6, 0.8}, {1.14, 1.52});
  auto const pin = gaps(Shape::disc({0.0, 0.0}, 2.0), ring, 0.2);
  EXPECT_EQ(pin.size(), 7u);
  for (OutlineGap const &g : pin)
    EXPECT_NEAR(g.gap, 0.0, 1e-14);
  EXPECT_TRUE(gaps(ring, Shape::disc({0.6, 0.8}, 0.9), 0.2).empty());
}

TEST(OutlineContacts, boxOnTheFloor_standsOnItsTwoLowerCorners)
{
  auto const g = gaps(box.moved({0.0, 0.5}, 0.0), floor_at_zero, 0.5);
  ASSERT_EQ(g.size(), 2u);
  expectGap(g[0], 0.0, {0.0, -1.0}, {-1.0, 0.0});
  expectGap(g[1], 0.0, {0.0, -1.0}, {1.0, 0.0});
}

// The upper box's right corners lie on the line of the lower box's right side, which must not hold it.
TEST(OutlineContacts, boxesStackedFlush_pressAcrossTheirCommonSideOnly)
{
  Shape const upper = box.moved({0.0, 1.0}, 0.0);
  for (bool const swapped : {false, true})
  {
    auto const g = swapped ? gaps(box, upper, 0.3) : gaps(upper, box, 0.3);
    ASSERT_EQ(g.size(), 2u);
    for (OutlineGap const &one : g)
    {
      EXPECT_NEAR(one.normal[0], 0.0, 1e-15);
      EXPECT_NEAR(one.gap, 0.0, 1e-15);
    }
  }
}

TEST(OutlineContacts, cornerInAGroove_touchesBothOfItsSides)
{
  Shape const groove = Shape::polygon({{-2.0, -1.0}, {2.0, -1.0}, {2.0, 2.0}, {0.0, 0.0}, {-2.0, 2.0}});
  EXPECT_EQ(gaps(Shape::polygon({{0.0, 0.0}, {0.5, 1.0}, {-0.5, 1.0}}), groove, 0.3).size(), 2u);
  EXPECT_EQ(gaps(Shape::disc({0.0, std::sqrt(0.5)}, 0.5), groove, 0.3).size(), 2u);
}

TEST(OutlineContacts, cornerAHairWithinAThinPlate_belongsToTheNearerSide)
{
  Shape const plate = Shape::rectangle({0.0, 0.0}, {4.0, 0.1});
  auto const g = gaps(Shape::polygon({{0.0, 0.049}, {1.0, 1.0}, {-1.0, 1.0}}), plate, 0.5);
  ASSERT_EQ(g.size(), 1u);
  expectGap(g[0], -0.001, {0.0, -1.0}, {0.0, 0.049});
}

namespace
{

/// A free disc of radius one above the floor y = 1 of an 8 x 8 mesh, with another body.
TinyScene discScene(Vector2 const &centre, Vector2 const &velocity, double spin)
{
  TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(8, 8)), {boxBody(0, 0, 0, 8, 1), boxBody(1, 2, 1.5, 4, 3)}, 2,
                  std::vector<BoundaryKind>(4, BoundaryKind::Outflow));
  RigidBody ground, disc;
  ground.material = 0;
  disc.material = 1;
  disc.motion = RigidMotion::Free;
  disc.mass = 2.0;
  disc.inertia = 1.0; // m R^2 / 2
  disc.centre = centre;
  disc.velocity = velocity;
  disc.angular_velocity = spin;
  scene.bodies_n = {ground, disc};
  scene.outline = {Shape::halfPlane({0.0, 1.0}, {0.0, 1.0}), Shape::disc(centre, 1.0)};
  return scene;
}

} // namespace

// A plastic impact with friction enough: rolls on with 2/3 v - 1/3 omega R.
TEST(OutlineRows, discThatStrikesTheFloor_rollsOnWithItsMomentOfMomentumAboutThePoint)
{
  TinyScene scene = discScene({3.0, 2.0}, {3.0, -50.0}, 6.0);
  PairInteraction rough;
  rough.kind = Interaction::Friction;
  rough.friction = 0.5;
  scene.setInteraction(0, 1, rough);
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.rows, 2);
  RigidBody const &disc = scene.bodies[1];
  EXPECT_NEAR(disc.velocity[0], 2.0 - 2.0, 1e-11);
  EXPECT_NEAR(disc.velocity[1], 0.0, 1e-11);
  EXPECT_NEAR(disc.angular_velocity, 0.0, 1e-11);
  EXPECT_NEAR(report.body_impulse[1][1], 100.0, 1e-10);
}

TEST(OutlineRows, discAboveTheFloor_fallsThroughItsGapAndNoFarther)
{
  TinyScene scene = discScene({3.0, 2.1}, {3.0, -200.0}, 6.0);
  EXPECT_EQ(scene.constrain().rows, 1);
  EXPECT_NEAR(scene.bodies[1].velocity[1], -0.1 / scene.dt, 1e-9);
  EXPECT_EQ(scene.bodies[1].velocity[0], 3.0);
  EXPECT_EQ(scene.bodies[1].angular_velocity, 6.0);
}

// The tangent would leave the ring by (v dt)^2 / 2d.
TEST(OutlineRows, discInARing_staysOnItsCircle)
{
  TinyScene scene = discScene({4.0, 2.5}, {100.0, 0.0}, 0.0);
  scene.outline[0] = Shape::annulus({4.0, 4.0}, 2.5, 4.0);
  EXPECT_GE(scene.constrain().rows, 1);
  Vector2 const end = scene.bodies[1].centre + scene.dt * scene.bodies[1].velocity - Vector2{4.0, 4.0};
  EXPECT_NEAR(norm(end), 1.5, 1e-5); // 3e-3 along the tangent
  EXPECT_GT(scene.bodies[1].velocity[1], 3.0);
}

TEST(OutlineRows, discOnAContactWall_hasOneRow)
{
  TinyScene scene = discScene({3.25, 1.0}, {0.0, -50.0}, 6.0);
  View<Boundary *> const boundary = scene.conditions.boundary;
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), boundary);
  host(2).kind = BoundaryKind::ContactWall;
  Kokkos::deep_copy(boundary, host);
  scene.outline[0] = Shape::halfPlane({0.0, 7.9}, {0.0, -1.0});
  ConstraintReport const report = scene.constrain();
  EXPECT_EQ(report.rows, 1);
  EXPECT_NEAR(scene.bodies[1].velocity[1], 0.0, 1e-11);
  EXPECT_EQ(scene.bodies[1].angular_velocity, 6.0);
  EXPECT_NEAR(report.external_impulse[1], 100.0, 1e-10);
}

// What is bonded keeps the rows of its segments.
TEST(OutlineRows, bondedBodies_moveAsOne)
{
  TinyScene scene = discScene({3.0, 2.0}, {3.0, 0.0}, 6.0);
  PairInteraction bond;
  bond.kind = Interaction::Bonded;
  scene.setInteraction(0, 1, bond);
  scene.constrain();
  scene.outline.clear();
  double const spin = scene.bodies[1].angular_velocity;
  scene.constrain();
  EXPECT_EQ(scene.bodies[1].angular_velocity, spin);
}

// Rows that share multipliers: these have their own.
TEST(OutlineRows, mortarPlacement_holdsTheDiscAsWell)
{
  TinyScene scene = discScene({3.0, 2.0}, {3.0, -50.0}, 6.0);
  scene.options.placement = Placement::Mortar;
  EXPECT_TRUE(scene.constrain().converged);
  EXPECT_NEAR(scene.bodies[1].velocity[1], 0.0, 1e-11);
}
