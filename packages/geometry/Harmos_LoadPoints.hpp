// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LOAD_POINTS_HPP
#define HARMOS_LOAD_POINTS_HPP

#include <Harmos_LaneNumbers.hpp>
#include <Harmos_Pack.hpp>
#include <Harmos_RowPointer.hpp>

#include <utility>

namespace Harmos
{

#if defined(HARMOS_VECTOR_TYPES) && defined(__AVX__) && (defined(__clang__) || __GNUC__ >= 12)
#define HARMOS_PAIRED_LOADS
#endif

#ifdef HARMOS_PAIRED_LOADS
namespace Detail
{
typedef double Two __attribute__((vector_size(16)));
typedef double UnalignedTwo __attribute__((vector_size(16), aligned(sizeof(double)), may_alias));
typedef double Four __attribute__((vector_size(32)));

KOKKOS_FORCEINLINE_FUNCTION Two loadTwo(double const *x)
{
  return *reinterpret_cast<UnalignedTwo const *>(x);
}

KOKKOS_FORCEINLINE_FUNCTION void storeTwo(double *x, Two const &two)
{
  *reinterpret_cast<UnalignedTwo *>(x) = two;
}

KOKKOS_FORCEINLINE_FUNCTION Four joined(Two const &a, Two const &b)
{
  return __builtin_shufflevector(a, b, 0, 1, 2, 3);
}

/// The rows of every second lane, one after the other.
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION Pack::Lanes everySecondRow(Row const &row, int first)
{
#if defined(__AVX512F__)
  return __builtin_shufflevector(joined(loadTwo(row(first)), loadTwo(row(first + 2))),
                                 joined(loadTwo(row(first + 4)), loadTwo(row(first + 6))), 0, 1, 2, 3, 4, 5, 6, 7);
#else
  return joined(loadTwo(row(first)), loadTwo(row(first + 2)));
#endif
}

/// a[0], b[0], a[2], b[2], ... with Odd = 0; a[1], b[1], a[3], b[3], ... with 1.
template <int Odd, int... Lane>
KOKKOS_FORCEINLINE_FUNCTION Pack::Lanes interleaved(Pack::Lanes const &a, Pack::Lanes const &b,
                                                    std::integer_sequence<int, Lane...>)
{
  return __builtin_shufflevector(a, b, ((Lane & 1) == 0 ? Lane + Odd : pack_width + Lane - 1 + Odd)...);
}

/// Lane l is number 2 l + Odd of a's and b's lanes, one after the other.
template <int Odd, int... Lane>
KOKKOS_FORCEINLINE_FUNCTION Pack::Lanes everySecondLane(Pack::Lanes const &a, Pack::Lanes const &b,
                                                        std::integer_sequence<int, Lane...>)
{
  return __builtin_shufflevector(a, b, (2 * Lane + Odd)...);
}

/// Lanes First + l / 2 of a where l is even, of b where it is odd.
template <int First, int... Lane>
KOKKOS_FORCEINLINE_FUNCTION Pack::Lanes alternating(Pack::Lanes const &a, Pack::Lanes const &b,
                                                    std::integer_sequence<int, Lane...>)
{
  return __builtin_shufflevector(a, b, (First + Lane / 2 + (Lane % 2) * pack_width)...);
}

using LaneNumbers = std::make_integer_sequence<int, pack_width>;
} // namespace Detail
#endif

/// Rows of two values into packs: lane l of x, y is row(l)[0], row(l)[1]. Both of a row by one load.
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION void loadPoints(Row const &row, Pack &x, Pack &y)
{
#ifdef HARMOS_PAIRED_LOADS
  Pack::Lanes const even = Detail::everySecondRow(row, 0), odd = Detail::everySecondRow(row, 1);
  x = Pack(Detail::interleaved<0>(even, odd, Detail::LaneNumbers()));
  y = Pack(Detail::interleaved<1>(even, odd, Detail::LaneNumbers()));
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
  Pack::Lanes const even = Detail::interleaved<0>(x.lanes, y.lanes, Detail::LaneNumbers());
  Pack::Lanes const odd = Detail::interleaved<1>(x.lanes, y.lanes, Detail::LaneNumbers());
  Detail::storeTwo(row(0), __builtin_shufflevector(even, even, 0, 1));
  Detail::storeTwo(row(1), __builtin_shufflevector(odd, odd, 0, 1));
  Detail::storeTwo(row(2), __builtin_shufflevector(even, even, 2, 3));
  Detail::storeTwo(row(3), __builtin_shufflevector(odd, odd, 2, 3));
#if defined(__AVX512F__)
  Detail::storeTwo(row(4), __builtin_shufflevector(even, even, 4, 5));
  Detail::storeTwo(row(5), __builtin_shufflevector(odd, odd, 4, 5));
  Detail::storeTwo(row(6), __builtin_shufflevector(even, even, 6, 7));
  Detail::storeTwo(row(7), __builtin_shufflevector(odd, odd, 6, 7));
#endif
#else
  for (int lane = 0; lane < pack_width; ++lane)
  {
    row(lane)[0] = laneOf(x, lane);
    row(lane)[1] = laneOf(y, lane);
  }
#endif
}

/// loadPoints of rows that lie one after the other from `first` on.
KOKKOS_FORCEINLINE_FUNCTION void loadPointRun(double const *first, Pack &x, Pack &y)
{
#ifdef HARMOS_PAIRED_LOADS
  Pack const a = loadPack(first), b = loadPack(first + pack_width);
  x = Pack(Detail::everySecondLane<0>(a.lanes, b.lanes, Detail::LaneNumbers()));
  y = Pack(Detail::everySecondLane<1>(a.lanes, b.lanes, Detail::LaneNumbers()));
#else
  loadPoints([&](int lane) { return first + 2 * lane; }, x, y);
#endif
}

/// Its inverse.
KOKKOS_FORCEINLINE_FUNCTION void storePointRun(double *first, Pack const &x, Pack const &y)
{
#ifdef HARMOS_PAIRED_LOADS
  storePack(first, Pack(Detail::alternating<0>(x.lanes, y.lanes, Detail::LaneNumbers())));
  storePack(first + pack_width, Pack(Detail::alternating<pack_width / 2>(x.lanes, y.lanes, Detail::LaneNumbers())));
#else
  storePoints([&](int lane) { return first + 2 * lane; }, x, y);
#endif
}

/// The corners of a pack's cells, their nodes; or of its pairs, their dof nodes.
struct PackedCornerRows
{
  RowPointer<int, 4> corner;
  int const *index; // of the lanes
  bool count_up;    // the corners of lane l are those of lane 0, each plus l

