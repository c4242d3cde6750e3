// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_JoinReducer.hpp>
#include <Harmos_SegmentBins.hpp>

namespace Harmos
{

double largestSegment(Mesh const &mesh, InterfaceSegments const &segments)
{
  View<InterfaceSegment *> const segment = segments.segment;
  View<int *> const depth = mesh.cell_depth;
  double largest = 0.0;
  launchReduce(
      "Harmos::constrain::largestSegment", segments.count,
      KOKKOS_LAMBDA(int i, double &l) {
        if (depth(segment(i).cell) == 0)
          l = Math::max(l, Math::max(segment(i).length, segment(i).cell_size));
      },
      Kokkos::Max<double>(largest));
  return segments.count > 0 ? Math::max(largest, 0.0) : 0.0;
}

namespace
{

/// Segments of each bucket, ascending: what concurrent filling shuffled is sorted.
KOKKOS_INLINE_FUNCTION void sortRange(View<int *> const &item, int begin, int end)
{
  for (int i = begin + 1; i < end; ++i)
    for (int j = i; j > begin && item(j - 1) > item(j); --j)
    {
      int const swap = item(j);
      item(j) = item(j - 1);
      item(j - 1) = swap;
    }
}

KOKKOS_INLINE_FUNCTION void setColumns(SegmentBins const &bins, int place, InterfaceSegment const &s)
{
  bins.column(BinX, place) = s.midpoint[0];
  bins.column(BinY, place) = s.midpoint[1];
  bins.column(BinNormalX, place) = s.normal[0];
  bins.column(BinNormalY, place) = s.normal[1];
  bins.column(BinExtent, place) = 0.5 * s.length + 1e-6 * s.cell_size;
  bins.column(BinMaterial, place) = s.material;
}

struct MidpointBox
{
  Vector2 least{1e300, 1e300}, most{-1e300, -1e300};

