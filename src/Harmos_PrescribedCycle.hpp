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
/// field does to energy and momentum is external work and impulse.
CycleReport advancePrescribed(Scene const &scene, CycleState &state, PhaseTimes &times);

/// Velocities of the dof nodes at x and a time. [m/s]
void setPrescribedVelocities(Scene const &scene, CycleState &state);

} // namespace Harmos

#endif
