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

View<int *> openFaces(Input const &in)
{
  if (!hasOpenBoundary(in))
    return {};
  View<int *> const open = scratch<int *>("open", in.mesh.num_cells);
  View<int *> const around = scratch<int *>("openAround", in.mesh.num_cells);
  Kokkos::parallel_for(
      "Harmos::remap::openFaces", RangePolicy(0, in.mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        int bits = 0;
        for (int k = 0; k < 4; ++k)
          bits |= faceOpenBit(in, cell, k);
        open(cell) = bits;
      });
  Kokkos::parallel_for(
      "Harmos::remap::openAround", RangePolicy(0, in.mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        int bits = open(cell) % own_open_bits;
        for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
          bits |= open(in.mesh.cell_neighbour.item(j)) % own_open_bits;
        around(cell) = open(cell) + own_open_bits * bits;
      });
  return around;
}

/// What each class is made of: materials of cells -> nodes -> cells -> nodes.
struct Classifier
{
  Input in;
  Classes classes;

  /// Whether a cell is full of one rigid body before and after, so that it keeps its bits.
  KOKKOS_INLINE_FUNCTION bool staysRigid(int cell) const
  {
    int const pair = in.pairs.offset(cell), row = in.rigid.offset(cell);
    return !in.retargeted && in.pairs.cell_kind(cell) == PureCell && in.rigid.offset(cell + 1) == row + 1 &&
           in.rigid.material(row) == in.pairs.material(pair) && in.rigid.volume_fraction(row) == 1.0;
  }

  /// Material of a pure cell, and whether the cell holds a rigid body in part: these are built anew wherever one was or
  /// is, with or without deformable material around.
  KOKKOS_INLINE_FUNCTION int material(int cell, int &rigid) const
  {
    int const first = in.pairs.offset(cell), end = in.pairs.offset(cell + 1);
    if (in.rigid.offset.extent(0) > 0 && staysRigid(cell))
    {
      rigid = 0;
      return -2;
    }
    rigid = in.rigid.offset.extent(0) > 0 && in.rigid.offset(cell) < in.rigid.offset(cell + 1) ? RigidBit : 0;
    int code = -2;
    bool const pure = in.pairs.cell_kind(cell) == PureCell;
    for (int pair = first; pair < end; ++pair)
    {
      int const of_pair = in.pairs.material(pair);
      if (in.isRigid(of_pair))
        rigid = RigidBit;
      else
        code = pure ? of_pair : -1;
    }
    return code;
  }

  /// Whether a cell's materials are another class than before, with the new one in `code` and `rigid`.
  KOKKOS_INLINE_FUNCTION bool changes(int cell, int &code, int &rigid) const
  {
    code = material(cell, rigid);
    return code != classes.pure_material(cell) || rigid != (classes.flags(cell) & RigidBit);
  }

  KOKKOS_INLINE_FUNCTION void setMaterial(int cell, int code, int rigid) const
  {
    classes.pure_material(cell) = code;
    classes.flags(cell) = (classes.flags(cell) & ~RigidBit) | rigid;
  }

  KOKKOS_INLINE_FUNCTION void classifyNode(int node) const
  {
    bool const any_open = classes.open.extent(0) > 0;
    int const begin = in.mesh.node_cell.offset(node);
    int const end = in.mesh.node_cell.offset(node + 1);
    int const first = begin < end ? classes.pure_material(in.mesh.node_cell.item(begin) >> 2) : -2;
    bool uniform = first >= 0 && in.options.swept_faces;
    bool deformable = false;
    int open = 0;
    for (int j = begin; j < end; ++j)
    {
      int const cell = in.mesh.node_cell.item(j) >> 2;
      int const corner = in.mesh.node_cell.item(j) & 3;
      int const code = classes.pure_material(cell);
      uniform = uniform && code == first;
      deformable = deformable || code >= -1;
      if (any_open && classes.open(cell) % own_open_bits != 0)
        open |= faceOpenBit(in, cell, corner) | faceOpenBit(in, cell, (corner + 3) % 4);
    }
    classes.node_return(node) = uniform && open == 0                    ? SweptNode
                                : deformable || (open & InflowBit) != 0 ? InterfaceNode
                                                                        : StillNode;
  }

