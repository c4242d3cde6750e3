// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_AREA_WEIGHT_HPP
#define HARMOS_AREA_WEIGHT_HPP

#include <Harmos_Moments.hpp>

namespace Harmos
{

enum class Geometry : int
{
  Planar = 0,      // (x, y), per unit depth
  Axisymmetric = 1 // (r, z) with r >= 0, per radian
};

/// What an area element counts at a point x from some origin: constant + slope x[0]. Volumes are integrals of it.
///
/// Planar: 1. Axisymmetric: the radius, in whatever unit the caller chooses.
struct AreaWeight
{
  double constant = 1.0;
  double slope = 0.0;

  KOKKOS_INLINE_FUNCTION bool uniform() const { return slope == 0.0 && constant == 1.0; }
  KOKKOS_INLINE_FUNCTION double at(Vector2 const &x) const { return constant + slope * x[0]; }
};

/// The weight of a geometry for points relative to `origin`. [1, or length]
KOKKOS_INLINE_FUNCTION AreaWeight areaWeight(Geometry geometry, Vector2 const &origin)
{
  return geometry == Geometry::Axisymmetric ? AreaWeight{origin[0], 1.0} : AreaWeight{1.0, 0.0};
}

/// Weighted moments from plane ones of one order more, about the same origin: exact, since the weight is linear.
/// integral w x^i y^k = constant M(i, k) + slope M(i + 1, k).
template <int Order>
KOKKOS_INLINE_FUNCTION Moments<Order> weighted(Moments<Order + 1> const &plane, AreaWeight const &weight)
{
  Moments<Order> m;
  for (int n = 0; n <= Order; ++n)
    for (int k = 0; k <= n; ++k)
      m.value[n * (n + 1) / 2 + k] =
          weight.constant * plane.value[n * (n + 1) / 2 + k] + weight.slope * plane.value[(n + 1) * (n + 2) / 2 + k];
  return m;
}

/// Weighted moments of a simple polygon about `origin`; the weight's points are relative to it as well.
///
/// \return [length^2 ...], per radian [length^3 ...]
template <int Order, int Capacity>
KOKKOS_INLINE_FUNCTION Moments<Order> moments(Polygon<Capacity> const &polygon, Vector2 const &origin,
                                              AreaWeight const &weight)
{
  return weight.uniform() ? moments<Order>(polygon, origin)
                          : weighted<Order>(moments<Order + 1>(polygon, origin), weight);
}

/// Signed volume of a polygon: the integral of a weight whose points have the polygon's origin.
template <int Capacity>
KOKKOS_INLINE_FUNCTION double volume(Polygon<Capacity> const &polygon, AreaWeight const &weight)
{
  if (weight.uniform() || polygon.size < 3)
    return area(polygon);
  return moments<0>(polygon, polygon[0], {weight.at(polygon[0]), weight.slope}).volume();
}

/// Its area, or per radian the volume of the ring it sweeps (Pappus). [length^2, or length^3]
template <int Capacity>
KOKKOS_INLINE_FUNCTION double volume(Polygon<Capacity> const &polygon, Geometry geometry)
{
  return volume(polygon, areaWeight(geometry, {0.0, 0.0}));
}

/// Where the volume's weight balances: the area's centroid, or that of the ring's section weighted by the radius.
template <int Capacity>
KOKKOS_INLINE_FUNCTION Vector2 volumeCentroid(Polygon<Capacity> const &polygon, Geometry geometry)
{
  return polygon[0] + moments<1>(polygon, polygon[0], areaWeight(geometry, polygon[0])).centroid();
}

} // namespace Harmos

#endif
