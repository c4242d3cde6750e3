// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <Harmos_JoinReducer.hpp>
#include <Harmos_Select.hpp>
#include <Harmos_SharedNodes.hpp>
#include <detail/Harmos_PairAccess.hpp>

namespace Harmos
{
namespace
{

constexpr double largest_part_of_altitude = 0.9;
/// dt |v - mean of the pair| of a light dof node over its altitude. What is caught between two heavy bodies is squeezed
/// at their speed over its own thickness; in nodes a whole cell apart that is their speed times cell over thickness.
constexpr double largest_light_strain = 0.25;
constexpr double density_range = 10.0; // of what a first look takes for light

/// Velocities that change, everything by gathering: no dof node writes another's.
struct SlowLight
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  View<Material *> materials;
  BoundaryConditions boundary;
  View<double *[num_pair_fields]> record;
  View<double *> dof_mass;
  View<double *[2]> half;
  View<double *> altitude;
  View<int *> slowed_with; // dof nodes: the pair whose mean velocity a slowed one takes, else -1
  double dt;
  double light_node;
  double largest_cell = 0.0;           // volume
  View<double *> largest_density = {}; // LagrangeWork::largest_density

  KOKKOS_INLINE_FUNCTION Vector2 velocity(int dof) const { return {half(dof, 0), half(dof, 1)}; }

  /// The part of a change of velocity that conditions and rigid materials leave to a dof node.
  KOKKOS_INLINE_FUNCTION Vector2 project(int dof, Vector2 const &change) const
  {
    auto const is_rigid = [this](int material) { return materials(material).rigid_body >= 0; };
    if (movedByARigidOne(mesh, pairs, dof_nodes, dof, is_rigid))
      return {0.0, 0.0};
    int const condition = boundary.node_index(dof_nodes.node(dof));
    return condition < 0 ? change : boundary.condition(condition).project(change);
  }

  /// Mass of a volume below which a dof node may be light there. [mass/volume]
  KOKKOS_INLINE_FUNCTION double lightDensity(int material) const
  {
    double const density = largest_density.extent(0) > 0 ? largest_density(material) : materials(material).density0;
    return density_range * light_node * density;
  }

  /// What is not lighter is not light in any cell.
  KOKKOS_INLINE_FUNCTION double lightMass(int material) const { return largest_cell * lightDensity(material); }

  /// A first look, which lets all light dof nodes of one deformable material pass.
  KOKKOS_INLINE_FUNCTION bool mayBeLight(int dof) const
  {
    int const own = dof_nodes.material(dof);
    if (own < 0 || materials(own).rigid_body >= 0)
      return false;
    double const mass_of_volume = lightDensity(own);
    if (dof_mass(dof) >= lightMass(own)) // no division where none is light
      return false;
    int const node = dof_nodes.node(dof);
    double const volume = dof_mass(dof) / mass_of_volume;
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      if (volume < mesh.cell_volume(mesh.node_cell.item(i) / 4))
        return true;
    }
    return false;
  }

  KOKKOS_INLINE_FUNCTION bool outruns(int dof, Vector2 const &velocity, double part) const
  {
    double const limit = part * altitude(dof_nodes.node(dof));
    return dt * dt * dot(velocity, velocity) > limit * limit;
  }

