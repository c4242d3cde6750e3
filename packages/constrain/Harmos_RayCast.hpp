// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RAY_CAST_HPP
#define HARMOS_RAY_CAST_HPP

#include <Harmos_SegmentBins.hpp>

namespace Harmos
{

/// Widest void through which two sides touch. [cells]
constexpr double touching_gap = 1e-3;

/// Least cosine of the angle between a ray and the reversed normal of a surface that faces it.
constexpr double facing_cosine = 0.5;

/// Deepest overlap of bodies on separate meshes that a ray still finds. [cell sizes]
constexpr double deepest_overlap = 0.25;

/// More than what crossSegment adds at the ends of a segment. [bins]
constexpr double crossing_slack = 1e-6;

/// What the normal ray of a segment's point meets first.
struct RayHit
{
  int segment;   // -1: nothing faces it within one cell size
  double gap;    // along the ray, >= 0 [length]
  double cosine; // of the ray with the reversed normal of the segment that it meets
};

/// Whether the ray of a segment meets something that touches it.
KOKKOS_INLINE_FUNCTION bool touches(InterfaceSegment const &s, RayHit const &hit)
{
  return hit.segment >= 0 && hit.gap <= touching_gap * s.cell_size;
}

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

KOKKOS_INLINE_FUNCTION bool shareNode(Mesh const &mesh, int cell, int other)
{
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (mesh.cell_node(cell, i) == mesh.cell_node(other, j))
        return true;
  return false;
}

/// A ray on its way: the nearest crossing so far, ties to the lower number. What it meets in the end does not depend on
/// the order in which it is offered the targets.
struct Ray
{
  InterfaceSegment const &from;
  double nearest;
  RayHit hit;

  KOKKOS_INLINE_FUNCTION explicit Ray(InterfaceSegment const &s) : from(s), nearest(s.cell_size), hit{-1, 0.0, 0.0} {}

  template <class Segment>
  KOKKOS_INLINE_FUNCTION void offer(Mesh const &mesh, Segment const &target, int number)
  {
    if (target.material == from.material)
      return;
    Vector2 const apart_by = target.midpoint - from.point;
    double const farthest = nearest + 0.5 * target.length + 1e-6 * target.cell_size;
    double distance;
    if (dot(apart_by, apart_by) > farthest * farthest || !crossSegment(from.point, from.normal, target, distance))
      return;
    double const apart = Math::fabs(distance);
    if (apart > nearest || (apart == nearest && hit.segment >= 0 && number > hit.segment))
      return;
    if (distance < -1e-7 * from.cell_size &&
        (apart > deepest_overlap * from.cell_size || shareNode(mesh, from.cell, target.cell)))
      return;
    nearest = apart;
    hit = {number, Math::max(distance, 0.0), -dot(from.normal, target.normal)};
  }

  /// Whether a segment of the own body lies across the ray before what it meets.
  KOKKOS_INLINE_FUNCTION bool isStoppedBy(BinnedSegment const &target) const
  {
    double distance;
    return target.material == from.material && crossSegment(from.point, from.normal, target, distance) &&
           distance >= 0.0 && distance < hit.gap;
  }

  /// The segments at places i, i + 1, ... below `end` of the bins that `offer` may not turn down at once: a bit each.
  KOKKOS_FORCEINLINE_FUNCTION unsigned candidates(SegmentBins const &bins, int i, int end) const
  {
    constexpr double slack = 1e-9; // more than round-off
    Pack const x = loadPack(&bins.column(BinX, i)) - Pack(from.point[0]);
    Pack const y = loadPack(&bins.column(BinY, i)) - Pack(from.point[1]);
    Pack const farthest = Pack((1.0 + slack) * nearest) + Pack(1.0 + slack) * loadPack(&bins.column(BinExtent, i));
    Pack const slope = Pack(from.normal[0]) * loadPack(&bins.column(BinNormalX, i)) +
                       Pack(from.normal[1]) * loadPack(&bins.column(BinNormalY, i));
    auto const near = both(x * x + y * y <= farthest * farthest, slope <= Pack(slack - facing_cosine));
    auto const other = no(loadPack(&bins.column(BinMaterial, i)) == Pack(from.material));
    return lanesOf(both(both(near, other), laneNumbers() < Pack(end - i)));
  }

