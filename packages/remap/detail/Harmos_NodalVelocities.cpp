// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Rebuild.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

struct NodalVelocityFunctor
{
  Input in;
  Classes classes;
  StageState stage;
  Acceptors acceptors;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  View<double *[num_pair_fields]> record;
  View<int *> candidate;
  View<double *[2]> velocity;
  bool in_place;

  /// Whether a cell around the node changed in stage 2.
  KOKKOS_INLINE_FUNCTION bool changed(int node) const
  {
    for (int j = in.mesh.node_cell.offset(node); j < in.mesh.node_cell.offset(node + 1); ++j)
    {
      int const index = classes.interface_index(in.mesh.node_cell.item(j) >> 2);
      if (index >= 0 && acceptors.verbatim(index) == 0)
        return true;
    }
    return false;
  }

  /// Sum over the deformable pairs around: four times the nodal mass and momentum.
  KOKKOS_INLINE_FUNCTION double gather(int node, int dof, Vector2 &momentum) const
  {
    double mass = 0.0;
    momentum = {0.0, 0.0};
    for (int j = in.mesh.node_cell.offset(node); j < in.mesh.node_cell.offset(node + 1); ++j)
    {
      int const cell = in.mesh.node_cell.item(j) >> 2;
      int const corner = in.mesh.node_cell.item(j) & 3;
      bool const interface = classes.interface_index(cell) >= 0;
      for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      {
        if (pairs.dof_node(pair, corner) != dof || in.isRigid(pairs.material(pair)))
          continue;
        double const m = record(pair, Mass);
        int const old_dof =
            interface ? -1 : in.pairs.dof_node(in.pairs.offset(cell) + pair - pairs.offset(cell), corner);
        for (int d = 0; d < 2; ++d)
          momentum[d] +=
              m * (interface ? acceptors.corner_velocity(candidate(pair), 2 * corner + d) : stage.velocity(old_dof, d));
        mass += m;
      }
    }
    return mass;
  }

  /// No cell around changes its materials, and so the node its dof nodes.
  KOKKOS_INLINE_FUNCTION void copyFinal(int node) const
  {
    int old = in.dof_nodes.offset(node);
    for (int dof = dof_nodes.offset(node); dof < dof_nodes.offset(node + 1); ++dof, ++old)
    {
      velocity(dof, 0) = stage.velocity(old, 0);
      velocity(dof, 1) = stage.velocity(old, 1);
    }
  }

  KOKKOS_INLINE_FUNCTION void operator()(int node, double &impulse_x, double &impulse_y, double &kinetic) const
  {
    if (classes.node_final(node) != 0)
    {
      if (!in_place)
        copyFinal(node);
      return;
    }
    bool const gathers = changed(node);
    bool const owned = in.mesh.node_owned(node) != 0;
    int const condition = in.conditions.node_index(node);
    for (int dof = dof_nodes.offset(node); dof < dof_nodes.offset(node + 1); ++dof)
    {
      int const old = gathers && condition < 0 ? -1 : in.dof_nodes.find(node, dof_nodes.material(dof));
      Vector2 v{0.0, 0.0}, momentum;
      double const four_mass = gather(node, dof, momentum);
      if (!gathers)
        v = {stage.velocity(old, 0), stage.velocity(old, 1)};
      else if (four_mass > 0.0)
        v = (1.0 / four_mass) * momentum;
      bool const same = old >= 0 && v[0] == in.half(old, 0) && v[1] == in.half(old, 1);
      if (condition >= 0 && !same && four_mass > 0.0)
      {
        Vector2 const imposed = in.conditions.condition(condition).apply(v);
        if (owned)
        {
          impulse_x += 0.25 * four_mass * (imposed[0] - v[0]);
          impulse_y += 0.25 * four_mass * (imposed[1] - v[1]);
        }
        v = imposed;
      }
      if (owned)
        kinetic += 0.125 * four_mass * dot(v, v);
      velocity(dof, 0) = v[0];
      velocity(dof, 1) = v[1];
    }
  }
};

} // namespace

void nodalVelocities(Input const &in, Classes const &classes, StageState const &stage, Acceptors const &acceptors,
                     Rebuilt const &rebuilt, bool in_place, SweptSums &sums)
{
  RemapResult const &out = rebuilt.result;
  double impulse_x = 0.0, impulse_y = 0.0, kinetic = 0.0;
  Kokkos::parallel_reduce("Harmos::remap::nodalVelocities", RangePolicy(0, in.mesh.num_nodes),
                          NodalVelocityFunctor{in, classes, stage, acceptors, out.pairs, out.dof_nodes,
                                               out.state.record, rebuilt.candidate, out.state.velocity, in_place},
                          impulse_x, impulse_y, kinetic);
  sums.wall_impulse += Vector2{impulse_x, impulse_y};
  sums.kinetic_after += kinetic;
}

double kineticEnergy(Input const &in, CellMaterialPairs const &pairs, View<double *[num_pair_fields]> const &record,
                     View<double *[2]> const &velocity)
{
  double sum = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::remap::kineticEnergy", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, double &s) {
        if (in.mesh.cell_depth(pairs.cell(pair)) == 0 && !in.isRigid(pairs.material(pair)))
          s += record(pair, Mass) * cornerKineticEnergy(pairs, velocity, pair);
      },
      sum);
  return sum;
}

double returnKineticDefect(Input const &in, Rebuilt const &rebuilt)
{
  CellMaterialPairs const pairs = rebuilt.result.pairs;
  PairState const state = rebuilt.result.state;
  View<double *> const kinetic = rebuilt.kinetic;
  double sum = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::remap::returnKineticDefect", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, double &s) {
        if (in.isRigid(pairs.material(pair)))
          return;
        double const defect = kinetic(pair) - cornerKineticEnergy(pairs, state.velocity, pair);
        state.record(pair, InternalEnergy) += defect;
        if (in.mesh.cell_depth(pairs.cell(pair)) == 0)
          s += state.record(pair, Mass) * defect;
      },
      sum);
  return sum;
}

} // namespace RemapDetail
} // namespace Harmos
