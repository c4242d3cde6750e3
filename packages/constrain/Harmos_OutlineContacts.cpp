// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_OutlineContacts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Harmos
{

namespace
{

constexpr int hole_directions = 6;
constexpr int outer_surface = 0, hole_surface = 1, first_direction = 2;

bool isRound(Shape const &shape)
{
  return shape.kind == Shape::Kind::Disc || shape.kind == Shape::Kind::Annulus;
}

int size(Shape const &shape)
{
  return static_cast<int>(shape.points.size());
}

Vector2 corner(Shape const &shape, int i)
{
  int const n = size(shape);
  return shape.points[static_cast<std::size_t>((i + n) % n)];
}

/// Unit vector along an edge, counter-clockwise.
Vector2 along(Shape const &shape, int edge)
{
  return normalised(corner(shape, edge + 1) - corner(shape, edge));
}

bool isConvex(Shape const &shape, int i)
{
  return cross(along(shape, i - 1), along(shape, i)) > 0.0;
}

/// A circle's (or corner's) distance from a hole's edge at a place of it. \param out Unit vector from the circle's
/// centre.
OutlineGap inHole(Vector2 const &centre, double radius, Shape const &b, Vector2 const &out)
{
  Vector2 const point = centre + radius * out, from = point - b.centre;
  double const distance = norm(from);
  return {point, distance > 0.0 ? (1.0 / distance) * from : out, b.inner_radius - distance};
}

OutlineGap onCircles(Vector2 const &centre, double radius, Shape const &b, int surface)
{
  Vector2 const apart = b.centre - centre;
  double const distance = norm(apart);
  Vector2 const to = distance > 0.0 ? (1.0 / distance) * apart : Vector2{1.0, 0.0};
  if (surface == outer_surface)
    return {centre + radius * to, to, distance - b.outer_radius - radius};
  if (surface == hole_surface)
    return {centre - radius * to, -to, b.inner_radius - distance - radius};
  double const angle = (surface - first_direction) * 2.0 * Math::pi / hole_directions;
  return inHole(centre, radius, b, {std::cos(angle), std::sin(angle)});
}

/// Whether the foot of x on an edge lies on the edge.
bool besideEdge(Shape const &b, int edge, Vector2 const &x)
{
  constexpr double tolerance = 1e-9; // of the edge
  Vector2 const from = corner(b, edge), to = corner(b, edge + 1);
  double const part = dot(x - from, to - from) / dot(to - from, to - from);
  return part >= -tolerance && part <= 1.0 + tolerance;
}

/// Whether a convex corner is the nearest of its polygon's points around it.
bool beforeCorner(Shape const &b, int i, Vector2 const &x)
{
  Vector2 const from = x - corner(b, i);
  return isConvex(b, i) && dot(from, along(b, i - 1)) > 0.0 && dot(from, along(b, i)) < 0.0;
}

/// Places of one feature on polygon b.
void onPolygon(Shape const &a, Shape const &b, OutlineFeature const &f, double reach, std::vector<OutlinePlace> &places)
{
  bool const circle = f.number == outer_circle;
  std::vector<OutlineGap> edge;
  std::vector<OutlinePlace> on_edge;
  for (int i = 0; i < size(b); ++i)
  {
    OutlineGap const here = outlineGap(a, b, {f.number, i});
    bool const before = !circle || here.gap + f.radius >= 0.0;
    if (before && Math::fabs(here.gap) < reach && besideEdge(b, i, f.centre) && mayLieOn(f, -here.normal))
    {
      edge.push_back(here);
      on_edge.push_back({f.number, i});
    }
    if (circle && beforeCorner(b, i, f.centre) && Math::fabs(outlineGap(a, b, {f.number, size(b) + i}).gap) < reach)
      places.push_back({f.number, size(b) + i});
  }
  // The far side of a thin body faces the other way.
  for (std::size_t i = 0; i < edge.size(); ++i)
    if (std::none_of(edge.begin(), edge.end(),
                     [&](OutlineGap const &e)
                     { return edge[i].gap < e.gap && e.gap <= 0.0 && dot(edge[i].normal, e.normal) < -0.5; }))
      places.push_back(on_edge[i]);
}

void onRound(Shape const &a, Shape const &b, OutlineFeature const &f, double reach, bool circles,
             std::vector<OutlinePlace> &places)
{
  bool const circle = f.number == outer_circle;
  bool const inside = b.kind == Shape::Kind::Annulus && f.radius <= b.inner_radius &&
                      norm(f.centre - b.centre) < 0.5 * (b.inner_radius + b.outer_radius);
  // A corner on a disc is found as the disc's circle on the corner.
  int const first = inside ? hole_surface : outer_surface;
  int const last = inside ? (circle ? first_direction + hole_directions - 1 : hole_surface)
                          : (circle && circles ? outer_surface : outer_surface - 1);
  for (int surface = first; surface <= last; ++surface)
    if (Math::fabs(outlineGap(a, b, {f.number, surface}).gap) < reach)
      places.push_back({f.number, surface});
}

} // namespace

std::vector<OutlineFeature> outlineFeatures(Shape const &shape)
{
  if (isRound(shape))
    return {{outer_circle, shape.centre, shape.outer_radius, {}}};
  std::vector<OutlineFeature> features;
  for (int i = 0; i < size(shape); ++i)
    if (isConvex(shape, i))
      features.push_back({i, corner(shape, i), 0.0, {-along(shape, i - 1), along(shape, i)}});
  return features;
}

OutlineGap outlineGap(Shape const &a, Shape const &b, OutlinePlace const &place)
{
  bool const circle = place.feature == outer_circle;
  Vector2 const centre = circle ? a.centre : corner(a, place.feature);
  double const radius = circle ? a.outer_radius : 0.0;
  if (isRound(b))
    return onCircles(centre, radius, b, place.surface);
  if (b.kind != Shape::Kind::HalfPlane && place.surface >= size(b))
  {
    Vector2 const apart = corner(b, place.surface - size(b)) - centre;
    double const distance = norm(apart);
    Vector2 const to = distance > 0.0 ? (1.0 / distance) * apart : Vector2{1.0, 0.0};
    return {centre + radius * to, to, distance - radius};
  }
  bool const line = b.kind == Shape::Kind::HalfPlane;
  Vector2 const normal = line ? b.normal : -perpendicular(along(b, place.surface));
  Vector2 const on_it = line ? b.centre : corner(b, place.surface);
  return {centre - radius * normal, -normal, dot(normal, centre - on_it) - radius};
}

double clearance(Shape const &a, Shape const &b, OutlinePlace const &place)
{
  bool const in_hole = place.feature == outer_circle && b.kind == Shape::Kind::Annulus && place.surface >= hole_surface;
  return in_hole ? Math::max(b.inner_radius - a.outer_radius, 0.0) : std::numeric_limits<double>::max();
}

std::vector<OutlinePlace> outlinePlaces(Shape const &a, Shape const &b, double reach, bool circles)
{
  std::vector<OutlinePlace> places;
  for (OutlineFeature const &f : outlineFeatures(a))
    if (isRound(b))
      onRound(a, b, f, reach, circles, places);
    else if (b.kind != Shape::Kind::HalfPlane)
      onPolygon(a, b, f, reach, places);
    else if (Math::fabs(outlineGap(a, b, {f.number, 0}).gap) < reach && mayLieOn(f, b.normal))
      places.push_back({f.number, 0});
  return places;
}

} // namespace Harmos