  KOKKOS_INLINE_FUNCTION Vector2 plainMean(int pair) const
  {
    Vector2 momentum{0.0, 0.0};
    double mass = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      int const dof = pairs.dof_node(pair, k);
      momentum += dof_mass(dof) * velocity(dof);
      mass += dof_mass(dof);
    }
    return (1.0 / mass) * momentum;
  }

  /// The heaviest of the pairs around a dof node that it belongs to and `counts`, or -1. Ties: the first; -2: a rigid
  /// one.
  template <class Counts>
  KOKKOS_INLINE_FUNCTION int heaviestPair(int dof, Counts const &counts) const
  {
    int const node = dof_nodes.node(dof);
    int const own = dof_nodes.material(dof);
    int best = -1;
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const cell = mesh.node_cell.item(i) / 4;
      for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      {
        if (own >= 0 && pairs.material(pair) != own)
          continue;
        if (materials(pairs.material(pair)).rigid_body >= 0)
          return -2;
        if (counts(pair) && (best < 0 || record(pair, Mass) > record(best, Mass)))
          best = pair;
      }
    }
    return best;
  }

  /// The heaviest pair around a dof node that is light, else -1.
  KOKKOS_INLINE_FUNCTION int pairOfLight(int dof) const
  {
    int const best = heaviestPair(dof, [](int) { return true; });
    if (best < 0)
      return -1;
    double const full = mesh.cell_volume(pairs.cell(best)) / record(best, SpecificVolume);
    return dof_mass(dof) < light_node * full ? best : -1;
  }

  /// That pair, where the light dof node travels too far or strains it too much, else -1.
  KOKKOS_INLINE_FUNCTION int pairOfOffender(int dof) const
  {
    bool const fast = outruns(dof, velocity(dof), largest_part_of_altitude);
    if (!fast && !mayBeLight(dof))
      return -1;
    int const best = pairOfLight(dof);
    return best >= 0 && (fast || outruns(dof, velocity(dof) - plainMean(best), largest_light_strain)) ? best : -1;
  }

  /// A light dof node beside an offender goes with it: left free it would bear the momentum of nodes that outweigh it.
  KOKKOS_INLINE_FUNCTION int pairOfCompanion(int dof) const
  {
    if (slowed_with(dof) >= 0)
      return slowed_with(dof);
    int const best = heaviestPair(dof, [this](int pair) { return slowsAny(pair); });
    return best >= 0 && pairOfLight(dof) >= 0 ? best : -1;
  }

  struct PairMean
  {
    Vector2 velocity = {0.0, 0.0}; // over its free nodes and those slowed with it
    Vector2 surplus = {0.0, 0.0};  // momentum that slowing takes from the slowed ones
    double free_mass = 0.0;        // of the nodes that are not slowed
  };

  KOKKOS_INLINE_FUNCTION PairMean pairMean(int pair) const
  {
    PairMean mean;
    double mass = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      int const dof = pairs.dof_node(pair, k);
      if (slowed_with(dof) >= 0 && slowed_with(dof) != pair)
        continue;
      mean.velocity += dof_mass(dof) * velocity(dof);
      mass += dof_mass(dof);
      if (slowed_with(dof) < 0)
        mean.free_mass += dof_mass(dof);
    }
    mean.velocity *= mass > 0.0 ? 1.0 / mass : 0.0;
    for (int k = 0; k < 4; ++k)
    {
      int const dof = pairs.dof_node(pair, k);
      if (slowed_with(dof) == pair)
        mean.surplus += dof_mass(dof) * project(dof, velocity(dof) - mean.velocity);
    }
    return mean;
  }

  /// The change of velocity that a dof node takes, before its node condition.
  KOKKOS_INLINE_FUNCTION Vector2 change(int dof) const
  {
    if (slowed_with(dof) >= 0)
      return pairMean(slowed_with(dof)).velocity - velocity(dof);
    Vector2 sum{0.0, 0.0};
    int const node = dof_nodes.node(dof);
    int const own = dof_nodes.material(dof);
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const cell = mesh.node_cell.item(i) / 4;
      for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      {
        if ((own >= 0 && pairs.material(pair) != own) || !slowsAny(pair))
          continue;
        PairMean const mean = pairMean(pair);
        if (mean.free_mass > 0.0)
          sum += (1.0 / mean.free_mass) * mean.surplus;
      }
    }
    return sum;
  }

  KOKKOS_INLINE_FUNCTION bool slowsAny(int pair) const
  {
    bool slows = false;
    for (int k = 0; k < 4; ++k)
      slows = slows || slowed_with(pairs.dof_node(pair, k)) == pair;
    return slows;
  }
};

/// Largest (dt |v| / (0.9 altitude))^2: of all local dof nodes, and of the owned ones. The outermost halo lacks forces,
/// so that only the latter may steer; but every rank slows its copies of the others.
struct Crossing
{
  long long light = 0; // dof nodes to be slowed
  double local = 0.0;
  double owned = 0.0;

