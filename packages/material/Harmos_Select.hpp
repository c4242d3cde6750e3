// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SELECT_HPP
#define HARMOS_SELECT_HPP

#include <Harmos_Pack.hpp>

namespace Harmos
{

/// \defgroup ValueType Physics is written once on a value type T: double, or a pack of doubles that share a material.
///
/// Pack (Harmos_Pack.hpp) has overloads of these two and of Math::sqrt, Math::min, Math::max; its comparisons return a
/// mask.
/// \{

/// condition ? a : b, lane by lane.
KOKKOS_INLINE_FUNCTION double select(bool condition, double a, double b)
{
  return condition ? a : b;
}

/// Whether any lane holds: lets a rare path be skipped.
KOKKOS_INLINE_FUNCTION bool any(bool condition)
{
  return condition;
}
/// \}

} // namespace Harmos

#endif
