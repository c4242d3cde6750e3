// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_NormalFit.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace Harmos;

namespace
{

Vector2 fit(std::vector<FitSample> const &sample, Vector2 const &own = {1.0, 0.0}, bool rough = false)
{
  FitSamples samples;
  for (FitSample const &s : sample)
    EXPECT_TRUE(samples.push(s));
  return fitNormal(samples, own, rough);
}

FitSample sampleAt(Vector2 const &x, Vector2 const &n, double length, int side, double gap = 0.0)
{
  return {x, n, length, laneOf(fitWeight(length, dot(x, x)), 0), gap, side};
}

double angleBetween(Vector2 const &a, Vector2 const &b)
{
  return std::fabs(std::atan2(cross(a, b), dot(a, b)));
}

Vector2 atAngle(double degrees)
{
  return {std::cos(degrees * Math::pi / 180), std::sin(degrees * Math::pi / 180)};
}

} // namespace

TEST(NormalFit, besideACornerOfABodyInsideOfAnother_keepsTheFace)
{
  // Two faces that meet at (0.3, 0), a speck beside them; the point is on the face along x.
  std::vector<FitSample> s;
  for (int side = 0; side < 2; ++side)
  {
    s.push_back(sampleAt({0.0, 0.0}, {0.0, 1.0}, 0.6, side));
    s.push_back(sampleAt({0.3, 0.5}, {-1.0, 0.0}, 1.0, side));
    for (int i = 1; i < 3; ++i)
    {
      s.push_back(sampleAt({-0.6 * i, 0.0}, {0.0, 1.0}, 0.6, side)); // cut by more cells
      s.push_back(sampleAt({0.3, i + 0.5}, {-1.0, 0.0}, 1.0, side));
    }
  }
  s.push_back(sampleAt({0.2, 1.9}, {0.0, 1.0}, 1e-4, 0));
  Vector2 const face{0.0, 1.0};
  EXPECT_LT(angleBetween(fit(s, face, true), face), 1e-6);
  EXPECT_GT(angleBetween(fit(s, face, false), face), 0.1);
}

TEST(SmoothnessAt, ofACircleAboutAPointOfTheMirrorIsOne_ofAKinkNone)
{
  // The mirror is x = 0, the body at x > 0; samples seen from a point 0.4 cells from it.
  Vector2 const wall{-1.0, 0.0};
  double const distance = 0.4, radius = 6.0;
  FitSamples circle, rough;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < 4; ++i)
    {
      double const x = 0.35 + 0.7 * i, angle = std::asin(x / radius);
      Vector2 const at{x - distance, radius * std::cos(angle) - radius};
      EXPECT_TRUE(circle.push(sampleAt(at, {std::sin(angle), std::cos(angle)}, 0.7, side)));
      double const off = angle + (i % 2 == 0 ? 0.02 : -0.02);
      EXPECT_TRUE(rough.push(sampleAt(at, {std::sin(off), std::cos(off)}, 0.7, side)));
    }
  EXPECT_EQ(smoothnessAt(circle, wall, distance, {0.0, 1.0}), 1.0);
  EXPECT_EQ(smoothnessAt(rough, wall, distance, {0.0, 1.0}), 1.0);
  double const sine[4] = {0.01, 0.02, 0.025, 0.1}, least[4] = {1.0, 0.5, 0.1, 0.0}, most[4] = {1.0, 0.9, 0.5, 0.0};
  for (int j = 0; j < 4; ++j)
  {
    FitSamples leg;
    Vector2 const normal{-sine[j], std::sqrt(1.0 - sine[j] * sine[j])};
    for (int i = 0; i < 4; ++i)
      EXPECT_TRUE(leg.push(sampleAt({0.35 + 0.7 * i - distance, sine[j] * i}, normal, 0.7, 0)));
    double const part = smoothnessAt(leg, wall, distance, {0.0, 1.0});
    EXPECT_GE(part, least[j]);
    EXPECT_LE(part, most[j]);
    // the other face of a wedge, that looks the other way, is not asked
    EXPECT_EQ(smoothnessAt(leg, wall, distance, {0.0, -1.0}), 0.0);
  }
}

