// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LOWER_BOUND_HPP
#define HARMOS_LOWER_BOUND_HPP

#include <Harmos_Kokkos.hpp>

namespace Harmos
{

/// The first of 0 to count - 1 that is not below what is looked for, or count: as std::lower_bound, in kernels. \param
/// isBelow bool(int), true up to some number and false from there on.
template <class IsBelow>
KOKKOS_INLINE_FUNCTION int lowerBound(int count, IsBelow const &isBelow)
{
  int low = 0, high = count;
  while (low < high)
  {
    int const middle = low + (high - low) / 2;
    if (isBelow(middle))
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

} // namespace Harmos

#endif
