// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_STRAIGHT_EDGES_HPP
#define HARMOS_STRAIGHT_EDGES_HPP

#include <Harmos_Polygon.hpp>

namespace Harmos
{

/// Whether all corners of a region from `first` up to (without) `last`, cyclic, lie within `bend` of the chord from
/// corner `from` to corner `to`, and between its ends.
KOKKOS_INLINE_FUNCTION bool liesAlong(Region const &region, int from, int first, int last, int to, double bend)
{
  Vector2 const chord = region[to] - region[from];
  double const squared = dot(chord, chord);
  for (int i = first; i != last; i = region.next(i))
  {
    Vector2 const d = region[i] - region[from];
    double const along = dot(d, chord), beside = cross(d, chord);
    if (!(along > 0.0 && along < squared && beside * beside < bend * bend * squared))
      return false;
  }
  return true;
}

/// \brief A convex region without the corners at which its edges hardly bend.
///
/// Between two corners that are kept all others lie within `bend` of the chord, however many there are, and none lies
/// on the rim. A region without any corner that bends by more is given back as it is.
///
/// \param region Convex, counter-clockwise.
/// \param bend   Largest distance of what is left out from its chord. [length]
/// \param on_rim on_rim(a, b): whether an edge lies on a face of the cell; its ends are kept.
template <class OnRim>
KOKKOS_INLINE_FUNCTION Region straightened(Region const &region, double bend, OnRim const &on_rim)
{
  int begin = 0, before = region.size - 1; // a corner that is kept, whatever comes before it
  for (; begin < region.size; before = begin++)
    if (!liesAlong(region, before, begin, region.next(begin), region.next(begin), bend) ||
        on_rim(region[before], region[begin]) || on_rim(region[begin], region[region.next(begin)]))
      break;
  if (begin == region.size)
    return region;
  Region kept;
  kept.push(region[begin]);
  int last = begin;
  for (int i = region.next(begin); i != begin; i = region.next(i))
  {
    int const next = region.next(i);
    if (liesAlong(region, last, region.next(last), next, next, bend) && !on_rim(region[i], region[next]) &&
        !on_rim(region[last], region[i]))
      continue;
    kept.push(region[i]);
    last = i;
  }
  return kept;
}

} // namespace Harmos

#endif
