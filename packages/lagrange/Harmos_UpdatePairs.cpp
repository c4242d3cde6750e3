// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <detail/Harmos_JoinReducer.hpp>
#include <detail/Harmos_PairAccess.hpp>

#include <limits>

namespace Harmos
{
namespace
{

struct UpdateSums
{
  detail::LargestRate largest;
  long long inverted = 0;
  long long not_a_number = 0;
  long long out_of_range = 0;
  int first_pair = -1;

  KOKKOS_INLINE_FUNCTION void trouble(int pair) { first_pair = first_pair < 0 ? pair : Math::min(first_pair, pair); }
  KOKKOS_INLINE_FUNCTION void join(UpdateSums const &other)
  {
    largest.join(other.largest);
    inverted += other.inverted;
    not_a_number += other.not_a_number;
    out_of_range += other.out_of_range;
    if (other.first_pair >= 0)
      trouble(other.first_pair);
  }
};

int valueAt(View<int *> const &view, int index)
{
  int value = -1;
  Kokkos::deep_copy(value, Kokkos::subview(view, index));
  return value;
}

TimeStepLimit limitFrom(detail::LargestRate const &largest, CellMaterialPairs const &pairs)
{
  if (largest.index < 0)
    return {std::numeric_limits<double>::infinity(), -1, -1};
  return {1.0 / largest.rate, valueAt(pairs.cell, largest.index), valueAt(pairs.material, largest.index)};
}

/// - sum_I f_I . v_mean_I, the power of the nodes on the pair.
KOKKOS_INLINE_FUNCTION double cornerPower(View<double *[8]> const &corner_force, int pair,
                                          detail::Corners<double> const &before, detail::Corners<double> const &half)
{
  double sum = 0.0;
  for (int k = 0; k < 4; ++k)
    sum += corner_force(pair, 2 * k) * (before.x[k] + half.x[k]) +
           corner_force(pair, 2 * k + 1) * (before.y[k] + half.y[k]);
  return -0.5 * sum;
}

/// x - x is not 0 for infinities and NaN.
KOKKOS_INLINE_FUNCTION bool isFinite(detail::PairRecord<double> const &r)
{
  double const all = r.internal_energy + r.plastic_strain + r.deviator.xx + r.deviator.yy + r.deviator.xy;
  return r.specific_volume > 0.0 && r.specific_volume - r.specific_volume == 0.0 && all - all == 0.0;
}

KOKKOS_INLINE_FUNCTION void storeRecord(View<double *[num_pair_fields]> const &record, int pair,
                                        detail::PairRecord<double> const &r)
{
  record(pair, SpecificVolume) = r.specific_volume;
  record(pair, InternalEnergy) = r.internal_energy;
  record(pair, PlasticStrain) = r.plastic_strain;
  record(pair, DeviatorXX) = r.deviator.xx;
  record(pair, DeviatorYY) = r.deviator.yy;
  record(pair, DeviatorXY) = r.deviator.xy;
}

} // namespace

UpdateReport updatePairs(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                         View<Material *> const &materials, LagrangeOptions const &options, double dt,
                         LagrangeWork const &work, TimeStepLimit &next)
{
  auto const record = state.record;
  auto const velocity = state.velocity;
  auto const half = work.half;
  auto const dof_mass = work.dof_mass;
  auto const corner_force = work.corner_force;
  detail::StepLimits const limits(options);
  UpdateSums result;
  Kokkos::parallel_reduce(
      "Harmos::lagrange::updatePairs", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, UpdateSums &sums) {
        Material const &material = materials(pairs.material(pair));
        int const cell = pairs.cell(pair);
        bool const owned = mesh.cell_depth(cell) == 0;
        auto const x = detail::cellCorners(mesh, cell);
        auto const v = detail::cornerVelocities(pairs, half, pair);
        if (material.rigid_body >= 0)
        {
          if (owned)
            sums.largest.include(detail::rigidPairRate(limits, x, v), pair);
          return;
        }
        double const power = cornerPower(corner_force, pair, detail::cornerVelocities(pairs, velocity, pair), v);
        auto const updated = detail::updatePair(material, detail::loadRecord(record, pair), x, v, power, dt);
        auto const &r = updated.record;
        storeRecord(record, pair, r);
        if (!owned)
          return;
        double const acoustic =
            detail::acousticRate(material, options, updated.geometry, r.specific_volume, r.internal_energy);
        sums.largest.include(
            detail::pairRate(pairs, dof_mass, limits, pair, v, updated.geometry, acoustic, r.specific_volume), pair);
        bool const folded = !(updated.corner_area > 0.0);
        bool const finite = isFinite(r);
        bool const in_range = eosInRange(material, r.specific_volume);
        if (folded || !finite || !in_range)
        {
          sums.inverted += folded;
          sums.not_a_number += !finite;
          sums.out_of_range += !in_range;
          if (folded || !finite)
            sums.trouble(pair);
        }
      },
      detail::JoinReducer<UpdateSums>(result));
  next = limitFrom(result.largest, pairs);
  UpdateReport report;
  report.inverted = result.inverted;
  report.not_a_number = result.not_a_number;
  report.out_of_range = result.out_of_range;
  if (result.first_pair >= 0)
  {
    report.cell = valueAt(pairs.cell, result.first_pair);
    report.material = valueAt(pairs.material, result.first_pair);
  }
  return report;
}

TimeStepLimit stableTimeStep(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                             View<Material *> const &materials, LagrangeOptions const &options,
                             LagrangeWork const &work)
{
  auto const record = state.record;
  auto const velocity = state.velocity;
  auto const dof_mass = work.dof_mass;
  detail::StepLimits const limits(options);
  detail::LargestRate result;
  Kokkos::parallel_reduce(
      "Harmos::lagrange::stableTimeStep", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, detail::LargestRate &largest) {
        Material const &material = materials(pairs.material(pair));
        int const cell = pairs.cell(pair);
        if (mesh.cell_depth(cell) != 0)
          return;
        auto const x = detail::cellCorners(mesh, cell);
        auto const v = detail::cornerVelocities(pairs, velocity, pair);
        if (material.rigid_body >= 0)
        {
          largest.include(detail::rigidPairRate(limits, x, v), pair);
          return;
        }
        auto const b = detail::meanGradient(x);
        auto const gradient = detail::velocityGradient(b, v);
        double const inverse = 1.0 / b.area;
        detail::StepGeometry<double> const geometry{b.area, detail::longestMidlineSquared(b) * inverse * inverse,
                                                    Math::max(-(gradient.xx + gradient.yy) * inverse, 0.0)};
        double const sv = record(pair, SpecificVolume);
        double const acoustic = detail::acousticRate(material, options, geometry, sv, record(pair, InternalEnergy));
        largest.include(detail::pairRate(pairs, dof_mass, limits, pair, v, geometry, acoustic, sv), pair);
      },
      detail::JoinReducer<detail::LargestRate>(result));
  return limitFrom(result, pairs);
}

} // namespace Harmos
