// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_OnHost.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace
{

using namespace Harmos;

Boundary ofKind(BoundaryKind kind, Vector2 velocity = {0.0, 0.0})
{
  Boundary boundary;
  boundary.kind = kind;
  boundary.velocity = velocity;
  return boundary;
}

/// Conditions by node number; a count of zero where there is none.
std::vector<NodeCondition> conditionsOf(Mesh const &mesh, std::vector<Boundary> const &list)
{
  BoundaryConditions const conditions = buildBoundaryConditions(mesh, deviceCopy("boundary", list));
  auto const index = onHost(conditions.node_index);
  auto const condition = onHost(conditions.condition);
  std::vector<NodeCondition> result(mesh.num_nodes);
  for (int n = 0; n < mesh.num_nodes; ++n)
    if (index(n) >= 0)
      result[n] = condition(index(n));
  return result;
}

//  6---7---8
//  |   |   |
//  3---4---5     boundaries 0 left, 1 right, 2 bottom, 3 top
//  |   |   |
//  0---1---2
Mesh fourCells()
{
  return buildMesh(rectilinearMesh({0, 1, 2}, {0, 1, 2}));
}

TEST(BuildBoundaryConditions, slipWalls_sidesKeepTheirTangentAndCornersAreFixed)
{
  auto const c = conditionsOf(fourCells(), std::vector<Boundary>(4));
  EXPECT_EQ(c[4].count, 0);
  EXPECT_EQ(c[1].count, 1);
  EXPECT_EQ(c[0].count, 2);
  Vector2 const v = c[1].apply({3.0, 4.0});
  EXPECT_EQ(v[0], 3.0);
  EXPECT_EQ(v[1], 0.0);
  Vector2 const w = c[5].apply({3.0, 4.0});
  EXPECT_EQ(w[0], 0.0);
  EXPECT_EQ(w[1], 4.0);
  Vector2 const corner = c[8].apply({3.0, 4.0});
  EXPECT_EQ(norm(corner), 0.0);
}

TEST(BuildBoundaryConditions, slipWallsAlongTheAxes_takeTheNormalPartToTheLastBit)
{
  for (int cells = 1; cells <= 100; ++cells)
  {
    double const h = 0.0388 / cells; // for some, (1 / (2 h)) (2 h) < 1
    auto const c =
        conditionsOf(buildMesh(rectilinearMesh({0.0, h, 2.0 * h}, {0.0, h, 2.0 * h})), std::vector<Boundary>(4));
    EXPECT_EQ(c[1].project({1e7, 1e7})[1], 0.0) << cells;
    EXPECT_EQ(c[3].project({1e7, 1e7})[0], 0.0) << cells;
  }
}

TEST(BuildBoundaryConditions, contactWallsAndOutflow_leaveTheNodesFree)
{
  auto const c = conditionsOf(fourCells(), {ofKind(BoundaryKind::ContactWall), ofKind(BoundaryKind::Outflow),
                                            ofKind(BoundaryKind::SlipWall), ofKind(BoundaryKind::ContactWall)});
  EXPECT_EQ(c[3].count, 0);
  EXPECT_EQ(c[5].count, 0);
  EXPECT_EQ(c[7].count, 0);
  EXPECT_EQ(c[0].count, 1);
  EXPECT_EQ(c[2].count, 1);
}

TEST(BuildBoundaryConditions, fixedInflowAndSlipMeet_fixedGoesFirstThenInflow)
{
  auto const c = conditionsOf(fourCells(), {ofKind(BoundaryKind::Inflow, {5.0, 1.0}), ofKind(BoundaryKind::SlipWall),
                                            ofKind(BoundaryKind::SlipWall), ofKind(BoundaryKind::Fixed)});
  Vector2 const lower_left = c[0].apply({9.0, 9.0});
  EXPECT_EQ(lower_left[0], 5.0);
  EXPECT_EQ(lower_left[1], 1.0);
  EXPECT_EQ(norm(c[6].apply({9.0, 9.0})), 0.0);
  EXPECT_EQ(norm(c[8].apply({9.0, 9.0})), 0.0);
}

TEST(BuildBoundaryConditions, fixedFaceBeforeInflowFace_fixedStillGoesFirst)
{
  auto const c = conditionsOf(fourCells(), {ofKind(BoundaryKind::Inflow, {5.0, 1.0}), ofKind(BoundaryKind::SlipWall),
                                            ofKind(BoundaryKind::Fixed), ofKind(BoundaryKind::SlipWall)});
  EXPECT_EQ(norm(c[0].apply({9.0, 9.0})), 0.0);
  EXPECT_EQ(c[6].apply({9.0, 9.0})[0], 5.0);
}

TEST(BuildBoundaryConditions, prescribedVelocity_onlyItsNormalPartIsUsed)
{
  auto const c =
      conditionsOf(fourCells(), {ofKind(BoundaryKind::Prescribed, {-2.0, 7.0}), ofKind(BoundaryKind::SlipWall),
                                 ofKind(BoundaryKind::SlipWall), ofKind(BoundaryKind::SlipWall)});
  Vector2 const v = c[3].apply({1.0, 4.0});
  EXPECT_EQ(v[0], -2.0);
  EXPECT_EQ(v[1], 4.0);
  Vector2 const corner = c[0].apply({1.0, 4.0});
  EXPECT_EQ(corner[0], -2.0);
  EXPECT_EQ(corner[1], 0.0);
}

TEST(BuildBoundaryConditions, slipWallsTurnedBy30Degrees_normalLeavesTheDomain)
{
  HostMesh whole = rectilinearMesh({0, 1, 2}, {0, 1, 2});
  double const c = std::cos(Math::pi / 6.0), s = std::sin(Math::pi / 6.0);
  for (auto &x : whole.node)
    x = {c * x[0] - s * x[1], s * x[0] + c * x[1]};
  auto const conditions = conditionsOf(buildMesh(whole), std::vector<Boundary>(4));
  EXPECT_EQ(conditions[1].count, 1);
  EXPECT_NEAR(conditions[1].normal[0][0], s, 1e-15);
  EXPECT_NEAR(conditions[1].normal[0][1], -c, 1e-15);
  EXPECT_NEAR(dot(conditions[1].apply({1.0, 2.0}), {s, -c}), 0.0, 1e-15);
}

//  3---4---5     the lower side bends at node 1
//  |   |   |
//  0---+---2
//      1
Mesh bentFloor(double bend)
{
  HostMesh whole = rectilinearMesh({0, 1, 3}, {0, 6});
  for (auto &x : whole.node)
    if (x[0] > 1.0 && x[1] == 0.0)
      x[1] = 2.0 * std::tan(bend);
  return buildMesh(whole);
}

TEST(BuildBoundaryConditions, gentlyBentWall_nodeSlidesAlongTheMeanTangentAndTheWallLetsNothingThrough)
{
  double const bend = Math::pi / 9.0;
  auto const c = conditionsOf(bentFloor(bend), std::vector<Boundary>(4));
  EXPECT_EQ(c[1].count, 1);
  Vector2 const v = c[1].apply({3.0, 0.0});
  EXPECT_GT(v[0], 2.0);
  // Faces of lengths 1 and 2 / cos, normals (0, -1) and (sin, -cos): the velocity carries nothing through both.
  EXPECT_NEAR(-v[1] + 2.0 / std::cos(bend) * (std::sin(bend) * v[0] - std::cos(bend) * v[1]), 0.0, 1e-14);
  EXPECT_EQ(c[0].count, 2);
  EXPECT_EQ(c[2].count, 2);
}

TEST(BuildBoundaryConditions, sharplyBentWall_fixesTheNode)
{
  EXPECT_EQ(conditionsOf(bentFloor(0.26 * Math::pi), std::vector<Boundary>(4))[1].count, 2);
  EXPECT_EQ(conditionsOf(bentFloor(0.24 * Math::pi), std::vector<Boundary>(4))[1].count, 1);
}

TEST(BuildBoundaryConditions, prescribedVelocityOfABentSide_isThatOfTheWholeSide)
{
  double const bend = Math::pi / 9.0;
  auto const c =
      conditionsOf(bentFloor(bend), {ofKind(BoundaryKind::SlipWall), ofKind(BoundaryKind::SlipWall),
                                     ofKind(BoundaryKind::Prescribed, {0.0, -2.0}), ofKind(BoundaryKind::SlipWall)});
  Vector2 const v = c[1].apply({0.0, -2.0});
  EXPECT_NEAR(v[0], 0.0, 1e-15);
  EXPECT_NEAR(v[1], -2.0, 1e-15);
}

TEST(BuildBoundaryConditions, edgeOfTheHalo_isNoBoundary)
{
  HostMesh const whole = rectilinearMesh({0, 1, 2, 3, 4}, {0, 1});
  Mesh const mesh = buildLocalMesh(whole, {0, 0, 1, 1}, 0, 1);
  auto const c = conditionsOf(mesh, std::vector<Boundary>(4));
  auto const global = onHost(mesh.node_global);
  for (int n = 0; n < mesh.num_nodes; ++n)
    EXPECT_EQ(c[n].count, global(n) % 5 == 0 ? 2 : 1);
}

TEST(BuildBoundaryConditions, boundaryNumberWithoutABoundary_isRefused)
{
  EXPECT_THROW(buildBoundaryConditions(fourCells(), deviceCopy("boundary", std::vector<Boundary>(3))),
               std::runtime_error);
}

} // namespace
