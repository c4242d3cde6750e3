// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_CurvedGap.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace Harmos;

namespace
{

constexpr double cell_size = 0.02, tilt = 0.3; // of everything

Vector2 turned(Vector2 const &x)
{
  return {std::cos(tilt) * x[0] - std::sin(tilt) * x[1], std::sin(tilt) * x[0] + std::cos(tilt) * x[1]};
}

InterfaceSegment facet(int material, int cell, Vector2 const &from, Vector2 const &to)
{
  InterfaceSegment s = {};
  Vector2 const a = cell_size * turned(from), b = cell_size * turned(to), across = perpendicular(b - a);
  double const outward = material == 0 ? 1.0 : -1.0;
  s.midpoint = s.point = 0.5 * (a + b);
  s.length = norm(b - a);
  s.normal = (outward / s.length) * across;
  s.cell_size = cell_size;
  s.material = material;
  s.cell = cell;
  s.parts = 1;
  return s;
}

/// Depth of an arc of radius r below its top, which is at t = 0. [cells]
double depth(double r, double t)
{
  return r - std::sqrt(r * r - t * t);
}

/// From t0 to t1, by Simpson's rule.
double meanDepth(double r, double t0, double t1)
{
  constexpr int steps = 64;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i)
    sum += (i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * depth(r, t0 + i * (t1 - t0) / steps);
  return sum / (3.0 * steps);
}

/// The facet of an arc from t0 to t1, with the arc's area: of material 0 below its top, of material 1 above.
void addChord(std::vector<InterfaceSegment> &all, int material, int cell, double r, double top, double t0, double t1)
{
  double const up = material == 0 ? -1.0 : 1.0, d0 = depth(r, t0), d1 = depth(r, t1);
  double const shift = meanDepth(r, t0, t1) - 0.5 * (d0 + d1);
  all.push_back(facet(material, cell, {t0, top + up * (d0 + shift)}, {t1, top + up * (d1 + shift)}));
}

SlipMirrors noMirrors()
{
  return {Mesh{}, View<Boundary *>(), 0, 0};
}

double gapOf(std::vector<InterfaceSegment> const &all, InterfaceSegment const &at)
{
  InterfaceSegments s;
  s.count = static_cast<int>(all.size());
  s.segment = View<InterfaceSegment *>("segment", all.size());
  auto const host = Kokkos::create_mirror_view(s.segment);
  for (std::size_t i = 0; i < all.size(); ++i)
    host(i) = all[i];
  Kokkos::deep_copy(s.segment, host);
  SegmentBins const bins = binSegments(s, 1.2 * cell_size);
  View<double *> const gap("gap", 1);
  SlipMirrors const none = noMirrors();
  Vector2 const up = turned({0.0, 1.0});
  Kokkos::parallel_for(
      "gap", RangePolicy(0, 1), KOKKOS_LAMBDA(int) { gap(0) = curvedGap(bins, none, at, 1, up); });
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), gap)(0);
}

/// Where the two sides' facets are asked: on no facet's own.
InterfaceSegment atPoint(double t)
{
  return facet(0, 0, {t - 0.1, 0.0}, {t + 0.1, 0.0});
}

/// Two arcs of radii r_a and r_b, in cells whose faces lie apart by `shift` on the two sides.
std::vector<InterfaceSegment> twoArcs(double r_a, double r_b, double gap, double shift)
{
  std::vector<InterfaceSegment> all;
  for (int i = -3; i < 3; ++i)
  {
    addChord(all, 0, 10 + i, r_a, 0.0, i + 0.3, i + 1.3);
    addChord(all, 1, 30 + i, r_b, gap, 0.9 * i + shift, 0.9 * (i + 1) + shift);
  }
  return all;
}

} // namespace

TEST(CurvedGap, twoArcs_areAsFarApartAsTheyAre)
{
  for (double r : {4.0, 6.0, 20.0})
    for (double shift : {0.0, 0.2, 0.55})
      for (double t : {0.0, 0.2})
      {
        double const gap = 0.02 + depth(r, t) + depth(5.0, t);
        double const found = gapOf(twoArcs(r, 5.0, 0.02, shift), atPoint(t));
        EXPECT_NEAR(found, gap, 1e-3) << r << " " << shift << " " << t;
      }
}

TEST(CurvedGap, facetsInPieces_countByTheirCells)
{
  // In one cell a piece of the facet is another body's: volumes are right in the sum of both pieces alone.
  auto const all = twoArcs(4.0, 5.0, 0.02, 0.0);
  std::vector<InterfaceSegment> pieces;
  for (InterfaceSegment const &s : all)
    if (s.cell != 9)
      pieces.push_back(s);
  double const from = -0.7, to = 0.3, part = 0.2; // of cell 9
  double const shift = meanDepth(4.0, from, to) - 0.5 * (depth(4.0, from) + depth(4.0, to));
  double const left = -depth(4.0, from) - shift, right = -depth(4.0, to) - shift, slope = right - left;
  double const sunk = 0.02, raised = sunk * part / (1.0 - part);
  double const middle = right - part * slope;
  pieces.push_back(facet(0, 9, {from, left + raised}, {to - part, middle + raised}));
  pieces.push_back(facet(0, 9, {to - part, middle - sunk}, {to, right - sunk}));
  EXPECT_NEAR(gapOf(pieces, atPoint(0.1)), gapOf(all, atPoint(0.1)), 2e-3);
  EXPECT_GT(gapOf(pieces, atPoint(0.1)), 0.015);
}

