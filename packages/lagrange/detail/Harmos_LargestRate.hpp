// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LARGEST_RATE_HPP
#define HARMOS_LARGEST_RATE_HPP

#include <Harmos_Lagrange.hpp>

#include <limits>

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

inline int valueAt(View<int *> const &view, int index)
{
  int value = -1;
  Kokkos::deep_copy(value, Kokkos::subview(view, index));
  return value;
}

inline double valueAt(View<double *[num_pair_fields]> const &record, int pair, int field)
{
  double value = 0.0;
  Kokkos::deep_copy(value, Kokkos::subview(record, pair, field));
  return value;
}

/// Of the largest 1 / dt, by pair.
inline TimeStepLimit limitFrom(LargestRate const &largest, CellMaterialPairs const &pairs)
{
  if (largest.index < 0)
    return {std::numeric_limits<double>::infinity(), -1, -1};
  return {1.0 / largest.rate, valueAt(pairs.cell, largest.index), valueAt(pairs.material, largest.index)};
}

} // namespace detail
} // namespace Harmos

#endif
