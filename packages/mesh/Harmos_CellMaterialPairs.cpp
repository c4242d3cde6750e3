// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_CellMaterialPairs.hpp>

#include <string>

namespace Harmos
{

namespace
{

/// The materials of a cell or a node in one word: bit m for material m < 63; the last bit says that there are
/// materials from 63 on, whose rows are then merged from the lists of the cells around.
using MaterialSet = unsigned long long;

constexpr int many_materials_bit = 63;
constexpr MaterialSet many_materials = 1ull << many_materials_bit;

KOKKOS_INLINE_FUNCTION MaterialSet setOf(int material)
{
  return 1ull << (material < many_materials_bit ? material : many_materials_bit);
}

/// Number of bits set (Warren, Hacker's Delight, 5-1: Kokkos has its own from 4.1 on).
KOKKOS_INLINE_FUNCTION int bitCount(MaterialSet x)
{
  x = x - ((x >> 1) & 0x5555555555555555ull);
  x = (x & 0x3333333333333333ull) + ((x >> 2) & 0x3333333333333333ull);
  x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0full;
  return static_cast<int>((x * 0x0101010101010101ull) >> 56);
}

/// Number of the lowest bit of a set that is not empty.
KOKKOS_INLINE_FUNCTION int lowestBit(MaterialSet x)
{
  return bitCount((x & (~x + 1)) - 1);
}

struct DofNodeBuilder
{
  bool shared; // one dof node per node, whatever the material
  Rows node_cell;
  View<int *> pair_offset;
  View<int *> pair_material;
  View<MaterialSet *> cell_set;
  View<MaterialSet *> node_set;

  /// The least material above `last` among the cells around a node, or -1.
  KOKKOS_INLINE_FUNCTION int nextMaterial(int node, int last) const
  {
    int next = -1;
    for (int i = node_cell.offset(node); i < node_cell.offset(node + 1); ++i)
    {
      int const cell = node_cell.item(i) / 4;
      for (int pair = pair_offset(cell); pair < pair_offset(cell + 1); ++pair)
      {
        int const material = pair_material(pair);
        if (material > last && (next < 0 || material < next))
          next = material;
      }
    }
    return next;
  }

  KOKKOS_INLINE_FUNCTION MaterialSet gather(int node) const
  {
    MaterialSet set = 0;
    for (int i = node_cell.offset(node); i < node_cell.offset(node + 1); ++i)
      set |= cell_set(node_cell.item(i) >> 2);
    return set;
  }

  KOKKOS_INLINE_FUNCTION int countAt(int node, MaterialSet set) const
  {
    if (shared)
      return set == 0 ? 0 : 1;
    if ((set & many_materials) == 0)
      return (set & (set - 1)) == 0 ? (set == 0 ? 0 : 1) : bitCount(set);
    int count = 0;
    for (int m = nextMaterial(node, -1); m >= 0; m = nextMaterial(node, m))
      ++count;
    return count;
  }

  KOKKOS_INLINE_FUNCTION void fill(int node, NodeMaterialPairs const &dof_nodes) const
  {
    MaterialSet set = node_set(node);
    int dof = dof_nodes.offset(node);
    if (shared && set != 0)
    {
      dof_nodes.material(dof) = -1;
      dof_nodes.node(dof) = node;
    }
    else if ((set & many_materials) == 0)
      for (; set != 0; set &= set - 1, ++dof)
      {
        dof_nodes.material(dof) = lowestBit(set);
        dof_nodes.node(dof) = node;
      }
    else
      for (int m = nextMaterial(node, -1); m >= 0; m = nextMaterial(node, m), ++dof)
      {
        dof_nodes.material(dof) = m;
        dof_nodes.node(dof) = node;
      }
  }

