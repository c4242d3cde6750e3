// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_OnHost.hpp>
#include <Harmos_SegmentBins.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>
#include <vector>

using namespace Harmos;

namespace
{

InterfaceSegments segmentsAt(std::vector<Vector2> const &midpoint)
{
  InterfaceSegments s;
  s.count = static_cast<int>(midpoint.size());
  s.segment = View<InterfaceSegment *>("segment", midpoint.size());
  auto const host = Kokkos::create_mirror_view(s.segment);
  for (int i = 0; i < s.count; ++i)
    host(i).midpoint = midpoint[static_cast<std::size_t>(i)];
  Kokkos::deep_copy(s.segment, host);
  return s;
}

std::vector<Vector2> scattered(int count)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-3.0, 5.0);
  std::vector<Vector2> x;
  for (int i = 0; i < count; ++i)
    x.push_back({coordinate(random), coordinate(random)});
  return x;
}

/// What a walk meets, and what it should: by bin row, bin column, number.
std::vector<int> walked(SegmentBins const &bins, Vector2 const &low, Vector2 const &high)
{
  View<int *> const met("met", bins.item.extent(0)), count("count", 1);
  Kokkos::parallel_for(
      "walked", RangePolicy(0, 1), KOKKOS_LAMBDA(int) {
        bins.forEach(low, high, [&](int, BinnedSegment const &s) { met(count(0)++) = s.segment; });
      });
  auto const host = onHost(met);
  return std::vector<int>(host.data(), host.data() + onHost(count)(0));
}

bool holdOthers(SegmentBins const &bins, Vector2 const &low, Vector2 const &high, int material)
{
  View<int *> const hold("hold", 1);
  Kokkos::parallel_for(
      "holdOthers", RangePolicy(0, 1), KOKKOS_LAMBDA(int) { hold(0) = bins.holdOthers(low, high, material) ? 1 : 0; });
  return onHost(hold)(0) == 1;
}

std::vector<int> expected(SegmentBins const &bins, std::vector<Vector2> const &x, Vector2 const &low,
                          Vector2 const &high)
{
  std::vector<std::tuple<int, int, int>> inside;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    int const column = bins.index(x[i][0]), row = bins.index(x[i][1]);
    if (bins.index(low[0]) <= column && column <= bins.index(high[0]) && bins.index(low[1]) <= row &&
        row <= bins.index(high[1]))
      inside.push_back({row, column, static_cast<int>(i)});
  }
  std::sort(inside.begin(), inside.end());
  std::vector<int> number;
  for (auto const &s : inside)
    number.push_back(std::get<2>(s));
  return number;
}

/// 1 for the segments whose numbers are divisible by three.
View<int *> everyThird(SegmentBins const &bins)
{
  View<int *> const chosen("chosen", bins.item.extent(0));
  View<BinnedSegment *> const item = bins.item;
  Kokkos::parallel_for(
      "everyThird", RangePolicy(0, bins.item.extent(0)),
      KOKKOS_LAMBDA(int i) { chosen(i) = item(i).segment % 3 == 0 ? 1 : 0; });
  return chosen;
}

void checkWalks(std::vector<Vector2> const &x, bool hashed)
{
  SegmentBins const bins = binSegments(segmentsAt(x), 0.3);
  EXPECT_EQ(bins.hashed, hashed);
  std::size_t met = 0;
  for (Vector2 const &centre : scattered(40))
  {
    Vector2 const low{centre[0] - 0.7, centre[1] - 0.4}, high{centre[0] + 0.5, centre[1] + 0.9};
    EXPECT_EQ(walked(bins, low, high), expected(bins, x, low, high));
    met += walked(bins, low, high).size();
  }
  EXPECT_GT(met, 100u);
}

} // namespace

TEST(SegmentBins, walkOverABox_meetsItsBinsByRowColumnAndNumber)
{
  checkWalks(scattered(500), false);
}

TEST(SegmentBins, bodiesFarApart_areHashedAndMetInTheSameOrder)
{
  std::vector<Vector2> x = scattered(500);
  x.push_back({4.0e6, -3.0e6});
  checkWalks(x, true);
}

TEST(SegmentBins, noSegments_walksMeetNothing)
{
  SegmentBins const bins = binSegments(segmentsAt({}), 0.0);
  EXPECT_TRUE(walked(bins, {-1.0, -1.0}, {1.0, 1.0}).empty());
}

// A rank without a segment, in memory that held something else.
TEST(SegmentBins, noSegmentsInUsedMemory_noneAreChosen)
{
  WorkArrays work;
  work.begin();
  Kokkos::deep_copy(work.unset<int *>("used", 10000), 77);
  work.begin();
  SegmentBins const bins = binSegments(segmentsAt({}), 0.3, work);
  View<int *> const chosen("chosen", 0);
  SegmentBins const none = chosenItems(bins, chosen, work);
  EXPECT_EQ(none.item.extent(0), 0u);
  EXPECT_TRUE(walked(none, {-1.0, -1.0}, {1.0, 1.0}).empty());
  auto const offset = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), bins.offset);
  EXPECT_EQ(offset(0), 0);
}

TEST(SegmentBins, chosenItems_areMetInTheSameOrderAndNoOthers)
{
  std::vector<Vector2> const x = scattered(300);
  SegmentBins const bins = binSegments(segmentsAt(x), 0.3);
  SegmentBins const third = chosenItems(bins, everyThird(bins));
  for (Vector2 const &centre : scattered(40))
  {
    Vector2 const low{centre[0] - 0.7, centre[1] - 0.4}, high{centre[0] + 0.5, centre[1] + 0.9};
    std::vector<int> expected_numbers;
    for (int number : expected(bins, x, low, high))
      if (number % 3 == 0)
        expected_numbers.push_back(number);
    EXPECT_EQ(walked(third, low, high), expected_numbers);
  }
}

TEST(SegmentBins, boxWithOneMaterialAlone_holdsNoOthers)
{
  std::vector<Vector2> x;
  for (int i = 0; i < 40; ++i)
    x.push_back({0.1 * i, 0.05});
  InterfaceSegments const segments = segmentsAt(x);
  auto const host = Kokkos::create_mirror_view(segments.segment);
  for (int i = 0; i < 40; ++i)
  {
    host(i).midpoint = x[static_cast<std::size_t>(i)];
    host(i).material = i < 30 ? 5 : (i < 39 ? 70 : -1);
  }
  Kokkos::deep_copy(segments.segment, host);
  SegmentBins const bins = binSegments(segments, 0.3);
  EXPECT_FALSE(holdOthers(bins, {0.0, 0.0}, {2.0, 0.3}, 5));
  EXPECT_TRUE(holdOthers(bins, {0.0, 0.0}, {2.0, 0.3}, 4));
  EXPECT_TRUE(holdOthers(bins, {0.0, 0.0}, {3.2, 0.3}, 5));
  EXPECT_FALSE(holdOthers(bins, {-9.0, -9.0}, {-8.0, -8.0}, 5));
  // Materials from 63 on, and walls, share a bit: they are never told apart.
  EXPECT_TRUE(holdOthers(bins, {3.3, 0.0}, {3.5, 0.1}, 70));
}
