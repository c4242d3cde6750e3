// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_CheckScene.hpp"
#include "Harmos_Require.hpp"

namespace Harmos
{
namespace
{

using namespace detail;

constexpr double fraction_round_off = 1e-6;

template <class V>
auto hostCopy(V const &view)
{
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
}

KOKKOS_INLINE_FUNCTION bool isFinite(double x)
{
  return x - x == 0.0;
}

template <class V>
bool holds(V const &view, int rows)
{
  return static_cast<int>(view.extent(0)) >= rows;
}

/// "cell 812, material 1": of a pair.
std::string placeOf(Scene const &scene, CellMaterialPairs const &pairs, int pair)
{
  return placeOf("cell", scene.mesh.cell_global, hostCopy(pairs.cell)(pair), *scene.exchange) + ", material " +
         std::to_string(hostCopy(pairs.material)(pair));
}

void checkExtents(Scene const &scene, CycleState const &s)
{
  int const num_pairs = s.pairs.num_pairs, num_dofs = s.dof_nodes.num_dof_nodes;
  std::string const pairs = std::to_string(num_pairs), dofs = std::to_string(num_dofs);
  require(static_cast<int>(s.pairs.offset.extent(0)) == scene.mesh.num_cells + 1,
          "state.pairs does not belong to scene.mesh");
  require(holds(s.pairs.material, num_pairs) && holds(s.pairs.cell, num_pairs),
          "state.pairs has fewer materials or cells than the " + pairs + " pairs");
  require(holds(s.state.record, num_pairs) && holds(s.state.centroid, num_pairs),
          "state.state has fewer records or centroids than the " + pairs + " pairs");
  require(!s.state.tracks_damage || holds(s.state.damage, num_pairs),
          "state.state.damage has fewer entries than the " + pairs + " pairs");
  require(holds(s.pairs.dof_node, num_pairs) && holds(s.pairs.cell_kind, scene.mesh.num_cells) &&
              holds(s.dof_nodes.offset, scene.mesh.num_nodes + 1) && holds(s.dof_nodes.material, num_dofs) &&
              holds(s.dof_nodes.node, num_dofs),
          "state.dof_nodes are not those of state.pairs on scene.mesh; see buildDofNodes");
  require(holds(s.state.velocity, num_dofs), "state.state.velocity has fewer rows than the " + dofs + " dof nodes");
}

/// Rows over cells, their materials, and the dof nodes.
void checkNumbers(Scene const &scene, CycleState const &s)
{
  Mesh const mesh = scene.mesh;
  CellMaterialPairs const pairs = s.pairs;
  NodeMaterialPairs const dofs = s.dof_nodes;
  int const num_materials = static_cast<int>(scene.materials.extent(0));
  int const cell = firstWrong(
      "Harmos::checkPairRows", mesh.num_cells, KOKKOS_LAMBDA(int c) {
        int const begin = pairs.offset(c), end = pairs.offset(c + 1);
        bool wrong = begin < 0 || end < begin || end > pairs.num_pairs || (c == 0 && begin != 0) ||
                     (c == mesh.num_cells - 1 && end != pairs.num_pairs);
        for (int pair = begin; pair < end && !wrong; ++pair)
          wrong = pairs.cell(pair) != c;
        return wrong;
      });
  require(cell < 0, cell < 0 ? ""
                             : placeOf("cell", mesh.cell_global, cell, *scene.exchange) +
                                   ": the rows of state.pairs are wrong; expected: offsets that ascend from 0 to the " +
                                   std::to_string(pairs.num_pairs) + " pairs, each of which names its cell");
  int const foreign = firstWrong(
      "Harmos::checkPairMaterials", pairs.num_pairs, KOKKOS_LAMBDA(int pair) {
        int const m = pairs.material(pair);
        return m < 0 || m >= num_materials || (pair > pairs.offset(pairs.cell(pair)) && pairs.material(pair - 1) >= m);
      });
  require(foreign < 0, foreign < 0
                           ? ""
                           : placeOf(scene, pairs, foreign) + ": expected: state.pairs with materials from 0 to " +
                                 std::to_string(num_materials - 1) + ", ascending within a cell");
  bool const shared = scene.kinematics == Kinematics::Single;
  bool const rows = firstWrong(
                        "Harmos::checkDofRows", mesh.num_nodes, KOKKOS_LAMBDA(int node) {
                          int const begin = dofs.offset(node), end = dofs.offset(node + 1);
                          bool wrong = begin < 0 || end < begin || end > dofs.num_dof_nodes;
                          for (int dof = begin; dof < end && !wrong; ++dof)
                            wrong = dofs.node(dof) != node || (dofs.material(dof) == -1) != shared;
                          return wrong;
                        }) < 0;
  bool const corners = rows && firstWrong(
                                   "Harmos::checkDofNodes", pairs.num_pairs, KOKKOS_LAMBDA(int pair) {
                                     bool wrong = false;
                                     for (int k = 0; k < 4; ++k)
                                     {
                                       int const dof = pairs.dof_node(pair, k);
                                       wrong = wrong || dof < 0 || dof >= dofs.num_dof_nodes ||
                                               dofs.node(dof) != mesh.cell_node(pairs.cell(pair), k) ||
                                               (!shared && dofs.material(dof) != pairs.material(pair));
                                     }
                                     return wrong;
                                   }) < 0;
  require(corners, "state.dof_nodes are not those of state.pairs and scene.kinematics; see buildDofNodes");
}

void checkRecords(Scene const &scene, CycleState const &s)
{
  CellMaterialPairs const pairs = s.pairs;
  auto const record = s.state.record;
  auto const materials = scene.materials;
  int const bad = firstWrong(
      "Harmos::checkRecords", pairs.num_pairs, KOKKOS_LAMBDA(int pair) {
        bool right = record(pair, Mass) >= 0.0 && record(pair, VolumeFraction) >= 0.0 &&
                     record(pair, VolumeFraction) <= 1.0 + fraction_round_off &&
                     (record(pair, SpecificVolume) > 0.0 || materials(pairs.material(pair)).rigid_body >= 0);
        for (int f = 0; f < num_pair_fields; ++f)
          right = right && isFinite(record(pair, f));
        return !right;
      });
  if (bad < 0)
    return;
  auto const host = hostCopy(record);
  std::string values;
  for (int f = 0; f < num_pair_fields; ++f)
    values += (f == 0 ? "" : ", ") + text(host(bad, f));
  require(false, placeOf(scene, pairs, bad) + ": state.state.record is (" + values +
                     "); expected: finite numbers, mass 0 or more, volume fraction from 0 to 1, specific volume above "
                     "0");
}

void checkVelocities(Scene const &scene, CycleState const &s)
{
  auto const velocity = s.state.velocity;
  int const dof = firstWrong(
      "Harmos::checkVelocities", s.dof_nodes.num_dof_nodes,
      KOKKOS_LAMBDA(int i) { return !isFinite(velocity(i, 0)) || !isFinite(velocity(i, 1)); });
  if (dof < 0)
    return;
  auto const host = hostCopy(velocity);
  require(false, placeOf("node", scene.mesh.node_global, hostCopy(s.dof_nodes.node)(dof), *scene.exchange) +
                     ", material " + std::to_string(hostCopy(s.dof_nodes.material)(dof)) +
                     ": state.state.velocity is (" + text(host(dof, 0)) + ", " + text(host(dof, 1)) +
                     "); expected: finite numbers");
}

} // namespace

void checkState(Scene const &scene, CycleState const &s)
{
  checkExtents(scene, s);
  checkNumbers(scene, s);
  checkRecords(scene, s);
  checkVelocities(scene, s);
}

} // namespace Harmos
