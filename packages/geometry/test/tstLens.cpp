// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <Harmos_Lens.hpp>
#include <Harmos_SharedVolume.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

constexpr double along = 1e-9;
Quadrilateral const everywhere = box(-10.0, -10.0, 10.0, 10.0);

Region region(std::vector<Vector2> const &vertices)
{
  Region p;
  for (Vector2 const &x : vertices)
    p.push(x);
  return p;
}

Region region(Quadrilateral const &q)
{
  return region({q[0], q[1], q[2], q[3]});
}

/// The same outline from another vertex.
Region turned(Region const &p, int by)
{
  Region q;
  for (int i = 0; i < p.size; ++i)
    q.push(p[(i + by) % p.size]);
  return q;
}

OutlineArcs arcsOf(Lenses const &lenses, bool of_a, int edges)
{
  OutlineArcs arcs;
  for (int i = 0; i < lenses.size; ++i)
    EXPECT_TRUE(arcs.add(of_a ? lenses.lens[i].of_a : lenses.lens[i].of_b, edges));
  return arcs;
}

/// Both after what they have in common was divided.
void part(Region const &a, Region const &b, Region &parted_a, Region &parted_b)
{
  Lenses const lenses = lensesOf(a, b, along);
  EXPECT_TRUE(straightened(a, arcsOf(lenses, true, a.size), parted_a));
  EXPECT_TRUE(straightened(b, arcsOf(lenses, false, b.size), parted_b));
}

} // namespace

TEST(Lens, cornerThatPokesThroughASide_isCutOffAlongIt)
{
  // A corner 0.2 deep in the side x = 1, which is itself the line through the crossings (1, 0.3), (1, 0.7).
  Region const a = region(box(0.0, 0.0, 1.0, 1.0)), b = region({{0.8, 0.5}, {1.3, 0.0}, {1.8, 0.5}, {1.3, 1.0}});
  for (int turn_a = 0; turn_a < 4; ++turn_a)
    for (int turn_b = 0; turn_b < 4; ++turn_b)
    {
      Region const p = turned(a, turn_a), q = turned(b, turn_b);
      Lenses const lenses = lensesOf(p, q, along);
      ASSERT_EQ(lenses.size, 1);
      EXPECT_NEAR(lenses.lens[0].area, 0.04, 1e-16);
      EXPECT_NEAR(norm(lenses.lens[0].of_a.from - Vector2{1.0, 0.3}), 0.0, 1e-15);
      EXPECT_NEAR(norm(lenses.lens[0].of_a.to - Vector2{1.0, 0.7}), 0.0, 1e-15);
      Region parted_p, parted_q;
      part(p, q, parted_p, parted_q);
      EXPECT_NEAR(area(parted_p), 1.0, 1e-15);
      EXPECT_NEAR(area(parted_q), 0.5 - 0.04, 1e-15);
    }
}

TEST(Lens, facetsThatTurnAgainstEachOther_endOnTheLineBetweenThem)
{
  // Two cells' halves whose common facet has turned by 0.1 about its middle, against one another.
  Region const a = region({{0.0, 0.0}, {0.55, 0.0}, {0.45, 1.0}, {0.0, 1.0}});
  Region const b = region({{0.45, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.55, 1.0}});
  Lenses const lenses = lensesOf(a, b, along);
  ASSERT_EQ(lenses.size, 1);
  EXPECT_NEAR(lenses.lens[0].area, 0.5 * 0.1 * 0.5, 1e-16);
  EXPECT_NEAR(sharedVolume(a, b, everywhere, Geometry::Planar), 0.025, 1e-15);
  Region parted_a, parted_b;
  part(a, b, parted_a, parted_b);
  EXPECT_NEAR(sharedVolume(parted_a, parted_b, everywhere, Geometry::Planar), 0.0, 1e-16);
  EXPECT_NEAR(area(a) + area(b) - area(parted_a) - area(parted_b), 0.025, 1e-15);
}

TEST(Lens, sidesThatRunAlongEachOther_crossHalfway)
{
  // The sides y = 0 and y = 1 are common from x = 0.5 to 0.6, exactly or but for round-off: what both have is halved.
  Random random(4);
  for (int trial = 0; trial < 1000; ++trial)
  {
    double const noise = trial % 2 == 0 ? 0.0 : 1e-13;
    Region a = region(box(0.0, 0.0, 0.6, 1.0)), b = region(box(0.5, 0.0, 1.0, 1.0));
    for (Region *p : {&a, &b})
      for (int i = 0; i < 4; ++i)
        (*p)[i][1] += uniform(random, -noise, noise);
    Region const p = turned(a, trial / 2 % 4), q = turned(b, trial / 8 % 4);
    Lenses const lenses = lensesOf(p, q, along);
    ASSERT_EQ(lenses.size, 1);
    Region parted_p, parted_q;
    part(p, q, parted_p, parted_q);
    EXPECT_NEAR(area(parted_p), 0.55, 1e-12);
    EXPECT_NEAR(area(parted_q), 0.45, 1e-12);
    EXPECT_NEAR(sharedVolume(parted_p, parted_q, everywhere, Geometry::Planar), 0.0, 1e-12);
  }
}