  KOKKOS_INLINE_FUNCTION void classifyCell(int cell) const
  {
    int const code = classes.pure_material(cell);
    int const rigid = classes.flags(cell) & RigidBit;
    int flags = rigid | (rigid != 0 ? InterfaceCellBit : 0) | (code >= 0 ? PureCellBit : 0) |
                (in.mesh.cell_depth(cell) == 0 ? OwnedCellBit : 0);
    for (int k = 0; k < 4; ++k)
    {
      int const kind = classes.node_return(in.mesh.cell_node(cell, k));
      flags |= kind == InterfaceNode ? InterfaceCellBit : 0;
      if (code < 0)
        continue;
      int const face = in.mesh.face_neighbour(cell, k);
      flags |= kind == SweptNode ? SweptCornerBit << k : 0;
      flags |= face >= 0 ? NeighbourBit << k : 0;
      flags |= face >= 0 && classes.pure_material(face / 4) == code ? SameBeyondBit << k : 0;
    }
    classes.flags(cell) = flags;
  }

  KOKKOS_INLINE_FUNCTION void finishNode(int node) const
  {
    bool final = true, swept = false;
    for (int j = in.mesh.node_cell.offset(node); j < in.mesh.node_cell.offset(node + 1); ++j)
    {
      int const flags = classes.flags(in.mesh.node_cell.item(j) >> 2);
      final = final && (flags & InterfaceCellBit) == 0;
      swept = swept || (flags & all_swept_corners) != 0;
    }
    classes.node_final(node) = final ? 1 : 0;
    bool const free = in.conditions.node_index(node) < 0 && in.mesh.node_owned(node) != 0;
    bool const plain = final && free && classes.node_return(node) == SweptNode;
    classes.node_sweep(node) = plain ? PlainNode | runBits(node) : swept ? SpecialNode : UntouchedNode;
  }

  KOKKOS_INLINE_FUNCTION int runBits(int node) const
  {
    auto const around = in.mesh.node_cell;
    int const first = around.offset(node);
    if (around.offset(node + 1) - first != 4)
      return 0;
    if (node + 1 == in.mesh.num_nodes || around.offset(node + 2) - around.offset(node + 1) != 4)
      return FourCellsBit;
    int differs = 0;
    for (int i = first; i < first + 4; ++i)
      differs |= around.item(i + 4) ^ (around.item(i) + 4);
    return differs == 0 ? FourCellsBit | RunsOnBit : FourCellsBit;
  }
};

void classifyAll(Classifier const &c)
{
  int const cells = c.in.mesh.num_cells, nodes = c.in.mesh.num_nodes;
  Kokkos::parallel_for(
      "Harmos::remap::classifyMaterials", RangePolicy(0, cells), KOKKOS_LAMBDA(int cell) {
        int rigid;
        int const code = c.material(cell, rigid);
        c.classes.flags(cell) = rigid;
        c.classes.pure_material(cell) = code;
      });
  Kokkos::parallel_for(
      "Harmos::remap::classifyNodes", RangePolicy(0, nodes), KOKKOS_LAMBDA(int node) { c.classifyNode(node); });
  Kokkos::parallel_for(
      "Harmos::remap::classifyCells", RangePolicy(0, cells), KOKKOS_LAMBDA(int cell) { c.classifyCell(cell); });
  Kokkos::parallel_for(
      "Harmos::remap::finishNodes", RangePolicy(0, nodes), KOKKOS_LAMBDA(int node) { c.finishNode(node); });
}

