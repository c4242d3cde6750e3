// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_GmshFile.hpp>

#include <gtest/gtest.h>

#include <stdexcept>

using namespace Harmos;

namespace
{

/// Two unit cells side by side: `rod` is the left one, `anvil` the right one (clockwise); the lower edges are `bottom`.
///
///   4---5---6
///   |   |   |
///   1---2---3
std::string const version2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 7 "bottom"
2 1 "rod"
2 2 "the anvil"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
6
1 15 2 0 1 1
2 1 2 7 1 1 2
3 1 2 7 1 2 3
4 1 2 0 2 4 5
5 3 2 1 1 1 2 5 4
6 3 2 2 2 2 5 6 3
$EndElements
)";

std::string const version4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 7 "bottom"
2 1 "rod"
2 2 "the anvil"
$EndPhysicalNames
$Entities
1 2 2 0
1 0 0 0 0
1 0 0 0 2 0 0 1 7 2 1 -2
2 0 1 0 1 1 0 0 0
1 0 0 0 1 1 0 1 1 1 1
2 1 0 0 2 1 0 1 2 1 1
$EndEntities
$Nodes
2 6 1 60
1 1 0 3
10
20
30
0 0 0
1 0 0
2 0 0
2 1 0 3
40
50
60
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
5 6 1 6
0 1 15 1
1 10
1 1 1 2
2 10 20
3 20 30
1 2 1 1
4 40 50
2 1 3 1
5 10 20 50 40
2 2 3 1
6 20 50 60 30
$EndElements
)";

std::string replaced(std::string text, std::string const &from, std::string const &to)
{
  text.replace(text.find(from), from.size(), to);
  return text;
}

std::string errorOf(std::string const &text)
{
  try
  {
    parseGmsh(text, "rod.msh");
  }
  catch (std::runtime_error const &error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(GmshFile, bothVersions_giveTheSameCellsGroupsAndTurnClockwiseOnes)
{
  for (std::string const &text : {version2, version4})
  {
    GmshMesh const mesh = parseGmsh(text, "rod.msh");
    ASSERT_EQ(mesh.node.size(), 6u);
    EXPECT_EQ(mesh.node[4], (std::array<double, 2>{1.0, 1.0}));
    ASSERT_EQ(mesh.quadrilateral.size(), 2u);
    EXPECT_EQ(mesh.quadrilateral[0].surface, "rod");
    EXPECT_EQ(mesh.quadrilateral[0].node, (std::array<int, 4>{0, 1, 4, 3}));
    EXPECT_EQ(mesh.quadrilateral[1].surface, "the anvil");
    EXPECT_EQ(mesh.quadrilateral[1].node, (std::array<int, 4>{1, 2, 5, 4}));
    ASSERT_EQ(mesh.edge.size(), 2u); // the one without a group is passed over
    EXPECT_EQ(mesh.edge[1].curve, "bottom");
    EXPECT_EQ(mesh.edge[1].node, (std::array<int, 2>{1, 2}));
  }
}

TEST(GmshFile, whatIsWrong_isNamedWithItsLine)
{
  EXPECT_EQ(errorOf(replaced(version2, "2.2 0 8", "2.1 0 8")),
            "rod.msh, line 2: MSH version 2.1; expected: 2.2 or 4.1");
  EXPECT_EQ(errorOf(replaced(version4, "4.1 0 8", "4.1 1 8")), "rod.msh, line 2: a binary file; expected: ASCII");
  EXPECT_EQ(
      errorOf(replaced(version2, "5 3 2 1 1 1 2 5 4", "5 2 2 1 1 1 2 5")),
      "rod.msh, line 25: a triangle; expected: quadrilaterals alone (Gmsh: Recombine Surface, or a transfinite mesh)");
  EXPECT_EQ(errorOf(replaced(version2, "5 3 2 1 1 1 2 5 4", "5 3 2 1 1 1 2 9 4")),
            "rod.msh, line 25: there is no node 9");
  EXPECT_EQ(errorOf(replaced(version4, "2 1 3 1\n5 10", "2 1 16 1\n5 10")),
            "rod.msh, line 45: element type 16; expected: lines of two nodes (1) and quadrilaterals of four (3)");
  EXPECT_EQ(errorOf(replaced(version2, "5 1 1 0\n", "5 1 1 0.5\n")),
            "rod.msh, line 16: node 5 has z = 0.500000; expected: the plane z = 0");
  EXPECT_EQ(errorOf("harmos:\n  title: no mesh\n").substr(0, 35), "rod.msh, line 2: no $MeshFormat; ex");
  EXPECT_NE(errorOf(version2.substr(0, 150)), "");
  EXPECT_EQ(errorOf(version2.substr(0, version2.find("$Elements"))).substr(0, 52),
            "rod.msh, line 18: no quadrilateral in a physical sur");
}
