// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DISC_MOMENTS_HPP
#define HARMOS_DISC_MOMENTS_HPP

#include <Harmos_Clip.hpp>
#include <Harmos_Moments.hpp>

namespace Harmos
{

/// A disc: |x - centre| <= radius.
struct Disc
{
  Vector2 centre;
  double radius; // [length], > 0

  KOKKOS_INLINE_FUNCTION bool contains(Vector2 const &x) const
  {
    Vector2 const d = x - centre;
    return dot(d, d) <= radius * radius;
  }
};

/// Every point of the convex polygon lies in the disc.
template <int Capacity>
KOKKOS_INLINE_FUNCTION bool isInside(Polygon<Capacity> const &polygon, Disc const &disc)
{
  for (int i = 0; i < polygon.size; ++i)
    if (!disc.contains(polygon[i]))
      return false;
  return true;
}

/// Every point of the convex polygon is at least a radius away from the disc's centre.
template <int Capacity>
KOKKOS_INLINE_FUNCTION bool isOutside(Polygon<Capacity> const &polygon, Disc const &disc)
{
  bool centre_inside = true;
  for (int i = 0; i < polygon.size; ++i)
  {
    Vector2 const a = polygon[i] - disc.centre;
    Vector2 const d = polygon[polygon.next(i)] - polygon[i];
    centre_inside = centre_inside && cross(d, a) <= 0.0;
    double const squared_length = dot(d, d);
    double const s = squared_length > 0.0 ? Math::clamp(-dot(a, d) / squared_length, 0.0, 1.0) : 0.0;
    if (norm(a + s * d) < disc.radius)
      return false;
  }
  return !centre_inside;
}

/// theta - sin(theta) with all its digits, also for small theta.
KOKKOS_INLINE_FUNCTION double angleMinusSine(double theta)
{
  if (Math::fabs(theta) > 0.5)
    return theta - Math::sin(theta);
  double const t = theta * theta;
  return theta * t / 6.0 *
         (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0 * (1.0 - t / 110.0 * (1.0 - t / 156.0)))));
}

/// The same region's moments about the origin that is `from` away: of x + from.
template <int Order>
KOKKOS_INLINE_FUNCTION Moments<Order> shifted(Moments<Order> m, Vector2 const &from)
{
  static_assert(Order == 1 || Order == 2, "orders 1 and 2");
  if constexpr (Order == 2)
    for (int d = 0; d < 2; ++d)
      for (int e = d; e < 2; ++e)
        m.value[3 + d + e] += from[d] * m.first(e) + from[e] * m.first(d) + from[d] * from[e] * m.volume();
  for (int d = 0; d < 2; ++d)
    m.value[1 + d] += from[d] * m.value[0];
  return m;
}

/// Moments about `origin` of the circular segment between an arc and its chord, counter-clockwise from p to q, both on
/// the circle, of angle theta at most pi/2 (a negative one, which round-off may bring, counts negative). With m the
/// unit vector from the centre to the arc's middle, t across it, about the centre: V = R^2 (theta - sin theta) / 2,
/// first = (2/3) R^3 sin^3(theta/2) m, mm = R^4 (2 theta - sin 2 theta) / 16, tt = R^4 (8 (theta - sin theta) - (2
/// theta - sin 2 theta)) / 48.
template <int Order>
KOKKOS_INLINE_FUNCTION Moments<Order> circularSegmentMoments(Disc const &disc, Vector2 const &p, Vector2 const &q,
                                                             Vector2 const &origin)
{
  Vector2 const a = p - disc.centre;
  Vector2 const b = q - disc.centre;
  double half_sine = 0.5 * norm(q - p) / disc.radius;
  if (cross(a, b) < 0.0)
    half_sine = -half_sine;
  double const theta = 2.0 * Math::asin(Math::clamp(half_sine, -1.0, 1.0));
  double const radius2 = disc.radius * disc.radius;
  double const lever = 2.0 / 3.0 * radius2 * disc.radius * half_sine * half_sine * half_sine;
  Vector2 const towards = normalised(a + b);
  Moments<Order> m;
  m.value[0] = 0.5 * radius2 * angleMinusSine(theta);
  m.value[1] = lever * towards[0];
  m.value[2] = lever * towards[1];
  if constexpr (Order == 2)
  {
    double const along = radius2 * radius2 / 16.0 * angleMinusSine(2.0 * theta);
    double const across = radius2 * radius2 / 6.0 * angleMinusSine(theta) - along / 3.0;
    m.value[3] = along * towards[0] * towards[0] + across * towards[1] * towards[1];
    m.value[4] = (along - across) * towards[0] * towards[1];
    m.value[5] = along * towards[1] * towards[1] + across * towards[0] * towards[0];
  }
  return shifted(m, disc.centre - origin);
}

