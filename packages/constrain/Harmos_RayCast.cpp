// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_RayCast.hpp>

namespace Harmos
{

View<RayHit *> castRays(Mesh const &mesh, InterfaceSegments const &segments, SegmentBins const &bins,
                        WorkArrays const &work)
{
  View<RayHit *> const hit = work.unset<RayHit *>("Harmos::constrain::hit", segments.count);
  launchFor(
      "Harmos::constrain::castRays", segments.count,
      KOKKOS_LAMBDA(int i) { hit(i) = castRay(mesh, segments, bins, segments.segment(i), i); });
  return hit;
}

} // namespace Harmos
