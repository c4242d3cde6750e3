// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <Harmos_InterfaceSegments.hpp>
#include <Harmos_RayCast.hpp>

#include <gtest/gtest.h>

using namespace HarmosTest;

namespace
{

std::vector<InterfaceSegment> segmentsOf(TinyScene const &scene)
{
  InterfaceSegments const s = findInterfaceSegments(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions,
                                                    scene.conditions, Placement::Midpoint);
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.segment);
  return std::vector<InterfaceSegment>(host.data(), host.data() + s.count);
}

std::vector<RayHit> hitsOf(TinyScene const &scene)
{
  InterfaceSegments const s = findInterfaceSegments(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions,
                                                    scene.conditions, Placement::Midpoint);
  auto const hit = castRays(scene.mesh, s, binSegments(s, largestSegment(scene.mesh, s)));
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), hit);
  return std::vector<RayHit>(host.data(), host.data() + s.count);
}

/// Body 0 above `bottom`, in the second row of cells, but for a film of void of 1e-5 along the upper faces there.
Body crackedAbove(double bottom)
{
  return {0, [bottom](Quadrilateral const &cell)
          {
            Region above, upper;
            clip(wholeCell(cell), Plane2{{0.0, -1.0}, -bottom}, above);
            if (cell[0][1] != 1.0)
              return above;
            clip(above, Plane2{{0.0, 1.0}, 2.0 - 1e-5}, upper);
            return upper;
          }};
}

} // namespace

TEST(InterfaceSegments, pureMeshOfOneMaterial_hasNone)
{
  TinyScene const scene(rectilinearMesh(uniform(4, 4), uniform(4, 4)), {boxBody(0, -1, -1, 9, 9)}, 1, open_box);
  EXPECT_TRUE(segmentsOf(scene).empty());
}

// Two materials that fill columns 0-1 and 2-3: the interface is the face x = 2, no mixed cell at all.
TEST(InterfaceSegments, interfaceOnFaces_pureCellsExposeWholeFaces)
{
  TinyScene const scene(rectilinearMesh(uniform(4, 4), uniform(2, 2)), {boxBody(0, 0, 0, 2, 2), boxBody(1, 2, 0, 4, 2)},
                        2, open_box);
  EXPECT_EQ(scene.regions.num_mixed_cells, 0);
  auto const s = segmentsOf(scene);
  auto const hit = hitsOf(scene);
  ASSERT_EQ(s.size(), 4u);
  for (std::size_t i = 0; i < s.size(); ++i)
  {
    EXPECT_DOUBLE_EQ(s[i].midpoint[0], 2.0);
    EXPECT_DOUBLE_EQ(s[i].length, 1.0);
    EXPECT_DOUBLE_EQ(s[i].exposed, 1.0);
    EXPECT_DOUBLE_EQ(s[i].normal[0], s[i].material == 0 ? 1.0 : -1.0);
    ASSERT_GE(hit[i].segment, 0);
    EXPECT_NE(s[static_cast<std::size_t>(hit[i].segment)].material, s[i].material);
    EXPECT_EQ(hit[i].gap, 0.0);
  }
}

// A film of void along a face inside body 0, above body 1, which the ray of the film's upper side would meet 0.7 cells
// farther on: behind its own body. (Vital vertices shared a multiplier with such a row, and what touched bore nothing.)
TEST(InterfaceSegments, rayFromACrackInItsBody_meetsNothingBehindIt)
{
  TinyScene const scene(rectilinearMesh(uniform(3, 3), uniform(3, 3)), {crackedAbove(1.5), boxBody(1, 0, 0, 3, 1.3)}, 2,
                        open_box);
  auto const s = segmentsOf(scene);
  auto const hit = hitsOf(scene);
  int faces = 0, upper_sides = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
  {
    if (s[i].material != 0 || s[i].normal[1] > -0.5)
      continue;
    bool const upper = s[i].midpoint[1] > 1.9;
    (upper ? upper_sides : faces) += 1;
    EXPECT_EQ(hit[i].segment >= 0, !upper) << s[i].midpoint[0] << ' ' << s[i].midpoint[1];
    if (!upper)
    {
      EXPECT_NEAR(hit[i].gap, 0.2, 1e-12);
    }
  }
  EXPECT_EQ(faces, 3);
  EXPECT_EQ(upper_sides, 3);
}

