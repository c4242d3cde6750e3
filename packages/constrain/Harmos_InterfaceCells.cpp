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
  Kokkos::parallel_reduce(
      "Harmos::constrain::freeFaces", RangePolicy(0, surface.mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &count) {
        for (int k = 0; k < 4; ++k)
          count += surface.freeFace(cell, k) ? 1 : 0;
      },
      free);
  return free > 0;
}

// What a node carries: its only material, else one of these.
constexpr int no_material = -1;
constexpr int several_materials = 1 << 30;

View<int *> nodeMaterials(Mesh const &mesh, NodeMaterialPairs const &dof_nodes, WorkArrays const &work)
{
  View<int *> const carried = work.unset<int *>("Harmos::constrain::node_material", mesh.num_nodes);
  View<int *> const offset = dof_nodes.offset, material = dof_nodes.material;
  Kokkos::parallel_for(
      "Harmos::constrain::nodeMaterials", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        int const first = offset(node), count = offset(node + 1) - first;
        carried(node) = count == 1 ? material(first) : count == 0 ? no_material : several_materials;
      });
  return carried;
}

/// 1 for the cells that have two materials, or a contact wall, within two cells around them. Those are then at the
/// nodes of one cell, which is this one or one of its vertex neighbours.
View<int *> cellsNearOthers(CellSurface const &surface, NodeMaterialPairs const &dof_nodes, WorkArrays const &work)
{
  View<int *[4]> const cell_node = surface.mesh.cell_node;
  Rows const neighbour = surface.mesh.cell_neighbour;
  bool const walls = surface.walls;
  View<int *> const carried = nodeMaterials(surface.mesh, dof_nodes, work);
  View<int *> const near = work.zeros<int *>("Harmos::constrain::near_others", surface.mesh.num_cells);
  Kokkos::parallel_for(
      "Harmos::constrain::nearOthers", RangePolicy(0, surface.mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        int most = no_material;
        unsigned least = static_cast<unsigned>(no_material); // the largest of all
        for (int k = 0; k < 4; ++k)
        {
          int const m = carried(cell_node(cell, k));
          most = Math::max(most, m);
          least = Math::min(least, static_cast<unsigned>(m));
        }
        bool meets = most == several_materials || static_cast<unsigned>(most) != least;
        for (int k = 0; walls && k < 4; ++k)
          meets = meets || surface.contactWall(cell, k);
        if (!meets)
          return;
        near(cell) = 1; // whoever writes writes one
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
  Kokkos::parallel_scan(
      "Harmos::constrain::listInterfaceCells", RangePolicy(0, num_cells),
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