  /// \param run Whether the indices count upwards one by one.
  KOKKOS_FORCEINLINE_FUNCTION PackedCornerRows(RowPointer<int, 4> const &corners, int const indices[pack_width],
                                               bool run)
      : corner(corners), index(indices), count_up(run && cornersCountUp(corners.row(indices[0]), 1))
  {
  }
};

/// Values at corner k. Where corners count upwards they are loaded in one go.
KOKKOS_FORCEINLINE_FUNCTION void loadCorner(PackedCornerRows const &rows, RowPointer<double, 2> const &value, int k,
                                            Pack &x, Pack &y)
{
  if (opaque(rows.count_up))
    loadPointRun(value.row(rows.corner(rows.index[0], k)), x, y);
  else
    loadPoints([&](int lane) { return value.row(rows.corner(rows.index[lane], k)); }, x, y);
}

/// loadRows of the rows `index`, which count upwards one by one in a run.
KOKKOS_FORCEINLINE_FUNCTION void loadIndexedRows(RowPointer<double, 8> const &rows, int const index[pack_width],
                                                 bool run, Pack (&field)[8])
{
  double const *first = rows.row(index[0]);
  if (opaque(run))
    loadRows([&](int lane) { return first + 8 * lane; }, field);
  else
    loadRows([&](int lane) { return rows.row(index[lane]); }, field);
}

/// Its inverse, for the lanes whose bit is set.
KOKKOS_FORCEINLINE_FUNCTION void storeIndexedRows(Pack const (&field)[8], unsigned lanes,
                                                  RowPointer<double, 8> const &rows, int const index[pack_width],
                                                  bool run)
{
  double *first = rows.row(index[0]);
  if (opaque(run && lanes == all_lanes))
    storeRows(field, all_lanes, [&](int lane) { return first + 8 * lane; });
  else
    storeRows(field, lanes, [&](int lane) { return rows.row(index[lane]); });
}

} // namespace Harmos

#endif
