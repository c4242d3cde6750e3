// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BodyProjection.hpp>
#include <Harmos_MultiplierSolver.hpp>

namespace Harmos
{

namespace
{

/// Arrays of the iteration; rows unless said otherwise.
struct Iteration
{
  View<double *[2]> y;                      // extrapolated impulses: where the gradient is taken
  View<double *[2]> next;                   // impulses after the step
  View<double *[2]> last;                   // impulses before the step
  View<double *[2]> residual;               // b + G M^-1 P G^T y
  View<double *> uphill;                    // momentum against descent, D (y - next) . (next - last)
  View<double **> travelling;               // impulses of all rows, as the exchange wants them
  View<double *[2]> change;                 // dofs: M^-1 P G^T y
  View<double *[3]> body_change, body_step; // free bodies

  explicit Iteration(ContactSystem const &s, bool several_ranks)
      : y("Harmos::constrain::extrapolated", s.num_rows), next("Harmos::constrain::next", s.num_rows),
        last("Harmos::constrain::last", s.num_rows), residual("Harmos::constrain::residual", s.num_rows),
        uphill("Harmos::constrain::uphill", s.num_rows),
        travelling("Harmos::constrain::travelling", several_ranks ? s.num_rows : 0, 2),
        change("Harmos::constrain::change", s.num_dofs), body_change("Harmos::constrain::body_change", s.num_free),
        body_step("Harmos::constrain::body_step", s.num_free)
  {
  }
};

/// Give the halo's rows their owners' impulses.
void shareImpulses(ContactRows const &rows, Exchange const &exchange, Iteration const &it)
{
  if (exchange.size() == 1)
    return;
  View<double **> const travelling = it.travelling;
  View<double *[2]> const y = it.y;
  Kokkos::parallel_for(
      "Harmos::constrain::packImpulses", RangePolicy(0, rows.count), KOKKOS_LAMBDA(int r) {
        travelling(r, 0) = y(r, 0);
        travelling(r, 1) = y(r, 1);
      });
  exchange.updateRows(rows.offset, travelling, 3);
  Kokkos::parallel_for(
      "Harmos::constrain::unpackImpulses", RangePolicy(0, rows.count), KOKKOS_LAMBDA(int r) {
        y(r, 0) = travelling(r, 0);
        y(r, 1) = travelling(r, 1);
      });
}

/// Velocities and residuals of the own rows at y.
void evaluate(ContactSystem const &s, ContactRows const &rows, Exchange const &exchange, Iteration const &it)
{
  shareImpulses(rows, exchange, it);
  velocityChange(s, it.y, it.change);
  bodyVelocityChange(s, it.y, exchange, it.body_change);
  View<double *[2]> const change = it.change, residual = it.residual;
  View<double *[3]> const body_change = it.body_change;
  Kokkos::parallel_for(
      "Harmos::constrain::rowResiduals", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        Vector2 v{0.0, 0.0};
        for (int k = 0; k < 8; ++k)
        {
          int const dof = s.dof(row, k);
          if (dof >= 0)
            v += s.weight(row, k) * Vector2{change(dof, 0), change(dof, 1)};
        }
        for (int k = 0; k < s.directions(row); ++k)
        {
          double r = s.predicted(row, k) + dot(s.direction(row, k), v);
          for (int side = 0; side < 2; ++side)
            for (int c = 0; s.free_body(row, side) >= 0 && c < 3; ++c)
              r += s.bodyJacobian(row, side, k, c) * body_change(s.free_body(row, side), c);
          residual(row, k) = r;
        }
      });
}

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

/// Largest violation at y itself, which must be feasible.
double violationAt(ContactSystem const &s, Exchange const &exchange, Iteration const &it)
{
  double violation = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::violation", RangePolicy(0, s.num_own),
      KOKKOS_LAMBDA(int i, double &largest) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
        {
          double const r = it.residual(row, k);
          largest = Math::max(largest, s.tied(row) || it.y(row, k) > 0.0 ? Math::fabs(r) : -r);
        }
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

/// Largest predicted |G v*| of all ranks' rows.
double largestPredicted(ContactSystem const &s, ContactRows const &rows, double dt, Exchange const &exchange)
{
  double largest = 0.0;
  View<ContactRow *> const row_of = rows.row;
  Kokkos::parallel_reduce(
      "Harmos::constrain::largestPredicted", RangePolicy(0, s.num_own),
      KOKKOS_LAMBDA(int i, double &l) {
        int const row = s.own(i);
        double const closing = s.tied(row) ? 0.0 : Math::max(row_of(row).gap, 0.0) / dt;
        l = Math::max(l, Math::max(Math::fabs(s.predicted(row, 0) - closing), Math::fabs(s.predicted(row, 1))));
      },
      Kokkos::Max<double>(largest));
  return exchange.max(s.num_own > 0 ? largest : 0.0);
}

} // namespace

MultiplierSolution solveMultipliers(ContactSystem const &system, ContactRows const &rows, double dt,
                                    ConstraintOptions const &options, Exchange const &exchange)
{
  Iteration const it(system, exchange.size() > 1);
  MultiplierSolution solution{it.y, it.change, it.body_change};
  double const scale = Math::max(largestPredicted(system, rows, dt, exchange), 1e-6 * options.speed_scale);
  double const bound = options.tolerance * scale;
  double t = 1.0;
  bool feasible = true; // y is an iterate, not an extrapolation
  for (solution.iterations = 0;; ++solution.iterations)
  {
    evaluate(system, rows, exchange, it);
    bool const last = solution.iterations == options.max_iterations;
    if (feasible)
    {
      double const violation = violationAt(system, exchange, it);
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

} // namespace Harmos
