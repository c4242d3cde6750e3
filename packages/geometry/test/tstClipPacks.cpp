// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <Harmos_ClipPacks.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace Harmos;

namespace
{

struct Overlay
{
  Moments<2> moments;
  double pieces;
};

/// Overlays with the 3 x 3 unit cells around the unit square, moments about (0, 0).
template <int Capacity>
std::vector<Overlay> overlaysInPacks(Polygon<Capacity> const &donor)
{
  double x[most_pack_vertices], y[most_pack_vertices];
  for (int i = 0; i < donor.size; ++i)
  {
    x[i] = donor[i][0];
    y[i] = donor[i][1];
  }
  std::vector<Overlay> overlays;
  for (int first = 0; first < 9; first += pack_width)
  {
    WindowPack w;
    for (int k = 0; k < 4; ++k)
    {
      double const dx = k == 1 || k == 2 ? 1.0 : 0.0, dy = k >= 2 ? 1.0 : 0.0;
      w.x[k] = packOf([&](int lane) { return (first + lane) % 3 - 1.0 + dx; });
      w.y[k] = packOf([&](int lane) { return Math::floor((first + lane) / 3 - 1.0) + dy; });
    }
    OverlayPack const m = momentsInWindows(donor.size, x, y, w);
    for (int lane = 0; lane < pack_width && first + lane < 9; ++lane)
    {
      Overlay overlay;
      for (int i = 0; i < Moments<2>::count; ++i)
        overlay.moments.value[i] = laneOf(m.value[i], lane);
      overlay.pieces = laneOf(m.pieces, lane);
      overlays.push_back(overlay);
    }
  }
  return overlays;
}

template <int Capacity>
Moments<2> clippedMoments(Polygon<Capacity> const &donor, int number)
{
  double const i = number % 3 - 1.0, j = number / 3 - 1.0;
  Region overlay;
  clipConvex(donor, box(i, j, i + 1.0, j + 1.0), overlay);
  return overlay.empty() ? Moments<2>() : moments<2>(overlay, Vector2{0.0, 0.0});
}

void expectClosure(Quadrilateral const &donor)
{
  Moments<2> const whole = moments<2>(donor, Vector2{0.0, 0.0});
  Moments<2> sum;
  for (Overlay const &overlay : overlaysInPacks(donor))
    sum += overlay.moments;
  for (int i = 0; i < Moments<2>::count; ++i)
    EXPECT_NEAR(whole.value[i], sum.value[i], 1e-14);
}

} // namespace

TEST(ClipPacks, movedSquares_haveTheMomentsOfTheClippedPolygons)
{
  Random random(7);
  for (int trial = 0; trial < 20000; ++trial)
  {
    Quadrilateral const donor = movedSquare(random, 0.25);
    std::vector<Overlay> const overlays = overlaysInPacks(donor);
    for (int number = 0; number < 9; ++number)
    {
      Moments<2> const expected = clippedMoments(donor, number);
      EXPECT_LE(overlays[number].pieces, 1.0);
      for (int i = 0; i < Moments<2>::count; ++i)
        EXPECT_NEAR(overlays[number].moments.value[i], expected.value[i], 2e-15);
    }
  }
}

TEST(ClipPacks, overlaysOfMovedSquares_sumToTheWhole)
{
  Random random(8);
  for (int trial = 0; trial < 1100000; ++trial)
    expectClosure(movedSquare(random, 0.25));
}

TEST(ClipPacks, sharedEdgesAndSlivers_loseNothing)
{
  expectClosure(box(0.0, 0.0, 1.0, 1.0));
  EXPECT_EQ(overlaysInPacks(box(0.0, 0.0, 1.0, 1.0))[4].moments.volume(), 1.0);
  EXPECT_EQ(overlaysInPacks(box(0.0, 0.0, 1.0, 1.0))[5].moments.volume(), 0.0);
  Random random(9);
  for (double width : {1e-15, 1e-12, 1e-6, 1e-2})
    for (int trial = 0; trial < 20000; ++trial)
    {
      double const low = trial % 3 == 0 ? 1.0 - width : uniform(random, -0.5, 1.0);
      expectClosure(box(low, 0.0, low + width, 1.0));
      Quadrilateral turned = box(0.0, -0.3, width, 1.3);
      double const lean = trial % 2 == 0 ? width * uniform(random, -2.0, 2.0) : uniform(random, -0.4, 0.4);
      turned[2][0] += lean;
      turned[3][0] += lean;
      expectClosure(turned);
    }
}

TEST(ClipPacks, sideThatCutsABentPolygonIntoPieces_isTold)
{
  // A notch from above down to y = 0.4: the cells above the line y = 1 get two teeth.
  Polygon<8> const notched{7, {{0.1, 0.2}, {0.9, 0.2}, {0.9, 1.3}, {0.6, 1.3}, {0.5, 0.4}, {0.4, 1.3}, {0.1, 1.3}}};
  std::vector<Overlay> const overlays = overlaysInPacks(notched);
  EXPECT_GT(overlays[4].pieces, 1.0);
  EXPECT_GT(overlays[7].pieces, 1.0);
  // Wholly inside: nothing is cut.
  Polygon<8> low = notched;
  for (int i = 0; i < low.size; ++i)
    low[i][1] *= 0.5;
  Overlay const whole = overlaysInPacks(low)[4];
  EXPECT_LE(whole.pieces, 1.0);
  EXPECT_NEAR(whole.moments.volume(), moments<1>(low, Vector2{0.0, 0.0}).volume(), 1e-15);
}