  /// The box of midpoints of segments that the rest of the ray can meet.
  KOKKOS_INLINE_FUNCTION void box(double reach, Vector2 &low, Vector2 &high) const
  {
    Vector2 const tail = from.point - Math::min(nearest, deepest_overlap * from.cell_size) * from.normal;
    Vector2 const head = from.point + nearest * from.normal;
    for (int d = 0; d < 2; ++d)
    {
      low[d] = Math::min(tail[d], head[d]) - reach;
      high[d] = Math::max(tail[d], head[d]) + reach;
    }
  }
};

/// Whether a point lies deeper than `depth` within a cell.
KOKKOS_INLINE_FUNCTION bool liesWithin(Mesh const &mesh, int cell, Vector2 const &point, double depth)
{
  Quadrilateral const q = cellQuadrilateral(mesh, cell);
  for (int k = 0; k < 4; ++k)
  {
    Vector2 const face = q[(k + 1) & 3] - q[k];
    double const inward = cross(face, point - q[k]);
    if (!(inward > 0.0 && inward * inward > depth * depth * dot(face, face)))
      return false;
  }
  return true;
}

/// The normal ray of a segment's point. \param from Segment `number`, or a part of it.
KOKKOS_INLINE_FUNCTION RayHit castRay(Mesh const &mesh, InterfaceSegments const &segments, SegmentBins const &bins,
                                      InterfaceSegment const &from, int number)
{
  Ray ray(from);
  View<InterfaceSegment *> const &segment = segments.segment;
  int const cell = from.cell, count = segments.count;
  if (from.material < 0)
    return ray.hit;
  // The own cell's segments first, and those across the face on which it lies: where the interface is shared the ray
  // ends at once.
  constexpr double shared = 1e-10; // apart, of the cell
  for (int to = number - 1; to >= 0 && segment(to).cell == cell; --to)
    ray.offer(mesh, segment(to), to);
  for (int to = number + 1; to < count && segment(to).cell == cell; ++to)
    ray.offer(mesh, segment(to), to);
  int const face = from.face >= 0 ? mesh.face_neighbour(cell, from.face) : -1; // of the cell across
  for (int to = face >= 0 ? segments.firstOf(face / 4) : count; to < count && segment(to).cell == face / 4; ++to)
    ray.offer(mesh, segment(to), to);
  if (ray.hit.segment >= 0 && ray.nearest <= shared * from.cell_size)
    return ray.hit;
  // Nor can other cells hold anything nearer than what lies nearer than they do: thin voids between two bodies.
  if (ray.hit.segment >= 0 && liesWithin(mesh, cell, from.point, ray.nearest + crossing_slack * bins.size))
    return ray.hit;
  Vector2 low, high;
  ray.box(0.52 * bins.size, low, high); // half the longest segment and a little
  if (bins.holdOthers(low, high, from.material))
    bins.forEachRun(low, high,
                    [&](int begin, int end)
                    {
                      for (int i = begin; i < end; i += pack_width)
                      {
                        unsigned const lanes = ray.candidates(bins, i, end);
                        for (int lane = 0; lanes >> lane != 0; ++lane)
                          if ((lanes >> lane & 1u) != 0)
                            ray.offer(mesh, bins.item(i + lane), bins.item(i + lane).segment);
                      }
                    });
  if (ray.hit.segment < 0 || ray.hit.gap <= touching_gap * from.cell_size)
    return ray.hit;
  bool stopped = false; // by the other side of a crack in its own body
  ray.box(0.52 * bins.size, low, high);
  bins.forEach(low, high, [&](int, BinnedSegment const &target) { stopped = stopped || ray.isStoppedBy(target); });
  return stopped ? RayHit{-1, 0.0, 0.0} : ray.hit;
}

/// Cast the normal ray of every segment of a material to the nearest facing segment of another material or wall, within
/// one cell size: finds a shared interface edge, two regions that meet on a face, a gap in a cell and a gap across
/// cells alike.
///
/// A facing surface behind the origin counts (gap 0) within round-off, and where the two cells share no node (blocks of
/// a moving mesh that overlap slightly) down to deepest_overlap. A ray that meets its own body first, across a crack in
/// it, meets nothing but what it touches (touching_gap): the crack is in a film then that lies on the other body.
View<RayHit *> castRays(Mesh const &mesh, InterfaceSegments const &segments, SegmentBins const &bins,
                        WorkArrays const &work = {});

} // namespace Harmos

#endif
