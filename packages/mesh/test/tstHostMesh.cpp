// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_HostMesh.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace
{

using namespace Harmos;

std::string messageOf(HostMesh const &mesh)
{
  try
  {
    checkHostMesh(mesh);
  }
  catch (std::runtime_error const &error)
  {
    return error.what();
  }
  return "";
}

TEST(GradedCoordinates, ratioTen_lastOverFirstIsTenAndSizesAreGeometric)
{
  std::vector<double> const x = gradedCoordinates(-1.0, 3.0, 8, 10.0);
  ASSERT_EQ(x.size(), 9u);
  EXPECT_EQ(x.front(), -1.0);
  EXPECT_EQ(x.back(), 3.0);
  EXPECT_NEAR((x[8] - x[7]) / (x[1] - x[0]), 10.0, 1e-12);
  for (int i = 1; i < 7; ++i)
    EXPECT_NEAR((x[i + 1] - x[i]) / (x[i] - x[i - 1]), std::pow(10.0, 1.0 / 7.0), 1e-12);
}

TEST(GradedCoordinates, ratioOne_everyCoordinateIsTheRoundedExactOne)
{
  std::vector<double> const x = gradedCoordinates(0.0, 1.0, 7, 1.0);
  for (int i = 0; i <= 7; ++i)
    EXPECT_EQ(x[i], i / 7.0);
}

TEST(GradedCoordinates, wrongArguments_areRefused)
{
  EXPECT_THROW(gradedCoordinates(0.0, 0.0, 4, 1.0), std::runtime_error);
  EXPECT_THROW(gradedCoordinates(0.0, 1.0, 0, 1.0), std::runtime_error);
  EXPECT_THROW(gradedCoordinates(0.0, 1.0, 4, -2.0), std::runtime_error);
}

//  9--10--11     boundaries: 0 left, 1 right,
//  | 4 | 5 |     2 bottom, 3 top
//  6---7---8
//  | 2 | 3 |
//  3---4---5
//  | 0 | 1 |
//  0---1---2
TEST(RectilinearMesh, twoByThree_numberedRowByRowWithFourBoundaries)
{
  HostMesh const mesh = rectilinearMesh({0.0, 1.0, 3.0}, {0.0, 1.0, 2.0, 4.0});
  EXPECT_NO_THROW(checkHostMesh(mesh));
  ASSERT_EQ(mesh.node.size(), 12u);
  ASSERT_EQ(mesh.cell.size(), 6u);
  EXPECT_EQ(mesh.cell[3], (std::array<int, 4>{4, 5, 8, 7}));
  EXPECT_EQ(mesh.node[11], (std::array<double, 2>{3.0, 4.0}));
  EXPECT_EQ(mesh.face_boundary[0], (std::array<int, 4>{2, -1, -1, 0}));
  EXPECT_EQ(mesh.face_boundary[3], (std::array<int, 4>{-1, 1, -1, -1}));
  EXPECT_EQ(mesh.face_boundary[5], (std::array<int, 4>{-1, 1, 3, -1}));
  HostRows const around = cellsAroundNodes(mesh);
  EXPECT_EQ(oppositeFace(mesh, around, 0, 1), 4 * 1 + 3);
  EXPECT_EQ(oppositeFace(mesh, around, 0, 2), 4 * 2 + 0);
  EXPECT_EQ(oppositeFace(mesh, around, 0, 0), -1);
}

TEST(RectilinearMesh, coordinatesThatDoNotAscend_areRefused)
{
  EXPECT_THROW(rectilinearMesh({0.0, 1.0, 1.0}, {0.0, 1.0}), std::runtime_error);
  EXPECT_THROW(rectilinearMesh({0.0}, {0.0, 1.0}), std::runtime_error);
}

TEST(RectilinearMesh, coordinatesThatDoNotAscend_areNamed)
{
  try
  {
    rectilinearMesh({2.0, 1.0}, {0.0, 1.0});
    FAIL();
  }
  catch (std::runtime_error const &error)
  {
    EXPECT_STREQ(error.what(), "rectilinear mesh: x[1] = 1.000000 is not above 2.000000");
  }
}

TEST(JitteredMesh, gradedLinesAndAnySeed_cellsAreConvexAndTheOutlineStays)
{
  std::vector<double> const x = gradedCoordinates(0.0, 1.0, 20, 7.0), y = gradedCoordinates(-1.0, 1.0, 15, 0.2);
  HostMesh const straight = rectilinearMesh(x, y);
  for (unsigned seed = 1; seed < 20; ++seed)
  {
    HostMesh const mesh = jitteredMesh(x, y, 0.2499, seed);
    EXPECT_EQ(messageOf(mesh), "");
    double most = 0.0;
    for (std::size_t n = 0; n < mesh.node.size(); ++n)
    {
      std::size_t const i = n % x.size(), j = n / x.size();
      bool const inner = i > 0 && i + 1 < x.size() && j > 0 && j + 1 < y.size();
      EXPECT_TRUE(inner || mesh.node[n] == straight.node[n]);
      if (inner)
        most = std::max(most, std::fabs(mesh.node[n][0] - x[i]) / std::min(x[i] - x[i - 1], x[i + 1] - x[i]));
    }
    EXPECT_GT(most, 0.24);
    EXPECT_LE(most, 0.2499 * (1.0 + 1e-12));
    EXPECT_EQ(mesh.cell, straight.cell);
    EXPECT_NE(mesh.node, jitteredMesh(x, y, 0.2499, seed + 1).node);
  }
  EXPECT_EQ(jitteredMesh(x, y, 0.0, 1).node, straight.node);
  EXPECT_THROW(jitteredMesh(x, y, 0.25, 1), std::runtime_error);
}

TEST(CheckHostMesh, damagedMeshes_nameTheCell)
{
  HostMesh const good = rectilinearMesh({0.0, 1.0, 2.0}, {0.0, 1.0, 2.0});
  EXPECT_EQ(messageOf(good), "");
  HostMesh mesh = good;
  mesh.node[0] = {1.5, 1.5};
  EXPECT_NE(messageOf(mesh).find("cell 0: corner"), std::string::npos) << messageOf(mesh);
  mesh = good;
  std::swap(mesh.cell[3][1], mesh.cell[3][3]);
  EXPECT_NE(messageOf(mesh).find("cell 3: corner"), std::string::npos) << messageOf(mesh);
  mesh = good;
  mesh.cell[2][0] = 9;
  EXPECT_NE(messageOf(mesh).find("cell 2: node 9"), std::string::npos) << messageOf(mesh);
  mesh = good;
  mesh.face_boundary[1][2] = 0;
  EXPECT_NE(messageOf(mesh).find("cell 1: inner face 2"), std::string::npos) << messageOf(mesh);
  mesh = good;
  mesh.face_boundary[1][1] = -5;
  EXPECT_NE(messageOf(mesh).find("cell 1: face 1 lies on boundary -5"), std::string::npos) << messageOf(mesh);
  mesh = good;
  mesh.cell.push_back(mesh.cell[0]);
  mesh.face_boundary.push_back(mesh.face_boundary[0]);
  EXPECT_NE(messageOf(mesh).find("shared wrongly"), std::string::npos) << messageOf(mesh);
  mesh = good;
  mesh.node.push_back({5.0, 5.0});
  EXPECT_NE(messageOf(mesh).find("node 9"), std::string::npos) << messageOf(mesh);
}

double totalArea(HostMesh const &mesh)
{
  double sum = 0.0;
  for (auto const &c : mesh.cell)
    for (int k = 0; k < 4; ++k)
    {
      auto const &a = mesh.node[c[k]];
      auto const &b = mesh.node[c[(k + 1) % 4]];
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
  return sum;
}

TEST(MappedBlocks, twoBlocksThatTouch_shareNoNodesAndFillTheirCorners)
{
  MappedBlock const trapezoid{{{{0.0, 0.0}, {4.0, 0.0}, {3.0, 2.0}, {1.0, 2.0}}}, {5, 3}};
  MappedBlock const above{{{{1.0, 2.0}, {3.0, 2.0}, {3.0, 3.0}, {1.0, 3.0}}}, {2, 2}};
  BlockMesh const blocks = mappedBlocks({trapezoid, above});
  ASSERT_EQ(blocks.mesh.cell.size(), 19u);
  ASSERT_EQ(blocks.mesh.node.size(), 24u + 9u);
  EXPECT_EQ(blocks.cell_block[14], 0);
  EXPECT_EQ(blocks.cell_block[15], 1);
  EXPECT_NEAR(totalArea(blocks.mesh), 6.0 + 2.0, 1e-13);
  EXPECT_EQ(blocks.mesh.face_boundary[0], (std::array<int, 4>{2, -1, -1, 0}));
  EXPECT_EQ(blocks.mesh.face_boundary[18], (std::array<int, 4>{-1, 5, 7, -1}));
  HostRows const around = cellsAroundNodes(blocks.mesh);
  EXPECT_EQ(oppositeFace(blocks.mesh, around, 12, 2), -1);
}

TEST(MappedBlocks, ringSectorWithArcs_hasItsNodesOnCirclesAndRays)
{
  // a quarter of a ring, 1 < r < 2: corners (1,0), (2,0), (0,2), (0,1)
  MappedBlock ring{{{{1.0, 0.0}, {2.0, 0.0}, {0.0, 2.0}, {0.0, 1.0}}}, {4, 30}};
  ring.arc_radius = {0.0, 2.0, 0.0, -1.0};
  BlockMesh const blocks = mappedBlocks({ring});
  for (int j = 0; j <= 30; ++j)
    for (int i = 0; i <= 4; ++i)
    {
      auto const &x = blocks.mesh.node[5 * j + i];
      double const angle = 0.5 * 3.14159265358979323846 * j / 30;
      EXPECT_NEAR(x[0], (1.0 + 0.25 * i) * std::cos(angle), 1e-14);
      EXPECT_NEAR(x[1], (1.0 + 0.25 * i) * std::sin(angle), 1e-14);
    }
  // chords cut the arcs short: sin(2 a) / (2 a) of the area, 2 a = pi / 60
  double const step = 3.14159265358979323846 / 60.0;
  EXPECT_NEAR(totalArea(blocks.mesh), 0.75 * 3.14159265358979323846 * std::sin(step) / step, 1e-13);
}

TEST(MappedBlocks, gradedBlock_hasCellsInGeometricProgression)
{
  MappedBlock block{{{{0.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}, {0.0, 1.0}}}, {2, 1}};
  block.grading = {2.0, 1.0};
  EXPECT_EQ(mappedBlocks({block}).mesh.node[1], (std::array<double, 2>{1.0, 0.0}));
}

TEST(MappedBlocks, arcTooTightForItsSide_isRefused)
{
  MappedBlock block{{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}}, {2, 2}};
  block.arc_radius[2] = 0.49;
  EXPECT_THROW(mappedBlocks({block}), std::runtime_error);
  // a half circle inwards reaches through the lower side
  block.corner[2][1] = block.corner[3][1] = 0.4;
  block.arc_radius[2] = -0.5;
  EXPECT_THROW(mappedBlocks({block}), std::runtime_error);
}

TEST(MappedBlocks, overlappingConcaveOrEmptyBlocks_areRefused)
{
  MappedBlock const unit{{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}}, {2, 2}};
  MappedBlock shifted = unit;
  for (auto &corner : shifted.corner)
    corner[0] += 0.5;
  EXPECT_THROW(mappedBlocks({unit, shifted}), std::runtime_error);
  MappedBlock concave = unit;
  concave.corner[2] = {0.2, 0.2};
  EXPECT_THROW(mappedBlocks({concave}), std::runtime_error);
  MappedBlock empty = unit;
  empty.cells = {0, 2};
  EXPECT_THROW(mappedBlocks({empty}), std::runtime_error);
  EXPECT_THROW(mappedBlocks({}), std::runtime_error);
}

} // namespace

// Two squares of four cells each; the second turned, at a distance along its diagonal.
TEST(HostMesh, overlappingCells_areThoseThatLieInEachOtherByMoreThanThePart)
{
  for (double const depth : {-0.3, 0.04, 0.06, 0.3})
  {
    HostMesh mesh;
    std::vector<int> body;
    for (int b = 0; b < 2; ++b)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          mesh.node.push_back(b == 0 ? std::array<double, 2>{0.5 * i, 0.5 * j}
                                     : std::array<double, 2>{1.0 - depth + (i + j) * std::sqrt(0.125),
                                                             0.25 + (j - i) * std::sqrt(0.125)});
    for (int b = 0; b < 2; ++b)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
        {
          int const first = 9 * b + 3 * j + i;
          mesh.cell.push_back({first, first + 1, first + 4, first + 3});
          body.push_back(b);
        }
    std::array<int, 2> const found = overlappingCells(mesh, body, 0.1);
    EXPECT_EQ(found[0] >= 0, depth > 0.05) << depth;
    if (found[0] >= 0)
    {
      EXPECT_NE(body[found[0]], body[found[1]]);
      EXPECT_EQ(overlappingCells(mesh, std::vector<int>(8, 0), 0.1)[0], -1);
    }
  }
}
