// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FULLNESS_HPP
#define HARMOS_FULLNESS_HPP

#include <Harmos_FilledRegions.hpp>

namespace Harmos
{

/// Void at which a cell is no longer full at all, part of its area.
constexpr double most_void_of_full_cell = 0.01;

/// How far the interfaces in a cell are closed: max(0, 1 - v / most_void_of_full_cell), v the part of the cell's area
/// that no region fills. Zero in cells of one material or none.
KOKKOS_INLINE_FUNCTION double fullness(Mesh const &mesh, CellMaterialPairs const &pairs, FilledRegions const &regions,
                                       int cell)
{
  int const first = regions.cell_region(cell), count = pairs.offset(cell + 1) - pairs.offset(cell);
  if (first < 0 || count < 2)
    return 0.0;
  double filled = 0.0;
  for (int k = 0; k < count; ++k)
    filled += area(regions.polygon(first + k));
  double const open = Math::max(0.0, 1.0 - filled / mesh.cell_area(cell));
  return Math::max(0.0, 1.0 - open / most_void_of_full_cell);
}

} // namespace Harmos

#endif
