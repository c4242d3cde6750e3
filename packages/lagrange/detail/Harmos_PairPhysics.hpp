// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PAIR_PHYSICS_HPP
#define HARMOS_PAIR_PHYSICS_HPP

#include <Harmos_EquationOfState.hpp>
#include <Harmos_Gruneisen.hpp>
#include <Harmos_Lagrange.hpp>
#include <Harmos_Strength.hpp>

#include <detail/Harmos_CutPairs.hpp>
#include <detail/Harmos_RingQuadrature.hpp>

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

constexpr double largest_energy_lag = 0.5; // of the pressure, that an expansion may take from it

/// What failure leaves of a pair's resistance.
template <class T>
struct Bearing
{
  T tensile_strength; // in tension beyond it the pressure is zero
  T room;             // void that a failed pair closes before it is compressed, over its own volume; else zero
  bool has_room;      // any
};

/// The part of a step's compression, at the rate theta, that `room` leaves to the pair: what void closes does no work.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T comesToBear(T const &theta, T const &step, T const &room)
{
  T const compression = step * theta;
  auto const exceeds = compression > room;
  T const part = (compression - room) / select(exceeds, compression, T(1.0));
  return select(exceeds, part, select(both(theta > T(0.0), room > T(0.0)), T(0.0), T(1.0)));
}

/// Minus the stress times the force volume, and the forces that it exerts where the cell's mean gradients act.
template <class T>
struct PairForces
{
  Corners<T> corner;
  ScaledStress<T> stress; // times m sv / cell volume
  T cell_volume;
  T bearing;  // part of the strain that meets them
  T pressure; // of the state alone, none in tension that the pair cannot bear
};

/// What a cut cell's pair has beyond its cell, or lacks.
template <class T>
struct CutPart
{
  CutVelocityGradient<T> gradient; // of the filled region, beyond the cell's mean
  LostExtent<T> lost;
  T answer; // answerToPressure
};

/// L^2 of the artificial viscosity over that of the whole cell: the squares of the extents of the filled region and of
/// the cell along the direction n of the strongest compression, one over the other. With the half trace t of the rate
/// in the plane, its deviator a = (D_xx - D_yy) / 2, b = D_xy, and r = |(a, b)|: n n = (1 - ((a, b), (b, -a)) / r) / 2.
/// Where r is below 0.1 |t|, all directions are compressed within a fifth alike, that takes the place of r: n n goes
/// over to the mean of all directions, for round-off would choose among them.
///
/// Kolev & Rieben, J. Comput. Phys. 228 (2009) 8336-8366: a length along the direction of compression.
/// \param g Velocity gradient times the cell's volume.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T viscousPart(MeanGradient<T> const &plane, ScaledVelocityGradient<T> const &g,
                                          T const &inverse_volume, CutPart<T> const &cut)
{
  constexpr double directed = 0.1; // of |t|
  T const xx = g.xx * inverse_volume + cut.gradient.xx, yy = g.yy * inverse_volume + cut.gradient.yy;
  T const a = 0.5 * (xx - yy);
  T const b = 0.5 * ((g.xy + g.yx) * inverse_volume + (cut.gradient.xy + cut.gradient.yx));
  T const r = Math::max(Math::sqrt(T(a * a + b * b)), T(0.5 * directed * Math::fabs(T(xx + yy))));
  auto const moves = r > T(0.0);
  T const inverse = select(moves, T(1.0 / select(moves, r, T(1.0))), T(0.0));
  auto const alongTwice = [&](T const &e_xx, T const &e_xy, T const &e_yy)
  { return T((e_xx + e_yy) - inverse * (a * (e_xx - e_yy) + 2.0 * b * e_xy)); };
  // the mid-lines of the cell, p and q, turned by a right angle: p p + q q is its squared extent
  T const px = plane.x1 - plane.x0, py = plane.y1 - plane.y0, qx = plane.x1 + plane.x0, qy = plane.y1 + plane.y0;
  T const whole = alongTwice(T(py * py + qy * qy), T(-(px * py + qx * qy)), T(px * px + qx * qx));
  T const lost = alongTwice(cut.lost.xx, cut.lost.xy, cut.lost.yy);
  return 1.0 - Math::min(Math::max(T(lost / whole), T(0.0)), T(1.0));
}

