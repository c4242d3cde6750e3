// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LOCAL_CELL_HPP
#define HARMOS_LOCAL_CELL_HPP

#include <Harmos_Mesh.hpp>

namespace Harmos
{

/// Local number of a cell of this rank, halo included, by its global number; -1: it is not here. O(log num_cells).
KOKKOS_INLINE_FUNCTION int localCell(Mesh const &mesh, long long global)
{
  int low = 0, high = mesh.num_cells;
  while (low < high)
  {
    int const middle = low + (high - low) / 2;
    if (mesh.cell_global(middle) < global)
      low = middle + 1;
    else
      high = middle;
  }
  return low < mesh.num_cells && mesh.cell_global(low) == global ? low : -1;
}

} // namespace Harmos

#endif
