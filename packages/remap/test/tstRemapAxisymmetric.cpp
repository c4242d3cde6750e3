// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

double one(int, Vector2 const &)
{
  return 1.0;
}

/// Integral of r (2 + 0.7 r - 0.9 z) over a cell.
double linearMass(Quadrilateral const &q)
{
  Moments<1> const m = moments<1>(q, Vector2{0.0, 0.0}, areaWeight(Geometry::Axisymmetric, {0.0, 0.0}));
  return 2.0 * m.volume() + 0.7 * m.first(0) - 0.9 * m.first(1);
}

Quadrilateral movedCell(Scene const &scene, int pair)
{
  Quadrilateral q = cellQuadrilateral(scene.mesh, scene.pairs.cell(pair));
  for (int k = 0; k < 4; ++k)
    for (int d = 0; d < 2; ++d)
      q[k][d] += scene.dt * scene.half(scene.pairs.dof_node(pair, k), d);
  return q;
}

Vector2 wobble(int, Vector2 const &x)
{
  return {0.02 * std::sin(9.0 * x[0] + 4.0 * x[1]), 0.02 * std::cos(7.0 * x[1] - 3.0 * x[0])};
}

/// Mass of a linear density field after a remap of pure cells by one of the two stages: largest error, of a cell's
/// mass.
double linearFieldError(bool swept)
{
  Scene scene(12, 10, 0.2, twoLaws());
  scene.aboutAxis();
  scene.options.swept_faces = swept;
  scene.options.limiter = RemapLimiter::None;
  scene.paint({rest(0)}, one, one);
  scene.move(wobble);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
    scene.state.record(pair, Mass) = linearMass(movedCell(scene, pair));
  RemapResult const result = scene.remapped();
  double worst = 0.0;
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
  {
    double const exact = linearMass(cellQuadrilateral(scene.mesh, result.pairs.cell(pair)));
    worst = std::max(worst, std::fabs(result.state.record(pair, Mass) / exact - 1.0));
  }
  return worst;
}

} // namespace

TEST(RemapAxisymmetric, LinearDensityThroughSweptFaces_isExact)
{
  EXPECT_LT(linearFieldError(true), 1e-12);
}

TEST(RemapAxisymmetric, LinearDensityThroughIntersections_isExact)
{
  EXPECT_LT(linearFieldError(false), 1e-12);
}

TEST(RemapAxisymmetric, AxialDriftOfTwoRings_keepsConstantsAndVolumes)
{
  Scene scene(10, 12, 0.2, twoLaws(), BoundaryKind::Outflow);
  scene.aboutAxis();
  scene.paint({disc(1, {0.0, 0.45}, 0.27), rest(-1)}, one, one);
  scene.move([](int, Vector2 const &) { return Vector2{0.0, 0.017}; });
  Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
  RemapResult const result = scene.remapped();
  Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
  EXPECT_NEAR(after.mass, before.mass, 1e-15);
  EXPECT_NEAR(after.volume, before.volume, 1e-14);
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
  {
    double const whole = scene.mesh.cell_volume(result.pairs.cell(pair));
    EXPECT_NEAR(result.state.record(pair, Mass), result.state.record(pair, VolumeFraction) * whole, 1e-13 * whole);
  }
  for (int dof = 0; dof < result.dof_nodes.num_dof_nodes; ++dof)
    EXPECT_NEAR(result.state.velocity(dof, 1), 0.017, 1e-15);
  EXPECT_EQ(scene.report.failures, 0);
}

TEST(RemapAxisymmetric, TwoMaterialsInAnyMotion_keepMassEnergyAndAxialMomentum)
{
  for (bool const swept : {false, true})
  {
    Scene scene(14, 12, 0.2, twoLaws());
    scene.aboutAxis();
    scene.options.swept_faces = swept;
    scene.paint({disc(1, {0.0, 0.45}, 0.27), rest(0)}, wave, wave);
    scene.move(wobble);
    Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
    RemapResult const result = scene.remapped();
    Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
    EXPECT_NEAR(after.mass, before.mass, 1e-14);
    EXPECT_NEAR(after.internal, before.internal, 1e-14);
    EXPECT_NEAR(after.momentum[1] - scene.report.wall_impulse[1], before.momentum[1], 1e-15);
    EXPECT_GT(before.kinetic - after.kinetic, 0.0);
    EXPECT_NEAR(largestSumOfFractions(scene.mesh, result), 1.0, 1e-12);
    EXPECT_EQ(scene.report.failures, 0);
  }
}

TEST(RemapAxisymmetric, ThirdOrder_isRefused)
{
  Scene scene(4, 4, 0.0, twoLaws());
  scene.aboutAxis();
  scene.paint({rest(0)}, one, one);
  scene.move(wobble);
  scene.options.swept_faces = false;
  scene.options.order = 3;
  EXPECT_THROW(scene.remapped(), std::runtime_error);
}
