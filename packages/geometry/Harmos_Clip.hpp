// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CLIP_HPP
#define HARMOS_CLIP_HPP

#include <Harmos_Polygon.hpp>

namespace Harmos
{

/// The part of a polygon on the inside (dot(normal, x) <= offset) of a line.
///
/// Sutherland & Hodgman, Commun. ACM 17 (1974) 32-42. Exact area for non-convex subjects as well (an edge may be
/// run through twice). A vertex on the line is kept once. Capacity overflow cannot happen for convex subjects with
/// size < CapacityOut; elsewhere the surplus vertex is dropped and `overflow` is raised.
template <int CapacityIn, int CapacityOut>
HARMOS_LARGE_FUNCTION bool clip(Polygon<CapacityIn> const &subject, Plane2 const &line, Polygon<CapacityOut> &result)
{
  bool complete = true;
  result.size = 0;
  if (subject.size < 3)
    return complete;
  Vector2 a = subject[subject.size - 1];
  double da = line.distance(a);
  for (int i = 0; i < subject.size; ++i)
  {
    Vector2 const b = subject[i];
    double const db = line.distance(b);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0))
    {
      double const s = da / (da - db);
      complete = result.push(a + s * (b - a)) && complete;
    }
    if (db <= 0.0)
      complete = result.push(b) && complete;
    a = b;
    da = db;
  }
  if (result.size < 3)
    result.size = 0;
  return complete;
}

/// The line through the directed edge a->b of a counter-clockwise polygon; the polygon is inside. Not normalised.
KOKKOS_INLINE_FUNCTION Plane2 edgeLine(Vector2 const &a, Vector2 const &b)
{
  Vector2 const outward{b[1] - a[1], a[0] - b[0]};
  return {outward, dot(outward, a)};
}

/// The part of `subject` inside the convex, counter-clockwise `window`. Returns false on capacity overflow.
template <int CapacityIn, int CapacityWindow, int CapacityOut>
HARMOS_LARGE_FUNCTION bool clipConvex(Polygon<CapacityIn> const &subject, Polygon<CapacityWindow> const &window,
                                      Polygon<CapacityOut> &result)
{
  bool complete = true;
  result.size = 0;
  for (int i = 0; i < subject.size; ++i)
    complete = result.push(subject[i]) && complete;
  Polygon<CapacityOut> buffer;
  Polygon<CapacityOut> *now = &result;
  Polygon<CapacityOut> *next = &buffer;
  for (int k = 0; k < window.size && now->size > 0; ++k)
  {
    Plane2 const line = edgeLine(window[k], window[window.next(k)]);
    double nearest = line.distance((*now)[0]);
    double farthest = nearest;
    for (int i = 1; i < now->size; ++i)
    {
      double const d = line.distance((*now)[i]);
      nearest = Math::min(nearest, d);
      farthest = Math::max(farthest, d);
    }
    if (farthest <= 0.0)
      continue;
    if (nearest >= 0.0)
    {
      now->size = 0;
      break;
    }
    complete = clip(*now, line, *next) && complete;
    Polygon<CapacityOut> *const swapped = now;
    now = next;
    next = swapped;
  }
  if (now != &result)
    result = *now;
  return complete;
}

} // namespace Harmos

#endif
