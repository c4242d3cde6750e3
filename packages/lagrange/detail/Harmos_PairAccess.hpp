// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PAIR_ACCESS_HPP
#define HARMOS_PAIR_ACCESS_HPP

#include <Harmos_Lagrange.hpp>

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

KOKKOS_INLINE_FUNCTION PairRecord<double> loadRecord(View<double *[num_pair_fields]> const &record, int pair)
{
  PairRecord<double> r;
  r.mass = record(pair, Mass);
  r.specific_volume = record(pair, SpecificVolume);
  r.internal_energy = record(pair, InternalEnergy);
  r.plastic_strain = record(pair, PlasticStrain);
  r.deviator = {record(pair, DeviatorXX), record(pair, DeviatorYY), record(pair, DeviatorXY)};
  return r;
}

KOKKOS_INLINE_FUNCTION double largestSpeedSquared(Corners<double> const &v)
{
  double largest = 0.0;
  for (int k = 0; k < 4; ++k)
    largest = Math::max(largest, v.x[k] * v.x[k] + v.y[k] * v.y[k]);
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
/// A full dof node has mass area / sv; light ones are left out of the travel.
KOKKOS_INLINE_FUNCTION double pairRate(CellMaterialPairs const &pairs, View<double *> const &dof_mass,
                                       StepLimits const &limits, int pair, Corners<double> const &v,
                                       StepGeometry<double> const &geometry, double acoustic, double specific_volume)
{
  double const rate = acoustic * limits.inverse_courant;
  double const scale = geometry.inverse_length_squared * limits.inverse_travel_squared;
  if (largestSpeedSquared(v) * scale <= rate * rate)
    return rate;
  double const least_mass = limits.light_node * geometry.area / specific_volume;
  return Math::max(rate, Math::sqrt(largestHeavySpeedSquared(pairs, dof_mass, pair, v, least_mass) * scale));
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
