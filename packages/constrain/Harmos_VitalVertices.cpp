// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_VitalVertices.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace Harmos
{

namespace
{

/// Kind of row, lower and upper node.
using EdgeKey = std::array<long long, 3>;

struct CrossedEdge
{
  EdgeKey key;
  double point[2];
};

} // namespace

std::vector<std::vector<GroupShare>> vitalGroups(std::vector<RowTrace> const &trace, std::vector<int> const &kind,
                                                 int &num_groups)
{
  auto const keyOf = [&](std::size_t row, int e) {
    return EdgeKey{kind[row], trace[row].node[e][0], trace[row].node[e][1]};
  };
  std::map<EdgeKey, int> number;
  std::vector<CrossedEdge> edge;
  std::map<std::array<long long, 2>, std::vector<int>> at_node; // edges at a node, by kind and node
  for (std::size_t row = 0; row < trace.size(); ++row)
    for (int e = 0; e < 2; ++e)
    {
      EdgeKey const key = keyOf(row, e);
      if (!number.insert({key, static_cast<int>(edge.size())}).second)
        continue;
      for (int k = 1; k < (key[1] == key[2] ? 2 : 3); ++k)
        at_node[{key[0], key[k]}].push_back(static_cast<int>(edge.size()));
      edge.push_back({key, {trace[row].point[e][0], trace[row].point[e][1]}});
    }

  auto const neighbours = [&](int i) -> std::size_t {
    return at_node[{edge[i].key[0], edge[i].key[1]}].size() + at_node[{edge[i].key[0], edge[i].key[2]}].size();
  };
  std::vector<std::pair<std::size_t, EdgeKey>> order;
  for (std::size_t i = 0; i < edge.size(); ++i)
    order.push_back({neighbours(static_cast<int>(i)), edge[i].key});
  std::sort(order.begin(), order.end());
  std::vector<int> group(edge.size(), -1);
  std::map<std::array<long long, 2>, int> owner; // vital edge at a node
  num_groups = 0;
  for (auto const &[degree, key] : order)
    if (owner.count({key[0], key[1]}) == 0 && owner.count({key[0], key[2]}) == 0)
    {
      int const i = number[key];
      owner[{key[0], key[1]}] = owner[{key[0], key[2]}] = i;
      group[i] = num_groups++;
    }
  for (auto const &[degree, key] : order)
  {
    int const i = number[key];
    if (group[i] >= 0)
      continue;
    double least = 1e300;
    for (int k = 1; k < 3; ++k)
    {
      auto const found = owner.find({key[0], key[k]});
      if (found == owner.end())
        continue;
      CrossedEdge const &vital = edge[found->second];
      double const apart = std::hypot(vital.point[0] - edge[i].point[0], vital.point[1] - edge[i].point[1]);
      if (apart < least)
        group[i] = group[found->second];
      least = std::min(least, apart);
    }
  }

  std::vector<std::vector<GroupShare>> shares(trace.size());
  std::vector<double> total(num_groups, 0.0);
  for (std::size_t row = 0; row < trace.size(); ++row)
    for (int e = 0; e < 2; ++e)
    {
      int const g = group[number[keyOf(row, e)]];
      double const weight = trace[row].length * trace[row].share[e];
      total[g] += weight;
      if (e == 1 && !shares[row].empty() && shares[row][0].group == g)
        shares[row][0].weight += weight;
      else if (weight > 0.0)
        shares[row].push_back({g, weight});
    }
  for (auto &row : shares)
    for (GroupShare &share : row)
      share.weight /= total[share.group];
  return shares;
}

} // namespace Harmos
