// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONSTRAIN_HPP
#define HARMOS_CONSTRAIN_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_Exchange.hpp>
#include <Harmos_FilledRegions.hpp>
#include <Harmos_RigidBody.hpp>

namespace Harmos
{

enum class Interaction : int
{
  Sliding, // frictionless, free to separate
  Tied     // no relative velocity at all
};

struct ConstraintOptions
{
  View<int **> interaction; // (materials, materials), symmetric: Interaction
  double tolerance = 1e-8;  // of max(largest predicted |G v|, 1e-6 speed_scale)
  int max_iterations = 1000;
  double speed_scale = 0.0;      // of the scene [m/s]
  double shortest_segment = 0.1; // of the cell size; shorter segments carry no row
  double exposed_face = 0.5;     // least exposed part of a cell face that carries a row
};

/// One multiplier (two when tied): material_a inside, material_b outside, n leaves a.
struct ContactRow
{
  long long key;              // global cell of the slave segment * 64 + its number there: the order of all sums
  int material_a, material_b; // material_b = -1: a contact wall
  int body_a, body_b;         // number of the rigid body, -1: deformable, -2: wall
  int cell_a, cell_b;         // local cells of the slave segment and of the surface that it faces
  int dof_a[4], dof_b[4];     // dof nodes (deformable sides)
  double weight_a[4], weight_b[4];
  Vector2 point, normal; // of the slave's point
  double gap;            // along n, >= 0 [length]
  double length;         // of the slave segment [length]
  int tied;
  double multiplier[2]; // impulse along n, and along perpendicular(n) when tied [N s/m]
};

/// Impulse and area of contact between two materials, for contact.csv: on a by b.
struct PairForce
{
  Vector2 impulse = {0.0, 0.0};
  double normal_impulse = 0.0;
  double area = 0.0; // length of the loaded segments
};

struct ConstraintReport
{
  long long rows = 0; // multipliers, over all ranks
  int iterations = 0;
  double residual = 0.0; // relative, at the end
  bool converged = true;
  double contact_loss = 0.0;             // - sum impulse . v_mean over rows, without the work on driven bodies [J/m]
  double driven_work = 0.0;              // work done by driven (fixed, prescribed) rigid bodies on the others
  Vector2 external_impulse = {0.0, 0.0}; // on the bodies by driven rigid bodies, contact walls and node conditions
  std::vector<Vector2> body_impulse;     // by rigid body
  std::vector<double> body_torque;       // about its centre
  std::vector<PairForce> pair_force;     // (materials + 1)^2, row-major; last index: contact wall
};

/// \brief Correct the predicted velocities by the impulses of contact (and ties) between all bodies.
///
/// Finds impulses p with v = v* + M^-1 P G^T p (P: node conditions) such that every sliding row has
/// gap/dt + G v >= 0, p >= 0, p (gap/dt + G v) = 0, and every tied row G v = 0 in both directions; G v = n . (v_b -
/// v_a) at the point of the row's slave segment, n from a to b. The same p acts on both sides: momentum is exact.
///
/// \param dof_mass   num_dof_nodes [kg/m]
/// \param velocity_n v^{n-1/2}, num_dof_nodes [m/s]: for the work of the impulses
/// \param predicted  v*, with node conditions applied [m/s]
/// \param half       Out: v^{n+1/2} of all dof nodes; dof nodes of rigid materials get their body's velocity at the
/// node.
///                   Right at all nodes of cells of depth <= 3.
/// \param bodies_n   Rigid bodies with the velocities before the cycle.
/// \param bodies     In: predicted velocities. Out: v^{n+1/2}. Poses are not changed.
/// \param dt         Of the cycle [s]
/// \return Sums over all ranks. `converged` is false where the tolerance was not reached: the velocities are then those
/// of
///         the last iterate, which conserves momentum all the same.
///
/// Throws std::runtime_error when a body's material is not one of the interaction table, or dt <= 0.
ConstraintReport constrainVelocities(Mesh const &mesh, CellMaterialPairs const &pairs,
                                     NodeMaterialPairs const &dof_nodes, FilledRegions const &regions,
                                     BoundaryConditions const &conditions, View<double *> const &dof_mass,
                                     View<double *[2]> const &velocity_n, View<double *[2]> const &predicted,
                                     View<double *[2]> const &half, std::vector<RigidBody> const &bodies_n,
                                     std::vector<RigidBody> &bodies, double dt, ConstraintOptions const &options,
                                     Exchange const &exchange);

} // namespace Harmos

#endif
