// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_WorkArrays.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

template <class T>
std::vector<T> valuesOf(View<T *> const &view)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
  return std::vector<T>(host.data(), host.data() + host.extent(0));
}

} // namespace

TEST(WorkArrays, ofOneCall_doNotShareMemory)
{
  WorkArrays work;
  for (int call = 0; call < 4; ++call)
  {
    work.begin();
    std::vector<View<int *>> taken;
    for (int i = 0; i < 50; ++i) // more than the first block holds
    {
      taken.push_back(work.unset<int *>("taken", 777 * (call + 1) + i));
      Kokkos::deep_copy(taken.back(), i);
    }
    for (int i = 0; i < 50; ++i)
      EXPECT_EQ(valuesOf(taken[static_cast<std::size_t>(i)]),
                std::vector<int>(static_cast<std::size_t>(777 * (call + 1) + i), i));
  }
}

TEST(WorkArrays, zerosInMemoryThatHeldValues_areZeros)
{
  WorkArrays work;
  for (int call = 0; call < 3; ++call)
  {
    work.begin();
    View<double *> const zero = work.zeros<double *>("zero", 1000);
    EXPECT_EQ(valuesOf(zero), std::vector<double>(1000, 0.0));
    Kokkos::deep_copy(zero, 7.0);
  }
}

TEST(WorkArrays, callsThatNeedTheSame_getTheSameMemory)
{
  WorkArrays work;
  std::vector<void *> first, second;
  for (int call = 0; call < 3; ++call)
  {
    work.begin();
    first = second;
    second.clear();
    for (std::size_t n : {100000u, 3u, 50000u, 0u, 200000u})
      second.push_back(work.unset<double *[2]>("taken", n).data());
  }
  EXPECT_EQ(first, second);
}

TEST(WorkArrays, beforeAnyCall_arraysOwnTheirMemory)
{
  View<int *> view;
  {
    WorkArrays const work;
    view = work.zeros<int *>("kept", 10);
  }
  EXPECT_EQ(valuesOf(view), std::vector<int>(10, 0));
  EXPECT_EQ(view.use_count(), 1);
}

TEST(WorkArrays, copyOfValues_holdsThemInTheirOrder)
{
  WorkArrays work;
  std::vector<int> const values = {5, 1, 4};
  EXPECT_EQ(valuesOf(work.copyOf("copy", values)), values);
  work.begin();
  EXPECT_EQ(valuesOf(work.copyOf("copy", values)), values);
  EXPECT_EQ(work.copyOf("copy", std::vector<int>()).extent(0), 0u);
}
