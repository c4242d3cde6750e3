// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SEGMENT_BEARING_HPP
#define HARMOS_SEGMENT_BEARING_HPP

#include <Harmos_ConstraintOptions.hpp>
#include <Harmos_Fullness.hpp>
#include <Harmos_InterfaceSegments.hpp>

namespace Harmos
{

/// How tractions act on the segments of interfaces: in balance with the stress of the materials on both sides.
struct SegmentBearing
{
  Mesh mesh;
  CellMaterialPairs pairs;
  FilledRegions regions;
  View<ShortSegments *> kept; // materials; extent 0: all Dropped
  double least_length;        // ConstraintOptions::shortest_segment

  KOKKOS_INLINE_FUNCTION ShortSegments shortSegments(int material) const
  {
    return material >= 0 && kept.extent(0) > 0 ? kept(material) : ShortSegments::Dropped;
  }

  /// Whether both sides of an undivided interface inside a cell end where segment a does.
  KOKKOS_INLINE_FUNCTION bool insideCell(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    return a.parts == 1 && a.face < 0 && b.cell == a.cell;
  }

  /// Whether the traction of segment a acts over all of it, in balance with the stress of one side at least.
  KOKKOS_INLINE_FUNCTION bool bearsWhole(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    return insideCell(a, b) &&
           (shortSegments(a.material) != ShortSegments::Dropped || shortSegments(b.material) != ShortSegments::Dropped);
  }

  /// Length below which segment a carries no row. [cells]
  KOKKOS_INLINE_FUNCTION double shortest(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    ShortSegments const of_a = shortSegments(a.material), of_b = shortSegments(b.material);
    if (!insideCell(a, b) || (of_a == ShortSegments::Dropped && of_b == ShortSegments::Dropped))
      return least_length;
    if (of_a == ShortSegments::Kept || of_b == ShortSegments::Kept)
      return 0.0;
    return (1.0 - fullness(mesh, pairs, regions, a.cell)) * least_length;
  }
};

} // namespace Harmos

#endif
