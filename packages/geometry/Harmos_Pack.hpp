// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PACK_HPP
#define HARMOS_PACK_HPP

#include <Harmos_Kokkos.hpp>

#include <utility>

namespace Harmos
{

// Compilers do not vectorise loops over cells whose body gathers through a connectivity. Their own vector type does it
// without intrinsics: as wide as the machine's registers (a wider one is many times slower than none). Device
// compilers have no such type; there a pack is a double.
#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__HIPCC__) && !defined(__SYCL_DEVICE_ONLY__)
#define HARMOS_VECTOR_TYPES
#endif

/// Marks a function that a kernel over all cells seldom calls: kept out of line, it takes no registers from the rest.
#ifdef HARMOS_VECTOR_TYPES
#define HARMOS_RARE_FUNCTION KOKKOS_FUNCTION __attribute__((noinline, cold))
#else
#define HARMOS_RARE_FUNCTION KOKKOS_FUNCTION
#endif

/// Before a short loop of constant length: its variables then stay in registers.
#if defined(__clang__) || defined(__CUDA_ARCH__)
#define HARMOS_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define HARMOS_UNROLL _Pragma("GCC unroll 8")
#else
#define HARMOS_UNROLL
#endif

#ifdef HARMOS_VECTOR_TYPES
#if defined(__AVX512F__)
constexpr int pack_width = 8;
#elif defined(__AVX__)
constexpr int pack_width = 4;
#else
constexpr int pack_width = 2;
#endif

/// One double for each of pack_width cells, with arithmetic lane by lane.
///
/// No operation mixes lanes: a lane's value does not depend on what the others hold, so that results do not depend on
/// how cells are grouped. Comparisons give a Mask.
struct Pack
{
  typedef double Lanes __attribute__((vector_size(pack_width * sizeof(double))));
  typedef double Unaligned
      __attribute__((vector_size(pack_width * sizeof(double)), aligned(sizeof(double)), may_alias));
  typedef long long Mask __attribute__((vector_size(pack_width * sizeof(long long))));

  Lanes lanes;

  Pack() = default;
  KOKKOS_FORCEINLINE_FUNCTION Pack(Lanes const &l) : lanes(l) {}
  KOKKOS_FORCEINLINE_FUNCTION Pack(double x) : lanes(x - Lanes{}) {}

  KOKKOS_FORCEINLINE_FUNCTION double operator[](int lane) const { return lanes[lane]; }

