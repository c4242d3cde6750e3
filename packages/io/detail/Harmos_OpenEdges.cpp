// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_OpenEdges.hpp>

#include <algorithm>

namespace Harmos
{

void addCoveredParts(Vector2 const &a, Vector2 const &b, Region const &other, int material, double tolerance,
                     std::vector<EdgePart> &parts)
{
  Vector2 const edge = b - a;
  double const length2 = dot(edge, edge);
  double const reach = tolerance * norm(edge); // cross products below it: distance to the line below the tolerance
  for (int i = 0; i < other.size; ++i)
  {
    Vector2 const c = other[i];
    Vector2 const d = other[other.next(i)];
    if (Math::fabs(cross(edge, c - a)) > reach || Math::fabs(cross(edge, d - a)) > reach || dot(edge, d - c) >= 0.0)
      continue;
    double const begin = Math::max(0.0, dot(edge, d - a) / length2);
    double const end = Math::min(1.0, dot(edge, c - a) / length2);
    if ((end - begin) * (end - begin) * length2 > tolerance * tolerance && end > begin)
      parts.push_back({begin, end, material});
  }
}

std::vector<EdgePart> uncoveredParts(std::vector<EdgePart> parts, double least)
{
  std::sort(parts.begin(), parts.end(), [](EdgePart const &p, EdgePart const &q) { return p.begin < q.begin; });
  std::vector<EdgePart> rest;
  double reached = 0.0;
  for (auto const &part : parts)
  {
    if (part.begin > reached + least)
      rest.push_back({reached, part.begin, -1});
    reached = std::max(reached, part.end);
  }
  if (1.0 > reached + least)
    rest.push_back({reached, 1.0, -1});
  return rest;
}

} // namespace Harmos
