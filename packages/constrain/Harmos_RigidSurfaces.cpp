// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_RigidSurfaces.hpp>

namespace Harmos
{

namespace
{

RigidSurface circle(Vector2 const &centre, double radius, double outward)
{
  return {centre, {0.0, 0.0}, 0.0, radius, outward};
}

void addSurfaces(Shape const &shape, std::vector<RigidSurface> &surfaces)
{
  switch (shape.kind)
  {
  case Shape::Kind::HalfPlane:
    surfaces.push_back({shape.centre, shape.normal, -1.0, 0.0, 0.0});
    return;
  case Shape::Kind::Annulus:
    surfaces.push_back(circle(shape.centre, shape.inner_radius, -1.0));
    surfaces.push_back(circle(shape.centre, shape.outer_radius, 1.0));
    return;
  case Shape::Kind::Disc:
    surfaces.push_back(circle(shape.centre, shape.outer_radius, 1.0));
    return;
  case Shape::Kind::Rectangle:
  case Shape::Kind::Polygon:
    break;
  }
  std::size_t const corners = shape.points.size();
  for (std::size_t i = 0; i < corners; ++i)
  {
    Vector2 const from = shape.points[i], edge = shape.points[(i + 1) % corners] - from;
    surfaces.push_back({from, -perpendicular(normalised(edge)), norm(edge), 0.0, 0.0});
  }
}

} // namespace

RigidSurfaces rigidSurfaces(std::vector<Shape> const &outline, WorkArrays const &work)
{
  if (outline.empty())
    return {};
  std::vector<RigidSurface> surfaces;
  std::vector<int> first = {0};
  for (Shape const &shape : outline)
  {
    addSurfaces(shape, surfaces);
    first.push_back(static_cast<int>(surfaces.size()));
  }
  return {work.copyOf("Harmos::constrain::rigid_first", first),
          work.copyOf("Harmos::constrain::rigid_surface", surfaces)};
}

} // namespace Harmos
