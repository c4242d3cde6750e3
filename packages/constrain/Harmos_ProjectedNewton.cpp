// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_InteriorPoint.hpp>
#include <Harmos_ProjectedNewton.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Harmos
{

namespace
{

using Vector = std::vector<double>;

class Newton
{
public:
  Newton(DualProblem const &problem, double enough, int max_iterations)
      : problem_(problem), enough_(enough), max_iterations_(max_iterations), n_(problem.size()), system_(problem),
        rubs_(std::any_of(problem.normal_of.begin(), problem.normal_of.end(), [](int normal) { return normal >= 0; })),
        x_(n_, 0.0), g_(problem.b), free_(n_, 0), safe_step_(1.9 / (1.0 + problem.bodyTrace())), least_shift_(n_, 1e-7)
  {
    constexpr double none = 1.0e300, rigid = 1e-6, deformable_shift = 1e-13;
    LowerTriangle const &a = problem.matrix;
    for (int i = 0; i < n_; ++i)
      for (int e = a.offset[i]; e < a.offset[i + 1]; ++e)
        if (a.column[e] == i && a.value[e] > rigid)
          least_shift_[i] = deformable_shift;
    bounds_.reserve(n_);
    for (int i = 0; i < n_; ++i)
      bounds_.push_back(rubs(i) ? ImpulseBounds{0.0, 0.0} : ImpulseBounds{problem.tied[i] ? -none : 0.0, none});
  }

  /// Every round counts at least one iteration, so that it ends.
  DualSolution solve(Vector const &start)
  {
    if (!start.empty())
      beginAt(start);
    exchangeActiveSets(false, iterations_ + patient_iterations_, rubs_ ? brief_ : patient_);
    if (rubs_ && !reached())
      exchangeActiveSets(true, iterations_ + most_coupled_, coupled_);
    // Few unknowns are sooner dropped one by one.
    bool const inside_first = many_change_ || n_ > few_unknowns_;
    if (!reached() && inside_first)
      followInterior();
    std::vector<ImpulseBounds> before = bounds_;
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; iterations_ < max_iterations_; ++round)
    {
      if (reached())
        break;
      bool const gains = violation() < 0.5 * last;
      last = violation();
      if (rubs_ && !gains && times_anew_ < most_anew_ && iterations_ >= (times_anew_ + 1) * most_before_anew_)
      {
        beginAnew();
        if (reached())
          break;
        before = bounds_;
      }
      if (round == patient_rounds_ || drags())
      {
        followInterior(inside_first);
        if (reached())
          break;
        before = bounds_;
      }
      if (round >= undamped_rounds_)
        dampReach(before);
      before = bounds_;
      setShift(0.01, violation());
      chooseFree();
      if (!descend() && iterations_ < max_iterations_)
        safeStep();
    }
    updateGradient();
    return {x_, iterations_, violation()};
  }

private:
  /// Across n, by friction.
  bool rubs(int i) const { return problem_.normal_of[i] >= 0; }

  /// Whether other steps took long, and no path was followed yet.
  bool drags() const { return !followed_ && iterations_ >= patient_iterations_; }

  /// The gradient at x, which most steps have already.
  void updateGradient()
  {
    if (!current_)
      problem_.gradient(x_, g_);
    current_ = true;
  }

  void setUnknown(int i, double x)
  {
    current_ = current_ && x == x_[i];
    x_[i] = x;
  }

  /// Friction's bounds from the impulses along n, which the impulses across n follow.
  void moveReach()
  {
    for (int i = 0; i < n_; ++i)
      if (!rubs(i))
        setUnknown(i, bounds_[i].clip(x_[i]));
    for (int i = 0; i < n_; ++i)
    {
      if (!rubs(i))
        continue;
      ImpulseBounds const before = bounds_[i];
      bounds_[i] = problem_.frictionBounds(i, x_);
      setUnknown(i, bounds_[i].follow(before, x_[i], g_[i]));
    }
  }

  /// Friction's bounds go half of their way only: where impulses along and across n couple they may else be thrown to
  /// and fro.
  void dampReach(std::vector<ImpulseBounds> const &before)
  {
    for (int i = 0; i < n_; ++i)
    {
      if (!rubs(i))
        continue;
      double const now = bounds_[i].high;
      bounds_[i] = ImpulseBounds::ofFriction(0.5 * (before[i].high + now));
      setUnknown(i, x_[i] >= now ? bounds_[i].high : x_[i] <= -now ? bounds_[i].low : bounds_[i].clip(x_[i]));
    }
    updateGradient();
  }

  /// What the shift compares residuals with stays that of zero.
  void beginAt(Vector const &start)
  {
    start_ = violation();
    x_ = start;
    current_ = false;
    updateGradient();
    moveReach();
    updateGradient();
    if (violation() < start_)
      return;
    std::fill(x_.begin(), x_.end(), 0.0);
    for (int i = 0; i < n_; ++i)
      if (rubs(i))
        bounds_[i] = {0.0, 0.0};
    g_ = problem_.b;
    current_ = true;
  }

  /// Impulses with friction's bounds as they are by them.
  void begin(Vector const &x)
  {
    x_ = x;
    current_ = false;
    for (int i = 0; i < n_; ++i)
      if (rubs(i))
        bounds_[i] = problem_.frictionBounds(i, x);
    updateGradient();
  }

  bool reached()
  {
    moveReach();
    updateGradient();
    return violation() <= enough_;
  }

  /// Back to `before` unless what has been found since is enough, or less than the violation there.
  void keepIfBetter(Vector const &before, double least)
  {
    if (!reached() && !(violation() < least))
      begin(before);
  }

  /// Where many unknowns change places for ever: a path inside the bounds, and sets once more from its end. Friction
  /// that couples strongly may leave it farther off than the sets had been.
  /// \param damped See InteriorPoint::solve.
  void followInterior(bool damped = false)
  {
    followed_ = true;
    Vector const before = x_;
    double const least = violation();
    InteriorPoint interior(problem_, system_);
    int const most = rubs_ && n_ <= many_unknowns_ ? most_inside_ : max_iterations_;
    iterations_ += interior.solve(enough_, std::min(most, max_iterations_ - iterations_), damped);
    begin(interior.impulses());
    exchangeActiveSets(rubs_, max_iterations_, rubs_ ? coupled_ : hasty_);
    keepIfBetter(before, least);
  }

  /// Sets with friction that came to no end: once more from zero, with other shifts. Rows that hardly tell impulses
  /// apart give sets that lead to and fro between a few; which of them they meet is chance.
  void beginAnew()
  {
    ++times_anew_;
    Vector const before = x_;
    double const least = violation();
    begin(Vector(n_, 0.0));
    exchangeActiveSets(true, iterations_ + most_coupled_, coupled_);
    keepIfBetter(before, least);
  }

  void setShiftOfSets(double reached, bool coupled)
  {
    struct Law
    {
      double factor, power; // of the residual over the first one
    };
    // Of recorded problems with friction the first law solved most, each next one most of what was left.
    constexpr Law rubbing[most_anew_ + 1] = {{1e-3, 2.0}, {0.01, 2.0}, {1e-4, 1.5}, {1e-3, 1.0}, {0.01, 1.5}};
    setShift(0.1, reached);
    if (coupled)
      shift_ = rubbing[times_anew_].factor * std::pow(reached / start_, rubbing[times_anew_].power);
  }

  void setShift(double factor, double reached)
  {
    start_ = start_ > 0.0 ? start_ : reached;
    shift_ = factor * (reached / start_) * (reached / start_);
  }

  /// Primal-dual active sets: an unknown is free where x - g lies between its bounds, else at the bound beyond which it
  /// lies; a Newton step of the free ones may leave their bounds, which the next sets mend. Whole sets change at once,
  /// so that places far from each other settle together; the residual may grow on the way: where rows are next to
  /// dependent, sets that part two of them throw it far beyond the first one, and the next ones mend that, too. What
  /// was best is kept, and left to other steps where a few sets do not halve it (fewer where many unknowns change
  /// places), some in a row throw it far, or all took long.
  /// \param coupled Whether friction's bounds are those of the impulses along n that the step will give, and sliding
  /// impulses go with them.
  /// \param until   Iterations of all steps at which it ends.
  /// \param patient Sets in a row that need not halve the residual, where few unknowns change places.
  void exchangeActiveSets(bool coupled, int until, int patient)
  {
    constexpr int few = 8, most_thrown = 3;
    constexpr double far = 10.0;
    int patience = patient;
    Vector best = x_, point, slope = g_;
    double least = 1e300;
    for (int worse = 0, thrown = 0; least > enough_ && iterations_ < std::min(until, max_iterations_);)
    {
      point = x_;
      moveReach();
      updateGradient();
      double const reached = violation();
      worse = reached < 0.5 * least ? 0 : worse + 1;
      thrown = start_ > 0.0 && reached > far * start_ ? thrown + 1 : 0;
      if (reached < least)
      {
        least = reached;
        best = x_;
      }
      if (least <= enough_ || worse > patience || thrown >= most_thrown)
        break;
      setShiftOfSets(least, coupled);
      if (point == x_)
        slope = g_;
      many_change_ = chooseSets(point, slope, coupled) > few;
      patience = many_change_ && !coupled ? hasty_ : patient;
      updateGradient();
      int const before = iterations_;
      newtonStep(coupled);
      iterations_ += iterations_ == before ? 1 : 0;
      for (int i = 0; i < n_; ++i)
      {
        x_[i] += free_[i] || slides_[i] != 0.0 ? step_[i] : 0.0;
        slope[i] = g_[i] + image_[i];
      }
      putAtBounds();
      current_ = false;
    }
    current_ = current_ && x_ == best;
    x_ = best;
  }

  /// The sets at a point that may lie beyond bounds, and x with what is not free at its bound.
  /// \return How many unknowns change between free and held.
  int chooseSets(Vector const &point, Vector const &slope, bool coupled)
  {
    int changed = 0;
    slides_.assign(n_, 0.0);
    for (int i = 0; i < n_; ++i)
    {
      double const to = point[i] - slope[i];
      bool const follows = coupled && rubs(i);
      int const along = follows ? problem_.normal_of[i] : i;
      ImpulseBounds const limit =
          follows ? ImpulseBounds::ofFriction(problem_.friction[i] * std::max(0.0, point[along] - slope[along]))
                  : bounds_[i];
      char const free = limit.low < limit.high && limit.inside(to) ? 1 : 0;
      changed += free != free_[i] ? 1 : 0;
      free_[i] = free;
      if (follows && !free && limit.high > 0.0)
        slides_[i] = to > 0.0 ? problem_.friction[i] : -problem_.friction[i];
      setUnknown(i, free ? point[i] : follows ? slides_[i] * point[along] : limit.clip(to));
    }
    return changed;
  }

  /// Sliding impulses at the bounds that follow from those along n, to the last digit: one digit inside of them, all
  /// of their velocity would count as violation.
  void putAtBounds()
  {
    for (int i = 0; i < n_; ++i)
    {
      if (slides_[i] == 0.0 || !(x_[problem_.normal_of[i]] > 0.0))
        continue;
      ImpulseBounds const bounds = problem_.frictionBounds(i, x_);
      x_[i] = slides_[i] > 0.0 ? bounds.high : bounds.low;
    }
  }

  double violation() const
  {
    double largest = 0.0;
    for (int i = 0; i < n_; ++i)
    {
      double const own = problem_.root[i] * bounds_[i].violation(x_[i], g_[i]);
      largest = std::isnan(own) ? std::numeric_limits<double>::infinity() : std::max(largest, own);
    }
    return largest;
  }

  /// Unknowns near a bound that their gradient presses on are held as if they were at it: else a path that is bent by
  /// one of them soon need not descend.
  void chooseFree()
  {
    double projected = 0.0;
    for (int i = 0; i < n_; ++i)
      projected = std::max(projected, std::fabs(x_[i] - bounds_[i].clip(x_[i] - g_[i])));
    for (int i = 0; i < n_; ++i)
    {
      ImpulseBounds const limit = bounds_[i];
      bool const held = limit.low >= limit.high || (g_[i] > 0.0 && x_[i] - limit.low <= projected) ||
                        (g_[i] < 0.0 && limit.high - x_[i] <= projected);
      free_[i] = held ? 0 : 1;
    }
  }

  /// step = d with (A + shift) d = -g for the free unknowns; d = -g for the held ones. image = A d of the free ones.
  ///
  /// Dependent rows give A eigenvalues down to nothing, along which a step without a shift is 1e6 times the impulses.
  /// A residual that closing velocities w have left is sqrt(eigenvalue) w along an eigenvector: what has been reached
  /// squared is the eigenvalue that matters next. Of rows between rigid bodies half of the eigenvalues are next to
  /// nothing: they have a shift of 1e-7 at least.
  void newtonStep(bool sliding = false)
  {
    constexpr int most = 30;
    shifts_.resize(n_);
    residual_.resize(n_);
    for (int i = 0; i < n_; ++i)
    {
      shifts_[i] = std::max(shift_, least_shift_[i]);
      residual_[i] = free_[i] ? -g_[i] : 0.0;
    }
    if (sliding)
      system_.factorSliding(free_, shifts_, slides_);
    else
      system_.factor(free_, shifts_);
    double const good = std::max(0.01 * system_.largest(residual_), 0.1 * enough_);
    int const left = std::min(most, max_iterations_ - iterations_);
    if (sliding)
      iterations_ += system_.solveSliding(residual_, good, left, step_, image_);
    else
      iterations_ += system_.solve(residual_, good, left, step_, image_);
    for (int i = 0; i < n_; ++i)
      if (!free_[i] && !(sliding && slides_[i] != 0.0))
        step_[i] = -g_[i];
  }

  /// Newton steps on a set of free unknowns that shrinks by those which stop the step. \return False: nothing moved,
  /// or the free unknowns had nothing left to gain.
  bool descend()
  {
    bool moved = false;
    while (iterations_ < max_iterations_ && !drags())
    {
      int const before = iterations_;
      newtonStep();
      if (iterations_ == before)
        return false;
      if (followPath())
        return true;
      double const part = stepToBound();
      moved = moved || part > 0.0;
      if (part >= 1.0 || std::none_of(free_.begin(), free_.end(), [](char f) { return f != 0; }))
        return moved;
    }
    return moved;
  }

  /// Along the projected path x(alpha) = bounds(x + alpha step), where it descends.
  bool followPath()
  {
    constexpr double part = 1e-4; // of the descent that the gradient promises
    Vector change(n_);
    for (double alpha = 1.0; alpha > 0.1; alpha *= 0.5)
    {
      double promised = 0.0;
      for (int i = 0; i < n_; ++i)
      {
        change[i] = bounds_[i].clip(x_[i] + alpha * step_[i]) - x_[i];
        promised += g_[i] * change[i];
      }
      problem_.multiply(change, product_);
      if (promised < 0.0 && promised + 0.5 * dot(change, product_) <= part * promised)
      {
        for (int i = 0; i < n_; ++i)
          x_[i] += change[i];
        current_ = false;
        return true;
      }
    }
    return false;
  }

  /// Move the free unknowns until the first of them meets a bound; what does is free no longer.
  /// \return The part of the step that was taken.
  double stepToBound()
  {
    Vector limit(n_, 1e300);
    double part = 1.0;
    for (int i = 0; i < n_; ++i)
    {
      ImpulseBounds const b = bounds_[i];
      if (!free_[i] || step_[i] == 0.0)
        continue;
      limit[i] = ((step_[i] > 0.0 ? b.high : b.low) - x_[i]) / step_[i];
      part = std::min(part, limit[i]);
    }
    Vector change(n_, 0.0);
    for (int i = 0; i < n_; ++i)
    {
      if (!free_[i])
        continue;
      double const to = bounds_[i].clip(x_[i] + part * step_[i]);
      change[i] = to - x_[i];
      x_[i] = to;
      if (limit[i] <= part)
        x_[i] = step_[i] > 0.0 ? bounds_[i].high : bounds_[i].low;
      free_[i] = limit[i] <= part ? 0 : 1;
    }
    problem_.multiply(change, product_);
    for (int i = 0; i < n_; ++i)
      g_[i] += product_[i];
    current_ = false;
    return part;
  }

  void safeStep()
  {
    ++iterations_;
    for (int i = 0; i < n_; ++i)
      x_[i] = bounds_[i].clip(x_[i] - safe_step_ * g_[i]);
    current_ = false;
  }

  DualProblem const &problem_;
  double const enough_;
  int const max_iterations_;
  int const n_;
  ShiftedSystem system_;
  bool const rubs_;                   // some unknown is across n, by friction
  std::vector<ImpulseBounds> bounds_; // across n with friction they follow the impulses along n
  Vector x_, g_;
  bool current_ = true; // g is the gradient at x
  Vector step_, image_, residual_, product_, shifts_;
  std::vector<char> free_;
  Vector slides_;
  static constexpr int undamped_rounds_ = 4, patient_rounds_ = 30;
  static constexpr int patient_iterations_ = 20, most_coupled_ = 14, most_before_anew_ = 55, most_anew_ = 4;
  static constexpr int few_unknowns_ = 100, many_unknowns_ = 1000;
  static constexpr int most_inside_ = 25; // iterations of a path inside the bounds with friction, up to many unknowns
  static constexpr int patient_ = 6, coupled_ = 4, hasty_ = 2, brief_ = 1; // sets that need not halve the residual
  double const safe_step_;
  Vector least_shift_;
  double start_ = 0.0, shift_ = 0.0;
  int iterations_ = 0;
  bool followed_ = false;
  int times_anew_ = 0;
  bool many_change_ = false; // unknowns between free and held, when sets were last exchanged
};

} // namespace

DualSolution projectedNewton(DualProblem const &problem, double enough, int max_iterations,
                             std::vector<double> const &start)
{
  return Newton(problem, enough, max_iterations).solve(start);
}

} // namespace Harmos
