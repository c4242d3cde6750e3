// SPDX-License-Identifier: BSD-3-Clause
#include "RigidWedge.hpp"

#include <Harmos_BridgedRegion.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

/// Where the corner of the notch lies.
enum class CornerAt
{
  InCell,
  Below // the cell has both sides, which do not meet in it
};

/// A rigid wall, of 0.7 to 2 cells or without end, has a notch with straight sides. A fluid that has lost or gained a
/// millionth of the cell fills it, or part of it below void.
void expectExactNotches(Geometry geometry, bool with_void, CornerAt corner)
{
  constexpr double least = 2e-3, most_wrong = 1e-6; // of the cell
  constexpr int middle = 3 * 7 + 3;
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int looked_at = 0, exact = 0, in_two = 0;
  double worst = 0.0;
  for (int i = 0; i < 600; ++i)
  {
    Place const place(geometry, i);
    Vector2 tip = place.inMiddleCell(random);
    double const ahead = 360.0 * unit(random), half_angle = 30.0 + 40.0 * unit(random);
    Vector2 const outward = halfPlane(ahead, tip).normal;
    if (corner == CornerAt::Below)
      tip += (unit(random) / 7.0) * outward;
    double const thickness = i % 3 == 0 ? 10.0 : (0.7 + 1.3 * unit(random)) / 7.0;
    double const deep = (0.2 + 0.8 * unit(random)) / 7.0, tilt = 40.0 * (unit(random) - 0.5);
    int const rigid = i / 2 % 2; // material
    auto const wedgeAt = [&](Vector2 const &point) {
      return Body{halfPlane(ahead - 90.0 + half_angle, point), halfPlane(ahead + 90.0 - half_angle, point)};
    };
    Vector2 const outer_tip = tip + (thickness / std::sin(half_angle * Math::pi / 180.0)) * outward;
    Body const notch = wedgeAt(tip), outline = wedgeAt(outer_tip);
    Body fluid = notch;
    if (with_void)
      fluid.push_back(halfPlane(ahead + 180.0 + tilt, tip - deep * outward));
    auto const momentsOfPart = [&](Quadrilateral const &quad, Body const &body)
    { return moments<1>(intersection(quad, body), quad[0], areaWeight(geometry, quad[0])); };
    auto const fills = [&](int, Quadrilateral const &quad)
    {
      Moments<1> const all = momentsOfPart(quad, outline), in_notch = momentsOfPart(quad, notch),
                       of_fluid = momentsOfPart(quad, fluid);
      double const of_rigid = all.volume() - in_notch.volume();
      double const change = with_void ? 0.0 : (unit(random) - 1.0) * 1e-6 * volume(quad, geometry);
      std::vector<Fill> found;
      if (of_fluid.volume() + change > 0.0)
        found.push_back({1 - rigid, of_fluid.volume() + change, quad[0] + of_fluid.centroid()});
      if (of_rigid > 1e-13 * volume(quad, geometry))
        found.insert(found.begin() + (rigid == 1 ? static_cast<int>(found.size()) : 0),
                     Fill{rigid, of_rigid,
                          quad[0] + (1.0 / of_rigid) *
                                        Vector2{all.first(0) - in_notch.first(0), all.first(1) - in_notch.first(1)}});
      return found;
    };
    Quadrilateral const cell =
        hostQuadrilateral(onHost(place.mesh.node_position), onHost(place.mesh.cell_node), middle);
    double const size = area(cell), own = area(intersection(cell, notch));
    bool const meet = area(intersection(cell, {opposite(notch[0]), opposite(notch[1])})) > least * size;
    double const beyond[2] = {area(intersection(cell, {opposite(notch[0])})),
                              area(intersection(cell, {opposite(notch[1])}))};
    double const wet = area(intersection(cell, fluid));
    if (std::min({beyond[0], beyond[1], own, wet}) < least * size || meet != (corner == CornerAt::InCell) ||
        size - area(intersection(cell, outline)) > 1e-12 || (with_void && own - wet < least * size))
      continue;
    ++looked_at;
    std::vector<Vector2> const inner = wedgeSides(tip, ahead, half_angle),
                               outer = wedgeSides(outer_tip, ahead, half_angle);
    std::vector<Vector2> const rim{outer_tip, outer[0], inner[0], tip, inner[1], outer[1]};
    Scene const scene = paint(place.mesh, fills);
    FilledRegions const regions = reconstructed(
        scene, 1e-6, ReconstructionMethod::MomentOfFluid, deviceCopy("fluid", std::vector<int>{rigid, 1 - rigid}),
        deviceCopy("exact", std::vector<int>{1 - rigid, rigid}), cornersOf(place.mesh, rim, rigid));
    auto const region = onHost(regions.polygon);
    int const first = onHost(regions.cell_region)(middle);
    Region const &r = region(first + rigid), &f = region(first + 1 - rigid);
    double const wrong = std::max(area(intersection(r, notch)), area(f) - area(intersection(f, fluid))) / size;
    int bridges = 0;
    for (int k = 0; k < r.size; ++k)
      bridges += isBridge(r, k) ? 1 : 0;
    in_two += bridges == 2 ? 1 : 0;
    EXPECT_TRUE(bridges == 0 || bridges == 2);
    exact += wrong < most_wrong ? 1 : 0;
    worst = std::max(worst, wrong);
  }
  std::printf("%d of %d notches exact, %d of them in two parts, misplaced volume at most %.1e\n", exact, looked_at,
              in_two, worst);
  EXPECT_GT(looked_at, 60);
  EXPECT_GE(exact, 0.99 * looked_at);
  EXPECT_GE(in_two, corner == CornerAt::Below ? looked_at / 2 : 0);
}

} // namespace

TEST(ReconstructNotches, fullOnes_areExact)
{
  expectExactNotches(Geometry::Planar, false, CornerAt::InCell);
}

TEST(ReconstructNotches, partlyFilledOnes_areExact)
{
  expectExactNotches(Geometry::Planar, true, CornerAt::InCell);
}

TEST(ReconstructNotches, bothSidesOfOnes_areExact)
{
  expectExactNotches(Geometry::Planar, false, CornerAt::Below);
}

TEST(ReconstructNotches, aboutAnAxis_areExact)
{
  expectExactNotches(Geometry::Axisymmetric, false, CornerAt::InCell);
  expectExactNotches(Geometry::Axisymmetric, false, CornerAt::Below);
}
