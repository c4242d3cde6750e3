// SPDX-License-Identifier: BSD-3-Clause
#include "OutputScene.hpp"
#include "SmallDisk.hpp"
#include "TestFolder.hpp"

#include <Harmos_Checkpoint.hpp>

#include <detail/Harmos_AtomicFile.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

namespace
{

using namespace Harmos;

CheckpointScalars scalarsOf(long long cycle)
{
  CheckpointScalars s;
  s.cycle = cycle;
  s.time = 1.0 / 3.0;
  s.dt = std::numeric_limits<double>::denorm_min();
  s.last_dt = 0.1;
  s.material_names = {"copper", "anvil"};
  s.bodies.resize(2);
  s.bodies[1] = {1, RigidMotion::Free, false, 2.0, 3.0, {0.1, 0.2}, 0.3, {-0.0, 5.0}, 0.7};
  s.ledger = {{"contact_loss", 1e-300}, {"external_work", 0.1}};
  s.arrays = {{"tracers", {1.0, 2.5}}, {"empty", {}}};
  s.warnings = {"cycle 3: something", "run/x: without effect"};
  s.deck = "mesh:\n  cells: [4, 3]\n" + std::string(100000, '#') + '\n';
  s.version = "0.1.0";
  return s;
}

/// Every pair of the local cells is there, with the bits that the scene gave it.
void expectScene(CheckpointState const &got, OutputScene const &want)
{
  ASSERT_EQ(got.pairs.num_pairs, want.pairs.num_pairs);
  auto equal = [](auto const &a, auto const &b)
  {
    auto const x = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), a);
    auto const y = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), b);
    return x.span() == y.span() && std::memcmp(x.data(), y.data(), x.span() * sizeof(*x.data())) == 0;
  };
  EXPECT_TRUE(equal(got.pairs.offset, want.pairs.offset));
  EXPECT_TRUE(equal(got.pairs.material, want.pairs.material));
  EXPECT_TRUE(equal(got.pairs.cell, want.pairs.cell));
  EXPECT_TRUE(equal(got.record, want.state.record));
  EXPECT_TRUE(equal(got.centroid, want.state.centroid));
  EXPECT_TRUE(equal(dofVelocities(want.pairs, want.dof_nodes, got.corner_velocity), want.state.velocity));
}

TEST(Checkpoint, writtenOnAllRanks_readsBackWithTheSameBits)
{
  auto const folder = freshFolder("checkpoint_same");
  for (auto kinematics : {Kinematics::Xfem, Kinematics::Single})
  {
    OutputScene scene = outputScene(MPI_COMM_WORLD, Partition::Blocks, kinematics);
    auto const path = writeCheckpoint(MPI_COMM_WORLD, folder, scene.mesh, scene.pairs, scene.state, scalarsOf(7));
    expectScene(readCheckpoint(MPI_COMM_WORLD, path, scene.mesh), scene);
  }
}

TEST(Checkpoint, writtenOnAllRanks_readsOnAnotherPartitionAndOnOneRank)
{
  auto const folder = freshFolder("checkpoint_other");
  OutputScene const scene = outputScene(MPI_COMM_WORLD, Partition::Blocks);
  auto const path = writeCheckpoint(MPI_COMM_WORLD, folder, scene.mesh, scene.pairs, scene.state, scalarsOf(7));
  OutputScene other = outputScene(MPI_COMM_WORLD, Partition::RoundRobin);
  expectScene(readCheckpoint(MPI_COMM_WORLD, path, other.mesh), other);
  OutputScene alone = outputScene(MPI_COMM_SELF, Partition::Blocks);
  expectScene(readCheckpoint(MPI_COMM_SELF, path, alone.mesh), alone);
}

