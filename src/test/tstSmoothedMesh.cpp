// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectKept.hpp"

#include <Harmos_SmoothedMesh.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace Harmos;
using namespace Harmos::Test;

TEST(SmoothedMesh, thatFollowsTheMaterial_keepsMassMomentumAndEnergyAndTheMotion)
{
  Impact still, moving;
  MaterialSums const before = moving.sums();
  auto const start = moving.scene.mesh.node_position;
  moving.scene.target_mesh = smoothedMesh({1.0, 0.05}, moving.scene.boundary, moving.alone);
  still.run(2e-4);
  moving.run(2e-4);
  ASSERT_EQ(moving.failures, 0);
  double farthest = 0.0;
  for (int node = 0; node < moving.scene.mesh.num_nodes; ++node)
    farthest = std::max(farthest, std::fabs(moving.scene.mesh.node_position(node, 0) - start(node, 0)));
  EXPECT_GT(farthest, 0.025); // a cell
  expectKept(before, moving, still, 0.02);
}

TEST(SmoothedMesh, stepThatWouldFoldTheMesh_isHalvedOrLeftOut)
{
  Impact folding;
  auto const position = folding.scene.mesh.node_position;
  // A node almost on its right neighbour: half of the way back to the middle is farther than what lies around it.
  int const node = 41 * 20 + 20;
  position(node, 0) += 0.024;
  updateGeometry(folding.scene.mesh);
  computeNodeAltitudes(folding.scene.mesh, folding.state.work);
  folding.state.dt = folding.scene.max_dt = 1e-8;
  folding.scene.target_mesh = smoothedMesh({0.0, 1.0}, folding.scene.boundary, folding.alone);
  ASSERT_EQ(countInvertedCells(folding.scene.mesh), 0);
  for (int cycle = 0; cycle < 5; ++cycle)
  {
    advance(folding.scene, folding.state, folding.times);
    ASSERT_EQ(countInvertedCells(folding.scene.mesh), 0);
  }
  EXPECT_LT(folding.scene.mesh.node_position(node, 0), 0.524);
}

TEST(TimeStep, motionAlongTheDiagonalByMoreThanSweptFacesBear_repeatsTheCycle)
{
  Impact falling;
  // From rest to 0.85 of a cell along the diagonal within the step: the first one's forces act for half of it.
  Kokkos::deep_copy(falling.state.state.velocity, 0.0);
  double const h = 0.025, dt = 0.2 * falling.state.dt;
  falling.state.dt = dt;
  double const g = 2.0 * 0.85 * h / std::sqrt(2.0) / (dt * dt);
  falling.scene.lagrange.gravity = {g, g};
  CycleReport const report = advance(falling.scene, falling.state, falling.times);
  EXPECT_GE(report.repeats, 1);
  EXPECT_EQ(report.remap.failures, 0);
  EXPECT_LE(report.dt, 0.5 * dt);
}
