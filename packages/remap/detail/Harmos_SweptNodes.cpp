// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_Pack.hpp>

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
      int const row = (stage.item[j] >> 2) & stage.mask;
      double const *increment = stage.increment.row(row) + 2 * (stage.item[j] & 3);
      g.four_mass += stage.mass[row];
      g.gain[0] += increment[0];
      g.gain[1] += increment[1];
    }
    return g;
  }

  KOKKOS_INLINE_FUNCTION Gathered gatherAny(int first, int end, int dof) const
  {
    Gathered g{0.0, {0.0, 0.0}};
    for (int j = first; j < end; ++j)
    {
      int const cell = stage.item[j] >> 2;
      int const corner = stage.item[j] & 3;
      int const pure = stage.pure_material[cell];
      if (pure == -2)
        continue;
      double const *increment = stage.incrementRow(cell) + 2 * corner;
      for (int pair = stage.first_pair[cell]; pair < stage.first_pair[cell + 1]; ++pair)
      {
        if (stage.dof_node(pair, corner) != dof || (pure < 0 && stage.isRigid(stage.pair_material[pair])))
          continue;
        g.four_mass += stage.record1(pair, Mass);
        if (pure >= 0)
          g.gain += {increment[0], increment[1]};
      }
    }
    return g;
  }

  /// Any node but a plain one.
  HARMOS_RARE_FUNCTION void special(int node, double &impulse_x, double &impulse_y, double &kinetic) const
  {
    int const first = stage.first_item[node], end = stage.first_item[node + 1];
    bool const pure = stage.node_return[node] == SweptNode;
    bool const final = stage.node_final[node] != 0;
    bool const owned = stage.node_owned[node] != 0;
    int const condition = stage.node_condition[node];
    for (int dof = stage.first_dof[node]; dof < stage.first_dof[node + 1]; ++dof)
    {
      Gathered const g = pure ? gatherPure(first, end) : gatherAny(first, end, dof);
      double const per_mass = g.four_mass > 0.0 ? 4.0 / g.four_mass : 0.0;
      Vector2 const half{stage.half(dof, 0), stage.half(dof, 1)};
      Vector2 v{half[0] + per_mass * g.gain[0], half[1] + per_mass * g.gain[1]};
      bool const moved = v[0] != half[0] || v[1] != half[1];
      if (final && moved && condition >= 0 && g.four_mass > 0.0)
      {
        Vector2 const imposed = stage.condition[condition].apply(v);
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

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int node, double &impulse_x, double &impulse_y, double &kinetic) const
  {
    if (stage.node_sweep[node] != PlainNode)
    {
      if (stage.node_sweep[node] == SpecialNode)
        special(node, impulse_x, impulse_y, kinetic);
      else
        for (int dof = stage.first_dof[node]; dof < stage.first_dof[node + 1]; ++dof)
        {
          stage.velocity1(dof, 0) = stage.half(dof, 0);
          stage.velocity1(dof, 1) = stage.half(dof, 1);
        }
      return;
    }
    Gathered const g = gatherPure(stage.first_item[node], stage.first_item[node + 1]);
    int const dof = stage.first_dof[node];
    double const per_mass = 4.0 / g.four_mass;
    double const x = stage.half(dof, 0) + per_mass * g.gain[0];
    double const y = stage.half(dof, 1) + per_mass * g.gain[1];
    stage.velocity1(dof, 0) = x;
    stage.velocity1(dof, 1) = y;
    kinetic += 0.125 * g.four_mass * (x * x + y * y);
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
