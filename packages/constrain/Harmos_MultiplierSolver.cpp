// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactOperator.hpp>
#include <Harmos_MultiplierSolver.hpp>
#include <Harmos_RowSums.hpp>

namespace Harmos
{

namespace
{

constexpr double no_bound = 1.0e300;

/// Arrays over rows; the values of tied rows have no bound.
struct Conjugate
{
  View<double *[2]> p;         // impulses, feasible
  View<double *[2]> r;         // b + A p
  View<double *[2]> direction; // of p
  View<double *[2]> product;   // A direction
  View<double *[2]> term;      // own rows: summands
  double fixed_step = 1.9;     // of projected gradient steps, below 2 / (norm of the scaled operator)

  explicit Conjugate(ContactSystem const &s)
      : p("Harmos::constrain::impulse", s.num_rows), r("Harmos::constrain::residual", s.num_rows),
        direction("Harmos::constrain::direction", s.num_rows), product("Harmos::constrain::product", s.num_rows),
        term("Harmos::constrain::terms", s.num_own)
  {
  }
};

KOKKOS_INLINE_FUNCTION bool isFree(ContactSystem const &s, Conjugate const &c, int row, int k)
{
  return s.tied(row) || c.p(row, k) > 0.0;
}

/// Bound of the scaled operator's norm: one for the deformable part (row sums), and the trace of the free bodies' part.
double operatorNorm(ContactSystem const &s, Conjugate const &c, Exchange const &exchange)
{
  if (s.num_free == 0)
    return 1.0;
  Kokkos::parallel_for(
      "Harmos::constrain::bodyTrace", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        double trace = 0.0;
        for (int k = 0; k < s.directions(row); ++k)
          for (int side = 0; side < 2; ++side)
            for (int b = 0; s.free_body(row, side) >= 0 && b < 3; ++b)
            {
              double const j = s.bodyJacobian(row, side, k, b);
              trace += j * j * s.body_inverse_mass(s.free_body(row, side), b) / s.diagonal(row, k);
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
  Kokkos::parallel_for(
      "Harmos::constrain::gradientTerms", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        double free = 0.0, chopped = 0.0;
        for (int k = 0; k < s.directions(row); ++k)
        {
          double const r = c.r(row, k), d = s.diagonal(row, k);
          double const reach = s.tied(row) ? no_bound : d * c.p(row, k) / c.fixed_step;
          if (isFree(s, c, row, k))
            free += r * Math::min(r, reach) / d;
          else
            chopped += r < 0.0 ? r * r / d : 0.0;
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
  Kokkos::parallel_for(
      "Harmos::constrain::setDirection", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
        {
          double const r = c.r(row, k);
          bool const free = isFree(s, c, row, k);
          double const gradient = free == of_free ? (of_free ? r : Math::min(r, 0.0)) : 0.0;
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
  Kokkos::parallel_for(
      "Harmos::constrain::slopeTerms", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
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
  Kokkos::parallel_for(
      "Harmos::constrain::conjugationTerms", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
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
  double longest = no_bound;
  Kokkos::parallel_reduce(
      "Harmos::constrain::longestStep", RangePolicy(0, s.num_own),
      KOKKOS_LAMBDA(int i, double &least) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
          if (!s.tied(row) && c.direction(row, k) > 0.0)
            least = Math::min(least, c.p(row, k) / c.direction(row, k));
      },
      Kokkos::Min<double>(longest));
  return exchange.min(s.num_own > 0 ? longest : no_bound);
}

/// p -= alpha direction, r -= alpha A direction.
void advance(ContactSystem const &s, Conjugate const &c, double alpha)
{
  Kokkos::parallel_for(
      "Harmos::constrain::advance", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
        {
          double const p = c.p(row, k) - alpha * c.direction(row, k);
          c.p(row, k) = s.tied(row) ? p : Math::max(p, 0.0);
          c.r(row, k) -= alpha * c.product(row, k);
        }
      });
}

/// p = max(0, p - fixed_step r / D) on the free rows.
void projectedStep(ContactSystem const &s, Conjugate const &c)
{
  Kokkos::parallel_for(
      "Harmos::constrain::projectedStep", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
          if (isFree(s, c, row, k))
          {
            double const p = c.p(row, k) - c.fixed_step * c.r(row, k) / s.diagonal(row, k);
            c.p(row, k) = s.tied(row) ? p : Math::max(p, 0.0);
          }
      });
}

} // namespace

MultiplierSolution solveMultipliers(ContactSystem const &s, ContactRows const &rows, double dt,
                                    ConstraintOptions const &options, Exchange const &exchange)
{
  ContactOperator const contact(s, rows, exchange);
  double const scale = Math::max(contact.largestPredicted(dt), 1e-6 * options.speed_scale);
  Conjugate c(s);
  c.fixed_step /= operatorNorm(s, c, exchange);
  MultiplierSolution solution{c.p, contact.change(), contact.bodyChange()};
  double const bound = options.tolerance * scale;
  int &iterations = solution.iterations;
  auto const judge = [&](double violation)
  {
    solution.residual = violation > 0.0 ? violation / scale : 0.0;
    solution.converged = violation <= bound;
    return solution.converged;
  };

  contact.residual(c.p, c.r);
  if (judge(contact.violation(c.p, c.r)))
    return solution;
  setDirection(s, c, true, 0.0);
  while (iterations < options.max_iterations)
  {
    GradientNorms const norms = gradientNorms(s, c, exchange);
    bool const proportional = norms.chopped <= norms.free;
    if (!proportional)
      setDirection(s, c, false, 0.0);
    contact.product(c.direction, c.product);
    ++iterations;
    Slope const slope = slopeAlong(s, c, exchange);
    double const alpha = slope.curvature > 0.0 ? slope.descent / slope.curvature : 0.0;
    double const longest = proportional ? longestStep(s, c, exchange) : no_bound;
    if (slope.curvature > 0.0 && alpha <= longest)
    {
      advance(s, c, alpha);
      setDirection(s, c, true, proportional ? -conjugation(s, c, exchange) / slope.curvature : 0.0);
    }
    else
    {
      if (slope.curvature > 0.0)
        advance(s, c, longest);
      projectedStep(s, c);
      contact.residual(c.p, c.r);
      ++iterations;
      setDirection(s, c, true, 0.0);
    }
    if (contact.violation(c.p, c.r) <= bound)
    {
      // The recurrence says so; the residual itself decides. Where they differ the iteration starts anew from it.
      contact.residual(c.p, c.r);
      if (judge(contact.violation(c.p, c.r)))
        return solution;
      setDirection(s, c, true, 0.0);
    }
  }
  contact.residual(c.p, c.r);
  judge(contact.violation(c.p, c.r));
  return solution;
}

} // namespace Harmos
