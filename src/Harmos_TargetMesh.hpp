// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TARGET_MESH_HPP
#define HARMOS_TARGET_MESH_HPP

#include "Harmos_TimeStep.hpp"

namespace Harmos
{

/// What a target mesh has no meaning with. \throw std::runtime_error
void checkTarget(Scene const &scene);

/// Move the mesh to where the host code wants it. \return Where it was; extent 0: nobody wants it moved.
/// \throw std::runtime_error if cells are not strictly convex there, or too long for several ranks. Collective.
View<double *[2]> moveToTarget(Scene &scene, CycleState &state, double dt);

/// On a mesh that has moved under the state: its stable step, and the cells of the tracers.
void settleOnTarget(Scene const &scene, CycleState &state, TimeStepLimit &next);

} // namespace Harmos

#endif
