// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Shape.hpp>

#include <Harmos_ConvexPieces.hpp>
#include <Harmos_ShapeRegion.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

namespace Harmos
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

void require(bool condition, std::string const &message)
{
  if (!condition)
    throw std::invalid_argument(message);
}

void requireFinite(Vector2 const &x, std::string const &what)
{
  require(std::isfinite(x[0]) && std::isfinite(x[1]),
          what + " (" + std::to_string(x[0]) + ", " + std::to_string(x[1]) + ") is not finite");
}

/// std::to_string would show 0.000000.
std::string shortText(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

Vector2 turned(Vector2 const &x, double angle)
{
  double const c = std::cos(angle);
  double const s = std::sin(angle);
  return {c * x[0] - s * x[1], s * x[0] + c * x[1]};
}

/// Moments of the whole polygon about `origin`, by the formulas of Harmos_Moments.hpp.
Moments<2> polygonMoments(std::vector<Vector2> const &points, Vector2 const &origin)
{
  Moments<2> sum;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    Polygon<3> fan;
    fan.push(origin);
    fan.push(points[i]);
    fan.push(points[i + 1 == points.size() ? 0 : i + 1]);
    sum += moments<2>(fan, origin);
  }
  return sum;
}

/// No point of the segment lies in the interior of the convex cell (separating axes).
bool segmentAvoids(Quadrilateral const &cell, Vector2 const &a, Vector2 const &b)
{
  int left = 0;
  int right = 0;
  for (int k = 0; k < cell.size; ++k)
  {
    Plane2 const side = edgeLine(cell[k], cell[cell.next(k)]);
    if (side.distance(a) >= 0.0 && side.distance(b) >= 0.0)
      return true;
    double const turn = cross(b - a, cell[k] - a);
    left += turn >= 0.0 ? 1 : 0;
    right += turn <= 0.0 ? 1 : 0;
  }
  return left == cell.size || right == cell.size;
}

void addCircle(std::vector<Vector2> &points, Vector2 const &centre, double radius, int sides, int direction)
{
  // The regular polygon of circumradius rho has the area sides * rho^2 sin(2 pi / sides) / 2.
  double const step = 2.0 * Math::pi / sides;
  double const circumradius = radius * std::sqrt(step / std::sin(step));
  for (int i = 0; i < sides; ++i)
    points.push_back(centre + turned({circumradius, 0.0}, direction * i * step));
}

} // namespace

Shape Shape::rectangle(Vector2 const &centre, Vector2 const &size, double angle)
{
  requireFinite(centre, "rectangle: centre");
  requireFinite(size, "rectangle: size");
  require(std::isfinite(angle), "rectangle: angle is not finite");
  require(size[0] > 0.0 && size[1] > 0.0,
          "rectangle: size " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " must be positive");
  double const x = 0.5 * size[0];
  double const y = 0.5 * size[1];
  Shape shape;
  shape.kind = Kind::Rectangle;
  shape.centre = centre;
  for (Vector2 const &corner : {Vector2{-x, -y}, Vector2{x, -y}, Vector2{x, y}, Vector2{-x, y}})
    shape.points.push_back(centre + turned(corner, angle));
  require(polygonArea(shape.points) > 0.0, "rectangle: its size " + shortText(size[0]) + " x " + shortText(size[1]) +
                                               " is lost in the digits of its place");
  shape.pieces = {{0, 1, 2, 3}};
  return shape;
}

Shape Shape::disc(Vector2 const &centre, double radius)
{
  requireFinite(centre, "disc: centre");
  require(std::isfinite(radius) && radius > 0.0, "disc: radius " + std::to_string(radius) + " must be positive");
  Shape shape;
  shape.kind = Kind::Disc;
  shape.centre = centre;
  shape.outer_radius = radius;
  return shape;
}