TEST(CurvedGap, manyCells_leaveRoomForThoseThatCount)
{
  // Shallow arcs in narrow cells, as a side at 45 degrees has them: more than there is room for, most of them far away.
  std::vector<InterfaceSegment> all;
  for (int i = -12; i < 12; ++i)
  {
    addChord(all, 0, 100 + i, 40.0, 0.0, 0.5 * i, 0.5 * (i + 1));
    addChord(all, 1, 200 + i, 40.0, 0.005, 0.5 * i + 0.2, 0.5 * (i + 1) + 0.2);
  }
  EXPECT_NEAR(gapOf(all, atPoint(0.0)), 0.005, 1e-3);
}

TEST(CurvedGap, flatSides_areNotMovedApart)
{
  std::vector<InterfaceSegment> all;
  for (int i = -3; i < 3; ++i)
    for (int side = 0; side < 2; ++side)
      all.push_back(facet(side, 10 * (side + 1) + i, {1.0 * i, 0.01 * side}, {i + 1.0, 0.01 * side}));
  EXPECT_EQ(gapOf(all, atPoint(0.0)), 0.0);
}

TEST(CurvedGap, arcsThatOverlap_haveNone)
{
  EXPECT_EQ(gapOf(twoArcs(4.0, 5.0, -0.01, 0.0), atPoint(0.0)), 0.0);
}

TEST(CurvedGap, chordsThatHaveDrifted_areStillArcs)
{
  std::vector<InterfaceSegment> drifted = twoArcs(4.0, 5.0, 0.02, 0.0);
  for (std::size_t i = 0; i < drifted.size(); ++i)
  {
    Vector2 const by = (i % 4 < 2 ? 0.01 : -0.01) * cell_size * turned({0.0, 1.0});
    drifted[i].midpoint = drifted[i].midpoint + by;
    drifted[i].point = drifted[i].point + by;
  }
  EXPECT_NEAR(gapOf(drifted, atPoint(0.0)), 0.02, 0.02);
  EXPECT_GT(gapOf(drifted, atPoint(0.0)), 0.0);
}

TEST(CurvedGap, chordsThatAreCutOff_standOutTwiceAsFar)
{
  EXPECT_NEAR(gapOf(twoArcs(16.0, 16.0, 0.03, 0.0), atPoint(0.0)), 0.03, 1e-3);
}

TEST(CurvedGap, moreThanChordsExplain_isNotBelieved)
{
  EXPECT_EQ(gapOf(twoArcs(20.0, 20.0, 0.05, 0.0), atPoint(0.0)), 0.0);
}

TEST(CurvedGap, aCorner_isNoArc)
{
  std::vector<InterfaceSegment> corner;
  for (InterfaceSegment const &s : twoArcs(5.0, 5.0, 0.0, 0.0))
    if (s.material == 1)
      corner.push_back(s);
  for (int i = 0; i < 3; ++i)
  {
    corner.push_back(facet(0, 10 + i, {1.0 * i, -0.3 * i}, {i + 1.0, -0.3 * (i + 1)}));
    corner.push_back(facet(0, 20 + i, {-i - 1.0, -0.3 * (i + 1)}, {-1.0 * i, -0.3 * i}));
  }
  EXPECT_EQ(gapOf(corner, atPoint(0.05)), 0.0);
}

TEST(CurvedGap, twoCellsOfASide_doNotTell)
{
  std::vector<InterfaceSegment> few;
  for (InterfaceSegment const &s : twoArcs(4.0, 5.0, 0.02, 0.0))
    if (s.material == 1 || s.cell == 9 || s.cell == 10)
      few.push_back(s);
  EXPECT_EQ(gapOf(few, atPoint(0.0)), 0.0);
}

TEST(CurvedGap, cornerAboveAnArc_isAsFarAwayAsTheArc)
{
  for (double r : {4.0, 6.0, 20.0})
    for (double t : {-0.5, 0.0, 0.28, 0.32})
    {
      std::vector<InterfaceSegment> all;
      for (int i = -3; i < 3; ++i)
        addChord(all, 0, 10 + i, r, 0.0, i + 0.3, i + 1.3);
      InterfaceSegment const &face = all[t < 0.3 ? 2 : 3];
      double const gap = 0.02, height = gap - depth(r, t);
      Vector2 const up = turned({0.0, 1.0}), corner = cell_size * turned({t, height});
      double const to_chord = dot(corner - face.midpoint, face.normal);
      InterfaceSegments s;
      s.count = static_cast<int>(all.size());
      s.segment = deviceCopy("segment", all);
      SegmentBins const bins = binSegments(s, 1.2 * cell_size);
      View<double *> const found("found", 1);
      SlipMirrors const none = noMirrors();
      Kokkos::parallel_for(
          "gapAboveArc", RangePolicy(0, 1),
          KOKKOS_LAMBDA(int) { found(0) = gapAboveArc(bins, none, face, corner, up, to_chord); });
      double const result = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), found)(0) / cell_size;
      EXPECT_NEAR(result, Math::max(gap, to_chord / cell_size), 1e-3) << r << " " << t;
      if (t > 0.2)
      {
        EXPECT_GT(result, to_chord / cell_size) << r << " " << t;
      }
    }
}
