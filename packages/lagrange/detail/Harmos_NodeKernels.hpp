// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_NODE_KERNELS_HPP
#define HARMOS_NODE_KERNELS_HPP

#include <Harmos_Lagrange.hpp>

#include <functional>

namespace Harmos
{
namespace detail
{

/// Launches a kernel for the pairs from `begin` to `end`.
using PairKernel = std::function<void(int begin, int end)>;
/// Launches a kernel for the dof nodes from `begin` to `end` and adds to the sums.
using NodeKernel = std::function<void(int begin, int end, PredictionSums &sums)>;

/// computeCornerForces of some of the pairs.
PairKernel cornerForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                        View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork &work);

/// predictVelocities of some of the dof nodes.
NodeKernel prediction(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                      PairState const &state, BoundaryConditions const &boundary, View<Material *> const &materials,
                      LagrangeOptions const &options, double kick, LagrangeWork &work);

} // namespace detail
} // namespace Harmos

#endif
