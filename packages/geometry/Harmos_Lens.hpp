// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LENS_HPP
#define HARMOS_LENS_HPP

#include <Harmos_Polygon.hpp>

namespace Harmos
{

/// Part of an outline between two points on it, counter-clockwise. A place on an outline is the number of an edge plus
/// the part of it that lies behind; `length` counts edges, across vertex 0 too.
struct OutlineArc
{
  double start, length;
  Vector2 from, to;
};

/// What two polygons have in common between two crossings of their outlines that follow each other on both.
struct Lens
{
  OutlineArc of_a, of_b; // the arc of a that lies in b, and that of b in a; each begins where the other ends
  double area;           // between the two arcs [length^2]
};

constexpr int most_lenses = 8; // of two polygons

struct Lenses
{
  int size = 0;
  Lens lens[most_lenses];
};

namespace LensDetail
{

constexpr int most_crossings = 2 * most_lenses;

struct Crossing
{
  double on_a, on_b;
  Vector2 point;
  bool enters; // a's outline goes into b
};

/// Places on an outline of n edges: how far along it `to` is ahead of `from`.
KOKKOS_INLINE_FUNCTION double ahead(double from, double to, int n)
{
  return to >= from ? to - from : to - from + n;
}

/// Whether a point is on the left of a line through two points of the other polygon. A point on the line is where it
/// were if b had been shifted by (d, d^2), d next to nothing: so the answers agree with each other, as those of `zero
/// is right` do not (Edelsbrunner & Muecke, ACM Trans. Graph. 9 (1990) 66). \param sign 1 where the point is a's, -1
/// where it is b's
KOKKOS_INLINE_FUNCTION bool isLeft(Vector2 const &from, Vector2 const &to, Vector2 const &point, double sign)
{
  Vector2 const along = to - from;
  double const side = cross(along, point - from);
  double const shifted = sign * (along[1] != 0.0 ? along[1] : -along[0]);
  return side > 0.0 || (side == 0.0 && shifted > 0.0);
}

/// Crossings in ascending order along a. \return Their number, or -1: more than fit.
template <int Capacity>
KOKKOS_INLINE_FUNCTION int findCrossings(Polygon<Capacity> const &a, Polygon<Capacity> const &b, Crossing *found)
{
  int size = 0;
  for (int i = 0; i < a.size; ++i)
  {
    Vector2 const p = a[i], q = a[a.next(i)];
    int const first = size;
    for (int j = 0; j < b.size; ++j)
    {
      Vector2 const r = b[j], s = b[b.next(j)];
      bool const p_left = isLeft(r, s, p, 1.0), q_left = isLeft(r, s, q, 1.0);
      if (p_left == q_left || isLeft(p, q, r, -1.0) == isLeft(p, q, s, -1.0))
        continue;
      if (size == most_crossings)
        return -1;
      double const dp = cross(s - r, p - r), dq = cross(s - r, q - r);
      double const dr = cross(q - p, r - p), ds = cross(q - p, s - p);
      double const t = dp != dq ? Math::clamp(dp / (dp - dq), 0.0, 1.0) : 0.0;
      double const u = dr != ds ? Math::clamp(dr / (dr - ds), 0.0, 1.0) : 0.0;
      found[size++] = {i + t, j + u, p + t * (q - p), q_left};
    }
    for (int k = first + 1; k < size; ++k)
      for (int m = k; m > first && found[m].on_a < found[m - 1].on_a; --m)
      {
        Crossing const other = found[m];
        found[m] = found[m - 1];
        found[m - 1] = other;
      }
  }
  return size;
}

/// Twice the area that an arc sweeps about the origin.
template <int Capacity>
KOKKOS_INLINE_FUNCTION double swept(Polygon<Capacity> const &p, OutlineArc const &arc, Vector2 const &origin)
{
  double twice = 0.0;
  Vector2 last = arc.from - origin;
  int vertex = static_cast<int>(arc.start) + 1;
  for (; vertex < arc.start + arc.length; ++vertex)
  {
    Vector2 const next = p[vertex % p.size] - origin;
    twice += cross(last, next);
    last = next;
  }
  return twice + cross(last, arc.to - origin);
}

/// The nearest vertices of an outline ahead of a point on it and behind, farther from it than `tolerance`.
struct Around
{
  int next, last; // may lie beyond 0 .. size - 1: whole turns
};

template <int Capacity>
KOKKOS_INLINE_FUNCTION Vector2 const &vertexAt(Polygon<Capacity> const &p, int number)
{
  return p[(number + 2 * p.size) % p.size];
}

template <int Capacity>
KOKKOS_INLINE_FUNCTION Around verticesAround(Polygon<Capacity> const &p, double place, Vector2 const &point,
                                             double tolerance)
{
  int const edge = static_cast<int>(place);
  Around around{edge + 1, edge};
  while (norm(vertexAt(p, around.next) - point) <= tolerance && around.next < edge + p.size)
    ++around.next;
  while (norm(vertexAt(p, around.last) - point) <= tolerance && around.last > edge - p.size)
    --around.last;
  return around;
}

/// How far two edges from a common point run along each other: to the nearer end, where that is by the other edge.
KOKKOS_INLINE_FUNCTION Vector2 commonStretch(Vector2 const &a, Vector2 const &b, double tolerance)
{
  bool const a_ends = dot(a, a) < dot(b, b);
  Vector2 const nearer = a_ends ? a : b, other = a_ends ? b : a;
  bool const along = dot(a, b) > 0.0 && Math::fabs(cross(nearer, other)) <= tolerance * norm(other);
  return along ? nearer : Vector2{0.0, 0.0};
}

/// The place of a point near edge `edge`.
template <int Capacity>
KOKKOS_INLINE_FUNCTION double placeOn(Polygon<Capacity> const &p, int edge, Vector2 const &point)
{
  Vector2 const from = vertexAt(p, edge), along = vertexAt(p, edge + 1) - from;
  double const whole = dot(along, along);
  double const place =
      (edge + 2 * p.size) % p.size + (whole > 0.0 ? Math::clamp(dot(point - from, along) / whole, 0.0, 1.0) : 0.0);
  return place < p.size ? place : 0.0;
}

/// Where outlines run along each other before they part, round-off decides where they cross: they shall do so halfway.
template <int Capacity>
KOKKOS_INLINE_FUNCTION void settle(Polygon<Capacity> const &a, Polygon<Capacity> const &b, double tolerance,
                                   Crossing &c)
{
  Around const on_a = verticesAround(a, c.on_a, c.point, tolerance);
  Around const on_b = verticesAround(b, c.on_b, c.point, tolerance);
  Vector2 const ahead = commonStretch(vertexAt(a, on_a.next) - c.point, vertexAt(b, on_b.next) - c.point, tolerance);
  Vector2 const behind = commonStretch(vertexAt(a, on_a.last) - c.point, vertexAt(b, on_b.last) - c.point, tolerance);
  double const forward = dot(ahead, ahead), backward = dot(behind, behind);
  if (!(forward > 0.0) && !(backward > 0.0))
    return;
  if (forward > 0.0 && backward > 0.0 &&
      Math::fabs(cross(ahead, behind)) > tolerance * Math::sqrt(Math::max(forward, backward)))
    return; // they share a corner: no straight stretch
  c.point += 0.5 * (ahead + behind);
  c.on_a = placeOn(a, forward > backward ? on_a.next - 1 : on_a.last, c.point);
  c.on_b = placeOn(b, forward > backward ? on_b.next - 1 : on_b.last, c.point);
}

/// The crossings of two outlines, each where it settles: of several along one stretch those that enter and leave
/// cancel. \return Their number.
template <int Capacity>
KOKKOS_INLINE_FUNCTION int settledCrossings(Polygon<Capacity> const &a, Polygon<Capacity> const &b, double tolerance,
                                            Crossing *crossing)
{
  int size = findCrossings(a, b, crossing);
  for (int i = 0; i < size; ++i)
    settle(a, b, tolerance, crossing[i]);
  auto const cancel = [&](int i, int j) {
    return crossing[i].enters != crossing[j].enters && norm(crossing[j].point - crossing[i].point) <= 4.0 * tolerance;
  };
  for (int i = 0; i + 1 < size;)
  {
    if (!cancel(i, i + 1))
    {
      ++i;
      continue;
    }
    for (int k = i + 2; k < size; ++k)
      crossing[k - 2] = crossing[k];
    size -= 2;
    i = i > 0 ? i - 1 : 0;
  }
  int first = 0;
  while (size - first > 1 && cancel(first, size - 1))
  {
    ++first;
    --size;
  }
  for (int k = first; k < size; ++k)
    crossing[k - first] = crossing[k];
  return Math::max(size - first, 0);
}

} // namespace LensDetail

/// The lenses of two simple polygons, counter-clockwise: where a's outline enters b and the next crossing along it is
/// also the last one along b's. What is enclosed otherwise (a polygon within the other, outlines that cross in another
/// order) is none. Where outlines run along each other they cross halfway. Places and areas follow from the arguments
/// in their order: (b, a) gives them to round-off, or others where vertices lie on edges exactly.
///
/// \param tolerance Outlines that are not farther from each other run along each other. [length]
template <int Capacity>
KOKKOS_INLINE_FUNCTION Lenses lensesOf(Polygon<Capacity> const &a, Polygon<Capacity> const &b, double tolerance)
{
  using namespace LensDetail;
  Lenses lenses;
  Crossing crossing[most_crossings];
  int const size = settledCrossings(a, b, tolerance, crossing);
  for (int i = 0; i < size; ++i)
  {
    int const j = i + 1 == size ? 0 : i + 1;
    if (j == i || !crossing[i].enters || crossing[j].enters || lenses.size == most_lenses)
      continue;
    double const on_b = ahead(crossing[j].on_b, crossing[i].on_b, b.size);
    bool follows = true;
    for (int k = 0; k < size; ++k)
      follows = follows && (k == i || k == j || ahead(crossing[j].on_b, crossing[k].on_b, b.size) > on_b);
    if (!follows)
      continue;
    Crossing const from = crossing[i], to = crossing[j];
    Lens lens;
    lens.of_a = {from.on_a, ahead(from.on_a, to.on_a, a.size), from.point, to.point};
    lens.of_b = {to.on_b, ahead(to.on_b, from.on_b, b.size), to.point, from.point};
    lens.area = 0.5 * (swept(a, lens.of_a, crossing[i].point) + swept(b, lens.of_b, crossing[i].point));
    lenses.lens[lenses.size++] = lens;
  }
  return lenses;
}

/// Arcs of one outline that do not run into each other, in ascending order of their starts.
struct OutlineArcs
{
  int size = 0;
  OutlineArc arc[most_lenses];

