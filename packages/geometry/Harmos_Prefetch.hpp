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

/// Ask for what a pack of rows of eight values, one line each, needs that comes after the pack from `row` on.
KOKKOS_FORCEINLINE_FUNCTION void readAhead(RowPointer<double, 8> const &rows, int row)
{
  for (int lane = 0; lane < pack_width; ++lane)
    prefetchToRead(rows.row(row + rows_ahead + lane));
}
KOKKOS_FORCEINLINE_FUNCTION void writeAhead(RowPointer<double, 8> const &rows, int row)
{
  for (int lane = 0; lane < pack_width; ++lane)
    prefetchToWrite(rows.row(row + rows_ahead + lane));
}

} // namespace Harmos

#endif
