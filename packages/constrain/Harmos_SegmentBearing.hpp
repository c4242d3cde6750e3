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
  View<ShortSegments *> kept; // materials; extent 0: all Dropped
  double least_length;        // ConstraintOptions::shortest_segment

  KOKKOS_INLINE_FUNCTION ShortSegments shortSegments(int material) const
  {
    return material >= 0 && kept.extent(0) > 0 ? kept(material) : ShortSegments::Dropped;
  }

  /// What balances the traction of segment a, where both sides of an undivided interface end in its cell: beside a
  /// wall there is no cell that is full.
  KOKKOS_INLINE_FUNCTION ShortSegments balance(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    ShortSegments const of_a = shortSegments(a.material), of_b = shortSegments(b.material);
    if (a.parts > 1 || a.face >= 0 || b.cell != a.cell)
      return ShortSegments::Dropped;
    if (of_a == ShortSegments::Kept || of_b == ShortSegments::Kept)
      return ShortSegments::Kept;
    bool const full = of_a == ShortSegments::KeptInFullCells || of_b == ShortSegments::KeptInFullCells;
    return full && b.material >= 0 ? ShortSegments::KeptInFullCells : ShortSegments::Dropped;
  }

  /// Whether the traction of segment a acts over all of it.
  KOKKOS_INLINE_FUNCTION bool bearsWhole(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    return balance(a, b) != ShortSegments::Dropped;
  }

  /// Length below which segment a carries no row. [cells]
  KOKKOS_INLINE_FUNCTION double shortest(Mesh const &mesh, CellMaterialPairs const &pairs, FilledRegions const &regions,
                                         InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    ShortSegments const found = balance(a, b);
    if (found == ShortSegments::Dropped)
      return least_length;
    return found == ShortSegments::Kept ? 0.0 : (1.0 - fullness(mesh, pairs, regions, a.cell)) * least_length;
  }
};

} // namespace Harmos

#endif
