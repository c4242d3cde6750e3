// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REGION_BOUNDS_HPP
#define HARMOS_REGION_BOUNDS_HPP

#include <Harmos_Kokkos.hpp>
#include <Harmos_Polygon.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Least x, y, greatest x, y.
struct Bounds
{
  double low[2], high[2];

  KOKKOS_INLINE_FUNCTION bool empty() const { return !(low[0] < high[0] && low[1] < high[1]); }
  KOKKOS_INLINE_FUNCTION Bounds with(Bounds const &b) const
  {
    Bounds both;
    for (int d = 0; d < 2; ++d)
    {
      both.low[d] = Math::max(low[d], b.low[d]);
      both.high[d] = Math::min(high[d], b.high[d]);
    }
    return both;
  }
};

KOKKOS_INLINE_FUNCTION Bounds boundsOf(Region const &region)
{
  if (region.empty())
    return {{0.0, 0.0}, {0.0, 0.0}};
  Bounds box{{region[0][0], region[0][1]}, {region[0][0], region[0][1]}};
  for (int i = 1; i < region.size; ++i)
    for (int d = 0; d < 2; ++d)
    {
      box.low[d] = Math::min(box.low[d], region[i][d]);
      box.high[d] = Math::max(box.high[d], region[i][d]);
    }
  return box;
}

} // namespace RemapDetail
} // namespace Harmos

#endif
