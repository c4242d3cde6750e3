// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryTestTools.hpp"

#include <Harmos_ConvexPieces.hpp>
#include <Harmos_Shape.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace Harmos;

namespace
{

/// A five-pointed star: not convex, ten corners.
std::vector<Vector2> star(Vector2 const &centre, double radius)
{
  std::vector<Vector2> points;
  for (int i = 0; i < 10; ++i)
  {
    double const angle = Math::pi * i / 5.0;
    points.push_back(centre + (i % 2 == 0 ? radius : 0.4 * radius) * Vector2{Math::cos(angle), Math::sin(angle)});
  }
  return points;
}

/// Sum of the intersections with an 8 x 8 grid of unit cells, sheared so that cells are no rectangles.
Moments<1> sumOverGrid(Shape const &shape)
{
  auto const node = [](int i, int j) { return Vector2{i + 0.2 * std::sin(j), j + 0.2 * std::sin(2.0 * i)}; };
  Moments<1> sum;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i)
    {
      Quadrilateral const cell{4, {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}};
      Moments<1> const m = shape.intersectionMoments(cell);
      sum.value[0] += m.value[0];
      for (int d = 0; d < 2; ++d)
        sum.value[1 + d] += m.first(d) + cell[0][d] * m.volume();
    }
  return sum;
}

void expectSumsToShape(Shape const &shape, double tolerance)
{
  Moments<1> const sum = sumOverGrid(shape);
  EXPECT_NEAR(1.0, sum.volume() / shape.area(), tolerance);
  EXPECT_NEAR(0.0, norm(sum.centroid() - shape.centroid()), 10.0 * tolerance);
}

} // namespace

TEST(Shape, closedForms_areaCentroidInertia)
{
  Shape const rectangle = Shape::rectangle({1.0, 2.0}, {2.0, 3.0}, 0.3);
  EXPECT_NEAR(6.0, rectangle.area(), 1e-14);
  EXPECT_NEAR(6.0 * (4.0 + 9.0) / 12.0, rectangle.inertia(), 1e-14);
  Shape const disc = Shape::disc({1.0, 2.0}, 2.0);
  EXPECT_NEAR(4.0 * Math::pi, disc.area(), 1e-14);
  EXPECT_NEAR(8.0 * Math::pi, disc.inertia(), 1e-14);
  Shape const annulus = Shape::annulus({0.0, 0.0}, 1.0, 2.0);
  EXPECT_NEAR(3.0 * Math::pi, annulus.area(), 1e-14);
  EXPECT_NEAR(7.5 * Math::pi, annulus.inertia(), 1e-13);
  Shape const triangle = Shape::polygon({{0, 0}, {0, 3}, {3, 0}}); // given clockwise
  EXPECT_NEAR(4.5, triangle.area(), 1e-15);
  EXPECT_NEAR(0.0, norm(triangle.centroid() - Vector2{1.0, 1.0}), 1e-15);
  EXPECT_NEAR(4.5, triangle.inertia(), 1e-14); // b h (b^2 + h^2) / 36
  EXPECT_TRUE(std::isinf(Shape::halfPlane({0, 0}, {0, 1}).area()));
}

TEST(Shape, everyKindAtRandomPoses_sumsOverAGridToItsAreaAndCentroid)
{
  Random random(14);
  for (int trial = 0; trial < 200; ++trial)
  {
    Vector2 const c{uniform(random, 3.5, 4.5), uniform(random, 3.5, 4.5)};
    double const angle = uniform(random, 0.0, 2.0 * Math::pi);
    expectSumsToShape(Shape::rectangle(c, {uniform(random, 0.01, 3.0), uniform(random, 0.01, 3.0)}, angle), 1e-13);
    expectSumsToShape(Shape::disc(c, uniform(random, 0.01, 2.5)), 1e-12);
    expectSumsToShape(Shape::annulus(c, uniform(random, 0.1, 1.0), uniform(random, 1.1, 2.5)), 1e-13);
    expectSumsToShape(Shape::polygon(star(c, uniform(random, 0.5, 2.5))).moved({0.0, 0.0}, angle), 1e-13);
  }
}

