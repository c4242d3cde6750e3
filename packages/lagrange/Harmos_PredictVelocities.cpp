// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

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
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  View<Material *> materials;
  View<double *[num_pair_fields]> record;
  View<double *[8]> corner_force;

  KOKKOS_FORCEINLINE_FUNCTION void add(Gathered &sum, int pair, int corner) const
  {
    sum.mass += record(pair, Mass);
    sum.force[0] += corner_force(pair, 2 * corner);
    sum.force[1] += corner_force(pair, 2 * corner + 1);
  }

  /// The pairs of one material.
  KOKKOS_FORCEINLINE_FUNCTION Gathered ofMaterial(int node, int material) const
  {
    Gathered sum;
    if (materials(material).rigid_body >= 0)
    {
      sum.held = true;
      return sum;
    }
    int const last = mesh.node_cell.offset(node + 1);
    for (int i = mesh.node_cell.offset(node); i < last; ++i)
    {
      int const item = mesh.node_cell.item(i);
      int const end = pairs.offset((item >> 2) + 1);
      for (int pair = pairs.offset(item >> 2); pair < end; ++pair)
        if (pairs.material(pair) == material)
        {
          add(sum, pair, item & 3);
          break;
        }
    }
    sum.mass *= 0.25;
    return sum;
  }

  /// All pairs around a shared node.
  KOKKOS_INLINE_FUNCTION Gathered ofAll(int node) const
  {
    Gathered sum;
    int const last = mesh.node_cell.offset(node + 1);
    for (int i = mesh.node_cell.offset(node); i < last; ++i)
    {
      int const item = mesh.node_cell.item(i);
      int const end = pairs.offset((item >> 2) + 1);
      for (int pair = pairs.offset(item >> 2); pair < end; ++pair)
        if (materials(pairs.material(pair)).rigid_body >= 0)
          sum.held = true;
        else
          add(sum, pair, item & 3);
    }
    sum.mass *= 0.25;
    return sum;
  }

  KOKKOS_FORCEINLINE_FUNCTION Gathered operator()(int dof) const
  {
    int const material = dof_nodes.material(dof);
    int const node = dof_nodes.node(dof);
    return material >= 0 ? ofMaterial(node, material) : ofAll(node);
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

} // namespace

PredictionSums predictVelocities(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                                 PairState const &state, BoundaryConditions const &boundary,
                                 View<Material *> const &materials, LagrangeOptions const &options, double dt,
                                 LagrangeWork &work)
{
  GatherCorners const gather{mesh, pairs, dof_nodes, materials, state.record, work.corner_force};
  auto const velocity = state.velocity;
  auto const dof_mass = work.dof_mass;
  auto const predicted = work.predicted;
  Vector2 const gravity = options.gravity;
  bool const has_gravity = gravity[0] != 0.0 || gravity[1] != 0.0;
  Sums result;
  Kokkos::parallel_reduce(
      "Harmos::lagrange::predictVelocities", RangePolicy(0, dof_nodes.num_dof_nodes),
      KOKKOS_LAMBDA(int dof, Sums &sums) {
        Gathered const g = gather(dof);
        int const node = gather.dof_nodes.node(dof);
        Vector2 const v{velocity(dof, 0), velocity(dof, 1)};
        Vector2 const impulse = dt * (g.force + g.mass * gravity);
        Vector2 const free = v + (g.mass > 0.0 ? 1.0 / g.mass : 0.0) * impulse;
        Vector2 v_star = g.held ? v : free;
        int const condition = boundary.node_index(node);
        if (condition >= 0 && !g.held)
          v_star = boundary.condition(condition).apply(free);
        dof_mass(dof) = g.mass;
        predicted(dof, 0) = v_star[0];
        predicted(dof, 1) = v_star[1];
        if (!(has_gravity || g.held || condition >= 0) || !gather.mesh.node_owned(node))
          return;
        Vector2 const mean = 0.5 * (v + v_star);
        Vector2 const by_gravity = (dt * g.mass) * gravity;
        Vector2 const by_other = g.mass * (v_star - free);
        sums.gravity_impulse += by_gravity;
        sums.gravity_work += dot(by_gravity, mean);
        (g.held ? sums.driven_impulse : sums.wall_impulse) += by_other;
        (g.held ? sums.driven_work : sums.wall_work) += dot(by_other, mean);
      },
      detail::JoinReducer<Sums>(result));
  return result;
}

} // namespace Harmos
