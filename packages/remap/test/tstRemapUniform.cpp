// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

double density(int material, Vector2 const &)
{
  return 1.5 + material;
}
double energy(int material, Vector2 const &)
{
  return 0.7 - 0.2 * material;
}
Vector2 drift(int, Vector2 const &)
{
  return {0.017, 0.011};
}

/// Every pair and dof node keeps the constants it began with; full cells stay full.
void expectUniform(Scene &scene)
{
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
  {
    scene.state.record(pair, PlasticStrain) = 0.25;
    scene.state.record(pair, DeviatorXX) = 0.1;
    scene.state.record(pair, DeviatorYY) = -0.3;
    scene.state.record(pair, DeviatorXY) = 0.2;
  }
  ResultOnHost const result = scene.remapped();
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
  {
    int const m = result.pairs.material(pair);
    double const volume = result.state.record(pair, VolumeFraction) * scene.mesh.cell_area(result.pairs.cell(pair));
    EXPECT_NEAR(result.state.record(pair, Mass), density(m, {}) * volume,
                1e-13 * scene.mesh.cell_area(result.pairs.cell(pair)));
    EXPECT_NEAR(result.state.record(pair, SpecificVolume), 1.0 / density(m, {}), 1e-13);
    EXPECT_NEAR(result.state.record(pair, InternalEnergy), energy(m, {}), 1e-13);
    EXPECT_NEAR(result.state.record(pair, PlasticStrain), 0.25, 1e-13);
    EXPECT_NEAR(result.state.record(pair, DeviatorXX), 0.1, 1e-13);
    EXPECT_NEAR(result.state.record(pair, DeviatorYY), -0.3, 1e-13);
    EXPECT_NEAR(result.state.record(pair, DeviatorXY), 0.2, 1e-13);
  }
  for (int dof = 0; dof < result.dof_nodes.num_dof_nodes; ++dof)
    for (int d = 0; d < 2; ++d)
      EXPECT_NEAR(result.state.velocity(dof, d), drift(0, {})[d], 1e-13 * 0.02);
  EXPECT_NEAR(scene.report.kinetic_loss, 0.0, 1e-15);
  EXPECT_EQ(scene.report.failures, 0);
  EXPECT_EQ(scene.report.void_volume, 0.0);
  EXPECT_EQ(scene.report.overlap_volume, 0.0);
}

/// A box whose left and bottom sides let the same material in and whose other sides let it out.
void openBox(Scene &scene, int inflow_material)
{
  Boundary in, out;
  in.kind = BoundaryKind::Inflow;
  in.velocity = drift(0, {});
  in.material = inflow_material;
  in.specific_volume = 1.0 / density(inflow_material, {});
  in.internal_energy = energy(inflow_material, {});
  out.kind = BoundaryKind::Outflow;
  scene.setBoundaries({in, out, in, out});
}

} // namespace

TEST(Uniform, twoMaterialsDriftInPeriodlessBox_stayUniform)
{
  Scene scene(12, 11, 0.2, twoLaws());
  Boundary free;
  free.kind = BoundaryKind::Outflow;
  scene.setBoundaries({free, free, free, free});
  scene.paint({disc(0, {0.45, 0.5}, 0.25), disc(1, {0.5, 0.5}, 0.35)}, density, energy);
  scene.move(drift);
  expectUniform(scene);
  EXPECT_EQ(scene.report.outflow_mass, 0.0);
}

TEST(Uniform, threeMaterialsMeetingInVoid_stayUniform)
{
  for (int order : {1, 2})
    for (Kinematics kinematics : {Kinematics::Xfem, Kinematics::Single})
    {
      Scene scene(12, 11, 0.2, twoLaws());
      Boundary free;
      free.kind = BoundaryKind::Outflow;
      scene.setBoundaries({free, free, free, free});
      scene.kinematics = kinematics;
      scene.options.order = order;
      scene.options.merge_below = 0.0;
      Layer const nothing{-1, [](Vector2 const &) { return lineThrough({0.12, 0.5}, 0.1); }};
      Layer const none_above{-1, [](Vector2 const &) { return lineThrough({0.5, 0.87}, -1.4); }};
      scene.paint({nothing, none_above, halfPlane(2, {0.4, 0.4}, 2.0), halfPlane(0, {0.5, 0.5}, 0.4),
                   halfPlane(1, {0.75, 0.7}, 0.3)},
                  density, energy);
      scene.move(drift);
      expectUniform(scene);
    }
}

TEST(Uniform, pureRegionThroughOpenBox_staysFullAndBooksItsFlow)
{
  Scene scene(9, 8, 0.2, twoLaws());
  openBox(scene, 0);
  scene.paint({rest(0)}, density, energy);
  scene.move(drift);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
    for (int f : {PlasticStrain, DeviatorXX, DeviatorYY, DeviatorXY})
      scene.state.record(pair, f) = 0.0;
  ResultOnHost const result = scene.remapped();
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
  {
    EXPECT_EQ(result.state.record(pair, VolumeFraction), 1.0);
    EXPECT_NEAR(result.state.record(pair, Mass) / scene.mesh.cell_area(result.pairs.cell(pair)), 1.5, 1e-13)
        << "cell " << result.pairs.cell(pair);
    EXPECT_NEAR(result.state.record(pair, InternalEnergy), 0.7, 1e-13);
  }
  EXPECT_NEAR(scene.report.outflow_mass, 0.0, 1e-14);
  EXPECT_NEAR(scene.report.outflow_energy, 0.0, 1e-14);
  EXPECT_NEAR(scene.report.kinetic_loss, 0.0, 1e-14);
}

TEST(Uniform, materialThatLeaves_isBookedAsOutflow)
{
  Scene scene(9, 8, 0.2, twoLaws(), BoundaryKind::Outflow);
  scene.paint({disc(0, {0.7, 0.6}, 0.35)}, density, energy);
  scene.move(drift);
  ResultOnHost const result = scene.remapped();
  Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
  Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
  EXPECT_GT(scene.report.outflow_mass, 1e-3);
  EXPECT_NEAR(after.mass + scene.report.outflow_mass, before.mass, 1e-14);
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d] + scene.report.outflow_momentum[d], before.momentum[d], 1e-15);
  EXPECT_NEAR(after.internal + after.kinetic + scene.report.outflow_energy, before.internal + before.kinetic, 1e-14);
  EXPECT_EQ(scene.report.failures, 0);
}

TEST(Uniform, velocitiesThatFadeToTheSmallestNumbers_leaveNumbers)
{
  for (double const least : {1e-290, 1e-305, 1e-308, 1e-315})
  {
    Scene scene(12, 12, 0.1, {Material{}});
    scene.paint({rest(0)}, density, energy);
    scene.move([least](int, Vector2 const &x) { return Vector2{least * (1.0 - 1.7 * x[1]), least * (x[0] - 0.6)}; });
    ResultOnHost const result = scene.remapped();
    for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
      for (int f = 0; f < num_pair_fields; ++f)
        EXPECT_EQ(result.state.record(pair, f), scene.state.record(pair, f)) << least;
  }
}
