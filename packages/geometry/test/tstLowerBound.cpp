// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_LowerBound.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace Harmos;

TEST(LowerBound, anyLength_isWhatTheStandardLibraryFinds)
{
  for (int count = 0; count < 20; ++count)
  {
    std::vector<int> sorted;
    for (int i = 0; i < count; ++i)
      sorted.push_back(i / 3 * 2); // with equal ones
    for (int wanted = -1; wanted <= 15; ++wanted)
    {
      int const found = lowerBound(count, [&](int i) { return sorted[static_cast<std::size_t>(i)] < wanted; });
      EXPECT_EQ(found, std::lower_bound(sorted.begin(), sorted.end(), wanted) - sorted.begin()) << count;
    }
  }
}
