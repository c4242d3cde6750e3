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
  IdealGas      // p = (gamma - 1) rho e
};

enum class StrengthKind : int
{
  None,
  Elastic,
  Plastic // von Mises, yield = yield0 + hardening * eps (hardening = 0: perfectly plastic)
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
  double hardening = 0.0;       // [Pa]
  double tension_limit = 1e300; // pressure does not fall below -tension_limit [Pa]
  int rigid_body = -1;          // number of the rigid body that this material is; -1: deformable
};

} // namespace Harmos

#endif
