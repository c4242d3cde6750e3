// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <Harmos_ShapeRegion.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace Harmos;

namespace
{

Quadrilateral const cell = box(0.0, 0.0, 1.0, 1.0);

double volumeOf(ShapeRegion const &region)
{
  return region.moments().volume();
}

Shape randomShape(Random &random)
{
  Vector2 const c{uniform(random, -0.2, 1.2), uniform(random, -0.2, 1.2)};
  double const angle = uniform(random, 0.0, 2.0 * Math::pi);
  switch (static_cast<int>(uniform(random, 0.0, 5.0)))
  {
  case 0:
    return Shape::rectangle(c, {uniform(random, 0.1, 1.0), uniform(random, 0.1, 1.0)}, angle);
  case 1:
    return Shape::disc(c, uniform(random, 0.1, 1.0));
  case 2:
    return Shape::annulus(c, uniform(random, 0.1, 0.3), uniform(random, 0.4, 1.0));
  case 3:
    return Shape::polygon({c + Vector2{-0.4, -0.4}, c + Vector2{0.5, -0.3}, c + Vector2{0.1, 0.0},
                           c + Vector2{0.4, 0.5}, c + Vector2{0.0, 0.2}, c + Vector2{-0.3, 0.4}})
        .moved({0.0, 0.0}, angle);
  default:
    return Shape::halfPlane(c, {std::cos(angle), std::sin(angle)});
  }
}

/// Cell ∩ { a and not b and not c ... } by counting sample points: an answer independent of all clipping.
double sampledVolume(Shape const &a, std::vector<Shape> const &others, bool intersect)
{
  int const n = 400;
  int count = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      Vector2 const x{(i + 0.5) / n, (j + 0.5) / n};
      bool inside = a.contains(x);
      for (Shape const &b : others)
        inside = inside && b.contains(x) == intersect;
      count += inside ? 1 : 0;
    }
  return count / (1.0 * n * n);
}

} // namespace

TEST(ShapeRegion, twoDiscs_overlapInTheClosedFormLens)
{
  double const r = 0.3, s = 0.25, d = 0.35;
  ShapeRegion region(cell);
  region.intersect(Shape::disc({0.35, 0.5}, r));
  region.intersect(Shape::disc({0.35 + d, 0.5}, s));
  double const x = (d * d + r * r - s * s) / (2.0 * d);
  double const lens = r * r * std::acos(x / r) - x * std::sqrt(r * r - x * x) + s * s * std::acos((d - x) / s) -
                      (d - x) * std::sqrt(s * s - (d - x) * (d - x));
  EXPECT_NEAR(lens, volumeOf(region), 1e-15);
}

TEST(ShapeRegion, discWithinTheHoleOfAnAnnulus_neitherOverlapsNorLeavesAGap)
{
  Shape const core = Shape::disc({0.5, 0.5}, 0.3);
  Shape const shell = Shape::annulus({0.5, 0.5}, 0.3, 0.4);
  ShapeRegion overlap(cell);
  overlap.intersect(core);
  overlap.intersect(shell);
  EXPECT_NEAR(0.0, volumeOf(overlap), 1e-16);
  ShapeRegion rest(cell);
  rest.subtract(core);
  rest.subtract(shell);
  EXPECT_NEAR(1.0 - Math::pi * 0.16, volumeOf(rest), 1e-15);
}

TEST(ShapeRegion, shapeCutByItself_isEmpty)
{
  Random random(16);
  for (int trial = 0; trial < 500; ++trial)
  {
    Shape const shape = randomShape(random);
    ShapeRegion region(cell);
    region.intersect(shape);
    region.subtract(shape);
    for (double const value : region.moments().value)
      EXPECT_NEAR(0.0, value, 1e-15);
  }
}

TEST(ShapeRegion, randomChains_insideAndOutsideSumToTheWhole)
{
  Random random(17);
  double worst = 0.0;
  for (int trial = 0; trial < 2000; ++trial)
  {
    Shape const a = randomShape(random);
    std::vector<Shape> const cutters{randomShape(random), randomShape(random), randomShape(random)};
    Moments<1> sum;
    // Disjoint parts of a: what each cutter takes from what the earlier ones left, and the rest.
    ShapeRegion rest(cell);
    rest.intersect(a);
    Moments<1> const whole = rest.moments();
    for (Shape const &cutter : cutters)
    {
      ShapeRegion taken = rest;
      taken.intersect(cutter);
      sum += taken.moments();
      rest.subtract(cutter);
    }
    sum += rest.moments();
    for (int i = 0; i < Moments<1>::count; ++i)
      worst = Math::max(worst, Math::fabs(sum.value[i] - whole.value[i]));
  }
  EXPECT_LT(worst, 2e-14);
}

TEST(ShapeRegion, orderOfCutters_doesNotMatter)
{
  Random random(18);
  for (int trial = 0; trial < 500; ++trial)
  {
    Shape const a = randomShape(random), b = randomShape(random), c = randomShape(random);
    ShapeRegion first(cell), second(cell);
    first.intersect(a);
    first.subtract(b);
    first.subtract(c);
    second.subtract(c);
    second.subtract(b);
    second.intersect(a);
    EXPECT_NEAR(volumeOf(first), volumeOf(second), 1e-14);
  }
}

TEST(ShapeRegion, randomChains_matchSampledVolumes)
{
  Random random(19);
  for (int trial = 0; trial < 60; ++trial)
  {
    Shape const a = randomShape(random);
    std::vector<Shape> const others{randomShape(random), randomShape(random)};
    ShapeRegion cut(cell), common(cell);
    cut.intersect(a);
    common.intersect(a);
    for (Shape const &b : others)
    {
      cut.subtract(b);
      common.intersect(b);
    }
    EXPECT_NEAR(sampledVolume(a, others, false), volumeOf(cut), 4e-3);
    EXPECT_NEAR(sampledVolume(a, others, true), volumeOf(common), 4e-3);
  }
}
