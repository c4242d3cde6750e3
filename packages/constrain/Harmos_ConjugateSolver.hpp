// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONJUGATE_SOLVER_HPP
#define HARMOS_CONJUGATE_SOLVER_HPP

#include <Harmos_ContactOperator.hpp>
#include <Harmos_MultiplierSolver.hpp>

namespace Harmos
{

/// \brief Multipliers without free rigid bodies: modified proportioning with reduced gradient projections (MPRGP).
///
/// Minimises p.A p/2 + b.p over p >= 0 (tied rows: any p), in the scaled unknowns sqrt(D) p with D the row sums, so
/// that the scaled operator's norm is at most one and projected gradient steps of length 1.9 are safe. Conjugate
/// gradients in the free set; a step that meets a bound ends in a projected gradient step; rows that want to become
/// active are let go when their gradient outweighs the free one.
///
/// \param scale What the residual is relative to. Convergence is judged on the residual computed afresh.
/// Dostal & Schoeberl, Comput. Optim. Appl. 30 (2005) 23-43.
MultiplierSolution solveByConjugateGradients(ContactSystem const &system, ContactOperator const &contact, double scale,
                                             ConstraintOptions const &options, Exchange const &exchange);

} // namespace Harmos

#endif
