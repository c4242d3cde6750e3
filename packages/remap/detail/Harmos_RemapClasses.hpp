// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_CLASSES_HPP
#define HARMOS_REMAP_CLASSES_HPP

#include <detail/Harmos_RemapInput.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// How the remap brings a node back.
enum NodeReturn : int
{
  StillNode = 0,    // no deformable material around
  SweptNode = 1,    // stage 1: all cells around are pure and of one deformable material, walls are slip or fixed
  InterfaceNode = 2 // stage 2
};

/// Open boundaries of a cell, as bits.
enum OpenBits : int
{
  ContactBit = 1,
  OutflowBit = 2,
  InflowBit = 4
};

/// What stage 1 needs to know of a pure cell, as bits; 0 for any other cell.
enum SweptBits : int
{
  SweptCornerBit = 1,     // << k: node k is swept
  NeighbourBit = 1 << 4,  // << k: there is a cell beyond face k
  SameBeyondBit = 1 << 8, // << k: and it is pure and of the same material
  PureCellBit = 1 << 12,
  all_swept_corners = 15
};

/// Which stage moves what.
struct Classes
{
  View<int *> flags;           // num_cells, SweptBits
  View<int *> node_final;      // num_nodes: 1 where no cell around takes part in stage 2
  View<int *> node_plain;      // num_nodes: 1 where a node is swept, final, owned and without condition
  View<int *> node_return;     // num_nodes, NodeReturn
  View<int *> pure_material;   // num_cells: material of a pure deformable cell, -1: none such, -2: no deformable at all
  View<int *> open;            // num_cells, OpenBits of its faces; extent 0: the boundaries are slip and fixed walls
  View<int *> interface_cell;  // cells of stage 2: touch an interface node or hold a rigid body, ascending
  View<int *> interface_index; // num_cells: position in interface_cell, or -1
  int num_swept = 0;           // cells of stage 1: pure with a swept node
  int num_interface = 0;

  /// Open boundaries of a cell and its vertex neighbours.
  KOKKOS_INLINE_FUNCTION int openAround(Mesh const &mesh, int cell) const
  {
    if (open.extent(0) == 0)
      return 0;
    int bits = open(cell);
    for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
      bits |= open(mesh.cell_neighbour.item(j));
    return bits;
  }
};

Classes classify(Input const &in);

} // namespace RemapDetail
} // namespace Harmos

#endif
