// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CHECKPOINT_HPP
#define HARMOS_CHECKPOINT_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_RigidBody.hpp>

#include <map>
#include <mpi.h>
#include <string>
#include <vector>

namespace Harmos
{

/// What a restart needs besides pairs and velocities; the same on all ranks.
struct CheckpointScalars
{
  long long cycle = 0;
  double time = 0.0;    // t^n of the next cycle [s]
  double dt = 0.0;      // of the next cycle [s]
  double last_dt = 0.0; // of the last one [s]
  Kinematics kinematics = Kinematics::Xfem;
  bool moving_mesh = false; // the node positions belong to the state, as they do in `lagrangian` kinematics
  std::vector<std::string> material_names;
  std::vector<RigidBody> bodies;
  std::map<std::string, double> ledger;              // cumulative values of the history, and whatever steers the run
  std::map<std::string, std::vector<double>> arrays; // further global values (tracers, schedules)
  std::vector<std::string> warnings;                 // of the run so far, one line each
  std::string deck;                                  // text
  std::string version;                               // of the program that wrote it
};

/// A state as a checkpoint holds it: velocities by pair corner, since dof nodes are derived data.
struct CheckpointState
{
  CellMaterialPairs pairs; // offset, material and cell alone
  View<double *[num_pair_fields]> record;
  View<double *[2]> centroid;
  View<double *[8]> corner_velocity; // vx, vy of corners 0..3
  bool has_damage = false;
  View<double *> damage; // pairs, where the run tracked it
};

/// Write DIR/checkpoint_CYCLE.h5; collective.
///
/// The file has its final name only once it is complete and flushed. It holds owned cells in the order of global cells,
/// doubles as their bits, and a checksum of every array; it does not depend on the number of ranks. Of the older
/// checkpoints in the folder the newest is kept; those of later cycles (of a branch that a restart left) are removed.
///
/// In `lagrangian` kinematics, and where the mesh moves by itself, the node positions are written as well.
/// \return The file's name. \throws std::runtime_error with the file's name and the cause.
std::string writeCheckpoint(MPI_Comm comm, std::string const &directory, Mesh const &mesh,
                            CellMaterialPairs const &pairs, PairState const &state, CheckpointScalars const &scalars);

/// Read the scalars alone (the deck, before there is a mesh). \throws std::runtime_error as readCheckpoint.
CheckpointScalars readCheckpointScalars(std::string const &path);

/// Read the pairs of the local cells, owned and halo, of any partition of the same mesh; collective.
///
/// Every rank scans the whole file, verifies its checksums and keeps the rows of its cells.
/// \param mesh Its node positions, cell areas and volumes are replaced where the file holds them; its corner shares
///             are not (updateCornerShares: where the mesh does not move with its material).
/// \throws std::runtime_error with the file's name: missing or cut short, another format, of another mesh, or damaged.
CheckpointState readCheckpoint(MPI_Comm comm, std::string const &path, Mesh &mesh);

/// Velocities of dof nodes from pair corners: every dof node takes the velocity of the lowest pair that it moves.
View<double *[2]> dofVelocities(CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                                View<double *[8]> const &corner_velocity);

/// The newest checkpoint in a folder, or an empty string.
std::string newestCheckpoint(std::string const &directory);

/// Whether all of a checkpoint can be read and has its checksums.
bool isSound(std::string const &path);

/// The newest sound checkpoint beside another one and older than it, or an empty string.
std::string soundCheckpointBefore(std::string const &path);

} // namespace Harmos

#endif
