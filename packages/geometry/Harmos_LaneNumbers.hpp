// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LANE_NUMBERS_HPP
#define HARMOS_LANE_NUMBERS_HPP

#include <Harmos_Pack.hpp>

#include <utility>

namespace Harmos
{

// Whether what a pack works on lies one after the other: many numbers to look at, so that they are compared as vectors.

#ifdef HARMOS_VECTOR_TYPES
/// A number for each lane of a pack.
typedef int LaneNumbers __attribute__((vector_size(pack_width * sizeof(int))));
/// A number for each corner of a cell.
typedef int CornerNumbers __attribute__((vector_size(4 * sizeof(int))));

namespace Detail
{
typedef int UnalignedLanes __attribute__((vector_size(pack_width * sizeof(int)), aligned(sizeof(int)), may_alias));
typedef int UnalignedCorners __attribute__((vector_size(4 * sizeof(int)), aligned(sizeof(int)), may_alias));

KOKKOS_FORCEINLINE_FUNCTION CornerNumbers loadCorners(int const *x)
{
  return *reinterpret_cast<UnalignedCorners const *>(x);
}

template <int... Lane>
KOKKOS_FORCEINLINE_FUNCTION LaneNumbers laneCount(std::integer_sequence<int, Lane...>)
{
  return LaneNumbers{Lane...};
}

} // namespace Detail

/// From pack_width numbers on: lane l's.
KOKKOS_FORCEINLINE_FUNCTION LaneNumbers loadNumbers(int const *x)
{
  return *reinterpret_cast<Detail::UnalignedLanes const *>(x);
}
/// x, x + step, x + 2 step, ...
KOKKOS_FORCEINLINE_FUNCTION LaneNumbers countFrom(int x, int step)
{
  return x + step * Detail::laneCount(std::make_integer_sequence<int, pack_width>());
}
/// Whether any is not zero.
KOKKOS_FORCEINLINE_FUNCTION bool anySet(LaneNumbers const &numbers)
{
  typedef long long Pairs __attribute__((vector_size(pack_width * sizeof(int))));
  Pairs const pairs = (Pairs)numbers;
  long long all = 0;
  for (int i = 0; i < pack_width / 2; ++i)
    all |= pairs[i];
  return all != 0;
}

/// Of pack_width rows of four, one after the other: zero in the columns that count upwards by `step`.
KOKKOS_FORCEINLINE_FUNCTION CornerNumbers differencesFromCount(int const *rows, int step)
{
  CornerNumbers expected = Detail::loadCorners(rows), differs = {};
  for (int lane = 1; lane < pack_width; ++lane)
  {
    expected += step;
    differs |= Detail::loadCorners(rows + 4 * lane) ^ expected;
  }
  return differs;
}
/// Whether all columns of such rows do.
KOKKOS_FORCEINLINE_FUNCTION bool cornersCountUp(int const *rows, int step)
{
  typedef long long Pairs __attribute__((vector_size(4 * sizeof(int))));
  Pairs const differs = (Pairs)differencesFromCount(rows, step);
  return (differs[0] | differs[1]) == 0;
}
#else
using LaneNumbers = int;

struct CornerNumbers
{
  KOKKOS_FORCEINLINE_FUNCTION int operator[](int) const { return 0; } // of one row
};

KOKKOS_FORCEINLINE_FUNCTION LaneNumbers loadNumbers(int const *x)
{
  return *x;
}
KOKKOS_FORCEINLINE_FUNCTION LaneNumbers countFrom(int x, int)
{
  return x;
}
KOKKOS_FORCEINLINE_FUNCTION bool anySet(LaneNumbers numbers)
{
  return numbers != 0;
}
KOKKOS_FORCEINLINE_FUNCTION CornerNumbers differencesFromCount(int const *, int)
{
  return {};
}
KOKKOS_FORCEINLINE_FUNCTION bool cornersCountUp(int const *, int)
{
  return true;
}
#endif

/// `b`, of which the compiler knows nothing: where it is asked twice, what lies between is not compiled once for each
/// answer. The two copies might round differently, and results depend on how cells are grouped.
KOKKOS_FORCEINLINE_FUNCTION bool opaque(bool b)
{
#ifdef HARMOS_VECTOR_TYPES
  int i = b ? 1 : 0;
  __asm__ volatile("" : "+r"(i));
  return i != 0;
#else
  return b;
#endif
}

/// Whether pack_width numbers count upwards one by one.
KOKKOS_FORCEINLINE_FUNCTION bool countsUp(int const *numbers)
{
  return !anySet(loadNumbers(numbers) ^ countFrom(numbers[0], 1));
}

} // namespace Harmos

#endif
