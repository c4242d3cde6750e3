// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FULLNESS_HPP
#define HARMOS_FULLNESS_HPP

#include <Harmos_FilledRegions.hpp>

namespace Harmos
{

/// Void at which a cell is no longer full at all, part of its area: of a cell in which there is a solid, and of one of
/// fluids alone.
constexpr double most_void_of_full_cell = 0.01, most_void_between_fluids = 0.1;

/// How far the interfaces in a cell are closed: max(0, 1 - v / v_0), v the part of the cell's area that no region
/// fills, v_0 the most of a full cell (above). Zero in cells of one material or none. What it changes of a gradient
/// changes with v, and so from step to step where v opens and closes: fluids, which have the gradient of what they fill
/// beside void too, ring without bound near the largest step where that is fast (doc/decisions/0034).
///
/// \param is_fluid Whether a material, by its number, deforms without strength; the same for the stress over filled
/// regions, the rows that bear it and the outlines that are moved.
template <class IsFluid>
KOKKOS_INLINE_FUNCTION double fullness(Mesh const &mesh, CellMaterialPairs const &pairs, FilledRegions const &regions,
                                       int cell, IsFluid const &is_fluid)
{
  int const first = regions.cell_region(cell), count = pairs.offset(cell + 1) - pairs.offset(cell);
  if (first < 0 || count < 2)
    return 0.0;
  double filled = 0.0;
  bool fluids = true;
  for (int k = 0; k < count; ++k)
  {
    filled += area(regions.polygon(first + k));
    fluids = fluids && is_fluid(pairs.material(pairs.offset(cell) + k));
  }
  double const open = Math::max(0.0, 1.0 - filled / mesh.cell_area(cell));
  return Math::max(0.0, 1.0 - open / (fluids ? most_void_between_fluids : most_void_of_full_cell));
}

} // namespace Harmos

#endif
