// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PRESSURE_TRACTIONS_HPP
#define HARMOS_PRESSURE_TRACTIONS_HPP

#include <Harmos_ContactSystem.hpp>
#include <Harmos_MultiplierSolver.hpp>

namespace Harmos
{

struct PlannedRows;
struct RowBuilder;

/// \brief What the rows leave of a fluid's pressure.
///
/// The pressure p of a fluid drives its nodes by p n_f on each facet f of its outline, n_f the facet's own normal. Rows
/// r bear it along their fitted normals n_r, at their places: across these, where a facet carries no row (short pieces
/// of cell faces beside a chord that stands for a corner), and where its row stands on the body's side and has another
/// length, nothing would. Fluid and body are pushed apart there, and light nodes go far. So each facet that lies on a
/// body has p n_f there as a traction between the two, and each row of such a facet less by p n_r,
///
///   T = p (sum over facets n_f - sum over rows n_r),
///
/// with the weights of rows, before the multipliers are found: a fluid of one pressure on bodies at rest is in balance
/// with the multipliers p, whatever facets the reconstruction made (doc/decisions/0029). Where a row acts over just its
/// facet the two are one.
///
/// There are none in tension, nor where the sides do not touch (touching_gap): void beyond that closes under the
/// pressure. p is pressureAround: what the cells around do not bear drives a sliver that is squeezed out of where it is
/// (doc/decisions/0033). With the cell's own the tractions would take away all that resists a light sliver's sliding
/// into a corner, and noise grew (e-fold in 0.8 ms beside a square of 0.7 m in air). Without the viscosity, which
/// follows the velocity that the tractions make. Between two fluids p is the lower: what both carry.
///
/// The work of T is what a gas does on the void that opens where its sides slide along what is not their common normal,
/// or lacks where they overlap (RemapOptions::close_void_beside_gas).
struct PressureTractions
{
  View<double *[3]> pressure; // in: PairStress::pressure
  ContactRows rows;           // one for each traction; num_multipliers counts two for each
  View<double *[2]> load;     // num_own: along the row's normal and across it [Pa]
  View<double *> speed;       // num_own: sqrt(p / density) of the (lighter) fluid [m/s]
};

/// The tractions of the segments of owned cells. Of two fluids the slave's facets count; bonded pairs have none. The
/// caller sums num_multipliers and exchanges the rows.
/// \param planned The rows of each segment. \param pressure PairStress::pressure
PressureTractions findPressureTractions(RowBuilder const &builder, View<PlannedRows *> const &planned,
                                        View<double *[3]> const &pressure, WorkArrays const &work);

/// The tractions at work.
struct PressureImpulses
{
  ContactSystem system;
  MultiplierSolution solution; // impulses along the normals and across [N s/m]; changes of velocity [m/s]
};

/// Impulses of the tractions over `kick`. They do work on what slides: where the sides pass each other by 0.1
/// sqrt(p / density), of the lighter of two fluids, they fade, at twice that they are none. Nor do they change a node's
/// velocity by more than 20 sqrt(p / density), all together: what two bodies squeeze to a thousandth of a cell is so
/// light that it would leave with a hundred times that where the rows' impulses are not the pressure
/// (doc/decisions/0031).
///
/// \param system Of tractions.rows, at v*. \param before v^{n-1/2}. Collective.
PressureImpulses pressureImpulses(PressureTractions const &tractions, ContactSystem const &system, Motion const &before,
                                  double kick, Exchange const &exchange, WorkArrays const &work);

} // namespace Harmos

#endif
