// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BOND_BINS_HPP
#define HARMOS_BOND_BINS_HPP

#include <Harmos_Bonds.hpp>
#include <Harmos_LowerBound.hpp>
#include <Harmos_WorkArrays.hpp>

namespace Harmos
{

/// Bonds in the order of square bins over all of them: by bin row, bin column, number.
struct BondBins
{
  double size = 1.0;           // of a bin [length]
  Vector2 corner = {0.0, 0.0}; // lower left one of the bins
  long long columns = 1;       // and one more on either side
  View<Bond *> bond;           // by number
  View<long long *> bin;       // ascending
  View<int *> number;          // of the bond, by place

  KOKKOS_INLINE_FUNCTION long long index(double apart) const
  {
    return static_cast<long long>(Math::floor(apart / size));
  }

  /// The first place whose bin is not below one.
  KOKKOS_INLINE_FUNCTION int firstOf(long long wanted) const
  {
    return lowerBound(static_cast<int>(bin.extent(0)), [&](int i) { return bin(i) < wanted; });
  }

  /// Number of the nearest bond of two materials (low < high) within reach of a point, ties to the lower number; -1:
  /// none. \param reach At which none is found any more [length]
  KOKKOS_INLINE_FUNCTION int nearest(Vector2 const &point, double reach, int low, int high) const
  {
    Vector2 const from = point - corner;
    long long const first = Math::max(index(from[0] - reach), -1LL), last = Math::min(index(from[0] + reach), columns);
    double least = reach * reach;
    int found = -1;
    for (long long row = index(from[1] - reach); row <= index(from[1] + reach); ++row)
      for (int i = firstOf(row * (columns + 2) + first);
           i < static_cast<int>(bin.extent(0)) && bin(i) <= row * (columns + 2) + last; ++i)
      {
        Bond const &candidate = bond(number(i));
        if (candidate.material_a != low || candidate.material_b != high)
          continue;
        Vector2 const apart = candidate.point - point;
        double const squared = dot(apart, apart);
        if (squared < least || (squared == least && found >= 0 && number(i) < found))
        {
          least = squared;
          found = number(i);
        }
      }
    return found;
  }
};

/// Bins of bond_reach times the largest cell_size of the bonds, so that a row looks into nine of them where cells keep
/// their size. Bonds may lie anywhere; without any, `nearest` finds none. Cost: a sort of the bonds.
BondBins binBonds(std::vector<Bond> const &bonds, WorkArrays const &work = {});

} // namespace Harmos

#endif
