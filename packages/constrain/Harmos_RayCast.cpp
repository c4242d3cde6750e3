// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_RayCast.hpp>

namespace Harmos
{

namespace
{

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

KOKKOS_INLINE_FUNCTION RayHit castRay(Mesh const &mesh, View<InterfaceSegment *> const &segment, int count,
                                      SegmentBins const &bins, int from)
{
  Ray ray(segment(from));
  int const cell = segment(from).cell;
  if (segment(from).material < 0)
    return ray.hit;
  // The own cell's segments first: where the interface is shared the ray ends at once.
  constexpr double shared = 1e-10; // apart, of the cell
  for (int to = from - 1; to >= 0 && segment(to).cell == cell; --to)
    ray.offer(mesh, segment(to), to);
  for (int to = from + 1; to < count && segment(to).cell == cell; ++to)
    ray.offer(mesh, segment(to), to);
  if (ray.hit.segment >= 0 && ray.nearest <= shared * segment(from).cell_size)
    return ray.hit;
  Vector2 low, high;
  ray.box(0.52 * bins.size, low, high); // half the longest segment and a little
  if (bins.holdOthers(low, high, segment(from).material))
    bins.forEach(low, high, [&](int, BinnedSegment const &target) { ray.offer(mesh, target, target.segment); });
  return ray.hit;
}

} // namespace

View<RayHit *> castRays(Mesh const &mesh, InterfaceSegments const &segments, SegmentBins const &bins)
{
  View<RayHit *> const hit(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::hit"), segments.count);
  View<InterfaceSegment *> const segment = segments.segment;
  int const count = segments.count;
  Kokkos::parallel_for(
      "Harmos::constrain::castRays", RangePolicy(0, segments.count),
      KOKKOS_LAMBDA(int i) { hit(i) = castRay(mesh, segment, count, bins, i); });
  return hit;
}

} // namespace Harmos
