// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructScene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

/// Three wedges around a point, each a third of the plane; with `with_void` the last one is left empty.
std::vector<Body> thirds(Vector2 const &point, double degrees, bool with_void)
{
  std::vector<Body> all;
  for (int k = 0; k < (with_void ? 2 : 3); ++k)
    all.push_back({halfPlane(degrees + 120.0 * k - 30.0, point), halfPlane(degrees + 120.0 * k + 30.0, point)});
  return all;
}

/// Misplaced parts of the worst cell and of the second worst, summed over their pairs.
std::pair<double, double> twoWorstCells(Scene const &scene, FilledRegions const &regions, std::vector<Body> const &all)
{
  std::vector<double> sum(2, 0.0);
  for (auto const &[cell, misplaced] : misplacedByCell(scene, regions, all))
    sum.push_back(std::accumulate(misplaced.begin(), misplaced.end(), 0.0));
  std::sort(sum.begin(), sum.end());
  return {sum.back(), sum[sum.size() - 2]};
}

} // namespace

//    \ 1 /     Lines cut one component after the other off a cell: they follow a T, not a Y. The Y's own cell is the
//   2 \ /  0   only one that is not exact, and how wrong it may be is measured.
//      |
TEST(ReconstructJunctions, yOfThreeMaterialsOrTwoAndVoid_onlyItsOwnCellIsNotExact)
{
  double worst = 0.0;
  for (bool const with_void : {false, true})
    for (int i = 0; i < 60; ++i)
    {
      Mesh const mesh = makeMesh(6, 6, 0.5, i % 2 == 0 ? 0.0 : 0.2, 20 + i);
      Vector2 const point{1.3 + 0.013 * (i % 7), 1.4 + 0.017 * (i % 11)};
      std::vector<Body> const all = thirds(point, 6.1 * i, with_void);
      Scene const scene = paint(mesh, bodies(all));
      std::pair<double, double> const misplaced = twoWorstCells(scene, reconstructed(scene, 0.0), all);
      EXPECT_LT(misplaced.second, 1e-12) << i;
      EXPECT_LT(misplaced.first, 0.1) << i;
      worst = std::max(worst, misplaced.first);
    }
  std::printf("misplaced part of the cell: at most %.3f\n", worst);
}

TEST(ReconstructJunctions, yAtANodeOfTheMesh_isExact)
{
  Mesh const mesh = makeMesh(6, 6, 1.0);
  for (double const angle : {30.0, 90.0, 150.0})
  {
    std::vector<Body> const all = thirds({3.0, 3.0}, angle, false);
    Scene const scene = paint(mesh, bodies(all));
    EXPECT_LT(misplacedVolume(scene, reconstructed(scene, 0.0), all), 1e-12) << angle;
  }
}

TEST(ReconstructJunctions, tOfThreeMaterials_isExactWhateverTheirNumbers)
{
  std::mt19937 random(29);
  for (int i = 0; i < 60; ++i)
  {
    Mesh const mesh = makeMesh(6, 6, 0.5, 0.2, 40 + i);
    Vector2 const corner{1.3 + 0.013 * (i % 7), 1.4 + 0.017 * (i % 11)};
    Plane2 const base = halfPlane(6.1 * i + 90.0, corner), side = halfPlane(6.1 * i + 20.0 * (i % 3), corner);
    std::vector<Body> all{{base}, {opposite(base), side}, {opposite(base), opposite(side)}};
    std::shuffle(all.begin(), all.end(), random);
    Scene const scene = paint(mesh, bodies(all));
    EXPECT_LT(misplacedVolume(scene, reconstructed(scene, 0.0), all), 1e-12) << i;
  }
}

