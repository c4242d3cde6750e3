// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_LoadPoints.hpp>
#include <Harmos_OnHost.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace Harmos;

namespace
{

/// 0, 1, 2, ... in rows.
HostView<double *[2]> countedPoints(int count)
{
  auto const points = Kokkos::create_mirror_view(View<double *[2]>("points", count));
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < 2; ++j)
      points(i, j) = 2 * i + j;
  return points;
}

/// Rows of corners that count upwards by `step`.
std::vector<int> countedCorners(int step)
{
  std::vector<int> corner;
  for (int lane = 0; lane < pack_width; ++lane)
    for (int first : {5, 6, 30, 29})
      corner.push_back(first + lane * step);
  return corner;
}

struct LoadedCorners
{
  bool count_up, count_up_without_run;
  double x[4][pack_width], y[4][pack_width];
};

/// What the lanes load whose corners are the rows from `first` on.
LoadedCorners loadedCorners(View<int *[4]> const &corner, int first, View<double *[2]> const &points)
{
  RowPointer<int, 4> const corners = corner;
  RowPointer<double, 2> const values = points;
  View<LoadedCorners *> const loaded("loaded", 1);
  Kokkos::parallel_for(
      "loadedCorners", RangePolicy(0, 1), KOKKOS_LAMBDA(int) {
        int index[pack_width];
        for (int lane = 0; lane < pack_width; ++lane)
          index[lane] = lane + first;
        PackedCornerRows const rows(corners, index, true);
        LoadedCorners &all = loaded(0);
        all.count_up = rows.count_up;
        all.count_up_without_run = PackedCornerRows(corners, index, false).count_up;
        for (int k = 0; k < 4; ++k)
        {
          Pack x, y;
          loadCorner(rows, values, k, x, y);
          for (int lane = 0; lane < pack_width; ++lane)
          {
            all.x[k][lane] = laneOf(x, lane);
            all.y[k][lane] = laneOf(y, lane);
          }
        }
      });
  return onHost(loaded)(0);
}

} // namespace

TEST(LoadPoints, anyRows_areLoadedAndStored)
{
  auto const points = countedPoints(3 * pack_width);
  auto const row = [&](int lane) { return &points((5 * lane) % (3 * pack_width), 0); };
  Pack x, y;
  loadPoints(row, x, y);
  for (int lane = 0; lane < pack_width; ++lane)
  {
    EXPECT_EQ(laneOf(x, lane), row(lane)[0]);
    EXPECT_EQ(laneOf(y, lane), row(lane)[1]);
  }
  storePoints(row, y, x);
  for (int lane = 0; lane < pack_width; ++lane)
  {
    EXPECT_EQ(row(lane)[0], laneOf(y, lane));
    EXPECT_EQ(row(lane)[1], laneOf(x, lane));
  }
}

TEST(LoadPoints, run_isLoadedAndStoredAsItsRowsAre)
{
  auto const points = countedPoints(pack_width + 2);
  Pack x, y;
  loadPointRun(&points(1, 0), x, y);
  for (int lane = 0; lane < pack_width; ++lane)
  {
    EXPECT_EQ(laneOf(x, lane), 2 * (lane + 1));
    EXPECT_EQ(laneOf(y, lane), 2 * (lane + 1) + 1);
  }
  storePointRun(&points(1, 0), -1.0 * x, 2.0 * y);
  for (int lane = 0; lane < pack_width; ++lane)
  {
    EXPECT_EQ(points(lane + 1, 0), -laneOf(x, lane));
    EXPECT_EQ(points(lane + 1, 1), 2.0 * laneOf(y, lane));
  }
  EXPECT_EQ(points(0, 1), 1.0);
  EXPECT_EQ(points(pack_width + 1, 0), 2.0 * (pack_width + 1));
}

TEST(LoadPoints, corners_areThoseOfEachLane)
{
  auto const points = countedPoints(100);
  View<double *[2]> const device_points("points", 100);
  Kokkos::deep_copy(device_points, points);
  for (int moved = -1; moved < 4 * pack_width; ++moved) // none, then one corner elsewhere
  {
    View<int *[4]> const device_corner("corner", pack_width + 3);
    auto const corner = Kokkos::create_mirror_view(device_corner);
    std::vector<int> const counted = countedCorners(1);
    for (int i = 0; i < 4 * pack_width; ++i)
      corner(i / 4 + 3, i % 4) = counted[i] + (i == moved ? 17 : 0);
    Kokkos::deep_copy(device_corner, corner);
    LoadedCorners const loaded = loadedCorners(device_corner, 3, device_points);
    EXPECT_EQ(loaded.count_up, moved < 0 || pack_width == 1);
    EXPECT_FALSE(loaded.count_up_without_run);
    for (int k = 0; k < 4; ++k)
      for (int lane = 0; lane < pack_width; ++lane)
      {
        EXPECT_EQ(loaded.x[k][lane], points(corner(lane + 3, k), 0));
        EXPECT_EQ(loaded.y[k][lane], points(corner(lane + 3, k), 1));
      }
  }
}

TEST(LaneNumbers, columnsThatCountUp_differFromNoCount)
{
  for (int step : {1, 4})
  {
    auto corner = countedCorners(step);
    EXPECT_TRUE(cornersCountUp(corner.data(), step));
    for (int i = 4; i < 4 * pack_width; ++i)
    {
      corner[i] ^= 1 << (i % 31);
      EXPECT_FALSE(cornersCountUp(corner.data(), step));
      auto const differs = differencesFromCount(corner.data(), step);
      for (int k = 0; k < 4; ++k)
        EXPECT_EQ(differs[k] != 0, k == i % 4);
      corner[i] ^= 1 << (i % 31);
    }
  }
}

TEST(LaneNumbers, numbersOutOfCount_areSeen)
{
  std::vector<int> numbers(pack_width);
  for (int lane = 0; lane < pack_width; ++lane)
    numbers[lane] = 9 + lane;
  EXPECT_TRUE(countsUp(numbers.data()));
  EXPECT_FALSE(anySet(loadNumbers(numbers.data()) ^ countFrom(9, 1)));
  for (int lane = 1; lane < pack_width; ++lane)
  {
    numbers[lane] -= 1;
    EXPECT_FALSE(countsUp(numbers.data()));
    numbers[lane] += 1;
  }
}
