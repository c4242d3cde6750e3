// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BOUNDARY_CONDITIONS_HPP
#define HARMOS_BOUNDARY_CONDITIONS_HPP

#include <Harmos_Mesh.hpp>

namespace Harmos
{

/// What a numbered boundary does.
enum class BoundaryKind : int
{
  SlipWall,    // bilateral: v.n = 0 (symmetry)
  ContactWall, // one-sided: rows of the contact package, nodes are free
  Fixed,       // v = 0
  Inflow,      // state and velocity given
  Outflow,     // traction-free; what leaves is booked
  Prescribed   // v.n given (lagrangian alone)
};

struct Boundary
{
  BoundaryKind kind = BoundaryKind::SlipWall;
  double friction = 0.0;          // contact wall
  double restitution = 0.0;       // contact wall: part of the closing speed that bodies part with
  Vector2 velocity = {0.0, 0.0};  // Inflow: of the material; Prescribed: its normal part is used
  int material = -1;              // Inflow
  double specific_volume = 0.0;   // Inflow
  double internal_energy = 0.0;   // Inflow, per mass
};

/// A node's velocity constraint: v.normal[i] = value[i], i < count; count = 2 fixes the velocity.
struct NodeCondition
{
  int count = 0;
  Vector2 normal[2] = {{1.0, 0.0}, {0.0, 1.0}};
  double value[2] = {0.0, 0.0};

  /// The velocity that satisfies the conditions, nearest to v.
  KOKKOS_INLINE_FUNCTION Vector2 apply(Vector2 v) const
  {
    if (count == 2)
    {
      double const det = cross(normal[0], normal[1]);
      return {(value[0] * normal[1][1] - value[1] * normal[0][1]) / det,
              (normal[0][0] * value[1] - normal[1][0] * value[0]) / det};
    }
    if (count == 1)
      v += (value[0] - dot(v, normal[0])) * normal[0];
    return v;
  }

  /// The part of an impulse that the conditions leave free to act.
  KOKKOS_INLINE_FUNCTION Vector2 project(Vector2 impulse) const
  {
    if (count == 2)
      return {0.0, 0.0};
    if (count == 1)
      impulse -= dot(impulse, normal[0]) * normal[0];
    return impulse;
  }
};

/// Conditions of the boundary nodes; interior nodes have index -1.
struct BoundaryConditions
{
  View<Boundary *> boundary;          // by boundary number
  View<int *> node_index;             // num_nodes: index into `condition`, -1: none
  View<NodeCondition *> condition;    // compact
};

/// Node conditions from the boundary faces around each node (halo edges are no boundary).
///
/// Slip walls give their face normal, fixed and inflow faces both directions, prescribed faces their normal velocity;
/// contact walls and outflow give none. Where normals differ by less than 45 degrees the wall is curved: the node keeps
/// their mean, weighted by the faces' lengths, so that the wall as a whole lets nothing through (v constant: sum of
/// L v.n = 0), and slides along the mean tangent. A sharper corner fixes it.
BoundaryConditions buildBoundaryConditions(Mesh const &mesh, View<Boundary *> const &boundary);

} // namespace Harmos

#endif