Shape Shape::annulus(Vector2 const &centre, double inner_radius, double outer_radius)
{
  requireFinite(centre, "annulus: centre");
  require(std::isfinite(outer_radius) && inner_radius > 0.0 && inner_radius < outer_radius,
          "annulus: radii " + std::to_string(inner_radius) + " and " + std::to_string(outer_radius) +
              ": 0 < inner < outer is needed");
  Shape shape;
  shape.kind = Kind::Annulus;
  shape.centre = centre;
  shape.inner_radius = inner_radius;
  shape.outer_radius = outer_radius;
  return shape;
}

Shape Shape::polygon(std::vector<Vector2> const &points)
{
  Shape shape;
  shape.kind = Kind::Polygon;
  for (Vector2 const &x : points)
  {
    requireFinite(x, "polygon: point");
    if (shape.points.empty() || norm(x - shape.points.back()) > 0.0)
      shape.points.push_back(x);
  }
  while (shape.points.size() > 1 && norm(shape.points.front() - shape.points.back()) == 0.0)
    shape.points.pop_back();
  require(shape.points.size() >= 3,
          "polygon: " + std::to_string(shape.points.size()) + " distinct points, at least 3 are needed");
  requireSimple(shape.points);
  double const signed_area = polygonArea(shape.points);
  require(signed_area != 0.0, "polygon: its area vanishes");
  if (signed_area < 0.0)
    std::reverse(shape.points.begin(), shape.points.end());
  shape.pieces = convexPieces(shape.points);
  shape.centre = shape.points[0] + polygonMoments(shape.points, shape.points[0]).centroid();
  return shape;
}

Shape Shape::halfPlane(Vector2 const &point, Vector2 const &normal)
{
  requireFinite(point, "half-plane: point");
  requireFinite(normal, "half-plane: normal");
  require(norm(normal) > 0.0, "half-plane: the normal vanishes");
  Shape shape;
  shape.kind = Kind::HalfPlane;
  shape.centre = point;
  shape.normal = normalised(normal);
  shape.pieces = {{}};
  return shape;
}

Shape Shape::moved(Vector2 const &displacement, double angle) const
{
  Shape shape = *this;
  shape.centre += displacement;
  // Without a turn no digit is lost: edges that lie on grid lines stay there.
  for (Vector2 &x : shape.points)
    x = angle == 0.0 ? x + displacement : shape.centre + turned(x - centre, angle);
  if (kind == Kind::HalfPlane)
    shape.normal = turned(normal, angle);
  // Lines through corners that rounding has made one would leave out nothing.
  if (!shape.points.empty() && !(polygonArea(shape.points) > 0.0))
    shape.pieces.clear();
  return shape;
}

bool Shape::contains(Vector2 const &x) const
{
  Vector2 const d = x - centre;
  switch (kind)
  {
  case Kind::Disc:
    return dot(d, d) <= outer_radius * outer_radius;
  case Kind::Annulus:
    return dot(d, d) <= outer_radius * outer_radius && dot(d, d) >= inner_radius * inner_radius;
  case Kind::HalfPlane:
    return dot(normal, d) <= 0.0;
  case Kind::Rectangle:
  case Kind::Polygon:
    break;
  }
  for (std::vector<int> const &piece : pieces)
  {
    bool inside = true;
    for (std::size_t i = 0; i < piece.size() && inside; ++i)
    {
      Vector2 const a = points[piece[i]];
      Vector2 const b = points[piece[i + 1 == piece.size() ? 0 : i + 1]];
      inside = cross(b - a, x - a) >= 0.0;
    }
    if (inside)
      return true;
  }
  return false;
}

Box Shape::boundingBox() const
{
  if (kind == Kind::Disc || kind == Kind::Annulus)
  {
    Vector2 const r{outer_radius, outer_radius};
    return {centre - r, centre + r};
  }
  if (kind == Kind::HalfPlane)
  {
    Box box{{-infinity, -infinity}, {infinity, infinity}};
    for (int d = 0; d < 2; ++d)
      if (normal[1 - d] == 0.0)
        (normal[d] > 0.0 ? box.high[d] : box.low[d]) = centre[d];
    return box;
  }
  Box box{points[0], points[0]};
  for (Vector2 const &x : points)
    for (int d = 0; d < 2; ++d)
    {
      box.low[d] = Math::min(box.low[d], x[d]);
      box.high[d] = Math::max(box.high[d], x[d]);
    }
  return box;
}

