// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SEGMENT_BINS_HPP
#define HARMOS_SEGMENT_BINS_HPP

#include <Harmos_InterfaceSegments.hpp>
#include <Harmos_Pack.hpp>
#include <Harmos_SlipMirrors.hpp>

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

/// What rays ask of a binned segment first, in columns.
enum BinColumn : int
{
  BinX, // of the midpoint
  BinY,
  BinNormalX,
  BinNormalY,
  BinExtent,   // half of the length, and what crossSegment adds at its ends
  BinMaterial, // exact integers
  num_bin_columns
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
  int mask = 0;                         // hashed: buckets - 1; buckets is a power of two
  View<int *> offset;                   // bins of the grid by row, or buckets; and one more
  View<BinnedSegment *> item;           // by bin, then by segment
  View<double **> column;               // num_bin_columns x items, and room for a last pack; none of chosenItems
  View<unsigned long long *> materials; // materialBits of each bin's segments

  KOKKOS_INLINE_FUNCTION int index(double x) const { return static_cast<int>(Math::floor(x / size)); }

  KOKKOS_INLINE_FUNCTION int bucket(int column, int row) const
  {
    if (!hashed)
      return gridBucket(column, row);
    unsigned const h = static_cast<unsigned>(column) * 73856093u ^ static_cast<unsigned>(row) * 19349663u;
    return static_cast<int>((h ^ (h >> 15)) & static_cast<unsigned>(mask));
  }

  /// A bit for each material below 63, one for all others and the walls.
  static KOKKOS_INLINE_FUNCTION unsigned long long materialBit(int material)
  {
    return 1ull << (material >= 0 && material < 63 ? material : 63);
  }

  /// False where the bins that meet the box low..high hold nothing but segments of one material, below 63: most of
  /// those that face void.
  KOKKOS_INLINE_FUNCTION bool holdOthers(Vector2 const &low, Vector2 const &high, int material) const
  {
    if (material >= 63)
      return true;
    unsigned long long bits = 0;
    Range const r = range(low, high);
    for (int row = r.south; row <= r.north; ++row)
    {
      if (!hashed)
      {
        int const start = gridBucket(0, row);
        for (int column = r.west; column <= r.east; ++column)
          bits |= materials(start + column);
        continue;
      }
      for (int column = r.west; column <= r.east; ++column)
        bits |= materials(bucket(column, row));
    }
    return (bits & ~materialBit(material)) != 0;
  }

  /// visit(begin, end) for places of items that lie side by side and in the bins that meet the box low..high: all such.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forEachRun(Vector2 const &low, Vector2 const &high, Visitor const &visit) const
  {
    Range const r = range(low, high);
    if (r.east < r.west)
      return;
    for (int row = r.south; row <= r.north; ++row)
    {
      if (!hashed) // the bins of a row of the grid lie side by side
      {
        int const start = gridBucket(0, row), begin = offset(start + r.west), end = offset(start + r.east + 1);
        if (begin < end)
          visit(begin, end);
        continue;
      }
      for (int column = r.west; column <= r.east; ++column)
        for (int i = offset(bucket(column, row)); i < offset(bucket(column, row) + 1); ++i)
          if (item(i).column == column && item(i).row == row)
            visit(i, i + 1);
    }
  }

  /// visit(place, item(place)) for every segment in the bins that meet the box low..high.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forEach(Vector2 const &low, Vector2 const &high, Visitor const &visit) const
  {
    forEachRun(low, high,
               [&](int begin, int end)
               {
                 for (int i = begin; i < end; ++i)
                   visit(i, item(i));
               });
  }

private:
  KOKKOS_FORCEINLINE_FUNCTION int gridBucket(int column, int row) const
  {
    return (row - first_row) * (last_column - first_column + 1) + column - first_column;
  }

  struct Range
  {
    int west, east, south, north;
  };

  /// Columns and rows of the bins that meet a box; none where east < west or north < south.
  KOKKOS_INLINE_FUNCTION Range range(Vector2 const &low, Vector2 const &high) const
  {
    return {Math::max(first_column, index(low[0])), Math::min(last_column, index(high[0])),
            Math::max(first_row, index(low[1])), Math::min(last_row, index(high[1]))};
  }
};

/// How many cells from a segment slip walls mirror what its fits take.
constexpr int mirrored_rows = 3;

/// visit(segment, image) for the segments in the bins within `box` of a point along x and y, and for their images
/// beyond slip walls there. \param visit Its second argument is the number of the mirror; -1: a segment itself.
template <class Visitor>
KOKKOS_INLINE_FUNCTION void forEachWithImages(SegmentBins const &bins, SlipMirrors const &mirrors, Vector2 const &point,
                                              double box, Visitor const &visit)
{
  Vector2 const reach{box, box};
  bins.forEach(point - reach, point + reach, [&](int, BinnedSegment const &s) { visit(s, -1); });
  for (int i = 0; i < mirrors.count; ++i)
  {
    MirrorImage const &image = mirrors.image[i];
    Vector2 const at = image.point(point);
    bins.forEach(at - reach, at + reach,
                 [&](int, BinnedSegment const &s)
                 {
                   if (!image.reflects(s.midpoint))
                     return;
                   BinnedSegment beyond = s;
                   beyond.midpoint = image.point(s.midpoint);
                   beyond.normal = image.direction(s.normal);
                   visit(beyond, i);
                 });
  }
}

/// Largest cell size or segment length of this rank's own cells; zero where they have no segment.
double largestSegment(Mesh const &mesh, InterfaceSegments const &segments);

/// \param largest Of all ranks' largestSegment. Own cells decide it: the halo's rim may hold segments that are not
/// there.
SegmentBins binSegments(InterfaceSegments const &segments, double largest, WorkArrays const &work = {});

/// The bins with those of their items alone that are chosen (1, else 0); walks meet them in the same order.
SegmentBins chosenItems(SegmentBins const &bins, View<int *> const &chosen, WorkArrays const &work = {});

} // namespace Harmos

#endif
