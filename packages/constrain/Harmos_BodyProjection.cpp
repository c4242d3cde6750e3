// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BodyProjection.hpp>

namespace Harmos
{

namespace
{

/// Rank-independent sum over own rows of a term of (row).
template <class Term>
double rowsSum(ContactSystem const &s, Exchange const &exchange, Term const &term)
{
  double largest = 0.0;
  View<int *> const own = s.own;
  Kokkos::parallel_reduce(
      "Harmos::constrain::largestTerm", RangePolicy(0, s.num_own),
      KOKKOS_LAMBDA(int i, double &l) { l = Math::max(l, Math::fabs(term(own(i)))); }, Kokkos::Max<double>(largest));
  largest = exchange.max(s.num_own > 0 ? largest : 0.0);
  ReproducibleSum const sum = reproducibleSum(largest, s.num_multipliers);
  long long quanta = 0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::sumTerms", RangePolicy(0, s.num_own),
      KOKKOS_LAMBDA(int i, long long &q) { q += sum.quanta(term(own(i))); }, quanta);
  exchange.sum(&quanta, 1);
  return sum.value(quanta);
}

/// Impulse that the step gives component c of a body.
struct StepImpulse
{
  ContactSystem s;
  View<double *[2]> y, residual;
  View<double *[3]> u;
  int body, c;

  KOKKOS_INLINE_FUNCTION double operator()(int row) const
  {
    double sum = 0.0;
    for (int side = 0; side < 2; ++side)
      if (s.free_body(row, side) == body)
        for (int k = 0; k < s.directions(row); ++k)
          sum += s.bodyJacobian(row, side, k, c) * (projectedImpulse(s, y, residual, u, row, k) - y(row, k));
    return sum;
  }
};

/// Entry (c, d) of the active rows' J^T D^-1 J of one body; rows between two free bodies count twice, which bounds what
/// leaving out the coupling between the bodies neglects.
struct StepStiffness
{
  ContactSystem s;
  View<double *[2]> y, residual;
  View<double *[3]> u;
  int body, c, d;

  KOKKOS_INLINE_FUNCTION double operator()(int row) const
  {
    double const factor = s.free_body(row, 0) >= 0 && s.free_body(row, 1) >= 0 ? 2.0 : 1.0;
    double sum = 0.0;
    for (int side = 0; side < 2; ++side)
      if (s.free_body(row, side) == body)
        for (int k = 0; k < s.directions(row); ++k)
          if (s.tied(row) || projectedImpulse(s, y, residual, u, row, k) > 0.0)
            sum += factor * s.bodyJacobian(row, side, k, c) * s.bodyJacobian(row, side, k, d) / s.diagonal(row, k);
    return sum;
  }
};

/// Solve the symmetric positive definite K x = b; b becomes x.
void solve3(double K[3][3], double b[3])
{
  for (int k = 0; k < 3; ++k)
    for (int i = k + 1; i < 3; ++i)
    {
      double const l = K[i][k] / K[k][k];
      for (int j = k; j < 3; ++j)
        K[i][j] -= l * K[k][j];
      b[i] -= l * b[k];
    }
  for (int k = 2; k >= 0; --k)
  {
    for (int j = k + 1; j < 3; ++j)
      b[k] -= K[k][j] * b[j];
    b[k] /= K[k][k];
  }
}

/// Newton's step of one body, added to `next`. Returns the largest part of a component that it changes.
double newtonStep(ContactSystem const &s, StepImpulse impulse, double damping, Exchange const &exchange,
                  HostView<double *[3]> const &inverse, HostView<double *[3]> const &next)
{
  int const body = impulse.body;
  double K[3][3], b[3];
  for (int c = 0; c < 3; ++c)
  {
    impulse.c = c;
    b[c] = rowsSum(s, exchange, impulse) - next(body, c) / inverse(body, c);
    for (int d = 0; d <= c; ++d)
    {
      StepStiffness const stiffness{s, impulse.y, impulse.residual, impulse.u, body, c, d};
      K[c][d] = K[d][c] = rowsSum(s, exchange, stiffness) + (c == d ? 1.0 / inverse(body, c) : 0.0);
    }
  }
  solve3(K, b);
  double change = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    next(body, c) += damping * b[c];
    if (b[c] != 0.0)
      change = Math::max(change, Math::fabs(b[c]) / Math::max(Math::fabs(b[c]), Math::fabs(next(body, c))));
  }
  return change;
}

} // namespace

void projectBodies(ContactSystem const &system, View<double *[2]> const &y, View<double *[2]> const &residual,
                   Exchange const &exchange, View<double *[3]> const &u)
{
  Kokkos::deep_copy(u, 0.0);
  if (system.num_free == 0)
    return;
  auto const next = Kokkos::create_mirror(u);
  auto const inverse = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), system.body_inverse_mass);
  Kokkos::deep_copy(next, 0.0);
  for (int step = 0; step < 40; ++step)
  {
    double change = 0.0;
    for (int body = 0; body < system.num_free; ++body)
    {
      double const damping = step < 10 ? 1.0 : 0.5;
      change =
          Math::max(change, newtonStep(system, {system, y, residual, u, body, 0}, damping, exchange, inverse, next));
    }
    Kokkos::deep_copy(u, next);
    if (change < 1e-13)
      return;
  }
}

} // namespace Harmos
