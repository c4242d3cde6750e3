// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_OnHost.hpp>
#include <Harmos_SlipMirrors.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{

using namespace Harmos;

/// Boundaries 0 left, 1 right, 2 bottom, 3 top of the given kinds.
View<Boundary *> walls(std::vector<BoundaryKind> const &kinds)
{
  std::vector<Boundary> list(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i)
    list[i].kind = kinds[i];
  return deviceCopy("boundary", list);
}

constexpr BoundaryKind slip = BoundaryKind::SlipWall, open = BoundaryKind::Outflow;

/// What a cell's mirrors are, found in a kernel.
SlipMirrors mirrorsOf(Mesh const &mesh, View<Boundary *> const &boundary, int cell, int rows)
{
  View<SlipMirrors *> const found("found", 1);
  Kokkos::parallel_for(
      "mirrors", RangePolicy(0, 1), KOKKOS_LAMBDA(int) { found(0) = SlipMirrors(mesh, boundary, cell, rows); });
  return onHost(found)(0);
}

/// Points that map on each other, to and fro.
void expectImage(MirrorImage const &image, Vector2 const &x, Vector2 const &of)
{
  for (int d = 0; d < 2; ++d)
  {
    EXPECT_NEAR(image.point(x)[d], of[d], 1e-14);
    EXPECT_NEAR(image.point(of)[d], x[d], 1e-14);
  }
}

Mesh rows(int nx, int ny)
{
  std::vector<double> x, y;
  for (int i = 0; i <= nx; ++i)
    x.push_back(i);
  for (int i = 0; i <= ny; ++i)
    y.push_back(2.0 * i);
  return buildMesh(rectilinearMesh(x, y));
}

TEST(SlipMirrors, atACorner_areTwoWallsAndBothTogether)
{
  SlipMirrors const m = mirrorsOf(rows(5, 5), walls({slip, slip, slip, slip}), 0, 1);
  ASSERT_EQ(m.count, 3);
  expectImage(m.image[0], {0.3, 0.7}, {0.3, -0.7});
  expectImage(m.image[1], {0.3, 0.7}, {-0.3, 0.7});
  EXPECT_EQ(m.image[2].count, 2);
  expectImage(m.image[2], {0.3, 0.7}, {-0.3, -0.7});
  EXPECT_EQ(m.image[2].direction({3.0, 4.0})[0], -3.0);
  EXPECT_EQ(m.image[2].direction({3.0, 4.0})[1], -4.0);
  EXPECT_EQ(m.image[0].direction({3.0, 4.0})[0], 3.0);
}

TEST(SlipMirrors, ofOtherBoundaries_areNone)
{
  Mesh const mesh = rows(5, 5);
  EXPECT_EQ(mirrorsOf(mesh, walls({open, open, open, BoundaryKind::Fixed}), 0, 3).count, 0);
  EXPECT_EQ(mirrorsOf(mesh, View<Boundary *>(), 0, 3).count, 0);
  EXPECT_EQ(mirrorsOf(mesh, walls({slip, slip, slip, slip}), 0, 0).count, 0);
  EXPECT_EQ(mirrorsOf(mesh, walls({slip, open, open, open}), 0, 3).count, 1);
}

TEST(SlipMirrors, areFoundOverSoManyRowsAsAreAskedFor)
{
  Mesh const mesh = rows(9, 9);
  View<Boundary *> const all = walls({slip, slip, slip, slip});
  int const third = 4 * 9 + 2; // from the left, in the middle of the other direction
  EXPECT_EQ(mirrorsOf(mesh, all, third, 2).count, 0);
  SlipMirrors const m = mirrorsOf(mesh, all, third, 3);
  ASSERT_EQ(m.count, 1);
  expectImage(m.image[0], {2.5, 9.0}, {-2.5, 9.0});
  // five cells of the wall to each side at most, here to its ends
  EXPECT_TRUE(m.image[0].reflects({2.5, 0.5}));
  EXPECT_FALSE(m.image[0].reflects({2.5, -0.5}));
}

TEST(SlipMirrors, inAStripOfOneCell_areOnBothSides)
{
  EXPECT_EQ(mirrorsOf(rows(5, 1), walls({slip, slip, slip, slip}), 2, 1).count, 2);
  EXPECT_EQ(mirrorsOf(rows(5, 1), walls({slip, slip, slip, slip}), 0, 1).count, 5); // left, and with each of them
}

TEST(SlipMirrors, endWhereAWallBends_andOneFaceOfAnArcIsNone)
{
  Mesh const flat = rows(6, 2);
  auto const x = onHost(flat.node_position);
  for (int from : {0, 3})
  {
    Mesh mesh = flat;
    mesh.node_position = View<double *[2]>("position", flat.num_nodes);
    auto const bent = Kokkos::create_mirror_view(mesh.node_position);
    for (int n = 0; n < flat.num_nodes; ++n)
    {
      bent(n, 0) = x(n, 0);
      // an arc from the left end on, each face by itself, or from x = 3 on
      double const beyond = Math::max(x(n, 0) - from, 0.0);
      bent(n, 1) = x(n, 1) - 0.02 * beyond * beyond;
    }
    Kokkos::deep_copy(mesh.node_position, bent);
    View<Boundary *> const bottom = walls({open, open, slip, open});
    EXPECT_EQ(mirrorsOf(mesh, bottom, 4, 1).count, 0);
    SlipMirrors const m = mirrorsOf(mesh, bottom, 1, 1);
    ASSERT_EQ(m.count, from == 0 ? 0 : 1);
    if (from == 3)
    {
      EXPECT_TRUE(m.image[0].reflects({2.9, 1.0}));
      EXPECT_FALSE(m.image[0].reflects({3.1, 1.0}));
    }
  }
}

} // namespace
