// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Rebuild.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

KOKKOS_INLINE_FUNCTION bool sameMaterials(Input const &in, Acceptors const &acceptors, int index, int cell)
{
  int pair = in.pairs.offset(cell);
  int const end = in.pairs.offset(cell + 1);
  for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
  {
    if (acceptors.merge_to(c) >= 0)
      continue;
    if (pair == end || in.pairs.material(pair) != acceptors.material(c))
      return false;
    ++pair;
  }
  return pair == end;
}

int countChangedCells(Input const &in, Classes const &classes, Acceptors const &acceptors)
{
  int changed = 0;
  Kokkos::parallel_reduce(
      "Harmos::remap::countChangedCells", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int i, int &sum) { sum += sameMaterials(in, acceptors, i, classes.interface_cell(i)) ? 0 : 1; },
      changed);
  return changed;
}

/// Rows of the new pairs: offset, material, cell.
void buildRows(Input const &in, Classes const &classes, Acceptors const &acceptors, CellMaterialPairs &pairs)
{
  int const cells = in.mesh.num_cells;
  View<int *> const offset = scratch<int *>("pairOffset", cells + 1);
  Kokkos::parallel_scan(
      "Harmos::remap::countPairs", RangePolicy(0, cells + 1),
      KOKKOS_LAMBDA(int cell, int &sum, bool last) {
        if (last)
          offset(cell) = sum;
        if (cell == cells)
          return;
        int const index = classes.interface_index(cell);
        if (index < 0)
          sum += in.pairs.offset(cell + 1) - in.pairs.offset(cell);
        else
          for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
            sum += acceptors.merge_to(c) < 0 ? 1 : 0;
      },
      pairs.num_pairs);
  View<int *> const material = scratch<int *>("pairMaterial", pairs.num_pairs);
  View<int *> const pair_cell = scratch<int *>("pairCell", pairs.num_pairs);
  Kokkos::parallel_for(
      "Harmos::remap::fillPairs", RangePolicy(0, cells), KOKKOS_LAMBDA(int cell) {
        int const index = classes.interface_index(cell);
        int pair = offset(cell);
        if (index < 0)
          for (int old = in.pairs.offset(cell); old < in.pairs.offset(cell + 1); ++old)
            material(pair++) = in.pairs.material(old);
        else
          for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
            if (acceptors.merge_to(c) < 0)
              material(pair++) = acceptors.material(c);
        for (pair = offset(cell); pair < offset(cell + 1); ++pair)
          pair_cell(pair) = cell;
      });
  pairs.offset = offset;
  pairs.material = material;
  pairs.cell = pair_cell;
}

/// Records and centroids of the non-interface cells, as after stage 1.
void copyStage(Input const &in, Classes const &classes, StageState const &stage, Rebuilt const &out)
{
  bool const kinetic = out.kinetic.extent(0) > 0;
  PairState const state = out.result.state;
  View<int *> const offset = out.result.pairs.offset;
  View<double *> const new_kinetic = out.kinetic;
  Kokkos::parallel_for(
      "Harmos::remap::copyStage", RangePolicy(0, in.mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        if (classes.interface_index(cell) >= 0)
          return;
        for (int pair = offset(cell); pair < offset(cell + 1); ++pair)
        {
          int const old = in.pairs.offset(cell) + pair - offset(cell);
          for (int f = 0; f < num_pair_fields; ++f)
            state.record(pair, f) = stage.record(old, f);
          for (int d = 0; d < 2; ++d)
            state.centroid(pair, d) = in.state.centroid(old, d);
          if (kinetic)
            new_kinetic(pair) = stage.kinetic(old);
        }
      });
}

