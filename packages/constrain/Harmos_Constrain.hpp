// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONSTRAIN_HPP
#define HARMOS_CONSTRAIN_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_ConstraintOptions.hpp>
#include <Harmos_Exchange.hpp>
#include <Harmos_FilledRegions.hpp>
#include <Harmos_InterfaceSegments.hpp>
#include <Harmos_RigidBody.hpp>
#include <Harmos_Shape.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

/// One multiplier (two with a bond or friction): material_a inside, material_b outside, n leaves a.
struct ContactRow
{
  long long key; // global cell of the slave segment * max_cell_rows + its number there: the order of all sums
  int material_a, material_b; // material_b = -1: a contact wall
  int body_a, body_b;         // number of the rigid body, -1: deformable, -2: wall
  int cell_a, cell_b;         // local cells of the slave segment and of the surface that it faces
  int dof_a[4], dof_b[4];     // dof nodes (deformable sides)
  double weight_a[4], weight_b[4];
  Vector2 point, normal; // of the slave's point
  double gap;    // that a step may close along n, >= 0; below between overlapping outlines of rigid bodies [length]
  double bend;   // part of its change over the step that is of second order in v* (Harmos_OutlineRows.hpp)
  double length; // of the slave segment [length]
  int tied;
  double friction;    // coefficient
  double restitution; // of the closing speed
  int bond;           // number of the nearest bond of a pair whose bonds can break, -1: none

  /// Whether it holds a node to its own body (Harmos_TipTies.hpp).
  KOKKOS_INLINE_FUNCTION bool isWithinBody() const { return material_a == material_b; }
  /// Where it acts on side 0 (a) or 1 (b). Two rigid bodies are tied at one point: across gaps that differ from row to
  /// row no common spin would satisfy them.
  KOKKOS_INLINE_FUNCTION Vector2 pointOn(int side) const
  {
    return side == 0 || (tied && body_a >= 0 && body_b >= 0) ? point : point + gap * normal;
  }
  /// What the bodies may come closer in the step. An overlap is not pushed out.
  KOKKOS_INLINE_FUNCTION double opening() const { return Math::max(gap, 0.0) + bend; }
};

/// What a caller may keep from cycle to cycle.
struct ConstraintWork
{
  InterfaceCells cells;
  WorkArrays arrays;
};

/// Impulse and area of contact between two materials, for contact.csv: on a by b.
struct PairForce
{
  Vector2 impulse = {0.0, 0.0};
  double normal_impulse = 0.0;
  double area = 0.0;    // length of the loaded segments
  double squares = 0.0; // sum of (normal impulse)^2 / length over them

  /// Root mean square deviation, by length, of the normal impulses per length from their mean. [N s/m^2]
  double deviation() const
  {
    double const mean = area > 0.0 ? normal_impulse / area : 0.0;
    return area > 0.0 ? std::sqrt(std::max(squares / area - mean * mean, 0.0)) : 0.0;
  }
};

/// Force of a row over a cycle, with which the next one may start. [N/m]
struct ContactForce
{
  long long key; // ContactRow::key
  double normal, tangential;
};

/// What the stress of the materials tells the constraints. By pair.
struct PairStress
{
  View<double *[3]> cauchy;   // xx, yy, xy; Nitsche's method alone reads it [Pa]
  View<double *[3]> pressure; // of fluids (ConstraintOptions::fluid) [Pa], volume and mass; extent 0: a pressure acts
                              // along the rows' normals alone (Harmos_PressureTractions.hpp)
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
  std::vector<BondLoad> bond_load;       // by bond
  std::vector<ContactForce> force;       // warm_start: of all ranks' rows, by key; the same on every rank
};

