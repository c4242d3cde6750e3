// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_EXPECT_KEPT_HPP
#define HARMOS_TEST_EXPECT_KEPT_HPP

#include "Impact.hpp"

#include <gtest/gtest.h>

namespace Harmos
{
namespace Test
{

/// Mass, momentum and energy of a run from `before` on, and the materials' motion beside that of another run.
inline void expectKept(MaterialSums const &before, Impact const &run, Impact const &other, double motion_error)
{
  MaterialSums const after = run.sums(), reference = other.sums();
  double const scale = before(0, SumMomentumX);
  double momentum[2] = {0.0, 0.0}, energy = 0.0, start = 0.0;
  for (int m = 0; m < 2; ++m)
  {
    EXPECT_NEAR(after(m, SumMass) / before(m, SumMass), 1.0, 1e-13);
    momentum[0] += after(m, SumMomentumX) - before(m, SumMomentumX);
    momentum[1] += after(m, SumMomentumY) - before(m, SumMomentumY);
    energy += after(m, SumKineticEnergy) + after(m, SumInternalEnergy);
    start += before(m, SumKineticEnergy) + before(m, SumInternalEnergy);
    // what the disc gives to the block
    EXPECT_NEAR(after(m, SumMomentumX), reference(m, SumMomentumX), motion_error * scale);
  }
  EXPECT_NEAR(momentum[0], run.impulse[0], 1e-12 * scale);
  EXPECT_NEAR(momentum[1], run.impulse[1], 1e-12 * scale);
  EXPECT_NEAR(energy + run.loss - run.work, start, 1e-3 * start);
}

} // namespace Test
} // namespace Harmos

#endif
