// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Partition.hpp>

#include <metis.h>

#include <stdexcept>
#include <string>

namespace Harmos
{

std::vector<int> partitionCells(HostMesh const &mesh, int parts, std::vector<int> const &weight)
{
  std::size_t const num_cells = mesh.cell.size();
  if (parts < 1)
    throw std::runtime_error("partition: parts = " + std::to_string(parts) + " < 1");
  if (!weight.empty() && weight.size() != num_cells)
    throw std::runtime_error("partition: " + std::to_string(num_cells) + " cells but weights of " +
                             std::to_string(weight.size()));
  std::vector<int> owner(num_cells, 0);
  if (parts == 1 || num_cells == 0)
    return owner;

  HostRows const node_cell = cellsAroundNodes(mesh);
  std::vector<idx_t> offset(1, 0), neighbour, cell_weight(weight.begin(), weight.end());
  for (std::size_t c = 0; c < num_cells; ++c)
  {
    for (int k = 0; k < 4; ++k)
    {
      int const opposite = oppositeFace(mesh, node_cell, static_cast<int>(c), k);
      if (opposite >= 0)
        neighbour.push_back(opposite / 4);
    }
    offset.push_back(static_cast<idx_t>(neighbour.size()));
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_UFACTOR] = 10; // heaviest part at most 1.010 times the mean
  idx_t vertices = static_cast<idx_t>(num_cells), constraints = 1, num_parts = parts, cut = 0;
  std::vector<idx_t> part(num_cells);
  int const status = METIS_PartGraphKway(&vertices, &constraints, offset.data(), neighbour.data(),
                                         cell_weight.empty() ? nullptr : cell_weight.data(), nullptr, nullptr,
                                         &num_parts, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK)
    throw std::runtime_error("partition: METIS returned error " + std::to_string(status) + " for " +
                             std::to_string(num_cells) + " cells on " + std::to_string(parts) + " ranks");
  owner.assign(part.begin(), part.end());
  return owner;
}

} // namespace Harmos