TEST(Checkpoint, table_isTheSameForEveryNumberOfRanks)
{
  auto const folder = freshFolder("checkpoint_table");
  OutputScene const scene = outputScene(MPI_COMM_WORLD, Partition::RoundRobin);
  auto const path = writeCheckpoint(MPI_COMM_WORLD, folder, scene.mesh, scene.pairs, scene.state, scalarsOf(7));
  std::string const self = folder + "/alone_" + std::to_string(rankOf());
  std::filesystem::create_directories(self);
  OutputScene alone = outputScene(MPI_COMM_SELF, Partition::Blocks);
  auto const own = writeCheckpoint(MPI_COMM_SELF, self, alone.mesh, alone.pairs, alone.state, scalarsOf(7));
  auto const a = readCheckpoint(MPI_COMM_SELF, path, alone.mesh), b = readCheckpoint(MPI_COMM_SELF, own, alone.mesh);
  ASSERT_EQ(a.pairs.num_pairs, 10);
  ASSERT_EQ(a.pairs.num_pairs, b.pairs.num_pairs);
  for (int i = 0; i < a.pairs.num_pairs; ++i)
    for (int k = 0; k < 8; ++k)
      EXPECT_EQ(a.corner_velocity(i, k), b.corner_velocity(i, k));
}

TEST(Checkpoint, scalars_readBackExactly)
{
  auto const folder = freshFolder("checkpoint_scalars");
  OutputScene const scene = outputScene(MPI_COMM_WORLD, Partition::Blocks);
  auto const want = scalarsOf(123456);
  auto const path = writeCheckpoint(MPI_COMM_WORLD, folder, scene.mesh, scene.pairs, scene.state, want);
  EXPECT_EQ(path, folder + "/checkpoint_000123456.h5");
  auto const got = readCheckpointScalars(path);
  EXPECT_EQ(got.cycle, want.cycle);
  EXPECT_EQ(got.time, want.time);
  EXPECT_EQ(got.dt, want.dt);
  EXPECT_EQ(got.last_dt, want.last_dt);
  EXPECT_EQ(got.kinematics, want.kinematics);
  EXPECT_EQ(got.material_names, want.material_names);
  EXPECT_EQ(got.ledger, want.ledger);
  EXPECT_EQ(got.arrays, want.arrays);
  EXPECT_EQ(got.warnings, want.warnings);
  EXPECT_EQ(got.deck, want.deck);
  EXPECT_EQ(got.version, want.version);
  ASSERT_EQ(got.bodies.size(), 2u);
  EXPECT_EQ(got.bodies[1].motion, RigidMotion::Free);
  EXPECT_EQ(got.bodies[1].inertia, 3.0);
  EXPECT_EQ(got.bodies[1].centre[1], 0.2);
  EXPECT_TRUE(std::signbit(got.bodies[1].velocity[0]));
  EXPECT_EQ(got.bodies[1].angular_velocity, 0.7);
}

TEST(Checkpoint, fullDisk_leavesWhatWasThere)
{
  auto const folder = freshFolder("checkpoint_full_disk");
  OutputScene const scene = outputScene(MPI_COMM_WORLD, Partition::Blocks);
  auto const write = [&](long long cycle)
  { return writeCheckpoint(MPI_COMM_WORLD, folder, scene.mesh, scene.pairs, scene.state, scalarsOf(cycle)); };
  auto const first = write(1);
  std::string const error = errorOnSmallDisk(4096, [&] { write(2); });
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_NE(error.find("checkpoint_000000002.h5"), std::string::npos) << error;
  EXPECT_EQ(newestCheckpoint(folder), first);
  auto const files = std::filesystem::directory_iterator(folder);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  readCheckpointScalars(first);
  MPI_Barrier(MPI_COMM_WORLD);
  write(2);
  EXPECT_EQ(readCheckpointScalars(newestCheckpoint(folder)).cycle, 2);
}

TEST(Checkpoint, lagrangian_movedNodesComeBack)
{
  auto const folder = freshFolder("checkpoint_moved");
  OutputScene scene = outputScene(MPI_COMM_WORLD, Partition::Blocks);
  auto const global = scene.mesh.node_global;
  auto const position = scene.mesh.node_position;
  for (int node = 0; node < scene.mesh.num_nodes; ++node)
    position(node, 0) += 0.01 * static_cast<double>(global(node) % 3);
  auto scalars = scalarsOf(3);
  scalars.kinematics = Kinematics::Lagrangian;
  auto const path = writeCheckpoint(MPI_COMM_WORLD, folder, scene.mesh, scene.pairs, scene.state, scalars);
  Mesh mesh = sceneMesh(MPI_COMM_WORLD, Partition::RoundRobin);
  auto const still = sceneMesh(MPI_COMM_WORLD, Partition::RoundRobin);
  readCheckpoint(MPI_COMM_WORLD, path, mesh);
  for (int node = 0; node < mesh.num_nodes; ++node)
    EXPECT_EQ(mesh.node_position(node, 0),
              still.node_position(node, 0) + 0.01 * static_cast<double>(mesh.node_global(node) % 3));
  Quadrilateral const q = cellQuadrilateral(mesh, 0);
  EXPECT_NEAR(mesh.cell_area(0), area(q), 1e-15);
}