/// Moments about `origin` of the triangle (origin, a, b).
template <int Order>
KOKKOS_INLINE_FUNCTION Moments<Order> triangleMoments(Vector2 const &origin, Vector2 const &a, Vector2 const &b)
{
  Polygon<3> triangle;
  triangle.push(origin);
  triangle.push(a);
  triangle.push(b);
  return moments<Order>(triangle, origin);
}

/// Moments about (0, 0) of disc ∩ convex polygon, where the polygon lies in one quadrant about the disc's centre.
///
/// The boundary of the intersection is one loop: the parts of the polygon's edges inside the disc, joined by arcs of at
/// most a quarter turn. Each arc is its chord and a circular segment, so that nothing of the size of the radius
/// cancels.
template <int Order, int Capacity>
KOKKOS_INLINE_FUNCTION Moments<Order> discMomentsInQuadrant(Polygon<Capacity> const &polygon, Disc const &disc)
{
  Moments<Order> m;
  bool any = false;
  Vector2 first = {0.0, 0.0};
  Vector2 last = {0.0, 0.0};
  for (int i = 0; i < polygon.size; ++i)
  {
    Vector2 const a = polygon[i];
    Vector2 const b = polygon[polygon.next(i)];
    double const length = norm(b - a);
    if (length == 0.0)
      continue;
    Vector2 const tangent = (1.0 / length) * (b - a);
    double const along = dot(disc.centre - a, tangent);
    double const distance = Math::fabs(cross(tangent, disc.centre - a));
    if (distance >= disc.radius)
      continue;
    double const half_chord = Math::sqrt((disc.radius - distance) * (disc.radius + distance));
    double const enter = along - half_chord;
    double const leave = along + half_chord;
    if (Math::max(enter, 0.0) >= Math::min(leave, length))
      continue;
    Vector2 const p = enter <= 0.0 ? a : a + enter * tangent;
    Vector2 const q = leave >= length ? b : a + leave * tangent;
    if (!any)
      first = p;
    else if (last[0] != p[0] || last[1] != p[1])
    {
      m += triangleMoments<Order>(first, last, p);
      m += circularSegmentMoments<Order>(disc, last, p, first);
    }
    m += triangleMoments<Order>(first, p, q);
    last = q;
    any = true;
  }
  if (any && (last[0] != first[0] || last[1] != first[1]))
    m += circularSegmentMoments<Order>(disc, last, first, first);
  return shifted(m, first);
}

/// Moments about (0, 0) of disc ∩ convex polygon, counter-clockwise: closed form, exact but for round-off.
///
/// The polygon is cut along the axes through the centre (only where they meet it), so that no arc exceeds a quarter
/// turn and no arc can be taken for its complement. Put (0, 0) near the polygon.
template <int Order = 1, int Capacity>
KOKKOS_INLINE_FUNCTION Moments<Order> discMoments(Polygon<Capacity> const &polygon, Disc const &disc)
{
  Moments<Order> m;
  Polygon<Capacity + 1> half;
  Polygon<Capacity + 2> quarter;
  for (int sx = -1; sx <= 1; sx += 2)
  {
    double const x = sx;
    clip(polygon, Plane2{{x, 0.0}, x * disc.centre[0]}, half);
    for (int sy = -1; sy <= 1; sy += 2)
    {
      double const y = sy;
      clip(half, Plane2{{0.0, y}, y * disc.centre[1]}, quarter);
      m += discMomentsInQuadrant<Order>(quarter, disc);
    }
  }
  return m;
}

} // namespace Harmos

#endif
