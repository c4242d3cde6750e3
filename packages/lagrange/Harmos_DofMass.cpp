// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <detail/Harmos_PairAccess.hpp>

namespace Harmos
{
namespace
{

template <class ViewType>
void grow(ViewType &view, char const *label, int count)
{
  if (static_cast<int>(view.extent(0)) < count)
    view = ViewType(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), count + count / 8);
}

double largestCellVolume(Mesh const &mesh)
{
  auto const volume = mesh.cell_volume;
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::lagrange::largestCellVolume", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, double &most) { most = Math::max(most, volume(cell)); }, Kokkos::Max<double>(largest));
  return largest;
}

} // namespace

void prepareWork(CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes, LagrangeWork &work)
{
  grow(work.corner_force, "Harmos::lagrange::corner_force", pairs.num_pairs);
  if (work.keeps_pressure)
    grow(work.pressure, "Harmos::lagrange::pressure", pairs.num_pairs);
  grow(work.dof_mass, "Harmos::lagrange::dof_mass", dof_nodes.num_dof_nodes);
  grow(work.predicted, "Harmos::lagrange::predicted", dof_nodes.num_dof_nodes);
  grow(work.constrained, "Harmos::lagrange::constrained", dof_nodes.num_dof_nodes);
  work.half = work.constrained;
}

void computeNodeAltitudes(Mesh const &mesh, LagrangeWork &work)
{
  work.largest_cell = largestCellVolume(mesh);
  grow(work.node_altitude, "Harmos::lagrange::node_altitude", mesh.num_nodes);
  auto const node_altitude = work.node_altitude;
  View<double *> const altitude(
      Kokkos::view_alloc(std::string("Harmos::lagrange::cell_altitude"), Kokkos::WithoutInitializing), mesh.num_cells);
  Kokkos::parallel_for(
      "Harmos::lagrange::cellAltitudes", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell) { altitude(cell) = detail::leastAltitude(detail::cellCorners(mesh, cell)); });
  Kokkos::parallel_for(
      "Harmos::lagrange::nodeAltitudes", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        int const first = mesh.node_cell.offset(node);
        double least = 0.0;
        for (int i = first; i < mesh.node_cell.offset(node + 1); ++i)
        {
          double const of_cell = altitude(mesh.node_cell.item(i) / 4);
          least = i == first ? of_cell : Math::min(least, of_cell);
        }
        node_altitude(node) = least;
      });
}

void computeDofMass(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                    PairState const &state, View<Material *> const &materials, LagrangeWork &work)
{
  auto const record = state.record;
  auto const dof_mass = work.dof_mass;
  Kokkos::parallel_for(
      "Harmos::lagrange::dofMass", RangePolicy(0, dof_nodes.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        int const node = dof_nodes.node(dof);
        int const material = dof_nodes.material(dof);
        double mass = 0.0;
        for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
        {
          int const cell = mesh.node_cell.item(i) / 4;
          double const share = mesh.corner_share(cell, mesh.node_cell.item(i) % 4);
          for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
            if ((material < 0 || pairs.material(pair) == material) && materials(pairs.material(pair)).rigid_body < 0)
              mass += share * record(pair, Mass);
        }
        dof_mass(dof) = mass;
      });
}

} // namespace Harmos
