// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_MeshSmoother.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

constexpr int cells = 8;

struct Shaken
{
  std::vector<double> const lines = gradedCoordinates(0.0, 1.0, cells, 3.0);
  Mesh mesh = buildMesh(jitteredMesh(lines, lines, 0.2, 3));
  BoundaryConditions conditions;
  View<double *[2]> motion = View<double *[2]>("motion", mesh.num_nodes);

  explicit Shaken(BoundaryKind kind = BoundaryKind::SlipWall)
  {
    Boundary boundary;
    boundary.kind = kind;
    conditions = buildBoundaryConditions(mesh, deviceCopy("boundary", std::vector<Boundary>(4, boundary)));
  }

  void smooth(MeshSmoother const &smoother)
  {
    View<double *[2]> const target("target", mesh.num_nodes);
    smoothNodes(mesh, conditions, smoother, motion, target);
    mesh.node_position = target;
  }
};

bool onBoundary(int node)
{
  int const i = node % (cells + 1), j = node / (cells + 1);
  return i == 0 || j == 0 || i == cells || j == cells;
}

} // namespace

TEST(MeshSmoother, gradedAndShakenMesh_becomesTheUniformOne)
{
  Shaken s;
  for (int step = 0; step < 1500; ++step)
    s.smooth({0.0, 0.5});
  auto const x = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.mesh.node_position);
  for (int node = 0; node < s.mesh.num_nodes; ++node)
  {
    EXPECT_NEAR(x(node, 0), static_cast<double>(node % (cells + 1)) / cells, 1e-12);
    EXPECT_NEAR(x(node, 1), static_cast<double>(node / (cells + 1)) / cells, 1e-12);
  }
}

TEST(MeshSmoother, nodesFollowTheMotion_alongSlipWalls)
{
  Shaken s;
  auto const before = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.mesh.node_position);
  Kokkos::deep_copy(s.motion, 0.01);
  s.smooth({0.5, 0.0});
  auto const after = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.mesh.node_position);
  for (int node = 0; node < s.mesh.num_nodes; ++node)
  {
    int const index[2] = {node % (cells + 1), node / (cells + 1)};
    for (int d = 0; d < 2; ++d)
    {
      bool const wall = index[d] == 0 || index[d] == cells;
      bool const corner = (index[0] == 0 || index[0] == cells) && (index[1] == 0 || index[1] == cells);
      EXPECT_NEAR(after(node, d) - before(node, d), wall || corner ? 0.0 : 0.005, 1e-15) << node;
    }
  }
}

TEST(MeshSmoother, nodesAtAnOutflowOrAContactWall_stay)
{
  for (BoundaryKind const kind : {BoundaryKind::Outflow, BoundaryKind::ContactWall, BoundaryKind::Inflow})
  {
    Shaken s(kind);
    auto const before = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.mesh.node_position);
    Kokkos::deep_copy(s.motion, 0.01);
    s.smooth({1.0, 0.3});
    auto const after = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.mesh.node_position);
    for (int node = 0; node < s.mesh.num_nodes; ++node)
      for (int d = 0; d < 2; ++d)
        EXPECT_EQ(after(node, d) == before(node, d), onBoundary(node)) << node;
  }
}
