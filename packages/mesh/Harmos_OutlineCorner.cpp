// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_OutlineCorner.hpp>

#include <Harmos_Clip.hpp>
#include <Harmos_Shape.hpp>

namespace Harmos
{

namespace
{

/// Whether the edge from a to b has more than 1e-9 of the cell's size within the cell.
bool crosses(Quadrilateral const &cell, Vector2 const &a, Vector2 const &b)
{
  constexpr double least = 1e-9;
  double low = 0.0, high = 1.0; // of the way from a to b
  for (int k = 0; k < 4; ++k)
  {
    Plane2 const face = edgeLine(cell[k], cell[cell.next(k)]);
    double const from = face.distance(a), rise = face.distance(b) - from;
    if (rise > 0.0)
      high = Math::min(high, -from / rise);
    else if (rise < 0.0)
      low = Math::max(low, -from / rise);
    else if (from > 0.0)
      return false;
  }
  return (high - low) * norm(b - a) > least * Math::sqrt(area(cell));
}

} // namespace

OutlineCorner outlineCorner(Quadrilateral const &cell, Geometry geometry, Shape const &shape, double fraction)
{
  constexpr double tolerance = 1e-12, least_cut = 1e-9; // of the cell
  OutlineCorner corner;
  if (shape.kind != Shape::Kind::Polygon && shape.kind != Shape::Kind::Rectangle)
    return corner;
  Plane2 behind[2];
  int count = 0;
  for (std::size_t i = 0; i < shape.points.size(); ++i)
  {
    Vector2 const &a = shape.points[i], &b = shape.points[(i + 1) % shape.points.size()];
    if (!crosses(cell, a, b))
      continue;
    if (count == 2)
      return corner;
    Plane2 const line = edgeLine(a, b);
    double const length = norm(line.normal);
    behind[count++] = {(1.0 / length) * line.normal, line.offset / length};
  }
  if (count < 2)
    return corner;
  double const whole = volume(cell, geometry);
  for (CornerKind const kind : {CornerKind::Convex, CornerKind::Notch})
  {
    bool const convex = kind == CornerKind::Convex;
    Plane2 line[2];
    for (int l = 0; l < 2; ++l)
      line[l] = convex ? behind[l] : Plane2{-behind[l].normal, -behind[l].offset};
    Region one, two;
    clip(cell, line[0], one);
    clip(one, line[1], two);
    double const left = one.empty() ? 0.0 : volume(one, geometry) / whole;
    double const filled = two.empty() ? 0.0 : volume(two, geometry) / whole;
    if (Math::fabs(filled - (convex ? fraction : 1.0 - fraction)) > tolerance || 1.0 - left < least_cut ||
        left - filled < least_cut)
      continue;
    corner.kind = kind;
    corner.normal[0] = line[0].normal;
    corner.normal[1] = line[1].normal;
    corner.beyond = 1.0 - left;
    break;
  }
  return corner;
}

} // namespace Harmos
