// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactOperator.hpp>
#include <Harmos_MultiplierSolver.hpp>
#include <Harmos_ProjectedNewton.hpp>
#include <Harmos_RowSums.hpp>
#include <Harmos_WarmStart.hpp>

namespace Harmos
{

namespace
{

/// Arrays over rows.
struct Conjugate
{
  View<double *[2]> p;         // impulses, feasible
  View<double *[2]> r;         // b + A p
  View<double *> reach;        // bounds across n by friction
  View<double *[2]> term;      // own rows: summands
  View<double *[2]> direction; // of p; this and what follows of conjugate gradients alone
  View<double *[2]> product;   // A direction
  double fixed_step = 1.9;     // of projected gradient steps, below 2 / (norm of the scaled operator)
  bool two_sided = false;      // some row has friction

  Conjugate(ContactSystem const &s, MultiplierMethod method, WorkArrays const &work)
      : p(work.zeros<double *[2]>("Harmos::constrain::impulse", s.num_rows)),
        r(work.unset<double *[2]>("Harmos::constrain::residual", s.num_rows)),
        reach(work.zeros<double *>("Harmos::constrain::reach", s.num_rows))
  {
    if (method == MultiplierMethod::ProjectedNewton)
      return;
    term = work.zeros<double *[2]>("Harmos::constrain::terms", s.num_own);
    if (method != MultiplierMethod::ConjugateGradients)
      return;
    direction = work.zeros<double *[2]>("Harmos::constrain::direction", s.num_rows);
    product = work.zeros<double *[2]>("Harmos::constrain::product", s.num_rows);
  }
};

KOKKOS_INLINE_FUNCTION ImpulseBounds boundsOf(ContactSystem const &s, Conjugate const &c, int row, int k)
{
  return s.bounds(row, k, c.reach(row));
}

KOKKOS_INLINE_FUNCTION bool isFree(ContactSystem const &s, Conjugate const &c, int row, int k)
{
  return boundsOf(s, c, row, k).inside(c.p(row, k));
}

/// Bound of the scaled operator's norm: one for the deformable part (row sums), and the trace of the free bodies' part.
double operatorNorm(ContactSystem const &s, Conjugate const &c, Exchange const &exchange)
{
  if (s.num_free == 0)
    return 1.0;
  launchFor(
      "Harmos::constrain::bodyTrace", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        double trace = 0.0;
        for (int k = 0; k < s.directions(row); ++k)
          for (int side = 0; side < 2; ++side)
            for (int b = 0; s.freeBody(row, side) >= 0 && b < 3; ++b)
            {
              double const j = s.bodyJacobian(row, side, k, b);
              trace += j * j * s.body_inverse_mass(s.freeBody(row, side), b) / s.diagonal(row, k);
            }
        c.term(i, 0) = trace;
        c.term(i, 1) = 0.0;
      });
  return 1.0 + reproducibleColumnSums(c.term, s.num_multipliers, exchange)[0];
}

/// Squared norms in scaled unknowns: of the gradient on the free rows against its reduced form, and on the bound ones.
struct GradientNorms
{
  double free;    // reduced free gradient . free gradient
  double chopped; // |gradient of bound rows that want to be let go|^2
};

GradientNorms gradientNorms(ContactSystem const &s, Conjugate const &c, Exchange const &exchange)
{
  launchFor(
      "Harmos::constrain::gradientTerms", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        double free = 0.0, chopped = 0.0;
        for (int k = 0; k < s.directions(row); ++k)
        {
          double const r = c.r(row, k), d = s.diagonal(row, k), p = c.p(row, k);
          ImpulseBounds const bounds = boundsOf(s, c, row, k);
          if (bounds.inside(p))
            free += r * bounds.reduced(p, r / d, c.fixed_step);
          else
            chopped += bounds.inward(p, r) * r / d;
        }
        c.term(i, 0) = free;
        c.term(i, 1) = chopped;
      });
  auto const sum = reproducibleColumnSums(c.term, s.num_multipliers, exchange);
  return {sum[0], sum[1]};
}

/// direction = scaled gradient of the free rows + beta direction; or of the bound rows alone.
void setDirection(ContactSystem const &s, Conjugate const &c, bool of_free, double beta)
{
  launchFor(
      "Harmos::constrain::setDirection", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
        {
          double const r = c.r(row, k);
          ImpulseBounds const bounds = boundsOf(s, c, row, k);
          bool const free = bounds.inside(c.p(row, k));
          double const gradient = free == of_free ? (of_free ? r : bounds.inward(c.p(row, k), r)) : 0.0;
          c.direction(row, k) = gradient / s.diagonal(row, k) + (free ? beta * c.direction(row, k) : 0.0);
        }
      });
}

