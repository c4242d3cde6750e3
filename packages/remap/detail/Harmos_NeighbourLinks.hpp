// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_NEIGHBOUR_LINKS_HPP
#define HARMOS_NEIGHBOUR_LINKS_HPP

#include <Harmos_Mesh.hpp>

namespace Harmos
{
namespace RemapDetail
{

constexpr int most_slots = 64; // of a cell: bits of a donor's set of overlays

/// What stage 2 asks of a mesh again and again: how a cell and its vertex neighbours see each other.
///
/// The slots of a cell are itself (0) and its vertex neighbours in the order of their row (1, 2, ...).
struct NeighbourLinks
{
  View<unsigned char *> link; // as mesh.cell_neighbour.item: 4 * (slot of the cell in the neighbour) + rotation
  View<double *[4]> box;      // num_cells: least x, y, greatest x, y of the corners
  int slots = 1;              // the most of any cell

  /// Slot of the cell whose row holds item j among those of that neighbour.
  KOKKOS_INLINE_FUNCTION int slotBack(int j) const { return link(j) >> 2; }
  /// cornerRotation(cell, neighbour)
  KOKKOS_INLINE_FUNCTION int rotation(int j) const { return link(j) & 3; }
};

/// All but the boxes, which depends on the mesh's connectivity alone. Throws where a cell has more neighbours than fit.
NeighbourLinks linkNeighbours(Mesh const &mesh);

/// The boxes, anew.
void boxCells(Mesh const &mesh, NeighbourLinks &links);

} // namespace RemapDetail
} // namespace Harmos

#endif
