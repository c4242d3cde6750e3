// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PAIR_PHYSICS_HPP
#define HARMOS_PAIR_PHYSICS_HPP

#include <Harmos_EquationOfState.hpp>
#include <Harmos_Lagrange.hpp>
#include <Harmos_Strength.hpp>

#include <detail/Harmos_MeanQuadrature.hpp>

namespace Harmos
{
namespace detail
{

/// The part of a pair's record that the Lagrangian step reads and writes.
template <class T>
struct PairRecord
{
  T mass, specific_volume, internal_energy, plastic_strain;
  Deviator<T> deviator;
};

/// Corner forces on the nodes (equations: computeCornerForces).
template <class T>
KOKKOS_FORCEINLINE_FUNCTION Corners<T> pairForces(Material const &material, LagrangeOptions const &options,
                                                  PairRecord<T> const &pair, Corners<T> const &x, Corners<T> const &v)
{
  MeanGradient<T> const b = meanGradient(x);
  T const inverse_area = 1.0 / b.area;
  T const rate = ((v.x[0] - v.x[2]) * b.x0 + (v.x[1] - v.x[3]) * b.x1 + (v.y[0] - v.y[2]) * b.y0 +
                  (v.y[1] - v.y[3]) * b.y1); // area * tr D
  EosState<T> const eos = equationOfState(material, pair.specific_volume, pair.internal_energy);
  T const c2 =
      longitudinalSoundSpeedSquared(material, eos.sound_speed_squared, pair.specific_volume, pair.internal_energy);
  T const c_length = Math::sqrt(T(c2 * b.area));

  // sv q = c1 c L |theta| + c2 L^2 theta^2: the force volume m sv times q needs no density
  T const theta = Math::max(T(-rate), T(0.0)) * inverse_area;
  T const sv_q = theta * (options.linear_viscosity * c_length + options.quadratic_viscosity * (b.area * theta));
  T const scaled_mass = pair.mass * inverse_area;
  T const scaled_volume = scaled_mass * pair.specific_volume;
  T const spherical = scaled_volume * eos.pressure + scaled_mass * sv_q;
  T const xx = spherical - scaled_volume * pair.deviator.xx; // - m sv sigma / area
  T const yy = spherical - scaled_volume * pair.deviator.yy;
  T const xy = -(scaled_volume * pair.deviator.xy);

  HourglassVector<T> const gamma = hourglassVector(b, inverse_area, x);
  T const coefficient = (0.25 * options.hourglass_viscosity) * (scaled_mass * c_length);
  T const hx = coefficient * gamma.amplitude(v.x);
  T const hy = coefficient * gamma.amplitude(v.y);

  T const fx0 = b.x0 * xx + b.y0 * xy + hx * gamma.g0;
  T const fy0 = b.x0 * xy + b.y0 * yy + hy * gamma.g0;
  T const fx1 = b.x1 * xx + b.y1 * xy + hx * gamma.g1;
  T const fy1 = b.x1 * xy + b.y1 * yy + hy * gamma.g1;
  return {{fx0 - hx, fx1 + hx, -fx0 - hx, hx - fx1}, {fy0 - hy, fy1 + hy, -fy0 - hy, hy - fy1}};
}

/// What the time step needs of a cell.
template <class T>
struct StepGeometry
{
  T area;
  T inverse_length_squared; // 1 / l^2, l = area / longest mid-line
  T compression;            // max(-tr D, 0) [1/s]
};

/// 1 / dt at Courant number one: (Q + sqrt(Q^2 + c^2)) / l, Q = (c1 c L + c2 L^2 compression) / l.
///
/// A lagged viscosity nu damps a wave of frequency omega by d = nu (dt omega / c)^2 / dt a step; the leapfrog is stable
/// while (omega dt)^2 + 2 d <= 4, omega = 2 c / l. The linear term is counted in expansion too: what oscillates
/// compresses next.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T acousticRate(Material const &material, LagrangeOptions const &options,
                                           StepGeometry<T> const &cell, EosState<T> const &eos, T specific_volume,
                                           T internal_energy)
{
  T const c2 = longitudinalSoundSpeedSquared(material, eos.sound_speed_squared, specific_volume, internal_energy);
  T const viscosity = options.linear_viscosity * Math::sqrt(T(c2 * cell.area)) +
                      options.quadratic_viscosity * (cell.area * cell.compression);
  T const q = viscosity * cell.inverse_length_squared;
  return q + Math::sqrt(T(q * q + c2 * cell.inverse_length_squared));
}

template <class T>
struct UpdatedPair
{
  PairRecord<T> record;
  StepGeometry<T> geometry; // of the moved cell
  T corner_area;            // leastCornerArea of the moved cell
};

/// The new record (equations: updatePairs). x at t^n, v_half; `power` = - sum f_I . v_mean_I.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION UpdatedPair<T> updatePair(Material const &material, PairRecord<T> const &pair,
                                                      Corners<T> const &x, Corners<T> const &v, T power, double dt)
{
  Corners<T> const x_np1 = moved(x, dt, v);
  MeanGradient<T> const b_n = meanGradient(x);
  MeanGradient<T> const b_np1 = meanGradient(x_np1);
  // positions move in a straight line, so that the mid-step gradient is the mean of both ends; its area is not
  MeanGradient<T> b;
  b.x0 = 0.5 * (b_n.x0 + b_np1.x0);
  b.y0 = 0.5 * (b_n.y0 + b_np1.y0);
  b.x1 = 0.5 * (b_n.x1 + b_np1.x1);
  b.y1 = 0.5 * (b_n.y1 + b_np1.y1);
  T const mid_x02 = 0.5 * ((x.x[0] - x.x[2]) + (x_np1.x[0] - x_np1.x[2]));
  T const mid_x13 = 0.5 * ((x.x[1] - x.x[3]) + (x_np1.x[1] - x_np1.x[3]));
  b.area = mid_x02 * b.x0 + mid_x13 * b.x1;

  T const both = b_n.area * b.area;
  T const inverse = 1.0 / (both * pair.mass); // one division for three
  T const inverse_both = inverse * pair.mass;
  T const inverse_area = inverse_both * b_n.area; // of mid-step
  T const step = dt * inverse_area;
  ScaledVelocityGradient<T> const gradient = velocityGradient(b, v);

  UpdatedPair<T> result;
  PairRecord<T> &updated = result.record;
  updated.mass = pair.mass;
  updated.specific_volume = pair.specific_volume * (b_np1.area * (inverse_both * b.area));
  updated.internal_energy = pair.internal_energy + dt * power * (inverse * both);
  Deviator<T> const turned = rotate(pair.deviator, T((0.5 * step) * (gradient.yx - gradient.xy)));
  StrainIncrement<T> const strain = {step * gradient.xx, step * gradient.yy,
                                     (0.5 * step) * (gradient.xy + gradient.yx)};
  ReturnedStress<T> const returned = strainedDeviator(material, turned, strain, pair.plastic_strain,
                                                      updated.specific_volume, updated.internal_energy, dt);
  updated.deviator = returned.deviator;
  updated.plastic_strain = pair.plastic_strain + returned.plastic_strain_increment;

  result.geometry.area = b_np1.area;
  result.geometry.inverse_length_squared = longestMidlineSquared(b_np1) / (b_np1.area * b_np1.area);
  result.geometry.compression = Math::max(T(-(gradient.xx + gradient.yy)), T(0.0)) * inverse_area;
  result.corner_area = leastCornerArea(x_np1);
  return result;
}

} // namespace detail
} // namespace Harmos

#endif
