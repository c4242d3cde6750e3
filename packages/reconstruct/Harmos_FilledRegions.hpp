// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FILLED_REGIONS_HPP
#define HARMOS_FILLED_REGIONS_HPP

#include <Harmos_CellMaterialPairs.hpp>

namespace Harmos
{

/// The filled regions of the mixed cells: one polygon for every pair of a mixed cell, convex but around a corner of
/// another body (embeddedCornerPlan); pure cells store none.
///
/// They were cut off the cell one component after the other. A cell of n pairs has n - 1 cuts, or n with void: entry i
/// tells which component the i-th took and its normal; an n-th that is none has the normal zero.
/// Cells that were not cut in sequence (parted, corners, films) have -1 for components.
struct FilledRegions
{
  int num_mixed_cells = 0;
  View<int *> mixed_cell;     // num_mixed_cells: cell, ascending
  View<int *> cell_region;    // num_cells: first region of the cell's pairs; -1 where the cell is not mixed
  View<Region *> polygon;     // by cell_region(cell) + (pair - offset(cell)); counter-clockwise
  View<int *> cut_component;  // by cell_region(cell) + cut: pair - offset(cell); the void's is the number of pairs
  View<Vector2 *> cut_normal; // by the same: unit, leaves what is cut off

  /// The filled region of a pair, whatever the kind of its cell.
  KOKKOS_INLINE_FUNCTION Region region(Mesh const &mesh, CellMaterialPairs const &pairs, int pair) const
  {
    int const cell = pairs.cell(pair);
    int const first = cell_region(cell);
    if (first >= 0)
      return polygon(first + pair - pairs.offset(cell));
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    Region r;
    for (int k = 0; k < 4; ++k)
      r.push(q[k]);
    return r;
  }
};

} // namespace Harmos

#endif
