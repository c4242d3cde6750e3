// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SHARED_VOLUME_HPP
#define HARMOS_SHARED_VOLUME_HPP

#include <Harmos_AreaWeight.hpp>
#include <Harmos_Clip.hpp>

namespace Harmos
{

namespace SharedVolumeDetail
{

/// Vertices of what two convex regions have in common in a cell: 16 + 16 + 4, and room for edges that lie on one
/// another and cross by round-off.
constexpr int capacity = 64;

template <int Capacity>
KOKKOS_INLINE_FUNCTION bool turnsLeft(Polygon<Capacity> const &p)
{
  for (int i = 0; i < p.size; ++i)
  {
    Vector2 const b = p[p.next(i)];
    if (cross(b - p[i], p[p.next(p.next(i))] - b) < 0.0)
      return false;
  }
  return true;
}

/// Triangle i of the fan about vertex 0, made counter-clockwise. \return The sign of its turn.
template <int Capacity>
KOKKOS_INLINE_FUNCTION double fanTriangle(Polygon<Capacity> const &p, int i, Polygon<3> &triangle)
{
  double const twice = cross(p[i + 1] - p[0], p[i + 2] - p[0]);
  triangle.size = 3;
  triangle[0] = p[0];
  triangle[1] = twice < 0.0 ? p[i + 2] : p[i + 1];
  triangle[2] = twice < 0.0 ? p[i + 1] : p[i + 2];
  return twice > 0.0 ? 1.0 : twice < 0.0 ? -1.0 : 0.0;
}

/// Of convex polygons. \return False where the vertices did not fit.
template <int CapacityA, int CapacityB, int CapacityWindow>
HARMOS_LARGE_FUNCTION bool addShared(Polygon<CapacityA> const &a, Polygon<CapacityB> const &b,
                                     Polygon<CapacityWindow> const &window, AreaWeight const &weight, double factor,
                                     double &sum)
{
  Polygon<capacity> inside, both;
  if (!clipConvex(a, window, inside))
    return false;
  if (inside.empty())
    return true;
  if (!clipConvex(inside, b, both))
    return false;
  sum += factor * volume(both, weight);
  return true;
}

template <int Capacity>
KOKKOS_INLINE_FUNCTION Polygon<Capacity> relativeTo(Vector2 const &origin, Polygon<Capacity> p)
{
  for (int i = 0; i < p.size; ++i)
    p[i] = p[i] - origin;
  return p;
}

} // namespace SharedVolumeDetail

/// Volume that two polygons have in common within a convex window: |a ∩ b ∩ window|.
///
/// Convex polygons are clipped by one another (Harmos_Clip.hpp). The indicator of any simple polygon is the sum of
/// those of the triangles (vertex 0, i, i + 1), each with the sign of its turn; so others are cut triangle by triangle:
/// |a ∩ b ∩ window| = sum_ij s_i s_j |triangle_i ∩ triangle_j ∩ window|. Exact to round-off for all.
///
/// \param a, b     Counter-clockwise, simple; less than three vertices share nothing. [length]
/// \param window   Convex, counter-clockwise. Coordinates are taken relative to its vertex 0.
/// \return [length^2], per radian [length^3]; >= 0
template <int CapacityA, int CapacityB, int CapacityWindow>
HARMOS_LARGE_FUNCTION double sharedVolume(Polygon<CapacityA> const &a, Polygon<CapacityB> const &b,
                                          Polygon<CapacityWindow> const &window, Geometry geometry)
{
  using namespace SharedVolumeDetail;
  if (a.empty() || b.empty())
    return 0.0;
  Vector2 const origin = window[0];
  auto const p = relativeTo(origin, a);
  auto const q = relativeTo(origin, b);
  auto const cell = relativeTo(origin, window);
  AreaWeight const weight = areaWeight(geometry, origin);
  double sum = 0.0;
  if (turnsLeft(p) && turnsLeft(q) && addShared(p, q, cell, weight, 1.0, sum))
    return Math::max(sum, 0.0);
  // Seven cuts of a triangle fit whatever they do: each adds half as many vertices as there are at most.
  static_assert(capacity >= 51, "3 * 1.5^7");
  for (int i = 0; i + 2 < p.size; ++i)
    for (int j = 0; j + 2 < q.size; ++j)
    {
      Polygon<3> s, t;
      double const factor = fanTriangle(p, i, s) * fanTriangle(q, j, t);
      if (factor != 0.0)
        addShared(s, t, cell, weight, factor, sum);
    }
  return Math::max(sum, 0.0);
}

} // namespace Harmos

#endif
