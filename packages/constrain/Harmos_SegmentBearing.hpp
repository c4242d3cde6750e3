// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SEGMENT_BEARING_HPP
#define HARMOS_SEGMENT_BEARING_HPP

#include <Harmos_ConstraintOptions.hpp>
#include <Harmos_InterfaceSegments.hpp>

namespace Harmos
{

/// How tractions act on the segments of interfaces: in balance with the stress of the materials on both sides.
struct SegmentBearing
{
  View<ShortSegments *> of_material; // extent 0: all Dropped
  double least_length;               // ConstraintOptions::shortest_segment
  Placement placement;
  View<int *> fluid; // by material; extent 0: none

  KOKKOS_INLINE_FUNCTION ShortSegments shortSegments(int material) const
  {
    return material >= 0 && of_material.extent(0) > 0 ? of_material(material) : ShortSegments::Dropped;
  }

  /// Whether a material is a fluid, whose pressure acts on all of its outline.
  KOKKOS_INLINE_FUNCTION bool presses(int material) const
  {
    return material >= 0 && fluid.extent(0) > 0 && fluid(material) != 0;
  }

  KOKKOS_INLINE_FUNCTION bool isPressed(InterfaceSegment const &a) const { return presses(a.material); }

  /// What balances the traction of segment a, where both sides of an interface end in its cell: beside a wall there is
  /// no cell that is full. Halves of segments do so for mortar multipliers; elsewhere two points want to be apart.
  KOKKOS_INLINE_FUNCTION ShortSegments balance(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    ShortSegments const of_a = shortSegments(a.material), of_b = shortSegments(b.material);
    if ((a.parts > 1 && placement != Placement::Mortar) || a.face >= 0 || b.cell != a.cell)
      return ShortSegments::Dropped;
    if (of_a == ShortSegments::Kept || of_b == ShortSegments::Kept)
      return ShortSegments::Kept;
    bool const shared = of_a == ShortSegments::Shared || of_b == ShortSegments::Shared;
    return shared && b.material >= 0 ? ShortSegments::Shared : ShortSegments::Dropped;
  }

  /// Length below which segment a carries no row of its own, in a cell of this fullness. Rows that share multipliers
  /// are not too many however short their segments are. [length]
  KOKKOS_INLINE_FUNCTION double shortest(InterfaceSegment const &a, InterfaceSegment const &b, double full) const
  {
    ShortSegments const found = balance(a, b);
    if (found == ShortSegments::Kept)
      return 0.0;
    return (found == ShortSegments::Shared && sharesMultipliers(placement) ? 1.0 - full : 1.0) * least_length *
           a.cell_size;
  }
};

} // namespace Harmos

#endif
