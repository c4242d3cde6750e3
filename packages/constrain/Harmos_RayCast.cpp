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

/// The box of midpoints of segments that a ray from -overlap to one cell size can meet.
KOKKOS_INLINE_FUNCTION void rayBox(InterfaceSegment const &s, double reach, Vector2 &low, Vector2 &high)
{
  Vector2 const tail = s.point - deepest_overlap * s.cell_size * s.normal;
  Vector2 const head = s.point + s.cell_size * s.normal;
  for (int d = 0; d < 2; ++d)
  {
    low[d] = Math::min(tail[d], head[d]) - reach;
    high[d] = Math::max(tail[d], head[d]) + reach;
  }
}

KOKKOS_INLINE_FUNCTION RayHit castRay(Mesh const &mesh, View<InterfaceSegment *> const &segment,
                                      SegmentBins const &bins, int from)
{
  InterfaceSegment const &s = segment(from);
  RayHit hit{-1, 0.0, 0.0};
  if (s.material < 0)
    return hit;
  Vector2 low, high;
  rayBox(s, 0.26 * bins.size, low, high); // half the longest segment and a little
  double nearest = s.cell_size;
  bins.forEach(low, high,
               [&](int to)
               {
                 InterfaceSegment const &target = segment(to);
                 double distance;
                 if (target.material == s.material || !crossSegment(s.point, s.normal, target, distance))
                   return;
                 double const apart = Math::fabs(distance);
                 if (apart > nearest || (apart == nearest && hit.segment >= 0 && to > hit.segment))
                   return;
                 if (distance < -1e-7 * s.cell_size &&
                     (apart > deepest_overlap * s.cell_size || shareNode(mesh, s.cell, target.cell)))
                   return;
                 nearest = apart;
                 hit = {to, Math::max(distance, 0.0), -dot(s.normal, target.normal)};
               });
  return hit;
}

} // namespace

View<RayHit *> castRays(Mesh const &mesh, InterfaceSegments const &segments, SegmentBins const &bins)
{
  View<RayHit *> const hit(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::hit"), segments.count);
  View<InterfaceSegment *> const segment = segments.segment;
  Kokkos::parallel_for(
      "Harmos::constrain::castRays", RangePolicy(0, segments.count),
      KOKKOS_LAMBDA(int i) { hit(i) = castRay(mesh, segment, bins, i); });
  return hit;
}

} // namespace Harmos
