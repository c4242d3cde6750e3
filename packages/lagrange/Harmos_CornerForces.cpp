// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <detail/Harmos_PairAccess.hpp>

namespace Harmos
{

void computeCornerForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                         View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork &work)
{
  auto const record = state.record;
  auto const velocity = state.velocity;
  auto const corner_force = work.corner_force;
  Kokkos::parallel_for(
      "Harmos::lagrange::cornerForces", RangePolicy(0, pairs.num_pairs), KOKKOS_LAMBDA(int pair) {
        Material const &material = materials(pairs.material(pair));
        detail::Corners<double> f = {};
        if (material.rigid_body < 0)
          f = detail::pairForces(material, options, detail::loadRecord(record, pair),
                                 detail::cellCorners(mesh, pairs.cell(pair)),
                                 detail::cornerVelocities(pairs, velocity, pair));
        for (int k = 0; k < 4; ++k)
        {
          corner_force(pair, 2 * k) = f.x[k];
          corner_force(pair, 2 * k + 1) = f.y[k];
        }
      });
}

} // namespace Harmos
