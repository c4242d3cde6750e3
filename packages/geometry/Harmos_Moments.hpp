// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MOMENTS_HPP
#define HARMOS_MOMENTS_HPP

#include <Harmos_Polygon.hpp>

namespace Harmos
{

/// Integrals over a polygon of the monomials up to total degree Order: [1], [x, y], [xx, xy, yy], [xxx, xxy, xyy, yyy].
///
/// Additive over disjoint polygons. All relative to one origin, which the caller knows.
template <int Order>
struct Moments
{
  static_assert(Order >= 0 && Order <= 3, "orders 0 to 3");
  static constexpr int count = (Order + 1) * (Order + 2) / 2;
  double value[count] = {};

  KOKKOS_INLINE_FUNCTION double volume() const { return value[0]; }
  KOKKOS_INLINE_FUNCTION double first(int d) const { return value[1 + d]; }
  KOKKOS_INLINE_FUNCTION double second(int d, int e) const { return value[3 + d + e]; }
  KOKKOS_INLINE_FUNCTION double third(int d, int e, int f) const { return value[6 + d + e + f]; }

  /// first / volume; meaningless where the volume is zero.
  KOKKOS_INLINE_FUNCTION Vector2 centroid() const { return {value[1] / value[0], value[2] / value[0]}; }

  KOKKOS_INLINE_FUNCTION Moments &operator+=(Moments const &b)
  {
    for (int i = 0; i < count; ++i)
      value[i] += b.value[i];
    return *this;
  }
  KOKKOS_INLINE_FUNCTION Moments &operator-=(Moments const &b)
  {
    for (int i = 0; i < count; ++i)
      value[i] -= b.value[i];
    return *this;
  }
};

/// x^(3 - k) y^k
KOKKOS_INLINE_FUNCTION double cubic(Vector2 const &p, int k)
{
  double product = 1.0;
  for (int i = 0; i < 3; ++i)
    product *= p[i < 3 - k ? 0 : 1];
  return product;
}

/// Moments of a simple polygon about `origin`, by the divergence theorem (a sum over edges, exact for polynomials):
/// with c = a x b of an edge a->b,
/// V = sum c / 2, first = sum c (a + b) / 6, second_de = sum c (a_d a_e + b_d b_e + (a_d b_e + a_e b_d) / 2) / 12;
/// third = sum c / 5 times the monomial's mean along the edge.
///
/// \param polygon Counter-clockwise gives a positive volume. [length]
/// \param origin  The moments are of x - origin: take a point near the polygon, so that the digits stay. [length]
/// \return [length^2, length^3, length^4, length^5]
template <int Order, int Capacity>
KOKKOS_INLINE_FUNCTION Moments<Order> moments(Polygon<Capacity> const &polygon, Vector2 const &origin)
{
  Moments<Order> m;
  if (polygon.size < 3)
    return m;
  Vector2 a = polygon[polygon.size - 1] - origin;
  for (int i = 0; i < polygon.size; ++i)
  {
    Vector2 const b = polygon[i] - origin;
    double const c = cross(a, b);
    m.value[0] += c;
    if constexpr (Order >= 1)
    {
      m.value[1] += c * (a[0] + b[0]);
      m.value[2] += c * (a[1] + b[1]);
    }
    if constexpr (Order >= 2)
    {
      m.value[3] += c * (a[0] * a[0] + b[0] * b[0] + a[0] * b[0]);
      m.value[4] += c * (a[0] * a[1] + b[0] * b[1] + 0.5 * (a[0] * b[1] + b[0] * a[1]));
      m.value[5] += c * (a[1] * a[1] + b[1] * b[1] + a[1] * b[1]);
    }
    if constexpr (Order >= 3)
    {
      // Simpson's rule is exact for cubics
      Vector2 const middle = 0.5 * (a + b);
      for (int k = 0; k < 4; ++k)
        m.value[6 + k] += c * (cubic(a, k) + 4.0 * cubic(middle, k) + cubic(b, k));
    }
    a = b;
  }
  m.value[0] *= 0.5;
  for (int i = 1; i < Moments<Order>::count; ++i)
    m.value[i] *= i < 3 ? 1.0 / 6.0 : (i < 6 ? 1.0 / 12.0 : 1.0 / 30.0);
  return m;
}

} // namespace Harmos

#endif
