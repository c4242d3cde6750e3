// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PHASE_TIMER_HPP
#define HARMOS_PHASE_TIMER_HPP

#include <Harmos_Kokkos.hpp>

namespace Harmos
{

/// Adds the life of a scope to a phase's seconds.
class PhaseTimer
{
public:
  PhaseTimer(char const *name, double &seconds) : region_(std::string("Harmos::") + name), seconds_(seconds) {}
  ~PhaseTimer()
  {
    ExecutionSpace().fence();
    seconds_ += timer_.seconds();
  }
  PhaseTimer(PhaseTimer const &) = delete;
  PhaseTimer &operator=(PhaseTimer const &) = delete;

private:
  ScopedRegion region_;
  Kokkos::Timer timer_;
  double &seconds_;
};

} // namespace Harmos

#endif
