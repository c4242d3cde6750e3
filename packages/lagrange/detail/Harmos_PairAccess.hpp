// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PAIR_ACCESS_HPP
#define HARMOS_PAIR_ACCESS_HPP

#include <Harmos_Lagrange.hpp>

#include <Harmos_LoadPoints.hpp>
#include <Harmos_RowPointer.hpp>
#include <detail/Harmos_PairPhysics.hpp>

namespace Harmos
{
namespace detail
{

/// Positions of a cell's corners.
KOKKOS_INLINE_FUNCTION Corners<double> cellCorners(Mesh const &mesh, int cell)
{
  Corners<double> c;
  for (int k = 0; k < 4; ++k)
  {
    int const node = mesh.cell_node(cell, k);
    c.x[k] = mesh.node_position(node, 0);
    c.y[k] = mesh.node_position(node, 1);
  }
  return c;
}

/// A velocity at the four dof nodes of a pair.
KOKKOS_INLINE_FUNCTION Corners<double> cornerVelocities(CellMaterialPairs const &pairs,
                                                        View<double *[2]> const &velocity, int pair)
{
  Corners<double> c;
  for (int k = 0; k < 4; ++k)
  {
    int const dof = pairs.dof_node(pair, k);
    c.x[k] = velocity(dof, 0);
    c.y[k] = velocity(dof, 1);
  }
  return c;
}

/// \defgroup PackedPairs The same for the pairs of a pack's lanes.
/// \{

/// Values at the corners.
KOKKOS_FORCEINLINE_FUNCTION Corners<Pack> packedCorners(PackedCornerRows const &rows,
                                                        RowPointer<double, 2> const &value)
{
  Corners<Pack> c;
  HARMOS_UNROLL
  for (int k = 0; k < 4; ++k)
    loadCorner(rows, value, k, c.x[k], c.y[k]);
  return c;
}

/// \param run Whether the pairs are numbered one after the other.
KOKKOS_FORCEINLINE_FUNCTION PairRecord<Pack> loadPackedRecord(RowPointer<double, num_pair_fields> const &record,
                                                              int const pair[pack_width], bool run)
{
  Pack field[num_pair_fields];
  loadIndexedRows(record, pair, run, field);
  PairRecord<Pack> r;
  r.mass = field[Mass];
  r.specific_volume = field[SpecificVolume];
  r.internal_energy = field[InternalEnergy];
  r.plastic_strain = field[PlasticStrain];
  r.deviator = {field[DeviatorXX], field[DeviatorYY], field[DeviatorXY]};
  return r;
}

KOKKOS_FORCEINLINE_FUNCTION Corners<double> laneOf(Corners<Pack> const &c, int lane)
{
  using Harmos::laneOf;
  Corners<double> r;
  for (int k = 0; k < 4; ++k)
  {
    r.x[k] = laneOf(c.x[k], lane);
    r.y[k] = laneOf(c.y[k], lane);
  }
  return r;
}

/// The first pairs of one material among the `left` ones of a pack.
HARMOS_RARE_FUNCTION inline unsigned selectLanes(int const *material_of, int first, unsigned left, int pair[pack_width])
{
  int lead = 0;
  while ((left >> lead & 1u) == 0u)
    ++lead;
  unsigned lanes = 0u;
  for (int lane = 0; lane < pack_width; ++lane)
  {
    bool const mine = (left >> lane & 1u) != 0u && material_of[first + lane] == material_of[first + lead];
    pair[lane] = mine ? first + lane : first + lead;
    lanes |= (mine ? 1u : 0u) << lane;
  }
  return lanes;
}

/// Visit pack number `block` of the pairs from `begin` to `end` in parts of one material: visit(material, pair, lanes),
/// bit l of `lanes` set where lane l is to be stored. The other lanes repeat a pair of the part, so that every lane
/// holds something sound.
///
/// One call of `visit`, so that there is one compiled copy of its arithmetic: two might round differently.
template <class Visitor>
KOKKOS_FORCEINLINE_FUNCTION void forPackedPairs(int const *material_of, int begin, int end, int block,
                                                Visitor const &visit)
{
  int const first = begin + block * pack_width;
  int const count = Math::min(pack_width, end - first);
  bool const uniform =
      count == pack_width && !anySet(loadNumbers(material_of + first) ^ countFrom(material_of[first], 0));
  unsigned left = (1u << count) - 1u;
  do
  {
    int pair[pack_width];
    unsigned lanes = all_lanes;
    if (uniform)
      for (int lane = 0; lane < pack_width; ++lane)
        pair[lane] = first + lane;
    else
      lanes = selectLanes(material_of, first, left, pair);
    visit(material_of[pair[0]], pair, lanes);
    left &= ~lanes;
  } while (left != 0u);
}
/// \}

template <class T>
KOKKOS_INLINE_FUNCTION T largestSpeedSquared(Corners<T> const &v)
{
  T largest = T(v.x[0] * v.x[0] + v.y[0] * v.y[0]);
  HARMOS_UNROLL
  for (int k = 1; k < 4; ++k)
    largest = Math::max(largest, T(v.x[k] * v.x[k] + v.y[k] * v.y[k]));
  return largest;
}

/// The same over the dof nodes that are not lighter than `least_mass`.
KOKKOS_INLINE_FUNCTION double largestHeavySpeedSquared(CellMaterialPairs const &pairs, View<double *> const &dof_mass,
                                                       int pair, Corners<double> const &v, double least_mass)
{
  double largest = 0.0;
  for (int k = 0; k < 4; ++k)
    if (dof_mass(pairs.dof_node(pair, k)) >= least_mass)
      largest = Math::max(largest, v.x[k] * v.x[k] + v.y[k] * v.y[k]);
  return largest;
}

/// Options of the time step, in the form that the kernels multiply by.
struct StepLimits
{
  double inverse_courant;
  double inverse_travel_squared;
  double light_node;

