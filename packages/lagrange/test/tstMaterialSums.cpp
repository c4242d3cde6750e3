// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

TEST(MaterialSums, TwoMaterials_addUpToTheNodalSums)
{
  // more than one chunk of pairs
  Scene s =
      makeScene(30, 30, 0.2, {elastic(), fluid()},
                [](int i, int) {
                  return i == 14 ? std::vector<Fill>{{0, 0.25}, {1, 0.5}} : std::vector<Fill>{{i < 14 ? 0 : 1, 1.0}};
                });
  disturb(s, 11);
  auto const sums = materialSums(s.mesh, s.pairs, s.state.record, s.state.velocity, 3);
  auto const nodal = kineticSums(s.mesh, s.dof_nodes, s.work.dof_mass, s.state.velocity);
  auto const total = [&](int field) { return sums(0, field) + sums(1, field) + sums(2, field); };
  EXPECT_NEAR(total(SumMass) / nodal.mass, 1.0, 1e-14);
  EXPECT_NEAR(total(SumMomentumX), nodal.momentum[0], 1e-13 * nodal.mass);
  EXPECT_NEAR(total(SumMomentumY), nodal.momentum[1], 1e-13 * nodal.mass);
  EXPECT_NEAR(total(SumAngularMomentum), nodal.angular_momentum, 1e-12 * nodal.mass);
  EXPECT_NEAR(total(SumKineticEnergy) / nodal.kinetic_energy, 1.0, 1e-13);
  EXPECT_NEAR(total(SumInternalEnergy), s.internalEnergy(), 1e-12);
  EXPECT_NEAR(total(SumVolume), 900.0 - 0.25 * 30.0, 0.25 * 30.0); // the mixed column's cells are distorted
  EXPECT_EQ(sums(2, SumMass), 0.0);
}

TEST(MaterialSums, UniformMotion_isMassTimesVelocity)
{
  Scene s = makeScene(4, 4, 0.0, {elastic()}, full);
  s.setVelocity([](int, Vector2) { return Vector2{3.0, -2.0}; });
  auto const r = onHost(s.state.record);
  r(5, PlasticStrain) = 0.7;
  Kokkos::deep_copy(s.state.record, r);
  auto const sums = materialSums(s.mesh, s.pairs, s.state.record, s.state.velocity, 1);
  EXPECT_DOUBLE_EQ(sums(0, SumMass), 32.0);
  EXPECT_DOUBLE_EQ(sums(0, SumVolume), 16.0);
  EXPECT_DOUBLE_EQ(sums(0, SumMomentumX), 96.0);
  EXPECT_DOUBLE_EQ(sums(0, SumKineticEnergy), 0.5 * 32.0 * 13.0);
  EXPECT_DOUBLE_EQ(sums(0, SumAngularMomentum), 2.0 * -64.0 - 2.0 * 96.0);
  EXPECT_EQ(sums(0, PlasticStrainMax), 0.7);
}
