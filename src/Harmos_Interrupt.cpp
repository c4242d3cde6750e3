// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Interrupt.hpp"

#include <csignal>

namespace Harmos
{
namespace
{

// A signal handler can reach nothing but such a flag.
volatile std::sig_atomic_t signal_came = 0;

void onSignal(int number)
{
  if (signal_came)
  {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  signal_came = 1;
}

} // namespace

void catchInterrupts()
{
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  std::signal(SIGUSR1, onSignal); // mpiexec forwards it, and waits
}

bool interrupted()
{
  return signal_came != 0;
}

} // namespace Harmos
