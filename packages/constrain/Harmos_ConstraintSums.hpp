// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONSTRAINT_SUMS_HPP
#define HARMOS_CONSTRAINT_SUMS_HPP

#include <Harmos_ContactSystem.hpp>
#include <Harmos_MultiplierSolver.hpp>

namespace Harmos
{

/// Add impulses, work and pair forces of a solution to a report, over all ranks.
///
/// The kinetic energy of deformable dofs and free bodies changes by the sum over rows of p . G v_mean less the part of
/// the driven sides, and by the node conditions, which take impulse f - P f from a dof:
///   contact_loss = - sum p . G v_mean (all sides; walls at rest),
///   driven_work  = - sum p . (driven side's part of G v_mean) - sum over dofs (f - P f) . v_mean,
///   change of kinetic energy by the constraints = driven_work - contact_loss, exactly.
///
/// v_mean = (v_n + half)/2, but of what the conditions hold half: what a wall takes does no work with a velocity that
/// it stops.
///
/// \param mean_bodies Bodies with (V_n + V_half)/2.
/// \param tell_pressure Whether normal impulses and loaded lengths count for the contact pressure of the pairs.
/// Collective.
void sumConstraint(ContactSystem const &system, ContactRows const &rows, MultiplierSolution const &solution,
                   Mesh const &mesh, NodeMaterialPairs const &dof_nodes, View<double *[2]> const &velocity_n,
                   View<double *[2]> const &half, BodyTable const &mean_bodies, int num_materials,
                   Exchange const &exchange, bool tell_pressure, ConstraintReport &report,
                   WorkArrays const &arrays = {});

/// Add up what the own rows of all ranks carry around their bonds that have not snapped, as their nodes feel it: the
/// same bits on any number of ranks. Collective.
void sumBondLoads(ContactSystem const &system, ContactRows const &rows, View<double *[2]> const &impulse,
                  Exchange const &exchange, std::vector<BondLoad> &load, WorkArrays const &work = {});

/// Rigid bodies bear impulses: a bond between two of them does not hold the one that it cannot bear for a cycle, but
/// snaps (BondLoad::snapped), and its rows slide from this solve on.
/// \param rows Those of bonds that snap are untied, own ones alone: rows between rigid bodies have no others.
/// \param kick Time over which impulses act [s]
/// \return Whether one did: the impulses are to be found anew.
bool snapRigidBonds(ContactRows const &rows, std::vector<RigidBody> const &bodies, std::vector<Bond> const &bonds,
                    ConstraintOptions const &options, double kick, std::vector<BondLoad> &load);

} // namespace Harmos

#endif
