// SPDX-License-Identifier: BSD-3-Clause
#include "RigidWedge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

constexpr double sliver = 1e-6;

/// A rigid body ends in a corner inside of another body, which void may bound behind the tip: a face with a dent.
/// \param with_void Or the other one fills the rest.
void expectExactDents(Geometry geometry, bool with_void)
{
  constexpr double least = 2e-3; // of the cell: what is smaller goes by its neighbours
  constexpr int middle = 3 * 7 + 3;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int looked_at = 0, exact = 0;
  double worst = 0.0;
  for (int i = 0; i < 300; ++i)
  {
    Place const place(geometry, i);
    Vector2 const tip = place.inMiddleCell(random);
    double const ahead = 360.0 * unit(random), half_angle = 20.0 + 50.0 * unit(random);
    double const tilt = with_void ? (unit(random) - 0.5) * (90.0 - half_angle) : 0.0;
    double const deep = with_void ? 0.3 * unit(random) / 7.0 : 1e3;
    int const rigid = i / 2 % 2; // material
    Body const wedge{halfPlane(ahead - 90.0 + half_angle, tip), halfPlane(ahead + 90.0 - half_angle, tip)};
    Plane2 const face = halfPlane(ahead + tilt + 180.0, tip - deep * halfPlane(ahead + tilt, tip).normal);
    // All on the block's side of the face, and that without the wedge.
    auto const momentsOfPart = [&](Quadrilateral const &quad, Body const &body)
    { return moments<1>(intersection(quad, body), quad[0], areaWeight(geometry, quad[0])); };
    auto const fills = [&](int, Quadrilateral const &quad)
    {
      Body dent = wedge;
      dent.push_back(face);
      Moments<1> const whole = momentsOfPart(quad, {face}), inside = momentsOfPart(quad, wedge),
                       taken = momentsOfPart(quad, dent);
      double const left = whole.volume() - taken.volume();
      std::vector<Fill> found;
      if (left > 1e-13 * whole.volume())
        found.push_back(
            {1 - rigid, left,
             quad[0] + (1.0 / left) * Vector2{whole.first(0) - taken.first(0), whole.first(1) - taken.first(1)}});
      if (inside.volume() > 0.0)
        found.insert(found.begin() + (rigid == 1 ? static_cast<int>(found.size()) : 0),
                     Fill{rigid, inside.volume(), quad[0] + inside.centroid()});
      return found;
    };
    std::vector<Vector2> const sides = wedgeSides(tip, ahead, half_angle);
    Scene const scene = paint(place.mesh, fills);
    auto const offset = onHost(scene.pairs.offset);
    auto const material = onHost(scene.pairs.material);
    auto const record = onHost(scene.state.record);
    double const first_part = offset(middle + 1) - offset(middle) == 2 ? record(offset(middle), VolumeFraction) : 0.0;
    double const second_part = first_part > 0.0 ? record(offset(middle) + 1, VolumeFraction) : 0.0;
    double const open = 1.0 - first_part - second_part;
    if (std::min(first_part, second_part) < least || (with_void ? open < least : std::fabs(open) > 1e-12))
      continue;
    // A wedge as wide as the cell at its face would leave the other one in two parts.
    ++looked_at;
    FilledRegions const regions = reconstructed(scene, sliver, ReconstructionMethod::MomentOfFluid, {},
                                                deviceCopy("exact", std::vector<int>{1 - rigid, rigid}),
                                                cornersOf(place.mesh, {tip, sides[0], sides[1]}, rigid));
    auto const region = onHost(regions.polygon);
    int const first = onHost(regions.cell_region)(middle);
    double wrong = 0.0;
    for (int k = 0; k < 2; ++k)
    {
      Region const &r = region(first + k);
      wrong = std::max(wrong, material(offset(middle) + k) == rigid
                                  ? area(r) - area(intersection(r, wedge))
                                  : area(intersection(r, wedge)) + area(r) - area(intersection(r, {face})));
    }
    exact += 49.0 * wrong < 1e-7 ? 1 : 0;
    worst = std::max(worst, 49.0 * wrong);
  }
  std::printf("%d of %d dents exact, misplaced volume at most %.1e\n", exact, looked_at, worst);
  EXPECT_GT(looked_at, 100);
  EXPECT_GE(exact, 0.97 * looked_at);
}

} // namespace

TEST(ReconstructDents, rigidCornersInsideOfASolid_areExact)
{
  expectExactDents(Geometry::Planar, false);
}

TEST(ReconstructDents, rigidCornersThatDentAFace_areExact)
{
  expectExactDents(Geometry::Planar, true);
}

TEST(ReconstructDents, rigidCornersThatDentAFaceAboutAnAxis_areExact)
{
  expectExactDents(Geometry::Axisymmetric, true);
}
