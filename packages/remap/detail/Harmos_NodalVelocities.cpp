// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_CornerTransfer.hpp>
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

  /// Sum over the deformable pairs around: the nodal mass and momentum.
  KOKKOS_INLINE_FUNCTION double gather(int node, int dof, Vector2 &momentum) const
  {
    double mass = 0.0;
    momentum = {0.0, 0.0};
    for (int j = in.mesh.node_cell.offset(node); j < in.mesh.node_cell.offset(node + 1); ++j)
    {
      int const cell = in.mesh.node_cell.item(j) >> 2;
      int const corner = in.mesh.node_cell.item(j) & 3;
      bool const interface = classes.interface_index(cell) >= 0;
      double const share = in.share(cell, corner);
      for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      {
        if (pairs.dof_node(pair, corner) != dof || in.isRigid(pairs.material(pair)))
          continue;
        double const m = share * record(pair, Mass);
        int const old = in.pairs.offset(cell) + pair - pairs.offset(cell);
        momentum += m * (interface ? Vector2{acceptors.corner_velocity(candidate(pair), 2 * corner),
                                             acceptors.corner_velocity(candidate(pair), 2 * corner + 1)}
                                   : stage.cornerVelocity(in, classes, old, corner));
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
      double const mass = gather(node, dof, momentum);
      if (!gathers)
        v = {stage.velocity(old, 0), stage.velocity(old, 1)};
      else if (mass > 0.0)
        v = (1.0 / mass) * momentum;
      bool const same = old >= 0 && v[0] == in.half(old, 0) && v[1] == in.half(old, 1);
      if (condition >= 0 && !same && mass > 0.0)
      {
        Vector2 const imposed = in.conditions.condition(condition).apply(v);
        if (owned)
        {
          impulse_x += mass * (imposed[0] - v[0]);
          impulse_y += mass * (imposed[1] - v[1]);
        }
        v = imposed;
      }
      if (owned)
        kinetic += 0.5 * mass * dot(v, v);
      velocity(dof, 0) = v[0];
      velocity(dof, 1) = v[1];
    }
  }
};

/// Nodes whose cells' shares have changed (moveShares).
struct MoveSharesFunctor
{
  Input in;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  View<double *[num_pair_fields]> record;
  View<double *[2]> velocity, moved;

  /// Mass and momentum of a corner before, and of the same corner after.
  struct Corner
  {
    double mass_before, mass;
    Vector2 momentum;
  };

  KOKKOS_INLINE_FUNCTION Corner cornerOf(int cell, int pair, int corner) const
  {
    double from[4], to[4], v[8];
    for (int k = 0; k < 4; ++k)
    {
      from[k] = in.share(cell, k);
      to[k] = in.mesh.corner_share(cell, k);
      for (int d = 0; d < 2; ++d)
        v[2 * k + d] = velocity(pairs.dof_node(pair, k), d);
    }
    reshare(from, to, v);
    double const mass = to[corner] * record(pair, Mass);
    return {from[corner] * record(pair, Mass), mass, {mass * v[2 * corner], mass * v[2 * corner + 1]}};
  }

  KOKKOS_INLINE_FUNCTION void operator()(int dof, double &impulse_x, double &impulse_y, double &gained) const
  {
    int const node = dof_nodes.node(dof);
    Corner sum{0.0, 0.0, {0.0, 0.0}};
    for (int j = in.mesh.node_cell.offset(node); j < in.mesh.node_cell.offset(node + 1); ++j)
    {
      int const cell = in.mesh.node_cell.item(j) >> 2;
      int const corner = in.mesh.node_cell.item(j) & 3;
      for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      {
        if (pairs.dof_node(pair, corner) != dof || in.isRigid(pairs.material(pair)))
          continue;
        Corner const c = cornerOf(cell, pair, corner);
        sum.mass_before += c.mass_before;
        sum.mass += c.mass;
        sum.momentum += c.momentum;
      }
    }
    Vector2 const before{velocity(dof, 0), velocity(dof, 1)};
    Vector2 const free = sum.mass > 0.0 ? (1.0 / sum.mass) * sum.momentum : before;
    int const condition = in.conditions.node_index(node);
    Vector2 const v = condition >= 0 && sum.mass > 0.0 ? in.conditions.condition(condition).apply(free) : free;
    moved(dof, 0) = v[0];
    moved(dof, 1) = v[1];
    if (in.mesh.node_owned(node) == 0)
      return;
    impulse_x += sum.mass * (v[0] - free[0]);
    impulse_y += sum.mass * (v[1] - free[1]);
    gained += 0.5 * sum.mass * dot(v, v) - 0.5 * sum.mass_before * dot(before, before);
  }
};

} // namespace

void moveShares(Input const &in, Rebuilt &rebuilt, SweptSums &sums)
{
  RemapResult &out = rebuilt.result;
  View<double *[2]> const moved = scratch<double *[2]>("sharedVelocity", out.dof_nodes.num_dof_nodes);
  double impulse_x = 0.0, impulse_y = 0.0, gained = 0.0;
  Kokkos::parallel_reduce("Harmos::remap::moveShares", RangePolicy(0, out.dof_nodes.num_dof_nodes),
                          MoveSharesFunctor{in, out.pairs, out.dof_nodes, out.state.record, out.state.velocity, moved},
                          impulse_x, impulse_y, gained);
  out.state.velocity = moved;
  sums.wall_impulse += Vector2{impulse_x, impulse_y};
  sums.kinetic_after += gained;
}

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
          s += record(pair, Mass) * cornerKineticEnergy(in.share, pairs, velocity, pair);
      },
      sum);
  return sum;
}

double returnKineticDefect(Input const &in, Rebuilt const &rebuilt)
{
  CellMaterialPairs const pairs = rebuilt.result.pairs;
  PairState const state = rebuilt.result.state;
  View<double *> const kinetic = rebuilt.kinetic;
  CornerShares const share = in.mesh.corner_share; // of the mesh that the remap has come to
  double sum = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::remap::returnKineticDefect", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, double &s) {
        if (in.isRigid(pairs.material(pair)))
          return;
        double const defect = kinetic(pair) - cornerKineticEnergy(share, pairs, state.velocity, pair);
        state.record(pair, InternalEnergy) += defect;
        if (in.mesh.cell_depth(pairs.cell(pair)) == 0)
          s += state.record(pair, Mass) * defect;
      },
      sum);
  return sum;
}

} // namespace RemapDetail
} // namespace Harmos
