// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Partition.hpp>

#include <metis.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>

namespace Harmos
{

namespace
{

constexpr int many_groups = 20000; // fewer cost METIS next to nothing
constexpr int many_of_part = 8000; // a quarter of that balances still
constexpr int few_parts = 8;       // recursive bisection is as fast, and cuts less
constexpr int trials = 16;         // the least cut of so many is taken
constexpr int face_weight = 10;
constexpr int face_weight_within_run = 13; // between cells whose numbers follow each other

/// Cells that stay on one rank together.
struct Groups
{
  std::vector<int> of_cell;
  int count = 0;
};

/// The groups that meet at a node, one a cell, become one where none of them has become part of another: on a grid
/// blocks of 2 x 2.
Groups merged(HostRows const &node_cell, Groups const &groups)
{
  std::vector<int> renamed(groups.count, -1);
  Groups result{groups.of_cell, 0};
  std::vector<int> meeting;
  for (std::size_t n = 0; n + 1 < node_cell.offset.size(); ++n)
  {
    bool apart = node_cell.offset[n + 1] - node_cell.offset[n] > 2;
    meeting.clear();
    for (int i = node_cell.offset[n]; apart && i < node_cell.offset[n + 1]; ++i)
    {
      int const group = groups.of_cell[node_cell.item[i] / 4];
      apart = renamed[group] < 0 && std::find(meeting.begin(), meeting.end(), group) == meeting.end();
      meeting.push_back(group);
    }
    if (apart)
    {
      for (int const group : meeting)
        renamed[group] = result.count;
      ++result.count;
    }
  }
  for (int &name : renamed)
    if (name < 0)
      name = result.count++;
  for (int &group : result.of_cell)
    group = renamed[group];
  return result;
}

/// What METIS partitions: groups, with edges of the weights of all faces between them.
struct GroupGraph
{
  std::vector<idx_t> offset, neighbour, edge_weight, weight;
};

GroupGraph groupGraph(HostMesh const &mesh, HostRows const &node_cell, Groups const &groups,
                      std::vector<int> const &cell_weight)
{
  std::vector<int> first(groups.count + 1, 0), cell(mesh.cell.size());
  for (int const group : groups.of_cell)
    ++first[group + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> next(first.begin(), first.end() - 1);
  for (std::size_t c = 0; c < mesh.cell.size(); ++c)
    cell[next[groups.of_cell[c]]++] = static_cast<int>(c);

  GroupGraph graph;
  graph.offset.assign(1, 0);
  graph.weight.assign(groups.count, 0);
  std::vector<idx_t> edge(groups.count, -1); // of the present group, to each other
  for (int g = 0; g < groups.count; ++g)
  {
    for (int i = first[g]; i < first[g + 1]; ++i)
    {
      graph.weight[g] += cell_weight.empty() ? 1 : cell_weight[cell[i]];
      for (int k = 0; k < 4; ++k)
      {
        int const opposite = oppositeFace(mesh, node_cell, cell[i], k);
        int const other = opposite < 0 ? g : groups.of_cell[opposite / 4];
        if (other == g)
          continue;
        if (edge[other] < graph.offset[g])
        {
          edge[other] = static_cast<idx_t>(graph.neighbour.size());
          graph.neighbour.push_back(other);
          graph.edge_weight.push_back(0);
        }
        bool const within_run = std::abs(opposite / 4 - cell[i]) == 1;
        graph.edge_weight[edge[other]] += within_run ? face_weight_within_run : face_weight;
      }
    }
    graph.offset.push_back(static_cast<idx_t>(graph.neighbour.size()));
  }
  return graph;
}

} // namespace

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
  Groups groups{std::vector<int>(num_cells), static_cast<int>(num_cells)};
  std::iota(groups.of_cell.begin(), groups.of_cell.end(), 0);
  while (groups.count > many_groups && groups.count / parts > many_of_part)
  {
    Groups coarser = merged(node_cell, groups);
    if (coarser.count == groups.count)
      break;
    groups = std::move(coarser);
  }
  GroupGraph graph = groupGraph(mesh, node_cell, groups, weight);

  bool const recursive = parts <= few_parts && groups.count > 10 * parts;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_NCUTS] = trials;
  options[METIS_OPTION_UFACTOR] = recursive ? 1 : 10; // heaviest part at most 1.001 or 1.010 times the mean
  idx_t vertices = groups.count, constraints = 1, num_parts = parts, cut = 0;
  std::vector<idx_t> part(groups.count);
  auto const partition = recursive ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  int const status =
      partition(&vertices, &constraints, graph.offset.data(), graph.neighbour.data(), graph.weight.data(), nullptr,
                graph.edge_weight.data(), &num_parts, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK)
    throw std::runtime_error("partition: METIS returned error " + std::to_string(status) + " for " +
                             std::to_string(num_cells) + " cells on " + std::to_string(parts) + " ranks");
  for (std::size_t c = 0; c < num_cells; ++c)
    owner[c] = static_cast<int>(part[groups.of_cell[c]]);
  return owner;
}

} // namespace Harmos
