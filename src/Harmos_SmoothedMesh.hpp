// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SMOOTHED_MESH_HPP
#define HARMOS_SMOOTHED_MESH_HPP

#include "Harmos_TimeStep.hpp"

#include <Harmos_MeshSmoother.hpp>

namespace Harmos
{

/// A target mesh for Scene::target_mesh that follows the material and evens out its cells (smoothNodes). A node's
/// material motion is dt times the mean of v^{n+1/2} over its dof nodes, weighted by their masses.
///
/// Where the new mesh would have a cell that is not convex, or a moved dof node would lie farther from its node than
/// 0.9 of the least altitude of the cells around, or a pure cell would give all it has away (largestSweptPart), the
/// whole step of the mesh is halved, up to four times; then the mesh rests in this cycle.
/// \param boundary  Of the scene. \param exchange  Must outlive the function that is returned.
TargetMesh smoothedMesh(MeshSmoother const &smoother, BoundaryConditions const &boundary, Exchange const &exchange);

} // namespace Harmos

#endif
