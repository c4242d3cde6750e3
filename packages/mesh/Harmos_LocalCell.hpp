// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LOCAL_CELL_HPP
#define HARMOS_LOCAL_CELL_HPP

#include <Harmos_LowerBound.hpp>
#include <Harmos_Mesh.hpp>

namespace Harmos
{

/// Local number of a cell of this rank, halo included, by its global number; -1: it is not here. O(log num_cells).
KOKKOS_INLINE_FUNCTION int localCell(Mesh const &mesh, long long global)
{
  int const cell = lowerBound(mesh.num_cells, [&](int i) { return mesh.cell_global(i) < global; });
  return cell < mesh.num_cells && mesh.cell_global(cell) == global ? cell : -1;
}

} // namespace Harmos

#endif
