// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_INTERIOR_POINT_HPP
#define HARMOS_INTERIOR_POINT_HPP

#include <Harmos_ShiftedSystem.hpp>

namespace Harmos
{

/// \brief Impulses of a contact problem by a path inside their bounds.
///
/// With slacks s = x - low, high - x and multipliers z of the bounds,
///
///     A x + b = z_low - z_high,   s z = mu,   s, z > 0,   mu -> 0:
///
/// each step is Newton's, (A + z_low/s_low + z_high/s_high + 1e-13) d = -(A x + b) + sigma mu (1/s_low - 1/s_high), and
/// goes 0.995 of the way to the first bound of s or z; sigma, between 0.05 and 0.5, is one less what the last step
/// could go. All unknowns move towards their bounds together, so that the steps hardly grow with their number: 10 to 26
/// from ten to ten thousand. After each step friction's bounds |x| <= reach follow the impulses along n; x and its
/// slacks are scaled with them (a fixed-point iteration: rows of rigid bodies, whose normal and tangential impulses
/// couple strongly, may be left with a residual). Bounds that move do not hold up the others: impulses across n, and
/// the z of their bounds, go 0.995 of the way to their own at most and do not shorten the step (15 to 45 steps). From
/// the 25th step on the bounds go half of their way, lest one row throws them to and fro.
///
/// Nocedal & Wright, Numerical Optimization, 2nd ed., Springer 2006, sections 14.2 and 16.6; products s z of friction
/// are kept within a factor of 30 of mu as by Waechter & Biegler, Math. Program. 106 (2006) 25-57, eq. 16.
class InteriorPoint
{
public:
  InteriorPoint(DualProblem const &problem, ShiftedSystem &system);

  /// From impulses of one size until the residual and the smaller of s and z, times root, are at most `enough`; or
  /// only the residual is left and stays (friction's bounds that move, round-off), the impulses grow without end (rows
  /// that nothing can part), or 60 steps or `most` solves are used up. \return Solves with a factor, at least one for
  /// each step.
  /// \param damped Friction's bounds go half of their way from the start: slower, and surer.
  int solve(double enough, int most, bool damped = false);

  /// Impulses, at a bound where the slack is smaller than its multiplier.
  std::vector<double> impulses() const;

private:
  struct Bound
  {
    std::vector<double> s, z; // zero where an unknown has no such bound
  };

  struct Progress
  {
    double mu, residual, complementarity; // mean of s z; the others times root [m/s]
  };

  bool hasLow(int i) const { return free_[i] && problem_.tied[i] == 0; }
  bool hasHigh(int i) const { return free_[i] && problem_.normal_of[i] >= 0; }

  Progress progress() const;
  void setStep(double target);
  double longestStep(double target);
  void follow(double length, double mu, double friction_part);
  void moveFrictionBounds(double mu, double part);

  DualProblem const &problem_;
  ShiftedSystem &system_;
  int const n_;
  std::vector<char> free_; // without friction of coefficient zero
  std::vector<double> x_, g_;
  Bound low_, high_;
  std::vector<double> shift_, right_, step_, low_change_, high_change_; // changes of z
};

} // namespace Harmos

#endif
