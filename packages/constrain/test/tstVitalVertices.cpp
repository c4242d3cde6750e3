// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <Harmos_VitalVertices.hpp>

#include <gtest/gtest.h>

using namespace HarmosTest;

namespace
{

/// Traces of a line y = y0 + slope x through unit cells 0 <= x <= columns, nodes numbered 1000 j + i.
std::vector<RowTrace> tracesOfLine(int columns, double y0, double slope)
{
  Mesh const mesh = buildMesh(rectilinearMesh(uniform(columns, columns), uniform(8, 8)));
  std::vector<RowTrace> traces;
  double const c = 1.0 / std::sqrt(1.0 + slope * slope);
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < 8; ++row)
    {
      // The part of the line within the cell.
      double x0 = column, x1 = column + 1.0;
      if (slope > 0.0)
      {
        x0 = std::max(x0, (row - y0) / slope);
        x1 = std::min(x1, (row + 1.0 - y0) / slope);
      }
      double const x = 0.5 * (x0 + x1), y = y0 + slope * x;
      if (x1 - x0 < 1e-6 || y < row || y >= row + 1.0)
        continue;
      ContactRow contact = {};
      contact.cell_a = row * columns + column;
      contact.material_b = 1;
      contact.point = {x, y};
      contact.normal = {-slope * c, c};
      contact.length = (x1 - x0) / c;
      traces.push_back(rowTrace(mesh, contact));
    }
  return traces;
}

double sum(std::vector<std::vector<GroupShare>> const &shares, int group)
{
  double total = 0.0;
  for (auto const &row : shares)
    for (GroupShare const &share : row)
      total += share.group == group ? share.weight : 0.0;
  return total;
}

} // namespace

//  +---+---+---+
//  |   |   |   |
//  x---x---x---x   the line crosses four edges without common nodes
//  |   |   |   |
//  +---+---+---+
TEST(VitalVertices, levelLine_hasAMultiplierAtEachCrossing_linearBetween)
{
  std::vector<RowTrace> const trace = tracesOfLine(3, 3.4, 0.0);
  ASSERT_EQ(trace.size(), 3u);
  int groups = 0;
  auto const shares = vitalGroups(trace, std::vector<int>(3, 0), groups);
  EXPECT_EQ(groups, 4);
  for (auto const &row : shares)
  {
    ASSERT_EQ(row.size(), 2u);
    EXPECT_NE(row[0].group, row[1].group);
  }
  for (int g = 0; g < groups; ++g)
    EXPECT_NEAR(sum(shares, g), 1.0, 1e-14);
}

// On cell faces: the nodes of the faces.
TEST(VitalVertices, lineOnFaces_hasAMultiplierAtEachNode)
{
  int groups = 0;
  vitalGroups(tracesOfLine(5, 3.0, 0.0), std::vector<int>(5, 0), groups);
  EXPECT_EQ(groups, 6);
}

// Vital edges share no node, and each crossed edge has a node with one: about a multiplier a column at any slope, where
// midpoints have 1 + slope.
TEST(VitalVertices, obliqueLine_hasAboutOneMultiplierAColumn)
{
  for (double const slope : {0.1, 0.364, 0.7})
  {
    int const columns = 9;
    std::vector<RowTrace> const trace = tracesOfLine(columns, 0.613, slope);
    int groups = 0;
    auto const shares = vitalGroups(trace, std::vector<int>(trace.size(), 0), groups);
    EXPECT_GE(static_cast<int>(trace.size()), columns + static_cast<int>(slope * columns));
    EXPECT_LE(groups, columns + 1);
    EXPECT_GE(groups, columns / 2);
    double total = 0.0;
    for (RowTrace const &row : trace)
      total += row.length;
    EXPECT_NEAR(total, columns * std::sqrt(1.0 + slope * slope), 1e-12);
    for (int g = 0; g < groups; ++g)
      EXPECT_NEAR(sum(shares, g), 1.0, 1e-13);
  }
}

// Kinds of rows share nothing.
TEST(VitalVertices, rowsOfOtherKind_haveGroupsOfTheirOwn)
{
  std::vector<RowTrace> const trace = tracesOfLine(4, 3.4, 0.0);
  int groups = 0;
  auto const shares = vitalGroups(trace, {0, 0, 1, 1}, groups);
  EXPECT_EQ(groups, 6);
  EXPECT_NE(shares[1][0].group, shares[2][0].group);
}

// Momentum and the work of the impulses are exact; the mean approach over the interface vanishes.
TEST(VitalVertices, obliqueImpact_conserves)
{
  for (Interaction const kind : {Interaction::Sliding, Interaction::Bonded, Interaction::Friction})
  {
    TinyScene scene(
        rectilinearMesh(uniform(12, 12), uniform(6, 6)),
        {polygonBody(0, {{0, 0}, {5.3, 0}, {3.6, 6}, {0, 6}}), polygonBody(1, {{5.3, 0}, {12, 0}, {12, 6}, {3.6, 6}})},
        2, std::vector<BoundaryKind>(4, BoundaryKind::Outflow), Kinematics::Xfem, {2.0, 3.0});
    PairInteraction law;
    law.kind = kind;
    law.friction = kind == Interaction::Friction ? 0.3 : 0.0;
    scene.setInteraction(0, 1, law);
    scene.options.placement = Placement::VitalVertices;
    scene.setVelocity(
        [](int material, Vector2 const &x) {
          return Vector2{material == 0 ? 60.0 : -40.0, 10.0 * std::sin(x[0])};
        });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    EXPECT_LE(report.iterations, 20);
    EXPECT_GT(report.pair_force[1].normal_impulse, 0.0);
    auto const before = scene.sums(scene.predicted, -2), after = scene.sums(scene.half, -2);
    EXPECT_NEAR(norm(after.momentum - before.momentum), 0.0, 1e-12 * 60.0 * before.mass);
    EXPECT_NEAR(after.kinetic + report.contact_loss, before.kinetic, 1e-11 * before.kinetic);
  }
}
