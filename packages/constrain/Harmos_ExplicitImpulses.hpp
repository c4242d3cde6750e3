// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_EXPLICIT_IMPULSES_HPP
#define HARMOS_EXPLICIT_IMPULSES_HPP

#include <Harmos_MultiplierSolver.hpp>

namespace Harmos
{

/// The state before the cycle, as the explicit methods read it.
struct StateBefore
{
  Mesh mesh;
  CellMaterialPairs pairs;
  Motion motion_n;
  View<double *[3]> pair_stress; // xx, yy, xy; Nitsche alone
};

/// Penalty and Nitsche's method, for comparison: impulses of the rows from the state alone, without a solve.
///
///   penalty:  p = kick L beta Z (- G v* - max(gap, 0)/dt),
///   Nitsche:  p = kick L [- n . {sigma} n + beta Z (- G v^{n-1/2} - max(gap, 0)/dt)],
///
/// p >= 0 (tied: of any sign, and the same across n; friction: within -mu p, mu p). L is the row's length, beta
/// options.penalty, Z the harmonic mean of the impedances, {sigma} the mean weighted by the other side's impedance, so
/// that the softer side decides; a rigid side has no part. Either is stable only while kick L beta Z G M^-1 G^T stays
/// below about two: nothing here limits the step.
///
/// \return `iterations` 1; `residual` as of the multipliers (Harmos_MultiplierSolver.hpp), by what the rows are missed;
///         `converged` is true, for nothing was asked.
/// Nitsche, Abh. Math. Sem. Univ. Hamburg 36 (1971) 9-15; weights: Annavarapu, Hautefeuille & Dolbow, Comput. Methods
/// Appl. Mech. Engng 225-228 (2012) 44-54.
MultiplierSolution explicitImpulses(StateBefore const &before, ContactSystem const &system, ContactRows const &rows,
                                    double dt, double kick, ConstraintOptions const &options, Exchange const &exchange,
                                    WorkArrays const &work = {});

} // namespace Harmos

#endif
