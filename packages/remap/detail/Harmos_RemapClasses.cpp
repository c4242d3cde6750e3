// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_RemapClasses.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

KOKKOS_INLINE_FUNCTION int openBit(BoundaryKind kind)
{
  return kind == BoundaryKind::ContactWall ? ContactBit
         : kind == BoundaryKind::Outflow   ? OutflowBit
         : kind == BoundaryKind::Inflow    ? InflowBit
                                           : 0;
}

KOKKOS_INLINE_FUNCTION int faceOpenBit(Input const &in, int cell, int face)
{
  int const boundary = in.mesh.face_boundary(cell, face);
  return boundary < 0 ? 0 : openBit(in.conditions.boundary(boundary).kind);
}

bool hasOpenBoundary(Input const &in)
{
  View<Boundary *> const boundary = in.conditions.boundary;
  int count = 0;
  Kokkos::parallel_reduce(
      "Harmos::remap::openBoundaries", RangePolicy(0, static_cast<int>(boundary.extent(0))),
      KOKKOS_LAMBDA(int b, int &sum) { sum += openBit(boundary(b).kind) != 0; }, count);
  return count > 0;
}

void classifyMaterials(Input const &in, Classes const &classes)
{
  Kokkos::parallel_for(
      "Harmos::remap::classifyMaterials", RangePolicy(0, in.mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        int const first = in.pairs.offset(cell);
        int code = -2;
        if (in.pairs.cell_kind(cell) == PureCell)
        {
          int const material = in.pairs.material(first);
          code = in.isRigid(material) ? -2 : material;
        }
        else
        {
          for (int pair = first; pair < in.pairs.offset(cell + 1); ++pair)
            if (!in.isRigid(in.pairs.material(pair)))
              code = -1;
        }
        classes.pure_material(cell) = code;
      });
}

void classifyBoundaries(Input const &in, Classes &classes)
{
  if (!hasOpenBoundary(in))
    return;
  View<int *> const open = scratch<int *>("open", in.mesh.num_cells);
  classes.open = open;
  Kokkos::parallel_for(
      "Harmos::remap::classifyBoundaries", RangePolicy(0, in.mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        int bits = 0;
        for (int k = 0; k < 4; ++k)
          bits |= faceOpenBit(in, cell, k);
        open(cell) = bits;
      });
}

void classifyNodes(Input const &in, Classes const &classes)
{
  bool const any_open = classes.open.extent(0) > 0;
  Kokkos::parallel_for(
      "Harmos::remap::classifyNodes", RangePolicy(0, in.mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        int const begin = in.mesh.node_cell.offset(node);
        int const end = in.mesh.node_cell.offset(node + 1);
        int const material = begin < end ? classes.pure_material(in.mesh.node_cell.item(begin) / 4) : -2;
        bool uniform = material >= 0;
        bool deformable = false;
        int open = 0;
        for (int j = begin; j < end; ++j)
        {
          int const cell = in.mesh.node_cell.item(j) / 4;
          int const corner = in.mesh.node_cell.item(j) % 4;
          int const code = classes.pure_material(cell);
          uniform = uniform && code == material;
          deformable = deformable || code >= -1;
          if (any_open && classes.open(cell) != 0)
            open |= faceOpenBit(in, cell, corner) | faceOpenBit(in, cell, (corner + 3) % 4);
        }
        int const kind = uniform && open == 0                    ? SweptNode
                         : deformable || (open & InflowBit) != 0 ? InterfaceNode
                                                                 : StillNode;
        classes.node_return(node) = kind;
      });
}

/// Rigid pairs are built anew wherever a body was or is, with or without deformable material around.
KOKKOS_INLINE_FUNCTION bool holdsRigid(Input const &in, int cell)
{
  if (in.rigid.offset.extent(0) > 0 && in.rigid.offset(cell) < in.rigid.offset(cell + 1))
    return true;
  for (int pair = in.pairs.offset(cell); pair < in.pairs.offset(cell + 1); ++pair)
    if (in.isRigid(in.pairs.material(pair)))
      return true;
  return false;
}

/// Ascending list of the cells whose mark is set; index(cell) is the place in it or -1.
int listCells(View<int *> const &index, View<int *> &list)
{
  int const cells = static_cast<int>(index.extent(0));
  int total = 0;
  View<int *> const filled = scratch<int *>("cellList", cells);
  Kokkos::parallel_scan(
      "Harmos::remap::listCells", RangePolicy(0, cells),
      KOKKOS_LAMBDA(int cell, int &sum, bool last) {
        int const mark = index(cell);
        if (last)
        {
          index(cell) = mark != 0 ? sum : -1;
          if (mark != 0)
            filled(sum) = cell;
        }
        sum += mark;
      },
      total);
  list = filled;
  return total;
}

/// Flags of the pure cells, marks of the interface cells. Returns the number of cells with a swept node.
int markCells(Input const &in, Classes const &classes)
{
  int num_swept = 0;
  Kokkos::parallel_reduce(
      "Harmos::remap::markCells", RangePolicy(0, in.mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum) {
        int const material = classes.pure_material(cell);
        int flags = material >= 0 ? PureCellBit : 0;
        int interface = holdsRigid(in, cell) ? 1 : 0;
        for (int k = 0; k < 4; ++k)
        {
          int const kind = classes.node_return(in.mesh.cell_node(cell, k));
          interface |= kind == InterfaceNode ? 1 : 0;
          if (material < 0)
            continue;
          int const face = in.mesh.face_neighbour(cell, k);
          flags |= kind == SweptNode ? SweptCornerBit << k : 0;
          flags |= face >= 0 ? NeighbourBit << k : 0;
          flags |= face >= 0 && classes.pure_material(face / 4) == material ? SameBeyondBit << k : 0;
        }
        classes.flags(cell) = flags;
        classes.interface_index(cell) = interface;
        sum += (flags & all_swept_corners) != 0 ? 1 : 0;
      },
      num_swept);
  return num_swept;
}

void markFinalNodes(Input const &in, Classes const &classes)
{
  Kokkos::parallel_for(
      "Harmos::remap::markFinalNodes", RangePolicy(0, in.mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        bool final = true;
        for (int j = in.mesh.node_cell.offset(node); j < in.mesh.node_cell.offset(node + 1); ++j)
          final = final && classes.interface_index(in.mesh.node_cell.item(j) / 4) < 0;
        classes.node_final(node) = final ? 1 : 0;
        bool const free = in.conditions.node_index(node) < 0 && in.mesh.node_owned(node) != 0;
        classes.node_plain(node) = final && free && classes.node_return(node) == SweptNode ? 1 : 0;
      });
}

} // namespace

Classes classify(Input const &in)
{
  int const cells = in.mesh.num_cells;
  Classes classes;
  classes.node_return = scratch<int *>("nodeReturn", in.mesh.num_nodes);
  classes.node_final = scratch<int *>("nodeFinal", in.mesh.num_nodes);
  classes.node_plain = scratch<int *>("nodePlain", in.mesh.num_nodes);
  classes.pure_material = scratch<int *>("pureMaterial", cells);
  classes.interface_index = scratch<int *>("interfaceIndex", cells);
  classes.flags = scratch<int *>("sweptFlags", cells);
  classifyMaterials(in, classes);
  classifyBoundaries(in, classes);
  classifyNodes(in, classes);
  classes.num_swept = markCells(in, classes);
  classes.num_interface = listCells(classes.interface_index, classes.interface_cell);
  markFinalNodes(in, classes);
  return classes;
}

} // namespace RemapDetail
} // namespace Harmos