// A filament of width w of a cell between two materials, or a body between a material and void: least squares too.
TEST(ReconstructJunctions, filamentThinnerThanACellBetweenTwoOthers_isExact)
{
  double worst[2] = {0.0, 0.0};
  int i = 0;
  for (double const width : {0.9, 0.5, 0.2, 0.05, 0.01, 1e-3})
    for (double angle = 1.0; angle < 360.0; angle += 31.7, ++i)
      for (bool const with_void : {false, true})
      {
        Mesh const mesh = makeMesh(9, 9, 1.0, 0.2, 60 + i);
        Plane2 const lower = halfPlane(angle, {4.4, 4.6});
        Plane2 const upper{-lower.normal, -lower.offset - width};
        std::vector<Body> all{{opposite(lower), opposite(upper)}, {lower}};
        if (!with_void)
          all.insert(all.begin() + i % 3, Body{upper});
        Scene const scene = paint(mesh, bodies(all));
        // In a corner of the mesh three neighbours do not tell least squares where a foil lies.
        double const bound[2] = {1e-12, width < 0.01 ? width : 1e-12};
        for (int method = 0; method < 2; ++method)
        {
          double const misplaced = misplacedVolume(scene, reconstructed(scene, method == 0 ? 0.0 : 1.0), all);
          EXPECT_LT(misplaced, bound[method]) << "width " << width << " angle " << angle;
          if (width >= 0.01)
            worst[method] = std::max(worst[method], misplaced);
        }
      }
  std::printf("misplaced volume: moment of fluid %.1e, least squares %.1e\n", worst[0], worst[1]);
}

// Void on both sides is one component, on one side of one line: the filament is not followed, but none of it is lost.
TEST(ReconstructJunctions, filamentInVoid_keepsItsVolumeInEveryCell)
{
  for (double const width : {0.5, 0.1, 1e-3, 1e-6})
    for (double angle = 1.0; angle < 180.0; angle += 31.7)
    {
      Mesh const mesh = makeMesh(9, 9, 1.0, 0.2, 80);
      Plane2 const lower = halfPlane(angle, {4.4, 4.6});
      std::vector<Body> const all{{{lower.normal, lower.offset + width}, opposite(lower)}};
      Scene const scene = paint(mesh, bodies(all));
      for (double const sliver : {0.0, 1e-3, 1.0})
      {
        FilledRegions const regions = reconstructed(scene, sliver);
        auto const polygon = onHost(regions.polygon);
        auto const record = onHost(scene.state.record);
        auto const mixed = onHost(regions.mixed_cell);
        auto const offset = onHost(scene.pairs.offset);
        auto const cell_area = onHost(scene.mesh.cell_area);
        for (int i = 0; i < regions.num_mixed_cells; ++i)
          EXPECT_NEAR(area(polygon(i)) / cell_area(mixed(i)), record(offset(mixed(i)), VolumeFraction), 1e-13);
      }
    }
}

TEST(ReconstructJunctions, fourParallelLayersAndVoid_areExactWhateverTheirNumbers)
{
  std::mt19937 random(31);
  for (int i = 0; i < 40; ++i)
  {
    Mesh const mesh = makeMesh(5, 5, 1.0, 0.2, 90 + i);
    Plane2 const base = halfPlane(9.1 * i, {2.3, 2.4});
    std::vector<Body> all{{base}};
    for (double const at : {0.0, 0.15, 0.25})
      all.push_back({{base.normal, base.offset + at + 0.1}, {-base.normal, -base.offset - at}});
    all[2][1].offset = -base.offset - 0.1; // no gaps between the layers
    all[2][0].offset = base.offset + 0.25;
    std::shuffle(all.begin(), all.end(), random);
    Scene const scene = paint(mesh, bodies(all));
    EXPECT_LT(misplacedVolume(scene, reconstructed(scene, 0.0), all), 1e-12) << i;
  }
}

// A round body comes up to a straight one across a wedge of void: the tip that has just entered the cell lies before
// the wedge. As a sliver it was put behind it, where its line suits the neighbours better.
//
//   a \   / b
//      \_/         the cell: b, a wedge of void at its left face, and the tip of a in its lower left corner
TEST(ReconstructJunctions, tipBeforeAWedgeOfVoid_staysOnItsSide)
{
  Mesh const mesh = makeMesh(6, 6, 1.0);
  for (double const enters : {0.002, 0.005, 0.01, 0.02})
  {
    Vector2 const tip{2.0 + enters, 2.0};
    double const radius = 8.0, slope = 8.0 * Math::pi / 180.0;
    Vector2 const centre = tip - radius * Vector2{std::cos(slope), std::sin(slope)};
    Body round;
    for (double degrees = -22.0; degrees <= 38.0; degrees += 5.0)
      round.push_back(halfPlane(degrees, centre + radius * Vector2{std::cos(degrees * Math::pi / 180.0),
                                                                   std::sin(degrees * Math::pi / 180.0)}));
    Body const straight{halfPlane(190.0, {2.104, 2.0})};
    Scene const scene = paint(mesh, bodies({round, straight}));
    FilledRegions const regions = reconstructed(scene, 1e-3);
    auto const first = onHost(regions.cell_region);
    auto const polygon = onHost(regions.polygon);
    auto const centroid = onHost(scene.state.centroid);
    auto const offset = onHost(scene.pairs.offset);
    int const cell = 2 * 6 + 2;
    ASSERT_EQ(offset(cell + 1) - offset(cell), 2);
    Region const &region = polygon(first(cell));
    Vector2 const found = region[0] + moments<1>(region, region[0]).centroid();
    EXPECT_NEAR(found[0], centroid(offset(cell), 0), 0.01) << enters;
    EXPECT_NEAR(found[1], centroid(offset(cell), 1), 0.03) << enters;
  }
}

