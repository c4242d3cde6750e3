// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_FacingSegments.hpp>

namespace Harmos
{

FacingSegments facingSegments(View<InterfaceSegment *> const &segment, View<RayHit *> const &hit,
                              SegmentBins const &bins, WorkArrays const &work)
{
  constexpr double least_cosine = 0.9; // of the facets that the fit takes
  int const count = static_cast<int>(bins.item.extent(0));
  View<int *> const serves = work.unset<int *>("Harmos::constrain::serves", count);
  View<BinnedSegment *> const item = bins.item;
  launchFor(
      "Harmos::constrain::serves", count, KOKKOS_LAMBDA(int i) {
        RayHit const &h = hit(item(i).segment);
        serves(i) = h.segment >= 0 && h.cosine >= least_cosine ? 1 : 0;
      });
  FacingSegments const facing{chosenItems(bins, serves, work), {}};
  int const num_facing = static_cast<int>(facing.bins.item.extent(0));
  int const room = num_facing + pack_width; // what lies behind the last one is masked out, but compared with
  View<double **> const column = work.unset<double **>("Harmos::constrain::facing", num_facing_columns, room);
  launchFor(
      "Harmos::constrain::lastFacing", pack_width, KOKKOS_LAMBDA(int i) {
        for (int c = 0; c < num_facing_columns; ++c)
          column(c, num_facing + i) = 0.0;
      });
  View<BinnedSegment *> const chosen = facing.bins.item;
  launchFor(
      "Harmos::constrain::facing", num_facing, KOKKOS_LAMBDA(int i) {
        BinnedSegment const &c = chosen(i);
        RayHit const &h = hit(c.segment);
        Vector2 const cell_centre = segment(c.segment).cell_centre;
        column(FacingX, i) = c.midpoint[0];
        column(FacingY, i) = c.midpoint[1];
        column(FacingNormalX, i) = c.normal[0];
        column(FacingNormalY, i) = c.normal[1];
        column(FacingLength, i) = c.length;
        column(FacingGap, i) = h.gap;
        column(FacingCellX, i) = cell_centre[0];
        column(FacingCellY, i) = cell_centre[1];
        column(FacingMaterial, i) = c.material;
        column(FacedMaterial, i) = segment(h.segment).material;
      });
  return {facing.bins, column};
}

} // namespace Harmos
