// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MATERIAL_HPP
#define HARMOS_MATERIAL_HPP

#include <Harmos_Kokkos.hpp>

namespace Harmos
{

enum class EosKind : int
{
  Stiffened,    // p = rho0 c0^2 (rho/rho0 - 1) + gamma0 rho (e - e0) : linear for gamma0 = 0
  MieGruneisen, // Us = c0 + s up, gamma rho = gamma0 rho0
  IdealGas,     // p = (gamma - 1) rho e
  Tillotson     // solid, mixture and vapour (TillotsonLaw)
};

enum class StrengthKind : int
{
  None,
  Elastic,
  Plastic,        // von Mises, yield = yield0 + hardening * eps (hardening = 0: perfectly plastic)
  PowerHardening, // the laws from here on: flowStress (Harmos_FlowStress.hpp)
  JohnsonCook,
  SteinbergGuinan
};

/// What the flow stress depends on beside Material::yield and hardening; see flowStress.
struct FlowLaw
{
  double hardening_exponent = 1.0;      // n
  double rate_coefficient = 0.0;        // C
  double reference_rate = 1.0;          // [1/s]
  double softening_exponent = 1.0;      // m
  double melting_temperature = 1e300;   // at the reference density [K]
  double initial_strain = 0.0;          // eps_i
  double largest_yield = 1e300;         // of the work hardening [Pa]
  double pressure_coefficient = 0.0;    // A [1/Pa]
  double temperature_coefficient = 0.0; // B [1/K]
  double melting_exponent = 0.0;        // a
};

/// A stress that is never reached.
constexpr double no_limit = 1e300;

/// When a pair fails (Harmos_Failure.hpp): a failed one carries neither tension nor shear.
struct FailureLaw
{
  double spall_pressure = no_limit; // at p <= -spall_pressure [Pa]
  double spall_stress = no_limit;   // at a largest principal stress >= spall_stress [Pa]
  bool damages = false;             // Johnson-Cook damage, needs a temperature
  double d[5] = {};                 // D1 .. D5 of it
};

/// Tillotson, General Atomic report GA-3216 (1962). Material::sound_speed0 is sqrt(bulk / density0).
struct TillotsonLaw
{
  double a = 0.0, b = 0.0;
  double bulk = 0.0;      // A [Pa]
  double quadratic = 0.0; // B [Pa]
  double alpha = 0.0, beta = 0.0;
  double energy = 0.0;    // E0 [J/kg]
  double incipient = 0.0; // E_iv: vaporisation begins [J/kg]
  double complete = 0.0;  // E_cv: all is vapour [J/kg]
};

/// Terms eta^0 ... of the series in ThermalCurve.
constexpr int num_thermal_terms = 14;

/// T = e / c_v + sum_k curve_k eta^k, eta = 1 - rho0 sv (Harmos_Temperature.hpp); heat_capacity 0: not known.
struct ThermalCurve
{
  double heat_capacity = 0.0;         // c_v [J/(kg K)]
  double reference_temperature = 0.0; // of density0, energy0 [K]
  double least_eta = 0.0, largest_eta = 0.0;
  double compression[num_thermal_terms] = {}; // [K]
  double expansion[num_thermal_terms] = {};
};

/// A material law, as the kernels see it. SI units.
struct Material
{
  EosKind eos = EosKind::Stiffened;
  StrengthKind strength = StrengthKind::None;
  double density0 = 0.0;        // [kg/m^3]
  double sound_speed0 = 0.0;    // c0 [m/s]
  double slope = 0.0;           // s
  double gruneisen = 0.0;       // gamma0; ideal gas: gamma
  double energy0 = 0.0;         // internal energy of the reference state [J/kg]
  double shear_modulus = 0.0;   // G [Pa]
  double yield = 0.0;           // [Pa]
  double hardening = 0.0;       // [Pa]; Steinberg-Guinan: beta
  double tension_limit = 1e300; // pressure does not fall below -tension_limit [Pa]
  int rigid_body = -1;          // number of the rigid body that this material is; -1: deformable
  FlowLaw flow;
  FailureLaw failure;
  TillotsonLaw tillotson;
  ThermalCurve thermal;
};

/// Whether a material deforms without shear strength.
KOKKOS_INLINE_FUNCTION bool isFluid(Material const &material)
{
  return material.rigid_body < 0 && material.strength == StrengthKind::None;
}

} // namespace Harmos

#endif
