// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_INTERFACE_CELLS_HPP
#define HARMOS_INTERFACE_CELLS_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_WorkArrays.hpp>

namespace Harmos
{

// What fills a cell: the material of a pure one, else one of these.
constexpr int void_filling = -1;
constexpr int mixed_filling = -2;

/// What lies at the faces of cells.
struct CellSurface
{
  Mesh mesh;
  CellMaterialPairs pairs;
  View<Boundary *> boundary;
  bool walls; // some boundary is a contact wall

  KOKKOS_INLINE_FUNCTION bool contactWall(int cell, int face) const
  {
    int const b = mesh.face_boundary(cell, face);
    return b >= 0 && boundary(b).kind == BoundaryKind::ContactWall;
  }

  KOKKOS_INLINE_FUNCTION bool freeFace(int cell, int face) const
  {
    return mesh.face_neighbour(cell, face) < 0 && mesh.face_boundary(cell, face) < 0;
  }

  KOKKOS_INLINE_FUNCTION int filling(int cell) const
  {
    int const kind = pairs.cell_kind(cell);
    return kind == PureCell ? pairs.material(pairs.offset(cell)) : kind == VoidCell ? void_filling : mixed_filling;
  }
};

CellSurface cellSurface(Mesh const &mesh, CellMaterialPairs const &pairs, BoundaryConditions const &conditions);

/// The cells whose segments can meet another body: cells that hold a piece of interface and have two materials, or a
/// contact wall, within two cells around them; and free surfaces of body-fitted blocks, which share no node with what
/// they meet. Cells of depth mesh.halo (halo > 0) are left out.
///
/// Kept as long as the pairs, and the mesh's neighbours and boundaries, are the same arrays (who changes what a cell
/// holds makes new ones), so that no cell is looked at in cycles without changes.
struct InterfaceCells
{
  CellMaterialPairs pairs; // what they were found for
  View<int *[4]> face_neighbour;
  View<Boundary *> boundary;
  bool free_faces = false; // some face has neither a neighbour nor a boundary
  int count = -1;
  View<int *> cell; // ascending; count, and some room
};

/// \param dof_nodes Of the surface's pairs.
void listInterfaceCells(CellSurface const &surface, NodeMaterialPairs const &dof_nodes, InterfaceCells &cells,
                        WorkArrays const &work = {});

} // namespace Harmos

#endif