  KOKKOS_INLINE_FUNCTION void join(MidpointBox const &other)
  {
    for (int d = 0; d < 2; ++d)
    {
      least[d] = Math::min(least[d], other.least[d]);
      most[d] = Math::max(most[d], other.most[d]);
    }
  }
};

/// The rows and columns of bins that hold segments, and with them the numbers of bins or buckets.
int spread(View<InterfaceSegment *> const &segment, int count, SegmentBins &bins)
{
  constexpr long long roomy = 64; // bins of the grid for each segment, beyond which it is hashed
  MidpointBox box;
  launchReduce(
      "Harmos::constrain::midpointBox", count,
      KOKKOS_LAMBDA(int i, MidpointBox &sum) {
        sum.join({segment(i).midpoint, segment(i).midpoint});
      },
      JoinReducer<MidpointBox>(box));
  if (count > 0)
  {
    bins.first_column = bins.index(box.least[0]);
    bins.last_column = bins.index(box.most[0]);
    bins.first_row = bins.index(box.least[1]);
    bins.last_row = bins.index(box.most[1]);
  }
  double const all = (1.0 + bins.last_column - bins.first_column) * (1.0 + bins.last_row - bins.first_row);
  bins.hashed = all > static_cast<double>(roomy * count);
  int buckets = 16;
  while (bins.hashed && buckets < 2 * count)
    buckets *= 2;
  bins.mask = buckets - 1;
  return bins.hashed ? buckets : static_cast<int>(all);
}

} // namespace

SegmentBins binSegments(InterfaceSegments const &segments, double largest, WorkArrays const &work)
{
  int const count = segments.count;
  View<InterfaceSegment *> const segment = segments.segment;
  SegmentBins bins;
  bins.size = largest > 0.0 ? largest : 1.0;
  int const buckets = spread(segment, count, bins);
  bins.offset = work.unset<int *>("Harmos::constrain::bin_offset", buckets + 1);
  bins.item = work.unset<BinnedSegment *>("Harmos::constrain::bin_item", count);
  bins.column = work.unset<double **>("Harmos::constrain::bin_column", num_bin_columns, count + pack_width);
  bins.materials = work.unset<unsigned long long *>("Harmos::constrain::bin_materials", buckets);
  View<int *[2]> const bin = work.unset<int *[2]>("Harmos::constrain::bin", count); // column, row
  View<int *> const bucket = work.unset<int *>("Harmos::constrain::bucket", count);
  View<int *> const order = work.unset<int *>("Harmos::constrain::bin_order", count);
  View<int *> const filled = work.zeros<int *>("Harmos::constrain::bin_filled", buckets);
  launchFor(
      "Harmos::constrain::lastPack", pack_width, KOKKOS_LAMBDA(int i) {
        for (int c = 0; c < num_bin_columns; ++c) // masked out, but compared with
          bins.column(c, count + i) = 0.0;
      });
  launchFor(
      "Harmos::constrain::countBins", count, KOKKOS_LAMBDA(int i) {
        bin(i, 0) = bins.index(segment(i).midpoint[0]);
        bin(i, 1) = bins.index(segment(i).midpoint[1]);
        bucket(i) = bins.bucket(bin(i, 0), bin(i, 1));
        Kokkos::atomic_add(&filled(bucket(i)), 1);
      });
  int all = 0;
  launchScan(
      "Harmos::constrain::scanBins", buckets + 1,
      KOKKOS_LAMBDA(int b, int &sum, bool final) {
        int const here = b < buckets ? filled(b) : 0;
        if (final)
        {
          bins.offset(b) = sum;
          if (b < buckets)
            filled(b) = 0;
        }
        sum += here;
      },
      all);
  launchFor(
      "Harmos::constrain::fillBins", count,
      KOKKOS_LAMBDA(int i) { order(bins.offset(bucket(i)) + Kokkos::atomic_fetch_add(&filled(bucket(i)), 1)) = i; });
  launchFor(
      "Harmos::constrain::sortBins", buckets, KOKKOS_LAMBDA(int b) {
        int const begin = bins.offset(b), end = bins.offset(b + 1);
        unsigned long long materials = 0;
        sortRange(order, begin, end);
        for (int i = begin; i < end; ++i)
        {
          int const number = order(i);
          InterfaceSegment const &s = segment(number);
          bins.item(i) = {s.midpoint, s.normal, s.length,       s.cell_size,   number,
                          s.material, s.cell,   bin(number, 0), bin(number, 1)};
          setColumns(bins, i, s);
          materials |= SegmentBins::materialBit(s.material);
        }
        bins.materials(b) = materials;
      });
  return bins;
}

SegmentBins chosenItems(SegmentBins const &bins, View<int *> const &chosen, WorkArrays const &work)
{
  int const count = static_cast<int>(bins.item.extent(0)), buckets = static_cast<int>(bins.offset.extent(0)) - 1;
  View<int *> const place = work.unset<int *>("Harmos::constrain::chosen_place", count + 1);
  int total = 0;
  launchScan(
      "Harmos::constrain::placeChosen", count + 1,
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        if (final)
          place(i) = sum;
        sum += i < count ? chosen(i) : 0;
      },
      total);
  SegmentBins result = bins;
  result.column = {};
  result.offset = work.unset<int *>("Harmos::constrain::chosen_offset", buckets + 1);
  result.item = work.unset<BinnedSegment *>("Harmos::constrain::chosen_item", total);
  launchFor(
      "Harmos::constrain::chosenOffsets", buckets + 1,
      KOKKOS_LAMBDA(int b) { result.offset(b) = place(bins.offset(b)); });
  launchFor(
      "Harmos::constrain::chosenItems", count, KOKKOS_LAMBDA(int i) {
        if (chosen(i) == 1)
          result.item(place(i)) = bins.item(i);
      });
  return result;
}

} // namespace Harmos
