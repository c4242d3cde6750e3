// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_EQUATION_OF_STATE_HPP
#define HARMOS_EQUATION_OF_STATE_HPP

#include <Harmos_Tillotson.hpp>

namespace Harmos
{

/// Mie-Gruneisen: least 1 - s eta that is evaluated. Below it the Hugoniot runs into its pole; there p_H is continued
/// with this denominator, and eosInRange says no.
constexpr double least_hugoniot_denominator = 0.1;

/// Floor of c^2 over c0^2: strong tension makes the isentropic c^2 negative, while time step and viscosity need c > 0.
constexpr double least_sound_speed_ratio_squared = 1e-4;

namespace detail
{

/// p = c0^2 (rho - rho0) + gamma0 rho (e - e0).
template <class T>
KOKKOS_INLINE_FUNCTION EosState<T> stiffened(Material const &m, T specific_volume, T internal_energy)
{
  T const rho = 1.0 / specific_volume;
  double const c2 = m.sound_speed0 * m.sound_speed0;
  T const e = internal_energy - m.energy0;
  T const p = c2 * (rho - m.density0) + m.gruneisen * (rho * e);
  return {p, c2 + m.gruneisen * (e + p * specific_volume)};
}

/// With eta = 1 - rho0 sv, d = 1 - s eta: p_H = rho0 c0^2 eta / d^2, e_H - e0 = p_H eta / (2 rho0),
/// p = p_H + gamma0 rho0 (e - e_H). In expansion p_H = c0^2 (rho - rho0) and e_H = e0: p, c^2 are continuous.
template <class T>
KOKKOS_INLINE_FUNCTION EosState<T> mieGruneisen(Material const &m, T specific_volume, T internal_energy)
{
  double const c2 = m.sound_speed0 * m.sound_speed0;
  double const gamma_rho = m.gruneisen * m.density0;
  T const rho = 1.0 / specific_volume;
  T const eta = 1.0 - m.density0 * specific_volume;
  T const d = 1.0 / Math::max(T(1.0 - m.slope * eta), T(least_hugoniot_denominator));
  T const hugoniot = (m.density0 * c2) * eta * d * d;
  T const reduction = 1.0 - (0.5 * m.gruneisen) * eta;
  // rho0 sv^2 dp/deta, that is dp/drho at constant e
  T const slope = (m.density0 * specific_volume) * (m.density0 * specific_volume) * d * d *
                  (c2 * (1.0 + m.slope * eta) * d * reduction - (0.5 * m.gruneisen * c2) * eta);
  auto const compressed = eta > T(0.0);
  T const p = select(compressed, T(hugoniot * reduction), T(c2 * (rho - m.density0))) +
              gamma_rho * (internal_energy - m.energy0);
  return {p, select(compressed, slope, T(c2)) + gamma_rho * (p * specific_volume * specific_volume)};
}

/// p = (gamma - 1) rho e, gamma in `gruneisen`.
template <class T>
KOKKOS_INLINE_FUNCTION EosState<T> idealGas(Material const &m, T specific_volume, T internal_energy)
{
  T const p = (m.gruneisen - 1.0) * internal_energy / specific_volume;
  return {p, m.gruneisen * (p * specific_volume)};
}

} // namespace detail

/// Pressure and bulk sound speed from specific volume and internal energy.
///
/// \param specific_volume [m^3/kg], > 0. \param internal_energy [J/kg].
/// \return p as EosKind states it, cut off at -tension_limit (strong tension has no stable answer: c^2 falls below zero
/// where gamma0 rho0 p sv^2 = -c0^2; a solid fails long before); c^2 not below least_sound_speed_ratio_squared c0^2
/// (ideal gas: not below 0). T: double, or a pack whose lanes share the material.
template <class T>
KOKKOS_INLINE_FUNCTION EosState<T> equationOfState(Material const &material, T specific_volume, T internal_energy)
{
  EosState<T> state;
  if (material.eos == EosKind::MieGruneisen)
    state = detail::mieGruneisen(material, specific_volume, internal_energy);
  else if (material.eos == EosKind::Stiffened)
    state = detail::stiffened(material, specific_volume, internal_energy);
  else if (material.eos == EosKind::IdealGas)
    state = detail::idealGas(material, specific_volume, internal_energy);
  else
    state = detail::tillotson(material, specific_volume, internal_energy);
  double const floor = least_sound_speed_ratio_squared * material.sound_speed0 * material.sound_speed0;
  state.sound_speed_squared = Math::max(state.sound_speed_squared, T(floor));
  state.pressure = Math::max(state.pressure, T(-material.tension_limit));
  return state;
}

/// Whether the equation of state is meant for this state, lane by lane: its range. Outside it goes on, by floors and
/// held denominators.
///
///  - All: sv > 0, and c^2 above its floor (strong tension and, ideal gas, e <= 0 have no stable answer) unless the
///    pressure is cut off at the tension limit;
///  - Mie-Gruneisen: short of the pole s eta = 1 of the Hugoniot (least_hugoniot_denominator);
///  - Tillotson: e > -E0 eta^2 / 2, short of its pole at -E0 eta^2.
/// \param state Of equationOfState at sv and e.
template <class T>
KOKKOS_INLINE_FUNCTION auto eosInRange(Material const &material, EosState<T> const &state, T specific_volume,
                                       T internal_energy)
{
  double const floor = least_sound_speed_ratio_squared * material.sound_speed0 * material.sound_speed0;
  auto const stable = no(both(state.sound_speed_squared <= T(floor), state.pressure > T(-material.tension_limit)));
  auto const good = both(specific_volume > T(0.0), stable);
  if (material.eos == EosKind::MieGruneisen)
    return both(good,
                T(1.0 - material.slope * (1.0 - material.density0 * specific_volume)) > T(least_hugoniot_denominator));
  if (material.eos == EosKind::Tillotson)
  {
    T const volume = material.density0 * specific_volume;
    return both(good, T(internal_energy * volume * volume) > T(-0.5 * material.tillotson.energy));
  }
  return good;
}

KOKKOS_INLINE_FUNCTION bool eosInRange(Material const &material, double specific_volume, double internal_energy)
{
  return specific_volume > 0.0 && eosInRange(material, equationOfState(material, specific_volume, internal_energy),
                                             specific_volume, internal_energy);
}

} // namespace Harmos

#endif
