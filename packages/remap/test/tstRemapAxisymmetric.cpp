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

/// Integral of r (2 + 0.7 r - 0.9 z + curvature (1.1 r^2 - 1.4 r z + 0.6 z^2)) over a cell.
double massOf(Quadrilateral const &q, double curvature)
{
  Moments<2> const m = moments<2>(q, Vector2{0.0, 0.0}, areaWeight(Geometry::Axisymmetric, {0.0, 0.0}));
  return 2.0 * m.volume() + 0.7 * m.first(0) - 0.9 * m.first(1) +
         curvature * (1.1 * m.second(0, 0) - 1.4 * m.second(0, 1) + 0.6 * m.second(1, 1));
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

/// A density or (uniform density) a specific energy after a remap of pure cells by one of the two stages: the largest
/// error of a cell, relative. Of linear fields by second order; of quadratic ones by third order, `rim` from the sides,
/// where cells have the neighbours that a fit needs.
double fieldError(int order, bool swept, int field, double jitter, double rim)
{
  Scene scene(12, 10, jitter, twoLaws());
  scene.aboutAxis();
  scene.options.order = order;
  scene.options.swept_faces = swept;
  scene.options.limiter = RemapLimiter::None;
  scene.paint({rest(0)}, one, one);
  scene.move([](int, Vector2 const &x) { return x[1] > 0.35 ? wobble(0, x) : Vector2{0.0, 0.0}; });
  double const curvature = order - 2.0;
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
  {
    Quadrilateral const q = movedCell(scene, pair);
    scene.state.record(pair, Mass) = field == Mass ? massOf(q, curvature) : volume(q, Geometry::Axisymmetric);
    if (field != Mass)
      scene.state.record(pair, field) = massOf(q, curvature) / volume(q, Geometry::Axisymmetric);
  }
  ResultOnHost const result = scene.remapped();
  double worst = 0.0;
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
  {
    Quadrilateral const q = cellQuadrilateral(scene.mesh, result.pairs.cell(pair));
    if (q[0][0] < rim || q[0][1] < rim || q[2][0] > 1.0 - rim || q[2][1] > 1.0 - rim)
      continue;
    double const got = result.state.record(pair, field) * (field == Mass ? 1.0 : volume(q, Geometry::Axisymmetric));
    worst = std::max(worst, std::fabs(got / massOf(q, curvature) - 1.0));
  }
  return worst;
}

} // namespace

TEST(RemapAxisymmetric, LinearDensityThroughSweptFaces_isExact)
{
  EXPECT_LT(fieldError(2, true, Mass, 0.2, 0.0), 1e-12);
}

TEST(RemapAxisymmetric, LinearDensityThroughIntersections_isExact)
{
  EXPECT_LT(fieldError(2, false, Mass, 0.2, 0.0), 1e-12);
}

TEST(RemapAxisymmetric, QuadraticFieldsByThirdOrder_areExactOnRegularAndRandomMeshes)
{
  for (bool const swept : {false, true})
    for (int const field : {static_cast<int>(Mass), static_cast<int>(InternalEnergy)})
      for (double const jitter : {0.0, 0.2})
        EXPECT_LT(fieldError(3, swept, field, jitter, 0.15), 1e-12) << swept << field << jitter;
}