// Three layers, of which two only touch the cell: the tip of one, 1e-5 of it, has just come in below, and the centroid
// of the other above is off by some hundredths of the cell, as beside a bent face. Its first moment misses more than
// that of the tip at the wrong end of the cell would.
//
//   |____ 2 |
//   |    ---|
//   |   1   |
//   |\0     |
TEST(ReconstructJunctions, tipBelowALayer_isNotPutAboveIt)
{
  Mesh const mesh = makeMesh(6, 6, 1.0);
  int const cell = 2 * 6 + 2;
  for (double const part : {2e-6, 1e-5, 1e-4, 1e-3})
    for (int turn = 0; turn < 12; ++turn)
    {
      Vector2 const off{0.06 * std::cos(Math::pi * turn / 6.0), 0.06 * std::sin(Math::pi * turn / 6.0)};
      // The tip's triangle, on a line that falls by a tenth: height and width have twice its area.
      Plane2 const low = halfPlane(90.0 - std::atan(0.1) * 180.0 / Math::pi, {2.0, 2.0 + std::sqrt(0.2 * part)});
      Plane2 const high = halfPlane(85.0, {3.0, 2.96});
      std::vector<Body> const all{{low}, {opposite(low), high}, {opposite(high)}};
      CellFills const exact = bodies(all);
      Scene const scene = paint(mesh,
                                [&](int where, Quadrilateral const &quad)
                                {
                                  std::vector<Fill> fills = exact(where, quad);
                                  if (where == cell)
                                    fills.back().centroid += off;
                                  return fills;
                                });
      FilledRegions const regions = reconstructed(scene, 1e-6);
      Region const &tip = onHost(regions.polygon)(onHost(regions.cell_region)(cell));
      ASSERT_FALSE(tip.empty());
      double top = 0.0;
      for (int v = 0; v < tip.size; ++v)
        top = std::max(top, tip[v][1] - 2.0);
      EXPECT_LT(top, 0.5) << part << " of the cell, direction " << turn;
    }
}

// The corner of a block that slides on a floor comes into a cell as a sliver, or the void behind it does. Their
// centroids tell where they are: by least squares, slivers below 1e-3, they lie along the floor as films.
TEST(ReconstructJunctions, cornerOnAPlane_isExactFromItsFirstMillionthOn)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst = 0.0, worst_by_least_squares = 0.0;
  Mesh const mesh = makeMesh(7, 7, 1.0);
  for (int i = 0; i < 200; ++i)
  {
    double const degrees = 360.0 * unit(random), depth = std::pow(10.0, -1.0 - 3.0 * unit(random));
    Vector2 corner{3.0 + unit(random), 3.0 + unit(random)};
    corner[i % 2] = unit(random) < 0.5 ? 3.0 + depth : 4.0 - depth;
    std::vector<Body> const all{{halfPlane(degrees - 90.0, corner), halfPlane(degrees, corner)},
                                {halfPlane(degrees + 90.0, corner)}};
    Scene const scene = paint(mesh, bodies(all));
    double const misplaced = misplacedVolume(scene, reconstructed(scene, 1e-6), all);
    EXPECT_LT(misplaced, 3e-6) << degrees << " degrees, corner " << corner[0] << ' ' << corner[1];
    worst = std::max(worst, misplaced);
    worst_by_least_squares = std::max(worst_by_least_squares, misplacedVolume(scene, reconstructed(scene, 1e-3), all));
  }
  std::printf("misplaced volume at most %.1e, by least squares %.1e\n", worst, worst_by_least_squares);
}

