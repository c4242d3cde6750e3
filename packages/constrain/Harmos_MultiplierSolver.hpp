// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MULTIPLIER_SOLVER_HPP
#define HARMOS_MULTIPLIER_SOLVER_HPP

#include <Harmos_ContactSystem.hpp>

namespace Harmos
{

struct MultiplierSolution
{
  View<double *[2]> impulse;     // num_rows (halo rows included) [N s/m]
  View<double *[2]> change;      // num_dofs: M^-1 P G^T p [m/s]
  View<double *[3]> body_change; // num_free
  int iterations = 0;
  double residual = 0.0; // relative
  bool converged = true;
};

/// \brief Solve r = b + G M^-1 P G^T p >= 0, p >= 0, p r = 0 (tied rows: r = 0, p of any sign).
///
/// Without free rigid bodies: conjugate gradients with projections (Harmos_ConjugateSolver.hpp). With them:
/// accelerated projected gradient in the metric D + J M_B^-1 J^T: D the row sums of the deformable part, J M_B^-1 J^T
/// the exact part of the free rigid bodies, which couples all rows of a body. The metric bounds the operator, so that
/// the step is one. Its projection is a small monotone system in the bodies' three velocities each, solved by Newton's
/// method (body_projection); without free bodies it is p = max(0, y - r/D). The momentum restarts when it points
/// uphill.
///
/// Residual: the largest |r| over rows with p > 0 or tied, and max(0, -r) over the others, relative to
/// max(largest |G v*|, 1e-6 speed_scale). Every comparison is between numbers that do not depend on ranks.
///
/// \param rows Their `offset` carries the multipliers between ranks.
/// Beck & Teboulle, SIAM J. Imaging Sci. 2 (2009) 183; O'Donoghue & Candes, Found. Comput. Math. 15 (2015) 715.
MultiplierSolution solveMultipliers(ContactSystem const &system, ContactRows const &rows, double dt,
                                    ConstraintOptions const &options, Exchange const &exchange);

} // namespace Harmos

#endif
