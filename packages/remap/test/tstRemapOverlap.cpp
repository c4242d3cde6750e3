// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

#include <array>

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

/// The scene with matter that has flowed, to be parted.
Scene flowed(Scene scene, double strain = 0.2)
{
  scene.options.part_overlaps = true;
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
    scene.state.record(pair, PlasticStrain) = strain;
  return scene;
}

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
  ResultOnHost const without = scene.remapped();
  EXPECT_EQ(scene.report.moved_overlap.volume, 0.0);
  scene.options.measure_overlap = true;
  ResultOnHost const with = scene.remapped();
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
    scene = flowed(scene);
    scene.remapped();
    return std::array<MovedOverlap, 2>{scene.report.moved_overlap, scene.report.remapped_overlap};
  };
  auto const whole_of = measured({});
  std::vector<int> left(24 * 20), right(24 * 20);
  for (int cell = 0; cell < 24 * 20; ++cell)
  {
    left[cell] = cell % 24 < 11 + (cell / 24) % 3 ? 0 : 1;
    right[cell] = 1 - left[cell];
  }
  auto const left_of = measured(left), right_of = measured(right);
  for (int i = 0; i < 2; ++i)
  {
    MovedOverlap const &a = left_of[i], &b = right_of[i], &whole = whole_of[i];
    EXPECT_NEAR(a.volume + b.volume, whole.volume, 1e-16);
    EXPECT_EQ(std::max(a.largest, b.largest), whole.largest);
    MovedOverlap const &larger = a.largest > b.largest ? a : b;
    EXPECT_EQ(larger.place[0], whole.place[0]);
    EXPECT_EQ(larger.place[1], whole.place[1]);
  }
  EXPECT_LT(whole_of[1].volume, whole_of[0].volume);
}

TEST(PartedRegions, squaresThatPassEachOther_keepTheirMass_andShareNothing)
{
  // Both have gone 0.1 h into each other, the left one 0.4 h up the face.
  double const d = 0.1 * h, shared = 2.0 * d * (3.0 * h - 4.0 * d);
  Scene scene = flowed(openScene({cells(0, 1 * h, 2 * h, 4 * h, 5 * h), cells(1, 4 * h, 2 * h, 7 * h, 5 * h)},
                                 {{d, 4.0 * d}, {-d, 0.0}}));
  for (bool const parts : {false, true})
  {
    scene.options.part_overlaps = parts;
    ResultOnHost const result = scene.remapped();
    EXPECT_NEAR(scene.report.moved_overlap.volume, shared, 1e-16);
    EXPECT_NEAR(scene.report.remapped_overlap.volume, parts ? 0.0 : shared, 1e-16);
    for (int m = 0; m < 2; ++m)
      EXPECT_NEAR(totals(scene.mesh, result.pairs, result.state.record, result.state.velocity, m).mass,
                  totals(scene.mesh, scene.pairs, scene.state.record, scene.half, m).mass, 1e-15);
  }
}

TEST(PartedRegions, ofWhatCreeps_orHasNotFlowed_orComesStraightOn_areNone)
{
  auto const parted = [](Vector2 const &left, Vector2 const &right, double strain)
  {
    Scene scene = flowed(
        openScene({cells(0, 1 * h, 2 * h, 4 * h, 5 * h), cells(1, 4 * h, 2 * h, 7 * h, 5 * h)}, {left, right}), strain);
    scene.remapped();
    EXPECT_GT(scene.report.moved_overlap.volume, 0.0);
    return scene.report.remapped_overlap.volume < scene.report.moved_overlap.volume;
  };
  double const d = 0.01 * h;
  EXPECT_TRUE(parted({d, 0.4 * h}, {-d, 0.0}, 0.2));
  EXPECT_FALSE(parted({d, 0.4 * h}, {-d, 0.0}, 0.09)); // has not flowed
  EXPECT_FALSE(parted({d, 0.0}, {-d, 0.0}, 0.2));      // straight on
  EXPECT_TRUE(parted({0.001 * h, 0.0049 * h}, {-0.001 * h, 0.0}, 0.2));
  EXPECT_FALSE(parted({0.001 * h, 0.0044 * h}, {-0.001 * h, 0.0}, 0.2)); // apart by less than 0.005 cells
}

TEST(PartedRegions, ofLessThan1e4OfACell_areNone)
{
  // A film beside a block goes half of its thickness into it, and up along it.
  auto const parted = [](double thickness)
  {
    double const x = (4.0 - thickness) * h;
    Scene scene = flowed(openScene(
        {halfPlane(-1, {x, 0.0}, 0.0), halfPlane(0, {4.0 * h, 0.0}, 0.0), cells(1, 4.0 * h, 0.0, 8.0 * h, 8.0 * h)},
        {{0.5 * thickness * h, 0.4 * h}, {0.0, 0.0}}));
    scene.remapped();
    EXPECT_GT(scene.report.moved_overlap.volume, 0.0) << thickness;
    return scene.report.remapped_overlap.volume < 0.01 * scene.report.moved_overlap.volume;
  };
  EXPECT_TRUE(parted(2.0e-4));
  EXPECT_FALSE(parted(0.9e-4));
}

TEST(PartedRegions, ofADiscThatTurnsInABlock_conserveAll)
{
  // The facets of its rim run into those of the block: as an impulse could not, parting takes nearly all of that away.
  for (int order : {1, 2, 3})
    for (bool const about_axis : {false, true})
    {
      Scene scene(24, 20, 0.0, twoLaws());
      if (about_axis)
        scene.aboutAxis();
      scene.options.order = order;
      scene.options.measure_overlap = true;
      scene.paint({disc(0, {0.5, 0.5}, 0.27), rest(1)}, wave, wave);
      scene.move(
          [](int material, Vector2 const &x) {
            return material == 0 ? 0.08 * perpendicular(x - Vector2{0.5, 0.5}) : Vector2{0.0, 0.0};
          });
      scene = flowed(scene);
      ResultOnHost const result = scene.remapped();
      EXPECT_GT(scene.report.moved_overlap.volume, 1e-4);
      EXPECT_LT(scene.report.remapped_overlap.volume, 0.1 * scene.report.moved_overlap.volume);
      EXPECT_EQ(scene.report.failures, 0);
      for (int m = 0; m < 2; ++m)
      {
        Totals const b = totals(scene.mesh, scene.pairs, scene.state.record, scene.half, m);
        Totals const a = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity, m);
        EXPECT_NEAR(a.mass, b.mass, 1e-14 * b.mass);
        EXPECT_NEAR(a.internal, b.internal, 1e-14 * b.internal);
        EXPECT_NEAR(a.thermodynamic_volume, b.thermodynamic_volume, 1e-14 * b.thermodynamic_volume);
      }
      Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
      Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
      double const scale = std::sqrt(2.0 * before.mass * before.kinetic);
      for (int d = 0; d < 2; ++d)
        EXPECT_NEAR(after.momentum[d] - scene.report.wall_impulse[d], before.momentum[d], 1e-14 * scale);
    }
}
