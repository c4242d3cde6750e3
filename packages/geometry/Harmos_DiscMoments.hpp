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

/// Moments about `origin` of the circular segment between an arc and its chord, counter-clockwise from p to q, both on
/// the circle, of angle theta at most pi/2 (a negative one, which round-off may bring, counts negative):
/// V = R^2 (theta - sin theta) / 2, first = V c + (2/3) R^3 sin^3(theta/2) m, c the centre and m the unit vector to the
/// arc's middle.
KOKKOS_INLINE_FUNCTION Moments<1> circularSegmentMoments(Disc const &disc, Vector2 const &p, Vector2 const &q,
                                                         Vector2 const &origin)
{
  Vector2 const a = p - disc.centre;
  Vector2 const b = q - disc.centre;
  double half_sine = 0.5 * norm(q - p) / disc.radius;
  if (cross(a, b) < 0.0)
    half_sine = -half_sine;
  double const theta = 2.0 * Math::asin(Math::clamp(half_sine, -1.0, 1.0));
  double const volume = 0.5 * disc.radius * disc.radius * angleMinusSine(theta);
  double const lever = 2.0 / 3.0 * disc.radius * disc.radius * disc.radius * half_sine * half_sine * half_sine;
  Vector2 const first = volume * (disc.centre - origin) + lever * normalised(a + b);
  return Moments<1>{{volume, first[0], first[1]}};
}

/// Moments about `origin` of the triangle (origin, a, b).
KOKKOS_INLINE_FUNCTION Moments<1> triangleMoments(Vector2 const &origin, Vector2 const &a, Vector2 const &b)
{
  Vector2 const p = a - origin;
  Vector2 const q = b - origin;
  double const c = cross(p, q);
  return Moments<1>{{0.5 * c, c * (p[0] + q[0]) / 6.0, c * (p[1] + q[1]) / 6.0}};
}

/// The same region's moments about (0, 0).
KOKKOS_INLINE_FUNCTION Moments<1> aboutZero(Moments<1> m, Vector2 const &origin)
{
  for (int d = 0; d < 2; ++d)
    m.value[1 + d] += origin[d] * m.value[0];
  return m;
}

/// Moments about (0, 0) of disc ∩ convex polygon, where the polygon lies in one quadrant about the disc's centre.
///
/// The boundary of the intersection is one loop: the parts of the polygon's edges inside the disc, joined by arcs of at
/// most a quarter turn. Each arc is its chord and a circular segment, so that nothing of the size of the radius
/// cancels.
template <int Capacity>
KOKKOS_INLINE_FUNCTION Moments<1> discMomentsInQuadrant(Polygon<Capacity> const &polygon, Disc const &disc)
{
  Moments<1> m;
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
      m += triangleMoments(first, last, p);
      m += circularSegmentMoments(disc, last, p, first);
    }
    m += triangleMoments(first, p, q);
    last = q;
    any = true;
  }
  if (any && (last[0] != first[0] || last[1] != first[1]))
    m += circularSegmentMoments(disc, last, first, first);
  return aboutZero(m, first);
}

/// Moments about (0, 0) of disc ∩ convex polygon, counter-clockwise: closed form, exact but for round-off.
///
/// The polygon is cut along the axes through the centre (only where they meet it), so that no arc exceeds a quarter
/// turn and no arc can be taken for its complement. Put (0, 0) near the polygon.
template <int Capacity>
KOKKOS_INLINE_FUNCTION Moments<1> discMoments(Polygon<Capacity> const &polygon, Disc const &disc)
{
  Moments<1> m;
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
      m += discMomentsInQuadrant(quarter, disc);
    }
  }
  return m;
}

} // namespace Harmos

#endif
