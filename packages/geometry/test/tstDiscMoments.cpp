// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <Harmos_DiscMoments.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

/// Moments about (0, 0) of the cap of a disc beyond x = centre + distance, by the closed form.
Moments<1> cap(Disc const &disc, double distance)
{
  double const half = 2.0 * Math::asin(Math::sqrt(0.5 * (disc.radius - distance) / disc.radius));
  double const r = disc.radius;
  Moments<1> m;
  m.value[0] = 0.5 * r * r * angleMinusSine(2.0 * half);
  double const s = Math::sin(half);
  m.value[1] = m.value[0] * disc.centre[0] + 2.0 / 3.0 * r * r * r * s * s * s;
  m.value[2] = m.value[0] * disc.centre[1];
  return m;
}

void expectEqual(Moments<1> const &a, Moments<1> const &b, double tolerance)
{
  for (int i = 0; i < Moments<1>::count; ++i)
    EXPECT_NEAR(a.value[i], b.value[i], tolerance);
}

} // namespace

TEST(DiscMoments, angleMinusSine_isSmoothWhereTheSeriesTakesOver)
{
  EXPECT_NEAR(0.5 - Math::sin(0.5), angleMinusSine(0.5), 1e-16);
  EXPECT_NEAR(angleMinusSine(0.5 * (1.0 + 1e-15)), angleMinusSine(0.5), 1e-16);
  EXPECT_NEAR(1.0, angleMinusSine(1e-5) / (1e-15 / 6.0), 1e-10);
}

TEST(DiscMoments, discWithinThePolygon_isTheWholeDisc)
{
  Disc const disc{{0.4, 0.6}, 0.3};
  Moments<1> const m = discMoments(box(0, 0, 1, 1), disc);
  double const volume = Math::pi * 0.09;
  EXPECT_NEAR(volume, m.volume(), 1e-15);
  EXPECT_NEAR(volume * 0.4, m.first(0), 1e-15);
  EXPECT_NEAR(volume * 0.6, m.first(1), 1e-15);
}

TEST(DiscMoments, polygonWithinTheDisc_isThePolygon)
{
  Random random(10);
  for (int trial = 0; trial < 1000; ++trial)
  {
    Quadrilateral const q = randomConvex(random);
    expectEqual(moments<1>(q, Vector2{0.0, 0.0}), discMoments(q, Disc{{0.1, -0.2}, 3.0}), 1e-14);
  }
}

TEST(DiscMoments, polygonInscribedInTheDisc_isThePolygon)
{
  // All corners on the circle to round-off: no arc may be taken for its complement.
  Random random(11);
  for (int n = 3; n <= 16; ++n)
    for (int trial = 0; trial < 200; ++trial)
    {
      Disc const disc{{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)}, uniform(random, 0.1, 1.0)};
      double const turn = trial == 0 ? 0.0 : uniform(random, 0.0, 2.0 * Math::pi);
      Region p;
      for (int i = 0; i < n; ++i)
      {
        double const angle = turn + 2.0 * Math::pi * i / n;
        p.push(disc.centre + disc.radius * Vector2{Math::cos(angle), Math::sin(angle)});
      }
      expectEqual(moments<1>(p, Vector2{0.0, 0.0}), discMoments(p, disc), 1e-14);
    }
}

TEST(DiscMoments, squareThatTouchesTheDisc_holdsAllOrNothingOfIt)
{
  Disc const disc{{0.0, 0.0}, 1.0};
  EXPECT_NEAR(Math::pi, discMoments(box(-1, -1, 1, 1), disc).volume(), 1e-14);
  EXPECT_NEAR(0.5 * Math::pi, discMoments(box(-1, 0, 1, 1), disc).volume(), 1e-14);
  EXPECT_NEAR(0.25 * Math::pi, discMoments(box(0, 0, 1, 1), disc).volume(), 1e-14);
  EXPECT_NEAR(0.0, discMoments(box(1, -1, 2, 1), disc).volume(), 1e-16);
}