  /// \param edges Of the outline. \return False, and no change, where it runs into another or no room is left.
  KOKKOS_INLINE_FUNCTION bool add(OutlineArc const &other, int edges)
  {
    constexpr double slack = 1e-9; // of an edge: arcs that end where the next begins, at a cell face
    if (size == most_lenses)
      return false;
    for (int i = 0; i < size; ++i)
      if (LensDetail::ahead(arc[i].start, other.start, edges) + slack < arc[i].length ||
          LensDetail::ahead(other.start, arc[i].start, edges) + slack < other.length)
        return false;
    int place = size++;
    for (; place > 0 && arc[place - 1].start > other.start; --place)
      arc[place] = arc[place - 1];
    arc[place] = other;
    return true;
  }
};

/// A polygon with straight lines in the place of arcs of its outline. \return False where the vertices do not fit.
template <int Capacity>
KOKKOS_INLINE_FUNCTION bool straightened(Polygon<Capacity> const &p, OutlineArcs const &arcs, Polygon<Capacity> &result)
{
  result.size = 0;
  bool fits = true;
  for (int i = 0; i < arcs.size; ++i)
  {
    OutlineArc const &arc = arcs.arc[i];
    double const end = arc.start + arc.length;
    double const next = i + 1 < arcs.size ? arcs.arc[i + 1].start : arcs.arc[0].start + p.size;
    fits = result.push(arc.from) && fits;
    fits = result.push(arc.to) && fits;
    for (int vertex = static_cast<int>(end) + 1; vertex < next; ++vertex)
      fits = result.push(p[vertex % p.size]) && fits;
  }
  return fits;
}

} // namespace Harmos

#endif
