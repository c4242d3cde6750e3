// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <Harmos_CornerShares.hpp>
#include <Harmos_Shape.hpp>
#include <Harmos_ShapeRegion.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

/// Integral over a triangle by Radon's seven points, exact to degree five.
template <class Function>
double radon(Vector2 const &a, Vector2 const &b, Vector2 const &c, Function const &f)
{
  double const root = std::sqrt(15.0);
  double const near[2] = {(6.0 - root) / 21.0, (6.0 + root) / 21.0};
  double const weight[2] = {(155.0 - root) / 1200.0, (155.0 + root) / 1200.0};
  double sum = 9.0 / 40.0 * f((1.0 / 3.0) * (a + b + c));
  for (int i = 0; i < 2; ++i)
  {
    double const s = near[i], rest = 1.0 - 2.0 * s;
    sum += weight[i] * (f(rest * a + s * b + s * c) + f(s * a + rest * b + s * c) + f(s * a + s * b + rest * c));
  }
  return 0.5 * cross(b - a, c - a) * sum;
}

template <class Function>
double integral(Quadrilateral const &q, Function const &f)
{
  return radon(q[0], q[1], q[2], f) + radon(q[0], q[2], q[3], f);
}

Quadrilateral ringSection(Random &random)
{
  Quadrilateral q = randomConvex(random);
  for (int k = 0; k < 4; ++k)
    q[k] += Vector2{1.6, 0.0};
  return q;
}

constexpr Geometry ring = Geometry::Axisymmetric;

} // namespace

TEST(AreaWeight, ThirdMomentsOfRandomQuadrilaterals_areThoseOfQuadrature)
{
  Random random(1);
  for (int trial = 0; trial < 200; ++trial)
  {
    Quadrilateral const q = randomConvex(random);
    Vector2 const origin{0.3, -0.2};
    Moments<3> const m = moments<3>(q, origin);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(m.value[6 + k],
                  integral(q, [&](Vector2 x) { return std::pow(x[0] - 0.3, 3 - k) * std::pow(x[1] + 0.2, k); }), 1e-14);
  }
}

TEST(AreaWeight, MomentsOfRings_areThoseOfQuadratureWithTheRadius)
{
  Random random(2);
  for (int trial = 0; trial < 200; ++trial)
  {
    Quadrilateral const q = ringSection(random);
    Moments<2> const m = moments<2>(q, q[0], areaWeight(ring, q[0]));
    for (int n = 0, i = 0; n < 3; ++n)
      for (int k = 0; k <= n; ++k, ++i)
        EXPECT_NEAR(m.value[i],
                    integral(q, [&](Vector2 x)
                             { return x[0] * std::pow(x[0] - q[0][0], n - k) * std::pow(x[1] - q[0][1], k); }),
                    1e-14);
    EXPECT_NEAR(volume(q, ring), m.volume(), 1e-15);
  }
}

TEST(AreaWeight, ConeAboutTheAxis_hasItsVolumeAndCentroid)
{
  Polygon<3> cone;
  cone.push({0.0, 0.0});
  cone.push({0.7, 0.0});
  cone.push({0.0, 1.3});
  // pi R^2 H / 3 over 2 pi; a quarter of the height
  EXPECT_NEAR(volume(cone, ring), 0.49 * 1.3 / 6.0, 1e-16);
  EXPECT_NEAR(volumeCentroid(cone, ring)[1], 1.3 / 4.0, 1e-15);
}

TEST(AreaWeight, PlanarVolume_isTheArea)
{
  Random random(3);
  Quadrilateral const q = ringSection(random);
  EXPECT_EQ(volume(q, Geometry::Planar), area(q));
  EXPECT_EQ(moments<1>(q, q[0], areaWeight(Geometry::Planar, q[0])).value[2], moments<1>(q, q[0]).value[2]);
}

TEST(AreaWeight, SphereHemisphereAndTorus_haveTheirClosedForms)
{
  double const r = 0.6;
  Moments<1> const sphere = Shape::disc({0.0, 0.1}, r).intersectionMoments(box(0.0, -1.0, 1.0, 1.0), ring);
  EXPECT_NEAR(sphere.volume(), 2.0 / 3.0 * r * r * r, 1e-15);
  EXPECT_NEAR(sphere.centroid()[1] - 1.0, 0.1, 1e-14);
  Moments<1> const half = Shape::disc({0.0, 0.0}, r).intersectionMoments(box(0.0, 0.0, 1.0, 1.0), ring);
  EXPECT_NEAR(half.volume(), r * r * r / 3.0, 1e-15);
  EXPECT_NEAR(half.centroid()[1], 3.0 / 8.0 * r, 1e-15);
  double const a = 0.25, big = 1.5;
  Moments<1> const torus = Shape::disc({big, 0.4}, a).intersectionMoments(box(1.0, 0.0, 2.0, 1.0), ring);
  EXPECT_NEAR(torus.volume(), Math::pi * a * a * big, 1e-15);
  EXPECT_NEAR(torus.first(0) + torus.volume(), Math::pi * a * a * (big * big + 0.25 * a * a), 1e-14);
}

