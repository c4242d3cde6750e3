// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <Harmos_CellVoid.hpp>
#include <Harmos_Failure.hpp>
#include <Harmos_Prefetch.hpp>
#include <detail/Harmos_NodeKernels.hpp>
#include <detail/Harmos_PairAccess.hpp>

namespace Harmos
{
namespace
{

template <Geometry geometry>
struct CornerForceFunctor
{
  LagrangeOptions options;
  CellMaterialPairs pairs;
  PairState state;
  int const *material_of;
  int const *cell_of;
  double const *cell_volume;
  Material const *materials;
  RowPointer<int, 4> cell_node, dof_node;
  RowPointer<double, 2> position, velocity;
  RowPointer<double, num_pair_fields> record;
  RowPointer<double, 8> corner_force;
  detail::CutPairs cut;
  RowPointer<double, 4> share; // Mesh::corner_share, about an axis
  View<double *[3]> before;
  View<double *[3]> pressure; // extent 0: not kept
  int begin = 0, end = 0;     // pairs

  /// Tension: failed pairs bear none, the others what they would not fail at. failPairs leaves none beyond, but the
  /// remap mixes: of vapour and condensed matter, both without pressure, the mean energy and volume may stand at the
  /// cold curve's deepest tension. Compression: failPairs lets the void of its cell close before a failed pair loses
  /// volume, and so before it resists: the void that their volumes leave, not their outlines.
  KOKKOS_FORCEINLINE_FUNCTION detail::Bearing<Pack> bearing(Material const &material, int const pair[pack_width],
                                                            int const cell[pack_width]) const
  {
    detail::Bearing<Pack> result = {no_limit, 0.0, false};
    if (!state.tracks_damage || !canFail(material))
      return result;
    double const sound = Math::min(material.failure.spall_pressure, material.failure.spall_stress);
    double strength[pack_width], room[pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
    {
      double const damage = state.damage(pair[lane]);
      double const open = damage >= least_failed_open ? voidFraction(pairs, state.record, cell[lane]) : 0.0;
      bool const failed = damage >= least_failed_open && isFailed(material, damage, open > least_void);
      strength[lane] = failed ? 0.0 : sound;
      room[lane] = failed && open > least_void && options.closure == Closure::EqualStrain
                       ? Math::max(voidOfVolumes(pairs, state.record, cell[lane], cell_volume[cell[lane]]), 0.0) /
                             filledByVolume(state.record, pair[lane], cell_volume[cell[lane]])
                       : 0.0;
      result.has_room = result.has_room || room[lane] > 0.0;
    }
    result.tensile_strength = loadPack(strength);
    result.room = loadPack(room);
    return result;
  }

  KOKKOS_FORCEINLINE_FUNCTION void compute(int number, int const pair[pack_width], unsigned lanes) const
  {
    Material const &material = materials[number];
    int cell[pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
      cell[lane] = cell_of[pair[lane]];
    bool const run = lanes == all_lanes;
    readAhead(material_of, pair[0]);
    readAhead(cell_of, pair[0]);
    readAhead(record, pair[0]);
    readAhead(cell_node, cell[0]);
    readAhead(dof_node, pair[0]);
    readAhead(position, cell_node(cell[0], 2));
    readAhead(velocity, dof_node(pair[0], 2));
    detail::Corners<Pack> f = {};
    if (material.rigid_body < 0)
    {
      bool const any_cut = actsOnFilledRegion(options.cut_cell_stress, material) && cut.any(cell);
      auto const v = detail::packedCorners({dof_node, pair, run}, velocity);
      PackedCornerRows const nodes(cell_node, cell, run && countsUp(cell_of + pair[0]));
      auto const x = detail::packedCorners(nodes, position);
      detail::CutPart<Pack> part = {};
      if (any_cut)
        part = {cut.template velocityGradient<geometry>(pair, cell, v), cut.lostExtent(pair, cell),
                cut.template answerToPressure<geometry>(pair, cell, x, share)};
      auto const own = detail::loadPackedRecord(record, pair, run);
      auto const forces = detail::pairForces<geometry>(material, options, own, x, v, bearing(material, pair, cell),
                                                       any_cut ? &part : nullptr);
      f = forces.corner;
      if (state.tracks_damage && canFail(material))
        for (int lane = 0; lane < pack_width; ++lane)
          before(pair[lane], BeforeBearing) = laneOf(forces.bearing, lane);
      if (pressure.extent(0) > 0 && material.strength == StrengthKind::None)
      {
        Pack const volume = own.mass * own.specific_volume;
        for (int lane = 0; lane < pack_width; ++lane)
          if ((lanes >> lane & 1u) != 0u)
          {
            pressure(pair[lane], 0) = laneOf(forces.pressure, lane);
            pressure(pair[lane], 1) = laneOf(volume, lane);
            pressure(pair[lane], 2) = laneOf(own.mass, lane);
          }
      }
      if (any_cut)
        cut.template addForces<geometry>(pair, cell, forces.stress, forces.cell_volume, f);
    }
    Pack const row[8] = {f.x[0], f.y[0], f.x[1], f.y[1], f.x[2], f.y[2], f.x[3], f.y[3]};
    storeIndexedRows(row, lanes, corner_force, pair, run);
  }

  KOKKOS_INLINE_FUNCTION void operator()(int block) const
  {
    detail::forPackedPairs(material_of, begin, end, block,
                           [&](int number, int const *pair, unsigned lanes) { compute(number, pair, lanes); });
  }
};

template <Geometry geometry>
detail::PairKernel kernelOf(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                            View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork const &work)
{
  CornerForceFunctor<geometry> const whole{options,
                                           pairs,
                                           state,
                                           pairs.material.data(),
                                           pairs.cell.data(),
                                           mesh.cell_volume.data(),
                                           materials.data(),
                                           mesh.cell_node,
                                           pairs.dof_node,
                                           mesh.node_position,
                                           state.velocity,
                                           state.record,
                                           work.corner_force,
                                           detail::CutPairs(work.cut, pairs),
                                           mesh.corner_share.part,
                                           work.before,
                                           work.keeps_pressure ? work.pressure : View<double *[3]>()};
  return [whole](int begin, int end)
  {
    CornerForceFunctor<geometry> part = whole;
    part.begin = begin;
    part.end = end;
    Kokkos::parallel_for("Harmos::lagrange::cornerForces", RangePolicy(0, numPacks(end - begin)), part);
  };
}

} // namespace

detail::PairKernel detail::cornerForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                                        View<Material *> const &materials, LagrangeOptions const &options,
                                        LagrangeWork &work)
{
  auto const kernel = mesh.geometry == Geometry::Planar ? kernelOf<Geometry::Planar> : kernelOf<Geometry::Axisymmetric>;
  if (state.tracks_damage && work.before.extent(0) < static_cast<std::size_t>(pairs.num_pairs))
    work.before = View<double *[3]>("Harmos::lagrange::before", pairs.num_pairs + pairs.num_pairs / 4);
  return kernel(mesh, pairs, state, materials, options, work);
}

void computeCornerForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                         View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork &work)
{
  detail::cornerForces(mesh, pairs, state, materials, options, work)(0, pairs.num_pairs);
}

} // namespace Harmos
