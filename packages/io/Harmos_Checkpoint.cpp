// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Checkpoint.hpp>
#include <Harmos_ResultFiles.hpp>

#include <detail/Harmos_AtomicFile.hpp>
#include <detail/Harmos_CheckpointRecord.hpp>
#include <detail/Harmos_GlobalOrder.hpp>

#include <algorithm>
#include <filesystem>

namespace Harmos
{

namespace
{

/// Checkpoints of a folder, cycle -> name.
std::map<long long, std::string> checkpointsIn(std::string const &directory)
{
  std::map<long long, std::string> found;
  if (!std::filesystem::is_directory(directory))
    return found;
  for (auto const &entry : std::filesystem::directory_iterator(directory))
    if (long long const cycle = checkpointCycle(entry.path()); cycle >= 0)
      found[cycle] = entry.path().string();
  return found;
}

std::string checkpointName(std::string const &directory, long long cycle)
{
  return directory + '/' + checkpointFileName(cycle);
}

/// Keep this cycle's checkpoint and the newest before it.
void removeOthers(std::string const &directory, long long cycle)
{
  auto const found = checkpointsIn(directory);
  long long previous = -1;
  for (auto const &[c, name] : found)
    if (c < cycle)
      previous = c;
  for (auto const &[c, name] : found)
    if (c != cycle && c != previous)
      std::filesystem::remove(name);
}

/// Owned pairs and their values on the host, ascending by (cell, material).
struct OwnedPairs
{
  std::vector<long long> cell;
  std::vector<int> material;
  std::vector<double> record, centroid, corner_velocity, damage;
};

OwnedPairs ownedPairs(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state)
{
  auto const depth = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_depth);
  auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_global);
  auto const cell = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), pairs.cell);
  auto const material = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), pairs.material);
  auto const dof = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), pairs.dof_node);
  auto const record = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), state.record);
  auto const centroid = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), state.centroid);
  auto const velocity = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), state.velocity);
  auto const damage = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), state.damage);
  OwnedPairs owned;
  for (int pair = 0; pair < pairs.num_pairs; ++pair)
  {
    if (depth(cell(pair)) != 0)
      continue;
    owned.cell.push_back(global(cell(pair)));
    owned.material.push_back(material(pair));
    for (int f = 0; f < num_pair_fields; ++f)
      owned.record.push_back(record(pair, f));
    for (int d = 0; d < 2; ++d)
      owned.centroid.push_back(centroid(pair, d));
    for (int corner = 0; corner < 4; ++corner)
      for (int d = 0; d < 2; ++d)
        owned.corner_velocity.push_back(velocity(dof(pair, corner), d));
    if (state.tracks_damage)
      owned.damage.push_back(damage(pair));
  }
  return owned;
}

void writePairs(Hdf5File &file, MPI_Comm comm, OwnedPairs const &owned, bool has_damage, long long num_cells)
{
  GlobalOrder const order(comm, owned.cell, num_cells);
  file.createGroup("/pairs");
  file.writeAttribute<long long>("/pairs", "count", order.total());
  writeChecked(file, order, "/pairs/cell", order.key(), 1);
  writeChecked(file, order, "/pairs/material", order.arrange(owned.material), 1);
  writeChecked(file, order, "/pairs/record", order.arrange(owned.record, num_pair_fields), num_pair_fields);
  writeChecked(file, order, "/pairs/centroid", order.arrange(owned.centroid, 2), 2);
  writeChecked(file, order, "/pairs/corner_velocity", order.arrange(owned.corner_velocity, 8), 8);
  if (has_damage)
    writeChecked(file, order, "/pairs/damage", order.arrange(owned.damage), 1);
}

void writeNodes(Hdf5File &file, MPI_Comm comm, Mesh const &mesh, long long num_nodes)
{
  auto const owned = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_owned);
  auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_global);
  auto const position = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_position);
  std::vector<long long> key;
  std::vector<double> value;
  for (int node = 0; node < mesh.num_nodes; ++node)
    if (owned(node))
    {
      key.push_back(global(node));
      value.insert(value.end(), {position(node, 0), position(node, 1)});
    }
  GlobalOrder const order(comm, key, num_nodes);
  file.createGroup("/nodes");
  file.writeAttribute<long long>("/nodes", "count", order.total());
  writeChecked(file, order, "/nodes/global", order.key(), 1);
  writeChecked(file, order, "/nodes/position", order.arrange(value, 2), 2);
}

/// One more than the largest number on any rank.
long long globalCount(MPI_Comm comm, View<long long *> const &number)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), number);
  long long count = 0;
  for (std::size_t i = 0; i < host.extent(0); ++i)
    count = std::max(count, host(i) + 1);
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_LONG_LONG, MPI_MAX, comm);
  return count;
}

} // namespace

std::string writeCheckpoint(MPI_Comm comm, std::string const &directory, Mesh const &mesh,
                            CellMaterialPairs const &pairs, PairState const &state, CheckpointScalars const &scalars)
{
  std::string const path = checkpointName(directory, scalars.cycle);
  TemporaryFile const temporary(path);
  long long const num_cells = globalCount(comm, mesh.cell_global);
  long long const num_nodes = globalCount(comm, mesh.node_global);
  {
    Hdf5File file = Hdf5File::create(comm, temporary.name());
    file.writeAttribute("/", "format", checkpoint_format);
    file.writeAttribute("/", "cells", num_cells);
    file.writeAttribute("/", "nodes", num_nodes);
    writeScalars(file, comm, scalars);
    writePairs(file, comm, ownedPairs(mesh, pairs, state), state.tracks_damage, num_cells);
    if (scalars.kinematics == Kinematics::Lagrangian || scalars.moving_mesh)
      writeNodes(file, comm, mesh, num_nodes);
    file.close();
  }
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank == 0)
  {
    temporary.publish();
    removeOthers(directory, scalars.cycle);
  }
  MPI_Barrier(comm);
  return path;
}

View<double *[2]> dofVelocities(CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                                View<double *[8]> const &corner_velocity)
{
  // A dof node's pairs hold the same numbers where their owners wrote complete nodes; at the rim of the halo any will
  // do. On the host: once a restart.
  auto const dof = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), pairs.dof_node);
  auto const corner = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), corner_velocity);
  View<double *[2]> const velocity("Harmos::io::velocity", dof_nodes.num_dof_nodes);
  auto const host = Kokkos::create_mirror_view(velocity);
  for (int pair = pairs.num_pairs - 1; pair >= 0; --pair)
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < 2; ++d)
        host(dof(pair, k), d) = corner(pair, 2 * k + d);
  Kokkos::deep_copy(velocity, host);
  return velocity;
}

std::string newestCheckpoint(std::string const &directory)
{
  auto const found = checkpointsIn(directory);
  return found.empty() ? std::string() : found.rbegin()->second;
}

std::string soundCheckpointBefore(std::string const &path)
{
  std::filesystem::path const folder = std::filesystem::path(path).parent_path();
  long long const cycle = checkpointCycle(path);
  auto const found = checkpointsIn(folder.empty() ? "." : folder.string());
  for (auto i = found.rbegin(); i != found.rend(); ++i)
    if (i->first < cycle && isSound(i->second))
      return i->second;
  return "";
}

} // namespace Harmos