/// Gradient and curvature along the direction: r . d and d . A d.
struct Slope
{
  double descent, curvature;
};

Slope slopeAlong(ContactSystem const &s, Conjugate const &c, Exchange const &exchange)
{
  launchFor(
      "Harmos::constrain::slopeTerms", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        double descent = 0.0, curvature = 0.0;
        for (int k = 0; k < s.directions(row); ++k)
        {
          descent += c.r(row, k) * c.direction(row, k);
          curvature += c.product(row, k) * c.direction(row, k);
        }
        c.term(i, 0) = descent;
        c.term(i, 1) = curvature;
      });
  auto const sum = reproducibleColumnSums(c.term, s.num_multipliers, exchange);
  return {sum[0], sum[1]};
}

/// Conjugation: (free gradient) . A d, both scaled.
double conjugation(ContactSystem const &s, Conjugate const &c, Exchange const &exchange)
{
  launchFor(
      "Harmos::constrain::conjugationTerms", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        double sum = 0.0;
        for (int k = 0; k < s.directions(row); ++k)
          if (isFree(s, c, row, k))
            sum += c.r(row, k) * c.product(row, k) / s.diagonal(row, k);
        c.term(i, 0) = sum;
        c.term(i, 1) = 0.0;
      });
  return reproducibleColumnSums(c.term, s.num_multipliers, exchange)[0];
}

/// Longest step p - alpha direction that keeps every bound.
double longestStep(ContactSystem const &s, Conjugate const &c, Exchange const &exchange)
{
  constexpr double endless = 1.0e290;
  double longest = endless;
  launchReduce(
      "Harmos::constrain::longestStep", s.num_own,
      KOKKOS_LAMBDA(int i, double &least) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
        {
          double const d = c.direction(row, k);
          ImpulseBounds const bounds = boundsOf(s, c, row, k);
          if (d != 0.0)
            least = Math::min(least, (c.p(row, k) - (d > 0.0 ? bounds.low : bounds.high)) / d);
        }
      },
      Kokkos::Min<double>(longest));
  return exchange.min(s.num_own > 0 ? longest : endless);
}

/// p -= alpha direction, r -= alpha A direction.
void advance(ContactSystem const &s, Conjugate const &c, double alpha)
{
  launchFor(
      "Harmos::constrain::advance", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
        {
          c.p(row, k) = boundsOf(s, c, row, k).clip(c.p(row, k) - alpha * c.direction(row, k));
          c.r(row, k) -= alpha * c.product(row, k);
        }
      });
}

/// p = bounds(p - step r / D), on the free rows alone or on all.
void projectedStep(ContactSystem const &s, Conjugate const &c, double step, bool free_alone)
{
  launchFor(
      "Harmos::constrain::projectedStep", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
          if (!free_alone || isFree(s, c, row, k))
            c.p(row, k) = boundsOf(s, c, row, k).clip(c.p(row, k) - step * c.r(row, k) / s.diagonal(row, k));
      });
}

/// Bounds across n from the normal impulses, |p_t| <= mu p, which the impulses across n follow.
void setReach(ContactSystem const &s, Conjugate const &c)
{
  launchFor(
      "Harmos::constrain::setReach", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        if (s.tied(row) || s.directions(row) == 1)
          return;
        ImpulseBounds const before = boundsOf(s, c, row, 1);
        c.reach(row) = s.friction(row) * c.p(row, 0);
        c.p(row, 1) = boundsOf(s, c, row, 1).follow(before, c.p(row, 1), c.r(row, 1));
      });
}

bool hasFriction(ContactSystem const &s, Exchange const &exchange)
{
  double largest = 0.0;
  launchReduce(
      "Harmos::constrain::largestFriction", s.num_own,
      KOKKOS_LAMBDA(int i, double &l) { l = Math::max(l, s.friction(s.own(i))); }, Kokkos::Max<double>(largest));
  return exchange.max(s.num_own > 0 ? largest : 0.0) > 0.0;
}

