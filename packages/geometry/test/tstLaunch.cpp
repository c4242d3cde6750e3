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

/// How often each of `count` items was visited. (CUDA wants its lambdas in functions that anyone may call.)
View<int *> visited(int count)
{
  View<int *> const visits("visits", count);
  launchFor(
      "visit", count, KOKKOS_LAMBDA(int i) { Kokkos::atomic_add(&visits(i), 1); });
  return visits;
}

int sumOf(View<int *> const &value, int count)
{
  int sum = 77;
  launchReduce(
      "sum", count, KOKKOS_LAMBDA(int i, int &part) { part += value(i); }, sum);
  return sum;
}

/// By a Kokkos reducer that keeps the largest.
template <class Reducer>
int joined(View<int *> const &value, int count)
{
  int result = 77;
  launchReduce(
      "join", count, KOKKOS_LAMBDA(int i, int &part) { part = Math::max(part, value(i)); }, Reducer(result));
  return result;
}

/// The sum of the items before each, and of all.
int sumsBefore(View<int *> const &value, View<int *> const &before)
{
  int total = 77;
  launchScan(
      "scan", static_cast<int>(value.extent(0)),
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        if (final)
          before(i) = sum;
        sum += value(i);
      },
      total);
  return total;
}

} // namespace

TEST(Launch, everyItem_isVisitedOnce)
{
  auto const host = onHost(visited(100));
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(host(i), 1) << i;
}

TEST(Launch, reductions_areThoseOfKokkosWhateverTheirResultHeld)
{
  auto const value = countedFrom3(50);
  EXPECT_EQ(sumOf(value, 50), 50 * 3 + 49 * 25);
  EXPECT_EQ(joined<Kokkos::Max<int>>(value, 50), 52);
  EXPECT_EQ(sumOf(value, 0), 0);
  EXPECT_EQ(joined<Kokkos::Min<int>>(value, 0), Kokkos::reduction_identity<int>::min());
}

TEST(Launch, scan_givesEachItemTheSumBeforeIt)
{
  auto const value = countedFrom3(50);
  View<int *> const before("before", 50);
  EXPECT_EQ(sumsBefore(value, before), 50 * 3 + 49 * 25);
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
