// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RANGE_LIMIT_HPP
#define HARMOS_RANGE_LIMIT_HPP

#include <Harmos_Select.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// The largest part, at most all, of deviations from q, between least <= 0 and most >= 0, that keeps q within lower and
/// upper.
/// \tparam T double or Pack
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T partWithin(T const &least, T const &most, T const &q, T const &lower, T const &upper)
{
  T const above = upper - q, below = lower - q;
  auto const high = most > above;
  auto const low = below > least;
  T const up = select(high, T(above / select(high, most, T(1.0))), T(1.0));
  T const down = select(low, T(below / select(low, least, T(1.0))), T(1.0));
  return Math::max(Math::min(up, down), T(0.0));
}

/// Widen a range by what lies beyond the boundary of the mesh, as far as anyone knows: the value of the cell opposite,
/// mirrored at one's own, where it is between least and largest.
/// \tparam T double or Pack
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void widenByMirrored(T const &q, T const &opposite, T const &least, T const &largest,
                                                 T &lower, T &upper)
{
  T const mirrored = 2.0 * q - opposite;
  lower = Math::min(lower, Math::max(mirrored, least));
  upper = Math::max(upper, Math::min(mirrored, largest));
}

/// Widen a range of specific volumes by what the density may be, between lower_density and upper_density, with its
/// ratio theta to the volume that it fills, where that is between least and largest.
KOKKOS_FORCEINLINE_FUNCTION void widenByDensity(double ratio, double lower_density, double upper_density, double least,
                                                double largest, double &lower, double &upper)
{
  lower = Math::min(lower, Math::max(ratio / upper_density, least));
  upper = Math::max(upper, Math::min(ratio / lower_density, largest));
}

} // namespace RemapDetail
} // namespace Harmos

#endif
