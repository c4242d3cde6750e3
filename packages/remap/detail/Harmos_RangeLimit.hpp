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

} // namespace RemapDetail
} // namespace Harmos

#endif