TEST(DiscMoments, halfDiscWithAnEdgeNearTheCentre_isContinuous)
{
  Disc const disc{{0.0, 0.0}, 1.0};
  for (double const shift : {-1e-15, -1e-17, 0.0, 1e-17, 1e-15})
  {
    Moments<1> const m = discMoments(box(-2, shift, 2, 2), disc);
    EXPECT_NEAR(0.5 * Math::pi, m.volume(), 1e-14);
    EXPECT_NEAR(2.0 / 3.0, m.first(1), 1e-14);
  }
}

TEST(DiscMoments, caps_matchTheClosedFormRelatively)
{
  Disc const disc{{0.25, -0.5}, 1.5};
  for (double const distance : {-1.4, -0.7, 0.0, 0.3, 1.0, 1.4, 1.499, 1.5 - 1e-6, 1.5 - 1e-9})
  {
    Moments<1> const m = discMoments(box(disc.centre[0] + distance, -3.0, 3.0, 3.0), disc);
    Moments<1> const expected = cap(disc, distance);
    // The distance itself is known to 1e-16 only: d(volume)/volume = 1.5 d(distance)/height.
    double const height = disc.radius - distance;
    double const tolerance = 1e-14 + 1e-15 / height;
    EXPECT_NEAR(1.0, m.volume() / expected.volume(), tolerance) << distance;
    EXPECT_NEAR(1.0, m.first(0) / expected.first(0), tolerance) << distance;
  }
}

TEST(DiscMoments, hugeRadius_keepsTheDigitsOfTheCell)
{
  // A circle of radius 2^20 through (0.5, y): nearly the line x = 0.5, sagitta (y - 0.5)^2 / (2 R).
  double const radius = 1048576.0;
  Disc const disc{{0.5 - radius, 0.5}, radius};
  Moments<1> const m = discMoments(box(0, 0, 1, 1), disc);
  EXPECT_NEAR(0.5 - 1.0 / (24.0 * radius), m.volume(), 1e-14);
  EXPECT_NEAR(0.125, m.first(0), 1e-6);
  EXPECT_NEAR(0.5 * m.volume(), m.first(1), 1e-14);
}

TEST(DiscMoments, overlaysWithAGrid_sumToTheDisc)
{
  Random random(12);
  double worst = 0.0;
  for (int trial = 0; trial < 300; ++trial)
  {
    Disc const disc{{uniform(random, 3.0, 5.0), uniform(random, 3.0, 5.0)}, uniform(random, 0.01, 3.0)};
    Moments<1> sum;
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i)
        sum += discMoments(box(i, j, i + 1.0, j + 1.0), disc);
    double const volume = Math::pi * disc.radius * disc.radius;
    worst = Math::max(worst, Math::fabs(sum.volume() / volume - 1.0));
    EXPECT_NEAR(0.0, norm(sum.centroid() - disc.centre), 1e-11);
  }
  EXPECT_LT(worst, 1e-12);
}

TEST(DiscMoments, randomPolygons_matchADiscOfManySectors)
{
  // Independent of arcs: the disc as an area-preserving polygon of very many sides, clipped by the polygon's edges.
  Random random(13);
  for (int trial = 0; trial < 20; ++trial)
  {
    Quadrilateral const q = randomConvex(random);
    Disc const disc{{uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5)}, uniform(random, 0.1, 1.0)};
    int const n = 20000;
    double const step = 2.0 * Math::pi / n;
    double const r = disc.radius * Math::sqrt(step / Math::sin(step));
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
    {
      Polygon<3> const sector{3,
                              {disc.centre, disc.centre + r * Vector2{Math::cos(i * step), Math::sin(i * step)},
                               disc.centre + r * Vector2{Math::cos((i + 1) * step), Math::sin((i + 1) * step)}}};
      Region part;
      clipConvex(sector, q, part);
      sum += area(part);
    }
    EXPECT_NEAR(sum, discMoments(q, disc).volume(), 1e-9);
  }
}
