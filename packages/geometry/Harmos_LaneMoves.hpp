// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LANE_MOVES_HPP
#define HARMOS_LANE_MOVES_HPP

#include <Harmos_Pack.hpp>

namespace Harmos
{

/// Sums of the lanes of each pack, in their order, for a whole number of pack_width packs; the packs are lost.
template <int Count>
KOKKOS_FORCEINLINE_FUNCTION void laneSums(Pack (&pack)[Count], double (&sum)[Count])
{
  static_assert(Count % pack_width == 0, "whole blocks are transposed");
  HARMOS_UNROLL
  for (int first = 0; first < Count; first += pack_width)
  {
    Pack block[pack_width];
    HARMOS_UNROLL
    for (int i = 0; i < pack_width; ++i)
      block[i] = pack[first + i];
    transpose(block);
    Pack total = block[0];
    HARMOS_UNROLL
    for (int i = 1; i < pack_width; ++i)
      total += block[i];
    storePack(sum + first, total);
  }
}

#if defined(HARMOS_VECTOR_TYPES) && defined(__AVX2__) && !defined(__AVX512F__)
#define HARMOS_LANE_PERMUTATION
namespace Detail
{
typedef int HalfLanes __attribute__((vector_size(32)));

/// By the bits of four lanes: where the halves of what is set come from, in their order, for the instruction that
/// permutes halves of doubles.
struct FrontLanes
{
  HalfLanes from[16];
};

constexpr FrontLanes front_lanes = {{{0, 1, 0, 1, 0, 1, 0, 1},
                                     {0, 1, 0, 1, 0, 1, 0, 1},
                                     {2, 3, 0, 1, 0, 1, 0, 1},
                                     {0, 1, 2, 3, 0, 1, 0, 1},
                                     {4, 5, 0, 1, 0, 1, 0, 1},
                                     {0, 1, 4, 5, 0, 1, 0, 1},
                                     {2, 3, 4, 5, 0, 1, 0, 1},
                                     {0, 1, 2, 3, 4, 5, 0, 1},
                                     {6, 7, 0, 1, 0, 1, 0, 1},
                                     {0, 1, 6, 7, 0, 1, 0, 1},
                                     {2, 3, 6, 7, 0, 1, 0, 1},
                                     {0, 1, 2, 3, 6, 7, 0, 1},
                                     {4, 5, 6, 7, 0, 1, 0, 1},
                                     {0, 1, 4, 5, 6, 7, 0, 1},
                                     {2, 3, 4, 5, 6, 7, 0, 1},
                                     {0, 1, 2, 3, 4, 5, 6, 7}}};
} // namespace Detail
#endif

/// Moves the lanes whose bit is set to the front, in their order; what lies behind them means nothing.
class LaneCompressor
{
public:
  int count = 0; // of the lanes that are set

#if defined(HARMOS_VECTOR_TYPES) && defined(__AVX512F__)
  KOKKOS_FORCEINLINE_FUNCTION explicit LaneCompressor(unsigned lanes)
      : count(__builtin_popcount(lanes)), lanes_(static_cast<unsigned char>(lanes))
  {
  }

  KOKKOS_FORCEINLINE_FUNCTION Pack operator()(Pack const &p) const
  {
    return Pack((Pack::Lanes)__builtin_ia32_compressdf512_mask(p.lanes, Pack::Lanes{}, lanes_));
  }

private:
  unsigned char lanes_;
#elif defined(HARMOS_LANE_PERMUTATION)
  KOKKOS_FORCEINLINE_FUNCTION explicit LaneCompressor(unsigned lanes)
      : count(__builtin_popcount(lanes)), from_(Detail::front_lanes.from[lanes])
  {
  }

  KOKKOS_FORCEINLINE_FUNCTION Pack operator()(Pack const &p) const
  {
    return Pack((Pack::Lanes)__builtin_ia32_permvarsi256((Detail::HalfLanes)p.lanes, from_));
  }

private:
  Detail::HalfLanes from_;
#else
  KOKKOS_FORCEINLINE_FUNCTION explicit LaneCompressor(unsigned lanes)
  {
    HARMOS_UNROLL
    for (int lane = 0; lane < pack_width; ++lane)
    {
      from_[count] = lane;
      count += static_cast<int>(lanes >> lane & 1u);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION Pack operator()(Pack const &p) const
  {
    return packOf([&](int lane) { return laneOf(p, from_[lane]); });
  }

private:
  int from_[pack_width + 1] = {};
#endif
};

} // namespace Harmos

#endif
