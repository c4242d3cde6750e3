// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BodyProjection.hpp>
#include <Harmos_RowSums.hpp>

namespace Harmos
{

namespace
{

/// What each own row adds to Newton's system of one body: impulse J^T (p(u) - y) and stiffness J^T D^-1 J of active
/// rows (entries 00, 10, 11, 20, 21, 22), in the body's scaled components.
///
/// Rows between two free bodies count twice in the stiffness: that bounds what leaving out their coupling neglects.
struct StepTerms
{
  ContactSystem s;
  View<double *[2]> y, residual;
  View<double *[3]> u;
  View<double *[3]> impulse;   // num_own
  View<double *[6]> stiffness; // num_own
  int body;

  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    int const row = s.own(i);
    double f[3] = {}, K[6] = {};
    double const factor = s.free_body(row, 0) >= 0 && s.free_body(row, 1) >= 0 ? 2.0 : 1.0;
    for (int side = 0; side < 2; ++side)
      for (int k = 0; s.free_body(row, side) == body && k < s.directions(row); ++k)
      {
        double const p = projectedImpulse(s, y, residual, u, row, k);
        double const compliance = s.tied(row) || p > 0.0 ? factor / s.diagonal(row, k) : 0.0;
        double J[3];
        for (int c = 0; c < 3; ++c)
          J[c] = s.bodyJacobian(row, side, k, c) / s.body_scale(body, c);
        for (int c = 0, e = 0; c < 3; ++c)
        {
          f[c] += J[c] * (p - y(row, k));
          for (int d = 0; d <= c; ++d, ++e)
            K[e] += compliance * J[c] * J[d];
        }
      }
    for (int c = 0; c < 3; ++c)
      impulse(i, c) = f[c];
    for (int e = 0; e < 6; ++e)
      stiffness(i, e) = K[e];
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

/// Newton's step of one body, in scaled components (velocities).
std::array<double, 3> newtonStep(StepTerms const &terms, Exchange const &exchange, HostView<double *[3]> const &inverse,
                                 HostView<double *[3]> const &scale, HostView<double *[3]> const &now)
{
  Kokkos::parallel_for("Harmos::constrain::bodyStepTerms", RangePolicy(0, terms.s.num_own), terms);
  auto const f = reproducibleColumnSums(terms.impulse, terms.s.num_multipliers, exchange);
  auto const stiffness = reproducibleColumnSums(terms.stiffness, terms.s.num_multipliers, exchange);
  double const mass = 1.0 / inverse(terms.body, 0); // of every scaled component
  double K[3][3], b[3];
  for (int c = 0, e = 0; c < 3; ++c)
  {
    b[c] = f[static_cast<std::size_t>(c)] - mass * scale(terms.body, c) * now(terms.body, c);
    for (int d = 0; d <= c; ++d, ++e)
      K[c][d] = K[d][c] = stiffness[static_cast<std::size_t>(e)] + (c == d ? mass : 0.0);
  }
  solve3(K, b);
  return {b[0], b[1], b[2]};
}

} // namespace

void projectBodies(ContactSystem const &system, View<double *[2]> const &y, View<double *[2]> const &residual,
                   Exchange const &exchange, View<double *[3]> const &u)
{
  if (system.num_free == 0)
    return;
  constexpr double negligible = 1e-12; // of the largest step
  Kokkos::deep_copy(u, 0.0);
  auto const now = Kokkos::create_mirror(u);
  auto const inverse = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), system.body_inverse_mass);
  auto const scale = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), system.body_scale);
  View<double *[3]> const impulse("Harmos::constrain::step_impulse", system.num_own);
  View<double *[6]> const stiffness("Harmos::constrain::step_stiffness", system.num_own);
  double largest = 0.0;
  for (int step = 0; step < 40; ++step)
  {
    double const damping = step < 10 ? 1.0 : 0.5;
    double size = 0.0;
    for (int body = 0; body < system.num_free; ++body)
    {
      auto const b = newtonStep({system, y, residual, u, impulse, stiffness, body}, exchange, inverse, scale, now);
      for (int c = 0; c < 3; ++c)
      {
        size = Math::max(size, Math::fabs(b[static_cast<std::size_t>(c)]));
        now(body, c) += damping * b[static_cast<std::size_t>(c)] / scale(body, c);
      }
    }
    Kokkos::deep_copy(u, now);
    largest = Math::max(largest, size);
    if (size <= negligible * largest)
      return;
  }
}

} // namespace Harmos
