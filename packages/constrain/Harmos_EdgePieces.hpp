// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_EDGE_PIECES_HPP
#define HARMOS_EDGE_PIECES_HPP

#include <Harmos_FilledRegions.hpp>

namespace Harmos
{

constexpr int max_covers = 2 * max_components;

/// What lies beyond an edge: intervals of arc length, each of one material.
struct EdgeCovers
{
  int count = 0;
  double begin[max_covers];
  double end[max_covers];
  int material[max_covers];
};

/// An edge of a counter-clockwise region.
struct Edge
{
  Vector2 start, direction, normal; // direction and normal are unit vectors
  double length;
};

KOKKOS_INLINE_FUNCTION Edge edgeBetween(Vector2 const &a, Vector2 const &b)
{
  Edge edge{a, b - a, {0.0, 0.0}, 0.0};
  edge.length = norm(edge.direction);
  if (edge.length > 0.0)
    edge.direction *= 1.0 / edge.length;
  edge.normal = -perpendicular(edge.direction);
  return edge;
}

/// Add the intervals of an edge that a region's edges touch from the other side.
KOKKOS_INLINE_FUNCTION void addCover(Edge const &edge, Region const &region, int material, double tolerance,
                                     EdgeCovers &covers)
{
  if (region.empty())
    return;
  Vector2 a = region[region.size - 1] - edge.start;
  bool a_near = Math::fabs(dot(a, edge.normal)) <= tolerance;
  for (int i = 0; i < region.size && covers.count < max_covers; ++i)
  {
    Vector2 const b = region[i] - edge.start;
    bool const b_near = Math::fabs(dot(b, edge.normal)) <= tolerance;
    if (a_near && b_near)
    {
      double const end = Math::min(dot(a, edge.direction), edge.length);
      double const begin = Math::max(dot(b, edge.direction), 0.0);
      if (end - begin > tolerance)
      {
        covers.begin[covers.count] = begin;
        covers.end[covers.count] = end;
        covers.material[covers.count++] = material;
      }
    }
    a = b;
    a_near = b_near;
  }
}

/// Maximal pieces of an edge beyond which lies one other material, or void.
struct EdgePieces
{
  int count = 0;
  double total = 0.0;
  double begin[2 * max_covers + 1];
  double end[2 * max_covers + 1];
};

/// The pieces beside and within one cover, or none.
KOKKOS_INLINE_FUNCTION void oneCover(double length, EdgeCovers const &covers, int material, double tolerance,
                                     EdgePieces &pieces)
{
  auto const add = [&](double begin, double end)
  {
    pieces.total += end - begin;
    pieces.begin[pieces.count] = begin;
    pieces.end[pieces.count++] = end;
  };
  double const begin = covers.count == 1 ? covers.begin[0] : length;
  if (begin > tolerance)
    add(0.0, begin);
  if (covers.count == 0)
    return;
  if (covers.material[0] != material)
    add(begin, covers.end[0]);
  if (length - covers.end[0] > tolerance)
    add(covers.end[0], length);
}

KOKKOS_INLINE_FUNCTION void exposedPieces(double length, EdgeCovers const &covers, int material, double tolerance,
                                          EdgePieces &pieces)
{
  if (covers.count < 2)
  {
    oneCover(length, covers, material, tolerance, pieces);
    return;
  }
  double at[2 * max_covers + 2];
  int count = 0;
  at[count++] = 0.0;
  at[count++] = length;
  for (int i = 0; i < covers.count; ++i)
    for (int k = 0; k < 2; ++k)
    {
      double const s = k == 0 ? covers.begin[i] : covers.end[i];
      int j = count++;
      for (; j > 0 && at[j - 1] > s; --j)
        at[j] = at[j - 1];
      at[j] = s;
    }
  int last = -2; // what lies beyond the last piece; -1 is void
  for (int i = 0; i + 1 < count; ++i)
  {
    if (at[i + 1] - at[i] <= tolerance)
      continue;
    double const middle = 0.5 * (at[i] + at[i + 1]);
    int beyond = -1;
    for (int c = covers.count - 1; c >= 0; --c)
      if (covers.begin[c] < middle && middle < covers.end[c])
        beyond = covers.material[c];
    if (beyond != material)
    {
      pieces.total += at[i + 1] - at[i];
      if (beyond == last)
        pieces.end[pieces.count - 1] = at[i + 1];
      else
      {
        pieces.begin[pieces.count] = at[i];
        pieces.end[pieces.count++] = at[i + 1];
      }
    }
    last = beyond;
  }
}

/// Beyond the edge lies one thing: a wall, void or a pure cell.
KOKKOS_INLINE_FUNCTION void wholeEdge(double length, EdgePieces &pieces)
{
  pieces.count = 1;
  pieces.total = pieces.end[0] = length;
  pieces.begin[0] = 0.0;
}

} // namespace Harmos

#endif