TEST(Lens, bodiesThatDoNotCross_haveNone)
{
  EXPECT_EQ(lensesOf(region(box(0, 0, 1, 1)), region(box(1, 0, 2, 1)), along).size, 0); // side to side
  EXPECT_EQ(lensesOf(region(box(0, 0, 1, 1)), region(box(1, 1, 2, 2)), along).size, 0); // corner to corner
  EXPECT_EQ(lensesOf(region(box(0, 0, 3, 3)), region(box(1, 1, 2, 2)), along).size, 0); // one in the other
  EXPECT_EQ(lensesOf(region(box(0, 0, 3, 1)), region(box(1, -1, 2, 2)), along).size,
            0); // a cross: four corners, no lens
}

TEST(Lens, twoTeethInABar_areTwoLenses)
{
  Region const comb = region({{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  Region const bar = region(box(-1.0, 1.75, 4.0, 3.0));
  EXPECT_EQ(lensesOf(comb, bar, along).size, 2);
  Region parted_comb, parted_bar;
  part(comb, bar, parted_comb, parted_bar);
  EXPECT_NEAR(area(parted_comb), 5.0 - 0.5, 1e-15);
  EXPECT_NEAR(area(parted_bar), area(bar), 1e-15);
  EXPECT_NEAR(sharedVolume(parted_comb, parted_bar, everywhere, Geometry::Planar), 0.0, 1e-15);
}

TEST(Lens, randomConvexPolygons_thatCrossTwice_shareNothingAfterwards)
{
  Random random(5);
  int crossed_twice = 0;
  for (int trial = 0; trial < 20000; ++trial)
  {
    Region const a = region(randomConvex(random)), b = region(randomConvex(random));
    LensDetail::Crossing crossing[LensDetail::most_crossings];
    if (LensDetail::findCrossings(a, b, crossing) != 2)
      continue;
    ++crossed_twice;
    Lenses const lenses = lensesOf(a, b, along), swapped = lensesOf(b, a, along);
    ASSERT_EQ(lenses.size, 1);
    ASSERT_EQ(swapped.size, 1);
    double const shared = sharedVolume(a, b, everywhere, Geometry::Planar);
    EXPECT_NEAR(lenses.lens[0].area, shared, 1e-14);
    EXPECT_NEAR(swapped.lens[0].area, shared, 1e-14);
    EXPECT_NEAR(norm(swapped.lens[0].of_a.from - lenses.lens[0].of_b.from), 0.0, 1e-12);
    Region parted_a, parted_b;
    part(a, b, parted_a, parted_b);
    EXPECT_NEAR(sharedVolume(parted_a, parted_b, everywhere, Geometry::Planar), 0.0, 1e-14);
    EXPECT_NEAR(area(a) + area(b) - area(parted_a) - area(parted_b), shared, 1e-14);
  }
  EXPECT_GT(crossed_twice, 5000);
}

TEST(Lens, arcsThatRunIntoEachOther_areNotTakenBoth)
{
  OutlineArcs arcs;
  EXPECT_TRUE(arcs.add({3.5, 1.0, {}, {}}, 4)); // across vertex 0, to 0.5
  EXPECT_FALSE(arcs.add({0.25, 0.5, {}, {}}, 4));
  EXPECT_FALSE(arcs.add({3.0, 0.75, {}, {}}, 4));
  EXPECT_FALSE(arcs.add({3.0, 2.0, {}, {}}, 4)); // all around it
  EXPECT_TRUE(arcs.add({0.5, 1.0, {}, {}}, 4));  // begins where it ends
  EXPECT_EQ(arcs.size, 2);
  EXPECT_EQ(arcs.arc[0].start, 0.5);
}

TEST(Lens, outlineWithoutRoom_isRefused)
{
  Region full;
  for (int i = 0; i < Region::capacity; ++i)
    full.push({std::cos(2.0 * Math::pi * i / Region::capacity), std::sin(2.0 * Math::pi * i / Region::capacity)});
  Region result;
  OutlineArcs within_an_edge, over_two_vertices;
  within_an_edge.add({0.25, 0.5, full[0], full[1]}, full.size);
  EXPECT_FALSE(straightened(full, within_an_edge, result));
  over_two_vertices.add({0.5, 2.0, 0.5 * (full[0] + full[1]), 0.5 * (full[2] + full[3])}, full.size);
  EXPECT_TRUE(straightened(full, over_two_vertices, result));
  EXPECT_EQ(result.size, Region::capacity);
}