/// Corner forces on the nodes (equations: computeCornerForces).
/// \param cut Null: none of these pairs is of a cut cell.
template <Geometry geometry, class T>
KOKKOS_FORCEINLINE_FUNCTION PairForces<T>
pairForces(Material const &material, LagrangeOptions const &options, PairRecord<T> const &pair, Corners<T> const &x,
           Corners<T> const &v, Bearing<T> const &bearing, CutPart<T> const *cut)
{
  auto const b = cellGradient<geometry>(x);
  MeanGradient<T> const &plane = planeOf(b);
  T const inverse_area = 1.0 / plane.area;
  T const inverse_volume = geometry == Geometry::Planar ? inverse_area : T(1.0 / volumeOf(b));
  auto const g = velocityGradient(b, v); // times the volume
  EosState<T> const eos = equationOfState(material, pair.specific_volume, pair.internal_energy);
  T const c2 =
      longitudinalSoundSpeedSquared(material, eos.sound_speed_squared, pair.specific_volume, pair.internal_energy);
  T const c_length = Math::sqrt(T(c2 * plane.area));

  T trace = traceOf(g) * inverse_volume; // tr D, of the ring where axisymmetric
  T q_area = plane.area, q_length = c_length;
  if (cut != nullptr)
  {
    trace = trace + cut->gradient.trace();
    T const part = viscousPart(plane, g, inverse_volume, *cut);
    q_area = q_area * part;
    q_length = q_length * Math::sqrt(part);
  }
  // sv q = c1 c L |theta| + c2 L^2 theta^2: the force volume m sv times q needs no density
  T const theta = Math::max(T(-trace), T(0.0));
  T sv_q = theta * (options.linear_viscosity * q_length + options.quadratic_viscosity * (q_area * theta));
  if (cut != nullptr && options.kick > 0.0)
    sv_q = Math::min(sv_q, T(2.0 * theta / (options.kick * cut->answer)));
  T const scaled_mass = pair.mass * inverse_volume;
  T const scaled_volume = scaled_mass * pair.specific_volume;
  // The internal energy is behind by `energy_lag`: de = - p sv tr D dt, dp = Gamma de / sv. In tension the lag damps.
  T const gamma_lag = options.energy_lag * gruneisenParameter(material, pair.specific_volume);
  T const p = select(eos.pressure < T(-bearing.tensile_strength), T(0.0), eos.pressure);
  T const pressure = p - Math::max(p, T(0.0)) * Math::min(T(gamma_lag * trace), T(largest_energy_lag));
  T spherical = scaled_volume * pressure + scaled_mass * sv_q;
  T part = 1.0;
  if (bearing.has_room)
  {
    part = comesToBear(theta, T(2.0 * options.energy_lag), bearing.room);
    spherical = spherical * part;
  }
  ScaledStress<T> const stress = {spherical - scaled_volume * pair.deviator.xx,
                                  spherical - scaled_volume * pair.deviator.yy, -(scaled_volume * pair.deviator.xy),
                                  spherical + scaled_volume * (pair.deviator.xx + pair.deviator.yy)};

  HourglassVector<T> const gamma = hourglassVector(plane, inverse_area, x);
  T const coefficient = (0.25 * options.hourglass_viscosity) * (pair.mass * inverse_area * c_length);
  return {stressForces(b, stress, gamma, T(coefficient * gamma.amplitude(v.x)), T(coefficient * gamma.amplitude(v.y))),
          stress, volumeOf(b), part, p};
}

/// What the time step needs of a cell.
template <class T>
struct StepGeometry
{
  T area, volume;
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

/// Volume times the gradient of a filled region.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void addCut(ScaledVelocityGradient<T> &g, T const &volume,
                                        CutVelocityGradient<T> const &cut)
{
  g.xx += volume * cut.xx;
  g.xy += volume * cut.xy;
  g.yx += volume * cut.yx;
  g.yy += volume * cut.yy;
}
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void addCut(ScaledRingVelocityGradient<T> &g, T const &volume,
                                        CutVelocityGradient<T> const &cut)
{
  addCut(static_cast<ScaledVelocityGradient<T> &>(g), volume, cut);
  g.hoop += volume * cut.hoop;
}

/// The new record (equations: updatePairs). x at t^n, v_half; `power` = - sum f_I . v_mean_I. `cut`: what the velocity
/// gradient of the filled region has beyond the cell's mean.
template <Geometry geometry, class T>
KOKKOS_FORCEINLINE_FUNCTION UpdatedPair<T> updatePair(Material const &material, PairRecord<T> const &pair,
                                                      Corners<T> const &x, Corners<T> const &v, T power, double dt,
                                                      double kick, CutVelocityGradient<T> const &cut)
{
  Corners<T> const x_np1 = moved(x, dt, v);
  auto motion = stepMotion<geometry>(x, x_np1, v);
  addCut(motion.gradient, motion.volume_mid, cut);
  T const both = motion.volume_n * motion.volume_mid;
  T const inverse = 1.0 / (both * pair.mass); // one division for three
  T const inverse_both = inverse * pair.mass;
  T const inverse_volume = inverse_both * motion.volume_n; // of mid-step
  T const step = dt * inverse_volume;

  UpdatedPair<T> result;
  PairRecord<T> &updated = result.record;
  updated.mass = pair.mass;
  T const dilatation = dt * cut.trace();
  updated.specific_volume = pair.specific_volume * (motion.volume_np1 * (inverse_both * motion.volume_mid)) *
                            (1.0 + dilatation * (1.0 + 0.5 * dilatation)); // exp to second order, above zero
  updated.internal_energy = pair.internal_energy + kick * power * (inverse * both);
  Deviator<T> const turned = rotate(pair.deviator, T((0.5 * step) * (motion.gradient.yx - motion.gradient.xy)));
  StrainIncrement<T> const strain = strainIncrement(motion.gradient, step);
  ReturnedStress<T> const returned = strainedDeviator(material, turned, strain, pair.plastic_strain,
                                                      updated.specific_volume, updated.internal_energy, dt);
  updated.deviator = returned.deviator;
  updated.plastic_strain = pair.plastic_strain + returned.plastic_strain_increment;

  MeanGradient<T> const &plane = motion.plane_np1;
  result.geometry.area = plane.area;
  result.geometry.volume = motion.volume_np1;
  result.geometry.inverse_length_squared = longestMidlineSquared(plane) / (plane.area * plane.area);
  result.geometry.compression = Math::max(T(-traceOf(motion.gradient)), T(0.0)) * inverse_volume;
  result.corner_area = leastCornerArea(x_np1);
  return result;
}

} // namespace detail
} // namespace Harmos

#endif
