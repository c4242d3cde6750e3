// SPDX-License-Identifier: BSD-3-Clause
#include "OutputScene.hpp"
#include "SmallDisk.hpp"
#include "TestFolder.hpp"

#include <Harmos_FieldOutput.hpp>
#include <Harmos_History.hpp>

#include <detail/Harmos_AtomicFile.hpp>
#include <detail/Harmos_Hdf5File.hpp>
#include <detail/Harmos_OpenEdges.hpp>

#include <gtest/gtest.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

namespace
{

using namespace Harmos;

FieldSnapshot snapshotOf(Partition partition, MPI_Comm comm = MPI_COMM_WORLD)
{
  OutputScene const s = outputScene(comm, partition);
  return takeSnapshot(s.mesh, s.pairs, s.dof_nodes, s.state, s.regions, s.materials);
}

TEST(InterfaceSegments, edgeHalfCovered_leavesTheOtherHalf)
{
  // a region below y = 0, another above that covers [0.5, 2] of its edge [0, 1]
  Region other;
  for (Vector2 const &v : {Vector2{0.5, 0.0}, Vector2{2.0, 0.0}, Vector2{2.0, 1.0}, Vector2{0.5, 1.0}})
    other.push(v);
  std::vector<EdgePart> parts;
  addCoveredParts({1.0, 0.0}, {0.0, 0.0}, other, 3, 1e-9, parts);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(parts[0].begin, 0.0, 1e-15);
  EXPECT_NEAR(parts[0].end, 0.5, 1e-15);
  EXPECT_EQ(parts[0].material, 3);
  auto const rest = uncoveredParts(parts, 1e-9);
  ASSERT_EQ(rest.size(), 1u);
  EXPECT_NEAR(rest[0].begin, 0.5, 1e-15);
  EXPECT_EQ(rest[0].end, 1.0);
}

TEST(InterfaceSegments, edgeThatRunsTheSameWay_isNotFaced)
{
  Region other;
  for (Vector2 const &v : {Vector2{0.0, 0.0}, Vector2{1.0, 0.0}, Vector2{1.0, 1.0}})
    other.push(v);
  std::vector<EdgePart> parts;
  addCoveredParts({0.0, 0.0}, {1.0, 0.0}, other, 3, 1e-9, parts);
  EXPECT_TRUE(parts.empty());
}

TEST(FieldSnapshot, interface_hasTheLengthsOfTheScene)
{
  // 0 faces 1 over 2 at x = 2.25; free: tops 2.25 + 0.5 + 1, the two sides of the gap 2 + 2; walls are no interface
  auto const s = snapshotOf(Partition::Blocks);
  double length[2] = {0.0, 0.0}; // faced, free
  for (std::size_t i = 0; i < s.interface.cell.size(); ++i)
  {
    double const *v = &s.interface.vertex[4 * i];
    length[s.interface.material_b[i] < 0] += std::hypot(v[2] - v[0], v[3] - v[1]);
  }
  MPI_Allreduce(MPI_IN_PLACE, length, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_NEAR(length[0], 2.0, 1e-14);
  EXPECT_NEAR(length[1], 7.75, 1e-14);
}

TEST(FieldSnapshot, cellMeans_areVolumeWeighted)
{
  auto const s = snapshotOf(Partition::Blocks, MPI_COMM_SELF);
  ASSERT_EQ(s.cells.global.size(), 12u);
  ASSERT_EQ(s.pairs.cell.size(), 10u);
  EXPECT_DOUBLE_EQ(s.cells.volume_fraction[2], 0.75);
  EXPECT_DOUBLE_EQ(s.cells.density[2], (fieldValue(2, 0, Mass) + fieldValue(2, 1, Mass)) / 0.75);
  // both at 1000 kg/m3 against 900: p = c0^2 100, c0 = 2000 and 4000
  EXPECT_NEAR(s.cells.pressure[2], (0.25 * 4e8 + 0.5 * 16e8) / 0.75, 1.0);
  EXPECT_EQ(s.cells.material[2], 1);
  EXPECT_EQ(s.cells.material[11], -1);
  EXPECT_EQ(s.cells.density[11], 0.0);
}

TEST(FieldSnapshot, regionsOfPairs_fillTheirVolumeFractions)
{
  auto const s = snapshotOf(Partition::RoundRobin);
  for (std::size_t i = 0; i < s.pairs.cell.size(); ++i)
  {
    Region r;
    for (long long v = s.pairs.offset[i]; v < s.pairs.offset[i + 1]; ++v)
      r.push({s.pairs.vertex[2 * v], s.pairs.vertex[2 * v + 1]});
    EXPECT_NEAR(area(r), s.pairs.volume_fraction[i], 1e-14);
  }
}

TEST(FieldOutput, file_isTheSameForEveryPartition)
{
  std::string const folder = freshFolder("field_order");
  FieldOutput output(MPI_COMM_WORLD, folder, {"copper", "anvil"});
  output.write(0, 0.0, snapshotOf(Partition::RoundRobin));
  MPI_Barrier(MPI_COMM_WORLD);
  auto const want = snapshotOf(Partition::Blocks, MPI_COMM_SELF);
  auto const file = Hdf5File::open(folder + "/fields_000000.h5");
  EXPECT_EQ(file.rows("/pairs/pressure"), 10);
  EXPECT_EQ(file.read<long long>("/pairs/cell", 1, 0, 10), want.pairs.cell);
  EXPECT_EQ(file.read<int>("/pairs/material", 1, 0, 10), want.pairs.material);
  EXPECT_EQ(file.read<double>("/pairs/von_mises", 1, 0, 10), want.pairs.von_mises);
  EXPECT_EQ(file.read<double>("/pairs/velocity", 3, 0, 10), want.pairs.velocity);
  EXPECT_EQ(file.read<double>("/pairs/vertex", 2, 0, 40), want.pairs.vertex);
  EXPECT_EQ(file.read<double>("/nodes/velocity", 3, 0, 20), want.nodes.velocity);
  EXPECT_EQ(file.read<double>("/nodes/position", 2, 0, 20), want.nodes.position);
  EXPECT_EQ(file.read<long long>("/cells/connectivity", 4, 0, 12), want.cells.node);
  EXPECT_EQ(file.read<double>("/cells/density", 1, 0, 12), want.cells.density);
  auto const n = static_cast<long long>(want.interface.cell.size());
  EXPECT_EQ(file.read<double>("/interface/vertex", 2, 0, 2 * n), want.interface.vertex);
  auto const topology = file.read<long long>("/pairs/topology", 1, 0, 60);
  for (int i = 0; i < 10; ++i) // quadrilaterals all
    for (int k = 0; k < 6; ++k)
      EXPECT_EQ(topology[6 * i + k], k == 0 ? 3 : k == 1 ? 4 : 4 * i + k - 2);
  EXPECT_EQ(file.readText("/materials"), "copper\nanvil\n");
}

TEST(FieldOutput, restart_listsTheOldOutputsAndForgetsLaterOnes)
{
  std::string const folder = freshFolder("field_restart");
  auto const snapshot = snapshotOf(Partition::Blocks);
  {
    FieldOutput output(MPI_COMM_WORLD, folder, {"copper", "anvil"}, {true});
    for (int i = 0; i < 4; ++i)
      output.write(10 * i, 0.1 * i, snapshot);
  }
  FieldOutput output(MPI_COMM_WORLD, folder, {"copper", "anvil"}, {true}, 15);
  output.write(17, 0.17, snapshot);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rankOf() == 0)
  {
    EXPECT_TRUE(std::filesystem::exists(folder + "/fields_000002.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder + "/fields_000003.h5"));
    ASSERT_EQ(output.frames().size(), 3u);
    EXPECT_EQ(output.frames()[1].cycle, 10);
    EXPECT_EQ(output.frames()[2].cycle, 17);
    std::string const xdmf = readWholeFile(folder + "/fields.xdmf");
    EXPECT_EQ(xdmf, xdmfText(output.frames()));
    EXPECT_NE(xdmf.find("<Time Value=\"0.17000000000000001\"/>"), std::string::npos);
    EXPECT_EQ(xdmf.find("fields_000003"), std::string::npos);
    EXPECT_NE(readWholeFile(folder + "/fields.pvd").find("timestep=\"0.17000000000000001\""), std::string::npos);
  }
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Hdf5File, onAFullDisk_saysWhyAndLeavesNothingToTheEndOfTheProgram)
{
  if (rankOf() == 0)
  {
    std::string const path = folderOf("full") + ".h5";
    auto const write = [&]
    {
      Hdf5File file = Hdf5File::create(MPI_COMM_SELF, path);
      file.write("/value", std::vector<double>(10000, 1.0), 1, 0, 10000);
      file.close();
    };
    std::string const error = errorOnSmallDisk(4096, write);
    EXPECT_NE(error.find(path), std::string::npos) << error;
    EXPECT_NE(error.find(std::strerror(EFBIG)), std::string::npos) << error;
    // The library's exit handler would write an open file once more.
    EXPECT_EQ(H5Fget_obj_count(static_cast<hid_t>(H5F_OBJ_ALL), H5F_OBJ_FILE), 0);
    write();
    EXPECT_EQ(Hdf5File::open(path).read<double>("/value", 1, 9999, 1), std::vector<double>{1.0});
  }
}

// Leaves the folder that the test of the plot script draws from.
TEST(FieldOutput, runFolder_holdsFieldsAndHistory)
{
  std::string const folder = freshFolder("field_run");
  {
    FieldOutput output(MPI_COMM_WORLD, folder, {"copper", "anvil"}, {true});
    History history(folder + "/history.csv", {"copper", "anvil"}, rankOf() == 0);
    auto const snapshot = snapshotOf(Partition::Blocks);
    for (int i = 0; i < 3; ++i)
    {
      output.write(i, 1e-6 * i, snapshot);
      HistoryRow row;
      row.cycle = i;
      row.time = 1e-6 * i;
      row.kinetic_energy = 3.0 - i;
      row.material.resize(2);
      history.write(row);
    }
  }
  MPI_Barrier(MPI_COMM_WORLD);
  for (char const *name : {"fields_000002.h5", "fields.xdmf", "fields.pvd", "history.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder + '/' + name)) << name;
}

} // namespace
