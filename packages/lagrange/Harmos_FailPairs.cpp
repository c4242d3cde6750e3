// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <Harmos_CellVoid.hpp>
#include <Harmos_Failure.hpp>

namespace Harmos
{
namespace
{

/// A pure cell opens when its void is this part of it: round-off in a failed cell's pressure makes no void.
constexpr double least_opening = 1e-6;

/// Volume fraction and specific volume.
struct Filling
{
  double fraction, specific_volume;
};

/// What void does to a failed pair that the update has strained from sv_n to `strained`.
///
/// The part `bearing` of the strain met its pressure and changes its volume, sv' = sv_n (sv / sv_n)^bearing; void takes
/// the rest. Where that leaves tension the pair shrinks to the volume without pressure, the rest is void. A cell that
/// has void is filled by what the pair's mass takes up, f' = m sv' / V', as far as others leave room: its outline
/// would come apart from that, since it moves with the nodes of its own corner of the cell and is cut where others
/// overlap it, and what is cut off would leave void that is none.
/// \param mass_per_volume m over the volume V' of the moved cell. \param most What others leave of it. \param open The
/// cell has void.
KOKKOS_INLINE_FUNCTION Filling failedFilling(Material const &m, Filling const &strained, double energy, double sv_n,
                                             double bearing, double mass_per_volume, double most, bool open)
{
  double sv = strained.specific_volume;
  if (bearing < 1.0)
    sv = bearing > 0.0 ? sv_n * Math::pow(sv / sv_n, bearing) : sv_n;
  double const unstressed = equationOfState(m, sv, energy).pressure >= 0.0 ? sv : unstressedVolume(m, sv, energy);
  if (open)
    return {Math::min(mass_per_volume * unstressed, most), unstressed};
  Filling const opened = {strained.fraction * (unstressed / sv), unstressed};
  return strained.fraction - opened.fraction < least_opening ? strained : opened;
}

struct FailFunctor
{
  Mesh mesh;
  CellMaterialPairs pairs;
  PairState state;
  View<Material *> materials;
  View<double *[3]> before;
  double dt;

  KOKKOS_INLINE_FUNCTION double othersOf(int cell, int pair) const
  {
    double sum = 0.0;
    for (int other = pairs.offset(cell); other < pairs.offset(cell + 1); ++other)
      sum += other == pair ? 0.0 : state.record(other, VolumeFraction);
    return sum;
  }

  /// \return Whether the pair has failed in this step.
  KOKKOS_INLINE_FUNCTION bool damagePair(int pair, Material const &m, bool open) const
  {
    auto const &record = state.record;
    double const damage = state.damage(pair);
    if (isFailed(m, damage, open))
      return false;
    FailureState const now = {record(pair, SpecificVolume),
                              record(pair, InternalEnergy),
                              {record(pair, DeviatorXX), record(pair, DeviatorYY), record(pair, DeviatorXY)},
                              record(pair, PlasticStrain) - before(pair, BeforePlasticStrain)};
    state.damage(pair) = damageAfter(m, now, damage, dt);
    return isFailed(m, state.damage(pair), open);
  }

  KOKKOS_INLINE_FUNCTION void relax(int cell, int pair, Material const &m, bool is_new, bool open) const
  {
    auto const &record = state.record;
    record(pair, DeviatorXX) = record(pair, DeviatorYY) = record(pair, DeviatorXY) = 0.0;
    if (!is_new)
      record(pair, PlasticStrain) = before(pair, BeforePlasticStrain);
    Filling const strained = {record(pair, VolumeFraction), record(pair, SpecificVolume)};
    double const sv_n = before(pair, BeforeSpecificVolume);
    double const moved_volume = mesh.cell_volume(cell) * (strained.specific_volume / sv_n);
    Filling const next = failedFilling(m, strained, record(pair, InternalEnergy), sv_n, before(pair, BeforeBearing),
                                       record(pair, Mass) / moved_volume, 1.0 - othersOf(cell, pair), open);
    record(pair, VolumeFraction) = next.fraction;
    record(pair, SpecificVolume) = next.specific_volume;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int cell, long long &failed, long long &moved) const
  {
    bool const open = isOpen(pairs, state.record, cell);
    for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
    {
      Material const &m = materials(pairs.material(pair));
      if (!canFail(m))
        continue;
      bool const is_new = damagePair(pair, m, open);
      failed += is_new && mesh.cell_depth(cell) == 0 ? 1 : 0;
      if (!isFailed(m, state.damage(pair), open))
        continue;
      double const fraction = state.record(pair, VolumeFraction);
      relax(cell, pair, m, is_new, open);
      moved += state.record(pair, VolumeFraction) != fraction ? 1 : 0;
    }
  }
};

/// Kinds after fractions have changed; in a view of their own where some do, since others keep the old one. A cell that
/// was pure gives its pair the cell's centroid. Those that stay pure keep theirs: whether fractions change elsewhere is
/// not known on all ranks.
void updateCellKinds(Mesh const &mesh, PairState const &state, CellMaterialPairs &pairs)
{
  View<int *> const kind("Harmos::lagrange::cell_kind", mesh.num_cells);
  CellMaterialPairs const p = pairs;
  auto const record = state.record;
  auto const centroid = state.centroid;
  int changed = 0;
  Kokkos::parallel_reduce(
      "Harmos::lagrange::updateCellKinds", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum) {
        int const before = p.cell_kind(cell);
        kind(cell) = cellKind(p, record, cell);
        if (kind(cell) == before)
          return;
        ++sum;
        if (before != PureCell)
          return;
        Vector2 const x = volumeCentroid(cellQuadrilateral(mesh, cell), mesh.geometry);
        centroid(p.offset(cell), 0) = x[0];
        centroid(p.offset(cell), 1) = x[1];
      },
      changed);
  if (changed > 0)
    pairs.cell_kind = kind;
}

} // namespace

void keepForFailure(CellMaterialPairs const &pairs, PairState const &state, LagrangeWork &work)
{
  if (!state.tracks_damage)
    return;
  auto const before = work.before;
  auto const record = state.record;
  Kokkos::parallel_for(
      "Harmos::lagrange::keepForFailure", RangePolicy(0, pairs.num_pairs), KOKKOS_LAMBDA(int pair) {
        before(pair, BeforeSpecificVolume) = record(pair, SpecificVolume);
        before(pair, BeforePlasticStrain) = record(pair, PlasticStrain);
      });
}

FailureReport failPairs(Mesh const &mesh, Kinematics kinematics, CellMaterialPairs &pairs, PairState const &state,
                        View<Material *> const &materials, double dt, LagrangeWork const &work)
{
  FailureReport report;
  if (!state.tracks_damage)
    return report;
  long long moved = 0;
  Kokkos::parallel_reduce("Harmos::lagrange::failPairs", RangePolicy(0, mesh.num_cells),
                          FailFunctor{mesh, pairs, state, materials, work.before, dt}, report.failed, moved);
  // The void of a body-fitted cell stays inside of it.
  report.fractions_changed = moved > 0 && kinematics != Kinematics::Lagrangian;
  if (report.fractions_changed)
    updateCellKinds(mesh, state, pairs);
  return report;
}

} // namespace Harmos
