// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BodyProjection.hpp>
#include <Harmos_ConjugateSolver.hpp>
#include <Harmos_MultiplierSolver.hpp>

namespace Harmos
{

namespace
{

/// Arrays of the iteration; rows unless said otherwise.
struct Iteration
{
  View<double *[2]> y;         // extrapolated impulses: where the gradient is taken
  View<double *[2]> next;      // impulses after the step
  View<double *[2]> last;      // impulses before the step
  View<double *[2]> residual;  // b + G M^-1 P G^T y
  View<double *> uphill;       // momentum against descent, D (y - next) . (next - last)
  View<double *[3]> body_step; // free bodies

  explicit Iteration(ContactSystem const &s)
      : y("Harmos::constrain::extrapolated", s.num_rows), next("Harmos::constrain::next", s.num_rows),
        last("Harmos::constrain::last", s.num_rows), residual("Harmos::constrain::residual", s.num_rows),
        uphill("Harmos::constrain::uphill", s.num_rows), body_step("Harmos::constrain::body_step", s.num_free)
  {
  }
};

/// The gradient step with projection; returns the largest violation at the new signs of the impulses.
double takeStep(ContactSystem const &s, Exchange const &exchange, Iteration const &it)
{
  projectBodies(s, it.y, it.residual, exchange, it.body_step);
  double violation = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::step", RangePolicy(0, s.num_own),
      KOKKOS_LAMBDA(int i, double &largest) {
        int const row = s.own(i);
        double uphill = 0.0;
        for (int k = 0; k < s.directions(row); ++k)
        {
          double const p = projectedImpulse(s, it.y, it.residual, it.body_step, row, k);
          double const r = it.residual(row, k);
          uphill += s.diagonal(row, k) * (it.y(row, k) - p) * (p - it.last(row, k));
          largest = Math::max(largest, s.tied(row) || p > 0.0 ? Math::fabs(r) : -r);
          it.next(row, k) = p;
        }
        it.uphill(row) = uphill;
      },
      Kokkos::Max<double>(violation));
  return exchange.max(s.num_own > 0 ? Math::max(violation, 0.0) : 0.0);
}

/// True where the last step went against the momentum: sum of `uphill` > 0, the same on all ranks.
bool momentumPointsUphill(ContactSystem const &s, Exchange const &exchange, Iteration const &it)
{
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::largestUphill", RangePolicy(0, s.num_own),
      KOKKOS_LAMBDA(int i, double &l) { l = Math::max(l, Math::fabs(it.uphill(s.own(i)))); },
      Kokkos::Max<double>(largest));
  ReproducibleSum const sum = reproducibleSum(exchange.max(s.num_own > 0 ? largest : 0.0), s.num_multipliers);
  long long quanta = 0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::sumUphill", RangePolicy(0, s.num_own),
      KOKKOS_LAMBDA(int i, long long &q) { q += sum.quanta(it.uphill(s.own(i))); }, quanta);
  exchange.sum(&quanta, 1);
  return quanta > 0;
}

/// y = next + momentum (next - last); last = next.
void extrapolate(ContactSystem const &s, double momentum, Iteration const &it)
{
  Kokkos::parallel_for(
      "Harmos::constrain::extrapolate", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < 2; ++k)
        {
          it.y(row, k) = it.next(row, k) + momentum * (it.next(row, k) - it.last(row, k));
          it.last(row, k) = it.next(row, k);
        }
      });
}

MultiplierSolution solveWithBodies(ContactSystem const &system, ContactOperator const &contact, double scale,
                                   ConstraintOptions const &options, Exchange const &exchange)
{
  Iteration const it(system);
  MultiplierSolution solution{it.y, contact.change(), contact.bodyChange()};
  double const bound = options.tolerance * scale;
  double t = 1.0;
  bool feasible = true; // y is an iterate, not an extrapolation
  for (solution.iterations = 0;; ++solution.iterations)
  {
    contact.residual(it.y, it.residual);
    bool const last = solution.iterations == options.max_iterations;
    if (feasible)
    {
      double const violation = contact.violation(it.y, it.residual);
      solution.residual = violation > 0.0 ? violation / scale : 0.0;
      solution.converged = violation <= bound;
      if (solution.converged || last)
        return solution;
    }
    if (takeStep(system, exchange, it) <= bound || solution.iterations + 1 >= options.max_iterations)
    {
      extrapolate(system, 0.0, it); // look at the iterate itself
      t = 1.0;
      feasible = true;
      continue;
    }
    if (momentumPointsUphill(system, exchange, it))
      t = 1.0;
    double const t_next = 0.5 * (1.0 + Math::sqrt(1.0 + 4.0 * t * t));
    double const momentum = (t - 1.0) / t_next;
    extrapolate(system, momentum, it);
    feasible = momentum == 0.0;
    t = t_next;
  }
}

} // namespace

MultiplierSolution solveMultipliers(ContactSystem const &system, ContactRows const &rows, double dt,
                                    ConstraintOptions const &options, Exchange const &exchange)
{
  ContactOperator const contact(system, rows, exchange);
  double const scale = Math::max(contact.largestPredicted(dt), 1e-6 * options.speed_scale);
  return system.num_free > 0 ? solveWithBodies(system, contact, scale, options, exchange)
                             : solveByConjugateGradients(system, contact, scale, options, exchange);
}

} // namespace Harmos
