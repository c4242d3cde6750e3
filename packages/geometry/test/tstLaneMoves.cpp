// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_LaneMoves.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

/// Different in both halves of their bits.
double valueOf(int lane)
{
  return (10.0 + lane) / 7.0;
}

} // namespace

TEST(LaneMoves, laneSums_areThoseOfEachPack)
{
  constexpr int count = 16;
  Pack pack[count];
  double expected[count], sum[count];
  for (int i = 0; i < count; ++i)
  {
    pack[i] = packOf([=](int lane) { return 1.0 / (3.0 + i + 7.0 * lane); });
    expected[i] = laneSum(pack[i]);
  }
  laneSums(pack, sum);
  for (int i = 0; i < count; ++i)
    EXPECT_EQ(sum[i], expected[i]) << i;
}

TEST(LaneMoves, chosenLanes_moveToTheFrontInTheirOrder)
{
  for (unsigned lanes = 0; lanes <= all_lanes; ++lanes)
  {
    LaneCompressor const chosen(lanes);
    Pack const front = chosen(packOf([](int lane) { return valueOf(lane); }));
    int count = 0;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      if ((lanes >> lane & 1u) == 0u)
        continue;
      EXPECT_EQ(laneOf(front, count), valueOf(lane)) << lanes;
      ++count;
    }
    EXPECT_EQ(chosen.count, count) << lanes;
  }
}