/// \brief Correct the predicted velocities by the impulses of contact (and ties) between all bodies.
///
/// Finds impulses p with v = v* + M^-1 P G^T p (P: node conditions) such that every sliding row has
/// gap/dt + G v >= 0, p >= 0, p (gap/dt + G v) = 0, and every tied row G v = 0 in both directions; G v = n . (v_b -
/// v_a) at the point of the row's slave segment, n from a to b. A row with friction has an impulse p_t across n too,
/// |p_t| <= mu p, that stops the sliding or, at its bound, opposes it. The same p acts on both sides: momentum is
/// exact.
///
/// With restitution e a sliding row that is about to touch, gap/dt + G v* < 0, and closes, s = G v^{n-1/2} < 0, obeys
/// Newton's law of impact instead: G v >= -e s, so that its impulse takes p (1 - e)/2 |s| of energy: none for e = 1.
/// One that opens, s >= 0, and would close within the step goes back by what it opened:
/// G v >= -e s - (1 - e) max(s, gap/dt), so that for e = 1 nothing is taken, and for no e anything given (its gap does
/// not bound the speed: what opened in the last step may lie as void elsewhere in the cell). So does one that bears
/// though it was not about to touch, since what others' impulses move strikes there: the impulses are found anew with
/// it. Bodies in lasting contact, s = 0 without a gap, feel no difference. With friction, where normal and tangential
/// motion of a corner are coupled, Newton's and Coulomb's laws together may give energy (Kane & Levinson, Dynamics
/// (1985)).
///
/// Rows of whose velocity along n less than a thousandth is left to move ask for nothing (ContactSystem); bonded rows
/// give way by bonded_compliance, rows that rub by rubbing_compliance.
///
/// \param dof_mass   num_dof_nodes [kg/m]
/// \param velocity_n v^{n-1/2}, num_dof_nodes [m/s]: for the work of the impulses
/// \param predicted  v*, with node conditions applied [m/s]
/// \param half       Out: v^{n+1/2} of all dof nodes; dof nodes of rigid materials get their body's velocity at the
/// node.
///                   Right at all nodes of cells of depth <= 3. Without contact and rigid bodies it becomes the same
///                   array as `predicted`.
/// \param bodies_n   Rigid bodies with the velocities before the cycle.
/// \param bodies     In: predicted velocities. Out: v^{n+1/2}. Poses are not changed.
/// \param dt         Of the cycle [s]
/// \param kick       Time for which the forces of penalty, Nitsche and fluids' pressures act, from v^{n-1/2} to
/// v^{n+1/2}
///                   [s]
/// \param bonds      Of the pairs whose bonds can break: a row of such a pair is tied where the nearest is whole.
/// \param last Forces of the cycle before, from which the solver starts with options.warm_start: `force` of its report.
/// \param kept Cells with interfaces and work arrays, from cycle to cycle.
/// \param outline By rigid body, at its present pose: contact between rigid bodies, and of free ones with walls, then
///                acts where these meet (Harmos_OutlineRows.hpp; options.outline_rows), and that of deformable bodies
///                with them along their normals (Harmos_RigidSurfaces.hpp). Empty: on segments, along fitted normals,
///                as between all others.
/// \return Sums over all ranks. `converged` is false where the tolerance was not reached: the velocities are then those
///         of the last iterate, which conserves momentum all the same.
///
/// Throws std::runtime_error when a body's material is not one of the interaction table, or dt <= 0.
ConstraintReport constrainVelocities(Mesh const &mesh, CellMaterialPairs const &pairs,
                                     NodeMaterialPairs const &dof_nodes, FilledRegions const &regions,
                                     BoundaryConditions const &conditions, View<double *> const &dof_mass,
                                     View<double *[2]> const &velocity_n, View<double *[2]> const &predicted,
                                     View<double *[2]> &half, std::vector<RigidBody> const &bodies_n,
                                     std::vector<RigidBody> &bodies, double dt, double kick, PairStress const &stress,
                                     std::vector<Bond> const &bonds, ConstraintOptions const &options,
                                     Exchange const &exchange, std::vector<ContactForce> const &last = {},
                                     ConstraintWork *kept = nullptr, std::vector<Shape> const &outline = {});

/// The bonds of a scene at its start: one for each slave cell and pair of materials whose bond can break, where they
/// touch. In the order of the global cells, the same on all ranks. Collective.
std::vector<Bond> findBonds(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                            FilledRegions const &regions, BoundaryConditions const &conditions,
                            std::vector<RigidBody> const &bodies, ConstraintOptions const &options,
                            Exchange const &exchange);

/// Load the bonds (Harmos::carry) and break those that carry more than their materials' bond bears (Harmos::breaks), or
/// have snapped (BondLoad::snapped).
/// \return How many broke.
int breakBonds(std::vector<BondLoad> const &load, ConstraintOptions const &options, double kick,
               std::vector<Bond> &bonds);

} // namespace Harmos

#endif
