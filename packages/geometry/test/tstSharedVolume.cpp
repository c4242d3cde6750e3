// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <Harmos_SharedVolume.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

Quadrilateral const everywhere = box(-10.0, -10.0, 10.0, 10.0);

/// A comb of two teeth, 3 wide and 2 high, with a unit notch from the top.
Polygon<8> comb(double x, double y)
{
  Polygon<8> p{8, {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  for (int i = 0; i < 8; ++i)
    p[i] += Vector2{x, y};
  return p;
}

/// The same in convex parts.
double ofParts(Polygon<8> const &p, Quadrilateral const parts[3], Quadrilateral const &window)
{
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
    sum += sharedVolume(p, parts[i], window, Geometry::Planar);
  return sum;
}

} // namespace

TEST(SharedVolume, shiftedSquares_shareARectangle)
{
  EXPECT_DOUBLE_EQ(0.75 * 0.5, sharedVolume(box(0, 0, 1, 1), box(0.25, 0.5, 2, 2), everywhere, Geometry::Planar));
  EXPECT_EQ(0.0, sharedVolume(box(0, 0, 1, 1), box(1, 0, 2, 1), everywhere, Geometry::Planar));
  EXPECT_EQ(0.0, sharedVolume(box(0, 0, 1, 1), box(1, 1, 2, 2), everywhere, Geometry::Planar));
  EXPECT_EQ(0.0, sharedVolume(box(0, 0, 1, 1), Quadrilateral{}, everywhere, Geometry::Planar));
}

TEST(SharedVolume, windowsThatTileThePlane_addUp)
{
  Random random(3);
  for (int trial = 0; trial < 2000; ++trial)
  {
    Quadrilateral const a = randomConvex(random), b = randomConvex(random);
    double sum = 0.0;
    for (int i = -2; i < 2; ++i)
      for (int j = -2; j < 2; ++j)
        sum += sharedVolume(a, b, box(i, j, i + 1, j + 1), Geometry::Planar);
    double const whole = sharedVolume(a, b, everywhere, Geometry::Planar);
    EXPECT_NEAR(whole, sum, 1e-14);
    EXPECT_NEAR(whole, sharedVolume(b, a, everywhere, Geometry::Planar), 1e-14);
    EXPECT_NEAR(area(a), sharedVolume(a, a, everywhere, Geometry::Planar), 1e-14);
  }
}

TEST(SharedVolume, combs_thatAreNotConvex_shareWhatTheirPartsDo)
{
  // The base of the upper lies half a unit deep on half of one tooth and all of the other.
  Polygon<8> const a = comb(0.0, 0.0), upper = comb(0.5, 1.5);
  EXPECT_NEAR(0.75, sharedVolume(a, upper, everywhere, Geometry::Planar), 1e-15);
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial)
  {
    double const x = uniform(random, -3.5, 3.5), y = uniform(random, -2.5, 2.5);
    Polygon<8> const b = comb(x, y);
    Quadrilateral const parts[3] = {box(x, y, x + 1, y + 2), box(x + 1, y, x + 2, y + 1), box(x + 2, y, x + 3, y + 2)};
    Quadrilateral const window = randomConvex(random);
    EXPECT_NEAR(ofParts(a, parts, everywhere), sharedVolume(a, b, everywhere, Geometry::Planar), 1e-14);
    EXPECT_NEAR(ofParts(a, parts, window), sharedVolume(a, b, window, Geometry::Planar), 1e-14);
  }
}

TEST(SharedVolume, ofRings_isWeightedByTheRadius)
{
  // 1.25 < r < 2, 0.5 < z < 1: (4 - 25/16) / 2 * 0.5
  double const exact = 0.25 * (4.0 - 1.5625);
  EXPECT_NEAR(exact, sharedVolume(box(1, 0, 2, 1), box(1.25, 0.5, 3, 2), everywhere, Geometry::Axisymmetric), 1e-15);
  double halves = 0.0;
  for (double r : {0.0, 1.5})
    halves += sharedVolume(box(1, 0, 2, 1), box(1.25, 0.5, 3, 2), box(r, 0, r + 1.5, 3), Geometry::Axisymmetric);
  EXPECT_NEAR(exact, halves, 1e-15);
}

TEST(SharedVolume, farFromTheOrigin_keepsItsDigits)
{
  double const x = 1e6, d = 0x1p-10;
  EXPECT_EQ(d * d, sharedVolume(box(x, x, x + 1, x + 1), box(x + 1 - d, x + 1 - d, x + 2, x + 2),
                                box(x - 1, x - 1, x + 3, x + 3), Geometry::Planar));
}
