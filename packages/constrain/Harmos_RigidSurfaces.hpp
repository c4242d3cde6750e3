// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RIGID_SURFACES_HPP
#define HARMOS_RIGID_SURFACES_HPP

#include <Harmos_Kokkos.hpp>
#include <Harmos_Shape.hpp>
#include <Harmos_WorkArrays.hpp>

#include <vector>

namespace Harmos
{

/// A smooth part of a rigid body's outline: a straight edge (or the line of a half-plane), or a whole circle.
struct RigidSurface
{
  Vector2 origin; // edge: its first corner, or a point of the line; circle: the centre
  Vector2 normal; // edge: unit, leaves the body
  double length;  // edge, from the origin along perpendicular(normal); below zero: no end [length]
  double radius;  // circle; zero: an edge [length]
  double outward; // circle: 1, or -1 for a hole

  KOKKOS_INLINE_FUNCTION bool isLine() const { return length < 0.0; }

  /// Unit vector at the foot of x that leaves the body.
  KOKKOS_INLINE_FUNCTION Vector2 normalAt(Vector2 const &x) const
  {
    return radius > 0.0 ? outward * normalised(x - origin) : normal;
  }

  /// Distance of x from the surface, negative within the body.
  KOKKOS_INLINE_FUNCTION double height(Vector2 const &x) const
  {
    return radius > 0.0 ? outward * (norm(x - origin) - radius) : dot(x - origin, normal);
  }

  /// Whether the foot of x lies on the surface, and not beyond an end of the edge.
  KOKKOS_INLINE_FUNCTION bool isBeside(Vector2 const &x) const
  {
    double const along = dot(x - origin, perpendicular(normal));
    return radius > 0.0 || isLine() || (along >= 0.0 && along <= length);
  }
};

/// The outlines of all rigid bodies as kernels see them; without outlines both are empty.
struct RigidSurfaces
{
  View<int *> first; // bodies + 1: number of a body's first surface
  View<RigidSurface *> surface;

  /// \brief The outward normal of a rigid body where a point of contact has its foot on the outline.
  ///
  /// That of the surface which the body's own facet stands for: it is no farther from the facet's midpoint than half of
  /// a cell, and turned from it by 41 degrees at most (a half-plane: at all, it has nothing else); of several the
  /// nearest. A facet that cuts off a right corner, and one where another body is painted over this one, stands for
  /// none.
  ///
  /// \param midpoint, facet_normal Of the body's facet; the normal leaves the body. \param point Of contact.
  /// \return Zero where there is none, and where the foot lies beyond the ends of the edge: at a corner it is the other
  /// body's surface that tells the normal.
  KOKKOS_INLINE_FUNCTION Vector2 normalAt(int body, Vector2 const &midpoint, Vector2 const &facet_normal,
                                          double cell_size, Vector2 const &point) const
  {
    constexpr double reach = 0.5;         // cells
    constexpr double least_cosine = 0.75; // of the angle between facet and surface
    Vector2 normal{0.0, 0.0};
    if (first.extent(0) == 0)
      return normal;
    double nearest = reach * cell_size;
    for (int k = first(body); k < first(body + 1); ++k)
    {
      RigidSurface const &s = surface(k);
      double const distance = Math::fabs(s.height(midpoint));
      bool const alike = s.isLine() || dot(s.normalAt(midpoint), facet_normal) >= least_cosine;
      if (distance < nearest && s.isBeside(midpoint) && alike)
      {
        nearest = distance;
        normal = s.isBeside(point) ? s.normalAt(point) : Vector2{0.0, 0.0};
      }
    }
    return normal;
  }
};

/// \param outline By rigid body, at its present pose.
RigidSurfaces rigidSurfaces(std::vector<Shape> const &outline, WorkArrays const &work = {});

} // namespace Harmos

#endif
