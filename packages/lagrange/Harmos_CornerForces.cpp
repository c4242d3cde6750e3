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
      "Harmos::lagrange::cornerForces", RangePolicy(0, numPacks(pairs.num_pairs)), KOKKOS_LAMBDA(int block) {
        detail::forPackedPairs(pairs, block,
                               [&](int number, int const *pair, unsigned lanes)
                               {
                                 Material const material = materials(number);
                                 int cell[pack_width];
                                 for (int lane = 0; lane < pack_width; ++lane)
                                   cell[lane] = pairs.cell(pair[lane]);
                                 detail::Corners<Pack> f = {};
                                 if (material.rigid_body < 0)
                                   f = detail::pairForces(material, options, detail::loadPackedRecord(record, pair),
                                                          detail::packedCorners(mesh, cell),
                                                          detail::packedVelocities(pairs, velocity, pair));
                                 Pack const row[8] = {f.x[0], f.y[0], f.x[1], f.y[1], f.x[2], f.y[2], f.x[3], f.y[3]};
                                 storeRows(row, lanes, [&](int lane) { return &corner_force(pair[lane], 0); });
                               });
      });
}

} // namespace Harmos
