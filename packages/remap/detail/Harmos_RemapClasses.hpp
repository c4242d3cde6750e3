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
  InflowBit = 4,
  own_open_bits = 8 // the bits of the cell and its vertex neighbours together are stored above those of the cell
};

/// What a cell is, as bits; the first four kinds are for stage 1 and those of pure cells alone.
enum SweptBits : int
{
  SweptCornerBit = 1,     // << k: node k is swept
  NeighbourBit = 1 << 4,  // << k: there is a cell beyond face k
  SameBeyondBit = 1 << 8, // << k: and it is pure and of the same material
  PureCellBit = 1 << 12,
  RigidBit = 1 << 13,         // holds a rigid body, or did, and is not full of it before and after
  InterfaceCellBit = 1 << 14, // takes part in stage 2
  OwnedCellBit = 1 << 15,     // of any kind
  all_swept_corners = 15
};

/// What stage 1 does at a node.
enum NodeSweep : int
{
  SpecialNode = 0,
  PlainNode = 1,     // swept, final, owned and without condition; with bits:
  UntouchedNode = 2, // no cell around takes part in stage 1
  FourCellsBit = 4,  // lies in four cells
  RunsOnBit = 8      // the next node lies in the four cells that follow those
};

/// Which stage moves what.
struct Classes
{
  View<int *> flags;           // num_cells, SweptBits
  View<int *> node_final;      // num_nodes: 1 where no cell around takes part in stage 2
  View<int *> node_sweep;      // num_nodes, NodeSweep, bits with PlainNode alone
  View<int *> node_return;     // num_nodes, NodeReturn
  View<int *> pure_material;   // num_cells: material of a pure deformable cell, -1: none such, -2: no deformable at all
  View<int *> open;            // num_cells, OpenBits; extent 0: the boundaries are slip and fixed walls
  View<int *> interface_cell;  // cells of stage 2: touch an interface node or hold a rigid body, ascending
  View<int *> interface_index; // num_cells: position in interface_cell, or -1
  View<int *> changed;         // work array of updateClasses
  int num_swept = 0;           // cells of stage 1: pure with a swept node
  int num_interface = 0;

  /// Open boundaries of a cell and its vertex neighbours.
  KOKKOS_INLINE_FUNCTION int openAround(int cell) const { return open.extent(0) == 0 ? 0 : open(cell) / own_open_bits; }
};

Classes classify(Input const &in);

/// Make the classes of other pairs, on the same mesh with the same conditions, into those of the input: what no changed
/// cell is near stays.
void updateClasses(Input const &in, Classes &classes);

} // namespace RemapDetail
} // namespace Harmos

#endif
