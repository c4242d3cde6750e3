// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BRIDGED_REGION_HPP
#define HARMOS_BRIDGED_REGION_HPP

#include <Harmos_Polygon.hpp>

namespace Harmos
{

/// Two regions that do not touch as one polygon: from vertex i of the first there and back to vertex j of the second,
/// along a bridge without width. Areas and moments are the sums of both; the bridge bounds nothing (isBridge). Empty
/// where it has too many vertices.
KOKKOS_INLINE_FUNCTION Region bridged(Region const &first, int i, Region const &second, int j)
{
  Region both;
  if (first.size + second.size + 2 > Region::capacity)
    return both;
  for (int k = 0; k <= first.size; ++k)
    both.push(first[(i + k) % first.size]);
  for (int k = 0; k <= second.size; ++k)
    both.push(second[(j + k) % second.size]);
  return both;
}

/// Whether the edge after vertex i is half of a bridge: the region goes back along it.
KOKKOS_INLINE_FUNCTION bool isBridge(Region const &region, int i)
{
  constexpr int fewest_vertices = 8; // two triangles, and both ends again
  if (region.size < fewest_vertices)
    return false;
  auto const same = [](Vector2 const &a, Vector2 const &b) { return a[0] == b[0] && a[1] == b[1]; };
  Vector2 const &a = region[i], &b = region[region.next(i)];
  for (int k = 0; k < region.size; ++k)
    if (same(region[k], b) && same(region[region.next(k)], a))
      return true;
  return false;
}

} // namespace Harmos

#endif
