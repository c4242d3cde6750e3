// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TARGET_MESH_HPP
#define HARMOS_TARGET_MESH_HPP

#include "Harmos_TimeStep.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace Harmos
{

/// Longest diagonal's square over the area, halved: of a rectangle of sides a < b it is (b/a + a/b)/2.
KOKKOS_INLINE_FUNCTION double elongation(Quadrilateral const &q)
{
  Vector2 const d = q[2] - q[0], e = q[3] - q[1];
  return Math::max(dot(d, d), dot(e, e)) / cross(d, e);
}

/// Of the owned cells.
double largestElongation(Mesh const &mesh);

/// elongation of a rectangle with sides 1 : 4, the longest cells on several ranks (doc/decisions/0003).
constexpr double largest_shared_aspect = 2.125 * (1.0 + 1e-9);

/// Whether bodies, or bodies and walls, can touch: contact alone reaches for a length, all else for neighbours.
bool contactCanArise(Kinematics kinematics, std::size_t num_materials, std::vector<Boundary> const &boundary);

/// Why several ranks cannot run a mesh of such cells; empty: they can, or there is one. Collective.
std::string whyNotShared(Scene const &scene);

/// What is wrong with a target mesh on some rank: all throw it.
class TargetMeshError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// What a target mesh has no meaning with. \throw std::runtime_error
void checkTarget(Scene const &scene);

/// Move the mesh to where the host code wants it. \return Where it was; extent 0: nobody wants it moved.
/// \throw TargetMeshError if cells are not strictly convex there, or too long for several ranks. Collective.
View<double *[2]> moveToTarget(Scene &scene, CycleState &state, double dt);

/// On a mesh that has moved under the state: its stable step, and the cells of the tracers.
void settleOnTarget(Scene const &scene, CycleState &state, TimeStepLimit &next);

} // namespace Harmos

#endif
