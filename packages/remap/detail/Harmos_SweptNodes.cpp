// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_LoadPoints.hpp>
#include <Harmos_Prefetch.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

struct SweptNodesFunctor
{
  SweptStage stage;
  int begin, end;

  /// Four times the nodal mass, and the momentum gained.
  struct Gathered
  {
    double four_mass;
    Vector2 gain;
  };

  /// Kinetic energy that a dof node loses (SweptHeat). \param mass, v After. \param gain Momentum gained.
  HARMOS_RARE_FUNCTION void storeHeat(int node, int dof, double mass, Vector2 const &gain, Vector2 const &v) const
  {
    double heat = 0.0;
    for (int j = stage.first_item[node]; j < stage.first_item[node + 1]; ++j)
    {
      int const cell = stage.item[j] >> 2, corner = stage.item[j] & 3;
      if (stage.pure_material[cell] >= 0 && stage.dof_node(stage.first_pair[cell], corner) == dof)
        heat += stage.corner_heat(cell, corner);
    }
    Vector2 const half{stage.half(dof, 0), stage.half(dof, 1)};
    Vector2 const change = v - half;
    double const lost = heat + dot(half, gain - mass * change) - 0.5 * mass * dot(change, change);
    stage.node_heat[dof] = mass > 0.0 ? lost / mass : 0.0;
  }

  /// All cells around are pure and of one material.
  KOKKOS_FORCEINLINE_FUNCTION Gathered gatherPure(int first, int end) const
  {
    Gathered g{0.0, {0.0, 0.0}};
    for (int j = first; j < end; ++j)
    {
      int const cell = stage.item[j] >> 2;
      int const corner = stage.item[j] & 3;
      double const *increment = stage.at(IncrementColumn + 2 * corner, cell);
      g.four_mass = multiplyAdd(stage.fourShares(cell, corner), *stage.at(NewMass, cell), g.four_mass);
      g.gain[0] += increment[0];
      g.gain[1] += increment[column_stride];
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
      double const *increment = stage.at(IncrementColumn + 2 * corner, cell);
      for (int pair = stage.first_pair[cell]; pair < stage.first_pair[cell + 1]; ++pair)
      {
        if (stage.dof_node(pair, corner) != dof || (pure < 0 && stage.isRigid(stage.pair_material[pair])))
          continue;
        g.four_mass = multiplyAdd(stage.fourShares(cell, corner), stage.record1(pair, Mass), g.four_mass);
        if (pure >= 0)
          g.gain += {increment[0], increment[column_stride]};
      }
    }
    return g;
  }

  /// A corner at a node, of a pair: four times its mass, and its velocity, the node's before and what it has gained.
  struct Corner
  {
    int cell, corner, pair;
    double four_mass;
    Vector2 own;
  };

  /// visit(corner) for all corners of deformable pairs at a dof node. In mixed cells nothing has flown.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forCorners(int node, int dof, Visitor const &visit) const
  {
    Vector2 const half{stage.half(dof, 0), stage.half(dof, 1)};
    for (int j = stage.first_item[node]; j < stage.first_item[node + 1]; ++j)
    {
      int const cell = stage.item[j] >> 2, corner = stage.item[j] & 3, pure = stage.pure_material[cell];
      for (int pair = stage.first_pair[cell]; pure != -2 && pair < stage.first_pair[cell + 1]; ++pair)
      {
        if (stage.dof_node(pair, corner) != dof || (pure < 0 && stage.isRigid(stage.pair_material[pair])))
          continue;
        Corner c{cell, corner, pair, stage.fourShares(cell, corner) * stage.record1(pair, Mass), half};
        if (pure >= 0 && c.four_mass > 0.0)
        {
          double const *increment = stage.at(IncrementColumn + 2 * corner, cell);
          c.own += (4.0 / c.four_mass) * Vector2{increment[0], increment[column_stride]};
        }
        visit(c);
      }
    }
  }