/// The residual of no impulses: what was predicted.
void predictedResidual(ContactSystem const &s, View<double *[2]> const &r)
{
  launchFor(
      "Harmos::constrain::predictedResidual", s.num_rows, KOKKOS_LAMBDA(int row) {
        r(row, 0) = s.predicted(row, 0);
        r(row, 1) = s.predicted(row, 1);
      });
}

/// One solve: the operator, the arrays, and what has been reached.
class Solve
{
public:
  Solve(ContactSystem const &system, ContactRows const &rows, double dt, ConstraintOptions const &options,
        Exchange const &exchange, WorkArrays const &work)
      : s_(system), rows_(rows), dt_(dt), exchange_(exchange), contact_(system, rows, exchange, work),
        c_(system, options.solver, work), work_(work),
        scale_(Math::max(contact_.largestPredicted(dt), 1e-6 * options.speed_scale)),
        bound_(options.tolerance * scale_), max_iterations_(options.max_iterations)
  {
    c_.two_sided = hasFriction(s_, exchange_);
    solution = {c_.p, contact_.change(), contact_.bodyChange()};
  }

  /// p <- bounds(p - r / D), with free bodies, which the row sums leave out, r over their trace's bound of the norm
  void byRowSums(std::vector<ContactForce> const &last)
  {
    if (nothingFits())
      return;
    beginAt(last);
    double const step = 1.0 / operatorNorm(s_, c_, exchange_);
    while (!residualFits() && solution.iterations < max_iterations_)
    {
      projectedStep(s_, c_, step, false);
      setReach(s_, c_);
      ++solution.iterations;
    }
  }

  /// Conjugate gradients; with friction until its bounds fit as well.
  void byConjugateGradients(std::vector<ContactForce> const &last)
  {
    constexpr double part = 0.1; // of the residual that one pass with held bounds has to leave
    if (nothingFits() || beginAt(last))
      return;
    c_.fixed_step /= operatorNorm(s_, c_, exchange_);
    descend(c_.two_sided ? Math::max(bound_, part * violation_) : bound_);
    while (c_.two_sided)
    {
      setReach(s_, c_);
      if (solution.iterations >= max_iterations_)
      {
        residualFits();
        return;
      }
      ++solution.iterations;
      if (residualFits() || solution.iterations >= max_iterations_)
        return;
      descend(Math::max(bound_, part * violation_));
    }
  }

  /// Projected Newton steps on the assembled problem; judged by the operator without a matrix, or where groups of rows
  /// share a multiplier by their problem's residual.
  void byProjectedNewton(Mesh const &mesh, ConstraintOptions const &options, std::vector<ContactForce> const &last)
  {
    if (nothingFits())
      return;
    AssembledProblem const problem =
        assembleDualProblem(mesh, s_, rows_, options.placement, options.fluid, exchange_, work_);
    bool const grouped = sharesMultipliers(options.placement);
    DualSolution const dual = projectedNewton(grouped ? problem.groups : problem.rows, 0.9 * bound_, max_iterations_,
                                              last.empty() ? std::vector<double>() : problem.unknownsOf(last, dt_));
    if (options.warm_start)
      solution.force = problem.forcesOf(dual.x, dt_);
    solution.iterations = dual.iterations;
    std::vector<double> spread(grouped ? problem.rows.size() : 0, 0.0);
    for (Spread::Entry const &e : problem.spread.entry)
      spread[e.fine] += e.weight * dual.x[e.coarse];
    setImpulses(problem.rows, grouped ? spread : dual.x);
    residualFits();
    if (!grouped)
      return;
    solution.residual = dual.violation / scale_;
    solution.converged = dual.violation <= bound_;
  }

  /// What the next cycle may begin with.
  void keepForces() { solution.force = forcesOf(s_, rows_, c_.p, dt_, exchange_, work_); }

  MultiplierSolution solution;

private:
  /// Begin with the forces of the last cycle, unless they leave no less than no impulses do, whose residual is known.
  /// \return Whether they fit.
  bool beginAt(std::vector<ContactForce> const &last)
  {
    if (last.empty())
      return false;
    double const none = violation_;
    beginAtForces(s_, rows_, last, dt_, c_.p, c_.reach, work_);
    if (residualFits())
      return true;
    if (violation_ < none)
      return false;
    beginAtForces(s_, rows_, {}, dt_, c_.p, c_.reach, work_);
    return nothingFits();
  }

