// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <Harmos_JoinReducer.hpp>
#include <Harmos_LoadPoints.hpp>
#include <Harmos_NodeEnds.hpp>
#include <Harmos_Prefetch.hpp>
#include <Harmos_RowPointer.hpp>
#include <detail/Harmos_NodeKernels.hpp>

#include <limits>
#include <type_traits>

namespace Harmos
{
namespace
{

constexpr int cells_at_once = 2048; // their records and forces stay in the cache until their nodes have gathered them

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
  RowPointer<double, 4> share; // Mesh::corner_share, about an axis
  bool about_axis;

  /// Four times the part of a cell's mass that a corner takes.
  KOKKOS_FORCEINLINE_FUNCTION double fourShares(int cell, int corner) const
  {
    return about_axis ? 4.0 * share(cell, corner) : 1.0;
  }

  KOKKOS_FORCEINLINE_FUNCTION void add(Gathered &sum, int cell, int pair, int corner) const
  {
    double const *force = corner_force.row(pair) + 2 * corner;
    sum.mass = multiplyAdd(fourShares(cell, corner), record(pair, Mass), sum.mass);
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
        add(sum, cell, pair, item[i] & 3);
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
          add(sum, cell, pair, item[i] & 3);
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
  double kick;
  int begin, end; // dof nodes

  KOKKOS_FORCEINLINE_FUNCTION Vector2 accelerate(int dof, Gathered const &g) const
  {
    Vector2 const impulse = kick * (g.force + g.mass * gravity);
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
    Vector2 const by_gravity = (kick * g.mass) * gravity;
    Vector2 const by_other = g.mass * (v_star - free);
    sums.gravity_impulse += by_gravity;
    sums.gravity_work += dot(by_gravity, mean);
    (g.held ? sums.driven_impulse : sums.wall_impulse) += by_other;
    (g.held ? sums.driven_work : sums.wall_work) += dot(by_other, mean);
  }

  /// What the dof nodes of a pack gather, and those of its lanes that are plain: not special.
  struct Plain
  {
    Pack mass = 0.0, force_x = 0.0, force_y = 0.0;
    unsigned lanes = 0u;
  };

  /// Whether the dof nodes from `first` on belong to one deformable material and to nodes without condition, each in
  /// four cells that are runs of pure cells of that material.
  KOKKOS_FORCEINLINE_FUNCTION bool inRuns(int first) const
  {
    constexpr int lowest = std::numeric_limits<int>::min();
    int const node = node_of[first], material = material_of_dof[first];
    if (has_gravity || material < 0 || gather.materials[material].rigid_body >= 0)
      return false;
    if (anySet((loadNumbers(node_of + first) ^ countFrom(node, 1)) |
               (loadNumbers(material_of_dof + first) ^ countFrom(material, 0))))
      return false;
    int const *first_item = gather.first_item + node;
    LaneNumbers const conditioned = ~loadNumbers(node_condition + node) & countFrom(lowest, 0); // by their signs
    if (anySet(((loadNumbers(first_item + 1) - loadNumbers(first_item)) ^ countFrom(4, 0)) | conditioned))
      return false;
    int const *item = gather.item + *first_item;
    return cornersCountUp(item, 4) && inPureRuns(item, material);
  }

  KOKKOS_FORCEINLINE_FUNCTION bool inPureRuns(int const item[4], int material) const
  {
    LaneNumbers differs = {};
    for (int i = 0; i < 4; ++i)
    {
      int const *pair = gather.first_pair + (item[i] >> 2);
      differs |= loadNumbers(pair + 1) ^ countFrom(*pair + 1, 1);
    }
    if (anySet(differs))
      return false; // there may be no pairs to look at
    for (int i = 0; i < 4; ++i)
      differs |= loadNumbers(gather.material_of + gather.first_pair[item[i] >> 2]) ^ countFrom(material, 0);
    return !anySet(differs);
  }

  KOKKOS_FORCEINLINE_FUNCTION Plain gatherRuns(int first) const
  {
    Plain plain;
    plain.lanes = all_lanes;
    int const *item = gather.item + gather.first_item[node_of[first]];
    int const last = gather.first_pair[item[3] >> 2]; // of the cells that come first here
    readAhead(gather.corner_force, last);
    readAhead(gather.record, last);
    readAhead(velocity, first);
    readAhead(node_of, first);
    readAhead(material_of_dof, first);
    readAhead(node_condition, node_of[first]);
    readAhead(gather.first_item, node_of[first]);
    readAhead(gather.first_pair, item[3] >> 2);
    readAhead(gather.material_of, last);
    for (int line = 0; line < 4 * pack_width; line += 16)
      prefetchToRead(item + 4 * rows_ahead + line);
    for (int i = 0; i < 4; ++i)
    {
      int const pair = gather.first_pair[item[i] >> 2], corner = item[i] & 3;
      Pack x, y;
      loadPoints([&](int lane) { return gather.corner_force.row(pair + lane) + 2 * corner; }, x, y);
      Pack const mass = packOf([&](int lane) { return gather.record(pair + lane, Mass); });
      if (gather.about_axis)
        plain.mass = multiplyAdd(packOf([&](int lane) { return gather.fourShares((item[i] >> 2) + lane, corner); }),
                                 mass, plain.mass);
      else
        plain.mass += mass;
      plain.force_x += x;
      plain.force_y += y;
    }
    plain.mass = 0.25 * plain.mass;
    return plain;
  }

  /// The plain dof nodes of a pack one by one; the others are dealt with.
  KOKKOS_FORCEINLINE_FUNCTION Plain gatherLanes(int first, int count, Sums &sums) const
  {
    double mass[pack_width], force_x[pack_width], force_y[pack_width];
    Plain plain;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      mass[lane] = force_x[lane] = force_y[lane] = 0.0;
      if (lane >= count)
        continue;
      int const dof = first + lane, node = node_of[dof], material = material_of_dof[dof];
      Gathered const g = material >= 0 ? gather.ofMaterial(node, material) : gather.ofAll(node);
      if (has_gravity || g.held || node_condition[node] >= 0)
      {
        special(dof, g, accelerate(dof, g), sums);
        continue;
      }
      mass[lane] = g.mass;
      force_x[lane] = g.force[0];
      force_y[lane] = g.force[1];
      plain.lanes |= 1u << lane;
    }
    plain.mass = loadPack(mass);
    plain.force_x = loadPack(force_x);
    plain.force_y = loadPack(force_y);
    return plain;
  }

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int block, Sums &sums) const
  {
    int const first = begin + block * pack_width;
    int const count = Math::min(pack_width, end - first);
    Plain const plain = count == pack_width && inRuns(first) ? gatherRuns(first) : gatherLanes(first, count, sums);
    if (plain.lanes == 0u)
      return;
    Pack x, y;
    if (count == pack_width)
      loadPointRun(velocity.row(first), x, y);
    else
      loadPoints([&](int lane) { return velocity.row(Math::min(first + lane, end - 1)); }, x, y);
    auto const massive = plain.mass > Pack(0.0);
    Pack const per_mass = select(massive, Pack(1.0 / select(massive, plain.mass, Pack(1.0))), Pack(0.0));
    x = x + per_mass * (kick * plain.force_x);
    y = y + per_mass * (kick * plain.force_y);
    if (plain.lanes == all_lanes)
    {
      storePack(dof_mass + first, plain.mass);
      storePointRun(predicted.row(first), x, y);
      return;
    }
    for (int lane = 0; lane < count; ++lane)
      if ((plain.lanes >> lane & 1u) != 0u)
        store(first + lane, laneOf(plain.mass, lane), {laneOf(x, lane), laneOf(y, lane)});
  }
};

} // namespace

