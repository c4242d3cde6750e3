// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_POLYGON_HPP
#define HARMOS_POLYGON_HPP

#include <Harmos_Vector.hpp>

namespace Harmos
{

/// A polygon of at most Capacity vertices, counter-clockwise; empty when size < 3.
template <int Capacity>
struct Polygon
{
  int size = 0;
  Vector2 vertex[Capacity];

  static constexpr int capacity = Capacity;

  KOKKOS_INLINE_FUNCTION bool empty() const { return size < 3; }
  KOKKOS_INLINE_FUNCTION Vector2 const &operator[](int i) const { return vertex[i]; }
  KOKKOS_INLINE_FUNCTION Vector2 &operator[](int i) { return vertex[i]; }
  KOKKOS_INLINE_FUNCTION int next(int i) const { return i + 1 == size ? 0 : i + 1; }

  /// Append a vertex; false (and no change) when the polygon is full.
  KOKKOS_INLINE_FUNCTION bool push(Vector2 const &point)
  {
    if (size == Capacity)
      return false;
    vertex[size++] = point;
    return true;
  }
};

/// Filled regions: a quadrilateral cut by up to twelve lines.
constexpr int max_region_vertices = 16;
using Region = Polygon<max_region_vertices>;

/// Most components (materials plus void) that one cell may hold; every cut adds at most one vertex to a convex region.
constexpr int max_components = max_region_vertices - 4;

/// Signed area, coordinates relative to the first vertex. [length^2]
template <int Capacity>
KOKKOS_INLINE_FUNCTION double area(Polygon<Capacity> const &p)
{
  double twice = 0.0;
  for (int i = 1; i + 1 < p.size; ++i)
    twice += cross(p[i] - p[0], p[i + 1] - p[0]);
  return 0.5 * twice;
}

} // namespace Harmos

#endif
