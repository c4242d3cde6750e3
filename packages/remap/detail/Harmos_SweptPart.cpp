// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Remap.hpp>

namespace Harmos
{

double largestSweptPart(Mesh const &mesh, CellMaterialPairs const &pairs, View<double *[2]> const &half, double dt,
                        View<double *[2]> const &start)
{
  View<double *[2]> const from = start.extent(0) > 0 ? start : mesh.node_position;
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::remap::largestSweptPart", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, double &most) {
        if (pairs.cell_kind(cell) != PureCell || mesh.cell_depth(cell) != 0)
          return;
        Vector2 moved[4], home[4];
        for (int k = 0; k < 4; ++k)
        {
          int const node = mesh.cell_node(cell, k), dof = pairs.dof_node(pairs.offset(cell), k);
          home[k] = {mesh.node_position(node, 0), mesh.node_position(node, 1)};
          moved[k] = Vector2{from(node, 0), from(node, 1)} + dt * Vector2{half(dof, 0), half(dof, 1)};
        }
        double const area = 0.5 * cross(moved[2] - moved[0], moved[3] - moved[1]);
        double out = 0.0;
        for (int k = 0; k < 4; ++k)
        {
          int const l = (k + 1) % 4;
          Vector2 const edge = 0.5 * ((moved[l] - moved[k]) + (home[l] - home[k]));
          out += Math::max(0.0, 0.5 * cross(edge, (home[k] - moved[k]) + (home[l] - moved[l])));
        }
        most = Math::max(most, out / area);
      },
      Kokkos::Max<double>(largest));
  return largest;
}

} // namespace Harmos
