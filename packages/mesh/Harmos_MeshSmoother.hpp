// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MESH_SMOOTHER_HPP
#define HARMOS_MESH_SMOOTHER_HPP

#include <Harmos_BoundaryConditions.hpp>

namespace Harmos
{

/// How a mesh moves by itself (arbitrary Lagrangian-Eulerian).
struct MeshSmoother
{
  double follow = 0.0; // part of the material's mean motion that the nodes follow, 0 to 1
  double relax = 0.0;  // part of the way to the mean of its neighbours that a node then goes, 0 to 1

  KOKKOS_INLINE_FUNCTION bool moves() const { return follow > 0.0 || relax > 0.0; }
};

/// y = x' + relax (1/2n sum over the n cells around of (x'_before + x'_after) - x'), x' = x + follow u: Laplacian
/// smoothing (Field, Commun. Appl. Numer. Methods 4 (1988) 709-712) of a mesh that follows the material.
/// "Before" and "after" are the node's neighbours in a cell. It evens out the sizes of the cells.
///
/// Boundary nodes slide along slip walls by what their node condition leaves of it, and stay at all other boundaries.
/// \param motion  u of all local nodes [length].
/// \param target  y of all local nodes; not that of a node whose cells the halo does not hold all.
void smoothNodes(Mesh const &mesh, BoundaryConditions const &conditions, MeshSmoother const &smoother,
                 View<double *[2]> const &motion, View<double *[2]> const &target);

} // namespace Harmos

#endif
