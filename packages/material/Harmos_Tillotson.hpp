// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TILLOTSON_HPP
#define HARMOS_TILLOTSON_HPP

#include <Harmos_Material.hpp>
#include <Harmos_Select.hpp>

namespace Harmos
{

template <class T>
struct EosState
{
  T pressure;            // [Pa], positive in compression
  T sound_speed_squared; // bulk, isentropic: c^2 = dp/drho|_e + (p / rho^2) dp/de|_rho [m^2/s^2]
};

namespace detail
{

/// Pressure with its derivatives.
struct TillotsonPressure
{
  double p;
  double by_rho; // at constant e
  double by_e;   // at constant rho
};

/// p = (a + b / w) rho e + A mu + B mu^2, w = 1 + e / (E0 eta^2), eta = rho / rho0, mu = eta - 1.
KOKKOS_INLINE_FUNCTION TillotsonPressure tillotsonSolid(Material const &m, double rho, double e)
{
  TillotsonLaw const &t = m.tillotson;
  double const eta = rho / m.density0, mu = eta - 1.0;
  double const x = e / (t.energy * eta * eta); // w - 1; dx/drho = -2 x / rho
  double const w = 1.0 / (1.0 + x);
  return {(t.a + t.b * w) * rho * e + t.bulk * mu + t.quadratic * mu * mu,
          (t.a + t.b * w + 2.0 * t.b * x * w * w) * e + (t.bulk + 2.0 * t.quadratic * mu) / m.density0,
          (t.a + t.b * w - t.b * x * w * w) * rho};
}

/// p = a rho e + (b rho e / w + A mu exp(-beta z)) exp(-alpha z^2), z = 1 / eta - 1.
KOKKOS_INLINE_FUNCTION TillotsonPressure tillotsonVapour(Material const &m, double rho, double e)
{
  TillotsonLaw const &t = m.tillotson;
  double const eta = rho / m.density0, mu = eta - 1.0;
  double const x = e / (t.energy * eta * eta);
  double const w = 1.0 / (1.0 + x);
  double const z = 1.0 / eta - 1.0;
  double const z_rho = -1.0 / (eta * rho);
  double const decay = Math::exp(-t.alpha * z * z);
  double const cold = t.bulk * Math::exp(-t.beta * z);
  double const inner = t.b * w * rho * e + cold * mu;
  double const inner_rho = (t.b * w + 2.0 * t.b * x * w * w) * e + cold * (1.0 / m.density0 - t.beta * mu * z_rho);
  return {t.a * rho * e + inner * decay, t.a * e + (inner_rho - 2.0 * t.alpha * z * z_rho * inner) * decay,
          (t.a + (t.b * w - t.b * x * w * w) * decay) * rho};
}

/// Solid where dense (rho >= rho0) or cold (e <= E_iv); vapour where expanded and e >= E_cv; between both linear in e.
KOKKOS_INLINE_FUNCTION TillotsonPressure tillotsonPressure(Material const &m, double rho, double e)
{
  TillotsonLaw const &t = m.tillotson;
  if (rho >= m.density0 || e <= t.incipient)
    return tillotsonSolid(m, rho, e);
  TillotsonPressure const vapour = tillotsonVapour(m, rho, e);
  if (e >= t.complete)
    return vapour;
  TillotsonPressure const solid = tillotsonSolid(m, rho, e);
  double const part = (e - t.incipient) / (t.complete - t.incipient);
  return {solid.p + part * (vapour.p - solid.p), solid.by_rho + part * (vapour.by_rho - solid.by_rho),
          solid.by_e + part * (vapour.by_e - solid.by_e) + (vapour.p - solid.p) / (t.complete - t.incipient)};
}

/// Tillotson, Metallic equations of state for hypervelocity impact, General Atomic GA-3216 (1962); the regions as
/// Melosh, Impact Cratering (1989), appendix II.
template <class T>
HARMOS_RARE_FUNCTION EosState<T> tillotson(Material const &m, T specific_volume, T internal_energy)
{
  TillotsonPressure at[Lanes<T>::width];
  for (int lane = 0; lane < Lanes<T>::width; ++lane)
    at[lane] = tillotsonPressure(m, 1.0 / laneOf(specific_volume, lane), laneOf(internal_energy, lane));
  T const p = Lanes<T>::of([&](int lane) { return at[lane].p; });
  T const by_rho = Lanes<T>::of([&](int lane) { return at[lane].by_rho; });
  T const by_e = Lanes<T>::of([&](int lane) { return at[lane].by_e; });
  return {p, by_rho + p * specific_volume * specific_volume * by_e};
}

} // namespace detail
} // namespace Harmos

#endif
