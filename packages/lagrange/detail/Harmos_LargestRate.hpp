// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LARGEST_RATE_HPP
#define HARMOS_LARGEST_RATE_HPP

#include <Harmos_Kokkos.hpp>

namespace Harmos
{
namespace detail
{

/// Largest rate and the index that has it; ties: the lowest index, whatever the order of joins.
struct LargestRate
{
  double rate = 0.0;
  int index = -1;

  KOKKOS_INLINE_FUNCTION void include(double candidate, int i)
  {
    if (candidate > rate || (candidate == rate && index >= 0 && i < index))
    {
      rate = candidate;
      index = i;
    }
  }
  KOKKOS_INLINE_FUNCTION void join(LargestRate const &other)
  {
    if (other.index >= 0)
      include(other.rate, other.index);
  }
};

} // namespace detail
} // namespace Harmos

#endif
