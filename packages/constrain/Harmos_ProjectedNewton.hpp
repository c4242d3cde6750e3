// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PROJECTED_NEWTON_HPP
#define HARMOS_PROJECTED_NEWTON_HPP

#include <Harmos_DualProblem.hpp>

namespace Harmos
{

struct DualSolution
{
  std::vector<double> x;
  int iterations = 0;     // solves with a Cholesky factor
  double violation = 0.0; // of the residual at x [m/s]
};

/// \brief Minimise x^T A x / 2 + b . x over low <= x <= high by Newton steps that are projected onto the bounds.
///
/// First primal-dual active sets, as long as a few of them halve the residual: what lies within its bounds at x - g is
/// free, the rest at its bound. Where they do not settle, a path inside the bounds (InteriorPoint) and sets once more
/// from its end, then sets that take sliding impulses with those along n. What is left is left to steps for the
/// unknowns that are free, or at a bound that their gradient leads away from: each follows its projected path where
/// that descends, else goes to the first bound that it meets and is made anew without the unknown that met it. The
/// systems, A plus a shift that falls with the square of the residual (Levenberg-Marquardt), are those of
/// ShiftedSystem. Friction's bounds follow the impulses along n from step to step.
///
/// \param start  Where to begin; empty, or farther from the solution than zero is: at zero.
/// \param enough Of the residual sqrt(D) (A x + b), as ImpulseBounds::violation measures it. [m/s]
/// Hintermueller, Ito & Kunisch, SIAM J. Optim. 13 (2002) 865-888 (active sets); Hueeber, Stadler & Wohlmuth, SIAM J.
/// Sci. Comput. 30 (2008) 572-596 (with friction); Bertsekas, SIAM J. Control Optim. 20 (1982) 221-246.
DualSolution projectedNewton(DualProblem const &problem, double enough, int max_iterations,
                             std::vector<double> const &start = {});

} // namespace Harmos

#endif
