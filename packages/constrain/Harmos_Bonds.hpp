// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BONDS_HPP
#define HARMOS_BONDS_HPP

#include <Harmos_Vector.hpp>

#include <vector>

namespace Harmos
{

/// Largest tractions of a bond; 0: without limit.
struct BondStrength
{
  double tensile = 0.0; // [Pa]
  double shear = 0.0;   // [Pa]

  KOKKOS_INLINE_FUNCTION bool limited() const { return tensile > 0.0 || shear > 0.0; }
};

/// A point of a bonded interface that can break. It moves with material_a; what is bonded around it is what lies nearer
/// to it than to any other bond of the two materials. All ranks hold all bonds alike. (doc/decisions/0007)
struct Bond
{
  Vector2 point = {0.0, 0.0};           // [length]
  int material_a = -1, material_b = -1; // a < b
  bool broken = false;                  // for good
  double cell_size = 0.0;               // where it stood at the start [length]
  double transit = 0.0;                 // a wave takes so long through a cell there; 0: not known [s]
  Vector2 traction = {0.0, 0.0};        // along n, negative in tension, and across it: mean over about this time [Pa]
};

/// What the rows around a bond carry: sums over them.
struct BondLoad
{
  double normal = 0.0;     // impulse along n, negative in tension [N s/m]
  double tangential = 0.0; // across n [N s/m]
  double length = 0.0;     // of the rows' segments [length]
  bool snapped = false;    // between rigid bodies: it broke before the cycle's impulses were found
};

/// Farthest that a bond reaches. [cell sizes]
constexpr double bond_reach = 2.0;

/// Widest gap that a bond holds across; wider ones are void between two bodies. [cell sizes]
constexpr double bond_gap = 0.1;

/// traction += min(1, kick / transit) (load / (kick length) - traction). The impulse that stops the nodes beside a
/// joint at an impact is set by their masses, whatever the step: over one step it is no traction, over the time in
/// which a wave passes their cell it is rho c V.
void carry(BondLoad const &load, double kick, Bond &bond);

/// True where (t_n / tensile)^2 + (t_t / shear)^2 >= 1, t_n in tension alone; a strength of 0 has no part.
bool breaks(Vector2 const &traction, BondStrength const &strength);

} // namespace Harmos

#endif
