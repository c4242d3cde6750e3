// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Totals.hpp"

#include <Harmos_CellVoid.hpp>
#include <Harmos_Failure.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{
namespace
{

/// sum m |v| and sum m |x| |v| over the corners of the owned deformable pairs, and the number of owned pairs, mixed
/// ones last.
struct PairCounts
{
  double speed_momentum, moment;
  long long pairs, mixed;
};

PairCounts countPairs(Scene const &scene, CycleState const &s)
{
  auto const mesh = scene.mesh;
  auto const pairs = s.pairs;
  auto const record = s.state.record;
  auto const velocity = s.state.velocity;
  auto const materials = scene.materials;
  PairCounts counts{};
  Kokkos::parallel_reduce(
      "Harmos::countPairs", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, double &speed, double &moment, long long &owned, long long &mixed) {
        int const cell = pairs.cell(pair);
        if (mesh.cell_depth(cell) != 0)
          return;
        ++owned;
        mixed += pairs.cell_kind(cell) == MixedCell ? 1 : 0;
        if (materials(pairs.material(pair)).rigid_body >= 0)
          return;
        for (int k = 0; k < 4; ++k)
        {
          int const dof = pairs.dof_node(pair, k), node = mesh.cell_node(cell, k);
          double const part =
              mesh.corner_share(cell, k) * record(pair, Mass) * norm(Vector2{velocity(dof, 0), velocity(dof, 1)});
          speed += part;
          moment += part * norm(Vector2{mesh.node_position(node, 0), mesh.node_position(node, 1)});
        }
      },
      counts.speed_momentum, counts.moment, counts.pairs, counts.mixed);
  return counts;
}

/// Volume fraction below which a piece does not count in the extents: a film that a contact has pressed into the next
/// cell by its tolerance would reach across that cell.
constexpr double film = 1e-6;

/// Lower the least x, -x, y, -y of a pair's filled region.
KOKKOS_INLINE_FUNCTION void lowerExtents(Mesh const &mesh, CellMaterialPairs const &pairs, FilledRegions const &regions,
                                         int pair, double *least)
{
  auto const lower = [least](Vector2 const &x)
  {
    for (int side = 0; side < 4; ++side)
      least[side] = Math::min(least[side], side % 2 == 0 ? x[side / 2] : -x[side / 2]);
  };
  int const cell = pairs.cell(pair), first = regions.cell_region(cell);
  if (first < 0)
  {
    Quadrilateral const corners = cellQuadrilateral(mesh, cell);
    for (int k = 0; k < 4; ++k)
      lower(corners[k]);
    return;
  }
  Region const &region = regions.polygon(first + pair - pairs.offset(cell));
  for (int i = 0; i < region.size; ++i)
    lower(region[i]);
}

/// Least and greatest coordinates of the filled regions of all ranks: x_min, x_max, y_min, y_max by material.
std::vector<double> extents(Scene const &scene, CycleState const &s, FilledRegions const &regions, int num_materials)
{
  constexpr double none = 1e300;
  auto const mesh = scene.mesh;
  auto const pairs = s.pairs;
  auto const record = s.state.record;
  int const chunk = std::max(256, pairs.num_pairs / 4096 + 1), num_chunks = (pairs.num_pairs + chunk - 1) / chunk;
  View<double **[4]> const partial(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::extents"), num_chunks,
                                   num_materials);
  Kokkos::parallel_for(
      "Harmos::extents", RangePolicy(0, num_chunks), KOKKOS_LAMBDA(int c) {
        for (int i = 0; i < 4 * num_materials; ++i)
          partial(c, i / 4, i % 4) = none;
        for (int pair = c * chunk; pair < Math::min((c + 1) * chunk, pairs.num_pairs); ++pair)
        {
          int const m = pairs.material(pair);
          if (m < num_materials && mesh.cell_depth(pairs.cell(pair)) == 0 && !(record(pair, VolumeFraction) < film))
            lowerExtents(mesh, pairs, regions, pair, &partial(c, m, 0));
        }
      });
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), partial);
  std::vector<double> result;
  for (int m = 0; m < num_materials; ++m)
    for (int side = 0; side < 4; ++side)
    {
      double least = none;
      for (int c = 0; c < num_chunks; ++c)
        least = std::min(least, host(c, m, side));
      double const all = scene.exchange->min(least);
      result.push_back(all == none ? 0.0 : (side % 2 == 0 ? all : -all));
    }
  return result;
}

