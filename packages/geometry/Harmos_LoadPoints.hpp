// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LOAD_POINTS_HPP
#define HARMOS_LOAD_POINTS_HPP

#include <Harmos_Pack.hpp>

namespace Harmos
{

#if defined(HARMOS_VECTOR_TYPES) && defined(__AVX__) && !defined(__AVX512F__) && (defined(__clang__) || __GNUC__ >= 12)
#define HARMOS_PAIRED_LOADS
#endif

#ifdef HARMOS_PAIRED_LOADS
namespace Detail
{
typedef double Two __attribute__((vector_size(16)));
typedef double UnalignedTwo __attribute__((vector_size(16), aligned(sizeof(double)), may_alias));

KOKKOS_FORCEINLINE_FUNCTION Two loadTwo(double const *x)
{
  return *reinterpret_cast<UnalignedTwo const *>(x);
}

KOKKOS_FORCEINLINE_FUNCTION void storeTwo(double *x, Two const &two)
{
  *reinterpret_cast<UnalignedTwo *>(x) = two;
}
} // namespace Detail
#endif

/// Rows of two values into packs: lane l of x, y is row(l)[0], row(l)[1]. Both of a row by one load.
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION void loadPoints(Row const &row, Pack &x, Pack &y)
{
#ifdef HARMOS_PAIRED_LOADS
  Pack::Lanes const even = __builtin_shufflevector(Detail::loadTwo(row(0)), Detail::loadTwo(row(2)), 0, 1, 2, 3);
  Pack::Lanes const odd = __builtin_shufflevector(Detail::loadTwo(row(1)), Detail::loadTwo(row(3)), 0, 1, 2, 3);
  x = Pack(__builtin_shufflevector(even, odd, 0, 4, 2, 6));
  y = Pack(__builtin_shufflevector(even, odd, 1, 5, 3, 7));
#else
  x = packOf([&](int lane) { return row(lane)[0]; });
  y = packOf([&](int lane) { return row(lane)[1]; });
#endif
}

/// Its inverse.
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION void storePoints(Row const &row, Pack const &x, Pack const &y)
{
#ifdef HARMOS_PAIRED_LOADS
  Pack::Lanes const even = __builtin_shufflevector(x.lanes, y.lanes, 0, 4, 2, 6);
  Pack::Lanes const odd = __builtin_shufflevector(x.lanes, y.lanes, 1, 5, 3, 7);
  Detail::storeTwo(row(0), __builtin_shufflevector(even, even, 0, 1));
  Detail::storeTwo(row(1), __builtin_shufflevector(odd, odd, 0, 1));
  Detail::storeTwo(row(2), __builtin_shufflevector(even, even, 2, 3));
  Detail::storeTwo(row(3), __builtin_shufflevector(odd, odd, 2, 3));
#else
  for (int lane = 0; lane < pack_width; ++lane)
  {
    row(lane)[0] = laneOf(x, lane);
    row(lane)[1] = laneOf(y, lane);
  }
#endif
}

} // namespace Harmos

#endif
