// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SELECT_HPP
#define HARMOS_SELECT_HPP

#include <Harmos_Pack.hpp>

namespace Harmos
{

/// \defgroup ValueType Physics is written once on a value type T: double, or a pack of doubles that share a material.
///
/// Pack (Harmos_Pack.hpp) has overloads of these, of select and of Math::sqrt, Math::min, Math::max; its comparisons
/// return a mask.
/// \{

/// Whether any lane holds: lets a rare path be skipped.
KOKKOS_INLINE_FUNCTION bool any(bool condition)
{
  return condition;
}

/// T from value(0), value(1), ...: what has no vector form is done lane by lane.
template <class T>
struct Lanes
{
  static constexpr int width = 1;
  template <class Value>
  static KOKKOS_INLINE_FUNCTION T of(Value const &value)
  {
    return value(0);
  }
};

#ifdef HARMOS_VECTOR_TYPES
template <>
struct Lanes<Pack>
{
  static constexpr int width = pack_width;
  template <class Value>
  static KOKKOS_FORCEINLINE_FUNCTION Pack of(Value const &value)
  {
    return packOf(value);
  }
};
#endif
/// \}

} // namespace Harmos

#endif