  explicit StepLimits(LagrangeOptions const &options)
      : inverse_courant(1.0 / options.courant),
        inverse_travel_squared(1.0 / (options.largest_travel * options.largest_travel)), light_node(options.light_node)
  {
  }
};

/// 1 / dt of a deformable pair: the larger of acoustic / courant and the travel's |v| / (largest_travel l).
///
/// A full dof node has mass volume / sv; light ones are left out of the travel.
KOKKOS_INLINE_FUNCTION double pairRate(CellMaterialPairs const &pairs, View<double *> const &dof_mass,
                                       StepLimits const &limits, int pair, Corners<double> const &v,
                                       StepGeometry<double> const &geometry, double acoustic, double specific_volume)
{
  double const rate = acoustic * limits.inverse_courant;
  double const scale = geometry.inverse_length_squared * limits.inverse_travel_squared;
  if (largestSpeedSquared(v) * scale <= rate * rate)
    return rate;
  double const least_mass = limits.light_node * geometry.volume / specific_volume;
  return Math::max(rate, Math::sqrt(largestHeavySpeedSquared(pairs, dof_mass, pair, v, least_mass) * scale));
}

/// The same for a pack of pairs; the rare path lane by lane.
KOKKOS_FORCEINLINE_FUNCTION Pack pairRate(CellMaterialPairs const &pairs, View<double *> const &dof_mass,
                                          StepLimits const &limits, int const pair[pack_width], Corners<Pack> const &v,
                                          StepGeometry<Pack> const &geometry, Pack const &acoustic,
                                          Pack const &specific_volume)
{
  Pack const rate = acoustic * limits.inverse_courant;
  Pack const scale = geometry.inverse_length_squared * limits.inverse_travel_squared;
  auto const travels = largestSpeedSquared(v) * scale > rate * rate;
  if (!any(travels))
    return rate;
  using Harmos::laneOf;
  return packOf(
      [&](int lane)
      {
        if (!laneOf(travels, lane))
          return laneOf(rate, lane);
        double const least_mass = limits.light_node * laneOf(geometry.volume, lane) / laneOf(specific_volume, lane);
        double const heavy = largestHeavySpeedSquared(pairs, dof_mass, pair[lane], detail::laneOf(v, lane), least_mass);
        return Math::max(laneOf(rate, lane), Math::sqrt(heavy * laneOf(scale, lane)));
      });
}

/// What the time step needs of a cell, at any velocity.
KOKKOS_INLINE_FUNCTION StepGeometry<double> stepGeometry(Geometry geometry, Corners<double> const &x,
                                                         Corners<double> const &v)
{
  MeanGradient<double> const b = meanGradient(x);
  double volume = b.area, change;
  if (geometry == Geometry::Planar)
    change = traceOf(velocityGradient(b, v));
  else
  {
    RingGradient<double> const ring = ringGradient(x);
    volume = ring.volume;
    change = traceOf(velocityGradient(ring, v));
  }
  double const inverse = 1.0 / b.area;
  return {b.area, volume, longestMidlineSquared(b) * inverse * inverse, Math::max(-(change / volume), 0.0)};
}

/// 1 / dt of a rigid pair: its travel through the unmoved cell.
KOKKOS_INLINE_FUNCTION double rigidPairRate(StepLimits const &limits, Corners<double> const &x,
                                            Corners<double> const &v)
{
  MeanGradient<double> const b = meanGradient(x);
  double const scale = limits.inverse_travel_squared * longestMidlineSquared(b) / (b.area * b.area);
  return Math::sqrt(largestSpeedSquared(v) * scale);
}

} // namespace detail
} // namespace Harmos

#endif
