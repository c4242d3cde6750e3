// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FAILURE_HPP
#define HARMOS_FAILURE_HPP

#include <Harmos_Strength.hpp>

namespace Harmos
{

/// Damage D of a pair: below least_failed it is sound and D is what it has used up of its life; a pair that fails gets
/// failed_damage. The jump makes the remap's mean, which is by mass, a vote: a pair is failed where at least half of
/// an otherwise unharmed mass is. Where void is open and the law knows spall alone, so that all damage comes from
/// failed mass, a twentieth of it will do (least_failed_open): a spall plane is one cell wide, and the mean thins its
/// damage out as it drifts through the mesh, while its void stays.
constexpr double least_failed = 1.0;
constexpr double least_failed_open = 0.1;
constexpr double failed_damage = 2.0;

/// \param open There is void in the pair's cell.
KOKKOS_INLINE_FUNCTION bool isFailed(Material const &m, double damage, bool open)
{
  return damage >= (open && !m.failure.damages ? least_failed_open : least_failed);
}

/// Whether a law can fail at all: its pairs then carry damage.
KOKKOS_INLINE_FUNCTION bool canFail(Material const &m)
{
  return m.failure.spall_pressure < no_limit || m.failure.spall_stress < no_limit || m.failure.damages;
}

/// Largest principal value of s - p 1: in the plane (s_xx + s_yy)/2 + sqrt(((s_xx - s_yy)/2)^2 + s_xy^2) - p, or
/// s_zz - p, s_zz = -(s_xx + s_yy). Positive in tension. [Pa]
KOKKOS_INLINE_FUNCTION double largestPrincipalStress(double pressure, Deviator<double> const &s)
{
  double const mean = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy);
  return Math::max(mean + Math::sqrt(half * half + s.xy * s.xy), -2.0 * mean) - pressure;
}

/// T* = (T - T0) / (T_m - T0) held within [0, 1].
KOKKOS_INLINE_FUNCTION double homologousTemperature(Material const &m, double temperature)
{
  double const t0 = m.thermal.reference_temperature;
  return Math::clamp((temperature - t0) / (m.flow.melting_temperature - t0), 0.0, 1.0);
}

/// Strain to fracture eps_f = (D1 + D2 exp(D3 x)) (1 + D4 ln max(rate / rate0, 1)) (1 + D5 T*), x = -p / q.
///
/// Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31-48. Their tests reach x = 1.5, where it is held; not below
/// least_failure_strain (some published sets give negative values there). D3 x is held at 100.
/// \param triaxiality -p / q. \param rate Of the equivalent plastic strain [1/s]. \param homologous T*.
constexpr double largest_triaxiality = 1.5;
constexpr double least_failure_strain = 1e-6;

KOKKOS_INLINE_FUNCTION double failureStrain(Material const &m, double triaxiality, double rate, double homologous)
{
  double const *d = m.failure.d;
  double const power = Math::min(d[2] * Math::min(triaxiality, largest_triaxiality), 100.0);
  double const shape = d[0] + d[1] * Math::exp(power);
  double const speed = 1.0 + d[3] * Math::log(Math::max(rate / m.flow.reference_rate, 1.0));
  return Math::max(shape * speed * (1.0 + d[4] * homologous), least_failure_strain);
}

/// A state as the failure laws look at it.
struct FailureState
{
  double specific_volume, internal_energy;
  Deviator<double> deviator;
  double strain_increment; // of the equivalent plastic strain within dt
};

/// Damage after a step of a sound pair: failed_damage where p <= -spall_pressure, or the
/// largest principal stress >= spall_stress, or D + d eps / eps_f >= 1; else D + d eps / eps_f.
KOKKOS_INLINE_FUNCTION double damageAfter(Material const &m, FailureState const &s, double damage, double dt)
{
  double const p = equationOfState(m, s.specific_volume, s.internal_energy).pressure;
  if (p <= -m.failure.spall_pressure || largestPrincipalStress(p, s.deviator) >= m.failure.spall_stress)
    return failed_damage;
  if (!m.failure.damages || !(s.strain_increment > 0.0))
    return damage;
  double const q = Math::sqrt(3.0 * secondInvariant(s.deviator));
  // without a deviator the triaxiality is at the end of the range in tension, without bound in compression
  double const triaxiality = q > 0.0 ? -p / q : (p > 0.0 ? -1e3 : largest_triaxiality);
  double const hot = homologousTemperature(m, temperature(m, s.specific_volume, s.internal_energy));
  double const next = damage + s.strain_increment / failureStrain(m, triaxiality, s.strain_increment / dt, hot);
  return next >= least_failed ? failed_damage : next;
}

/// The specific volume below `specific_volume`, where p < 0, at which p(sv, e) = 0: to what a failed pair shrinks.
///
/// Bracketed by steps of 2 per cent, which no tension that a law can reach outlasts for long, then regula falsi
/// (Illinois): |p| <= 1e-12 rho0 c0^2. Where p stays below zero down to half of the volume, or of that at rest where it
/// is less (no solid state does), that.
KOKKOS_INLINE_FUNCTION double unstressedVolume(Material const &m, double specific_volume, double internal_energy)
{
  double const tolerance = 1e-12 * m.density0 * m.sound_speed0 * m.sound_speed0;
  double const least = 0.5 * Math::min(specific_volume, 1.0 / m.density0);
  double low = specific_volume, high = specific_volume;
  double p_high = equationOfState(m, high, internal_energy).pressure, p_low = p_high;
  while (p_low < 0.0 && low > least)
  {
    high = low;
    p_high = p_low;
    low *= 0.98;
    p_low = equationOfState(m, low, internal_energy).pressure;
  }
  if (!(p_low > 0.0) || !(p_high < 0.0))
    return low;
  double middle = low;
  int side = 0;
  for (int i = 0; i < 60; ++i)
  {
    middle = (low * p_high - high * p_low) / (p_high - p_low);
    double const p = equationOfState(m, middle, internal_energy).pressure;
    if (Math::fabs(p) <= tolerance)
      break;
    bool const positive = p > 0.0;
    if (positive)
    {
      low = middle;
      p_low = p;
      p_high *= side == 1 ? 0.5 : 1.0;
    }
    else
    {
      high = middle;
      p_high = p;
      p_low *= side == -1 ? 0.5 : 1.0;
    }
    side = positive ? 1 : -1;
  }
  return middle;
}

} // namespace Harmos

#endif
