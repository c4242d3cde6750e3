// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_PrescribedField.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace Harmos;

namespace
{

std::vector<PrescribedField> allFields(double period)
{
  std::vector<PrescribedField> fields(4);
  FieldKind const kinds[4] = {FieldKind::Translation, FieldKind::Rotation, FieldKind::Vortex, FieldKind::Deformation};
  for (int i = 0; i < 4; ++i)
  {
    fields[i].kind = kinds[i];
    fields[i].period = period;
    fields[i].velocity = {0.3, -0.2};
    fields[i].centre = {0.4, 0.6};
    fields[i].angular_velocity = 1.5;
    fields[i].speed = 0.7;
    fields[i].corner = {-0.5, 0.25};
    fields[i].length = 2.0;
  }
  return fields;
}

/// Points all over a box that is not that of the fields.
template <class Visit>
void forPoints(Visit const &visit)
{
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j)
      visit(Vector2{-0.3 + 0.07 * i, 0.1 + 0.09 * j});
}

} // namespace

TEST(PrescribedField, everyField_isFreeOfDivergence)
{
  double const h = 1e-5;
  for (PrescribedField const &f : allFields(3.0))
    forPoints(
        [&](Vector2 const &x)
        {
          double const t = 0.4;
          double const ux = f.velocityAt({x[0] + h, x[1]}, t)[0] - f.velocityAt({x[0] - h, x[1]}, t)[0];
          double const vy = f.velocityAt({x[0], x[1] + h}, t)[1] - f.velocityAt({x[0], x[1] - h}, t)[1];
          EXPECT_NEAR((ux + vy) / (2.0 * h), 0.0, 1e-7);
        });
}

TEST(PrescribedField, vortex_isTheCurlOfItsStreamFunctionAndRestsOnItsBox)
{
  PrescribedField const f = allFields(0.0)[2];
  auto const psi = [&](Vector2 const &x)
  {
    double const a = Math::sin(Math::pi * (x[0] - f.corner[0]) / f.length);
    double const b = Math::sin(Math::pi * (x[1] - f.corner[1]) / f.length);
    return f.speed * f.length / Math::pi * a * a * b * b;
  };
  double const h = 1e-5;
  forPoints(
      [&](Vector2 const &x)
      {
        Vector2 const v = f.velocityAt(x, 0.0);
        EXPECT_NEAR(v[0], -(psi({x[0], x[1] + h}) - psi({x[0], x[1] - h})) / (2.0 * h), 1e-8);
        EXPECT_NEAR(v[1], (psi({x[0] + h, x[1]}) - psi({x[0] - h, x[1]})) / (2.0 * h), 1e-8);
      });
  for (double const s : {0.1, 0.8, 1.9})
  {
    EXPECT_NEAR(norm(f.velocityAt({-0.5, 0.25 + s}, 0.0)), 0.0, 1e-15);
    EXPECT_NEAR(norm(f.velocityAt({-0.5 + s, 2.25}, 0.0)), 0.0, 1e-15);
  }
}

TEST(PrescribedField, largestSpeed_isABoundThatIsReached)
{
  for (PrescribedField const &f : allFields(0.0))
  {
    double largest = 0.0;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j)
        largest = Math::max(largest, norm(f.velocityAt({-0.5 + 0.01 * i, 0.25 + 0.01 * j}, 0.0)));
    double const bound = f.largestSpeed({-0.5, 0.25}, {1.5, 2.25});
    EXPECT_LE(largest, bound * (1.0 + 1e-14));
    EXPECT_GE(largest, bound * 0.999);
  }
}

TEST(PrescribedField, displacement_isOfFourthOrderAlongTheTrajectory)
{
  for (PrescribedField const &f : allFields(3.0))
  {
    Vector2 const start{0.31, 0.77};
    auto const end = [&](int steps)
    {
      Vector2 x = start;
      for (int i = 0; i < steps; ++i)
        x += f.displacement(x, 0.2 + i * 0.8 / steps, 0.8 / steps);
      return x;
    };
    Vector2 const exact = end(2000);
    double const coarse = norm(end(8) - exact), fine = norm(end(16) - exact);
    EXPECT_LT(fine, 1e-5);
    // A translation is the integral of a cosine: Simpson's rule.
    EXPECT_GT(coarse, 14.0 * fine);
  }
}

TEST(PrescribedField, fieldWithAPeriod_bringsEveryPointBack)
{
  for (PrescribedField const &f : allFields(2.0))
    forPoints(
        [&](Vector2 const &start)
        {
          Vector2 x = start;
          for (int i = 0; i < 200; ++i)
            x += f.displacement(x, 0.01 * i, 0.01);
          EXPECT_NEAR(norm(x - start), 0.0, 1e-8);
        });
}

TEST(PrescribedField, carriedPose_followsRigidMotionAndKnowsTheReturnOfTheOthers)
{
  std::vector<PrescribedField> const fields = allFields(2.0);
  Vector2 const centroid{0.7, 0.2};
  double const t = 0.6;
  for (int i = 0; i < 2; ++i)
  {
    // The centroid, and a point beside it that the angle carries along.
    Vector2 x[2] = {centroid, centroid + Vector2{0.1, 0.0}};
    for (int k = 0; k < 2; ++k)
      for (int step = 0; step < 600; ++step)
        x[k] += fields[i].displacement(x[k], 0.001 * step, 0.001);
    CarriedPose const pose = carriedPose(fields[i], centroid, t);
    EXPECT_TRUE(pose.known);
    EXPECT_NEAR(norm(centroid + pose.displacement - x[0]), 0.0, 1e-11);
    Vector2 const arm{0.1 * Math::cos(pose.angle), 0.1 * Math::sin(pose.angle)};
    EXPECT_NEAR(norm(centroid + pose.displacement + arm - x[1]), 0.0, 1e-11);
  }
  for (int i = 2; i < 4; ++i)
  {
    EXPECT_FALSE(carriedPose(fields[i], centroid, t).known);
    EXPECT_TRUE(carriedPose(fields[i], centroid, 2.0).known);
    EXPECT_TRUE(carriedPose(fields[i], centroid, 6.0).known);
    EXPECT_FALSE(carriedPose(allFields(0.0)[i], centroid, 2.0).known);
  }
}
