// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <Harmos_Pack.hpp>
#include <Harmos_RowPointer.hpp>
#include <detail/Harmos_JoinReducer.hpp>

namespace Harmos
{
namespace
{

/// What a dof node gathers from the pairs around it, in the order of mesh.node_cell.
struct Gathered
{
  double mass = 0.0;
  Vector2 force = {0.0, 0.0};
  bool held = false; // by a rigid material
};

struct GatherCorners
{
  int const *first_item; // mesh.node_cell.offset
  int const *item;
  int const *first_pair; // pairs.offset
  int const *material_of;
  Material const *materials;
  RowPointer<double, num_pair_fields> record;
  RowPointer<double, 8> corner_force;

  KOKKOS_FORCEINLINE_FUNCTION void add(Gathered &sum, int pair, int corner) const
  {
    double const *force = corner_force.row(pair) + 2 * corner;
    sum.mass += record(pair, Mass);
    sum.force[0] += force[0];
    sum.force[1] += force[1];
  }

  /// The pairs of one material.
  KOKKOS_FORCEINLINE_FUNCTION Gathered ofMaterial(int node, int material) const
  {
    Gathered sum;
    if (materials[material].rigid_body >= 0)
    {
      sum.held = true;
      return sum;
    }
    int const last = first_item[node + 1];
    for (int i = first_item[node]; i < last; ++i)
    {
      int const cell = item[i] >> 2;
      int pair = first_pair[cell];
      int const end = first_pair[cell + 1];
      while (pair < end && material_of[pair] != material)
        ++pair;
      if (pair < end)
        add(sum, pair, item[i] & 3);
    }
    sum.mass *= 0.25;
    return sum;
  }

  /// All pairs around a shared node.
  HARMOS_RARE_FUNCTION Gathered ofAll(int node) const
  {
    Gathered sum;
    for (int i = first_item[node]; i < first_item[node + 1]; ++i)
    {
      int const cell = item[i] >> 2;
      for (int pair = first_pair[cell]; pair < first_pair[cell + 1]; ++pair)
        if (materials[material_of[pair]].rigid_body >= 0)
          sum.held = true;
        else
          add(sum, pair, item[i] & 3);
    }
    sum.mass *= 0.25;
    return sum;
  }
};

struct Sums : PredictionSums
{
  KOKKOS_INLINE_FUNCTION void join(Sums const &other)
  {
    wall_impulse += other.wall_impulse;
    wall_work += other.wall_work;
    gravity_impulse += other.gravity_impulse;
    gravity_work += other.gravity_work;
    driven_impulse += other.driven_impulse;
    driven_work += other.driven_work;
  }
};

struct PredictFunctor
{
  GatherCorners gather;
  BoundaryConditions boundary;
  int const *node_of;
  int const *material_of_dof;
  int const *node_owned;
  int const *node_condition;
  RowPointer<double, 2> velocity, predicted;
  double *dof_mass;
  Vector2 gravity;
  bool has_gravity;
  double dt;

  KOKKOS_FORCEINLINE_FUNCTION Vector2 accelerate(int dof, Gathered const &g) const
  {
    Vector2 const impulse = dt * (g.force + g.mass * gravity);
    return Vector2{velocity(dof, 0), velocity(dof, 1)} + (g.mass > 0.0 ? 1.0 / g.mass : 0.0) * impulse;
  }

  KOKKOS_FORCEINLINE_FUNCTION void store(int dof, double mass, Vector2 const &v) const
  {
    dof_mass[dof] = mass;
    predicted(dof, 0) = v[0];
    predicted(dof, 1) = v[1];
  }

  /// Held nodes, node conditions, gravity: whatever has sums.
  HARMOS_RARE_FUNCTION void special(int dof, Gathered const &g, Vector2 const &free, Sums &sums) const
  {
    int const node = node_of[dof];
    int const condition = node_condition[node];
    Vector2 const v{velocity(dof, 0), velocity(dof, 1)};
    Vector2 v_star = g.held ? v : free;
    if (condition >= 0 && !g.held)
      v_star = boundary.condition(condition).apply(free);
    store(dof, g.mass, v_star);
    if (node_owned[node] == 0)
      return;
    Vector2 const mean = 0.5 * (v + v_star);
    Vector2 const by_gravity = (dt * g.mass) * gravity;
    Vector2 const by_other = g.mass * (v_star - free);
    sums.gravity_impulse += by_gravity;
    sums.gravity_work += dot(by_gravity, mean);
    (g.held ? sums.driven_impulse : sums.wall_impulse) += by_other;
    (g.held ? sums.driven_work : sums.wall_work) += dot(by_other, mean);
  }

  KOKKOS_INLINE_FUNCTION void operator()(int dof, Sums &sums) const
  {
    int const node = node_of[dof];
    int const material = material_of_dof[dof];
    Gathered const g = material >= 0 ? gather.ofMaterial(node, material) : gather.ofAll(node);
    Vector2 const free = accelerate(dof, g);
    if (has_gravity || g.held || node_condition[node] >= 0)
      special(dof, g, free, sums);
    else
      store(dof, g.mass, free);
  }
};

} // namespace

PredictionSums predictVelocities(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                                 PairState const &state, BoundaryConditions const &boundary,
                                 View<Material *> const &materials, LagrangeOptions const &options, double dt,
                                 LagrangeWork &work)
{
  GatherCorners const gather{mesh.node_cell.offset.data(),
                             mesh.node_cell.item.data(),
                             pairs.offset.data(),
                             pairs.material.data(),
                             materials.data(),
                             state.record,
                             work.corner_force};
  Vector2 const gravity = options.gravity;
  PredictFunctor const predict{gather,
                               boundary,
                               dof_nodes.node.data(),
                               dof_nodes.material.data(),
                               mesh.node_owned.data(),
                               boundary.node_index.data(),
                               state.velocity,
                               work.predicted,
                               work.dof_mass.data(),
                               gravity,
                               gravity[0] != 0.0 || gravity[1] != 0.0,
                               dt};
  Sums result;
  Kokkos::parallel_reduce("Harmos::lagrange::predictVelocities", RangePolicy(0, dof_nodes.num_dof_nodes), predict,
                          detail::JoinReducer<Sums>(result));
  return result;
}

} // namespace Harmos
