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
  std::vector<ContactForce> force = {}; // options.warm_start: of all ranks' rows, by key
};

/// \brief Solve r = b + A p >= 0, A = G M^-1 P G^T + C, p >= 0, p r = 0 (tied rows: r = 0, p of any sign; across n with
/// friction: |p_t| <= mu p, r_t = 0 inside of the bounds and against p_t at them).
///
/// MultiplierMethod::ProjectedNewton: on the assembled problem of all ranks (projectedNewton); judged here.
///
/// Friction by fixed point: the bounds across n are held while the convex problem of all impulses is solved, then set
/// anew, until normal and tangential impulses fit together; the residual is judged with the new bounds.
///
/// MultiplierMethod::RowSums is the plain iteration p <- bounds(p - r / D), for comparison; with free rigid bodies r is
/// divided by the bound of the norm below.
///
/// MultiplierMethod::ConjugateGradients: modified proportioning with reduced gradient projections (MPRGP), for p.A p/2
/// + b.p over p >= 0 in the scaled unknowns sqrt(D) p, D the row sums of the deformable part of A. The scaled
/// operator's norm is at most one, plus a millionth where rows give way (rubbing_compliance), plus the trace of the
/// free rigid bodies' part, so that projected gradient steps of 1.9 over that bound are safe. Conjugate gradients in
/// the free set; a step that meets a bound ends in a projected gradient step; bound rows are let go when their gradient
/// outweighs the free one. The few large eigenvalues that a rigid body adds cost conjugate gradients a few iterations,
/// where gradient methods crawl. Convergence is judged on the residual computed afresh.
///
/// Residual: the largest |r| of impulses between their bounds, and of what leads away from a bound, relative to
/// max(largest |G v*|, 1e-6 speed_scale). Every comparison is between numbers that do not depend on ranks.
///
/// \param rows Their `travelling` carries the multipliers between ranks.
/// \param last Where options.warm_start begins: rows of the same key get the force of the last cycle.
/// Dostal & Schoeberl, Comput. Optim. Appl. 30 (2005) 23-43; Dostal, Haslinger & Kucera, J. Comput. Appl. Math. 140
/// (2002) 245-256 (friction).
MultiplierSolution solveMultipliers(Mesh const &mesh, ContactSystem const &system, ContactRows const &rows, double dt,
                                    ConstraintOptions const &options, Exchange const &exchange,
                                    std::vector<ContactForce> const &last, WorkArrays const &work = {});

} // namespace Harmos

#endif