// What is left below the film is a film itself and lies on body 1: what is above it presses on that body as well.
TEST(InterfaceSegments, rayFromACrackNearItsBodysSurface_meetsWhatTheBodyTouches)
{
  double const surface = 2.0 - 4e-4;
  TinyScene const scene(rectilinearMesh(uniform(3, 3), uniform(3, 3)),
                        {crackedAbove(surface), boxBody(1, 0, 0, 3, surface)}, 2, open_box);
  auto const s = segmentsOf(scene);
  auto const hit = hitsOf(scene);
  int upper_sides = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
    if (s[i].material == 0 && s[i].normal[1] < -0.5 && s[i].midpoint[1] > 2.0 - 1e-9)
    {
      ++upper_sides;
      ASSERT_GE(hit[i].segment, 0);
      EXPECT_EQ(s[static_cast<std::size_t>(hit[i].segment)].material, 1);
      EXPECT_NEAR(hit[i].gap, 4e-4, 1e-12);
    }
  EXPECT_EQ(upper_sides, 3);
}

// Cells are found once for the same arrays; who changes what a cell holds makes new ones.
TEST(InterfaceSegments, keptCells_giveTheSameSegmentsUntilKindsComeInANewArray)
{
  TinyScene scene(rectilinearMesh(uniform(4, 4), uniform(2, 2)), {boxBody(0, 0, 0, 2, 2), boxBody(1, 2, 0, 4, 2)}, 2,
                  open_box);
  InterfaceCells kept;
  auto const find = [&](InterfaceCells *cells)
  {
    return findInterfaceSegments(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions,
                                 Placement::Midpoint, cells)
        .count;
  };
  EXPECT_EQ(find(&kept), 4);
  int const *const listed = kept.cell.data();
  EXPECT_EQ(find(&kept), 4);
  EXPECT_EQ(kept.cell.data(), listed);

  // Void in cell 5, of the first material beside the interface.
  View<int *> const kind("kind", scene.mesh.num_cells);
  Kokkos::deep_copy(kind, scene.pairs.cell_kind);
  Kokkos::deep_copy(Kokkos::subview(kind, 5), static_cast<int>(VoidCell));
  scene.pairs.cell_kind = kind;
  EXPECT_EQ(find(&kept), find(nullptr));
  EXPECT_NE(find(&kept), 4);
}

// Right cell is cut at y = 0.25 into material 0 below and 1 above; left cell is all 0: it exposes the upper three
// quarters.
TEST(InterfaceSegments, pureCellBesideMixedCell_exposesWhatItsMaterialDoesNotCover)
{
  TinyScene const scene(rectilinearMesh(uniform(2, 2), uniform(1, 1)),
                        {boxBody(0, 0, 0, 1, 1), boxBody(0, 1, 0, 2, 0.25), boxBody(1, 1, 0.25, 2, 1)}, 2, open_box);
  int found = 0;
  for (InterfaceSegment const &s : segmentsOf(scene))
    if (s.cell == 0)
    {
      ++found;
      EXPECT_NEAR(s.length, 0.75, 1e-14);
      EXPECT_NEAR(s.exposed, 0.75, 1e-14);
      EXPECT_NEAR(s.midpoint[1], 0.625, 1e-14);
    }
  EXPECT_EQ(found, 1);
}

// Material 0 below y = 0.5 faces 1 (x < 0.4) and 2 (x > 0.4) in one cell: its edge is split there.
TEST(InterfaceSegments, edgeThatFacesTwoMaterials_isSplit)
{
  TinyScene const scene(rectilinearMesh(uniform(1, 1), uniform(1, 1)),
                        {boxBody(0, 0, 0, 1, 0.5), boxBody(1, 0, 0.5, 0.4, 1), boxBody(2, 0.4, 0.5, 1, 1)}, 3,
                        open_box);
  std::vector<double> lengths;
  for (InterfaceSegment const &s : segmentsOf(scene))
    if (s.material == 0)
      lengths.push_back(s.length);
  ASSERT_EQ(lengths.size(), 2u);
  EXPECT_NEAR(lengths[0] + lengths[1], 1.0, 1e-14);
  EXPECT_NEAR(std::min(lengths[0], lengths[1]), 0.4, 1e-14);
}

// Five strips with gaps in one cell: more segments than the room that is first made for a cell.
TEST(InterfaceSegments, cellOfManySegments_keepsThemAll)
{
  std::vector<Body> strips;
  for (int m = 0; m < 5; ++m)
    strips.push_back(boxBody(m, 0, 0.2 * m + 0.05, 1, 0.2 * m + 0.15));
  TinyScene const scene(rectilinearMesh(uniform(1, 1), uniform(1, 1)), strips, 5, open_box);
  auto const s = segmentsOf(scene);
  ASSERT_EQ(s.size(), 10u);
  for (std::size_t i = 0; i < s.size(); ++i)
  {
    EXPECT_EQ(s[i].number, static_cast<int>(i));
    EXPECT_EQ(s[i].material, static_cast<int>(i / 2));
    EXPECT_NEAR(s[i].length, 1.0, 1e-14);
  }
}

