// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

/// Material 0 below, material 1 above a gap of void, both to the last cell of a row of shaken cells.
struct Layers
{
  std::vector<Testing::Body> bodies;
  Testing::Scene scene;
};

Layers layers(Geometry geometry, double degrees, double middle, double gap)
{
  Mesh mesh = makeMesh(6, 3, 1.0, 0.1, 7);
  mesh.geometry = geometry;
  Vector2 const along{std::cos((degrees + 90.0) * Math::pi / 180.0), std::sin((degrees + 90.0) * Math::pi / 180.0)};
  Layers result{{{halfPlane(degrees + 90.0, Vector2{3.0, middle} - 0.5 * gap * along)},
                 {halfPlane(degrees + 270.0, Vector2{3.0, middle} + 0.5 * gap * along)}},
                {}};
  result.scene = paint(mesh, bodies(result.bodies, geometry));
  return result;
}

/// The pairs and centroids of one scene with the volume fractions of another.
FilledRegions refilled(Testing::Scene const &before, Testing::Scene const &after, FilledRegions const &regions)
{
  PairState state = before.state;
  state.record = after.state.record;
  ReconstructionReport report;
  FilledRegions const result = refill(before.mesh, before.pairs, state, regions, {}, report);
  EXPECT_EQ(report.failures, 0);
  EXPECT_LT(report.largest_volume_error, 1e-13);
  return result;
}

/// Two blocks whose end faces were in line, slid by a part of a cell: the cell of both corners is parted.
Testing::Scene passingCorners(double slip)
{
  Vector2 const corner{3.2, 1.3};
  Vector2 const moved = corner + slip * halfPlane(10.0, corner).normal;
  std::vector<Testing::Body> const blocks{{halfPlane(-80.0, corner), halfPlane(10.0, corner)},
                                          {halfPlane(100.0, corner), halfPlane(10.0, moved)}};
  return paint(makeMesh(6, 3, 1.0), bodies(blocks));
}

/// The largest distance between vertices of the same number.
double distance(FilledRegions const &a, FilledRegions const &b)
{
  auto const first = onHost(a.polygon);
  auto const second = onHost(b.polygon);
  EXPECT_EQ(first.extent(0), second.extent(0));
  double largest = 0.0;
  for (std::size_t i = 0; i < first.extent(0); ++i)
  {
    EXPECT_EQ(first(i).size, second(i).size);
    for (int v = 0; v < first(i).size; ++v)
      largest = std::max(largest, norm(first(i)[v] - second(i)[v]));
  }
  return largest;
}

} // namespace

TEST(Refill, InterfacesThatMoveAlongTheirNormals_areFoundWithTheCentroidsOfBefore)
{
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (double const degrees : {0.0, 3.0, -4.0})
    {
      Layers const before = layers(geometry, degrees, 1.5, 0.2), after = layers(geometry, degrees, 1.55, 0.1);
      ASSERT_EQ(before.scene.pairs.num_pairs, after.scene.pairs.num_pairs);
      FilledRegions const regions = reconstructed(before.scene);
      ASSERT_LT(misplacedVolume(before.scene, regions, before.bodies), 1e-10);
      FilledRegions const moved = refilled(before.scene, after.scene, regions);
      EXPECT_LT(misplacedVolume(after.scene, moved, after.bodies), 1e-10) << degrees;
    }
}

TEST(Refill, UnchangedFractions_giveTheSameRegions)
{
  Layers const same = layers(Geometry::Planar, 3.0, 1.5, 0.2);
  FilledRegions const regions = reconstructed(same.scene);
  EXPECT_EQ(distance(regions, refilled(same.scene, same.scene, regions)), 0.0);
}

TEST(Refill, CellsWhoseVoidComesOrGoes_areReconstructed)
{
  Layers const open = layers(Geometry::Planar, 3.0, 1.5, 0.2), closed = layers(Geometry::Planar, 3.0, 1.5, 0.0);
  FilledRegions const without_void = reconstructed(closed.scene), with_void = reconstructed(open.scene);
  EXPECT_EQ(distance(without_void, refilled(closed.scene, closed.scene, with_void)), 0.0);
  EXPECT_EQ(distance(with_void, refilled(open.scene, open.scene, without_void)), 0.0);
}

TEST(Refill, PartedCells_areReconstructed)
{
  Testing::Scene const before = passingCorners(0.1), after = passingCorners(0.13);
  ASSERT_EQ(before.pairs.num_pairs, after.pairs.num_pairs);
  FilledRegions const regions = reconstructed(before);
  int const cell = 6 + 3;
  auto const first = onHost(regions.cell_region);
  auto const component = onHost(regions.cut_component);
  auto const offset = onHost(before.pairs.offset);
  ASSERT_GE(first(cell), 0);
  EXPECT_EQ(component(first(cell)), -1);
  EXPECT_EQ(component(first(cell) + 1), -1);
  EXPECT_EQ(distance(regions, refilled(before, before, regions)), 0.0);

  // Other fractions, then the void of that cell closed: as if there had been no regions before.
  Testing::Scene changed = before, closed = before;
  changed.state.record = after.state.record;
  closed.state.record = View<double *[num_pair_fields]>("record", before.pairs.num_pairs);
  auto const record = Kokkos::create_mirror_view(closed.state.record);
  Kokkos::deep_copy(record, before.state.record);
  double const lower = record(offset(cell) + 1, VolumeFraction);
  record(offset(cell), VolumeFraction) = 1.0 - lower;
  Kokkos::deep_copy(closed.state.record, record);
  for (Testing::Scene const &scene : {changed, closed})
  {
    auto const anew = onHost(reconstructed(scene).polygon);
    auto const kept = onHost(refilled(before, scene, regions).polygon);
    for (int k = 0; k < 2; ++k)
    {
      Region const &a = anew(first(cell) + k), &b = kept(first(cell) + k);
      ASSERT_EQ(a.size, b.size);
      for (int v = 0; v < a.size; ++v)
        EXPECT_EQ(norm(a[v] - b[v]), 0.0);
    }
  }
}
