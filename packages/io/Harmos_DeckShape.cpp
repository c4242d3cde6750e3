// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckBodies.hpp>

#include <Teuchos_Array.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

namespace
{

double orientation(Vector2 const &a, Vector2 const &b, Vector2 const &c)
{
  return cross(b - a, c - a);
}

/// Whether segments a-b and c-d touch at all.
bool segmentsMeet(Vector2 const &a, Vector2 const &b, Vector2 const &c, Vector2 const &d)
{
  double const o1 = orientation(a, b, c), o2 = orientation(a, b, d);
  double const o3 = orientation(c, d, a), o4 = orientation(c, d, b);
  for (int k = 0; k < 2; ++k)
    if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k]))
      return false;
  return o1 * o2 <= 0.0 && o3 * o4 <= 0.0;
}

bool isSimple(std::vector<Vector2> const &points)
{
  int const n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && segmentsMeet(points[i], points[i + 1], points[j], points[(j + 1) % n]))
        return false;
  return true;
}

/// Signed area and centroid, relative to the first corner.
double areaAndCentroid(std::vector<Vector2> const &points, Vector2 &centroid)
{
  double area = 0.0;
  Vector2 first = {0.0, 0.0};
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
  {
    Vector2 const a = points[i] - points[0], b = points[i + 1] - points[0];
    double const triangle = 0.5 * cross(a, b);
    area += triangle;
    first += (triangle / 3.0) * (a + b);
  }
  if (area != 0.0)
    centroid = points[0] + (1.0 / area) * first;
  return area;
}

/// Corners that lie on the straight line between their neighbours are none.
void removeStraightCorners(std::vector<Vector2> &points)
{
  constexpr double straight = 1e-12; // sine of the angle
  std::vector<Vector2> const all = points;
  std::size_t const n = all.size();
  points.clear();
  for (std::size_t i = 0; i < n; ++i)
  {
    Vector2 const before = all[i] - all[(i + n - 1) % n], after = all[(i + 1) % n] - all[i];
    bool const goes_on = dot(before, after) > 0.0;
    if (!goes_on || std::fabs(cross(before, after)) > straight * norm(before) * norm(after))
      points.push_back(all[i]);
  }
}

void convertPolygon(DeckChecker const &check, Teuchos::Array<double> const &numbers, std::string const &path,
                    ShapeSpec &shape)
{
  check.require(numbers.size() % 2 == 0, path,
                std::to_string(numbers.size()) + " numbers; expected: an even number of them, x0, y0, x1, y1, ...");
  for (int i = 0; i + 1 < static_cast<int>(numbers.size()); i += 2)
    shape.points.push_back({numbers[i], numbers[i + 1]});
  double const area = areaAndCentroid(shape.points, shape.center);
  removeStraightCorners(shape.points);
  check.require(area != 0.0 && shape.points.size() > 2, path, "the polygon has no area");
  check.require(isSimple(shape.points), path, "edges of the polygon cross or touch; expected: a simple polygon");
  if (area < 0.0)
    std::reverse(shape.points.begin(), shape.points.end());
}

} // namespace

Vector2 vectorOf(Teuchos::ParameterList const &list, std::string const &key)
{
  auto const &values = list.get<Teuchos::Array<double>>(key);
  return {values[0], values[1]};
}

ShapeSpec shapeOf(DeckChecker const &check, Teuchos::ParameterList const &list, std::string const &path)
{
  ShapeSpec shape;
  std::string const kind = list.get<std::string>("shape");
  if (kind == "polygon")
  {
    shape.kind = ShapeKind::Polygon;
    convertPolygon(check, list.get<Teuchos::Array<double>>("points"), keyPath(path, "points"), shape);
  }
  else if (kind == "half-plane")
  {
    shape.kind = ShapeKind::HalfPlane;
    shape.center = vectorOf(list, "point");
    Vector2 const normal = vectorOf(list, "normal");
    double const length = std::hypot(normal[0], normal[1]);
    check.require(length > 0.0, keyPath(path, "normal"), "[0.0, 0.0] has no direction");
    shape.normal = {normal[0] / length, normal[1] / length};
  }
  else if (kind == "mesh part")
  {
    shape.kind = ShapeKind::MeshPart;
    shape.part = list.get<std::string>("part");
  }
  else
    shape.center = vectorOf(list, "center");
  if (kind == "rectangle")
    shape.size = vectorOf(list, "size");
  if (kind == "disc")
  {
    shape.kind = ShapeKind::Disc;
    shape.outer_radius = list.get<double>("radius");
  }
  if (kind == "annulus")
  {
    shape.kind = ShapeKind::Annulus;
    shape.inner_radius = list.get<double>("inner_radius");
    shape.outer_radius = list.get<double>("outer_radius");
    check.require(shape.inner_radius < shape.outer_radius, keyPath(path, "inner_radius"),
                  numberText(shape.inner_radius) + " is not below outer_radius " + numberText(shape.outer_radius));
  }
  shape.angle = list.get<double>("angle") * (Math::pi / 180.0);
  shape.shift = vectorOf(list, "shift");
  return shape;
}

} // namespace Harmos