/// The cells whose materials have changed: their list, and the new materials in place. Returns their number.
int changedCells(Classifier const &c)
{
  View<int *> const list = c.classes.changed;
  int count = 0;
  Kokkos::parallel_scan(
      "Harmos::remap::changedCells", RangePolicy(0, c.in.mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum, bool last) {
        int code, rigid;
        if (!c.changes(cell, code, rigid))
          return;
        if (last)
        {
          list(sum) = cell;
          c.setMaterial(cell, code, rigid);
        }
        ++sum;
      },
      count);
  return count;
}

/// Classes around the changed cells. Several may write the same value to a place.
void classifyAround(Classifier const &c, int count)
{
  View<int *> const list = c.classes.changed;
  Mesh const mesh = c.in.mesh;
  Rows const row = mesh.cell_neighbour;
  Kokkos::parallel_for(
      "Harmos::remap::classifyNodesAround", RangePolicy(0, count), KOKKOS_LAMBDA(int i) {
        for (int k = 0; k < 4; ++k)
          c.classifyNode(mesh.cell_node(list(i), k));
      });
  Kokkos::parallel_for(
      "Harmos::remap::classifyCellsAround", RangePolicy(0, count), KOKKOS_LAMBDA(int i) {
        c.classifyCell(list(i));
        for (int j = row.offset(list(i)); j < row.offset(list(i) + 1); ++j)
          c.classifyCell(row.item(j));
      });
  Kokkos::parallel_for(
      "Harmos::remap::finishNodesAround", RangePolicy(0, count), KOKKOS_LAMBDA(int i) {
        for (int k = 0; k < 4; ++k)
          c.finishNode(mesh.cell_node(list(i), k));
        for (int j = row.offset(list(i)); j < row.offset(list(i) + 1); ++j)
          for (int k = 0; k < 4; ++k)
            c.finishNode(mesh.cell_node(row.item(j), k));
      });
}

/// Ascending list of the interface cells.
void listInterfaceCells(Input const &in, Classes &classes)
{
  Classes const c = classes;
  Kokkos::parallel_scan(
      "Harmos::remap::listInterfaceCells", RangePolicy(0, in.mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum, bool last) {
        bool const interface = (c.flags(cell) & InterfaceCellBit) != 0;
        if (last)
        {
          c.interface_index(cell) = interface ? sum : -1;
          if (interface)
            c.interface_cell(sum) = cell;
        }
        sum += interface ? 1 : 0;
      },
      classes.num_interface);
  Kokkos::parallel_reduce(
      "Harmos::remap::countSweptCells", RangePolicy(0, in.mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum) { sum += (c.flags(cell) & all_swept_corners) != 0 ? 1 : 0; },
      classes.num_swept);
}

} // namespace

Classes classify(Input const &in)
{
  int const cells = in.mesh.num_cells;
  Classes classes;
  classes.node_return = scratch<int *>("nodeReturn", in.mesh.num_nodes);
  classes.node_final = scratch<int *>("nodeFinal", in.mesh.num_nodes);
  classes.node_sweep = scratch<int *>("nodeSweep", in.mesh.num_nodes);
  classes.pure_material = scratch<int *>("pureMaterial", cells);
  classes.interface_index = scratch<int *>("interfaceIndex", cells);
  classes.interface_cell = scratch<int *>("interfaceCell", cells);
  classes.flags = scratch<int *>("sweptFlags", cells);
  classes.changed = scratch<int *>("changedCells", cells);
  classes.open = openFaces(in);
  classifyAll({in, classes});
  listInterfaceCells(in, classes);
  return classes;
}

void updateClasses(Input const &in, Classes &classes)
{
  constexpr int much = 64; // a changed cell costs some fifty visits of a node or cell
  Classifier const c{in, classes};
  int const count = changedCells(c);
  if (count == 0)
    return;
  if (count > in.mesh.num_cells / much)
    classifyAll(c);
  else
    classifyAround(c, count);
  listInterfaceCells(in, classes);
}

} // namespace RemapDetail
} // namespace Harmos
