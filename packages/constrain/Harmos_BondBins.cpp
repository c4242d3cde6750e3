// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BondBins.hpp>

#include <algorithm>
#include <utility>

namespace Harmos
{

BondBins binBonds(std::vector<Bond> const &bonds, WorkArrays const &work)
{
  BondBins bins;
  if (bonds.empty())
    return bins;
  double right = bonds[0].point[0];
  bins.corner = bonds[0].point;
  bins.size = 0.0;
  for (Bond const &bond : bonds)
  {
    right = std::max(right, bond.point[0]);
    for (int d = 0; d < 2; ++d)
      bins.corner[d] = std::min(bins.corner[d], bond.point[d]);
    bins.size = std::max(bins.size, bond_reach * bond.cell_size);
  }
  if (!(bins.size > 0.0)) // bonds of a host code that does not tell
    bins.size = 1.0;
  bins.columns = bins.index(right - bins.corner[0]) + 1;
  std::vector<std::pair<long long, int>> place;
  for (std::size_t i = 0; i < bonds.size(); ++i)
  {
    Vector2 const from = bonds[i].point - bins.corner;
    place.emplace_back(bins.index(from[1]) * (bins.columns + 2) + bins.index(from[0]), static_cast<int>(i));
  }
  std::sort(place.begin(), place.end());
  std::vector<long long> bin;
  std::vector<int> number;
  for (auto const &[its_bin, its_number] : place)
  {
    bin.push_back(its_bin);
    number.push_back(its_number);
  }
  bins.bond = work.copyOf("Harmos::constrain::bond", bonds);
  bins.bin = work.copyOf("Harmos::constrain::bond_bin", bin);
  bins.number = work.copyOf("Harmos::constrain::bond_number", number);
  return bins;
}

} // namespace Harmos