TEST(Shape, cellWithinOrBesideAShape_isWholeOrNothing)
{
  Quadrilateral const cell = box(4.0, 4.0, 4.5, 4.5);
  Quadrilateral const far = box(40.0, 4.0, 41.0, 5.0);
  for (Shape const &shape : {Shape::rectangle({4, 4}, {4, 4}, 0.2), Shape::disc({4, 4}, 2.0),
                             Shape::annulus({4, 4.2}, 1e-3, 2.0).moved({-1.0, 0.0}, 0.0),
                             Shape::polygon(star({4.25, 4.25}, 3.0)), Shape::halfPlane({8, 0}, {1, 0.1})})
  {
    EXPECT_EQ(CellPosition::Inside, shape.position(cell));
    EXPECT_EQ(0.25, shape.intersectionMoments(cell).volume());
    EXPECT_EQ(CellPosition::Outside, shape.position(far));
    EXPECT_EQ(0.0, shape.intersectionMoments(far).volume());
  }
}

TEST(Shape, rectangleOnGridLines_fillsItsCellsExactlyAndNoOthers)
{
  Shape const shape = Shape::rectangle({2.0, 2.0}, {2.0, 2.0});
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
    {
      bool const inside = i >= 1 && i < 3 && j >= 1 && j < 3;
      EXPECT_EQ(inside ? CellPosition::Inside : CellPosition::Outside, shape.position(box(i, j, i + 1.0, j + 1.0)));
      EXPECT_EQ(inside ? 1.0 : 0.0, shape.intersectionMoments(box(i, j, i + 1.0, j + 1.0)).volume());
    }
}

TEST(Shape, smallShapeWithinACell_isWhole)
{
  Quadrilateral const cell = box(0.0, 0.0, 1.0, 1.0);
  Moments<1> const m = Shape::disc({0.5, 0.5}, 1e-5).intersectionMoments(cell);
  EXPECT_NEAR(1.0, m.volume() / (Math::pi * 1e-10), 1e-11);
  EXPECT_NEAR(0.0, norm(m.centroid() - Vector2{0.5, 0.5}), 1e-10);
  EXPECT_NEAR(0.01, Shape::rectangle({0.5, 0.5}, {0.1, 0.1}).intersectionMoments(cell).volume(), 1e-17);
}

TEST(Shape, outlineThatRoundingMakesAPoint_fillsNothing)
{
  Shape const shape = Shape::polygon({{0, 0}, {1e-17, 0}, {0, 1e-17}}).moved({0.5, 0.5}, 0.0);
  for (double const x : {0.0, 1.0}) // with the point inside, and beside it
    EXPECT_EQ(0.0, shape.intersectionMoments(box(x, 0.0, x + 1.0, 1.0)).volume());
  EXPECT_FALSE(shape.contains({0.25, 0.25}));
}

TEST(Shape, contains_agreesWithTheOutline)
{
  Shape const annulus = Shape::annulus({1, 1}, 1.0, 2.0);
  EXPECT_FALSE(annulus.contains({1.0, 1.5}));
  EXPECT_TRUE(annulus.contains({1.0, 2.5}));
  EXPECT_FALSE(annulus.contains({1.0, 3.5}));
  Shape const five = Shape::polygon(star({0, 0}, 1.0));
  EXPECT_TRUE(five.contains({0.9, 0.0}));
  EXPECT_FALSE(five.contains({-0.9, 0.0}));
  EXPECT_TRUE(Shape::halfPlane({0, 1}, {0, 1}).contains({7.0, 0.5}));
  EXPECT_FALSE(Shape::halfPlane({0, 1}, {0, 1}).contains({7.0, 1.5}));
}

TEST(Shape, boundingBox_isTight)
{
  Box const b = Shape::rectangle({1.0, 2.0}, {2.0, 2.0}, 0.25 * Math::pi).boundingBox();
  EXPECT_NEAR(1.0 - std::sqrt(2.0), b.low[0], 1e-15);
  EXPECT_NEAR(2.0 + std::sqrt(2.0), b.high[1], 1e-15);
  Box const h = Shape::halfPlane({1.0, 2.0}, {0.0, -3.0}).boundingBox();
  EXPECT_EQ(2.0, h.low[1]);
  EXPECT_TRUE(std::isinf(h.high[1]) && std::isinf(h.low[0]));
}