// Two bodies that had their end faces in line slide on each other: for a while both corners lie in one cell. All that
// bounds them there is straight, but no sequence of cuts leaves both what they have.
//
//   | a  |                the cell: a's corner above the line, b's farther to the right below it, void right of both
//   |----+--+
//   | b     |
TEST(ReconstructJunctions, cornersThatSlidePastEachOther_areExact)
{
  Mesh const mesh = makeMesh(6, 6, 1.0);
  for (double const degrees : {0.0, 10.0, 22.5, 33.0, 45.0})
    for (double const slip : {0.02, 0.1, 0.3, 0.6})
    {
      Vector2 const corner{3.2, 3.3};
      Vector2 const moved = corner + slip * halfPlane(degrees, corner).normal;
      std::vector<Body> const all{{halfPlane(degrees - 90.0, corner), halfPlane(degrees, corner)},
                                  {halfPlane(degrees + 90.0, corner), halfPlane(degrees, moved)}};
      Scene const scene = paint(mesh, bodies(all));
      FilledRegions const regions = reconstructed(scene, 1e-3);
      int const cell = 3 * 6 + 3;
      auto const first = onHost(regions.cell_region);
      auto const polygon = onHost(regions.polygon);
      auto const offset = onHost(scene.pairs.offset);
      ASSERT_EQ(offset(cell + 1) - offset(cell), 2);
      for (int k = 0; k < 2; ++k)
      {
        Region const &region = polygon(first(cell) + k);
        EXPECT_NEAR(area(intersection(region, all[k])), area(region), 1e-9) << degrees << " degrees, slip " << slip;
      }
    }
}

// The same just before the lower block's corner leaves the cell, where its void seems to lie between the bodies and
// only an exact cell is taken: lines that go on in the neighbours to 3e-5, as bent edges do, are exact enough.
TEST(ReconstructJunctions, cornerThatLeavesTheCell_keepsItsLinesWhereTheNeighboursAreALittleOff)
{
  Mesh const mesh = makeMesh(7, 7, 1.0);
  int const cell = 3 * 7 + 3;
  Vector2 const upper{3.5151, 3.8235}, along = halfPlane(15.0, upper).normal;
  auto const passing = [&](Vector2 const &corner, double slip)
  {
    return std::vector<Body>{{halfPlane(105.0, corner), halfPlane(15.0, corner + slip * along)},
                             {halfPlane(285.0, corner), halfPlane(15.0, corner)}};
  };
  for (double const slip : {0.42, 0.44, 0.46, 0.48})
  {
    std::vector<Body> const all = passing(upper, slip);
    CellFills const exact = bodies(all), off = bodies(passing(upper + 3e-5 * perpendicular(along), slip));
    Scene const scene = paint(mesh, [&](int where, Quadrilateral const &quad)
                              { return where == cell ? exact(where, quad) : off(where, quad); });
    auto const by_pair = misplacedByCell(scene, reconstructed(scene, 1e-6), all).at(cell);
    EXPECT_LT(*std::max_element(by_pair.begin(), by_pair.end()), 1e-4) << slip;
  }
}

// What fills less than a tenth of a cell all around is a thread or a fragment, no tip of a body beyond: its end lies
// along the face that it meets, that of a block where it is.
//
//   |  1  |  1  |
//   |-----|#----|    #: end of body 0, below 1e-3 of the cell
//   |     |#    |
TEST(ReconstructJunctions, endOfAThread_liesAlongTheFaceThatItMeets)
{
  Mesh const mesh = makeMesh(7, 7, 1.0);
  double const right = 3.42;
  for (double const width : {0.02, 0.05, 2.0})
    for (double const into : {1e-3, 2e-3})
    {
      double const face = 3.0 + into;
      std::vector<Body> const all{
          {halfPlane(90.0, {0.0, face}), halfPlane(0.0, {right, 0.0}), halfPlane(180.0, {right - width, 0.0})},
          {halfPlane(270.0, {0.0, face})}};
      FilledRegions const regions = reconstructed(paint(mesh, bodies(all)), 1e-6);
      auto const first = onHost(regions.cell_region);
      auto const polygon = onHost(regions.polygon);
      Region const &end = polygon(first(3 * 7 + 3));
      ASSERT_FALSE(end.empty());
      double reach = 0.0;
      for (int v = 0; v < end.size; ++v)
        reach = std::max(reach, end[v][0] - 3.0);
      EXPECT_NEAR(reach, width < 1.0 ? 1.0 : right - 3.0, 1e-6) << "width " << width << ", into the cell " << into;
    }
}