/// Mass of this rank's failed pairs of one material.
double failedMass(Scene const &scene, CycleState const &s, int material)
{
  if (!s.state.tracks_damage)
    return 0.0;
  auto const mesh = scene.mesh;
  auto const pairs = s.pairs;
  auto const state = s.state;
  auto const materials = scene.materials;
  double sum = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::failedMass", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, double &part) {
        int const cell = pairs.cell(pair);
        if (pairs.material(pair) == material && mesh.cell_depth(cell) == 0 &&
            isFailed(materials(material), state.damage(pair), isOpen(pairs, state.record, cell)))
          part += state.record(pair, Mass);
      },
      sum);
  return sum;
}

} // namespace

long long countOwnedPairs(Exchange const &exchange, Mesh const &mesh, CellMaterialPairs const &pairs)
{
  auto const halo = exchange.haloCells(mesh.halo).received;
  auto const offset = pairs.offset;
  long long others = 0;
  Kokkos::parallel_reduce(
      "Harmos::countHaloPairs", RangePolicy(0, static_cast<int>(halo.extent(0))),
      KOKKOS_LAMBDA(int i, long long &part) { part += offset(halo(i) + 1) - offset(halo(i)); }, others);
  return pairs.num_pairs - others;
}

Totals computeTotals(Scene const &scene, CycleState const &s, int num_materials, bool with_extents)
{
  int const all_materials = static_cast<int>(scene.materials.extent(0));
  MaterialSums const sums = materialSums(scene.mesh, s.pairs, s.state.record, s.state.velocity, all_materials);
  PairCounts const counts = countPairs(scene, s);

  std::vector<double> flat;
  for (int m = 0; m < all_materials; ++m)
    for (int i = 0; i < PlasticStrainMax; ++i)
      flat.push_back(sums(m, i));
  for (int m = 0; m < num_materials; ++m)
    flat.push_back(failedMass(scene, s, m));
  flat.push_back(counts.speed_momentum);
  flat.push_back(counts.moment);
  scene.exchange->sum(flat.data(), static_cast<int>(flat.size()));
  long long whole[2] = {counts.pairs, counts.mixed};
  scene.exchange->sum(whole, 2);

  Totals totals;
  totals.pairs = whole[0];
  totals.pairs_mixed = whole[1];
  totals.speed_momentum = flat[flat.size() - 2];
  totals.moment = flat.back();
  totals.material.resize(num_materials);
  std::vector<int> body_of(all_materials, -1);
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    body_of[s.bodies[b].material] = static_cast<int>(b);

  for (int m = 0; m < all_materials; ++m)
  {
    double const *sum = flat.data() + PlasticStrainMax * m;
    HistoryMaterial row;
    row.mass = sum[SumMass];
    row.volume = sum[SumVolume];
    row.momentum_x = sum[SumMomentumX];
    row.momentum_y = sum[SumMomentumY];
    row.kinetic_energy = sum[SumKineticEnergy];
    row.internal_energy = sum[SumInternalEnergy];
    row.plastic_strain_max = scene.exchange->max(sums(m, PlasticStrainMax));
    double angular = sum[SumAngularMomentum];
    bool counted = true;
    if (body_of[m] >= 0)
    {
      RigidBody const &body = s.bodies[body_of[m]];
      counted = body.motion == RigidMotion::Free;
      if (counted)
      {
        row.mass = body.mass;
        row.momentum_x = body.mass * body.velocity[0];
        row.momentum_y = body.mass * body.velocity[1];
        row.kinetic_energy = 0.5 * body.mass * dot(body.velocity, body.velocity) +
                             0.5 * body.inertia * body.angular_velocity * body.angular_velocity;
        angular = body.mass * cross(body.centre, body.velocity) + body.inertia * body.angular_velocity;
        totals.speed_momentum += body.mass * norm(body.velocity);
        totals.moment +=
            body.mass * norm(body.centre) * norm(body.velocity) + body.inertia * std::fabs(body.angular_velocity);
      }
    }
    if (counted)
    {
      totals.mass += row.mass;
      totals.momentum_x += row.momentum_x;
      totals.momentum_y += row.momentum_y;
      // rings turn about no axis that the plane shows
      totals.angular_momentum += scene.mesh.geometry == Geometry::Planar ? angular : 0.0;
      totals.kinetic_energy += row.kinetic_energy;
      totals.internal_energy += row.internal_energy;
    }
    if (m < num_materials)
    {
      row.failed_mass = flat[PlasticStrainMax * all_materials + m];
      totals.material[m] = row;
    }
  }

  if (with_extents)
  {
    std::vector<double> const extent = extents(scene, s, s.regions, num_materials);
    for (int m = 0; m < num_materials; ++m)
    {
      totals.material[m].x_min = extent[4 * m];
      totals.material[m].x_max = extent[4 * m + 1];
      totals.material[m].y_min = extent[4 * m + 2];
      totals.material[m].y_max = extent[4 * m + 3];
    }
  }
  return totals;
}

} // namespace Harmos
