// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_NodeEnds.hpp>
#include <Harmos_OnHost.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <stdexcept>

namespace
{

using namespace Harmos;

std::vector<double> uniform(int cells)
{
  return gradedCoordinates(0.0, cells, cells, 1.0);
}

/// An unstructured patch: three quadrilaterals around one node (valence 3), whose outer edges are free.
//      5
//     / \.
//   4     6
//   | \1/ |
//   | 0 0 |     nodes: 0 in the middle, 1..6 around it
//   3  |  1
//     \2/
HostMesh threeAroundANode()
{
  HostMesh mesh;
  mesh.node = {{0.0, 0.0}, {1.0, -0.5}, {0.0, -1.0}, {-1.0, -0.5}, {-1.0, 0.5}, {0.0, 1.0}, {1.0, 0.5}};
  mesh.cell = {{0, 6, 5, 4}, {0, 4, 3, 2}, {0, 2, 1, 6}};
  mesh.face_boundary.assign(3, {-1, -1, -1, -1});
  return mesh;
}

TEST(BuildMesh, serial_everythingIsOwnedAndNumberedAsTheWhole)
{
  HostMesh const whole = rectilinearMesh(uniform(5), uniform(4));
  Mesh const mesh = buildMesh(whole);
  EXPECT_NO_THROW(checkMesh(mesh));
  EXPECT_EQ(mesh.num_cells, 20);
  EXPECT_EQ(mesh.num_owned_cells, 20);
  EXPECT_EQ(mesh.num_nodes, 30);
  auto const global = onHost(mesh.cell_global);
  auto const area = onHost(mesh.cell_area);
  auto const around = onHost(mesh.cell_neighbour.offset);
  auto const owned = onHost(mesh.node_owned);
  for (int c = 0; c < 20; ++c)
  {
    EXPECT_EQ(global(c), c);
    EXPECT_DOUBLE_EQ(area(c), 1.0);
  }
  EXPECT_EQ(around(1) - around(0), 3);
  EXPECT_EQ(around(7) - around(6), 8);
  for (int n = 0; n < 30; ++n)
    EXPECT_EQ(owned(n), 1);
}

TEST(BuildMesh, threeCellsAroundANode_connectivityIsComplete)
{
  Mesh const mesh = buildMesh(threeAroundANode());
  EXPECT_NO_THROW(checkMesh(mesh));
  auto const offset = onHost(mesh.node_cell.offset);
  auto const item = onHost(mesh.node_cell.item);
  EXPECT_EQ(offset(1), 3);
  EXPECT_EQ(item(0), 0);
  EXPECT_EQ(item(1), 4);
  EXPECT_EQ(item(2), 8);
  auto const face = onHost(mesh.face_neighbour);
  EXPECT_EQ(face(0, 0), 4 * 2 + 3);
  EXPECT_EQ(face(0, 3), 4 * 1 + 0);
  EXPECT_EQ(face(0, 1), -1);
}

TEST(NodeEnds, nodesBelowAnEnd_haveNoCellBeyondThePiece)
{
  for (bool const mixed : {false, true})
  {
    HostMesh whole = rectilinearMesh(uniform(9), uniform(7));
    if (mixed)
    {
      std::mt19937 random(3);
      std::shuffle(whole.cell.begin(), whole.cell.end(), random);
      whole.face_boundary.assign(whole.cell.size(), {-1, -1, -1, -1});
    }
    Mesh const mesh = buildMesh(whole);
    auto const offset = onHost(mesh.node_cell.offset);
    auto const item = onHost(mesh.node_cell.item);
    for (int const piece : {1, 10, 63, 100})
    {
      auto const ends = nodeEnds(mesh, piece);
      ASSERT_EQ(static_cast<int>(ends.size()), (63 + piece - 1) / piece);
      EXPECT_EQ(ends.back(), mesh.num_nodes);
      auto const lastPiece = [&](int node) { return item(offset(node + 1) - 1) / 4 / piece; };
      int node = 0;
      for (int t = 0; t < static_cast<int>(ends.size()); ++t)
      {
        for (; node < ends[t]; ++node)
          EXPECT_LE(lastPiece(node), t);
        if (ends[t] < mesh.num_nodes)
        {
          EXPECT_GT(lastPiece(ends[t]), t); // no later end would do
        }
      }
      EXPECT_EQ(node, mesh.num_nodes);
    }
  }
}

/// Owners in a chequer of blocks, so that owned and halo cells interleave.
std::vector<int> chequer(int nx, int ny, int ranks)
{
  std::vector<int> owner;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      owner.push_back((i / 4 + 2 * (j / 3)) % ranks);
  return owner;
}

TEST(BuildLocalMesh, uniformGrid_depthIsTheLeastChebyshevDistanceToAnOwnedCell)
{
  int const nx = 13, ny = 11;
  HostMesh const whole = rectilinearMesh(uniform(nx), uniform(ny));
  std::vector<int> const owner = chequer(nx, ny, 5);
  for (int rank = 0; rank < 5; ++rank)
    for (int const halo : {0, 1, 3})
    {
      Mesh const mesh = buildLocalMesh(whole, owner, rank, halo);
      EXPECT_NO_THROW(checkMesh(mesh));
      auto const global = onHost(mesh.cell_global);
      auto const depth = onHost(mesh.cell_depth);
      std::vector<int> local(owner.size(), -1);
      for (int c = 0; c < mesh.num_cells; ++c)
        local[global(c)] = c;
      for (int g = 0; g < nx * ny; ++g)
      {
        int least = nx + ny;
        for (int other = 0; other < nx * ny; ++other)
          if (owner[other] == rank)
            least = std::min(least, std::max(std::abs(g % nx - other % nx), std::abs(g / nx - other / nx)));
        ASSERT_EQ(local[g] >= 0, least <= halo) << "cell " << g << " rank " << rank;
        if (local[g] < 0)
          continue;
        EXPECT_EQ(depth(local[g]), least);
      }
    }
}

TEST(BuildLocalMesh, anyRank_rowsOfInnerCellsAndNodesAreTheSerialRowsInTheSameOrder)
{
  int const nx = 13, ny = 11;
  HostMesh const whole = rectilinearMesh(uniform(nx), uniform(ny));
  std::vector<int> const owner = chequer(nx, ny, 5);
  Mesh const serial = buildMesh(whole);
  auto const serial_around = onHost(serial.cell_neighbour.item);
  auto const serial_around_offset = onHost(serial.cell_neighbour.offset);
  auto const serial_item = onHost(serial.node_cell.item);
  auto const serial_offset = onHost(serial.node_cell.offset);
  auto const serial_face = onHost(serial.face_neighbour);
  auto const serial_boundary = onHost(serial.face_boundary);
  std::vector<int> times_owned(whole.node.size(), 0);
  for (int rank = 0; rank < 5; ++rank)
  {
    Mesh const mesh = buildLocalMesh(whole, owner, rank, 2);
    auto const cell_global = onHost(mesh.cell_global);
    auto const node_global = onHost(mesh.node_global);
    auto const depth = onHost(mesh.cell_depth);
    auto const node_depth = onHost(mesh.node_depth);
    auto const node_owned = onHost(mesh.node_owned);
    auto const around = onHost(mesh.cell_neighbour.item);
    auto const around_offset = onHost(mesh.cell_neighbour.offset);
    auto const item = onHost(mesh.node_cell.item);
    auto const offset = onHost(mesh.node_cell.offset);
    auto const face = onHost(mesh.face_neighbour);
    auto const boundary = onHost(mesh.face_boundary);
    for (int c = 0; c < mesh.num_cells; ++c)
    {
      int const g = static_cast<int>(cell_global(c));
      for (int k = 0; k < 4; ++k)
        EXPECT_EQ(boundary(c, k), serial_boundary(g, k));
      if (depth(c) == 2)
        continue;
      ASSERT_EQ(around_offset(c + 1) - around_offset(c), serial_around_offset(g + 1) - serial_around_offset(g));
      for (int i = 0; i < around_offset(c + 1) - around_offset(c); ++i)
        EXPECT_EQ(cell_global(around(around_offset(c) + i)), serial_around(serial_around_offset(g) + i));
      for (int k = 0; k < 4; ++k)
      {
        int const other = face(c, k);
        EXPECT_EQ(other < 0 ? -1 : 4 * cell_global(other / 4) + other % 4, serial_face(g, k));
      }
    }
    for (int n = 0; n < mesh.num_nodes; ++n)
    {
      int const g = static_cast<int>(node_global(n));
      times_owned[g] += node_owned(n);
      EXPECT_TRUE(node_owned(n) == 0 || node_depth(n) == 0);
      if (node_depth(n) == 2)
        continue;
      ASSERT_EQ(offset(n + 1) - offset(n), serial_offset(g + 1) - serial_offset(g));
      for (int i = 0; i < offset(n + 1) - offset(n); ++i)
      {
        int const here = item(offset(n) + i);
        EXPECT_EQ(4 * cell_global(here / 4) + here % 4, serial_item(serial_offset(g) + i));
      }
    }
  }
  for (int const times : times_owned)
    EXPECT_EQ(times, 1);
}

TEST(BuildLocalMesh, rankWithoutCells_isEmpty)
{
  HostMesh const whole = rectilinearMesh(uniform(3), uniform(3));
  Mesh const mesh = buildLocalMesh(whole, std::vector<int>(9, 0), 1, 2);
  EXPECT_EQ(mesh.num_cells, 0);
  EXPECT_EQ(mesh.num_nodes, 0);
  EXPECT_NO_THROW(checkMesh(mesh));
}

TEST(BuildLocalMesh, wrongOwners_areRefused)
{
  HostMesh const whole = rectilinearMesh(uniform(3), uniform(3));
  EXPECT_THROW(buildLocalMesh(whole, std::vector<int>(8, 0), 0, 2), std::runtime_error);
  EXPECT_THROW(buildLocalMesh(whole, std::vector<int>(9, 0), 0, -1), std::runtime_error);
  std::vector<int> owner(9, 0);
  owner[4] = -1;
  EXPECT_THROW(buildLocalMesh(whole, owner, 0, 2), std::runtime_error);
}

TEST(UpdateGeometry, nodesMovedByALinearMap_areasScaleByItsDeterminant)
{
  Mesh mesh = buildMesh(threeAroundANode());
  auto const before = onHost(mesh.cell_area);
  std::vector<double> const old(before.data(), before.data() + 3);
  auto position = Kokkos::create_mirror_view(mesh.node_position);
  Kokkos::deep_copy(position, mesh.node_position);
  for (int n = 0; n < mesh.num_nodes; ++n)
  {
    double const x = position(n, 0), y = position(n, 1);
    position(n, 0) = 2.0 * x + 0.5 * y;
    position(n, 1) = 0.25 * x + y;
  }
  Kokkos::deep_copy(mesh.node_position, position);
  EXPECT_THROW(checkMesh(mesh), std::runtime_error);
  updateGeometry(mesh);
  EXPECT_NO_THROW(checkMesh(mesh));
  auto const after = onHost(mesh.cell_area);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(after(c), 1.875 * old[c], 1e-14);
}

TEST(SetGeometry, unitSquareAboutTheAxis_hasTheVolumeOfACylinderPerRadian)
{
  Mesh mesh = buildMesh(rectilinearMesh(uniform(4), uniform(4)));
  EXPECT_EQ(mesh.cell_volume.data(), mesh.cell_area.data());
  setGeometry(mesh, Geometry::Axisymmetric);
  EXPECT_NO_THROW(checkMesh(mesh));
  auto const x = onHost(mesh.node_position);
  double const width = x(mesh.num_nodes - 1, 0), height = x(mesh.num_nodes - 1, 1);
  auto const volume = onHost(mesh.cell_volume);
  double sum = 0.0;
  for (int cell = 0; cell < mesh.num_cells; ++cell)
    sum += volume(cell);
  EXPECT_NEAR(sum, 0.5 * width * width * height, 1e-13 * sum);
  setGeometry(mesh, Geometry::Planar);
  EXPECT_EQ(mesh.cell_volume.data(), mesh.cell_area.data());
}

TEST(SetGeometry, nodesLeftOfTheAxis_areRefused)
{
  Mesh mesh = buildMesh(rectilinearMesh({-1e-9, 1.0, 2.0}, {0.0, 1.0}));
  EXPECT_THROW(setGeometry(mesh, Geometry::Axisymmetric), std::runtime_error);
}

TEST(CountInvertedCells, middleNodePulledAcrossAnEdge_countsTheCellsThatFold)
{
  Mesh mesh = buildMesh(rectilinearMesh(uniform(4), uniform(4)));
  EXPECT_EQ(countInvertedCells(mesh), 0);
  auto position = Kokkos::create_mirror_view(mesh.node_position);
  Kokkos::deep_copy(position, mesh.node_position);
  position(6, 0) += 1.2; // folds cell 1 and cell 5, whose left lower and left upper corner it is
  Kokkos::deep_copy(mesh.node_position, position);
  EXPECT_EQ(countInvertedCells(mesh), 2);
}

} // namespace
