// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BONDED_PLACES_HPP
#define HARMOS_BONDED_PLACES_HPP

#include <Harmos_BondBins.hpp>
#include <Harmos_ConstraintOptions.hpp>

namespace Harmos
{

/// Where bodies are bonded: without a strength everywhere, with one around bonds that are whole. Elsewhere what has
/// broken, and what was apart at the start, slides.
struct BondedPlaces
{
  View<PairInteraction **> interaction;
  BondBins bonds;

  /// Number of the nearest bond of two materials within bond_reach cells of a point; -1: none.
  /// \param cell_size At the point [length].
  KOKKOS_INLINE_FUNCTION int nearest(Vector2 const &point, double cell_size, int a, int b) const
  {
    return bonds.nearest(point, bond_reach * cell_size, Math::min(a, b), Math::max(a, b));
  }

  /// Whether two materials are bonded at a point; none with a wall (b < 0) is.
  KOKKOS_INLINE_FUNCTION bool at(Vector2 const &point, double cell_size, int a, int b) const
  {
    if (a < 0 || b < 0 || interaction(a, b).kind != Interaction::Bonded)
      return false;
    if (!interaction(a, b).strength.limited())
      return true;
    int const bond = nearest(point, cell_size, a, b);
    return bond >= 0 && !bonds.bond(bond).broken;
  }
};

} // namespace Harmos

#endif
