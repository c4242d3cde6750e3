// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

struct SweptNodesFunctor
{
  SweptStage stage;

  /// Four times the nodal mass, and the momentum gained.
  struct Gathered
  {
    double four_mass;
    Vector2 gain;
  };

  /// All cells around are pure and of one material.
  KOKKOS_FORCEINLINE_FUNCTION Gathered gatherPure(int first, int end) const
  {
    Gathered g{0.0, {0.0, 0.0}};
    for (int j = first; j < end; ++j)
    {
      int const item = stage.in.mesh.node_cell.item(j);
      int const row = stage.window.row(item >> 2);
      g.four_mass += stage.record1(stage.in.pairs.offset(item >> 2), Mass);
      g.gain[0] += stage.window.increment(row, 2 * (item & 3));
      g.gain[1] += stage.window.increment(row, 2 * (item & 3) + 1);
    }
    return g;
  }

  KOKKOS_INLINE_FUNCTION Gathered gatherAny(int first, int end, int dof) const
  {
    Input const &in = stage.in;
    Gathered g{0.0, {0.0, 0.0}};
    for (int j = first; j < end; ++j)
    {
      int const cell = in.mesh.node_cell.item(j) / 4;
      int const corner = in.mesh.node_cell.item(j) % 4;
      int const pure = stage.classes.pure_material(cell);
      if (pure == -2)
        continue;
      int const row = stage.window.row(cell);
      for (int pair = in.pairs.offset(cell); pair < in.pairs.offset(cell + 1); ++pair)
      {
        if (in.pairs.dof_node(pair, corner) != dof || (pure < 0 && in.isRigid(in.pairs.material(pair))))
          continue;
        g.four_mass += stage.record1(pair, Mass);
        if (pure >= 0)
          g.gain += {stage.window.increment(row, 2 * corner), stage.window.increment(row, 2 * corner + 1)};
      }
    }
    return g;
  }

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int node, double &impulse_x, double &impulse_y, double &kinetic) const
  {
    Input const &in = stage.in;
    int const first = in.mesh.node_cell.offset(node), end = in.mesh.node_cell.offset(node + 1);
    bool const pure = stage.classes.node_return(node) == SweptNode;
    bool const final = stage.classes.node_final(node) != 0;
    bool const owned = in.mesh.node_owned(node) != 0;
    int const condition = in.conditions.node_index(node);
    for (int dof = in.dof_nodes.offset(node); dof < in.dof_nodes.offset(node + 1); ++dof)
    {
      Gathered const g = pure ? gatherPure(first, end) : gatherAny(first, end, dof);
      double const per_mass = g.four_mass > 0.0 ? 4.0 / g.four_mass : 0.0;
      Vector2 const half{in.half(dof, 0), in.half(dof, 1)};
      Vector2 v{half[0] + per_mass * g.gain[0], half[1] + per_mass * g.gain[1]};
      bool const moved = v[0] != half[0] || v[1] != half[1];
      if (final && moved && condition >= 0 && g.four_mass > 0.0)
      {
        Vector2 const imposed = in.conditions.condition(condition).apply(v);
        if (owned)
        {
          impulse_x += 0.25 * g.four_mass * (imposed[0] - v[0]);
          impulse_y += 0.25 * g.four_mass * (imposed[1] - v[1]);
        }
        v = imposed;
      }
      if (final && owned)
        kinetic += 0.125 * g.four_mass * dot(v, v);
      stage.velocity1(dof, 0) = v[0];
      stage.velocity1(dof, 1) = v[1];
    }
  }
};

} // namespace

void sweptNodes(SweptStage const &stage, int begin, int end, SweptSums &sums)
{
  double impulse_x = 0.0, impulse_y = 0.0, kinetic = 0.0;
  Kokkos::parallel_reduce("Harmos::remap::sweptNodes", RangePolicy(begin, end), SweptNodesFunctor{stage}, impulse_x,
                          impulse_y, kinetic);
  sums.wall_impulse += Vector2{impulse_x, impulse_y};
  sums.kinetic_after += kinetic;
}

} // namespace RemapDetail
} // namespace Harmos
