// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MESH_HPP
#define HARMOS_MESH_HPP

#include <Harmos_AreaWeight.hpp>
#include <Harmos_CornerShares.hpp>

namespace Harmos
{

/// Compressed rows: the items of row i are item(offset(i)) .. item(offset(i + 1) - 1).
struct Rows
{
  View<int *> offset; // rows + 1
  View<int *> item;
};

/// An unstructured mesh of bilinear quadrilaterals, as one rank sees it: its own cells and `halo` layers around them.
///
/// Local numbers follow the global ones (cell i < cell j locally exactly where that holds globally; nodes as well),
/// owned and halo cells interleaved. Every gather that runs over a row therefore adds in the same order on every
/// number of ranks. With one rank local and global numbers are the same and all depths are zero.
///
/// Face k of a cell joins its nodes k and (k + 1) % 4; nodes run counter-clockwise.
struct Mesh
{
  Geometry geometry = Geometry::Planar; // setGeometry
  int num_cells = 0;                    // owned and halo
  int num_nodes = 0;
  int num_owned_cells = 0;
  int halo = 0; // layers of vertex neighbours around the owned cells that this rank holds

  View<double *[2]> node_position; // [length]
  View<int *[4]> cell_node;        // counter-clockwise
  View<double *> cell_area;        // in the plane [length^2]
  View<double *> cell_volume;      // planar: cell_area itself; axisymmetric: integral of r dA, per radian [length^3]
  CornerShares corner_share;       // of a pair's mass; a mesh that moves with it keeps them
  View<int *[4]> face_neighbour;   // 4 * cell + its face number; -1: none here (domain boundary, edge of the halo)
  View<int *[4]> face_boundary;    // number of the boundary that the face lies on, -1: none
  Rows cell_neighbour;             // cell -> cells that share a node with it, without itself, ascending
  Rows node_cell;                  // node -> 4 * cell + the node's corner number there, ascending
  View<int *> cell_depth;          // 0: owned; k: in the k-th halo layer
  View<int *> node_depth;          // 0: touches an owned cell; else the least depth of its cells
  View<int *> node_owned;          // 1 where this rank owns the node (lowest owned cell); sums count it once
  View<long long *> cell_global;
  View<long long *> node_global;
};

/// The corners of a cell.
KOKKOS_INLINE_FUNCTION Quadrilateral cellQuadrilateral(Mesh const &mesh, int cell)
{
  Quadrilateral q;
  q.size = 4;
  for (int k = 0; k < 4; ++k)
  {
    int const node = mesh.cell_node(cell, k);
    q[k] = {mesh.node_position(node, 0), mesh.node_position(node, 1)};
  }
  return q;
}

} // namespace Harmos

#endif
