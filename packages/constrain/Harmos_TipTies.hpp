// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TIP_TIES_HPP
#define HARMOS_TIP_TIES_HPP

#include <Harmos_CornerContacts.hpp>

namespace Harmos
{

/// \brief Rows that hold the light nodes of a corner that touches a face to the body behind them.
///
/// The nodes around a tip move hardly anything: the row of the corner throws them out of its way, by motions of which
/// stress along the mean strain of their cells knows nothing (a cell that ends in one edge has four outer velocities
/// and three strains), and hourglass viscosity makes heat of it: a corner kept 0.55 to 0.97 of the kinetic energy that
/// it should. So in the cut cells of a corner, its tip and its edges each node I that moves less than
/// `least_tip_mass` of what a node inside does goes with the linear velocity of a cell c of the same body,
///
///   v_I = sum_k w_k v_k , w_k = 1/4 + B_k . (x_I - x_c) ,
///
/// B_k the cell's mean gradient, tied along both axes within the multipliers' problem: weights that add to one and give
/// the node's place keep momentum and angular momentum. c is that of the cells that do not touch the node, but cells
/// that do, with the largest filled part over its distance from the node, of which 0.3 are filled at least (as
/// aggregated cells have it: Badia, Verdugo & Martin, Comput. Methods Appl. Mech. Eng. 336 (2018) 533). With
/// restitution there are none, for what is tied loses energy.
///
/// Such a row has one material on both sides and no length. Corners of body-fitted meshes have none: nothing cuts their
/// cells.
constexpr double least_tip_mass = 0.4; // of a node around which all is filled

/// Numbers of ties within a cell begin here: behind those of the rows of segments.
constexpr int first_tie = 2 * max_cell_segments;

/// \brief The ties of the cells of a rank, in the order of cells.
struct TipTies
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  FilledRegions regions;
  BodyTable bodies;
  View<int *> of_tip; // dof nodes: 1 around corners that touch a face

  /// visit(row) for every tie of an owned cell, by rising keys.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forEach(int cell, Visitor const &visit) const
  {
    if (mesh.cell_depth(cell) != 0)
      return;
    for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      for (int k = 0; k < 4; ++k)
      {
        int const number = first_tie + 4 * (pair - pairs.offset(cell)) + k;
        ContactRow row = {};
        if (of_tip(pairs.dof_node(pair, k)) == 0 || number >= max_cell_rows || !tie(pair, k, row))
          continue;
        row.key = mesh.cell_global(cell) * max_cell_rows + number;
        visit(row);
      }
  }

private:
  KOKKOS_INLINE_FUNCTION double filled(int cell, int material) const
  {
    int const pair = pairs.find(cell, material);
    return pair < 0 ? 0.0 : area(regions.region(mesh, pairs, pair)) / mesh.cell_area(cell);
  }

  KOKKOS_INLINE_FUNCTION bool touches(int cell, int node) const
  {
    for (int k = 0; k < 4; ++k)
      if (mesh.cell_node(cell, k) == node)
        return true;
    return false;
  }

  KOKKOS_INLINE_FUNCTION Vector2 middleOf(int cell) const
  {
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    return 0.25 * ((q[0] + q[1]) + (q[2] + q[3]));
  }

  /// The cell that moves a node, -1: none.
  KOKKOS_INLINE_FUNCTION int rootOf(int node, int material) const
  {
    constexpr double least_filled = 0.3, alike = 1e-6;
    Vector2 const x{mesh.node_position(node, 0), mesh.node_position(node, 1)};
    int root = -1;
    double best = 0.0;
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const around = mesh.node_cell.item(i) / 4;
      for (int j = mesh.cell_neighbour.offset(around); j < mesh.cell_neighbour.offset(around + 1); ++j)
      {
        int const cell = mesh.cell_neighbour.item(j);
        double const part = touches(cell, node) ? 0.0 : filled(cell, material);
        if (part < least_filled)
          continue;
        double const score = part * Math::sqrt(mesh.cell_area(cell)) / norm(middleOf(cell) - x);
        bool const first = root < 0 || mesh.cell_global(cell) < mesh.cell_global(root);
        if (score > (1.0 + alike) * best || (first && score > (1.0 - alike) * best))
        {
          best = Math::max(best, score);
          root = cell;
        }
      }
    }
    return root;
  }

  /// \return False where corner k of the pair's cell moves enough, has no cell to go with, or is another cell's.
  KOKKOS_INLINE_FUNCTION bool tie(int pair, int k, ContactRow &row) const
  {
    int const cell = pairs.cell(pair), material = pairs.material(pair), node = mesh.cell_node(cell, k);
    double mass = 0.0;
    int first = -1;
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const around = mesh.node_cell.item(i) / 4;
      mass += 0.25 * filled(around, material);
      if (first < 0 && pairs.find(around, material) >= 0)
        first = around;
    }
    int const root = mass < least_tip_mass && first == cell ? rootOf(node, material) : -1;
    if (root < 0)
      return false;
    row.material_a = row.material_b = material;
    row.body_a = row.body_b = -1;
    row.cell_a = cell;
    row.cell_b = root;
    row.point = {mesh.node_position(node, 0), mesh.node_position(node, 1)};
    row.normal = {1.0, 0.0};
    row.tied = 1;
    row.bond = -1;
    Quadrilateral const q = cellQuadrilateral(mesh, root);
    Vector2 const apart = row.point - middleOf(root);
    double const per_area = 0.5 / area(q);
    int const moving = pairs.find(root, material);
    for (int l = 0; l < 4; ++l)
    {
      row.dof_a[l] = pairs.dof_node(pair, l);
      row.weight_a[l] = l == k ? 1.0 : 0.0;
      row.dof_b[l] = pairs.dof_node(moving, l);
      row.weight_b[l] = 0.25 + per_area * cross(apart, q[(l + 1) & 3] - q[(l + 3) & 3]);
    }
    return true;
  }
};

/// The ties of the corners that touch faces. \param corners Not empty.
TipTies findTipTies(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                    FilledRegions const &regions, InterfaceSegments const &segments, CornerContacts const &corners,
                    BodyTable const &bodies, ConstraintOptions const &options, BoundaryConditions const &conditions,
                    WorkArrays const &work = {});

/// Put the ties among the rows of the segments, in the order of keys.
void addTipTies(TipTies const &ties, ContactRows &rows, WorkArrays const &work = {});

} // namespace Harmos

#endif