TEST(RemapAxisymmetric, AxialDriftOfTwoRings_keepsConstantsAndVolumes)
{
  Scene scene(10, 12, 0.2, twoLaws(), BoundaryKind::Outflow);
  scene.aboutAxis();
  scene.paint({disc(1, {0.0, 0.45}, 0.27), rest(-1)}, one, one);
  scene.move([](int, Vector2 const &) { return Vector2{0.0, 0.017}; });
  Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
  ResultOnHost const result = scene.remapped();
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

TEST(RemapAxisymmetric, StreamThroughOpenEnds_staysFullAndBooksItsFlow)
{
  Scene scene(9, 8, 0.2, twoLaws());
  scene.aboutAxis();
  double const speed = 0.017;
  Boundary wall, in, out;
  in.kind = BoundaryKind::Inflow;
  in.velocity = {0.0, speed};
  in.material = 0;
  in.specific_volume = 1.0;
  in.internal_energy = 1.0;
  out.kind = BoundaryKind::Outflow;
  scene.setBoundaries({wall, wall, in, out});
  scene.paint({rest(0)}, one, one);
  scene.move([=](int, Vector2 const &) { return Vector2{0.0, speed}; });
  ResultOnHost const result = scene.remapped();
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
  {
    double const whole = scene.mesh.cell_volume(result.pairs.cell(pair));
    EXPECT_EQ(result.state.record(pair, VolumeFraction), 1.0);
    EXPECT_NEAR(result.state.record(pair, Mass), whole, 1e-13 * whole);
    EXPECT_NEAR(result.state.record(pair, SpecificVolume), 1.0, 1e-13);
  }
  EXPECT_NEAR(scene.report.outflow_mass, 0.0, 1e-15);
  EXPECT_NEAR(scene.report.outflow_energy, 0.0, 1e-15);
}

TEST(RemapAxisymmetric, EdgesThatCrossNextToANodeAlmostAtRest_leaveFiniteFields)
{
  // ahead of a wave velocities fade: the triangle at such a node is smaller than what has a reciprocal
  for (double const faint : {1e-140, 1e-150, 1e-160, 1e-170, 1e-200})
  {
    Scene scene(8, 8, 0.2, twoLaws());
    scene.aboutAxis();
    scene.paint({rest(0)}, one, one);
    scene.move(
        [&](int, Vector2 const &x) {
          return std::fmod(8.0 * x[0] + 8.0 * x[1] + 0.5, 2.0) < 1.0 ? Vector2{faint, faint} : Vector2{-1e-18, -1e-18};
        });
    ResultOnHost const result = scene.remapped();
    for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
      for (int field = 0; field < num_pair_fields; ++field)
        ASSERT_TRUE(std::isfinite(result.state.record(pair, field))) << faint << " " << pair << " " << field;
  }
}

TEST(RemapAxisymmetric, UniformExpansionFromWalls_keepsItsForm)
{
  // v = c x becomes v = c x / (1 + c dt) in every node, those next to the axis and to the walls too
  double const c = 0.01;
  for (bool const ring : {false, true})
  {
    Scene scene(10, 10, 0.0, twoLaws());
    if (ring)
      scene.aboutAxis();
    scene.paint({rest(0)}, one, one);
    scene.move([&](int, Vector2 const &x) { return c * x; });
    ResultOnHost const result = scene.remapped();
    double worst = 0.0;
    for (int dof = 0; dof < result.dof_nodes.num_dof_nodes; ++dof)
      for (int d = 0; d < 2; ++d)
      {
        int const node = result.dof_nodes.node(dof);
        Vector2 const x{scene.mesh.node_position(node, 0), scene.mesh.node_position(node, 1)};
        if (x[0] < 0.75 && x[1] < 0.75 && x[d] > 0.05)
          worst = std::max(worst, std::fabs(result.state.velocity(dof, d) / (c / (1.0 + c) * x[d]) - 1.0));
      }
    EXPECT_LT(worst, 2.0 * c * c) << (ring ? "about the axis" : "in the plane");
  }
}

TEST(RemapAxisymmetric, TwoMaterialsInAnyMotion_keepMassEnergyAndAxialMomentum)
{
  for (int const variant : {0, 1, 2, 3})
  {
    Scene scene(14, 12, 0.2, twoLaws());
    scene.aboutAxis();
    scene.options.swept_faces = variant % 2 == 1;
    scene.options.order = variant < 2 ? 2 : 3;
    scene.paint({disc(1, {0.0, 0.45}, 0.27), rest(0)}, wave, wave);
    scene.move(wobble);
    Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
    ResultOnHost const result = scene.remapped();
    Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
    EXPECT_NEAR(after.mass, before.mass, 1e-14);
    EXPECT_NEAR(after.internal, before.internal, 1e-14);
    EXPECT_NEAR(after.momentum[1] - scene.report.wall_impulse[1], before.momentum[1], 1e-15);
    EXPECT_GT(before.kinetic - after.kinetic, 0.0);
    EXPECT_NEAR(largestSumOfFractions(scene.mesh, result), 1.0, 1e-12);
    EXPECT_EQ(scene.report.failures, 0);
  }
}

TEST(RemapAxisymmetric, ContourHessians_keepTheirOrderAwayFromTheAxis)
{
  double error[2];
  for (int const i : {0, 1})
  {
    Scene scene(16 << i, 16 << i, 0.0, twoLaws());
    scene.aboutAxis();
    scene.options.swept_faces = false;
    scene.options.order = 3;
    scene.options.limiter = RemapLimiter::None;
    scene.options.hessian = RemapHessian::Contour;
    scene.paint({rest(0)}, one, one);
    scene.move([&](int, Vector2 const &x) { return (1.0 / (1 << i)) * wobble(0, x); });
    error[i] = 0.0;
    for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
      scene.state.record(pair, Mass) = massOf(movedCell(scene, pair), 1.0);
    ResultOnHost const result = scene.remapped();
    for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
    {
      Quadrilateral const q = cellQuadrilateral(scene.mesh, result.pairs.cell(pair));
      if (q[0][0] > 0.2 && q[0][1] > 0.2 && q[2][0] < 0.8 && q[2][1] < 0.8)
        error[i] = std::max(error[i], std::fabs(result.state.record(pair, Mass) / massOf(q, 1.0) - 1.0));
    }
    EXPECT_EQ(scene.report.failures, 0);
  }
  std::printf("contour integrals about the axis: %.3e, %.3e, slope %.2f\n", error[0], error[1],
              std::log2(error[0] / error[1]));
  EXPECT_GT(std::log2(error[0] / error[1]), 2.8);
}
