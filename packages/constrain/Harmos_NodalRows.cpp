// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactRows.hpp>
#include <Harmos_Moments.hpp>

#include <stdexcept>

namespace Harmos
{

namespace
{

/// Rows of one corner of a cell are numbered below this, so that a cell's are below max_cell_segments.
constexpr int max_corner_rows = max_cell_segments / 4;

struct NodalRowBuilder
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  FilledRegions regions;
  BoundaryConditions conditions;
  BodyTable bodies;
  View<PairInteraction **> interaction;
  bool merged;

  /// The first cell around a node that holds a material: 4 * cell + corner.
  KOKKOS_INLINE_FUNCTION int firstCell(int node, int material) const
  {
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
      if (pairs.find(mesh.node_cell.item(i) / 4, material) >= 0)
        return mesh.node_cell.item(i);
    return -1;
  }

  /// From the volume of a to that of b around a node; zero where neither lies more on one side than the other.
  KOKKOS_INLINE_FUNCTION Vector2 normalAt(int node, int material_a, int material_b) const
  {
    Vector2 const x{mesh.node_position(node, 0), mesh.node_position(node, 1)};
    Vector2 sum{0.0, 0.0};
    double size = 0.0;
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const cell = mesh.node_cell.item(i) / 4;
      size += mesh.cell_area(cell) * Math::sqrt(mesh.cell_area(cell));
      for (int side = 0; side < 2; ++side)
      {
        int const pair = pairs.find(cell, side == 0 ? material_a : material_b);
        if (pair < 0)
          continue;
        Moments<1> const m = moments<1>(regions.region(mesh, pairs, pair), x);
        sum += (side == 0 ? -1.0 : 1.0) * Vector2{m.value[1], m.value[2]};
      }
    }
    int const index = conditions.node_index(node);
    if (index >= 0)
      sum = conditions.condition(index).project(sum); // along a wall, which mirrors what lies beyond it
    constexpr double least = 1e-10;
    return norm(sum) > least * size ? normalised(sum) : Vector2{0.0, 0.0};
  }

  KOKKOS_INLINE_FUNCTION void fillSide(int cell, int corner, int material, int body, int dof[4], double weight[4]) const
  {
    int const pair = pairs.find(cell, material);
    for (int k = 0; k < 4; ++k)
    {
      dof[k] = body == -1 ? pairs.dof_node(pair, k) : -1;
      weight[k] = k == corner ? 1.0 : 0.0;
    }
  }

  /// visit(row) for every row of an owned cell.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forEachRow(int cell, Visitor const &visit) const
  {
    for (int corner = 0; mesh.cell_depth(cell) == 0 && corner < 4; ++corner)
    {
      int const node = mesh.cell_node(cell, corner), end = dof_nodes.offset(node + 1);
      int number = 0;
      for (int i = dof_nodes.offset(node); i < end; ++i)
      {
        int const a = dof_nodes.material(i);
        for (int j = i + 1; a >= 0 && j < (merged ? Math::min(i + 2, end) : end); ++j)
          if (firstCell(node, a) == 4 * cell + corner)
          {
            ContactRow row = {};
            row.key = mesh.cell_global(cell) * max_cell_rows + corner * max_corner_rows + number++;
            if (fill(cell, corner, a, dof_nodes.material(j), row))
              visit(row);
          }
      }
    }
  }

private:
  /// \return False where the two have no normal, or no impulse could move either.
  KOKKOS_INLINE_FUNCTION bool fill(int cell, int corner, int a, int b, ContactRow &row) const
  {
    int const node = mesh.cell_node(cell, corner), other = firstCell(node, b);
    row.material_a = a;
    row.material_b = b;
    row.body_a = bodies.of_material(a);
    row.body_b = bodies.of_material(b);
    row.cell_a = cell;
    row.cell_b = other / 4;
    row.point = {mesh.node_position(node, 0), mesh.node_position(node, 1)};
    row.normal = merged ? Vector2{1.0, 0.0} : normalAt(node, a, b);
    row.length = Math::sqrt(mesh.cell_area(cell)) * (mesh.cell_volume(cell) / mesh.cell_area(cell));
    PairInteraction const &law = interaction(a, b);
    row.tied = merged || law.kind == Interaction::Bonded ? 1 : 0;
    row.friction = !merged && law.kind == Interaction::Friction ? law.friction : 0.0;
    row.restitution = merged ? 0.0 : law.restitution;
    row.bond = -1;
    if (other < 0 || dot(row.normal, row.normal) == 0.0 || (bodies.driven(row.body_a) && bodies.driven(row.body_b)))
      return false;
    fillSide(cell, corner, a, row.body_a, row.dof_a, row.weight_a);
    fillSide(other / 4, other % 4, b, row.body_b, row.dof_b, row.weight_b);
    return true;
  }
};

/// \throw std::runtime_error where a node is moved by more materials than a corner's rows can be numbered for.
void checkMaterialsAtNodes(NodeMaterialPairs const &dof_nodes, bool merged)
{
  int most = 0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::mostMaterials", RangePolicy(0, static_cast<int>(dof_nodes.offset.extent(0)) - 1),
      KOKKOS_LAMBDA(int node, int &largest) {
        largest = Math::max(largest, dof_nodes.offset(node + 1) - dof_nodes.offset(node));
      },
      Kokkos::Max<int>(most));
  int const rows = merged ? most - 1 : most * (most - 1) / 2;
  if (rows > max_corner_rows)
    throw std::runtime_error("nodal contact: " + std::to_string(most) + " materials at one node make " +
                             std::to_string(rows) + " pairs, at most " + std::to_string(max_corner_rows));
}

} // namespace

ContactRows buildNodalRows(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                           FilledRegions const &regions, BoundaryConditions const &conditions, BodyTable const &bodies,
                           ConstraintOptions const &options, WorkArrays const &work)
{
  NodalRowBuilder const builder{mesh,       pairs,  dof_nodes,           regions,
                                conditions, bodies, options.interaction, options.method == ConstraintMethod::Merged};
  checkMaterialsAtNodes(dof_nodes, builder.merged);
  View<int *> const first = work.unset<int *>("Harmos::constrain::first_nodal_row", mesh.num_cells);
  ContactRows rows;
  Kokkos::parallel_scan(
      "Harmos::constrain::countNodalRows", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum, bool final) {
        if (final)
          first(cell) = sum;
        builder.forEachRow(cell, [&](ContactRow const &) { ++sum; });
      },
      rows.count);
  rows.num_own = rows.count;
  rows.row = work.unset<ContactRow *>("Harmos::constrain::row", rows.count);
  rows.own = work.unset<int *>("Harmos::constrain::own_row", rows.count);
  View<ContactRow *> const row = rows.row;
  View<int *> const own = rows.own;
  Kokkos::parallel_reduce(
      "Harmos::constrain::makeNodalRows", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, long long &multipliers) {
        int r = first(cell);
        builder.forEachRow(cell,
                           [&](ContactRow const &made)
                           {
                             row(r) = made;
                             own(r) = r;
                             multipliers += made.tied || made.friction > 0.0 ? 2 : 1;
                             ++r;
                           });
      },
      rows.num_multipliers);
  return rows;
}

} // namespace Harmos
