// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Launch.hpp>
#include <Harmos_OnHost.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

/// 3, 4, 5, ...
View<int *> countedFrom3(int count)
{
  View<int *> const value("value", count);
  launchFor(
      "count", count, KOKKOS_LAMBDA(int i) { value(i) = 3 + i; });
  return value;
}

} // namespace

TEST(Launch, everyItem_isVisitedOnce)
{
  View<int *> const visits("visits", 100);
  launchFor(
      "visit", 100, KOKKOS_LAMBDA(int i) { Kokkos::atomic_add(&visits(i), 1); });
  auto const host = onHost(visits);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(host(i), 1) << i;
}

TEST(Launch, reductions_areThoseOfKokkosWhateverTheirResultHeld)
{
  auto const value = countedFrom3(50);
  int sum = 77, largest = 77;
  auto const add = KOKKOS_LAMBDA(int i, int &part)
  {
    part += value(i);
  };
  auto const join = KOKKOS_LAMBDA(int i, int &part)
  {
    part = Math::max(part, value(i));
  };
  launchReduce("sum", 50, add, sum);
  EXPECT_EQ(sum, 50 * 3 + 49 * 25);
  launchReduce("largest", 50, join, Kokkos::Max<int>(largest));
  EXPECT_EQ(largest, 52);
  launchReduce("nothing", 0, add, sum);
  EXPECT_EQ(sum, 0);
  int least_of_none = 0;
  launchReduce("none", 0, join, Kokkos::Min<int>(least_of_none));
  EXPECT_EQ(least_of_none, Kokkos::reduction_identity<int>::min());
}

TEST(Launch, scan_givesEachItemTheSumBeforeIt)
{
  auto const value = countedFrom3(50);
  View<int *> const before("before", 50);
  int total = 77;
  launchScan(
      "scan", 50,
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        if (final)
          before(i) = sum;
        sum += value(i);
      },
      total);
  EXPECT_EQ(total, 50 * 3 + 49 * 25);
  auto const host = onHost(before);
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(host(i), 3 * i + i * (i - 1) / 2) << i;
}

TEST(Launch, copy_leavesTheSameArrayAlone)
{
  auto const value = countedFrom3(5);
  View<int *> const other("other", 5);
  launchCopy(other, value);
  launchCopy(other, other);
  auto const host = onHost(other);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(host(i), 3 + i) << i;
}
