// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_InteriorPoint.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Harmos
{

namespace
{

/// Part of the way to the first bound of s or z that a step goes.
constexpr double way_to_bound = 0.995;

} // namespace

InteriorPoint::InteriorPoint(DualProblem const &problem, ShiftedSystem &system)
    : problem_(problem), system_(system), n_(problem.size()), free_(n_, 1), x_(n_, 0.0), g_(n_), shift_(n_), right_(n_),
      low_change_(n_, 0.0), high_change_(n_, 0.0)
{
  low_.s.assign(n_, 0.0);
  low_.z = high_.s = high_.z = low_.s;
  double size = 0.0;
  for (double const b : problem.b)
    size = std::max(size, 0.3 * std::fabs(b)); // the scaled matrix has a norm about one
  for (int i = 0; i < n_; ++i)
    if (problem.normal_of[i] < 0 && hasLow(i))
      x_[i] = low_.s[i] = low_.z[i] = size;
  for (int i = 0; i < n_; ++i)
  {
    if (problem.normal_of[i] < 0)
      continue;
    free_[i] = problem.friction[i] > 0.0 ? 1 : 0;
    low_.s[i] = high_.s[i] = problem.reach(i, x_);
    low_.z[i] = high_.z[i] = size;
  }
}

InteriorPoint::Progress InteriorPoint::progress() const
{
  double sum = 0.0, residual = 0.0, smaller = 0.0;
  int bounds = 0;
  auto const add = [&](Bound const &bound, int i)
  {
    sum += bound.s[i] * bound.z[i];
    smaller = std::max(smaller, problem_.root[i] * std::min(bound.s[i], bound.z[i]));
    ++bounds;
  };
  for (int i = 0; i < n_; ++i)
  {
    if (!free_[i])
      continue;
    residual = std::max(residual, problem_.root[i] * std::fabs(g_[i] - low_.z[i] + high_.z[i]));
    if (hasLow(i))
      add(low_, i);
    if (hasHigh(i))
      add(high_, i);
  }
  return {sum / std::max(bounds, 1), residual, smaller};
}

/// Diagonal and right side of Newton's step to products s z = target.
void InteriorPoint::setStep(double target)
{
  constexpr double least = 1e-13; // for unknowns without bounds
  for (int i = 0; i < n_; ++i)
  {
    shift_[i] = least;
    right_[i] = free_[i] ? -g_[i] : 0.0;
    if (hasLow(i))
    {
      shift_[i] += low_.z[i] / low_.s[i];
      right_[i] += target / low_.s[i];
    }
    if (hasHigh(i))
    {
      shift_[i] += high_.z[i] / high_.s[i];
      right_[i] -= target / high_.s[i];
    }
  }
}

/// The part of the step that keeps s and z of the impulses along n positive, and the changes of all z.
double InteriorPoint::longestStep(double target)
{
  double length = 1.0;
  auto const meet = [&](Bound const &bound, int i, double towards, double &change)
  {
    double const s = bound.s[i], z = bound.z[i];
    change = (target - z * towards) / s - z;
    if (problem_.normal_of[i] >= 0)
      return;
    if (towards < 0.0)
      length = std::min(length, -way_to_bound * s / towards);
    if (change < 0.0)
      length = std::min(length, -way_to_bound * z / change);
  };
  for (int i = 0; i < n_; ++i)
  {
    if (hasLow(i))
      meet(low_, i, step_[i], low_change_[i]);
    if (hasHigh(i))
      meet(high_, i, -step_[i], high_change_[i]);
  }
  return length;
}

/// Impulses across n, and their z, go as far towards their own bounds as those may.
/// \param mu What the step leaves of the mean product. \param friction_part Of their way that friction's bounds go.
void InteriorPoint::follow(double length, double mu, double friction_part)
{
  auto const moved = [](double z, double change) { return std::max(z + change, (1.0 - way_to_bound) * z); };
  for (int i = 0; i < n_; ++i)
  {
    if (!free_[i])
      continue;
    double way = length * step_[i];
    if (hasHigh(i))
    {
      way = std::min(std::max(way, -way_to_bound * low_.s[i]), way_to_bound * high_.s[i]);
      high_.s[i] -= way;
      high_.z[i] = moved(high_.z[i], length * high_change_[i]);
    }
    x_[i] += way;
    if (hasLow(i))
    {
      low_.s[i] += way;
      low_.z[i] = moved(low_.z[i], length * low_change_[i]);
    }
  }
  moveFrictionBounds(mu, friction_part);
}

/// Slacks are scaled to the new bounds; their products with z stay within a factor of mu.
void InteriorPoint::moveFrictionBounds(double mu, double part)
{
  constexpr double factor = 30.0;
  for (int i = 0; i < n_; ++i)
  {
    if (!hasHigh(i))
      continue;
    double const ratio = 1.0 + part * (2.0 * problem_.reach(i, x_) / (low_.s[i] + high_.s[i]) - 1.0);
    for (Bound *const bound : {&low_, &high_})
    {
      double &s = bound->s[i], &z = bound->z[i];
      s *= ratio;
      z = std::min(std::max(z, mu / (factor * s)), factor * mu / s);
    }
    x_[i] = 0.5 * (low_.s[i] - high_.s[i]);
  }
}

int InteriorPoint::solve(double enough, int most, bool damped)
{
  constexpr int most_steps = 60, undamped_steps = 25;
  constexpr double endless = 1e8; // times the first impulses
  double const first = system_.largest(x_);
  std::vector<double> image; // of a step
  double length = 0.9, before = std::numeric_limits<double>::infinity();
  int iterations = 0;
  for (int step = 0; step < most_steps && iterations < most; ++step)
  {
    problem_.gradient(x_, g_);
    Progress const now = progress();
    bool const stays = now.complementarity <= 0.1 * enough && now.residual > 0.5 * before;
    before = now.residual;
    if (stays || (now.complementarity <= enough && now.residual <= enough))
      break;
    double const sigma = std::min(std::max(1.0 - length, 0.05), 0.5), target = sigma * now.mu;
    setStep(target);
    system_.factor(free_, shift_);
    int const solves =
        system_.solve(right_, 0.01 * system_.largest(right_), std::min(30, most - iterations), step_, image);
    iterations += std::max(solves, 1);
    length = longestStep(target);
    if (!std::isfinite(length) || !std::isfinite(now.mu))
      break;
    follow(length, (1.0 - length * (1.0 - sigma)) * now.mu, damped || step >= undamped_steps ? 0.5 : 1.0);
    if (system_.largest(x_) > endless * first)
      break;
  }
  return iterations;
}

std::vector<double> InteriorPoint::impulses() const
{
  std::vector<double> x = x_;
  for (int i = 0; i < n_; ++i)
    if (hasLow(i) && problem_.normal_of[i] < 0 && low_.s[i] < low_.z[i])
      x[i] = 0.0;
  for (int i = 0; i < n_; ++i)
  {
    if (!hasHigh(i))
      continue;
    ImpulseBounds const bounds = problem_.frictionBounds(i, x);
    x[i] = low_.s[i] < low_.z[i] ? bounds.low : high_.s[i] < high_.z[i] ? bounds.high : bounds.clip(x[i]);
  }
  return x;
}

} // namespace Harmos
