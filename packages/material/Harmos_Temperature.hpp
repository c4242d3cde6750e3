// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEMPERATURE_HPP
#define HARMOS_TEMPERATURE_HPP

#include <Harmos_Material.hpp>
#include <Harmos_Select.hpp>

namespace Harmos
{

/// Temperature from specific volume and internal energy. [K]
///
/// T = T_s(eta) + (e - e_s(eta)) / c_v, c_v constant, eta = 1 - rho0 sv; e_s, T_s are energy and temperature on the
/// isentrope through the reference state (density0, energy0, T0): de_s/dsv = -p(sv, e_s), dT_s/dsv = -(gamma / sv) T_s.
/// With p linear in e (Mie-Gruneisen, stiffened) this is the temperature that belongs to p: T ds = de + p dsv is exact
/// (Wallace, Thermodynamics of Crystals (1972); Steinberg's cold curve is the same one from T = 0).
/// Tillotson's p gives no such T: there gamma is taken as its low-energy limit a + b, good for e below a tenth of E0.
/// The isentrope is a power series (setThermalCurve); eta is held within [least_eta, largest_eta] in it. Melting takes
/// no heat.
template <class T>
KOKKOS_INLINE_FUNCTION T temperature(Material const &m, T specific_volume, T internal_energy)
{
  ThermalCurve const &c = m.thermal;
  T const eta = Math::max(T(c.least_eta), Math::min(T(1.0 - m.density0 * specific_volume), T(c.largest_eta)));
  T compression = c.compression[num_thermal_terms - 1];
  T expansion = c.expansion[num_thermal_terms - 1];
  for (int k = num_thermal_terms - 2; k >= 0; --k)
  {
    compression = compression * eta + c.compression[k];
    expansion = expansion * eta + c.expansion[k];
  }
  return internal_energy * (1.0 / c.heat_capacity) + select(eta > T(0.0), compression, expansion);
}

namespace detail
{

/// Series of the isentrope: (1 - gamma_eta eta) g' = gamma0 g + source, g(0) = 0, and the same for T_s without source.
///
/// gamma_eta = 0: gamma rho is constant, gamma dsv / sv = -gamma0 deta; 1: gamma is, gamma dsv / sv = -gamma deta /
/// (1 - eta). `source`: coefficients of sv0 p at g = e_s - energy0 = 0, times (1 - gamma_eta eta).
inline void isentropeSeries(double gamma0, double gamma_eta, double const source[num_thermal_terms], double energy0,
                            ThermalCurve const &thermal, double curve[num_thermal_terms])
{
  double g = 0.0, t = thermal.reference_temperature;
  curve[0] = t - energy0 / thermal.heat_capacity;
  for (int k = 0; k + 1 < num_thermal_terms; ++k)
  {
    g = ((gamma0 + k * gamma_eta) * g + source[k]) / (k + 1);
    t = (gamma0 + k * gamma_eta) * t / (k + 1);
    curve[k + 1] = t - g / thermal.heat_capacity;
  }
}

} // namespace detail

/// Give a law its temperature; the equation of state is set. \param heat_capacity c_v > 0 [J/(kg K)].
/// \param reference_temperature Of density0, energy0 [K].
inline void setThermalCurve(Material &m, double heat_capacity, double reference_temperature)
{
  ThermalCurve &thermal = m.thermal;
  thermal.heat_capacity = heat_capacity;
  thermal.reference_temperature = reference_temperature;
  if (m.eos == EosKind::IdealGas) // T = e / c_v
    return;
  bool const mie = m.eos == EosKind::MieGruneisen, tillotson = m.eos == EosKind::Tillotson;
  // The series of 1 / (1 - s eta)^2 converges slowly towards the pole: at 0.6 of the way it is good to 1 per cent.
  thermal.least_eta = -0.3;
  thermal.largest_eta = mie && m.slope > 0.0 ? Math::min(0.6, 0.6 / m.slope) : 0.5;
  // sv0 p at g = e - e0 = 0, times (1 - eta) where gamma is constant: coefficients of eta^k
  double const c2 = m.sound_speed0 * m.sound_speed0;
  double const quadratic = tillotson ? m.tillotson.quadratic / m.density0 : 0.0;
  double const gamma = tillotson ? m.tillotson.a + m.tillotson.b : m.gruneisen;
  double compression[num_thermal_terms] = {}, expansion[num_thermal_terms] = {};
  double power = 1.0, last_power = 0.0; // s^(k-1), s^(k-2)
  for (int k = 1; k < num_thermal_terms; ++k)
  {
    if (mie)
    {
      // p_H (1 - gamma0 eta / 2), p_H = rho0 c0^2 sum k s^(k-1) eta^k; in expansion c0^2 (rho - rho0)
      compression[k] = c2 * (k * power - 0.5 * gamma * (k - 1) * last_power);
      expansion[k] = c2;
    }
    else
      compression[k] = expansion[k] = (k == 1 ? c2 : 0.0) + (k > 1 ? quadratic : 0.0);
    last_power = power;
    power *= m.slope;
  }
  detail::isentropeSeries(gamma, mie ? 0.0 : 1.0, compression, m.energy0, thermal, thermal.compression);
  detail::isentropeSeries(gamma, mie ? 0.0 : 1.0, expansion, m.energy0, thermal, thermal.expansion);
}

} // namespace Harmos

#endif
