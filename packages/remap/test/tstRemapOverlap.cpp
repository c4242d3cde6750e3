// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

double one(int, Vector2 const &)
{
  return 1.0;
}

/// A material (-1: void) that fills the cells whose centres are inside of a box.
Layer cells(int material, double x0, double y0, double x1, double y1)
{
  return {material, [=](Vector2 const &c)
          {
            bool const inside = c[0] > x0 && c[0] < x1 && c[1] > y0 && c[1] < y1;
            return Plane2{{1.0, 0.0}, inside ? 1e3 : -1e3};
          }};
}

/// 8 x 8 cells of h = 1/8 in the unit square, open on all sides.
Scene openScene(std::vector<Layer> const &layers, std::vector<Vector2> const &velocity, bool about_axis = false)
{
  Scene scene(8, 8, 0.0, twoLaws());
  if (about_axis)
    scene.aboutAxis();
  Boundary out;
  out.kind = BoundaryKind::Outflow;
  scene.setBoundaries({out, out, out, out});
  scene.options.measure_overlap = true;
  scene.paint(layers, one, one);
  scene.move([=](int material, Vector2 const &) { return velocity[material]; });
  return scene;
}

constexpr double h = 0.125;

} // namespace

TEST(Overlap, squaresThatMeetAtAFace_shareWhatTheyAdvance)
{
  // 3 x 3 cells of material 0 beside 3 x 3 of material 1, each goes 0.1 h into the other.
  double const d = 0.1 * h;
  Scene scene =
      openScene({cells(0, 1 * h, 2 * h, 4 * h, 5 * h), cells(1, 4 * h, 2 * h, 7 * h, 5 * h)}, {{d, 0.0}, {-d, 0.0}});
  scene.remapped();
  EXPECT_NEAR(scene.report.moved_overlap.volume, 2.0 * d * 3.0 * h, 1e-16);
  EXPECT_NEAR(scene.report.moved_overlap.largest, 0.1, 1e-14);
  // The lowest of the six cells along the face.
  EXPECT_NEAR(scene.report.moved_overlap.place[0], 3.5 * h, 1e-15);
  EXPECT_NEAR(scene.report.moved_overlap.place[1], 2.5 * h, 1e-15);
  // What they claim beyond the cells is the same here: there was no void.
  EXPECT_NEAR(scene.report.overlap_volume, 2.0 * d * 3.0 * h, 1e-15);
}

TEST(Overlap, layersInOneCellBesideVoid_shareWhatNoVolumeShows)
{
  // x < 4.3 h and 4.4 h < x < 4.6 h: the first goes 0.15 h.
  Scene scene = openScene(
      {halfPlane(0, {4.3 * h, 0.0}, 0.0), halfPlane(-1, {4.4 * h, 0.0}, 0.0), halfPlane(1, {4.6 * h, 0.0}, 0.0)},
      {{0.15 * h, 0.0}, {0.0, 0.0}});
  scene.remapped();
  EXPECT_NEAR(scene.report.moved_overlap.volume, 0.05 * h, 1e-15);
  EXPECT_NEAR(scene.report.moved_overlap.largest, 0.05, 1e-14);
  EXPECT_EQ(scene.report.overlap_volume, 0.0);
}

TEST(Overlap, cellsThatMeetAtACorner_shareASquare)
{
  double const d = 0.1 * h;
  Scene scene =
      openScene({cells(0, 0, 0, 4 * h, 4 * h), cells(1, 4 * h, 4 * h, 8 * h, 8 * h)}, {{d, 2.0 * d}, {0.0, 0.0}});
  scene.remapped();
  EXPECT_NEAR(scene.report.moved_overlap.volume, 2.0 * d * d, 1e-16);
  EXPECT_NEAR(scene.report.moved_overlap.largest, 0.02, 1e-14);
  EXPECT_NEAR(scene.report.moved_overlap.place[0], 4.5 * h, 1e-15);
}

TEST(Overlap, bodiesOnBothSidesOfAnEmptyCell_meetWithinIt)
{
  double const d = 0.6 * h;
  Scene scene =
      openScene({cells(0, 1 * h, 2 * h, 3 * h, 4 * h), cells(1, 4 * h, 2 * h, 6 * h, 4 * h)}, {{d, 0.0}, {-d, 0.0}});
  scene.remapped();
  EXPECT_NEAR(scene.report.moved_overlap.volume, 0.2 * h * 2.0 * h, 1e-15);
  EXPECT_NEAR(scene.report.moved_overlap.largest, 0.2, 1e-14);
  EXPECT_NEAR(scene.report.moved_overlap.place[0], 3.5 * h, 1e-15);
}

TEST(Overlap, ofAClosedChord_isWhatItsMiddleSweeps)
{
  // x + y < 9.3 h and the rest. The node (4 h, 4 h) of the first moves towards the chord from (5, 4.3) h to (4.3, 5) h,
  // whose ends it does not move; N = 0.35^2 in the chord's middle, which counts half.
  double const u = 0.01 * h, quarter_turn = Math::pi / 4.0;
  Scene scene = openScene({halfPlane(0, {4.3 * h, 5.0 * h}, quarter_turn), rest(1)}, {{0.0, 0.0}, {0.0, 0.0}});
  scene.move(
      [=](int material, Vector2 const &x)
      {
        bool const moves = material == 0 && norm(x - Vector2{4.0 * h, 4.0 * h}) < 1e-12;
        return moves ? Vector2{u, u} : Vector2{0.0, 0.0};
      });
  scene.remapped();
  EXPECT_NEAR(scene.report.moved_overlap.volume, 0.5 * 0.1225 * (0.7 * std::sqrt(2.0) * h) * (std::sqrt(2.0) * u),
              1e-16);
}

