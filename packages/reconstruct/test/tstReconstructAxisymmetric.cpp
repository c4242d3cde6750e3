// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructScene.hpp"

#include <Harmos_LineCut.hpp>
#include <Harmos_MomentOfFluid.hpp>

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

double misplaced(ReconstructionMethod method, double sliver, double left, double degrees, double *volume_error)
{
  Mesh const mesh = ringMesh(8, left, 0.25, 5);
  Vector2 const point{left + 0.47, 0.53};
  std::vector<Testing::Body> const both{{halfPlane(degrees, point)}, {halfPlane(degrees + 180.0, point)}};
  Testing::Scene const scene = paint(mesh, bodies(both, Geometry::Axisymmetric));
  ReconstructionOptions options;
  options.method = method;
  options.sliver = sliver;
  ReconstructionReport report;
  FilledRegions const regions = reconstruct(scene.mesh, scene.pairs, scene.state, options, report);
  EXPECT_EQ(report.failures, 0);
  EXPECT_EQ(report.unfinished_cells, 0);
  *volume_error = std::max(*volume_error, report.largest_volume_error);
  return misplacedVolume(scene, regions, both);
}

} // namespace

TEST(ReconstructAxisymmetric, StraightInterfacesByMomentOfFluid_areExactAtAnyRadius)
{
  double volume_error = 0.0;
  for (double const left : {0.0, 0.3, 10.0})
    for (int degrees = 3; degrees < 360; degrees += 31)
      EXPECT_LT(misplaced(ReconstructionMethod::MomentOfFluid, 1e-3, left, degrees, &volume_error), 1e-10)
          << left << " " << degrees;
  EXPECT_LT(volume_error, 1e-13);
}

TEST(ReconstructAxisymmetric, StraightInterfacesByLeastSquares_areExactAtAnyRadius)
{
  double volume_error = 0.0;
  for (double const left : {0.0, 0.3, 10.0})
    for (int degrees = 3; degrees < 360; degrees += 31)
      EXPECT_LT(misplaced(ReconstructionMethod::MomentOfFluid, 1.0, left, degrees, &volume_error), 1e-9)
          << left << " " << degrees;
  EXPECT_LT(volume_error, 1e-13);
}

TEST(ReconstructAxisymmetric, Youngs_hasExactVolumes)
{
  double volume_error = 0.0;
  misplaced(ReconstructionMethod::Youngs, 1e-3, 0.0, 34.0, &volume_error);
  EXPECT_LT(volume_error, 1e-13);
}

TEST(ReconstructAxisymmetric, LineCutOfRandomRings_cutsOffTheVolumeDownToTinyOnes)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 20000; ++trial)
  {
    Region cell;
    // every other one touches the axis, where the weight vanishes
    double const left = trial % 2 == 0 ? 0.0 : 2.0 * unit(random);
    cell.push({left, 0.0});
    cell.push({left + 1.0 + 0.3 * unit(random), 0.2 * unit(random)});
    cell.push({left + 1.0, 1.0 + 0.3 * unit(random)});
    cell.push({left + (trial % 4 == 0 ? 0.0 : 0.2 * unit(random)), 1.0});
    double const angle = trial % 7 == 0 ? 0.5 * Math::pi * (trial % 4) : 2.0 * Math::pi * unit(random);
    Vector2 const normal{std::cos(angle), std::sin(angle)};
    AreaWeight const weight = areaWeight(Geometry::Axisymmetric, {0.0, 0.0});
    double const whole = volume(cell, Geometry::Axisymmetric);
    double const part = std::pow(10.0, -12.0 * unit(random));
    LineCut const cut = lineCut(cell, normal, part * whole, weight);
    EXPECT_TRUE(cut.converged);
    double const got = moments<0>(partBelow(cell, cut), cut.begin, {weight.at(cut.begin), weight.slope}).volume();
    ASSERT_NEAR(got, part * whole, 1e-13 * whole) << trial << " " << part;
    ASSERT_NEAR(got / (part * whole), 1.0, 1e-3) << trial << " " << part;
  }
}

TEST(ReconstructAxisymmetric, TurningTheLineOfARing_keepsTheVolumeAndMovesTheCentroidAtTheGivenRate)
{
  Region cell;
  for (Vector2 const &p : {Vector2{0.0, 0.0}, Vector2{1.1, 0.1}, Vector2{0.9, 1.2}, Vector2{0.0, 1.0}})
    cell.push(p);
  AreaWeight const weight = areaWeight(Geometry::Axisymmetric, {0.2, 0.0});
  double const volume = 0.3, step = 1e-5;
  for (int i = 0; i < 12; ++i)
  {
    double const angle = 0.1 + 0.5 * i;
    auto const cutAt = [&](double a) {
      return Detail::turningCut(cell, Vector2{std::cos(a), std::sin(a)}, volume, weight);
    };
    Vector2 const along = perpendicular(Vector2{std::cos(angle), std::sin(angle)});
    Vector2 const moved = (0.5 / step) * (cutAt(angle + step).centroid - cutAt(angle - step).centroid);
    EXPECT_NEAR(-dot(moved, along), cutAt(angle).rate, 1e-8);
  }
}