double Shape::area() const
{
  if (kind == Kind::HalfPlane)
    return infinity;
  if (kind == Kind::Rectangle || kind == Kind::Polygon)
    return polygonArea(points);
  return Math::pi * (outer_radius - inner_radius) * (outer_radius + inner_radius);
}

double Shape::volume(Geometry geometry) const
{
  if (geometry == Geometry::Planar || kind == Kind::HalfPlane)
    return area();
  Box box = boundingBox();
  box.low[0] = std::max(box.low[0], 0.0);
  if (!(box.high[0] > box.low[0]))
    return 0.0;
  Quadrilateral whole;
  whole.push(box.low);
  whole.push({box.high[0], box.low[1]});
  whole.push(box.high);
  whole.push({box.low[0], box.high[1]});
  return intersectionMoments(whole, geometry).volume();
}

double Shape::inertia() const
{
  if (kind == Kind::HalfPlane)
    return infinity;
  if (kind == Kind::Rectangle || kind == Kind::Polygon)
  {
    Moments<2> const m = polygonMoments(points, centre);
    return m.second(0, 0) + m.second(1, 1);
  }
  double const inner = inner_radius * inner_radius;
  double const outer = outer_radius * outer_radius;
  return 0.5 * Math::pi * (outer - inner) * (outer + inner);
}

std::vector<Vector2> Shape::outline(int sides) const
{
  require(kind != Kind::HalfPlane, "outline: a half-plane has no closed outline");
  require(sides >= 3, "outline: " + std::to_string(sides) + " sides, at least 3 are needed");
  if (kind == Kind::Rectangle || kind == Kind::Polygon)
    return points;
  std::vector<Vector2> result;
  addCircle(result, centre, outer_radius, sides, 1);
  if (kind == Kind::Annulus)
  {
    result.push_back(result.front());
    std::size_t const first = result.size();
    addCircle(result, centre, inner_radius, sides, -1);
    result.push_back(result[first]);
  }
  return result;
}

CellPosition Shape::position(Quadrilateral const &cell) const
{
  if (kind == Kind::Disc || kind == Kind::Annulus)
  {
    Disc const outer{centre, outer_radius};
    Disc const inner{centre, inner_radius};
    bool const has_hole = kind == Kind::Annulus;
    if (isOutside(cell, outer) || (has_hole && isInside(cell, inner)))
      return CellPosition::Outside;
    return isInside(cell, outer) && (!has_hole || isOutside(cell, inner)) ? CellPosition::Inside : CellPosition::Cut;
  }
  if (kind == Kind::HalfPlane)
  {
    int inside = 0;
    int outside = 0;
    for (int k = 0; k < cell.size; ++k)
    {
      double const distance = dot(normal, cell[k] - centre);
      inside += distance <= 0.0 ? 1 : 0;
      outside += distance >= 0.0 ? 1 : 0;
    }
    if (outside == cell.size)
      return CellPosition::Outside;
    return inside == cell.size ? CellPosition::Inside : CellPosition::Cut;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!segmentAvoids(cell, points[i], points[i + 1 == points.size() ? 0 : i + 1]))
      return CellPosition::Cut;
  Vector2 const middle = 0.25 * (cell[0] + cell[1] + cell[2] + cell[3]);
  return contains(middle) ? CellPosition::Inside : CellPosition::Outside;
}

Moments<1> Shape::intersectionMoments(Quadrilateral const &cell, Geometry geometry) const
{
  switch (position(cell))
  {
  case CellPosition::Outside:
    return Moments<1>();
  case CellPosition::Inside:
    return moments<1>(cell, cell[0], areaWeight(geometry, cell[0]));
  case CellPosition::Cut:
    break;
  }
  ShapeRegion region(cell);
  region.intersect(*this);
  return region.moments(geometry);
}

} // namespace Harmos
