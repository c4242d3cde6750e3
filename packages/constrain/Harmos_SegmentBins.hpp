// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SEGMENT_BINS_HPP
#define HARMOS_SEGMENT_BINS_HPP

#include <Harmos_InterfaceSegments.hpp>

namespace Harmos
{

/// What a walk over the bins reads of a segment: they lie side by side in the order of the bins.
struct BinnedSegment
{
  Vector2 midpoint, normal;
  double length, cell_size;
  int segment, material, cell;
  int column, row; // of the bin
};

/// Segments sorted into square bins by their midpoints: compressed rows over a grid that covers them all, or, where
/// that would have many more bins than there are segments (bodies far apart), over the buckets of a hash.
///
/// Bins are the same on every rank (origin zero, common size), so that a walk over a box meets the segments in an order
/// that depends on neither the ranks nor the hash: by bin row, bin column, key.
struct SegmentBins
{
  double size = 1.0; // of a bin: the largest cell size or segment length of all ranks
  int first_column = 0, last_column = -1, first_row = 0, last_row = -1; // of the segments' bins
  bool hashed = false;
  int mask = 0;               // hashed: buckets - 1; buckets is a power of two
  View<int *> offset;         // bins of the grid by row, or buckets; and one more
  View<BinnedSegment *> item; // by bin, then by segment

  KOKKOS_INLINE_FUNCTION int index(double x) const { return static_cast<int>(Math::floor(x / size)); }

  KOKKOS_INLINE_FUNCTION int bucket(int column, int row) const
  {
    if (!hashed)
      return (row - first_row) * (last_column - first_column + 1) + column - first_column;
    unsigned const h = static_cast<unsigned>(column) * 73856093u ^ static_cast<unsigned>(row) * 19349663u;
    return static_cast<int>((h ^ (h >> 15)) & static_cast<unsigned>(mask));
  }

  /// visit(place, item(place)) for every segment in the bins that meet the box low..high.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forEach(Vector2 const &low, Vector2 const &high, Visitor const &visit) const
  {
    int const west = Math::max(first_column, index(low[0])), east = Math::min(last_column, index(high[0]));
    int const north = Math::min(last_row, index(high[1]));
    if (east < west)
      return;
    for (int row = Math::max(first_row, index(low[1])); row <= north; ++row)
    {
      // The bins of a row of the grid lie side by side.
      for (int column = west; column <= east; column = hashed ? column + 1 : east + 1)
        for (int i = offset(bucket(column, row)); i < offset(bucket(hashed ? column : east, row) + 1); ++i)
          if (!hashed || (item(i).column == column && item(i).row == row))
            visit(i, item(i));
    }
  }
};

/// Largest cell size or segment length of this rank's own cells; zero where they have no segment.
double largestSegment(Mesh const &mesh, InterfaceSegments const &segments);

/// \param largest Of all ranks' largestSegment. Own cells decide it: the halo's rim may hold segments that are not
/// there.
SegmentBins binSegments(InterfaceSegments const &segments, double largest);

} // namespace Harmos

#endif
