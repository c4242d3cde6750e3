// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SUBZONAL_PRESSURE_HPP
#define HARMOS_SUBZONAL_PRESSURE_HPP

#include <Harmos_Lagrange.hpp>

namespace Harmos
{

/// What a cell's four subzones take of its area: (cells, corners), adding up to one.
///
/// The subzone of corner I has the corner, the middles of its two edges and the mean of the four corners as vertices.
/// All four are a quarter on a parallelogram.
View<double *[4]> subzoneFractions(Mesh const &mesh);

/// Pressures that keep the subzones of a body-fitted cell at their share of it, added to work.corner_force.
///
/// With the mean gradient alone nothing but a viscosity holds a cell against becoming a wedge, which where the flow
/// stretches it a hundredfold (the axis of a Taylor rod) it does, until an edge has no length left. Each subzone keeps
/// its mass, so that its density differs from the cell's by the ratio of areas:
/// dp_I = merit rho c^2 (phi_I A / A_I - 1), f_J = sum_I dp_I dA_I/dx_J; phi the fractions at the start, A_I the areas
/// now, c the bulk sound speed. The forces of a cell have no resultant and no moment and vanish where A_I = phi_I A;
/// their work is part of corner_force's. Axisymmetric: times the cell's mean radius, A the areas in the plane. For
/// pairs that fill their cell and moved with it from the start: kinematics lagrangian. Rigid pairs: nothing. Caramana &
/// Shashkov, J. Comput. Phys. 142 (1998) 521-561.
void addSubzonalForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                       View<Material *> const &materials, View<double *[4]> const &fraction, double merit,
                       LagrangeWork &work);

} // namespace Harmos

#endif
