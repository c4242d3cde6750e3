// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RIGID_MOTION_HPP
#define HARMOS_RIGID_MOTION_HPP

#include "Harmos_TimeStep.hpp"

#include <vector>

namespace Harmos
{

/// Free rigid bodies fall for the time `kick`; the others keep their motion.
std::vector<RigidBody> predictBodies(std::vector<RigidBody> bodies, Vector2 const &gravity, double kick);

/// x += dt v, angle += dt omega.
void moveBodies(std::vector<RigidBody> &bodies, double dt);

/// Their outlines at given poses.
std::vector<Shape> presentShapes(Scene const &scene, std::vector<RigidBody> const &bodies);

/// What the rigid bodies fill at their new poses; where none has moved, the rows of the last cycle.
RigidRows const &rigidRows(Scene const &scene, CycleState &state);

/// Set the rigid velocities after a remap. In `single` the nodes that a rigid material has newly reached are stopped,
/// or driven: what that does to the deformable materials is work and impulse of the rigid bodies.
void holdRigidNodes(Scene const &scene, CycleState &state, PredictionSums &prediction);

/// Nodes of a turning rigid block: on their circles, not on the tangents along which velocities would move them.
void turnRigidNodes(Mesh const &mesh, NodeMaterialPairs const &dof_nodes, RigidBody const &body_n,
                    RigidBody const &body, double dt);

} // namespace Harmos

#endif
