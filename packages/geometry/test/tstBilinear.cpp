// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

Vector2 position(Quadrilateral const &q, Vector2 const &xi)
{
  double N[4];
  shapeFunctions(xi, N);
  return N[0] * q[0] + N[1] * q[1] + N[2] * q[2] + N[3] * q[3];
}

} // namespace

TEST(Bilinear, shapeFunctions_areOneAtTheirCornerAndSumToOne)
{
  Vector2 const corner[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int k = 0; k < 4; ++k)
  {
    double N[4];
    shapeFunctions(corner[k], N);
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(i == k ? 1.0 : 0.0, N[i]);
  }
  double N[4];
  shapeFunctions({0.3, 0.8}, N);
  EXPECT_DOUBLE_EQ(1.0, N[0] + N[1] + N[2] + N[3]);
}

TEST(Bilinear, referenceCoordinates_invertTheMapOfConvexCells)
{
  Random random(6);
  double worst = 0.0;
  for (int trial = 0; trial < 20000; ++trial)
  {
    Quadrilateral const q = movedSquare(random, 0.2);
    Vector2 const xi{uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0)};
    Vector2 const x = position(q, xi);
    worst = Math::max(worst, norm(position(q, referenceCoordinates(q, x)) - x));
    EXPECT_NEAR(0.0, norm(referenceCoordinates(q, x) - xi), 1e-12);
  }
  EXPECT_LT(worst, 1e-14);
}

TEST(Bilinear, referenceCoordinates_reachTheCornersOfDistortedCells)
{
  Quadrilateral const q{4, {{0.0, 0.0}, {4.0, 0.5}, {1.5, 1.0}, {0.2, 1.1}}};
  Vector2 const corner[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(0.0, norm(referenceCoordinates(q, q[k]) - corner[k]), 1e-12);
}

TEST(Bilinear, pointOutsideTheCell_isNotClamped)
{
  Vector2 const xi = referenceCoordinates(box(1.0, 1.0, 3.0, 2.0), {3.2, 0.9});
  EXPECT_DOUBLE_EQ(1.1, xi[0]);
  EXPECT_DOUBLE_EQ(-0.1, xi[1]);
}

TEST(Bilinear, shapeFunctionsAtAPoint_interpolateLinearFieldsExactly)
{
  Random random(7);
  for (int trial = 0; trial < 1000; ++trial)
  {
    Quadrilateral const q = movedSquare(random, 0.2);
    Vector2 const x = position(q, {uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0)});
    double N[4];
    shapeFunctionsAt(q, x, N);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
      sum += N[k] * (2.0 + 3.0 * q[k][0] - q[k][1]);
    EXPECT_NEAR(2.0 + 3.0 * x[0] - x[1], sum, 1e-14);
  }
}