  KOKKOS_FORCEINLINE_FUNCTION Pack &operator+=(Pack const &b)
  {
    lanes += b.lanes;
    return *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION Pack &operator-=(Pack const &b)
  {
    lanes -= b.lanes;
    return *this;
  }
};

KOKKOS_FORCEINLINE_FUNCTION Pack operator-(Pack const &a)
{
  return Pack(-a.lanes);
}
KOKKOS_FORCEINLINE_FUNCTION Pack operator+(Pack const &a, Pack const &b)
{
  return Pack(a.lanes + b.lanes);
}
KOKKOS_FORCEINLINE_FUNCTION Pack operator-(Pack const &a, Pack const &b)
{
  return Pack(a.lanes - b.lanes);
}
KOKKOS_FORCEINLINE_FUNCTION Pack operator*(Pack const &a, Pack const &b)
{
  return Pack(a.lanes * b.lanes);
}
KOKKOS_FORCEINLINE_FUNCTION Pack operator/(Pack const &a, Pack const &b)
{
  return Pack(a.lanes / b.lanes);
}
KOKKOS_FORCEINLINE_FUNCTION Pack::Mask operator<(Pack const &a, Pack const &b)
{
  return a.lanes < b.lanes;
}
KOKKOS_FORCEINLINE_FUNCTION Pack::Mask operator>(Pack const &a, Pack const &b)
{
  return a.lanes > b.lanes;
}
KOKKOS_FORCEINLINE_FUNCTION Pack::Mask operator<=(Pack const &a, Pack const &b)
{
  return a.lanes <= b.lanes;
}
KOKKOS_FORCEINLINE_FUNCTION Pack::Mask operator==(Pack const &a, Pack const &b)
{
  return a.lanes == b.lanes;
}

KOKKOS_FORCEINLINE_FUNCTION Pack select(Pack::Mask const &condition, Pack const &a, Pack const &b)
{
  return Pack(condition ? a.lanes : b.lanes);
}
/// One bit a lane.
KOKKOS_FORCEINLINE_FUNCTION unsigned lanesOf(Pack::Mask const &mask)
{
  // compilers would take the lanes out one by one
#if defined(__AVX512DQ__)
  return static_cast<unsigned>(__builtin_ia32_cvtq2mask512(mask));
#elif defined(__AVX__) && !defined(__AVX512F__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256((Pack::Lanes)mask));
#else
  unsigned lanes = 0;
  for (int lane = 0; lane < pack_width; ++lane)
    lanes |= mask[lane] != 0 ? 1u << lane : 0u;
  return lanes;
#endif
}
KOKKOS_FORCEINLINE_FUNCTION bool any(Pack::Mask const &mask)
{
  return lanesOf(mask) != 0;
}
KOKKOS_FORCEINLINE_FUNCTION Pack::Mask both(Pack::Mask const &a, Pack::Mask const &b)
{
  return a & b;
}
KOKKOS_FORCEINLINE_FUNCTION Pack::Mask either(Pack::Mask const &a, Pack::Mask const &b)
{
  return a | b;
}
KOKKOS_FORCEINLINE_FUNCTION Pack::Mask no(Pack::Mask const &a)
{
  return ~a;
}
KOKKOS_FORCEINLINE_FUNCTION bool laneOf(Pack::Mask const &mask, int lane)
{
  return mask[lane] != 0;
}
KOKKOS_FORCEINLINE_FUNCTION double laneOf(Pack const &pack, int lane)
{
  return pack[lane];
}

/// The pack of value(0), value(1), ...
template <class Value>
KOKKOS_FORCEINLINE_FUNCTION Pack packOf(Value const &value)
{
#if defined(__AVX512F__)
  return Pack(Pack::Lanes{value(0), value(1), value(2), value(3), value(4), value(5), value(6), value(7)});
#elif defined(__AVX__)
  return Pack(Pack::Lanes{value(0), value(1), value(2), value(3)});
#else
  return Pack(Pack::Lanes{value(0), value(1)});
#endif
}

namespace Detail
{
#if defined(__clang__) || __GNUC__ >= 12
/// Swap the Step-sized blocks off the diagonal of rows a and b, which are Step apart.
template <int Step, int... Lane>
KOKKOS_FORCEINLINE_FUNCTION void swapBlocks(Pack &a, Pack &b, std::integer_sequence<int, Lane...>)
{
  Pack::Lanes const upper =
      __builtin_shufflevector(a.lanes, b.lanes, ((Lane & Step) != 0 ? pack_width + Lane - Step : Lane)...);
  b.lanes = __builtin_shufflevector(a.lanes, b.lanes, ((Lane & Step) != 0 ? pack_width + Lane : Lane + Step)...);
  a.lanes = upper;
}
#else
template <int Step, int... Lane>
KOKKOS_FORCEINLINE_FUNCTION void swapBlocks(Pack &a, Pack &b, std::integer_sequence<int, Lane...>)
{
  Pack const p = a, q = b;
  for (int lane = 0; lane < pack_width; ++lane)
  {
    a.lanes[lane] = (lane & Step) != 0 ? q.lanes[lane - Step] : p.lanes[lane];
    b.lanes[lane] = (lane & Step) != 0 ? q.lanes[lane] : p.lanes[lane + Step];
  }
}
#endif

template <int Step>
KOKKOS_FORCEINLINE_FUNCTION void transposeFrom(Pack (&p)[pack_width])
{
  if constexpr (Step < pack_width)
  {
    HARMOS_UNROLL
    for (int row = 0; row < pack_width; ++row)
      if ((row & Step) == 0)
        swapBlocks<Step>(p[row], p[row + Step], std::make_integer_sequence<int, pack_width>());
    transposeFrom<2 * Step>(p);
  }
}
} // namespace Detail

namespace Detail
{
#if defined(__clang__) || __GNUC__ >= 12
template <int At, int... Lane>
KOKKOS_FORCEINLINE_FUNCTION Pack replaced(Pack const &a, double x, std::integer_sequence<int, Lane...>)
{
  return Pack(__builtin_shufflevector(a.lanes, Pack(x).lanes, (Lane == At ? pack_width + Lane : Lane)...));
}
#else
template <int At, int... Lane>
KOKKOS_FORCEINLINE_FUNCTION Pack replaced(Pack a, double x, std::integer_sequence<int, Lane...>)
{
  a.lanes[At] = x;
  return a;
}
#endif
} // namespace Detail

/// a with x in lane At; in registers: a value stored into a vector in memory would hold up the next load of it.
template <int At>
KOKKOS_FORCEINLINE_FUNCTION Pack withLane(Pack const &a, double x)
{
  return Detail::replaced<At>(a, x, std::make_integer_sequence<int, pack_width>());
}

/// p[i] lane j <-> p[j] lane i.
KOKKOS_FORCEINLINE_FUNCTION void transpose(Pack (&p)[pack_width])
{
  Detail::transposeFrom<1>(p);
}

KOKKOS_FORCEINLINE_FUNCTION Pack loadPack(double const *x)
{
  Pack::Lanes const lanes = *reinterpret_cast<Pack::Unaligned const *>(x); // a reference would claim alignment
  return Pack(lanes);
}
KOKKOS_FORCEINLINE_FUNCTION void storePack(double *x, Pack const &p)
{
  *reinterpret_cast<Pack::Unaligned *>(x) = p.lanes;
}

namespace Math
{
KOKKOS_FORCEINLINE_FUNCTION Pack sqrt(Pack const &a)
{
  return packOf([&](int lane) { return __builtin_sqrt(a.lanes[lane]); });
}
KOKKOS_FORCEINLINE_FUNCTION Pack fabs(Pack const &a)
{
  return Pack((Pack::Lanes)((Pack::Mask)a.lanes & 0x7fffffffffffffffll));
}
KOKKOS_FORCEINLINE_FUNCTION Pack min(Pack const &a, Pack const &b)
{
  return Pack(b.lanes < a.lanes ? b.lanes : a.lanes);
}
KOKKOS_FORCEINLINE_FUNCTION Pack max(Pack const &a, Pack const &b)
{
  return Pack(a.lanes < b.lanes ? b.lanes : a.lanes);
}
} // namespace Math

#else

constexpr int pack_width = 1;
using Pack = double;

template <class Value>
KOKKOS_FORCEINLINE_FUNCTION Pack packOf(Value const &value)
{
  return value(0);
}
template <int At>
KOKKOS_FORCEINLINE_FUNCTION Pack withLane(Pack const &, double x)
{
  return x;
}
KOKKOS_FORCEINLINE_FUNCTION void transpose(Pack (&)[pack_width]) {}
KOKKOS_FORCEINLINE_FUNCTION Pack loadPack(double const *x)
{
  return *x;
}
KOKKOS_FORCEINLINE_FUNCTION void storePack(double *x, Pack const &p)
{
  *x = p;
}

#endif

/// a b + c, rounded once where the machine does that in one instruction. A compiler may fuse a product and a sum in
/// one place and not in another: sums that are made in packs here and cell by cell there say what they are.
KOKKOS_FORCEINLINE_FUNCTION double multiplyAdd(double a, double b, double c)
{
#if defined(HARMOS_VECTOR_TYPES) && defined(__FP_FAST_FMA)
  return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}
#ifdef HARMOS_VECTOR_TYPES
KOKKOS_FORCEINLINE_FUNCTION Pack multiplyAdd(Pack const &a, Pack const &b, Pack const &c)
{
  return packOf([&](int lane) { return multiplyAdd(laneOf(a, lane), laneOf(b, lane), laneOf(c, lane)); });
}
#endif

/// condition ? a : b, lane by lane.
KOKKOS_INLINE_FUNCTION double select(bool condition, double a, double b)
{
  return condition ? a : b;
}
KOKKOS_FORCEINLINE_FUNCTION bool both(bool a, bool b)
{
  return a && b;
}
KOKKOS_FORCEINLINE_FUNCTION bool either(bool a, bool b)
{
  return a || b;
}
KOKKOS_FORCEINLINE_FUNCTION bool no(bool a)
{
  return !a;
}
KOKKOS_FORCEINLINE_FUNCTION unsigned lanesOf(bool mask)
{
  return mask ? 1u : 0u;
}
KOKKOS_FORCEINLINE_FUNCTION bool laneOf(bool mask, int)
{
  return mask;
}
KOKKOS_FORCEINLINE_FUNCTION double laneOf(double pack, int)
{
  return pack;
}

/// Sum of the lanes, in their order.
KOKKOS_FORCEINLINE_FUNCTION double laneSum(Pack const &p)
{
  double sum = laneOf(p, 0);
  for (int lane = 1; lane < pack_width; ++lane)
    sum += laneOf(p, lane);
  return sum;
}

/// The numbers of the lanes: 0, 1, ...
KOKKOS_FORCEINLINE_FUNCTION Pack laneNumbers()
{
  return packOf([](int lane) { return static_cast<double>(lane); });
}

/// Field f of eight-field rows into packs: field[f] lane l = row(l)[f].
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION void loadRows(Row const &row, Pack (&field)[8])
{
  HARMOS_UNROLL
  for (int f = 0; f < 8; f += pack_width)
  {
    Pack p[pack_width];
    HARMOS_UNROLL
    for (int lane = 0; lane < pack_width; ++lane)
      p[lane] = loadPack(row(lane) + f);
    transpose(p);
    HARMOS_UNROLL
    for (int i = 0; i < pack_width; ++i)
      field[f + i] = p[i];
  }
}

/// One bit a lane.
constexpr unsigned all_lanes = (1u << pack_width) - 1u;

/// Its inverse, for the lanes whose bit is set.
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION void storeRows(Pack const (&field)[8], unsigned lanes, Row const &row)
{
  HARMOS_UNROLL
  for (int f = 0; f < 8; f += pack_width)
  {
    Pack p[pack_width];
    HARMOS_UNROLL
    for (int i = 0; i < pack_width; ++i)
      p[i] = field[f + i];
    transpose(p);
    if (lanes == all_lanes)
    {
      HARMOS_UNROLL
      for (int lane = 0; lane < pack_width; ++lane)
        storePack(row(lane) + f, p[lane]);
    }
    else
      for (int lane = 0; lane < pack_width; ++lane)
        if ((lanes >> lane & 1u) != 0u)
          storePack(row(lane) + f, p[lane]);
  }
}

/// Number of packs that hold `count` lanes.
KOKKOS_INLINE_FUNCTION constexpr int numPacks(int count)
{
  return (count + pack_width - 1) / pack_width;
}

} // namespace Harmos

#endif
