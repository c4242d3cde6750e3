// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PRESCRIBED_CYCLE_HPP
#define HARMOS_PRESCRIBED_CYCLE_HPP

#include "Harmos_TimeStep.hpp"

namespace Harmos
{

/// One cycle without mechanics: the dof nodes move with scene.prescribed, then remap and reconstruction as ever.
///
/// v^{n+1/2} = (X(t + dt) - X(t)) / dt along each node's trajectory. The fields are free of divergence and the density
/// stays the law's: volumes are restored after the remap (doc/decisions/0005) and masses follow from them. What the
/// field does to energy and momentum is external work and impulse. Where the field carries material through a side of
/// the mesh (report.crossing_cell on one of the ranks), nothing is done.
CycleReport advancePrescribed(Scene const &scene, CycleState &state, PhaseTimes &times);

/// The first cell, with its material, whose material the next step would carry through a side of the mesh, or away from
/// it: none has a meaning there, since the walls let nothing through and the volumes are kept. Not collective.
struct SideCrossing
{
  int cell = -1; // local; -1: none
  int material = -1;
};
SideCrossing findSideCrossing(Scene const &scene, CycleState const &state);

/// Velocities of the dof nodes at x and a time. [m/s]
void setPrescribedVelocities(Scene const &scene, CycleState &state);

} // namespace Harmos

#endif
