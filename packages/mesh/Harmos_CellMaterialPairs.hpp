// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CELL_MATERIAL_PAIRS_HPP
#define HARMOS_CELL_MATERIAL_PAIRS_HPP

#include <Harmos_Mesh.hpp>

namespace Harmos
{

/// What a cell holds. Pure: one pair that fills it (volume fraction exactly 1). Mixed: anything else but nothing.
enum CellKind : int
{
  VoidCell = 0,
  PureCell = 1,
  MixedCell = 2
};

/// The (cell, material) pairs that exist: compressed rows over cells, materials ascending within a cell.
///
/// A pair is one single-material element of the X-FEM decomposition. Element kernels run over pairs; `dof_node` alone
/// tells them which velocities move it (Hansbo & Hansbo, CMAME 193 (2004) 3523; Song et al., IJNME 67 (2006) 868).
struct CellMaterialPairs
{
  int num_pairs = 0;
  View<int *> offset;      // num_cells + 1
  View<int *> material;    // num_pairs
  View<int *> cell;        // num_pairs
  View<int *[4]> dof_node; // num_pairs: the dof nodes at the cell's four corners
  View<int *> cell_kind;   // num_cells, CellKind

  /// The pair of a material in a cell, or -1.
  KOKKOS_INLINE_FUNCTION int find(int in_cell, int of_material) const
  {
    for (int pair = offset(in_cell); pair < offset(in_cell + 1); ++pair)
      if (material(pair) == of_material)
        return pair;
    return -1;
  }
};

/// The (node, material) dof nodes in the support of some pair: compressed rows over nodes, materials ascending.
///
/// Kinematics `xfem` and `lagrangian`: one per (node, material). `single`: one per node that any pair touches, with
/// material = -1.
struct NodeMaterialPairs
{
  int num_dof_nodes = 0;
  View<int *> offset;   // num_nodes + 1
  View<int *> material; // num_dof_nodes; -1: shared by all
  View<int *> node;     // num_dof_nodes

  /// The dof node of a material at a node, or -1.
  KOKKOS_INLINE_FUNCTION int find(int at_node, int of_material) const
  {
    for (int dof = offset(at_node); dof < offset(at_node + 1); ++dof)
      if (material(dof) == of_material || material(dof) == -1)
        return dof;
    return -1;
  }
};

/// Fields of a pair's record (one cache line).
enum PairField : int
{
  Mass = 0,           // [kg/m]; per radian when axisymmetric
  VolumeFraction = 1, // of its cell, geometric
  SpecificVolume = 2, // thermodynamic [m^3/kg]: force, work and equation of state use it; evolves with tr D
  InternalEnergy = 3, // per mass [J/kg]
  PlasticStrain = 4,  // equivalent
  DeviatorXX = 5,     // stress deviator [Pa]; zz = -(xx + yy)
  DeviatorYY = 6,
  DeviatorXY = 7,
  num_pair_fields = 8
};

/// Whether matter has flowed so far that its outlines keep nothing of the straight edges and smooth facets they began
/// with: no corner is looked for there (Harmos_CornerCell.hpp), and facets are parted (detail/Harmos_PartDonors.hpp).
/// \param plastic_strain Equivalent.
KOKKOS_INLINE_FUNCTION bool hasFlowed(double plastic_strain)
{
  return plastic_strain > 0.1;
}

/// State at one time level, numbered as the pairs and dof nodes that it belongs to.
struct PairState
{
  View<double *[num_pair_fields]> record; // num_pairs
  View<double *[2]> centroid;             // num_pairs: of the filled region [length]; valid in mixed cells only
  View<double *[2]> velocity;             // num_dof_nodes, v^{n-1/2} at the start of a cycle [m/s]
  bool tracks_damage = false;             // some law can fail
  View<double *> damage = {};             // num_pairs where tracked (Harmos_Failure.hpp), else nothing
};

/// The kind of a cell from its pairs: pure where one pair fills it.
KOKKOS_INLINE_FUNCTION CellKind cellKind(CellMaterialPairs const &pairs, View<double *[num_pair_fields]> const &record,
                                         int cell)
{
  int const first = pairs.offset(cell), end = pairs.offset(cell + 1);
  bool const pure = end == first + 1 && record(first, VolumeFraction) == 1.0;
  return end == first ? VoidCell : (pure ? PureCell : MixedCell);
}

enum class Kinematics
{
  Xfem,
  Single,
  Lagrangian
};

/// Build the dof nodes of a set of pairs (offset, material, cell given), and the pairs' dof_node and cell_kind.
///
/// \param pairs     In: offset, material, cell. Out: dof_node; cell_kind from `record` (Pure where the one pair's
///                  VolumeFraction == 1).
/// \param record    Volume fractions of the pairs.
/// \return The dof nodes: compressed rows over nodes, materials ascending.
/// Cost: proportional to cells + pairs. Deterministic.
NodeMaterialPairs buildDofNodes(Mesh const &mesh, Kinematics kinematics, View<double *[num_pair_fields]> const &record,
                                CellMaterialPairs &pairs);

} // namespace Harmos

#endif
