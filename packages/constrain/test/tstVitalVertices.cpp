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
  std::vector<ContactRow> rows;
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
      rows.push_back(contact);
    }
  return tracesOf(mesh, rows);
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

/// The obliquely cut box of the tests below: the interface runs from (5.3, 0) to (3.6, 6).
TinyScene obliqueScene(Interaction kind, Placement placement)
{
  TinyScene scene(
      rectilinearMesh(uniform(12, 12), uniform(6, 6)),
      {polygonBody(0, {{0, 0}, {5.3, 0}, {3.6, 6}, {0, 6}}), polygonBody(1, {{5.3, 0}, {12, 0}, {12, 6}, {3.6, 6}})}, 2,
      std::vector<BoundaryKind>(4, BoundaryKind::Outflow), Kinematics::Xfem, {2.0, 3.0});
  PairInteraction law;
  law.kind = kind;
  law.friction = kind == Interaction::Friction ? 0.3 : 0.0;
  scene.setInteraction(0, 1, law);
  scene.options.placement = placement;
  return scene;
}

/// Velocities that the impulse of a uniform pressure on the interface gives both bodies: +- n p / m_I times the
/// integral of N_I along the line, by Simpson's rule between the lines of the mesh, where N_I is quadratic.
void pressTogether(TinyScene &scene, double p)
{
  Vector2 const from{5.3, 0.0}, to{3.6, 6.0};
  std::vector<double> cut = {0.0, 1.0};
  for (int k = 1; k < 6; ++k)
    cut.push_back(k / 6.0);
  for (int x : {4, 5})
    cut.push_back((from[0] - x) / (from[0] - to[0]));
  std::sort(cut.begin(), cut.end());
  double const length = norm(to - from);
  Vector2 const n{6.0 / length, 1.7 / length};
  auto const mass = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.dof_mass);
  auto const v = Kokkos::create_mirror_view(scene.predicted);
  scene.forEachDof(
      [&](int dof, int material, Vector2 const &node)
      {
        double integral = 0.0;
        for (std::size_t i = 0; i + 1 < cut.size(); ++i)
          for (int k = 0; k < 3; ++k)
          {
            Vector2 const x = from + (cut[i] + 0.5 * k * (cut[i + 1] - cut[i])) * (to - from);
            double const shape =
                std::max(1.0 - std::fabs(x[0] - node[0]), 0.0) * std::max(1.0 - std::fabs(x[1] - node[1]), 0.0);
            integral += (k == 1 ? 4.0 : 1.0) / 6.0 * (cut[i + 1] - cut[i]) * length * shape;
          }
        for (int d = 0; d < 2; ++d)
          v(dof, d) = (material == 0 ? 1.0 : -1.0) * p * integral / mass(dof) * n[d];
      });
  Kokkos::deep_copy(scene.predicted, v);
}

// A uniform pressure, integrated exactly over the interface, is what the mortar multipliers answer with, to round-off.
// One point a segment integrates its forces otherwise.
TEST(VitalVertices, mortar_answersAUniformPressureWithItself)
{
  constexpr double p = 7.0;
  double const length = std::hypot(1.7, 6.0);
  for (Interaction const kind : {Interaction::Sliding, Interaction::Bonded, Interaction::Friction})
    for (Placement const placement : {Placement::Mortar, Placement::VitalVertices})
    {
      TinyScene scene = obliqueScene(kind, placement);
      scene.options.shortest_segment = 0.0;
      scene.setVelocity([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
      pressTogether(scene, p);
      ConstraintReport const report = scene.constrain();
      EXPECT_TRUE(report.converged) << report.residual;
      PairForce const &force = report.pair_force[1];
      EXPECT_NEAR(force.area, length, 1e-12);
      EXPECT_NEAR(force.normal_impulse, p * length, (placement == Placement::Mortar ? 1e-9 : 0.05) * p * length);
      if (placement == Placement::Mortar)
        EXPECT_LE(force.deviation(), 1e-7 * p);
      else
        EXPECT_GE(force.deviation(), 0.01 * p);
    }
}

// Two bodies touch up to y = 3 and open above. Pressed together they do not approach in the mean over any group with
// points that touch, though others of its points still have a gap.
TEST(VitalVertices, gapsOfSomePoints_letNoGroupThatTouchesApproach)
{
  for (Placement const placement : {Placement::VitalVertices, Placement::Mortar})
  {
    TinyScene scene(rectilinearMesh(uniform(12, 12), uniform(6, 6)),
                    {polygonBody(0, {{0, 0}, {5.3, 0}, {5.3, 6}, {0, 6}}),
                     polygonBody(1, {{5.3, 0}, {12, 0}, {12, 6}, {5.34, 6}, {5.3, 3}})},
                    2, std::vector<BoundaryKind>(4, BoundaryKind::Outflow), Kinematics::Xfem, {2.0, 3.0});
    scene.options.placement = placement;
    double const speed = 0.1 / scene.dt;
    scene.setVelocity([&](int material, Vector2 const &) { return Vector2{material == 0 ? speed : -speed, 0.0}; });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    auto const half = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.half);
    double approach[7] = {}; // at x = 5.3
    scene.forEachDof(
        [&](int dof, int material, Vector2 const &node)
        {
          double const part = std::max(0.0, 1.0 - std::fabs(5.3 - node[0]));
          approach[static_cast<int>(std::lround(node[1]))] += (material == 0 ? part : -part) * half(dof, 0);
        });
    double const own = placement == Placement::Mortar ? 4.0 : 2.0; // of one group, in the mean over its hat
    for (int y = 1; y <= 3; ++y)
      EXPECT_LE((approach[y - 1] + own * approach[y] + approach[y + 1]) / (own + 2.0), 1e-5 * speed) << y;
    EXPECT_LE(approach[6], 0.04 / scene.dt);
    EXPECT_GE(approach[6], 0.02 / scene.dt);
  }
}

// Momentum and the work of the impulses are exact; the mean approach over the interface vanishes.
TEST(VitalVertices, obliqueImpact_conserves)
{
  for (Placement const placement : {Placement::VitalVertices, Placement::Mortar})
    for (Interaction const kind : {Interaction::Sliding, Interaction::Bonded, Interaction::Friction})
    {
      TinyScene scene = obliqueScene(kind, placement);
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
