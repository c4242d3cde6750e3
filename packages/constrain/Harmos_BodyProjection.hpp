// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BODY_PROJECTION_HPP
#define HARMOS_BODY_PROJECTION_HPP

#include <Harmos_ContactSystem.hpp>

namespace Harmos
{

/// The impulse of one row after a gradient step from y with residual r and body velocity changes u since y:
/// max(0, y - (r + J u)/D), without the bound where tied.
KOKKOS_INLINE_FUNCTION double projectedImpulse(ContactSystem const &s, View<double *[2]> const &y,
                                               View<double *[2]> const &residual, View<double *[3]> const &u, int row,
                                               int k)
{
  double r = residual(row, k);
  for (int side = 0; side < 2; ++side)
  {
    int const body = s.free_body(row, side);
    for (int c = 0; body >= 0 && c < 3; ++c)
      r += s.bodyJacobian(row, side, k, c) * u(body, c);
  }
  double const p = y(row, k) - r / s.diagonal(row, k);
  return s.tied(row) ? p : Math::max(0.0, p);
}

/// \brief The free bodies' velocity changes u that belong to one gradient step: u = M_B^-1 J^T (p(u) - y).
///
/// The map u -> M_B u - J^T (p(u) - y) is strictly monotone and piecewise linear: Newton's method with the active rows'
/// M_B + J^T D^-1 J (3 x 3, body by body) ends in a few steps. Halved steps after the tenth; at most 40.
/// Sums over rows are independent of the ranks. Collective when there are free bodies.
void projectBodies(ContactSystem const &system, View<double *[2]> const &y, View<double *[2]> const &residual,
                   Exchange const &exchange, View<double *[3]> const &u);

} // namespace Harmos

#endif
