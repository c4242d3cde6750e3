// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_SegmentBins.hpp>

namespace Harmos
{

SegmentBins binSegments(Mesh const &mesh, InterfaceSegments const &segments, Exchange const &exchange)
{
  int const count = segments.count;
  View<InterfaceSegment *> const segment = segments.segment;
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::largestSegment", RangePolicy(0, count),
      KOKKOS_LAMBDA(int i, double &l) {
        if (mesh.cell_depth(segment(i).cell) == 0)
          l = Math::max(l, Math::max(segment(i).length, segment(i).cell_size));
      },
      Kokkos::Max<double>(largest));
  largest = exchange.max(count > 0 ? largest : 0.0);

  SegmentBins bins;
  int buckets = 16;
  while (buckets < 2 * count)
    buckets *= 2;
  bins.mask = buckets - 1;
  bins.size = largest > 0.0 ? 2.0 * largest : 1.0;
  bins.offset = View<int *>("Harmos::constrain::bin_offset", buckets + 1);
  bins.item = View<int *>("Harmos::constrain::bin_item", count);
  bins.bin_of = View<int *[2]>("Harmos::constrain::bin_of", count);

  View<int *> const filled("Harmos::constrain::bin_filled", buckets);
  Kokkos::parallel_for(
      "Harmos::constrain::countBins", RangePolicy(0, count), KOKKOS_LAMBDA(int i) {
        bins.bin_of(i, 0) = bins.index(segment(i).midpoint[0]);
        bins.bin_of(i, 1) = bins.index(segment(i).midpoint[1]);
        Kokkos::atomic_increment(&filled(bins.bucket(bins.bin_of(i, 0), bins.bin_of(i, 1))));
      });
  Kokkos::parallel_scan(
      "Harmos::constrain::scanBins", RangePolicy(0, buckets), KOKKOS_LAMBDA(int b, int &sum, bool final) {
        sum += filled(b);
        if (final)
        {
          bins.offset(b + 1) = sum;
          filled(b) = 0;
        }
      });
  Kokkos::parallel_for(
      "Harmos::constrain::fillBins", RangePolicy(0, count), KOKKOS_LAMBDA(int i) {
        int const b = bins.bucket(bins.bin_of(i, 0), bins.bin_of(i, 1));
        bins.item(bins.offset(b) + Kokkos::atomic_fetch_add(&filled(b), 1)) = i;
      });
  Kokkos::parallel_for(
      "Harmos::constrain::sortBins", RangePolicy(0, buckets), KOKKOS_LAMBDA(int b) {
        for (int i = bins.offset(b) + 1; i < bins.offset(b + 1); ++i)
          for (int j = i; j > bins.offset(b) && bins.item(j - 1) > bins.item(j); --j)
          {
            int const swap = bins.item(j);
            bins.item(j) = bins.item(j - 1);
            bins.item(j - 1) = swap;
          }
      });
  return bins;
}

} // namespace Harmos
