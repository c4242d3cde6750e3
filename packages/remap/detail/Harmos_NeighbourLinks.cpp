// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_NeighbourLinks.hpp>

#include <detail/Harmos_CornerRotation.hpp>
#include <detail/Harmos_RemapInput.hpp>

#include <stdexcept>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

KOKKOS_INLINE_FUNCTION int slotOf(Mesh const &mesh, int cell, int neighbour)
{
  int const begin = mesh.cell_neighbour.offset(cell);
  for (int j = begin; j < mesh.cell_neighbour.offset(cell + 1); ++j)
    if (mesh.cell_neighbour.item(j) == neighbour)
      return 1 + j - begin;
  return 0;
}

int mostSlots(Mesh const &mesh)
{
  int most = 0;
  Kokkos::parallel_reduce(
      "Harmos::remap::mostSlots", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &largest) {
        largest = Math::max(largest, mesh.cell_neighbour.offset(cell + 1) - mesh.cell_neighbour.offset(cell));
      },
      Kokkos::Max<int>(most));
  return 1 + (mesh.num_cells > 0 ? most : 0);
}

} // namespace

NeighbourLinks linkNeighbours(Mesh const &mesh)
{
  NeighbourLinks links;
  links.slots = mostSlots(mesh);
  if (links.slots > most_slots)
    throw std::runtime_error("remap: a cell has " + std::to_string(links.slots - 1) + " vertex neighbours, more than " +
                             std::to_string(most_slots - 1));
  View<unsigned char *> const link = scratch<unsigned char *>("links", mesh.cell_neighbour.item.extent(0));
  Kokkos::parallel_for(
      "Harmos::remap::linkNeighbours", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
        {
          int const neighbour = mesh.cell_neighbour.item(j);
          link(j) =
              static_cast<unsigned char>(4 * slotOf(mesh, neighbour, cell) + cornerRotation(mesh, cell, neighbour));
        }
      });
  links.link = link;
  return links;
}

void boxCells(Mesh const &mesh, NeighbourLinks &links)
{
  if (links.box.extent(0) == 0)
    links.box = scratch<double *[4]>("boxes", mesh.num_cells);
  View<double *[4]> const box = links.box;
  Kokkos::parallel_for(
      "Harmos::remap::boxes", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        Quadrilateral const q = cellQuadrilateral(mesh, cell);
        for (int d = 0; d < 2; ++d)
        {
          box(cell, d) = Math::min(Math::min(q[0][d], q[1][d]), Math::min(q[2][d], q[3][d]));
          box(cell, 2 + d) = Math::max(Math::max(q[0][d], q[1][d]), Math::max(q[2][d], q[3][d]));
        }
      });
}

} // namespace RemapDetail
} // namespace Harmos
