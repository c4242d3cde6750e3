// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SEGMENT_BINS_HPP
#define HARMOS_SEGMENT_BINS_HPP

#include <Harmos_Exchange.hpp>
#include <Harmos_InterfaceSegments.hpp>

namespace Harmos
{

/// Segments hashed by the square bin that holds their midpoint: compressed rows over the buckets of the hash.
///
/// Bins are the same on every rank (origin zero, common size), so that a walk over a box meets the segments in an order
/// that does not depend on the ranks: by bin row, bin column, key.
struct SegmentBins
{
  double size = 1.0;     // of a bin: twice the largest cell size or segment length of all ranks
  int mask = 0;          // buckets - 1; buckets is a power of two
  View<int *> offset;    // buckets + 1
  View<int *> item;      // segments, ascending within a bucket
  View<int *[2]> bin_of; // segments: column, row

  KOKKOS_INLINE_FUNCTION int index(double x) const { return static_cast<int>(Math::floor(x / size)); }

  KOKKOS_INLINE_FUNCTION int bucket(int column, int row) const
  {
    unsigned const h = static_cast<unsigned>(column) * 73856093u ^ static_cast<unsigned>(row) * 19349663u;
    return static_cast<int>((h ^ (h >> 15)) & static_cast<unsigned>(mask));
  }

  /// visit(segment) for every segment in the bins that meet the box low..high.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forEach(Vector2 const &low, Vector2 const &high, Visitor const &visit) const
  {
    int const last_column = index(high[0]), last_row = index(high[1]);
    for (int row = index(low[1]); row <= last_row; ++row)
      for (int column = index(low[0]); column <= last_column; ++column)
      {
        int const b = bucket(column, row);
        for (int i = offset(b); i < offset(b + 1); ++i)
          if (bin_of(item(i), 0) == column && bin_of(item(i), 1) == row)
            visit(item(i));
      }
  }
};

/// Collective: the bin size is agreed upon. Own cells decide it: the halo's rim may hold segments that are not there.
SegmentBins binSegments(Mesh const &mesh, InterfaceSegments const &segments, Exchange const &exchange);

} // namespace Harmos

#endif