TEST(CornerShares, OfRingSections_balanceWhereTheirVolumeDoes)
{
  // sum share_k x_k = integral of r x dA / V, since sum N_k x_k = x
  Random random(4);
  for (int trial = 0; trial < 200; ++trial)
  {
    Quadrilateral q = ringSection(random);
    if (trial % 2 == 0)
      q[0][0] = q[3][0] = 0.0;
    double share[4], sum = 0.0;
    ringShares(q, share);
    Vector2 centre{0.0, 0.0};
    for (int k = 0; k < 4; ++k)
    {
      sum += share[k];
      centre += share[k] * q[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_NEAR(centre[0], volumeCentroid(q, ring)[0], 1e-14);
    EXPECT_NEAR(centre[1], volumeCentroid(q, ring)[1], 1e-14);
  }
}

TEST(CornerShares, OfARectangleAtTheAxis_areASixthAndAThird)
{
  double share[4];
  ringShares(box(0.0, 2.0, 0.3, 2.7), share);
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(share[k], k == 0 || k == 3 ? 1.0 / 6.0 : 1.0 / 3.0, 1e-15);
}

TEST(AreaWeight, CellsCutASphereIntoParts_thatAddUpToIt)
{
  for (double const radius : {0.9, 37.3, 2.0e4})
  {
    // cells along the surface, of size one where the sphere is large
    double const h = std::min(1.0, radius / 10.0), low = radius > 100.0 ? radius - 20.0 * h : 0.0;
    Shape const sphere = Shape::disc({0.0, 0.0}, radius);
    Moments<1> sum;
    double const top = 20.0 * h;
    int const columns = static_cast<int>(std::ceil((1.01 * radius - low) / h));
    if (columns > 400)
      continue;
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < columns; ++i)
      {
        Quadrilateral const cell = box(low + i * h, j * h, low + (i + 1) * h, (j + 1) * h);
        Moments<1> m = sphere.intersectionMoments(cell, ring);
        sum += shifted(m, cell[0]);
      }
    // integral over z of (R^2 - z^2 - low^2) / 2, up to the lower of top and the sphere's end
    double const z = std::min(top, radius);
    double const exact = 0.5 * ((radius - low) * (radius + low) * z - z * z * z / 3.0);
    EXPECT_NEAR(sum.volume() / exact, 1.0, 1e-12) << radius;
  }
}

TEST(AreaWeight, PartsOfDiscs_areThoseOfQuadratureOverManyChords)
{
  Random random(5);
  for (int trial = 0; trial < 50; ++trial)
  {
    Disc const disc{{uniform(random, 0.5, 1.5), uniform(random, -0.5, 0.5)}, uniform(random, 0.2, 1.0)};
    Quadrilateral const q = ringSection(random);
    Moments<2> const m = discMoments<2>(q, disc);
    // the same disc as a polygon of many sides, its area mended: error of second order in the angle
    int const sides = 4000;
    Polygon<4008> fan;
    double const stretch = std::sqrt(2.0 * Math::pi / sides / std::sin(2.0 * Math::pi / sides));
    for (int i = 0; i < sides; ++i)
    {
      double const angle = 2.0 * Math::pi * i / sides;
      fan.push(disc.centre + (stretch * disc.radius) * Vector2{std::cos(angle), std::sin(angle)});
    }
    Polygon<4008> part;
    clipConvex(fan, q, part);
    Moments<2> const many = moments<2>(part, Vector2{0.0, 0.0});
    for (int i = 0; i < Moments<2>::count; ++i)
      EXPECT_NEAR(m.value[i], many.value[i], 1e-6);
  }
}

TEST(AreaWeight, ShapeVolume_isThatOfThePartRightOfTheAxis)
{
  EXPECT_NEAR(Shape::disc({0.0, 3.0}, 0.5).volume(ring), 0.125 * 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(Shape::rectangle({0.0, 0.0}, {2.0, 3.0}).volume(ring), 0.5 * 3.0, 1e-15);
  EXPECT_NEAR(Shape::annulus({0.0, 0.0}, 0.5, 1.0).volume(ring), 2.0 / 3.0 * (1.0 - 0.125), 1e-14);
  EXPECT_EQ(Shape::disc({-2.0, 0.0}, 0.5).volume(ring), 0.0);
  EXPECT_EQ(Shape::rectangle({0.0, 0.0}, {2.0, 3.0}).volume(Geometry::Planar), 6.0);
}
