// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_NodeEnds.hpp>

#include <algorithm>

namespace Harmos
{

std::vector<int> nodeEnds(Mesh const &mesh, int cells)
{
  auto const offset = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_cell.offset);
  auto const item = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_cell.item);
  std::vector<int> ends(std::max(1, (mesh.num_cells + cells - 1) / cells), mesh.num_nodes);
  int reached = 0; // piece of the nodes so far
  for (int node = 0; node < mesh.num_nodes; ++node)
  {
    if (offset(node) == offset(node + 1))
      continue;
    int const last = item(offset(node + 1) - 1) / 4 / cells; // ascending
    for (; reached < last; ++reached)
      ends[reached] = node;
  }
  return ends;
}

} // namespace Harmos