TEST(Overlap, aboutAnAxis_isAVolume)
{
  // 4 h < r < 4.1 h, 3 cells high; the cell's volume is 4.5 h^3.
  Scene scene = openScene({cells(0, 1 * h, 2 * h, 4 * h, 5 * h), cells(1, 4 * h, 2 * h, 7 * h, 5 * h)},
                          {{0.1 * h, 0.0}, {0.0, 0.0}}, true);
  scene.remapped();
  double const section = 0.5 * (4.1 * 4.1 - 16.0) * h * h;
  EXPECT_NEAR(scene.report.moved_overlap.volume, section * 3.0 * h, 1e-16);
  EXPECT_NEAR(scene.report.moved_overlap.largest, section / (4.5 * h * h), 1e-14);
}

TEST(Overlap, ofARigidBody_isThatOfItsFilledRegions)
{
  Scene scene = sceneWithRigidBody(one);
  scene.options.measure_overlap = true;
  scene.move(
      [](int material, Vector2 const &x) {
        return x[0] > 0.0 && x[0] < 1.0 && material == 1 ? Vector2{-0.01, 0.0} : Vector2{0.0, 0.0};
      });
  scene.remapped();
  EXPECT_NEAR(scene.report.moved_overlap.volume, 0.01, 1e-15);
  EXPECT_NEAR(scene.report.moved_overlap.largest, 0.04, 1e-14);
}

TEST(Overlap, neighboursInOneRigidMotion_shareNothing)
{
  // Disc in a block of two materials on a random mesh; all turn and go.
  double worst = 0.0;
  for (double turn : {0.0, 0.01, 0.05})
  {
    Scene scene(24, 20, 0.2, twoLaws());
    Boundary out;
    out.kind = BoundaryKind::Outflow;
    scene.setBoundaries({out, out, out, out});
    scene.options.measure_overlap = true;
    scene.paint({disc(0, {0.45, 0.5}, 0.27), halfPlane(2, {0.5, 0.5}, 0.3), rest(1)}, wave, wave);
    scene.move(
        [=](int, Vector2 const &x) {
          return Vector2{0.01, -0.007} + turn * perpendicular(x - Vector2{0.4, 0.6});
        });
    scene.remapped();
    EXPECT_EQ(scene.report.failures, 0);
    worst = std::max(worst, scene.report.moved_overlap.volume);
  }
  std::printf("largest overlap %.2e\n", worst);
  EXPECT_LT(worst, 1e-15);
}

TEST(Overlap, measured_changesNoBit)
{
  auto const slip = [](int material, Vector2 const &x)
  {
    double const s = std::sin(Math::pi * x[0]) * std::sin(Math::pi * x[1]);
    return s * Vector2{0.011 + 0.004 * material, 0.009 * std::cos(3.0 * x[1]) - 0.005 * material};
  };
  Scene scene(24, 20, 0.2, twoLaws());
  scene.paint({disc(0, {0.45, 0.5}, 0.27), halfPlane(2, {0.5, 0.5}, 0.3), rest(1)}, wave, wave);
  scene.move(slip);
  RemapResult const without = scene.remapped();
  EXPECT_EQ(scene.report.moved_overlap.volume, 0.0);
  scene.options.measure_overlap = true;
  RemapResult const with = scene.remapped();
  EXPECT_GT(scene.report.moved_overlap.volume, scene.report.overlap_volume);
  EXPECT_EQ(differences(scene, with, without), 0);
}

TEST(Overlap, ofTheParts_addsUpToTheWhole)
{
  auto const slip = [](int material, Vector2 const &x)
  {
    double const s = std::sin(Math::pi * x[0]) * std::sin(Math::pi * x[1]);
    return s * Vector2{0.011 + 0.004 * material, 0.009 * std::cos(3.0 * x[1]) - 0.005 * material};
  };
  auto const measured = [&](std::vector<int> const &owner)
  {
    Scene scene(24, 20, 0.2, twoLaws());
    scene.options.measure_overlap = true;
    if (!owner.empty())
      scene.distribute(owner, 7);
    scene.paint({disc(0, {0.45, 0.5}, 0.27), halfPlane(2, {0.5, 0.5}, 0.3), rest(1)}, wave, wave);
    scene.move(slip);
    scene.remapped();
    return scene.report.moved_overlap;
  };
  MovedOverlap const whole = measured({});
  std::vector<int> left(24 * 20), right(24 * 20);
  for (int cell = 0; cell < 24 * 20; ++cell)
  {
    left[cell] = cell % 24 < 11 + (cell / 24) % 3 ? 0 : 1;
    right[cell] = 1 - left[cell];
  }
  MovedOverlap const a = measured(left), b = measured(right);
  EXPECT_NEAR(a.volume + b.volume, whole.volume, 1e-16);
  EXPECT_EQ(std::max(a.largest, b.largest), whole.largest);
  MovedOverlap const &larger = a.largest > b.largest ? a : b;
  EXPECT_EQ(larger.place[0], whole.place[0]);
  EXPECT_EQ(larger.place[1], whole.place[1]);
}
