// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TIME_STEP_HPP
#define HARMOS_TIME_STEP_HPP

#include <Harmos_Points.hpp>

#include <Harmos_Constrain.hpp>
#include <Harmos_Lagrange.hpp>
#include <Harmos_PrescribedField.hpp>
#include <Harmos_Reconstruct.hpp>
#include <Harmos_Remap.hpp>
#include <Harmos_Shape.hpp>
#include <Harmos_SubzonalPressure.hpp>

#include <functional>
#include <vector>

namespace Harmos
{

/// Layers of halo cells that the cycle needs (doc/decisions/0003).
constexpr int halo_layers = 7;

struct CycleState;

/// Where the nodes of a mesh are to be at the end of a cycle.
///
/// \param mesh    Where they are. \param state  Before the remap: state.work.half are the dof nodes' v^{n+1/2}.
/// \param dt      Of this cycle [s].
/// \param target  All local nodes; holds their present positions. Must be right, to the bit, at the nodes of owned
///                cells, on every rank that owns one around; the others get what their owners have.
using TargetMesh =
    std::function<void(Mesh const &mesh, CycleState const &state, double dt, View<double *[2]> const &target)>;

/// What does not change from cycle to cycle. A host code fills it with its own mesh and exchange.
struct Scene
{
  Kinematics kinematics = Kinematics::Xfem;
  Mesh mesh;              // node positions change in lagrangian kinematics and with a target mesh
  TargetMesh target_mesh; // empty: the remap goes back to where the cycle began
  BoundaryConditions boundary;
  View<Material *> materials;
  std::vector<Shape> rigid_shape; // by rigid body, in its pose at the start; lagrangian: none where not known
  std::vector<RigidBody> rigid_start;
  LagrangeOptions lagrange;
  ReconstructionOptions reconstruction;
  ConstraintOptions constraint;
  RemapOptions remap;
  View<double *[4]> subzone_fraction; // lagrangian: of the mesh at time zero, the present one where empty
  PrescribedField prescribed;         // with a kind: no mechanics, all moves with it
  double max_dt = 1e300;              // [s]
  Exchange const *exchange = nullptr; // on one rank an Exchange, on several a TpetraExchange of this mesh
};

/// What the cycle carries.
struct CycleState
{
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
  FilledRegions regions;          // of this state
  LagrangeWork work;              // scratch, kept from cycle to cycle
  RemapWork remap_work;           // the same
  ConstraintWork constraint_work; // the same
  std::vector<RigidBody> bodies;
  RigidRows rigid_rows;              // what the bodies fill,
  RigidCorners rigid_corners;        // and their corners, at
  std::vector<RigidBody> rigid_pose; // these poses
  std::vector<Tracer> tracers;       // moved with v^{n+1/2}
  std::vector<Bond> bonds;           // of the pairs whose bonds can break; found in the first cycle
  std::vector<Tracer> bond_tracers;  // what moves them
  std::vector<ContactForce> force;   // of the last cycle's rows, where the solver starts from them
  std::vector<double> start_density; // by material, the largest of its law and of the start; a restart keeps it
  double time = 0.0;                 // [s], of the records; velocities are half a step behind
  double dt = 0.0;                   // of the next cycle [s]
  double last_dt = 0.0;              // of the last cycle, 0 before the first: velocities are half of it behind [s]
  TimeStepLimit limit;               // what sets it
  long long cycle = 0;
  bool started = false; // by startCycle
};

/// Seconds spent in the phases of the cycle, this rank.
struct PhaseTimes
{
  double reconstruct = 0.0;
  double lagrange = 0.0;
  double constrain = 0.0;
  double remap = 0.0;
  double exchange = 0.0;
};

/// What one cycle did, summed over ranks; energies and impulses per unit depth.
struct CycleReport
{
  double dt = 0.0;
  double kick = 0.0;         // (last cycle's dt + dt)/2: the time for which forces act, from v^{n-1/2} to v^{n+1/2}
  int repeats = 0;           // cycle repeated with half the time step: a node would have outrun its neighbourhood
  int broken_bonds = 0;      // in this cycle
  long long light_nodes = 0; // light dof nodes moved with their pair
  ReconstructionReport reconstruction;
  ConstraintReport constraint;
  UpdateReport update;
  FailureReport failure;
  RemapReport remap;
  double external_work = 0.0; // gravity, walls, driven bodies
  Vector2 external_impulse = {0.0, 0.0};
  int crossing_cell = -1; // prescribed field: it would carry this cell's material through a side of the mesh
  int crossing_material = -1;
  double restored_volume = 0.0; // prescribed field: sum over materials of |volume given back| [length^2]
};

/// Dof velocities of rigid materials from their bodies (single: of every node that a rigid pair touches).
void setRigidVelocities(Scene const &scene, CycleState &state);

/// The state as probes and tracers look at it.
PointField pointField(Scene const &scene, CycleState const &state);

/// Filled regions of the state -> state.regions. Once at the start; every cycle ends with it.
void reconstructState(Scene const &scene, CycleState &state, ReconstructionReport &report);

/// Make a state ready for its first cycle, or for its next where a host code has restored it: checks scene and state,
/// fills what follows from them (impedances and subzone fractions where empty, damage where a law can fail, rigid
/// bodies and their velocities, the first stable step `state.dt`) and reconstructs the filled regions. Collective.
///
/// \param state Holds pairs, records, centroids, dof nodes and their velocities: painted (Harmos_Paint.hpp) or
///              restored. A restored state's own step is to be set afterwards.
/// \return Failures above zero: an interface could not be placed, and the state cannot be used.
/// \throw std::runtime_error that names what is missing or does not fit, the same on all ranks.
ReconstructionReport startCycle(Scene &scene, CycleState &state);

/// One cycle: lagrange, constrain, move, remap, and the filled regions of the new state (doc/theory). With a
/// prescribed field: move, remap, filled regions.
///
/// \return What happened. `update.inverted` or `update.not_a_number` above zero, or failures of the remap or the
///         reconstruction, mean that the state is no longer to be used: the caller stops the run.
/// \throw std::runtime_error if the state has not been started, or the host's target mesh cannot be used.
CycleReport advance(Scene &scene, CycleState &state, PhaseTimes &times);

} // namespace Harmos

#endif