TEST(Shape, moved_turnsAboutTheCentroidAndKeepsAreaAndInertia)
{
  Shape const start = Shape::polygon(star({0.3, 0.4}, 1.0));
  Shape const end = start.moved({1.0, -2.0}, 0.7);
  EXPECT_NEAR(0.0, norm(end.centroid() - start.centroid() - Vector2{1.0, -2.0}), 1e-15);
  EXPECT_NEAR(start.area(), end.area(), 1e-15);
  EXPECT_NEAR(start.inertia(), end.inertia(), 1e-15);
  Vector2 const arm = start.points[0] - start.centroid();
  Vector2 const turned{std::cos(0.7) * arm[0] - std::sin(0.7) * arm[1],
                       std::sin(0.7) * arm[0] + std::cos(0.7) * arm[1]};
  EXPECT_NEAR(0.0, norm(end.points[0] - end.centroid() - turned), 1e-15);
  EXPECT_NEAR(0.0, Shape::halfPlane({0, 0}, {1, 0}).moved({0, 0}, 0.5 * Math::pi).normal[0], 1e-15);
}

TEST(Shape, outline_preservesTheArea)
{
  for (Shape const &shape :
       {Shape::disc({1, 2}, 0.7), Shape::annulus({1, 2}, 0.3, 0.7), Shape::polygon(star({1, 2}, 1.0))})
    for (int const sides : {3, 8, 97})
      EXPECT_NEAR(shape.area(), polygonArea(shape.outline(sides)), 1e-14);
  EXPECT_THROW(Shape::halfPlane({0, 0}, {1, 0}).outline(), std::invalid_argument);
}

TEST(Shape, badShapes_areRefused)
{
  EXPECT_THROW(Shape::rectangle({0, 0}, {1, 0}), std::invalid_argument);
  EXPECT_THROW(Shape::rectangle({0.3, 0.3}, {1e-17, 1e-17}), std::invalid_argument); // all corners are one
  EXPECT_THROW(Shape::disc({0, 0}, -1.0), std::invalid_argument);
  EXPECT_THROW(Shape::disc({0, std::nan("")}, 1.0), std::invalid_argument);
  EXPECT_THROW(Shape::annulus({0, 0}, 2.0, 1.0), std::invalid_argument);
  EXPECT_THROW(Shape::halfPlane({0, 0}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(Shape::polygon({{0, 0}, {1, 0}}), std::invalid_argument);
  EXPECT_THROW(Shape::polygon({{0, 0}, {1, 0}, {2, 0}}), std::invalid_argument);
  EXPECT_THROW(Shape::polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), std::invalid_argument); // a bow tie
}

TEST(ConvexPieces, randomStarShapedPolygons_areCutWithoutLoss)
{
  Random random(15);
  for (int trial = 0; trial < 200; ++trial)
  {
    std::vector<Vector2> points;
    int const n = 3 + trial % 60;
    for (int i = 0; i < n; ++i)
    {
      double const angle = 2.0 * Math::pi * i / n;
      points.push_back(uniform(random, 0.2, 1.0) * Vector2{Math::cos(angle), Math::sin(angle)});
    }
    double sum = 0.0;
    for (std::vector<int> const &piece : convexPieces(points))
    {
      std::vector<Vector2> corners;
      for (int const i : piece)
        corners.push_back(points[i]);
      EXPECT_GT(polygonArea(corners), 0.0);
      sum += polygonArea(corners);
    }
    EXPECT_NEAR(polygonArea(points), sum, 1e-14);
  }
}

// A notch whose point lies on the diagonals of the square: fused products put it on either side of them.
TEST(ConvexPieces, cornersOnDiagonals_areCutWithoutLoss)
{
  std::vector<Vector2> const square = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {0.0, 0.0}, {-1.0, 1.0}};
  for (double const scale : {0.1, 0.3, 0.7, 1.0 / 3.0})
    for (std::size_t first = 0; first < square.size(); ++first)
    {
      std::vector<Vector2> points;
      for (std::size_t i = 0; i < square.size(); ++i)
        points.push_back(scale * square[(first + i) % square.size()] + Vector2{0.1, -0.7});
      double sum = 0.0;
      for (std::vector<int> const &piece : convexPieces(points))
      {
        std::vector<Vector2> corners;
        for (int const i : piece)
          corners.push_back(points[i]);
        sum += polygonArea(corners);
      }
      EXPECT_NEAR(sum, 3.0 * scale * scale, 1e-14);
    }
}
