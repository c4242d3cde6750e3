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
  if (own == void_filling && !surface.walls)
    return false;
  for (int k = 0; k < 4; ++k)
  {
    int const across = surface.mesh.face_neighbour(cell, k);
    if (across >= 0 ? own >= 0 && surface.filling(across / 4) != own
                    : surface.contactWall(cell, k) || (own >= 0 && surface.freeFace(cell, k)))
      return true;
  }
  return false;
}

bool hasContactWall(View<Boundary *> const &boundary)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), boundary);
  for (std::size_t b = 0; b < host.extent(0); ++b)
    if (host(b).kind == BoundaryKind::ContactWall)
      return true;
  return false;
}

bool hasFreeFace(CellSurface const &surface)
{
  int free = 0;
  launchReduce(
      "Harmos::constrain::freeFaces", surface.mesh.num_cells,
      KOKKOS_LAMBDA(int cell, int &count) {
        for (int k = 0; k < 4; ++k)
          count += surface.freeFace(cell, k) ? 1 : 0;
      },
      free);
  return free > 0;
}

/// Whether the nodes of a void cell, none of which has several, carry different materials.
KOKKOS_INLINE_FUNCTION bool liesBetween(CellSurface const &surface, NodeMaterialPairs const &dof_nodes, int cell)
{
  int first = -1; // of the materials that were found
  for (int k = 0; k < 4; ++k)
  {
    int const node = surface.mesh.cell_node(cell, k), dof = dof_nodes.offset(node);
    if (dof == dof_nodes.offset(node + 1))
      continue;
    int const material = dof_nodes.material(dof);
    if (first >= 0 && material != first)
      return true;
    first = material;
  }
  return false;
}

/// 1 for the cells that have two materials, or a contact wall, within two cells around them. Those are then at the
/// nodes of one cell, which is this one or one of its vertex neighbours: at one node, or on both sides of a void cell.
View<int *> cellsNearOthers(CellSurface const &surface, NodeMaterialPairs const &dof_nodes, WorkArrays const &work)
{
  Rows const neighbour = surface.mesh.cell_neighbour, node_cell = surface.mesh.node_cell;
  View<int *> const offset = dof_nodes.offset, kind = surface.pairs.cell_kind;
  bool const walls = surface.walls;
  View<int *> const meets = work.zeros<int *>("Harmos::constrain::meets_others", surface.mesh.num_cells);
  View<int *> const near = work.zeros<int *>("Harmos::constrain::near_others", surface.mesh.num_cells);
  // Whoever writes writes one.
  launchFor(
      "Harmos::constrain::nodesOfSeveral", surface.mesh.num_nodes, KOKKOS_LAMBDA(int node) {
        if (offset(node + 1) - offset(node) < 2)
          return;
        for (int e = node_cell.offset(node); e < node_cell.offset(node + 1); ++e)
          meets(node_cell.item(e) / 4) = 1;
      });
  launchFor(
      "Harmos::constrain::nearOthers", surface.mesh.num_cells, KOKKOS_LAMBDA(int cell) {
        bool found = meets(cell) == 1 || (kind(cell) == VoidCell && liesBetween(surface, dof_nodes, cell));
        for (int k = 0; walls && k < 4; ++k)
          found = found || surface.contactWall(cell, k);
        if (!found)
          return;
        near(cell) = 1;
        for (int e = neighbour.offset(cell); e < neighbour.offset(cell + 1); ++e)
          near(neighbour.item(e)) = 1;
      });
  return near;
}

} // namespace

CellSurface cellSurface(Mesh const &mesh, CellMaterialPairs const &pairs, BoundaryConditions const &conditions)
{
  return {mesh, pairs, conditions.boundary, hasContactWall(conditions.boundary)};
}

void listInterfaceCells(CellSurface const &surface, NodeMaterialPairs const &dof_nodes, InterfaceCells &cells,
                        WorkArrays const &work)
{
  Mesh const &mesh = surface.mesh;
  CellMaterialPairs const &pairs = surface.pairs;
  bool const same_mesh = cells.count >= 0 && cells.face_neighbour.data() == mesh.face_neighbour.data();
  if (same_mesh && cells.pairs.offset.data() == pairs.offset.data() &&
      cells.pairs.material.data() == pairs.material.data() && cells.pairs.cell_kind.data() == pairs.cell_kind.data() &&
      cells.boundary.data() == surface.boundary.data())
    return;
  bool const free_faces = same_mesh ? cells.free_faces : hasFreeFace(surface);
  View<int *> const near = cellsNearOthers(surface, dof_nodes, work);
  int const num_cells = mesh.num_cells, halo = mesh.halo;
  View<int *> const depth = mesh.cell_depth;
  View<int *> const visited(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::interface_cell"),
                            num_cells);
  int count = 0;
  launchScan(
      "Harmos::constrain::listInterfaceCells", num_cells,
      KOKKOS_LAMBDA(int cell, int &sum, bool final) {
        bool candidate = near(cell) == 1;
        for (int k = 0; free_faces && k < 4; ++k)
          candidate = candidate || surface.freeFace(cell, k);
        if (!candidate || (halo > 0 && depth(cell) >= halo) || !carriesSegments(surface, cell))
          return;
        if (final)
          visited(sum) = cell;
        ++sum;
      },
      count);
  cells = {pairs, mesh.face_neighbour, surface.boundary, free_faces, count, visited};
}

} // namespace Harmos
