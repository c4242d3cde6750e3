// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BondBins.hpp>
#include <Harmos_OnHost.hpp>

#include <gtest/gtest.h>

#include <random>

using namespace Harmos;

namespace
{

int nearestOfAll(std::vector<Bond> const &bonds, Vector2 const &point, double reach, int low, int high)
{
  double least = reach * reach;
  int found = -1;
  for (std::size_t i = 0; i < bonds.size(); ++i)
  {
    Vector2 const apart = bonds[i].point - point;
    if (bonds[i].material_a == low && bonds[i].material_b == high && dot(apart, apart) < least)
    {
      least = dot(apart, apart);
      found = static_cast<int>(i);
    }
  }
  return found;
}

/// Of BondBins::nearest.
struct Search
{
  Vector2 point;
  double reach;
  int low, high;
};

HostView<int *> nearestOf(BondBins const &bins, std::vector<Search> const &searches)
{
  View<Search *> const search = deviceCopy("search", searches);
  View<int *> const nearest("nearest", searches.size());
  Kokkos::parallel_for(
      "nearestOf", RangePolicy(0, searches.size()), KOKKOS_LAMBDA(int i) {
        Search const &s = search(i);
        nearest(i) = bins.nearest(s.point, s.reach, s.low, s.high);
      });
  return onHost(nearest);
}

} // namespace

TEST(BondBins, findWhatASearchOfAllFinds)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-3.0, 5.0), size(0.05, 0.2);
  std::vector<Bond> bonds;
  for (int i = 0; i < 400; ++i)
    bonds.push_back({{place(random), 0.3 * place(random)}, i % 3 == 0 ? 1 : 0, 2, false, size(random)});
  for (int i = 0; i < 40; ++i) // some twice: the lower number counts
    bonds.push_back(bonds[static_cast<std::size_t>(7 * i)]);
  std::vector<Search> searches;
  for (int i = 0; i < 4000; ++i)
  {
    Vector2 const point = i % 9 == 0 ? bonds[static_cast<std::size_t>(i / 9 % 440)].point
                                     : Vector2{1.2 * place(random), 0.4 * place(random)};
    double const reach = 5.0 * size(random); // up to several bins
    searches.push_back({point, reach, i % 2, 2});
  }
  auto const nearest = nearestOf(binBonds(bonds), searches);
  int found = 0;
  for (std::size_t i = 0; i < searches.size(); ++i)
  {
    Search const &s = searches[i];
    EXPECT_EQ(nearest(i), nearestOfAll(bonds, s.point, s.reach, s.low, s.high));
    found += nearest(i) >= 0 ? 1 : 0;
  }
  EXPECT_GT(found, 1000);
  EXPECT_LT(found, 3999);
}

TEST(BondBins, withoutBonds_findNone)
{
  EXPECT_EQ(nearestOf(binBonds({}), {{{0.0, 0.0}, 1.0, 0, 1}})(0), -1);
}