  /// Impulses of this rank's rows, and their bounds across n.
  void setImpulses(DualProblem const &problem, std::vector<double> const &x)
  {
    auto const p = Kokkos::create_mirror_view(c_.p);
    auto const reach = Kokkos::create_mirror_view(c_.reach);
    for (int row = 0; row < s_.num_rows; ++row)
    {
      int const along = problem.first[row], across = along + 1;
      if (along < 0)
        continue;
      p(row, 0) = x[along] / problem.root[along];
      if (problem.tied[along])
        p(row, 1) = x[across] / problem.root[across];
      else if (across < problem.size() && problem.normal_of[across] == along)
      {
        double const bound = problem.reach(across, x);
        reach(row) = bound / problem.root[across];
        p(row, 1) = x[across] >= bound    ? reach(row)
                    : x[across] <= -bound ? -reach(row)
                                          : x[across] / problem.root[across];
      }
    }
    launchCopy(c_.p, p);
    launchCopy(c_.reach, reach);
  }

  double violation() const { return contact_.violation(c_.p, c_.r, c_.reach); }

  /// Judge the residual of no impulses.
  bool nothingFits()
  {
    predictedResidual(s_, c_.r);
    return judge();
  }

  /// Compute the residual afresh and judge it.
  bool residualFits()
  {
    contact_.residual(c_.p, c_.r);
    return judge();
  }

  bool judge()
  {
    violation_ = violation();
    solution.residual = violation_ > 0.0 ? violation_ / scale_ : 0.0;
    solution.converged = violation_ <= bound_;
    return solution.converged;
  }

  /// One step along the conjugate (or, to let go bound rows, the gradient's) direction.
  void step()
  {
    GradientNorms const norms = gradientNorms(s_, c_, exchange_);
    bool const proportional = norms.chopped <= norms.free;
    if (!proportional)
      setDirection(s_, c_, false, 0.0);
    contact_.product(c_.direction, c_.product);
    ++solution.iterations;
    Slope const slope = slopeAlong(s_, c_, exchange_);
    double const alpha = slope.curvature > 0.0 ? slope.descent / slope.curvature : 0.0;
    bool const meets_bounds = proportional || c_.two_sided;
    double const longest = meets_bounds ? longestStep(s_, c_, exchange_) : alpha;
    if (slope.curvature > 0.0 && alpha <= longest)
    {
      advance(s_, c_, alpha);
      setDirection(s_, c_, true, proportional ? -conjugation(s_, c_, exchange_) / slope.curvature : 0.0);
      return;
    }
    if (slope.curvature > 0.0)
      advance(s_, c_, longest);
    if (solution.iterations >= max_iterations_)
      return;
    projectedStep(s_, c_, c_.fixed_step, true);
    contact_.residual(c_.p, c_.r);
    ++solution.iterations;
    setDirection(s_, c_, true, 0.0);
  }

  /// With the bounds as they are, until the violation is at most `enough`.
  void descend(double enough)
  {
    setDirection(s_, c_, true, 0.0);
    while (solution.iterations < max_iterations_)
    {
      step();
      if (violation() > enough)
        continue;
      // The recurrence says so; the residual itself decides. Where they differ the iteration starts anew from it.
      residualFits();
      if (violation_ <= enough)
        return;
      setDirection(s_, c_, true, 0.0);
    }
    residualFits();
  }

  ContactSystem const &s_;
  ContactRows const &rows_;
  double const dt_;
  Exchange const &exchange_;
  ContactOperator const contact_;
  Conjugate c_;
  WorkArrays const work_;
  double const scale_, bound_;
  int const max_iterations_;
  double violation_ = 0.0;
};

} // namespace

MultiplierSolution solveMultipliers(Mesh const &mesh, ContactSystem const &system, ContactRows const &rows, double dt,
                                    ConstraintOptions const &options, Exchange const &exchange,
                                    std::vector<ContactForce> const &last, WorkArrays const &work)
{
  Solve solve(system, rows, dt, options, exchange, work);
  std::vector<ContactForce> const start = options.warm_start ? last : std::vector<ContactForce>();
  if (options.solver == MultiplierMethod::RowSums)
    solve.byRowSums(start);
  else if (options.solver == MultiplierMethod::ProjectedNewton)
    solve.byProjectedNewton(mesh, options, start);
  else
    solve.byConjugateGradients(start);
  if (options.warm_start && options.solver != MultiplierMethod::ProjectedNewton)
    solve.keepForces();
  return solve.solution;
}

} // namespace Harmos