TEST(NormalFit, noSamples_returnsTheFallback)
{
  Vector2 const n = fit({});
  EXPECT_EQ(n[0], 1.0);
  EXPECT_EQ(n[1], 0.0);
}

TEST(NormalFit, oneSegment_returnsItsNormal)
{
  Vector2 const n = atAngle(37.0);
  EXPECT_LT(angleBetween(fit({sampleAt({0.1, 0.2}, n, 0.7, 0)}), n), 1e-14);
}

TEST(NormalFit, straightLineOnBothSides_isExact)
{
  Vector2 const n = atAngle(105.0), t = perpendicular(n);
  std::vector<FitSample> s;
  for (int i = -3; i <= 3; ++i)
  {
    s.push_back(sampleAt((0.9 * i) * t, n, 0.9, 0));
    s.push_back(sampleAt((0.8 * i + 0.2) * t + 0.15 * n, n, 0.8, 1));
  }
  EXPECT_LT(angleBetween(fit(s), n), 1e-14);
}

// One segment lies a third of a cell off and is tilted by 35 degrees: without the robust weights the normal errs by
// 0.02.
TEST(NormalFit, straightLineWithAWildSegment_isNearlyExact)
{
  Vector2 const n = atAngle(105.0), t = perpendicular(n);
  std::vector<FitSample> s;
  for (int i = -3; i <= 3; ++i)
    for (int side = 0; side < 2; ++side)
    {
      bool const wild = i == 2 && side == 0;
      s.push_back(sampleAt((0.9 * i) * t + (wild ? 0.33 : 0.0) * n, wild ? atAngle(140.0) : n, 0.9, side));
    }
  EXPECT_LT(angleBetween(fit(s), n), 5e-4);
}

// Two bodies lie on each other for two cells; beside that one of them has lifted off by a wedge of 5 degrees. What
// touches has no part in the wedge, though its opening, below 0.14 cells, is no misfit that the robust weights drop.
TEST(NormalFit, contactBesideAWedge_isNotTurned)
{
  Vector2 const n = atAngle(112.5), t = perpendicular(n), leaning = atAngle(117.5);
  double const rise = std::tan(5.0 * Math::pi / 180.0);
  for (double const closed_by : {1.0, 0.0}) // the wedge begins beside the row, or at it
  {
    std::vector<FitSample> s;
    for (int i = -5; i <= 5; ++i)
    {
      double const at = 0.45 * i, gap = std::max(0.0, (at - closed_by) * rise);
      s.push_back(sampleAt(at * t, n, 0.45, 0, gap));
      s.push_back(sampleAt(at * t + gap * n, gap > 0.0 ? leaning : n, 0.45, 1, gap));
    }
    EXPECT_LT(angleBetween(fit(s), n), 3e-4) << "closed to " << closed_by;
  }
}

// A short facet that touches, tilted by 10 degrees, between straight sides a tenth of a cell apart: they tell more.
TEST(NormalFit, shortFacetThatTouches_doesNotDecideAlone)
{
  Vector2 const n = atAngle(60.0), t = perpendicular(n);
  std::vector<FitSample> s{sampleAt({0.0, 0.0}, atAngle(70.0), 0.3, 0), sampleAt({0.0, 0.0}, atAngle(70.0), 0.3, 1)};
  for (int i = -5; i <= 5; ++i)
    for (int side = 0; side < 2; ++side)
      if (i != 0)
        s.push_back(sampleAt((0.45 * i) * t + (0.1 * side) * n, n, 0.45, side, 0.1));
  EXPECT_LT(angleBetween(fit(s), n), 0.02);
}

TEST(NormalFit, noisyLine_isAveraged)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  Vector2 const n = atAngle(105.0), t = perpendicular(n);
  double largest = 0.0;
  for (int trial = 0; trial < 50; ++trial)
  {
    std::vector<FitSample> s;
    for (int i = -3; i <= 3; ++i)
      for (int side = 0; side < 2; ++side)
      {
        double const tilt = 0.01 * noise(random);
        s.push_back(sampleAt((0.9 * i) * t + (0.003 * noise(random)) * n, normalised(n + tilt * t), 0.9, side));
      }
    largest = std::max(largest, angleBetween(fit(s), n));
  }
  RecordProperty("largest_angle_error", std::to_string(largest));
  EXPECT_LT(largest, 0.005); // own normals err by up to three times 0.01
}