  /// The dof node of a material that is present at a node.
  KOKKOS_INLINE_FUNCTION int dofNode(int node, int material, NodeMaterialPairs const &dof_nodes) const
  {
    int dof = dof_nodes.offset(node);
    if (shared)
      return dof;
    MaterialSet const set = node_set(node);
    if ((set & many_materials) == 0)
      return (set & (set - 1)) == 0 ? dof : dof + bitCount(set & (setOf(material) - 1));
    while (dof_nodes.material(dof) != material)
      ++dof;
    return dof;
  }
};

void classifyCells(DofNodeBuilder const &builder, CellMaterialPairs const &pairs,
                   View<double *[num_pair_fields]> const &record)
{
  CellMaterialPairs const p = pairs;
  auto const cell_set = builder.cell_set;
  Kokkos::parallel_for(
      "Harmos::mesh::classifyCells", RangePolicy(0, static_cast<int>(cell_set.extent(0))), KOKKOS_LAMBDA(int cell) {
        int const first = p.offset(cell);
        int const end = p.offset(cell + 1);
        MaterialSet set = 0;
        for (int pair = first; pair < end; ++pair)
          set |= setOf(p.material(pair));
        cell_set(cell) = set;
        p.cell_kind(cell) = cellKind(p, record, cell);
      });
}

/// Rows over nodes: a scan of the numbers of dof nodes. Returns their total.
int countDofNodes(DofNodeBuilder const &builder, View<int *> const &offset)
{
  int const num_nodes = static_cast<int>(offset.extent(0)) - 1;
  DofNodeBuilder const b = builder;
  int total = 0;
  Kokkos::parallel_scan(
      "Harmos::mesh::countDofNodes", RangePolicy(0, num_nodes),
      KOKKOS_LAMBDA(int node, int &sum, bool final) {
        MaterialSet const set = b.gather(node);
        if (final)
        {
          b.node_set(node) = set;
          offset(node) = sum;
        }
        sum += b.countAt(node, set);
        if (final && node + 1 == num_nodes)
          offset(num_nodes) = sum;
      },
      total);
  if (num_nodes == 0)
    Kokkos::deep_copy(offset, 0);
  return total;
}

void fillDofNodes(DofNodeBuilder const &builder, NodeMaterialPairs const &dof_nodes)
{
  DofNodeBuilder const b = builder;
  NodeMaterialPairs const d = dof_nodes;
  Kokkos::parallel_for(
      "Harmos::mesh::fillDofNodes", RangePolicy(0, static_cast<int>(d.offset.extent(0)) - 1),
      KOKKOS_LAMBDA(int node) { b.fill(node, d); });
}

void connectPairs(Mesh const &mesh, DofNodeBuilder const &builder, NodeMaterialPairs const &dof_nodes,
                  CellMaterialPairs const &pairs)
{
  auto const cell_node = mesh.cell_node;
  DofNodeBuilder const b = builder;
  NodeMaterialPairs const d = dof_nodes;
  CellMaterialPairs const p = pairs;
  Kokkos::parallel_for(
      "Harmos::mesh::connectPairs", RangePolicy(0, p.num_pairs), KOKKOS_LAMBDA(int pair) {
        int const cell = p.cell(pair);
        int const material = p.material(pair);
        for (int k = 0; k < 4; ++k)
          p.dof_node(pair, k) = b.dofNode(cell_node(cell, k), material, d);
      });
}

template <class V>
V uninitialised(char const *label, int size)
{
  return V(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), size);
}

} // namespace

NodeMaterialPairs buildDofNodes(Mesh const &mesh, Kinematics kinematics, View<double *[num_pair_fields]> const &record,
                                CellMaterialPairs &pairs)
{
  ScopedRegion const region("Harmos::mesh::buildDofNodes");
  pairs.dof_node = uninitialised<View<int *[4]>>("Harmos::mesh::dof_node", pairs.num_pairs);
  pairs.cell_kind = uninitialised<View<int *>>("Harmos::mesh::cell_kind", mesh.num_cells);

  DofNodeBuilder builder;
  builder.shared = kinematics == Kinematics::Single;
  builder.node_cell = mesh.node_cell;
  builder.pair_offset = pairs.offset;
  builder.pair_material = pairs.material;
  builder.cell_set = uninitialised<View<MaterialSet *>>("Harmos::mesh::cell_set", mesh.num_cells);
  builder.node_set = uninitialised<View<MaterialSet *>>("Harmos::mesh::node_set", mesh.num_nodes);
  classifyCells(builder, pairs, record);
  // Each body-fitted cell is its pair's; a fraction below one is void inside of it.
  if (kinematics == Kinematics::Lagrangian)
    Kokkos::deep_copy(pairs.cell_kind, static_cast<int>(PureCell));

  NodeMaterialPairs dof_nodes;
  dof_nodes.offset = uninitialised<View<int *>>("Harmos::mesh::dof_offset", mesh.num_nodes + 1);
  dof_nodes.num_dof_nodes = countDofNodes(builder, dof_nodes.offset);
  dof_nodes.material = uninitialised<View<int *>>("Harmos::mesh::dof_material", dof_nodes.num_dof_nodes);
  dof_nodes.node = uninitialised<View<int *>>("Harmos::mesh::dof_node_node", dof_nodes.num_dof_nodes);
  fillDofNodes(builder, dof_nodes);
  connectPairs(mesh, builder, dof_nodes, pairs);
  return dof_nodes;
}

} // namespace Harmos