TEST(Checkpoint, series_keepsTheLastTwoAndForgetsAnAbandonedBranch)
{
  auto const folder = freshFolder("checkpoint_series");
  OutputScene const scene = outputScene(MPI_COMM_WORLD, Partition::Blocks);
  for (long long cycle : {10, 20, 30, 15})
  {
    writeCheckpoint(MPI_COMM_WORLD, folder, scene.mesh, scene.pairs, scene.state, scalarsOf(cycle));
    EXPECT_EQ(newestCheckpoint(folder), folder + "/checkpoint_0000000" + std::to_string(cycle) + ".h5");
    MPI_Barrier(MPI_COMM_WORLD);
  }
  std::size_t files = 0;
  for (auto const &entry : std::filesystem::directory_iterator(folder))
  {
    ++files;
    EXPECT_EQ(entry.path().extension(), ".h5"); // no temporary is left
  }
  EXPECT_EQ(files, 1u); // 10 went when 30 came, 20 and 30 with the restart from before them
}

/// The message of the error that reading a file gives, or an empty string.
std::string errorOf(std::string const &path)
{
  Mesh mesh = sceneMesh(MPI_COMM_SELF, Partition::Blocks);
  try
  {
    readCheckpoint(MPI_COMM_SELF, path, mesh);
  }
  catch (std::runtime_error const &error)
  {
    return error.what();
  }
  return {};
}

TEST(Checkpoint, missingShortOrDamagedFiles_areNamedInTheError)
{
  auto const folder = freshFolder("checkpoint_damaged");
  OutputScene const scene = outputScene(MPI_COMM_WORLD, Partition::Blocks);
  auto const path = writeCheckpoint(MPI_COMM_WORLD, folder, scene.mesh, scene.pairs, scene.state, scalarsOf(1));
  if (rankOf() == 0)
  {
    EXPECT_EQ(errorOf(path), "");
    EXPECT_NE(errorOf(folder + "/none.h5").find("none.h5': missing"), std::string::npos);

    std::string const whole = readWholeFile(path);
    std::string const cut = folder + "/short.h5", text = folder + "/text.h5", bad = folder + "/bad.h5";
    std::ofstream(cut, std::ios::binary) << whole.substr(0, whole.size() / 2);
    std::ofstream(text) << "no HDF5 at all\n";
    EXPECT_NE(errorOf(cut).find("short.h5"), std::string::npos);
    EXPECT_NE(errorOf(text).find("text.h5"), std::string::npos);

    // One bit of one stored double: pair (cell 0, material 0), specific volume.
    double const value = fieldValue(0, 0, InternalEnergy);
    std::string pattern(sizeof(double), '\0');
    std::memcpy(pattern.data(), &value, sizeof(double));
    std::size_t const at = whole.find(pattern);
    ASSERT_NE(at, std::string::npos);
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    std::ofstream(bad, std::ios::binary) << damaged;
    EXPECT_NE(errorOf(bad).find("/pairs/record is damaged"), std::string::npos) << errorOf(bad);
  }
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Checkpoint, ofAnotherMesh_isRefused)
{
  auto const folder = freshFolder("checkpoint_mesh");
  OutputScene const scene = outputScene(MPI_COMM_WORLD, Partition::Blocks);
  auto const path = writeCheckpoint(MPI_COMM_WORLD, folder, scene.mesh, scene.pairs, scene.state, scalarsOf(1));
  Mesh other = buildMesh(rectilinearMesh({0, 1, 2}, {0, 1}));
  EXPECT_THROW(readCheckpoint(MPI_COMM_SELF, path, other), std::runtime_error);
}

} // namespace