  /// Velocities of the corners at a node that stage 2 goes on with: v + increment / corner mass, which for linear ones
  /// is where the centroid of the cell has moved, to first order. With the mixed cells' corners at v, their sum is the
  /// node's momentum: but the mean of all cells around would take the lag of those which stage 1 does not move into
  /// those which it does. A component's differences from the mean are kept by one part, so far that all stay in the
  /// range of the velocities of the cells around.
  ///
  /// \param mean The node's velocity after.
  HARMOS_RARE_FUNCTION void storeCorners(int node, int dof, Vector2 const &mean) const
  {
    Vector2 least = mean, most = mean;
    forCorners(node, dof,
               [&](Corner const &c)
               {
                 for (int k = 0; k < 4; ++k)
                   for (int d = 0; d < 2; ++d)
                   {
                     double const v = stage.half(stage.dof_node(c.pair, k), d);
                     least[d] = Math::min(least[d], v);
                     most[d] = Math::max(most[d], v);
                   }
               });
    Vector2 part{1.0, 1.0}, square{0.0, 0.0};
    double four_mass = 0.0;
    forCorners(node, dof,
               [&](Corner const &c)
               {
                 four_mass += c.four_mass;
                 for (int d = 0; d < 2; ++d)
                 {
                   double const apart = c.own[d] - mean[d], size = Math::fabs(apart);
                   double const room = apart > 0.0 ? most[d] - mean[d] : mean[d] - least[d];
                   part[d] = size > room ? Math::min(part[d], room / size) : part[d];
                   square[d] += c.four_mass * apart * apart;
                 }
               });
    forCorners(node, dof,
               [&](Corner const &c)
               {
                 for (int d = 0; d < 2 && stage.pure_material[c.cell] >= 0; ++d)
                   stage.corner1(c.cell, 2 * c.corner + d) = mean[d] + part[d] * (c.own[d] - mean[d]);
               });
    double motion = 0.0; // of the corners about their mean: it is no heat
    for (int d = 0; d < 2; ++d)
    {
      stage.own_part(dof, d) = part[d];
      motion += 0.5 * part[d] * part[d] * square[d];
    }
    if (stage.returnsHeat() && four_mass > 0.0)
      stage.node_heat[dof] -= motion / four_mass;
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
      if (stage.returnsHeat())
        storeHeat(node, dof, 0.25 * g.four_mass, g.gain, v);
      if (!final)
        storeCorners(node, dof, v);
      stage.velocity1(dof, 0) = v[0];
      stage.velocity1(dof, 1) = v[1];
    }
  }

  /// No cell around takes part.
  KOKKOS_FORCEINLINE_FUNCTION void keep(int node) const
  {
    for (int dof = stage.first_dof[node]; dof < stage.first_dof[node + 1]; ++dof)
    {
      stage.velocity1(dof, 0) = stage.half(dof, 0);
      stage.velocity1(dof, 1) = stage.half(dof, 1);
    }
  }

  /// What the nodes of a pack gather, and those of its lanes that are plain.
  struct Plain
  {
    Pack four_mass = 1.0, gain_x = 0.0, gain_y = 0.0;
    unsigned lanes = 0u;
  };

  /// Whether the nodes from `first` on are plain and each lies in four cells, which are runs of cells on runs of rows.
  KOKKOS_FORCEINLINE_FUNCTION bool inRuns(int first) const
  {
    constexpr int last = PlainNode | FourCellsBit;
    int differs = (stage.node_sweep[first + pack_width - 1] & last) ^ last;
    for (int lane = 0; lane + 1 < pack_width; ++lane)
      differs |= stage.node_sweep[first + lane] ^ (last | RunsOnBit);
    if (differs != 0)
      return false;
    int const *item = stage.item + stage.first_item[first];
    for (int line = 0; line < 4 * pack_width; line += 16)
      prefetchToRead(item + 4 * rows_ahead + line);
    bool wraps = false;
    for (int i = 0; i < 4; ++i)
      wraps = wraps || !stage.inTile(item[i] >> 2);
    return !wraps;
  }

  KOKKOS_FORCEINLINE_FUNCTION Plain gatherRuns(int first) const
  {
    Plain plain;
    plain.four_mass = 0.0;
    plain.lanes = all_lanes;
    for (int i = 0; i < 4; ++i)
    {
      int const item = stage.item[stage.first_item[first] + i];
      double const *increment = stage.at(IncrementColumn + 2 * (item & 3), item >> 2);
      Pack const mass = loadPack(stage.at(NewMass, item >> 2));
      if (stage.aboutAxis())
        plain.four_mass = multiplyAdd(packOf([&](int lane) { return stage.fourShares((item >> 2) + lane, item & 3); }),
                                      mass, plain.four_mass);
      else
        plain.four_mass += mass;
      plain.gain_x += loadPack(increment);
      plain.gain_y += loadPack(increment + column_stride);
    }
    return plain;
  }

  /// The plain nodes of a pack one by one; the others are dealt with.
  KOKKOS_FORCEINLINE_FUNCTION Plain gatherLanes(int first, int count, double &impulse_x, double &impulse_y,
                                                double &kinetic) const
  {
    double mass[pack_width], gain_x[pack_width], gain_y[pack_width];
    Plain plain;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      mass[lane] = 1.0;
      gain_x[lane] = gain_y[lane] = 0.0;
      int const node = first + lane;
      if (lane >= count)
        continue;
      if (stage.node_sweep[node] == SpecialNode)
        special(node, impulse_x, impulse_y, kinetic);
      else if (stage.node_sweep[node] == UntouchedNode)
        keep(node);
      else
      {
        Gathered const g = gatherPure(stage.first_item[node], stage.first_item[node + 1]);
        mass[lane] = g.four_mass;
        gain_x[lane] = g.gain[0];
        gain_y[lane] = g.gain[1];
        plain.lanes |= 1u << lane;
      }
    }
    plain.four_mass = loadPack(mass);
    plain.gain_x = loadPack(gain_x);
    plain.gain_y = loadPack(gain_y);
    return plain;
  }

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int number, double &impulse_x, double &impulse_y, double &kinetic) const
  {
    int const first = begin + number * pack_width;
    int const count = Math::min(pack_width, end - first);
    readAhead(stage.node_sweep, first);
    readAhead(stage.first_item, first);
    readAhead(stage.first_dof, first);
    Plain const plain = count == pack_width && inRuns(first) ? gatherRuns(first)
                                                             : gatherLanes(first, count, impulse_x, impulse_y, kinetic);
    if (plain.lanes == 0u)
      return;
    int dof[pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
      dof[lane] = stage.first_dof[Math::min(first + lane, end - 1)];
    readAhead(stage.half, dof[0]);
    Pack x, y;
    bool const run = count == pack_width && countsUp(stage.first_dof + first);
    if (opaque(run))
      loadPointRun(stage.half.row(dof[0]), x, y);
    else
      loadPoints([&](int lane) { return stage.half.row(dof[lane]); }, x, y);
    Pack const per_mass = 4.0 / plain.four_mass;
    x = x + per_mass * plain.gain_x;
    y = y + per_mass * plain.gain_y;
    Pack const energy = 0.125 * plain.four_mass * (x * x + y * y);
    if (opaque(plain.lanes == all_lanes && run))
      storePointRun(stage.velocity1.row(dof[0]), x, y);
    else if (plain.lanes == all_lanes)
      storePoints([&](int lane) { return stage.velocity1.row(dof[lane]); }, x, y);
    for (int lane = 0; lane < pack_width; ++lane)
      if ((plain.lanes >> lane & 1u) != 0u)
      {
        kinetic += laneOf(energy, lane);
        if (stage.returnsHeat())
          storeHeat(first + lane, dof[lane], 0.25 * laneOf(plain.four_mass, lane),
                    {laneOf(plain.gain_x, lane), laneOf(plain.gain_y, lane)}, {laneOf(x, lane), laneOf(y, lane)});
        if (plain.lanes == all_lanes)
          continue;
        stage.velocity1(dof[lane], 0) = laneOf(x, lane);
        stage.velocity1(dof[lane], 1) = laneOf(y, lane);
      }
  }
};

} // namespace

void sweptNodes(SweptStage const &stage, int begin, int end, SweptSums &sums)
{
  double impulse_x = 0.0, impulse_y = 0.0, kinetic = 0.0;
  Kokkos::parallel_reduce("Harmos::remap::sweptNodes", RangePolicy(0, numPacks(end - begin)),
                          SweptNodesFunctor{stage, begin, end}, impulse_x, impulse_y, kinetic);
  sums.wall_impulse += Vector2{impulse_x, impulse_y};
  sums.kinetic_after += kinetic;
}

} // namespace RemapDetail
} // namespace Harmos
