// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SELECT_HPP
#define HARMOS_SELECT_HPP

#include <Harmos_Pack.hpp>

namespace Harmos
{

/// \defgroup ValueType Physics is written once on a value type T: double, or a pack of doubles that share a material.
///
/// Pack (Harmos_Pack.hpp) has overloads of this one, of select and of Math::sqrt, Math::min, Math::max; its comparisons
/// return a mask.
/// \{

/// Whether any lane holds: lets a rare path be skipped.
KOKKOS_INLINE_FUNCTION bool any(bool condition)
{
  return condition;
}
/// \}

} // namespace Harmos

#endif
