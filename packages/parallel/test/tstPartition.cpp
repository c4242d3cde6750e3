// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Partition.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace
{

using namespace Harmos;

HostMesh grid(int nx, int ny)
{
  return rectilinearMesh(gradedCoordinates(0.0, 1.0, nx, 1.0), gradedCoordinates(0.0, 1.0, ny, 1.0));
}

/// Heaviest part over the mean.
double imbalance(std::vector<int> const &owner, int parts, std::vector<int> const &weight)
{
  std::vector<double> load(parts, 0.0);
  double total = 0.0;
  for (std::size_t c = 0; c < owner.size(); ++c)
  {
    double const w = weight.empty() ? 1.0 : weight[c];
    load.at(owner[c]) += w;
    total += w;
  }
  return *std::max_element(load.begin(), load.end()) * parts / total;
}

int facesCut(HostMesh const &mesh, std::vector<int> const &owner)
{
  HostRows const around = cellsAroundNodes(mesh);
  int cut = 0;
  for (std::size_t c = 0; c < owner.size(); ++c)
    for (int k = 0; k < 4; ++k)
    {
      int const opposite = oppositeFace(mesh, around, static_cast<int>(c), k);
      cut += opposite >= 0 && owner[opposite / 4] > owner[c] ? 1 : 0;
    }
  return cut;
}

TEST(PartitionCells, gridOnTwoToEightRanks_balancesWithin5PercentWithShortCuts)
{
  HostMesh const mesh = grid(60, 50);
  for (int const parts : {2, 3, 4, 8})
  {
    std::vector<int> const owner = partitionCells(mesh, parts);
    EXPECT_LT(imbalance(owner, parts, {}), 1.05) << parts;
    EXPECT_LT(facesCut(mesh, owner), 60 * parts) << parts;
  }
}

TEST(PartitionCells, manyCells_areCutNearlyStraightIntoEqualParts)
{
  // so many that groups of them are partitioned
  HostMesh const mesh = grid(300, 200);
  int const shortest[] = {200, 400, 500};
  for (int const i : {0, 1, 2})
  {
    int const parts = i + 2;
    std::vector<int> const owner = partitionCells(mesh, parts);
    EXPECT_LT(imbalance(owner, parts, {}), 1.005) << parts;
    EXPECT_LT(facesCut(mesh, owner), 1.15 * shortest[i]) << parts;
  }
}

/// The same cells numbered column by column.
HostMesh numberedByColumns(HostMesh mesh, int nx, int ny)
{
  HostMesh const rows = mesh;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
    {
      mesh.cell[i * ny + j] = rows.cell[j * nx + i];
      mesh.face_boundary[i * ny + j] = rows.face_boundary[j * nx + i];
    }
  return mesh;
}

/// Runs of consecutive cells that a rank owns, all ranks together.
int runs(std::vector<int> const &owner)
{
  int count = 1;
  for (std::size_t c = 1; c < owner.size(); ++c)
    count += owner[c] != owner[c - 1] ? 1 : 0;
  return count;
}

TEST(PartitionCells, square_isCutBetweenRunsOfConsecutiveCells)
{
  // in groups or not; a cut across the rows would leave two runs in each of them
  for (int const n : {80, 512})
  {
    HostMesh const by_rows = grid(n, n);
    EXPECT_LT(runs(partitionCells(by_rows, 2)), n / 4) << n;
    EXPECT_LT(runs(partitionCells(numberedByColumns(by_rows, n, n), 2)), n / 4) << n;
  }
}

TEST(PartitionCells, longRows_areCutWhereTheCutIsShort)
{
  HostMesh const mesh = grid(400, 100);
  EXPECT_LT(facesCut(mesh, partitionCells(mesh, 2)), 115);
  EXPECT_LT(facesCut(mesh, partitionCells(mesh, 4)), 345);
}

TEST(PartitionCells, heavyLeftThird_weightsBalanceWithin5Percent)
{
  HostMesh const mesh = grid(60, 50);
  std::vector<int> weight(mesh.cell.size(), 1);
  for (std::size_t c = 0; c < weight.size(); ++c)
    weight[c] = c % 60 < 20 ? 7 : 1;
  std::vector<int> const owner = partitionCells(mesh, 4, weight);
  EXPECT_LT(imbalance(owner, 4, weight), 1.05);
  EXPECT_GT(imbalance(owner, 4, {}), 1.2);
}

TEST(PartitionCells, calledTwice_givesTheSame)
{
  HostMesh const mesh = grid(40, 40);
  std::vector<int> const first = partitionCells(mesh, 4);
  std::rand();
  EXPECT_EQ(partitionCells(mesh, 4), first);
}

TEST(PartitionCells, disjointBlocks_areShared)
{
  MappedBlock const a{{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}}, {20, 20}};
  MappedBlock const b{{{{2.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}, {2.0, 1.0}}}, {20, 20}};
  BlockMesh const blocks = mappedBlocks({a, b});
  EXPECT_LT(imbalance(partitionCells(blocks.mesh, 4), 4, {}), 1.05);
}

TEST(PartitionCells, onePart_ownsEverything)
{
  std::vector<int> const owner = partitionCells(grid(3, 3), 1);
  EXPECT_EQ(std::count(owner.begin(), owner.end(), 0), 9);
}

TEST(PartitionCells, wrongArguments_areRefused)
{
  EXPECT_THROW(partitionCells(grid(3, 3), 0), std::runtime_error);
  EXPECT_THROW(partitionCells(grid(3, 3), 2, {1, 2}), std::runtime_error);
}

} // namespace