/// Records and centroids of the interface cells.
void copyCandidates(Classes const &classes, Acceptors const &acceptors, Rebuilt const &out)
{
  bool const kinetic = out.kinetic.extent(0) > 0;
  PairState const state = out.result.state;
  View<int *> const offset = out.result.pairs.offset;
  View<int *> const candidate = out.candidate;
  View<double *> const new_kinetic = out.kinetic;
  Kokkos::parallel_for(
      "Harmos::remap::copyCandidates", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int i) {
        int pair = offset(classes.interface_cell(i));
        for (int c = acceptors.begin(i); c < acceptors.end(i); ++c)
        {
          if (acceptors.merge_to(c) >= 0)
            continue;
          for (int f = 0; f < num_pair_fields; ++f)
            state.record(pair, f) = acceptors.record(c, f);
          for (int d = 0; d < 2; ++d)
            state.centroid(pair, d) = acceptors.centroid(c, d);
          if (kinetic)
            new_kinetic(pair) = acceptors.kinetic(c);
          candidate(pair) = c;
          ++pair;
        }
      });
}

/// Kinds of the interface cells; the array of the input stays where none changes.
void updateCellKinds(Input const &in, Classes const &classes, Rebuilt &out)
{
  CellMaterialPairs &pairs = out.result.pairs;
  View<double *[num_pair_fields]> const record = out.result.state.record;
  View<int *> const offset = pairs.offset;
  View<int *> const old_kind = in.pairs.cell_kind;
  View<int *> const kind = scratch<int *>("interfaceKind", classes.num_interface);
  int changed = 0;
  Kokkos::parallel_reduce(
      "Harmos::remap::interfaceKinds", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int i, int &sum) {
        int const cell = classes.interface_cell(i);
        int const first = offset(cell);
        int const count = offset(cell + 1) - first;
        kind(i) = count == 0 ? VoidCell : count == 1 && record(first, VolumeFraction) == 1.0 ? PureCell : MixedCell;
        sum += kind(i) != old_kind(cell) ? 1 : 0;
      },
      changed);
  if (changed == 0)
    return;
  pairs.cell_kind = scratch<int *>("cellKind", in.mesh.num_cells);
  Kokkos::deep_copy(pairs.cell_kind, old_kind);
  View<int *> const cell_kind = pairs.cell_kind;
  Kokkos::parallel_for(
      "Harmos::remap::updateCellKinds", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int i) { cell_kind(classes.interface_cell(i)) = kind(i); });
}

} // namespace

Rebuilt rebuild(Input const &in, Kinematics kinematics, Classes const &classes, StageState const &stage,
                Acceptors const &acceptors)
{
  Rebuilt out;
  out.result.pairs = in.pairs;
  out.result.dof_nodes = in.dof_nodes;
  out.result.state.record = stage.record;
  out.result.state.centroid = in.state.centroid;
  out.kinetic = stage.kinetic;
  if (classes.num_interface == 0)
    return out;

  bool const same = countChangedCells(in, classes, acceptors) == 0;
  CellMaterialPairs &pairs = out.result.pairs;
  if (!same)
  {
    buildRows(in, classes, acceptors, pairs);
    out.result.state.record = scratch<double *[num_pair_fields]>("record", pairs.num_pairs);
    if (stage.kinetic.extent(0) > 0)
      out.kinetic = scratch<double *>("kinetic", pairs.num_pairs);
  }
  out.result.state.centroid = scratch<double *[2]>("centroid", pairs.num_pairs);
  out.candidate = scratch<int *>("pairCandidate", pairs.num_pairs);
  if (same)
    Kokkos::deep_copy(out.result.state.centroid, in.state.centroid);
  else
    copyStage(in, classes, stage, out);
  copyCandidates(classes, acceptors, out);
  if (same)
    updateCellKinds(in, classes, out);
  else
  {
    pairs.dof_node = {};
    pairs.cell_kind = {};
    out.result.dof_nodes = buildDofNodes(in.mesh, kinematics, out.result.state.record, pairs);
  }
  return out;
}

} // namespace RemapDetail
} // namespace Harmos
