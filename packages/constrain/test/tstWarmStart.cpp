// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <gtest/gtest.h>

using namespace HarmosTest;

namespace
{

/// Two blocks that meet at an oblique interface, with waves in both.
TinyScene meetingBlocks(Interaction kind, MultiplierMethod solver)
{
  TinyScene scene(
      rectilinearMesh(uniform(12, 12), uniform(6, 6)),
      {polygonBody(0, {{0, 0}, {5.3, 0}, {4.6, 6}, {0, 6}}), polygonBody(1, {{5.3, 0}, {12, 0}, {12, 6}, {4.6, 6}})}, 2,
      open_box, Kinematics::Xfem, {2.0, 3.0});
  PairInteraction law;
  law.kind = kind;
  law.friction = kind == Interaction::Friction ? 0.3 : 0.0;
  scene.setInteraction(0, 1, law);
  scene.options.solver = solver;
  scene.options.tolerance = 1e-10;
  scene.setVelocity(
      [](int material, Vector2 const &x) {
        return Vector2{(material == 0 ? 60.0 : -40.0) * std::cos(0.4 * x[1]), 10.0 * std::sin(x[0])};
      });
  return scene;
}

constexpr Interaction all_kinds[] = {Interaction::Sliding, Interaction::Bonded, Interaction::Friction};

} // namespace

// Begun with the forces of the cycle before, a solver needs hardly an iteration where nothing has changed, and
// elsewhere finds the same velocities; forces that lead astray are left out.
TEST(WarmStart, newtonAndConjugateGradients_findTheSameVelocitiesInFewerIterations)
{
  for (MultiplierMethod const solver : {MultiplierMethod::ProjectedNewton, MultiplierMethod::ConjugateGradients})
    for (Interaction const kind : all_kinds)
    {
      SCOPED_TRACE(testing::Message() << static_cast<int>(solver) << " " << static_cast<int>(kind));
      TinyScene scene = meetingBlocks(kind, solver);
      ConstraintReport const cold = scene.constrain();
      EXPECT_TRUE(cold.force.empty());
      auto const expected = scene.sums(scene.half, 0);
      scene.options.warm_start = true;
      ConstraintReport const first = scene.constrain(); // nothing to begin with
      EXPECT_EQ(first.iterations, cold.iterations);
      EXPECT_FALSE(first.force.empty());
      for (double const factor : {1.0, 0.9, -50.0})
      {
        scene.last = first.force;
        for (ContactForce &force : scene.last)
        {
          force.normal *= factor;
          force.tangential *= factor;
        }
        ConstraintReport const warm = scene.constrain();
        EXPECT_TRUE(warm.converged) << warm.residual;
        // The bounds of friction follow the normal forces, which are known to the tolerance.
        int const unchanged =
            kind == Interaction::Friction && solver == MultiplierMethod::ProjectedNewton ? cold.iterations / 2 : 1;
        // From zero sets on friction's cone need but four or five; from a wrong start they have to turn back first.
        int const changed = cold.iterations + (kind == Interaction::Friction ? 2 : 0);
        EXPECT_LE(warm.iterations, factor == 1.0 ? unchanged : changed) << factor;
        auto const found = scene.sums(scene.half, 0);
        EXPECT_NEAR(found.kinetic, expected.kinetic, 1e-8 * expected.kinetic);
        EXPECT_NEAR(norm(found.momentum - expected.momentum), 0.0, 1e-7 * norm(expected.momentum));
      }
    }
}

TEST(WarmStart, rowSums_goOnWhereTheyEnded)
{
  for (Interaction const kind : all_kinds)
  {
    TinyScene scene = meetingBlocks(kind, MultiplierMethod::RowSums);
    scene.options.tolerance = 1e-14; // is not reached
    scene.options.warm_start = true;
    scene.options.max_iterations = 40;
    ConstraintReport const whole = scene.constrain();
    scene.options.max_iterations = 20;
    ConstraintReport const half = scene.constrain();
    scene.last = half.force;
    ConstraintReport const rest = scene.constrain();
    EXPECT_GT(std::fabs(rest.residual - half.residual), 1e-3 * half.residual);
    EXPECT_NEAR(rest.residual, whole.residual, 1e-10 * whole.residual) << static_cast<int>(kind);
  }
}
