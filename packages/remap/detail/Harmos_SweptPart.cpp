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
        Quadrilateral moved, home;
        moved.size = home.size = 4;
        for (int k = 0; k < 4; ++k)
        {
          int const node = mesh.cell_node(cell, k), dof = pairs.dof_node(pairs.offset(cell), k);
          home[k] = {mesh.node_position(node, 0), mesh.node_position(node, 1)};
          moved[k] = Vector2{from(node, 0), from(node, 1)} + dt * Vector2{half(dof, 0), half(dof, 1)};
        }
        double out = 0.0;
        for (int k = 0; k < 4; ++k)
        {
          int const l = (k + 1) % 4;
          Quadrilateral const swept{4, {moved[k], moved[l], home[l], home[k]}};
          out += Math::max(0.0, volume(swept, mesh.geometry));
        }
        most = Math::max(most, out / volume(moved, mesh.geometry));
      },
      Kokkos::Max<double>(largest));
  return largest;
}

} // namespace Harmos