TEST(InterfaceSegments, contactWall_isASegmentThatFacesIntoTheDomain)
{
  std::vector<BoundaryKind> kinds = open_box;
  kinds[2] = BoundaryKind::ContactWall;
  TinyScene const scene(rectilinearMesh(uniform(2, 2), uniform(2, 2)), {boxBody(0, 0, 0.5, 2, 2)}, 1, kinds);
  auto const s = segmentsOf(scene);
  auto const hit = hitsOf(scene);
  int walls = 0, facing = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
  {
    walls += s[i].material == -1 && s[i].normal[1] == 1.0;
    if (s[i].material == 0 && s[i].normal[1] < -0.5)
    {
      ASSERT_GE(hit[i].segment, 0);
      EXPECT_EQ(s[static_cast<std::size_t>(hit[i].segment)].material, -1);
      EXPECT_NEAR(hit[i].gap, 0.5, 1e-14);
      ++facing;
    }
  }
  EXPECT_EQ(walls, 2);
  EXPECT_EQ(facing, 2);
}

// Cells four times as high as wide: two plates face each other over 3 wherever the gap is less than a cell's size, 0.5,
// which is two cells. A third one far away meets nothing and carries no segment.
TEST(InterfaceSegments, thoseOfCellsFarFromOthers_areLeftOutAndAllThatFacesRemains)
{
  for (double const start : {3.0, 3.1, 3.2})
    for (double const gap : {0.0, 1e-4, 0.1, 0.3, 0.49})
    {
      TinyScene const scene(
          rectilinearMesh(uniform(12.0, 48), uniform(4.0, 4)),
          {boxBody(0, 1.0, 0.5, start, 3.5), boxBody(1, start + gap, 0.5, 6.1, 3.5), boxBody(2, 8.4, 0.5, 10.3, 3.5)},
          3, open_box);
      auto const s = segmentsOf(scene);
      auto const hit = hitsOf(scene);
      double facing[2] = {0.0, 0.0};
      for (std::size_t i = 0; i < s.size(); ++i)
      {
        ASSERT_NE(s[i].material, 2);
        EXPECT_NEAR(s[i].midpoint[0], start, 1.0);
        if (hit[i].segment >= 0)
        {
          EXPECT_NEAR(hit[i].gap, gap, 1e-13);
          facing[s[i].material] += s[i].length;
        }
      }
      EXPECT_NEAR(facing[0], 3.0, 1e-12) << "start " << start << " gap " << gap;
      EXPECT_NEAR(facing[1], 3.0, 1e-12) << "start " << start << " gap " << gap;
    }
}

TEST(RayCast, gapAcrossCells_isMeasuredAndBeyondOneCellNothingIsFound)
{
  for (double const gap : {0.3, 0.9, 1.1})
  {
    TinyScene const scene(rectilinearMesh(uniform(6, 6), uniform(1, 1)),
                          {boxBody(0, 0, 0, 2.5, 1), boxBody(1, 2.5 + gap, 0, 6, 1)}, 2, open_box);
    auto const s = segmentsOf(scene);
    auto const hit = hitsOf(scene);
    for (std::size_t i = 0; i < s.size(); ++i)
    {
      if (std::fabs(s[i].normal[0]) < 0.5)
        continue;
      if (gap > 1.0)
        EXPECT_EQ(hit[i].segment, -1);
      else
      {
        ASSERT_GE(hit[i].segment, 0);
        EXPECT_NEAR(hit[i].gap, gap, 1e-13);
        EXPECT_NEAR(hit[i].cosine, 1.0, 1e-14);
      }
    }
  }
}

TEST(RayCast, overlapOfSeparateBlocks_isFoundAsGapZero)
{
  BlockMesh const blocks =
      mappedBlocks({{{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}}, {2, 2}}, {{{{2, 0}, {4, 0}, {4, 2}, {2, 2}}}, {2, 2}}});
  HostMesh host = blocks.mesh;
  for (auto &f : host.face_boundary)
    f = {-1, -1, -1, -1};
  for (std::size_t i = 9; i < host.node.size(); ++i)
    host.node[i][0] -= 0.1; // the second block moves into the first
  auto const block = [](bool second)
  {
    return [second](Quadrilateral const &q)
    { return (q[0][0] != std::floor(q[0][0])) == second ? wholeCell(q) : Region(); };
  };
  TinyScene const scene(host, {{0, block(false)}, {1, block(true)}}, 2, open_box, Kinematics::Lagrangian);
  auto const s = segmentsOf(scene);
  auto const hit = hitsOf(scene);
  int found = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
    if (std::fabs(s[i].midpoint[0] - (s[i].material == 0 ? 2.0 : 1.9)) < 1e-12 && std::fabs(s[i].normal[0]) > 0.9)
    {
      ASSERT_GE(hit[i].segment, 0);
      EXPECT_EQ(hit[i].gap, 0.0);
      ++found;
    }
  EXPECT_EQ(found, 8); // two a free face
}