  KOKKOS_INLINE_FUNCTION void join(Crossing const &other)
  {
    light += other.light;
    local = Math::max(local, other.local);
    owned = Math::max(owned, other.owned);
  }
};

/// Looks at dof nodes in packs, and closer at those of a pack in which one may be light or travel furthest so far.
struct CrossingFunctor
{
  SlowLight slow;
  int const *node_of, *material_of;
  double const *mass, *altitude;
  RowPointer<double, 2> half;
  int count;

  KOKKOS_INLINE_FUNCTION void look(int dof, Crossing &largest) const
  {
    int const node = slow.dof_nodes.node(dof);
    double const limit = largest_part_of_altitude * slow.altitude(node);
    Vector2 const v = slow.velocity(dof);
    double const travel2 = slow.dt * slow.dt * dot(v, v);
    if (travel2 > limit * limit || slow.mayBeLight(dof))
      largest.light += slow.pairOfOffender(dof) >= 0;
    if (travel2 <= largest.owned * (limit * limit))
      return;
    double const squared = travel2 / (limit * limit);
    largest.local = Math::max(largest.local, squared);
    if (slow.mesh.node_owned(node))
      largest.owned = Math::max(largest.owned, squared);
  }

  /// Whether `look` would find nothing; in doubt, by round-off or because materials differ, not.
  KOKKOS_FORCEINLINE_FUNCTION bool passes(int first, double owned) const
  {
    constexpr double margin = 1.0 + 1e-12;
    int const material = material_of[first];
    if (anySet(loadNumbers(material_of + first) ^ countFrom(material, 0)))
      return false;
    Pack x, y;
    loadPointRun(half.row(first), x, y);
    Pack const limit = largest_part_of_altitude *
                       (countsUp(node_of + first) ? loadPack(altitude + node_of[first])
                                                  : packOf([&](int lane) { return altitude[node_of[first + lane]]; }));
    Pack const travel2 = (margin * slow.dt * slow.dt) * (x * x + y * y);
    if (any(no(travel2 <= Math::min(owned, 1.0) * (limit * limit))))
      return false;
    bool const deformable = material >= 0 && slow.materials(material).rigid_body < 0;
    return !deformable || !any(loadPack(mass + first) < Pack(margin * slow.lightMass(material)));
  }

  KOKKOS_INLINE_FUNCTION void operator()(int block, Crossing &largest) const
  {
    int const first = block * pack_width;
    if (first + pack_width <= count && passes(first, largest.owned))
      return;
    for (int dof = first; dof < count && dof < first + pack_width; ++dof)
      look(dof, largest);
  }
};

Crossing largestCrossing(SlowLight const &slow)
{
  int const count = slow.dof_nodes.num_dof_nodes;
  CrossingFunctor const crossing{slow,
                                 slow.dof_nodes.node.data(),
                                 slow.dof_nodes.material.data(),
                                 slow.dof_mass.data(),
                                 slow.altitude.data(),
                                 slow.half,
                                 count};
  Crossing result;
  Kokkos::parallel_reduce("Harmos::lagrange::largestCrossing", RangePolicy(0, numPacks(count)), crossing,
                          JoinReducer<Crossing>(result));
  return result;
}

struct SlowSums : TravelReport
{
  KOKKOS_INLINE_FUNCTION void join(SlowSums const &other)
  {
    limited += other.limited;
    wall_impulse += other.wall_impulse;
    energy_loss += other.energy_loss;
  }
};

