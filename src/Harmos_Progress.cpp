// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Progress.hpp"

#include <algorithm>
#include <cmath>
#include <unistd.h>

namespace Harmos
{
namespace
{

std::string clock(double seconds)
{
  char text[32];
  long const s = std::lround(std::min(seconds, 3.5e6));
  if (s >= 3600)
    std::snprintf(text, sizeof text, "%ldh%02ldm", s / 3600, s / 60 % 60);
  else
    std::snprintf(text, sizeof text, "%ldm%02lds", s / 60, s % 60);
  return text;
}

} // namespace

// Launchers such as Open MPI's give their children a terminal for the output alone, wherever it really goes.
Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(fileno(stdout)) == 1 && isatty(fileno(stderr)) == 1) {}

void Progress::update(double fraction, double time, double dt, long long cycle, double wall_seconds,
                      double cells_per_second)
{
  if (quiet_)
    return;
  fraction = std::clamp(fraction, 0.0, 1.0);
  double const eta = fraction > 0.0 ? wall_seconds * (1.0 - fraction) / fraction : 0.0;
  if (terminal_)
  {
    if (fraction < 1.0 && wall_seconds - last_shown_ < 0.2)
      return;
    last_shown_ = wall_seconds;
    int const width = 24;
    int const filled = static_cast<int>(fraction * width);
    std::string const bar = std::string(filled, '#') + std::string(width - filled, '.');
    std::printf("\r[%s] %5.1f%%  t %.4g s  dt %.3g s  cycle %lld  ETA %s  %.3g cells/s\033[K", bar.c_str(),
                100.0 * fraction, time, dt, cycle, clock(eta).c_str(), cells_per_second);
    line_open_ = true;
  }
  else
  {
    if (fraction < next_tenth_)
      return;
    next_tenth_ = 0.1 * (std::floor(fraction / 0.1) + 1.0);
    std::printf("%5.1f%%  t %.6g s  dt %.3g s  cycle %lld  wall %s  ETA %s  %.3g cells/s\n", 100.0 * fraction, time, dt,
                cycle, clock(wall_seconds).c_str(), clock(eta).c_str(), cells_per_second);
  }
  std::fflush(stdout);
}

void Progress::message(std::string const &text)
{
  if (quiet_)
    return;
  std::printf("%s%s\n", line_open_ ? "\r\033[K" : "", text.c_str());
  std::fflush(stdout);
  line_open_ = false;
}

void Progress::finish()
{
  if (line_open_)
    std::printf("\n");
  line_open_ = false;
  std::fflush(stdout);
}

} // namespace Harmos
