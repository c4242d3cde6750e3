// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FLOW_STRESS_HPP
#define HARMOS_FLOW_STRESS_HPP

#include <Harmos_EquationOfState.hpp>
#include <Harmos_Temperature.hpp>

namespace Harmos
{

/// Whether the yield stress follows one of the laws of flowStress, whose surface is not linear in the strain alone.
KOKKOS_INLINE_FUNCTION bool hasFlowLaw(Material const &m)
{
  return m.strength > StrengthKind::Plastic;
}

struct FlowStress
{
  double stress;    // [Pa]
  double by_strain; // d stress / d increment at increment / dt [Pa]
};

/// Flow stress after an increment of equivalent plastic strain within dt, f the factor of softening:
///  - power hardening: Y = Y0 + B eps^n (f = 1);
///  - Johnson & Cook, 7th Int. Symp. Ballistics (1983) 541: Y = (A + B eps^n) (1 + C ln max(r / r0, 1)) f,
///    r = increment / dt the plastic strain rate;
///  - Steinberg, Cochran & Guinan, J. Appl. Phys. 51 (1980) 1498: Y = min(Y0 (1 + beta (eps + eps_i))^n, Y_max) f.
/// \param strain At the end of the increment.
KOKKOS_INLINE_FUNCTION FlowStress flowStress(Material const &m, double strain, double increment, double dt, double f)
{
  FlowLaw const &law = m.flow;
  if (m.strength == StrengthKind::SteinbergGuinan)
  {
    double const base = 1.0 + m.hardening * (strain + law.initial_strain);
    double const work = m.yield * Math::pow(base, law.hardening_exponent);
    bool const hardens = work < law.largest_yield;
    return {f * (hardens ? work : law.largest_yield),
            hardens ? f * work * law.hardening_exponent * m.hardening / base : 0.0};
  }
  double const power = strain > 0.0 ? m.hardening * Math::pow(strain, law.hardening_exponent) : 0.0;
  double const work = f * (m.yield + power);
  double const slope = strain > 0.0 ? f * power * law.hardening_exponent / strain : 0.0;
  double const ratio = increment / (law.reference_rate * dt);
  if (law.rate_coefficient == 0.0 || !(ratio > 1.0))
    return {work, slope};
  double const rate = 1.0 + law.rate_coefficient * Math::log(ratio);
  return {work * rate, slope * rate + work * law.rate_coefficient / increment};
}

/// Melting temperature of Steinberg-Guinan (Lindemann's law, gamma = gamma0 / x):
/// T_m = T_m0 exp(2 a (1 - 1/x)) x^(2 (gamma0 - a - 1/3)), x = rho / rho0. Steinberg, UCRL-MA-106439 (1996).
KOKKOS_INLINE_FUNCTION double meltingTemperature(Material const &m, double compression)
{
  FlowLaw const &law = m.flow;
  return law.melting_temperature * Math::exp(2.0 * law.melting_exponent * (1.0 - 1.0 / compression)) *
         Math::pow(compression, 2.0 * (m.gruneisen - law.melting_exponent - 1.0 / 3.0));
}

/// The factor f of flowStress, which is zero where the material has melted (1 for power hardening):
///  - Johnson-Cook: 1 - T*^m, T* = (T - T0) / (T_m - T0) held within [0, 1];
///  - Steinberg-Guinan: G / G0 = 1 + A p x^(-1/3) - B (T - 300 K), x = rho / rho0, not below 0; 0 from T_m on.
KOKKOS_INLINE_FUNCTION double softening(Material const &m, double compression, double pressure, double temperature)
{
  FlowLaw const &law = m.flow;
  if (m.strength == StrengthKind::JohnsonCook)
  {
    double const t0 = m.thermal.reference_temperature;
    double const homologous = (temperature - t0) / (law.melting_temperature - t0);
    return homologous <= 0.0 ? 1.0 : homologous >= 1.0 ? 0.0 : 1.0 - Math::pow(homologous, law.softening_exponent);
  }
  if (m.strength != StrengthKind::SteinbergGuinan)
    return 1.0;
  // half of T_m0 is below T_m(x >= 0.9) for any gamma0 < 3.5
  bool const cold = temperature < 0.5 * law.melting_temperature && compression >= 0.9;
  if (!cold && temperature >= meltingTemperature(m, compression))
    return 0.0;
  return Math::max(1.0 + law.pressure_coefficient * pressure * Math::pow(compression, -1.0 / 3.0) -
                       law.temperature_coefficient * (temperature - 300.0),
                   0.0);
}

/// softening at a specific volume and energy; p and T by the equation of state.
template <class T>
HARMOS_RARE_FUNCTION T softeningAt(Material const &m, T specific_volume, T internal_energy)
{
  if (m.strength == StrengthKind::PowerHardening)
    return T(1.0);
  T const hot = temperature(m, specific_volume, internal_energy);
  T const p = m.strength == StrengthKind::SteinbergGuinan
                  ? equationOfState(m, specific_volume, internal_energy).pressure
                  : T(0.0);
  return Lanes<T>::of(
      [&](int lane)
      { return softening(m, 1.0 / (m.density0 * laneOf(specific_volume, lane)), laneOf(p, lane), laneOf(hot, lane)); });
}

/// Shear modulus [Pa]: G0, without strength 0, Steinberg-Guinan G0 f; Johnson-Cook 0 where it has melted.
///
/// What is molten has no deviator: counted in the sound speed, G0 sv would bring the time step down wherever vapour
/// expands.
template <class T>
KOKKOS_INLINE_FUNCTION T shearModulus(Material const &m, T specific_volume, T internal_energy)
{
  if (m.strength == StrengthKind::JohnsonCook)
    return select(temperature(m, specific_volume, internal_energy) < T(m.flow.melting_temperature), T(m.shear_modulus),
                  T(0.0));
  if (m.strength != StrengthKind::SteinbergGuinan)
    return T(m.strength == StrengthKind::None ? 0.0 : m.shear_modulus);
  return m.shear_modulus * softeningAt(m, specific_volume, internal_energy);
}

/// Squared speed of longitudinal waves: c_L^2 = c_b^2 + 4 G / (3 rho); the bulk speed without strength.
template <class T>
KOKKOS_INLINE_FUNCTION T longitudinalSoundSpeedSquared(Material const &material, T bulk_squared, T specific_volume,
                                                       T internal_energy)
{
  return bulk_squared + (4.0 / 3.0) * (shearModulus(material, specific_volume, internal_energy) * specific_volume);
}

/// Increment of equivalent plastic strain within dt that takes a trial stress q back to the yield surface:
/// q - 3 G x = Y(eps + x, x / dt, f), x > 0; 0 where q is within Y(eps) at the lowest rate.
///
/// The rate is that of the increment itself (implicit): the stress after the step is the law's at the step's plastic
/// strain rate, however small dt is; a rate from the total strain would harden elastic waves too. Y is increasing in
/// x, so that the root is one. Newton's method within a bracket: q - 3 G x - Y is convex in x up to the kink at the
/// reference rate, so that from the left it cannot overshoot. Stops at 1e-11 q.
KOKKOS_INLINE_FUNCTION double plasticIncrement(Material const &m, double q, double strain, double dt, double f,
                                               double shear_modulus)
{
  double const static_yield = flowStress(m, strain, 0.0, dt, f).stress;
  if (!(q > static_yield) || !(shear_modulus > 0.0))
    return 0.0;
  double const three_g = 3.0 * shear_modulus;
  double low = 0.0, high = (q - static_yield) / three_g;
  double x = high;
  for (int i = 0; i < 60; ++i)
  {
    FlowStress const flow = flowStress(m, strain + x, x, dt, f);
    double const excess = q - three_g * x - flow.stress;
    if (Math::fabs(excess) <= 1e-11 * q)
      break;
    (excess > 0.0 ? low : high) = x;
    double const newton = x + excess / (three_g + flow.by_strain);
    x = newton > low && newton < high ? newton : (low > 0.0 ? 0.5 * (low + high) : 0.1 * high);
  }
  return x;
}

} // namespace Harmos

#endif
