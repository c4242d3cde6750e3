// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PROGRESS_HPP
#define HARMOS_PROGRESS_HPP

#include <cstdio>
#include <string>

namespace Harmos
{

/// The line that tells how far a run is: rewritten in place on a terminal, a plain line every ten percent elsewhere.
class Progress
{
public:
  /// \param quiet Print nothing (ranks other than 0).
  explicit Progress(bool quiet);

  /// \param fraction Done, 0 to 1. \param cells_per_second Owned cells times cycles over wall time, all ranks.
  void update(double fraction, double time, double dt, long long cycle, double wall_seconds, double cells_per_second);

  /// A line of its own, above the progress line.
  void message(std::string const &text);

  void finish();

private:
  bool quiet_;
  bool terminal_;
  double last_shown_ = -1.0; // wall seconds
  double next_tenth_ = 0.0;
  bool line_open_ = false;
};

} // namespace Harmos

#endif
