// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LUMPED_FORCES_HPP
#define HARMOS_LUMPED_FORCES_HPP

#include <Harmos_Lagrange.hpp>

namespace Harmos
{

/// Where the mass of each fluid of a cut cell is, and along what it may be driven: what addLumpedForces goes by.
/// \return Whether there is any.
bool locateCutFluids(Mesh const &mesh, CellMaterialPairs const &pairs, FilledRegions const &regions,
                     View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork &work);

/// \brief What drives fluids along interfaces, moved to where their mass is lumped: added to work.corner_force.
///
/// A fluid that fills a part of a cell has its forces by the shape functions over that part (CutGradients): what drives
/// it along the interface acts about the part's centroid x_c, in the parts N_I(x_c). Its mass is lumped at the corners
/// by corner_share s_I, as if it filled the cell. Along a wall with the fraction f of its cells full a gradient of
/// pressure so accelerates the nodes beyond the wall by f, the others by more than is due, and gravity, which is the
/// same for all, is balanced nowhere: a fluid at rest streams. So each such pair, mass m, gets
///
///   h_I = (s_I - N_I(x_c)) t (t . F),   F = sum_J (m N_J / M_J) f_J,   M_J = sum over pairs m N_J(x_c),
///
/// t along its interface, f_J the force on node J of all pairs of the material around with one pressure taken from
/// theirs, the mean by volume of what they have, which is what the interfaces there bear: so one pressure everywhere
/// drives nothing, whatever way the interface bends, and a small tip of another pressure is driven by what acts through
/// its opening alone. Where all nodes
/// should have one acceleration, f_J = M_J a, they get it along t: f_J + sum h_J = m_J a. The sum over I of h_I is
/// zero; its work is the pair's (updatePairs). Across the interface the contact's tractions, which have the same
/// weights, are in balance with the stress. Where edges inside of the cell have several directions, less:
/// ((e_1 - e_2) / (e_1 + e_2))^2 of the eigenvalues of sum over edges L n n^T.
///
/// All forces [N/m] (per radian about an axis: [N]). The law is of our own (doc/decisions/0045).
///
/// \param work In: corner_force, cut, pressure (keeps_pressure) of all local pairs. Nodes at the rim of the halo do not
/// have all their cells. locateCutFluids went before, predictVelocities is to follow.
void addLumpedForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                     FilledRegions const &regions, BoundaryConditions const &boundary,
                     View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork &work);

} // namespace Harmos

#endif
