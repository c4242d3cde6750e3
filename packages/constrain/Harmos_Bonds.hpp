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
};

/// What the rows around a bond carry: sums over them.
struct BondLoad
{
  double normal = 0.0;     // impulse along n, negative in tension [N s/m]
  double tangential = 0.0; // across n [N s/m]
  double length = 0.0;     // of the rows' segments [length]
};

/// Farthest that a bond reaches. [cell sizes]
constexpr double bond_reach = 2.0;

/// Widest gap that a bond holds across; wider ones are void between two bodies. [cell sizes]
constexpr double bond_gap = 0.1;

/// True where (t_n / tensile)^2 + (t_t / shear)^2 >= 1 with the mean tractions t = load / (dt length), t_n in tension
/// alone; a strength of 0 has no part.
bool breaks(BondLoad const &load, BondStrength const &strength, double dt);

} // namespace Harmos

#endif
