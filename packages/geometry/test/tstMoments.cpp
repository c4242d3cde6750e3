// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <gtest/gtest.h>

using namespace Harmos;

TEST(Moments, rectangle_matchesTheProductOfIntegrals)
{
  Quadrilateral const q = box(1.0, -2.0, 3.0, 1.0);
  Moments<2> const m = moments<2>(q, Vector2{0.0, 0.0});
  EXPECT_DOUBLE_EQ(6.0, m.volume());
  EXPECT_DOUBLE_EQ(12.0, m.first(0));
  EXPECT_DOUBLE_EQ(-3.0, m.first(1));
  EXPECT_DOUBLE_EQ(26.0, m.second(0, 0)); // (27 - 1) / 3 * 3
  EXPECT_DOUBLE_EQ(-6.0, m.second(0, 1)); // 4 * (1 - 4) / 2
  EXPECT_DOUBLE_EQ(-6.0, m.second(1, 0));
  EXPECT_DOUBLE_EQ(6.0, m.second(1, 1)); // 2 * (1 + 8) / 3
}

TEST(Moments, triangle_matchesTheClosedForm)
{
  // Unit right triangle: integral of x^p y^q = p! q! / (p + q + 2)!.
  Polygon<3> const t{3, {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};
  Moments<2> const m = moments<2>(t, Vector2{0.0, 0.0});
  EXPECT_DOUBLE_EQ(1.0 / 2.0, m.value[0]);
  EXPECT_DOUBLE_EQ(1.0 / 6.0, m.value[1]);
  EXPECT_DOUBLE_EQ(1.0 / 6.0, m.value[2]);
  EXPECT_DOUBLE_EQ(1.0 / 12.0, m.value[3]);
  EXPECT_DOUBLE_EQ(1.0 / 24.0, m.value[4]);
  EXPECT_DOUBLE_EQ(1.0 / 12.0, m.value[5]);
}

TEST(Moments, regularPolygon_hasTheClosedFormInertia)
{
  int const n = 12;
  double const step = 2.0 * Math::pi / n;
  Region p;
  for (int i = 0; i < n; ++i)
    p.push({2.0 + Math::cos(i * step), 3.0 + Math::sin(i * step)});
  Moments<2> const m = moments<2>(p, Vector2{2.0, 3.0});
  double const expected_area = 0.5 * n * Math::sin(step);
  EXPECT_NEAR(expected_area, m.volume(), 1e-14);
  EXPECT_NEAR(0.0, m.first(0), 1e-15);
  EXPECT_NEAR(0.0, m.second(0, 1), 1e-15);
  // Polar moment A (2 + cos(2 pi / n)) / 6 of the circumradius 1, half of it in each direction.
  EXPECT_NEAR(expected_area * (2.0 + Math::cos(step)) / 12.0, m.second(0, 0), 1e-14);
  EXPECT_NEAR(expected_area * (2.0 + Math::cos(step)) / 12.0, m.second(1, 1), 1e-14);
}

TEST(Moments, shiftedOrigin_obeysTheParallelAxisTheorem)
{
  Random random(5);
  for (int trial = 0; trial < 1000; ++trial)
  {
    Quadrilateral const q = randomConvex(random);
    Vector2 const s{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
    Moments<2> const m = moments<2>(q, Vector2{0.0, 0.0});
    Moments<2> const n = moments<2>(q, s);
    EXPECT_NEAR(m.volume(), n.volume(), 4e-15);
    for (int d = 0; d < 2; ++d)
    {
      EXPECT_NEAR(m.first(d) - s[d] * m.volume(), n.first(d), 1e-14);
      for (int e = 0; e < 2; ++e)
        EXPECT_NEAR(m.second(d, e) - s[d] * m.first(e) - s[e] * m.first(d) + s[d] * s[e] * m.volume(), n.second(d, e),
                    1e-14);
    }
  }
}

TEST(Moments, clockwisePolygon_countsNegative)
{
  Polygon<3> const t{3, {{0.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}}};
  EXPECT_DOUBLE_EQ(-0.5, moments<0>(t, Vector2{0.3, 0.4}).volume());
  EXPECT_DOUBLE_EQ(-0.5, area(t));
}

TEST(Moments, emptyPolygon_isZero)
{
  Polygon<4> const p{2, {{0.0, 0.0}, {1.0, 0.0}}};
  for (double const value : moments<2>(p, Vector2{0.0, 0.0}).value)
    EXPECT_EQ(0.0, value);
}

TEST(Moments, centroidFarFromTheCoordinateOrigin_keepsItsDigits)
{
  Quadrilateral q = box(0.0, 0.0, 1e-3, 1e-3);
  for (int k = 0; k < 4; ++k)
    q[k] += Vector2{1024.0, 2048.0};
  Vector2 const c = moments<1>(q, q[0]).centroid();
  EXPECT_NEAR(0.5 * (q[2][0] - q[0][0]), c[0], 1e-18);
  EXPECT_NEAR(0.5 * (q[2][1] - q[0][1]), c[1], 1e-18);
}
