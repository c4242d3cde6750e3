// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RAY_CAST_HPP
#define HARMOS_RAY_CAST_HPP

#include <Harmos_SegmentBins.hpp>

namespace Harmos
{

/// Least cosine of the angle between a ray and the reversed normal of a surface that faces it.
constexpr double facing_cosine = 0.5;

/// Deepest overlap of bodies on separate meshes that a ray still finds. [cell sizes]
constexpr double deepest_overlap = 0.25;

/// What the normal ray of a segment's point meets first.
struct RayHit
{
  int segment;   // -1: nothing faces it within one cell size
  double gap;    // along the ray, >= 0 [length]
  double cosine; // of the ray with the reversed normal of the segment that it meets
};

/// Distance along a ray at which it crosses a facing segment, with a small tolerance at the segment's ends.
/// \return False when it does not cross, or the segment does not face it.
/// \param target An InterfaceSegment or a BinnedSegment.
template <class Segment>
KOKKOS_INLINE_FUNCTION bool crossSegment(Vector2 const &origin, Vector2 const &direction, Segment const &target,
                                         double &distance)
{
  double const slope = dot(direction, target.normal);
  if (slope > -facing_cosine)
    return false;
  distance = dot(target.midpoint - origin, target.normal) / slope;
  Vector2 const crossing = origin + distance * direction;
  double const along = dot(crossing - target.midpoint, perpendicular(target.normal));
  return Math::fabs(along) <= 0.5 * target.length + 1e-7 * target.cell_size;
}

/// Cast the normal ray of every segment of a material to the nearest facing segment of another material or wall, within
/// one cell size: finds a shared interface edge, two regions that meet on a face, a gap in a cell and a gap across
/// cells alike.
///
/// A facing surface behind the origin counts (gap 0) within round-off, and where the two cells share no node (blocks of
/// a moving mesh that overlap slightly) down to deepest_overlap.
View<RayHit *> castRays(Mesh const &mesh, InterfaceSegments const &segments, SegmentBins const &bins);

} // namespace Harmos

#endif
