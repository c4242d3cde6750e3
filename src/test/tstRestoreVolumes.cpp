// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_RestoreVolumes.hpp>

#include <Harmos_MeshBuilder.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace Harmos;

namespace
{

// Cells of 0.5 x 1, left to right: |0|0,1|0,1,void|1|1,void|void|; the fractions of each are given by the test.
struct Scene
{
  Mesh mesh = buildMesh(rectilinearMesh({0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0}, {0.0, 1.0}));
  CellMaterialPairs pairs;
  View<double *[num_pair_fields]> record;
  Exchange exchange;

  explicit Scene(std::vector<std::array<double, 2>> const &fraction)
  {
    std::vector<int> offset{0}, material, cell;
    std::vector<double> f;
    for (std::size_t c = 0; c < fraction.size(); ++c)
    {
      for (int m = 0; m < 2; ++m)
        if (fraction[c][m] > 0.0)
        {
          material.push_back(m);
          cell.push_back(static_cast<int>(c));
          f.push_back(fraction[c][m]);
        }
      offset.push_back(static_cast<int>(material.size()));
    }
    pairs.num_pairs = static_cast<int>(f.size());
    pairs.offset = deviceCopy("offset", offset);
    pairs.material = deviceCopy("material", material);
    pairs.cell = deviceCopy("cell", cell);
    record = View<double *[num_pair_fields]>("record", f.size());
    auto host = Kokkos::create_mirror_view(record);
    for (std::size_t i = 0; i < f.size(); ++i)
      host(i, VolumeFraction) = f[i];
    Kokkos::deep_copy(record, host);
    buildDofNodes(mesh, Kinematics::Xfem, record, pairs);
  }

  std::vector<double> volumes() const { return materialVolumes(mesh, pairs, record, 2, exchange); }

  double fraction(int cell, int material) const
  {
    auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), record);
    auto const offset = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), pairs.offset);
    auto const of = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), pairs.material);
    for (int pair = offset(cell); pair < offset(cell + 1); ++pair)
      if (of(pair) == material)
        return host(pair, VolumeFraction);
    return 0.0;
  }
};

std::vector<std::array<double, 2>> const mixture = {{1.0, 0.0}, {0.3, 0.7},  {0.2, 0.5},
                                                    {0.0, 1.0}, {0.0, 1e-9}, {0.0, 0.0}};

} // namespace

TEST(RestoreVolumes, twoMaterialsAndVoid_getTheirVolumesAndCellsStayFull)
{
  Scene scene(mixture);
  std::vector<double> target = scene.volumes();
  EXPECT_NEAR(target[0], 0.75, 1e-15);
  EXPECT_NEAR(target[1], 1.1 + 5e-10, 1e-15);
  target[0] += 1e-3;
  target[1] -= 2e-3;
  RestoredVolumes const done = restoreVolumes(scene.mesh, scene.pairs, scene.record, target, scene.exchange);
  EXPECT_NEAR(done.moved, 3e-3, 1e-15);
  EXPECT_LE(done.iterations, 5);
  std::vector<double> const now = scene.volumes();
  EXPECT_NEAR(now[0], target[0], 1e-15);
  EXPECT_NEAR(now[1], target[1], 1e-15);
  EXPECT_EQ(scene.fraction(0, 0), 1.0);
  EXPECT_EQ(scene.fraction(3, 1), 1.0);
  EXPECT_EQ(scene.fraction(1, 0) + scene.fraction(1, 1), 1.0);
  EXPECT_GT(scene.fraction(1, 0), 0.3);
  EXPECT_GT(scene.fraction(4, 1), 0.0);
  EXPECT_LT(scene.fraction(2, 0) + scene.fraction(2, 1), 1.0);
}

TEST(RestoreVolumes, noVoidAnywhere_whatOneMaterialGainsTheOtherLoses)
{
  Scene scene({{1.0, 0.0}, {0.3, 0.7}, {0.9, 0.1}, {0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}});
  std::vector<double> target = scene.volumes();
  target[0] -= 1e-3;
  target[1] += 1e-3;
  restoreVolumes(scene.mesh, scene.pairs, scene.record, target, scene.exchange);
  std::vector<double> const now = scene.volumes();
  EXPECT_NEAR(now[0], target[0], 1e-15);
  EXPECT_NEAR(now[1], target[1], 1e-15);
  EXPECT_EQ(scene.fraction(2, 0) + scene.fraction(2, 1), 1.0);
}

TEST(RestoreVolumes, nothingMissing_changesNoBit)
{
  Scene scene(mixture);
  restoreVolumes(scene.mesh, scene.pairs, scene.record, scene.volumes(), scene.exchange);
  for (int cell = 0; cell < 6; ++cell)
    for (int m = 0; m < 2; ++m)
      EXPECT_EQ(scene.fraction(cell, m), mixture[cell][m]) << cell << ' ' << m;
}

TEST(RestoreVolumes, smallChange_isSharedLikeFractionTimesVoid)
{
  Scene scene({{1.0, 0.0}, {0.5, 0.0}, {0.1, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}});
  std::vector<double> target = scene.volumes();
  target[0] += 1e-7;
  restoreVolumes(scene.mesh, scene.pairs, scene.record, target, scene.exchange);
  EXPECT_NEAR((scene.fraction(1, 0) - 0.5) / (scene.fraction(2, 0) - 0.1), 0.25 / 0.09, 1e-5);
}

TEST(RestoreVolumes, noMixedCellThatCouldTakeIt_isAnError)
{
  Scene scene({{1.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.0, 1.0}, {0.0, 0.0}, {0.0, 0.0}});
  std::vector<double> target = scene.volumes();
  target[0] += 1e-6;
  EXPECT_THROW(restoreVolumes(scene.mesh, scene.pairs, scene.record, target, scene.exchange), std::runtime_error);
}
