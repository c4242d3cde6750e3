// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_InterfaceCells.hpp>

namespace Harmos
{

namespace
{

/// False where no segment can lie: a pure cell among its like, void away from contact walls.
KOKKOS_INLINE_FUNCTION bool carriesSegments(CellSurface const &surface, int cell)
{
  int const own = surface.filling(cell);
  if (own == mixed_filling)
    return true;
  for (int k = 0; k < 4; ++k)
  {
    int const across = surface.mesh.face_neighbour(cell, k);
    if (across >= 0 ? own >= 0 && surface.filling(across / 4) != own
                    : surface.contactWall(cell, k) || (own >= 0 && surface.freeFace(cell, k)))
      return true;
  }
  return false;
}

/// Marks a cell and its vertex neighbours.
KOKKOS_INLINE_FUNCTION void markAround(Mesh const &mesh, int cell, View<int *> const &marked)
{
  marked(cell) = 1; // whoever writes writes one
  for (int e = mesh.cell_neighbour.offset(cell); e < mesh.cell_neighbour.offset(cell + 1); ++e)
    marked(mesh.cell_neighbour.item(e)) = 1;
}

bool hasContactWall(View<Boundary *> const &boundary)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), boundary);
  for (std::size_t b = 0; b < host.extent(0); ++b)
    if (host(b).kind == BoundaryKind::ContactWall)
      return true;
  return false;
}

/// Whether the nodes of a cell carry different materials.
KOKKOS_INLINE_FUNCTION bool nodesDiffer(Mesh const &mesh, NodeMaterialPairs const &dof_nodes, int cell)
{
  int known = void_filling;
  for (int k = 0; k < 4; ++k)
  {
    int const node = mesh.cell_node(cell, k);
    for (int dof = dof_nodes.offset(node); dof < dof_nodes.offset(node + 1); ++dof)
    {
      if (known != void_filling && dof_nodes.material(dof) != known)
        return true;
      known = dof_nodes.material(dof);
    }
  }
  return false;
}

/// 1 for the cells that have two materials, or a contact wall, within two cells around them: those are in the vertex
/// neighbours of some cell that is, or touches, this one. All materials there are at that cell's nodes.
View<int *> cellsNearOthers(CellSurface const &surface, NodeMaterialPairs const &dof_nodes)
{
  Mesh const mesh = surface.mesh;
  View<int *> const kind = surface.pairs.cell_kind, offset = dof_nodes.offset;
  View<int *> const several("Harmos::constrain::several_materials", mesh.num_cells);
  View<int *> const near("Harmos::constrain::near_others", mesh.num_cells);
  bool const walls = hasContactWall(surface.boundary);
  Kokkos::parallel_for(
      "Harmos::constrain::severalMaterials", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        if (offset(node + 1) - offset(node) > 1)
          for (int e = mesh.node_cell.offset(node); e < mesh.node_cell.offset(node + 1); ++e)
            several(mesh.node_cell.item(e) / 4) = 1;
      });
  Kokkos::parallel_for(
      "Harmos::constrain::nearOthers", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        bool meets = several(cell) == 1 || (kind(cell) == VoidCell && nodesDiffer(mesh, dof_nodes, cell));
        for (int k = 0; walls && k < 4; ++k)
          meets = meets || surface.contactWall(cell, k);
        if (meets)
          markAround(mesh, cell, near);
      });
  return near;
}

} // namespace

View<int *> interfaceCells(CellSurface const &surface, NodeMaterialPairs const &dof_nodes, int &count)
{
  Mesh const mesh = surface.mesh;
  View<int *> const near = cellsNearOthers(surface, dof_nodes);
  View<int *> const visited(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::interface_cell"),
                            mesh.num_cells);
  Kokkos::parallel_scan(
      "Harmos::constrain::listInterfaceCells", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum, bool final) {
        bool candidate = near(cell) == 1;
        for (int k = 0; k < 4; ++k)
          candidate = candidate || surface.freeFace(cell, k);
        if (!candidate || (mesh.halo > 0 && mesh.cell_depth(cell) >= mesh.halo) || !carriesSegments(surface, cell))
          return;
        if (final)
          visited(sum) = cell;
        ++sum;
      },
      count);
  return visited;
}

} // namespace Harmos