detail::NodeKernel detail::prediction(Mesh const &mesh, CellMaterialPairs const &pairs,
                                      NodeMaterialPairs const &dof_nodes, PairState const &state,
                                      BoundaryConditions const &boundary, View<Material *> const &materials,
                                      LagrangeOptions const &options, double kick, LagrangeWork &work)
{
  GatherCorners const gather{mesh.node_cell.offset.data(),
                             mesh.node_cell.item.data(),
                             pairs.offset.data(),
                             pairs.material.data(),
                             materials.data(),
                             state.record,
                             work.corner_force,
                             mesh.corner_share.part,
                             mesh.geometry == Geometry::Axisymmetric};
  Vector2 const gravity = options.gravity;
  PredictFunctor const whole{gather,
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
                             kick,
                             0,
                             0};
  return [whole](int begin, int end, PredictionSums &sums)
  {
    PredictFunctor part = whole;
    part.begin = begin;
    part.end = end;
    Sums of_part, all;
    Kokkos::parallel_reduce("Harmos::lagrange::predictVelocities", RangePolicy(0, numPacks(end - begin)), part,
                            JoinReducer<Sums>(of_part));
    static_cast<PredictionSums &>(all) = sums;
    all.join(of_part);
    sums = all;
  };
}

PredictionSums predictVelocities(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                                 PairState const &state, BoundaryConditions const &boundary,
                                 View<Material *> const &materials, LagrangeOptions const &options, double kick,
                                 LagrangeWork &work)
{
  PredictionSums sums;
  detail::prediction(mesh, pairs, dof_nodes, state, boundary, materials, options, kick,
                     work)(0, dof_nodes.num_dof_nodes, sums);
  return sums;
}

PredictionSums computeForcesAndPredict(Mesh const &mesh, CellMaterialPairs const &pairs,
                                       NodeMaterialPairs const &dof_nodes, PairState const &state,
                                       BoundaryConditions const &boundary, View<Material *> const &materials,
                                       LagrangeOptions const &options, double kick, LagrangeWork &work)
{
  auto const forces = detail::cornerForces(mesh, pairs, state, materials, options, work);
  auto const predict = detail::prediction(mesh, pairs, dof_nodes, state, boundary, materials, options, kick, work);
  bool const on_host = std::is_same<MemorySpace, Kokkos::HostSpace>::value;
  int const piece = on_host ? cells_at_once * ExecutionSpace().concurrency() : Math::max(mesh.num_cells, 1);
  if (work.pieces.of.data() != mesh.node_cell.offset.data() || work.pieces.cells != piece)
    work.pieces = {mesh.node_cell.offset, piece, nodeEnds(mesh, piece)};
  PredictionSums sums;
  int pair = 0, dof = 0;
  int const count = static_cast<int>(work.pieces.node_end.size());
  for (int t = 0; t < count; ++t)
  {
    bool const last = t + 1 == count;
    int const pair_end = last ? pairs.num_pairs : pairs.offset((t + 1) * piece);
    int const dof_end = last ? dof_nodes.num_dof_nodes : dof_nodes.offset(work.pieces.node_end[t]);
    forces(pair, pair_end);
    predict(dof, dof_end, sums);
    pair = pair_end;
    dof = dof_end;
  }
  return sums;
}

} // namespace Harmos
