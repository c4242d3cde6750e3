// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <Harmos_JoinReducer.hpp>
#include <Harmos_Prefetch.hpp>
#include <detail/Harmos_LargestRate.hpp>
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
  int first_out_of_range = -1;

  static KOKKOS_INLINE_FUNCTION void note(int &first, int pair) { first = first < 0 ? pair : Math::min(first, pair); }
  KOKKOS_INLINE_FUNCTION void join(UpdateSums const &other)
  {
    largest.join(other.largest);
    inverted += other.inverted;
    not_a_number += other.not_a_number;
    out_of_range += other.out_of_range;
    if (other.first_pair >= 0)
      note(first_pair, other.first_pair);
    if (other.first_out_of_range >= 0)
      note(first_out_of_range, other.first_out_of_range);
  }
};

/// - sum_I f_I . v_mean_I, the power of the nodes on the pairs.
KOKKOS_FORCEINLINE_FUNCTION Pack cornerPower(RowPointer<double, 8> const &corner_force, int const pair[pack_width],
                                             bool run, detail::Corners<Pack> const &before,
                                             detail::Corners<Pack> const &half)
{
  Pack f[8];
  loadIndexedRows(corner_force, pair, run, f);
  Pack sum = 0.0;
  HARMOS_UNROLL
  for (int k = 0; k < 4; ++k)
    sum += f[2 * k] * (before.x[k] + half.x[k]) + f[2 * k + 1] * (before.y[k] + half.y[k]);
  return -0.5 * sum;
}

/// Lanes where nothing is wrong, no mass negative. x - x is not 0 for infinities and NaN.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION auto isFinite(detail::PairRecord<T> const &r)
{
  T const all = r.mass + r.internal_energy + r.plastic_strain + r.deviator.xx + r.deviator.yy + r.deviator.xy;
  return both(both(r.specific_volume > T(0.0), no(r.mass < T(0.0))),
              T((r.specific_volume - r.specific_volume) + (all - all)) == T(0.0));
}

template <Geometry geometry>
struct UpdateFunctor
{
  CellMaterialPairs pairs;
  int const *cell_of;
  int const *material_of;
  int const *cell_depth;
  Material const *materials;
  LagrangeOptions options;
  detail::StepLimits limits;
  double dt, kick;
  RowPointer<int, 4> cell_node, dof_node;
  RowPointer<double, 2> position, velocity, half;
  RowPointer<double, num_pair_fields> record;
  RowPointer<double, 8> corner_force;
  View<double *> dof_mass;
  detail::CutPairs cut;

  KOKKOS_INLINE_FUNCTION bool stored(unsigned lanes, int lane) const { return (lanes >> lane & 1u) != 0u; }

  /// The stored lanes whose cells this rank owns.
  KOKKOS_FORCEINLINE_FUNCTION unsigned owned(unsigned lanes, int const cell[pack_width]) const
  {
    for (int lane = 0; lane < pack_width; ++lane)
      if (cell_depth[cell[lane]] != 0)
        lanes &= ~(1u << lane);
    return lanes;
  }

  template <class InRange>
  KOKKOS_INLINE_FUNCTION void countTrouble(detail::UpdatedPair<Pack> const &updated, InRange const &in_range,
                                           int const pair[pack_width], unsigned lanes, UpdateSums &sums) const
  {
    auto const finite = isFinite(updated.record);
    for (int lane = 0; lane < pack_width; ++lane)
    {
      if (!stored(lanes, lane))
        continue;
      bool const folded = !(laneOf(updated.corner_area, lane) > 0.0);
      sums.inverted += folded;
      sums.not_a_number += !laneOf(finite, lane);
      sums.out_of_range += !laneOf(in_range, lane);
      if (folded || !laneOf(finite, lane))
        UpdateSums::note(sums.first_pair, pair[lane]);
      if (!laneOf(in_range, lane))
        UpdateSums::note(sums.first_out_of_range, pair[lane]);
    }
  }

  KOKKOS_INLINE_FUNCTION void includeRigid(detail::Corners<Pack> const &x, detail::Corners<Pack> const &v,
                                           int const pair[pack_width], unsigned lanes, UpdateSums &sums) const
  {
    for (int lane = 0; lane < pack_width; ++lane)
      if (stored(lanes, lane))
        sums.largest.include(detail::rigidPairRate(limits, detail::laneOf(x, lane), detail::laneOf(v, lane)),
                             pair[lane]);
  }

