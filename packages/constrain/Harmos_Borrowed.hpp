// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BORROWED_HPP
#define HARMOS_BORROWED_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_FilledRegions.hpp>

namespace Harmos
{

// The same arrays without a share in their ownership, for kernels that capture dozens of Views: each copy of one that
// owns counts its references with a locked instruction. The owners must outlive them.

template <class T>
View<T> borrowed(View<T> const &owner)
{
  return View<T>(owner.data(), owner.layout());
}

inline Rows borrowed(Rows const &owner)
{
  return {borrowed(owner.offset), borrowed(owner.item)};
}

inline Mesh borrowed(Mesh const &owner)
{
  Mesh mesh;
  mesh.geometry = owner.geometry;
  mesh.num_cells = owner.num_cells;
  mesh.num_nodes = owner.num_nodes;
  mesh.num_owned_cells = owner.num_owned_cells;
  mesh.halo = owner.halo;
  mesh.node_position = borrowed(owner.node_position);
  mesh.cell_node = borrowed(owner.cell_node);
  mesh.cell_area = borrowed(owner.cell_area);
  mesh.cell_volume = borrowed(owner.cell_volume);
  mesh.corner_share = {borrowed(owner.corner_share.part)};
  mesh.face_neighbour = borrowed(owner.face_neighbour);
  mesh.face_boundary = borrowed(owner.face_boundary);
  mesh.cell_neighbour = borrowed(owner.cell_neighbour);
  mesh.node_cell = borrowed(owner.node_cell);
  mesh.cell_depth = borrowed(owner.cell_depth);
  mesh.node_depth = borrowed(owner.node_depth);
  mesh.node_owned = borrowed(owner.node_owned);
  mesh.cell_global = borrowed(owner.cell_global);
  mesh.node_global = borrowed(owner.node_global);
  return mesh;
}

inline CellMaterialPairs borrowed(CellMaterialPairs const &owner)
{
  return {owner.num_pairs,      borrowed(owner.offset),   borrowed(owner.material),
          borrowed(owner.cell), borrowed(owner.dof_node), borrowed(owner.cell_kind)};
}

inline NodeMaterialPairs borrowed(NodeMaterialPairs const &owner)
{
  return {owner.num_dof_nodes, borrowed(owner.offset), borrowed(owner.material), borrowed(owner.node)};
}

inline FilledRegions borrowed(FilledRegions const &owner)
{
  return {owner.num_mixed_cells,   borrowed(owner.mixed_cell),    borrowed(owner.cell_region),
          borrowed(owner.polygon), borrowed(owner.cut_component), borrowed(owner.cut_normal)};
}

inline BoundaryConditions borrowed(BoundaryConditions const &owner)
{
  return {borrowed(owner.boundary), borrowed(owner.node_index), borrowed(owner.condition)};
}

} // namespace Harmos

#endif
