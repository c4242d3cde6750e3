// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

// No rescaling to integers: it would round to 1e-7.
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/intersection.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <gtest/gtest.h>

#include <deque>

using namespace Harmos;

namespace
{

namespace bg = boost::geometry;
using BoostPolygon = bg::model::polygon<bg::model::d2::point_xy<double>, false>; // counter-clockwise

BoostPolygon toBoost(Quadrilateral const &q)
{
  BoostPolygon polygon;
  for (int k = 0; k < q.size; ++k)
    bg::append(polygon.outer(), bg::model::d2::point_xy<double>(q[k][0], q[k][1]));
  bg::correct(polygon);
  return polygon;
}

double boostArea(Quadrilateral const &a, Quadrilateral const &b)
{
  std::deque<BoostPolygon> parts;
  bg::intersection(toBoost(a), toBoost(b), parts);
  double sum = 0.0;
  for (BoostPolygon const &part : parts)
    sum += bg::area(part);
  return sum;
}

} // namespace

TEST(ClipAgainstBoost, randomConvexQuadrilaterals_haveTheSameOverlap)
{
  Random random(8);
  double worst = 0.0;
  int overlapping = 0;
  for (int trial = 0; trial < 5000; ++trial)
  {
    Quadrilateral const a = randomConvex(random);
    Quadrilateral const b = randomConvex(random);
    Region overlay;
    clipConvex(a, b, overlay);
    worst = Math::max(worst, Math::fabs(area(overlay) - boostArea(a, b)));
    overlapping += overlay.empty() ? 0 : 1;
  }
  EXPECT_GT(overlapping, 2500);
  EXPECT_LT(worst, 1e-13);
}

TEST(ClipAgainstBoost, movedSquares_haveTheSameOverlapWithUnitCells)
{
  Random random(9);
  double worst = 0.0;
  for (int trial = 0; trial < 500; ++trial)
  {
    Quadrilateral const donor = movedSquare(random, 0.25);
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        worst = Math::max(
            worst, Math::fabs(area(overlayWithUnitCell(donor, i, j)) - boostArea(donor, box(i, j, i + 1.0, j + 1.0))));
  }
  EXPECT_LT(worst, 1e-13);
}
