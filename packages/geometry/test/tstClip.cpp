// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

void expectClosure(Quadrilateral const &donor)
{
  Moments<1> const whole = moments<1>(donor, Vector2{0.0, 0.0});
  Moments<1> const sum = sumOfOverlays(donor);
  for (int i = 0; i < Moments<1>::count; ++i)
    EXPECT_NEAR(whole.value[i], sum.value[i], 1e-14);
}

} // namespace

TEST(Clip, squareByDiagonal_keepsHalf)
{
  Polygon<5> half;
  EXPECT_TRUE(clip(box(0, 0, 1, 1), Plane2{{1.0, 1.0}, 1.0}, half));
  EXPECT_EQ(3, half.size);
  EXPECT_DOUBLE_EQ(0.5, area(half));
}

TEST(Clip, lineThroughAnEdge_keepsAllOrNothing)
{
  Polygon<5> part;
  clip(box(0, 0, 1, 1), Plane2{{1.0, 0.0}, 1.0}, part);
  EXPECT_EQ(4, part.size);
  EXPECT_EQ(1.0, area(part));
  clip(box(0, 0, 1, 1), Plane2{{-1.0, 0.0}, -1.0}, part);
  EXPECT_TRUE(part.empty());
  EXPECT_EQ(0, part.size);
}

TEST(Clip, bothSidesOfARandomLine_sumToTheWhole)
{
  Random random(1);
  for (int trial = 0; trial < 20000; ++trial)
  {
    Quadrilateral const q = randomConvex(random);
    double const angle = uniform(random, 0.0, 2.0 * Math::pi);
    Vector2 const normal{Math::cos(angle), Math::sin(angle)};
    double const offset = uniform(random, -1.0, 1.0);
    Polygon<5> inside, outside;
    EXPECT_TRUE(clip(q, Plane2{normal, offset}, inside));
    EXPECT_TRUE(clip(q, Plane2{-normal, -offset}, outside));
    EXPECT_NEAR(area(q), area(inside) + area(outside), 2e-15);
  }
}

TEST(Clip, nonConvexSubject_areaIsExactThoughItsPartsStayJoined)
{
  // A comb of two teeth, 3 wide and 2 high with a unit notch from the top; cut below y = 1.5.
  Polygon<8> const comb{8, {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  Polygon<16> part;
  EXPECT_TRUE(clip(comb, Plane2{{0.0, -1.0}, -1.5}, part));
  EXPECT_DOUBLE_EQ(1.0, area(part));
}

TEST(Clip, capacityExceeded_isReported)
{
  Polygon<4> part;
  EXPECT_FALSE(clip(box(0, 0, 1, 1), Plane2{{1.0, 1.0}, 1.5}, part));
}

// With those of the next tests more than ten million pairs of a donor and one of nine cells.
TEST(ClipConvex, donorMovedAtRandom_overlaysWithNeighboursSumToIt)
{
  Random random(2);
  for (int trial = 0; trial < 1100000; ++trial)
    expectClosure(movedSquare(random, 0.25));
}

TEST(ClipConvex, donorNotMoved_onlyItsOwnCellHoldsIt)
{
  Quadrilateral const donor = box(0, 0, 1, 1);
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i)
      EXPECT_EQ(i == 0 && j == 0 ? 1.0 : 0.0, area(overlayWithUnitCell(donor, i, j)));
}

TEST(ClipConvex, donorWithSharedEdgesAndVertices_closes)
{
  expectClosure(box(0.0, 0.0, 1.25, 1.0));
  expectClosure(box(0.0, -0.5, 1.0, 0.5));
  expectClosure(box(-1.0, -1.0, 2.0, 2.0));
  expectClosure(Quadrilateral{4, {{0.5, 0.0}, {1.0, 0.5}, {0.5, 1.0}, {0.0, 0.5}}});
  expectClosure(Quadrilateral{4, {{0.5, -0.5}, {1.5, 0.5}, {0.5, 1.5}, {-0.5, 0.5}}}); // edges through corners
  expectClosure(Quadrilateral{4, {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {1.0, 1.0}}});   // a doubled vertex
}

TEST(ClipConvex, sliversAndTinyDisplacements_close)
{
  Random random(3);
  for (double const size : {1e-16, 1e-15, 1e-12, 1e-8})
  {
    expectClosure(box(0.0, 0.0, 1.0, size));
    expectClosure(box(1.0 - size, 0.25, 1.0 + size, 0.75));
    for (int trial = 0; trial < 20000; ++trial)
      expectClosure(movedSquare(random, size));
  }
}

TEST(ClipConvex, sliverBeyondAFace_keepsItsDigits)
{
  // Relative to the corner of the acceptor the sliver is 2^-50, to the last digits (fused multiply-adds differ there).
  double const size = std::ldexp(1.0, -50);
  EXPECT_DOUBLE_EQ(size, area(overlayWithUnitCell(box(0.0, 0.0, 1.0 + size, 1.0), 1, 0)));
}

TEST(ClipConvex, subjectAndWindowExchanged_giveTheSameMoments)
{
  Random random(4);
  for (int trial = 0; trial < 20000; ++trial)
  {
    Quadrilateral const a = randomConvex(random);
    Quadrilateral const b = randomConvex(random);
    Region ab, ba;
    EXPECT_TRUE(clipConvex(a, b, ab));
    EXPECT_TRUE(clipConvex(b, a, ba));
    Moments<2> const mab = moments<2>(ab, Vector2{0.0, 0.0});
    Moments<2> const mba = moments<2>(ba, Vector2{0.0, 0.0});
    for (int i = 0; i < Moments<2>::count; ++i)
      EXPECT_NEAR(mab.value[i], mba.value[i], 1e-14);
  }
}