  KOKKOS_FORCEINLINE_FUNCTION void update(int number, int const pair[pack_width], unsigned lanes,
                                          UpdateSums &sums) const
  {
    Material const &material = materials[number];
    int cell[pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
      cell[lane] = cell_of[pair[lane]];
    readAhead(material_of, pair[0]);
    readAhead(cell_of, pair[0]);
    readAhead(record, pair[0]);
    readAhead(corner_force, pair[0]);
    readAhead(cell_node, cell[0]);
    readAhead(dof_node, pair[0]);
    readAhead(position, cell_node(cell[0], 2));
    readAhead(velocity, dof_node(pair[0], 2));
    readAhead(half, dof_node(pair[0], 2));
    bool const run = lanes == all_lanes;
    PackedCornerRows const dofs(dof_node, pair, run);
    auto const x = detail::packedCorners({cell_node, cell, run && countsUp(cell_of + pair[0])}, position);
    auto const v = detail::packedCorners(dofs, half);
    if (material.rigid_body >= 0)
    {
      includeRigid(x, v, pair, owned(lanes, cell), sums);
      return;
    }
    Pack const power = cornerPower(corner_force, pair, run, detail::packedCorners(dofs, velocity), v);
    auto const updated =
        detail::updatePair<geometry>(material, detail::loadPackedRecord(record, pair, run), x, v, power, dt, kick,
                                     actsOnFilledRegion(options.cut_cell_stress, material) && cut.any(cell)
                                         ? cut.template velocityGradient<geometry>(pair, cell, v)
                                         : detail::CutVelocityGradient<Pack>{});
    auto const &r = updated.record;
    Pack const fraction = packOf([&](int lane) { return record(pair[lane], VolumeFraction); });
    Pack const row[num_pair_fields] = {r.mass,           fraction,      r.specific_volume, r.internal_energy,
                                       r.plastic_strain, r.deviator.xx, r.deviator.yy,     r.deviator.xy};
    storeIndexedRows(row, lanes, record, pair, run);

    EosState<Pack> const eos = equationOfState(material, r.specific_volume, r.internal_energy);
    Pack const acoustic =
        detail::acousticRate(material, options, updated.geometry, eos, r.specific_volume, r.internal_energy);
    Pack const rate = detail::pairRate(pairs, dof_mass, limits, pair, v, updated.geometry, acoustic, r.specific_volume);
    if (any(rate > Pack(sums.largest.rate)))
    {
      unsigned const counted = owned(lanes, cell);
      for (int lane = 0; lane < pack_width; ++lane)
        if (stored(counted, lane))
          sums.largest.include(laneOf(rate, lane), pair[lane]);
    }
    auto const in_range = eosInRange(material, eos, r.specific_volume, r.internal_energy);
    if (any(no(both(both(updated.corner_area > Pack(0.0), isFinite(r)), in_range))))
      countTrouble(updated, in_range, pair, owned(lanes, cell), sums);
  }

  KOKKOS_INLINE_FUNCTION void operator()(int block, UpdateSums &sums) const
  {
    detail::forPackedPairs(material_of, 0, pairs.num_pairs, block,
                           [&](int number, int const *pair, unsigned lanes) { update(number, pair, lanes, sums); });
  }
};

template <Geometry geometry>
UpdateSums launch(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                  View<Material *> const &materials, LagrangeOptions const &options, double dt, double kick,
                  LagrangeWork const &work)
{
  UpdateFunctor<geometry> const update{pairs,
                                       pairs.cell.data(),
                                       pairs.material.data(),
                                       mesh.cell_depth.data(),
                                       materials.data(),
                                       options,
                                       detail::StepLimits(options),
                                       dt,
                                       kick,
                                       mesh.cell_node,
                                       pairs.dof_node,
                                       mesh.node_position,
                                       state.velocity,
                                       work.half,
                                       state.record,
                                       work.corner_force,
                                       work.dof_mass,
                                       detail::CutPairs(work.cut, pairs)};
  UpdateSums result;
  Kokkos::parallel_reduce("Harmos::lagrange::updatePairs", RangePolicy(0, numPacks(pairs.num_pairs)), update,
                          JoinReducer<UpdateSums>(result));
  return result;
}

} // namespace

UpdateReport updatePairs(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                         View<Material *> const &materials, LagrangeOptions const &options, double dt, double kick,
                         LagrangeWork const &work, TimeStepLimit &next)
{
  auto const launcher = mesh.geometry == Geometry::Planar ? launch<Geometry::Planar> : launch<Geometry::Axisymmetric>;
  UpdateSums const result = launcher(mesh, pairs, state, materials, options, dt, kick, work);
  next = detail::limitFrom(result.largest, pairs);
  UpdateReport report;
  report.inverted = result.inverted;
  report.not_a_number = result.not_a_number;
  report.out_of_range = result.out_of_range;
  if (result.first_pair >= 0)
  {
    report.cell = detail::valueAt(pairs.cell, result.first_pair);
    report.material = detail::valueAt(pairs.material, result.first_pair);
  }
  if (result.first_out_of_range >= 0)
  {
    report.range_cell = detail::valueAt(pairs.cell, result.first_out_of_range);
    report.range_material = detail::valueAt(pairs.material, result.first_out_of_range);
    report.range_energy = detail::valueAt(state.record, result.first_out_of_range, InternalEnergy);
    report.range_mass = detail::valueAt(state.record, result.first_out_of_range, Mass);
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
        detail::StepGeometry<double> const geometry = detail::stepGeometry(mesh.geometry, x, v);
        double const sv = record(pair, SpecificVolume), e = record(pair, InternalEnergy);
        EosState<double> const eos = equationOfState(material, sv, e);
        double const acoustic = detail::acousticRate(material, options, geometry, eos, sv, e);
        largest.include(detail::pairRate(pairs, dof_mass, limits, pair, v, geometry, acoustic, sv), pair);
      },
      JoinReducer<detail::LargestRate>(result));
  return detail::limitFrom(result, pairs);
}

} // namespace Harmos
