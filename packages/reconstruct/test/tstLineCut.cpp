// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Clip.hpp>
#include <Harmos_MomentOfFluid.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace Harmos;

namespace
{

/// A convex polygon: points on an ellipse at sorted random angles, scaled to area one.
Region randomConvexPolygon(std::mt19937 &random, int size)
{
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  double angle[max_region_vertices], sum = 0.0;
  for (int i = 0; i < size; ++i)
    sum += angle[i] = uniform(random);
  double const aspect = uniform(random);
  Region polygon;
  double at = 0.0;
  for (int i = 0; i < size; ++i)
  {
    at += 2.0 * Math::pi * angle[i] / sum;
    polygon.push({std::cos(at), aspect * std::sin(at)});
  }
  double const scale = 1.0 / std::sqrt(area(polygon));
  for (int i = 0; i < size; ++i)
    polygon[i] *= scale;
  return polygon;
}

Vector2 direction(double angle)
{
  return {std::cos(angle), std::sin(angle)};
}

Region unitSquare()
{
  Region square;
  square.push({0.0, 0.0});
  square.push({1.0, 0.0});
  square.push({1.0, 1.0});
  square.push({0.0, 1.0});
  return square;
}

} // namespace

TEST(LineCut, tinyFractions_lowestVertexAtOrigin_volumeKeepsRelativeAccuracy)
{
  Region const square = unitSquare();
  for (double const volume : {1e-3, 1e-6, 1e-9, 1e-12})
  {
    for (double const angle : {225.0, 180.0, 200.0, 270.0})
    {
      Vector2 const normal = -direction(angle * Math::pi / 180.0);
      LineCut const cut = lineCut(square, normal, volume);
      EXPECT_NEAR(area(partBelow(square, cut)) / volume, 1.0, 1e-12) << volume << " at " << angle;
    }
  }
}

TEST(LineCut, bothPartsTogether_areThePolygonAndShareTheChord)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 2000; ++i)
  {
    Region const polygon = randomConvexPolygon(random, 3 + i % 8);
    double const inside = uniform(random);
    Division const division = divide(polygon, direction(7.0 * uniform(random)), inside, 1.0 - inside);
    EXPECT_NEAR(area(division.inside), inside, 1e-14);
    EXPECT_NEAR(area(division.inside) + area(division.outside), 1.0, 1e-14);
    EXPECT_EQ(division.inside.size + division.outside.size, polygon.size + 4);
  }
}

TEST(MomentOfFluid, cutsOfConvexPolygons_areFoundFromTheirCentroids)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double worst = 0.0;
  int iterations = 0, most = 0;
  int const count = 20000;
  for (int i = 0; i < count; ++i)
  {
    Region const polygon = randomConvexPolygon(random, 3 + i % 4);
    double const volume = i % 2 == 0 ? 0.5 * uniform(random) + 1e-3 : std::pow(10.0, -3.0 * uniform(random) - 0.302);
    Vector2 const normal = direction(2.0 * Math::pi * uniform(random));
    Region const part = partBelow(polygon, lineCut(polygon, normal, volume));
    Vector2 const centroid = polygon[0] + moments<1>(part, polygon[0]).centroid();
    MomentOfFluidLine const line = momentOfFluidLine(polygon, volume, centroid);
    // The area between the two lines in the polygon.
    Region const found = partBelow(polygon, lineCut(polygon, line.normal, volume));
    Region common;
    clipConvex(part, found, common);
    double const misplaced = volume - area(common);
    EXPECT_LT(misplaced, 1e-12) << i << " volume " << volume << " error " << std::sqrt(line.squared_error);
    worst = std::max(worst, misplaced);
    iterations += line.iterations;
    most = std::max(most, line.iterations);
  }
  std::printf("misplaced volume %.2e; cuts evaluated: mean %.2f, most %d\n", worst, double(iterations) / count, most);
}
