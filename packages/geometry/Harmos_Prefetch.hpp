// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PREFETCH_HPP
#define HARMOS_PREFETCH_HPP

#include <Harmos_Pack.hpp>
#include <Harmos_RowPointer.hpp>

namespace Harmos
{

/// Rows ahead of those at work that kernels over all cells ask for: such a kernel reads and writes more streams than
/// the machine's own prefetcher follows.
constexpr int rows_ahead = 48;

/// Ask for the line of memory at an address, which need not be an array's any more.
KOKKOS_FORCEINLINE_FUNCTION void prefetchToRead(void const *address)
{
#ifdef HARMOS_VECTOR_TYPES
  __builtin_prefetch(address, 0);
#else
  (void)address;
#endif
}
KOKKOS_FORCEINLINE_FUNCTION void prefetchToWrite(void const *address)
{
#ifdef HARMOS_VECTOR_TYPES
  __builtin_prefetch(address, 1);
#else
  (void)address;
#endif
}

/// Ask for what a pack of rows, one after the other, needs that comes after the pack from `row` on.
template <class T, int N>
KOKKOS_FORCEINLINE_FUNCTION void readAhead(RowPointer<T, N> const &rows, int row)
{
  constexpr int rows_a_line = N * sizeof(T) < 64 ? 64 / (N * sizeof(T)) : 1;
  for (int lane = 0; lane < pack_width; lane += rows_a_line)
    prefetchToRead(rows.row(row + rows_ahead + lane));
}
KOKKOS_FORCEINLINE_FUNCTION void readAhead(int const *numbers, int row)
{
  prefetchToRead(numbers + row + rows_ahead);
}
KOKKOS_FORCEINLINE_FUNCTION void writeAhead(RowPointer<double, 8> const &rows, int row)
{
  for (int lane = 0; lane < pack_width; ++lane)
    prefetchToWrite(rows.row(row + rows_ahead + lane));
}

} // namespace Harmos

#endif
