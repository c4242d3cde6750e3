// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CLIP_PACKS_HPP
#define HARMOS_CLIP_PACKS_HPP

#include <Harmos_Moments.hpp>
#include <Harmos_Pack.hpp>

namespace Harmos
{

/// Corners of as many convex cells as a pack has lanes, relative to a point.
struct WindowPack
{
  Pack x[4], y[4];
};

/// Moments of the parts of polygons in windows, a lane each, as Moments<Order> orders them.
template <int Order>
struct OverlayPackOf
{
  Pack value[Moments<Order>::count];
  Pack pieces; // 1 or less; more: a window's side cuts the polygon, which motion has bent, into pieces, and the
               // moments are wrong
};

using OverlayPack = OverlayPackOf<2>;

constexpr int most_pack_vertices = 8;

namespace Detail
{

/// A closed chain of directed edges start -> end, in any order; edges of no length stand for what has been cut off.
struct EdgeChain
{
  int count = 0;
  Pack start_x[most_pack_vertices + 4], start_y[most_pack_vertices + 4];
  Pack end_x[most_pack_vertices + 4], end_y[most_pack_vertices + 4];
};

/// A side of each window: a point on it and its normal outwards.
struct SidePack
{
  Pack x, y, nx, ny;
  Pack active; // 1 where part of the polygon lies beyond, else 0
};

/// Swap two sides in the lanes where the second alone is active.
KOKKOS_FORCEINLINE_FUNCTION void activeFirst(SidePack &a, SidePack &b)
{
  auto const swaps = a.active < b.active;
  auto const order = [&](Pack &p, Pack &q)
  {
    Pack const first = select(swaps, q, p);
    q = select(swaps, p, q);
    p = first;
  };
  order(a.x, b.x);
  order(a.y, b.y);
  order(a.nx, b.nx);
  order(a.ny, b.ny);
  order(a.active, b.active);
}

/// The windows' sides, in each lane the active ones first. \return The most active sides of any lane; -1 where every
/// polygon lies beyond one of them.
template <class Coordinate>
KOKKOS_FORCEINLINE_FUNCTION int sidesOf(WindowPack const &w, int size, Coordinate const *x, Coordinate const *y,
                                        SidePack (&side)[4])
{
  Pack const zero = 0.0, one = 1.0;
  Pack count = zero, beyond = zero;
  for (int k = 0; k < 4; ++k)
  {
    int const next = (k + 1) & 3;
    SidePack &s = side[k];
    s.x = w.x[k];
    s.y = w.y[k];
    s.nx = w.y[next] - w.y[k];
    s.ny = w.x[k] - w.x[next];
    Pack farthest = zero, nearest = one;
    for (int i = 0; i < size; ++i)
    {
      Pack const distance = s.nx * (Pack(x[i]) - s.x) + s.ny * (Pack(y[i]) - s.y);
      farthest = Math::max(farthest, distance);
      nearest = Math::min(nearest, distance);
    }
    s.active = select(farthest > zero, one, zero);
    count += s.active;
    beyond = select(nearest < zero, beyond, one);
  }
  double meets = 1.0;
  for (int lane = 0; lane < pack_width; ++lane)
    meets = Math::min(meets, laneOf(beyond, lane));
  if (meets > 0.0)
    return -1;
  activeFirst(side[0], side[1]);
  activeFirst(side[2], side[3]);
  activeFirst(side[0], side[2]);
  activeFirst(side[1], side[3]);
  activeFirst(side[1], side[2]);
  double most = 0.0;
  for (int lane = 0; lane < pack_width; ++lane)
    most = Math::max(most, laneOf(count, lane));
  return static_cast<int>(most);
}

/// Cut off what lies beyond a side: every edge is shortened by itself, and one more closes the chain along the side. No
/// branches, no order of vertices: the lanes cut differently. \return How often the chain leaves the inside.
KOKKOS_FORCEINLINE_FUNCTION Pack cutChain(EdgeChain &c, SidePack const &side)
{
  Pack const zero = 0.0, one = 1.0;
  Pack leave_x = zero, leave_y = zero, enter_x = zero, enter_y = zero, pieces = zero;
  for (int i = 0; i < c.count; ++i)
  {
    Pack const ax = c.start_x[i], ay = c.start_y[i], bx = c.end_x[i], by = c.end_y[i];
    Pack const da = side.nx * (ax - side.x) + side.ny * (ay - side.y);
    Pack const db = side.nx * (bx - side.x) + side.ny * (by - side.y);
    auto const a_outside = da > zero, b_outside = db > zero;
    auto const leaves = both(no(a_outside), b_outside), enters = both(a_outside, no(b_outside));
    auto const crosses = either(leaves, enters);
    Pack const s = da / select(crosses, Pack(da - db), one);
    // An edge that is cut off altogether goes to the origin, where it adds exactly nothing.
    Pack const x = select(crosses, Pack(ax + s * (bx - ax)), zero);
    Pack const y = select(crosses, Pack(ay + s * (by - ay)), zero);
    c.start_x[i] = select(a_outside, x, ax);
    c.start_y[i] = select(a_outside, y, ay);
    c.end_x[i] = select(b_outside, x, bx);
    c.end_y[i] = select(b_outside, y, by);
    leave_x = select(leaves, x, leave_x);
    leave_y = select(leaves, y, leave_y);
    enter_x = select(enters, x, enter_x);
    enter_y = select(enters, y, enter_y);
    pieces += select(leaves, one, zero);
  }
  c.start_x[c.count] = leave_x;
  c.start_y[c.count] = leave_y;
  c.end_x[c.count] = enter_x;
  c.end_y[c.count] = enter_y;
  ++c.count;
  return pieces;
}

template <int Order>
KOKKOS_FORCEINLINE_FUNCTION void addMoments(EdgeChain const &chain, OverlayPackOf<Order> &m)
{
  Pack const half = 0.5;
  for (int i = 0; i < chain.count; ++i)
  {
    Pack const ax = chain.start_x[i], ay = chain.start_y[i], bx = chain.end_x[i], by = chain.end_y[i];
    Pack const c = ax * by - ay * bx;
    Pack const x = ax + bx, y = ay + by;
    m.value[0] += c;
    m.value[1] += c * x;
    m.value[2] += c * y;
    if constexpr (Order == 2)
    {
      m.value[3] += c * (x * x - ax * bx);
      m.value[4] += c * (ax * ay + bx * by + half * (ax * by + bx * ay));
      m.value[5] += c * (y * y - ay * by);
    }
  }
  m.value[0] = half * m.value[0];
  for (int i = 1; i < Moments<Order>::count; ++i)
    m.value[i] = Pack(i < 3 ? 1.0 / 6.0 : 1.0 / 12.0) * m.value[i];
}

} // namespace Detail

/// Moments about the origin of the parts of polygons in convex windows, exact where no side cuts one into pieces (a
/// convex polygon never is).
///
/// \tparam Order 1 or 2.
/// \param size, x, y Vertices, counter-clockwise; at most most_pack_vertices: of one polygon (double) or of one a lane
/// (Pack). [length]
template <int Order = 2, class Coordinate>
KOKKOS_INLINE_FUNCTION OverlayPackOf<Order> momentsInWindows(int size, Coordinate const *x, Coordinate const *y,
                                                             WindowPack const &windows)
{
  OverlayPackOf<Order> m;
  m.pieces = 0.0;
  for (Pack &value : m.value)
    value = 0.0;
  Detail::SidePack side[4];
  int const cuts = Detail::sidesOf(windows, size, x, y, side);
  if (cuts < 0)
    return m;
  Detail::EdgeChain chain;
  chain.count = size;
  for (int i = 0; i < size; ++i)
  {
    int const next = i + 1 < size ? i + 1 : 0;
    chain.start_x[i] = x[i];
    chain.start_y[i] = y[i];
    chain.end_x[i] = x[next];
    chain.end_y[i] = y[next];
  }
  for (int j = 0; j < cuts; ++j)
    m.pieces = Math::max(m.pieces, Detail::cutChain(chain, side[j]));
  Detail::addMoments(chain, m);
  return m;
}

} // namespace Harmos

#endif
