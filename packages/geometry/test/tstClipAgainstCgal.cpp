// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <gtest/gtest.h>

#include <vector>

using namespace Harmos;

namespace
{

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Exact = Kernel::FT;
using ExactPolygon = CGAL::Polygon_2<Kernel>;

ExactPolygon toCgal(Quadrilateral const &q)
{
  ExactPolygon polygon;
  for (int k = 0; k < q.size; ++k)
    polygon.push_back(Kernel::Point_2(q[k][0], q[k][1]));
  return polygon;
}

/// Moments about (0, 0) of what two simple counter-clockwise quadrilaterals share, rounded once, at the end.
Moments<2> exactMoments(Quadrilateral const &a, Quadrilateral const &b)
{
  std::vector<CGAL::Polygon_with_holes_2<Kernel>> parts;
  CGAL::intersection(toCgal(a), toCgal(b), std::back_inserter(parts));
  Exact sum[Moments<2>::count] = {0, 0, 0, 0, 0, 0};
  for (auto const &part : parts)
  {
    EXPECT_FALSE(part.has_holes());
    for (auto edge = part.outer_boundary().edges_begin(); edge != part.outer_boundary().edges_end(); ++edge)
    {
      Exact const x0 = edge->source().x(), y0 = edge->source().y(), x1 = edge->target().x(), y1 = edge->target().y();
      Exact const c = x0 * y1 - x1 * y0;
      sum[0] += c / 2;
      sum[1] += c * (x0 + x1) / 6;
      sum[2] += c * (y0 + y1) / 6;
      sum[3] += c * (x0 * x0 + x0 * x1 + x1 * x1) / 12;
      sum[4] += c * (2 * x0 * y0 + x0 * y1 + x1 * y0 + 2 * x1 * y1) / 24;
      sum[5] += c * (y0 * y0 + y0 * y1 + y1 * y1) / 12;
    }
  }
  Moments<2> m;
  for (int i = 0; i < Moments<2>::count; ++i)
    m.value[i] = CGAL::to_double(sum[i]);
  return m;
}

/// Largest difference of the moments of the overlay of two quadrilaterals from the exact ones.
double error(Quadrilateral const &a, Quadrilateral const &b)
{
  Region overlay;
  clipConvex(a, b, overlay);
  Moments<2> const found = moments<2>(overlay, Vector2{0.0, 0.0});
  Moments<2> const exact = exactMoments(a, b);
  double worst = 0.0;
  for (int i = 0; i < Moments<2>::count; ++i)
    worst = Math::max(worst, Math::fabs(found.value[i] - exact.value[i]));
  return worst;
}

Quadrilateral moved(Quadrilateral q, Vector2 const &by)
{
  for (int k = 0; k < q.size; ++k)
    q[k] += by;
  return q;
}

} // namespace

TEST(ClipAgainstCgal, randomConvexQuadrilaterals_haveTheExactMoments)
{
  Random random(8);
  double worst = 0.0;
  for (int trial = 0; trial < 1000; ++trial)
  {
    Quadrilateral const a = randomConvex(random);
    worst = Math::max(worst, error(a, randomConvex(random)));
  }
  EXPECT_LT(worst, 1e-14);
}

TEST(ClipAgainstCgal, movedSquares_haveTheExactMomentsInUnitCells)
{
  Random random(9);
  double worst = 0.0;
  for (int trial = 0; trial < 100; ++trial)
  {
    Quadrilateral const donor = movedSquare(random, 0.25);
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        worst = Math::max(worst, error(moved(donor, {-1.0 * i, -1.0 * j}), box(0.0, 0.0, 1.0, 1.0)));
  }
  EXPECT_LT(worst, 1e-14);
}

TEST(ClipAgainstCgal, sharedEdgesAndCornersAndSlivers_haveTheExactMoments)
{
  Quadrilateral const cell = box(0.0, 0.0, 1.0, 1.0);
  double worst = 0.0;
  for (double gap : {0.0, 1e-15, 1e-12, 1e-9, 1e-3})
    for (double sign : {-1.0, 1.0})
    {
      double const d = sign * gap;
      for (Vector2 const &by : {Vector2{d, 0.0}, Vector2{0.0, d}, Vector2{d, d}, Vector2{1.0 + d, 0.0},
                                Vector2{1.0 + d, 1.0 + d}, Vector2{0.5, -1.0 - d}, Vector2{-1.0 - d, 0.25}})
        worst = Math::max(worst, error(moved(cell, by), cell));
      // a corner on an edge, edges that nearly coincide, a needle along a diagonal
      worst = Math::max(worst, error({4, {{0.5, 1.0 - d}, {1.0, 1.5}, {0.5, 2.0}, {0.0, 1.5}}}, cell));
      worst = Math::max(worst, error({4, {{0.0, d}, {1.0, -d}, {1.0, 1.0}, {0.0, 1.0}}}, cell));
      worst = Math::max(worst, error({4, {{-0.5, -0.5}, {1.5, 1.5}, {1.5, 1.5 + 2e-3 + gap}, {-0.5, -0.5 + 1e-3}}}, cell));
    }
  EXPECT_LT(worst, 1e-15);
}