/// Slow the marked dof nodes; sums over owned nodes.
SlowSums slowMarked(SlowLight const &slow, View<double *[2]> const &initial, LagrangeWork &work)
{
  int const count = slow.dof_nodes.num_dof_nodes;
  View<double *[2]> const changed("Harmos::lagrange::changed", work.half.extent(0));
  auto const predicted = work.predicted;
  SlowSums result;
  Kokkos::parallel_reduce(
      "Harmos::lagrange::slowLight", RangePolicy(0, count),
      KOKKOS_LAMBDA(int dof, SlowSums &sums) {
        Vector2 const before = slow.velocity(dof);
        Vector2 const wanted = slow.change(dof);
        Vector2 const change = slow.project(dof, wanted);
        Vector2 const after = before + change;
        changed(dof, 0) = after[0];
        changed(dof, 1) = after[1];
        bool const slowed = slow.slowed_with(dof) >= 0;
        if (!slow.mesh.node_owned(slow.dof_nodes.node(dof)) || !(slowed || dot(wanted, wanted) > 0.0))
          return;
        double const mass = slow.dof_mass(dof);
        // what other impulses did at this node counted half the old velocity: half their change belongs here
        Vector2 const other{before[0] - predicted(dof, 0), before[1] - predicted(dof, 1)};
        Vector2 const sum{initial(dof, 0) + after[0], initial(dof, 1) + after[1]};
        sums.energy_loss -= 0.5 * mass * (dot(change, sum) + dot(other, change));
        sums.limited += slowed;
        // what a wall keeps a slowed node from taking is left to the pair's free ones; without those the wall takes it
        if (!slowed || !(slow.pairMean(slow.slowed_with(dof)).free_mass > 0.0))
          sums.wall_impulse += mass * (change - wanted);
      },
      JoinReducer<SlowSums>(result));
  Kokkos::deep_copy(work.half, changed);
  return result;
}

/// Below this ratio (dt |v| of a quarter of an altitude) no cell folds: its corners are half an altitude at least from
/// the line through both beside them, and both sides go.
constexpr double least_folding_ratio = 0.25 / largest_part_of_altitude;

/// The ratio, or two where the step would fold an owned deformable pair's cell, so that it is repeated with half.
double withFolding(double ratio, SlowLight const &slow)
{
  if (ratio <= least_folding_ratio)
    return ratio;
  long long folded = 0;
  Kokkos::parallel_reduce(
      "Harmos::lagrange::withFolding", RangePolicy(0, slow.pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, long long &count) {
        int const cell = slow.pairs.cell(pair);
        if (slow.mesh.cell_depth(cell) != 0 || slow.materials(slow.pairs.material(pair)).rigid_body >= 0)
          return;
        auto const v = detail::cornerVelocities(slow.pairs, slow.half, pair);
        auto const moved = detail::moved(detail::cellCorners(slow.mesh, cell), slow.dt, v);
        count += !(detail::leastCornerArea(moved) > 0.0);
      },
      folded);
  return folded > 0 ? Math::max(ratio, 2.0) : ratio;
}

} // namespace

TravelReport limitTravel(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                         PairState const &state, BoundaryConditions const &boundary, View<Material *> const &materials,
                         LagrangeOptions const &options, double dt, LagrangeWork &work)
{
  TravelReport report;
  SlowLight slow{mesh,          pairs,     dof_nodes,          materials, boundary, state.record,
                 work.dof_mass, work.half, work.node_altitude, {},        dt,       options.light_node};
  slow.largest_cell = work.largest_cell;
  slow.largest_density = work.largest_density;
  Crossing const crossing = largestCrossing(slow);
  if (crossing.light == 0)
  {
    report.largest_ratio = withFolding(std::sqrt(crossing.owned), slow);
    return report;
  }
  int const count = dof_nodes.num_dof_nodes;
  View<int *> const offender("Harmos::lagrange::offender", count), slowed("Harmos::lagrange::slowed", count);
  Kokkos::parallel_for(
      "Harmos::lagrange::markOffenders", RangePolicy(0, count),
      KOKKOS_LAMBDA(int dof) { offender(dof) = slow.pairOfOffender(dof); });
  slow.slowed_with = offender;
  Kokkos::parallel_for(
      "Harmos::lagrange::markCompanions", RangePolicy(0, count),
      KOKKOS_LAMBDA(int dof) { slowed(dof) = slow.pairOfCompanion(dof); });
  slow.slowed_with = slowed;
  report = slowMarked(slow, state.velocity, work);
  report.largest_ratio = withFolding(std::sqrt(largestCrossing(slow).owned), slow);
  return report;
}

} // namespace Harmos