// Chords of a circle of radius 8: curvature must not tilt the normal, wherever the point lies among the chords.
TEST(NormalFit, chordsOfACircle_normalIsRadial)
{
  double largest = 0.0;
  for (int trial = 0; trial < 40; ++trial)
  {
    double const R = 8.0, chord = 0.11, at = 0.3 + 0.05 * trial;
    auto const centre = [&](double phi) { return (R * std::cos(0.5 * chord)) * Vector2{std::cos(phi), std::sin(phi)}; };
    Vector2 const x = centre(at);
    std::vector<FitSample> s;
    for (int i = -4; i <= 3; ++i) // one-sided: more on one hand
      for (int side = 0; side < 2; ++side)
      {
        double const phi = at + i * chord;
        s.push_back(sampleAt(centre(phi) - x, {std::cos(phi), std::sin(phi)}, 2 * R * std::sin(0.5 * chord), side));
      }
    largest = std::max(largest, angleBetween(fit(s), {std::cos(at), std::sin(at)}));
  }
  RecordProperty("largest_angle_error", std::to_string(largest));
  EXPECT_LT(largest, 2e-3);
}

// Chords of small circles, as cells cut them: long and short ones by turns, more on one hand. No parabola is a circle;
// a misfit must not flatten it, or the normal turns with what the curvature lacks.
TEST(NormalFit, chordsOfSmallCircles_areNotFlattened)
{
  for (double const R : {2.5, 4.0})
  {
    double phi = -2.6 / R;
    std::vector<FitSample> s;
    for (int i = 0; phi < 1.3 / R; ++i)
    {
      double const chord = (i % 2 == 0 ? 0.9 : 0.3) / R, middle = phi + 0.5 * chord, inside = R * std::cos(0.5 * chord);
      Vector2 const n{std::cos(middle), std::sin(middle)};
      for (int side = 0; side < 2; ++side)
        s.push_back(sampleAt(inside * n - Vector2{R, 0.0}, n, 2.0 * R * std::sin(0.5 * chord), side));
      phi += chord;
    }
    EXPECT_LT(angleBetween(fit(s), {1.0, 0.0}), 0.035 / (R * R)) << "radius " << R;
  }
}

// The two faces of a wedge of 12 degrees inside of the other material: each has its own normal, and neither the mean of
// both, which is along the wedge.
TEST(NormalFit, facesOfASharpWedge_keepTheirNormals)
{
  Vector2 const left = atAngle(186.0), right = atAngle(-6.0);
  std::vector<FitSample> s;
  for (int i = 0; i < 4; ++i)
  {
    double const y = 0.5 + i; // above the tip
    Vector2 const on_left{-0.105 * y, y}, on_right{0.105 * y, y}, at{-0.105 * 0.5, 0.5};
    for (int side = 0; side < 2; ++side)
    {
      s.push_back(sampleAt(on_left - at, left, 1.0, side));
      s.push_back(sampleAt(on_right - at, right, 1.0, side));
    }
  }
  EXPECT_LT(angleBetween(fit(s, left), left), 1e-3);
  EXPECT_LT(angleBetween(fit(s, right), right), 0.02);
}

// Below a misfit of 1e-3 the last pass is left out: heights scattered by a little more or less give the same slope, of
// what is scattered.
TEST(NormalFit, scatterThatGrows_turnsTheNormalSteadily)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> scatter(-1.0, 1.0);
  std::vector<double> height;
  for (int i = 0; i < 14; ++i)
    height.push_back(scatter(random));
  double before = 0.0, largest_jump = 0.0;
  for (double size = 5e-4; size < 8e-3; size *= 1.001)
  {
    std::vector<FitSample> s;
    for (int i = 0; i < 14; ++i)
      s.push_back(sampleAt({0.45 * (i - 6), size * height[static_cast<std::size_t>(i)]}, {0.0, 1.0}, 0.6, i % 2));
    Vector2 const n = fit(s);
    double const turned = n[0] / size;
    largest_jump = std::max(largest_jump, before == 0.0 ? 0.0 : size * std::fabs(turned - before));
    before = turned;
  }
  EXPECT_LT(largest_jump, 2e-7);
}
