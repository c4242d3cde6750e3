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

/// An elastic body (0) up to x = 0.375 on a 4 x 1 mesh, a material of a gas's law (1) beyond it, its pressure as given;
/// the body's side moves by `by`.
Scene bodyBesideGas(double by, double sound_speed = 0.0)
{
  std::vector<Material> laws = twoLaws();
  laws[1].strength = StrengthKind::None;
  laws[1].eos = sound_speed > 0.0 ? EosKind::Stiffened : EosKind::IdealGas;
  laws[1].sound_speed0 = sound_speed;
  laws[1].density0 = 0.9999;                         // slightly compressed
  laws[1].gruneisen = sound_speed > 0.0 ? 0.0 : 1.4; // of an ideal gas: gamma
  Scene scene(4, 1, 0.0, laws);
  scene.options.close_void_beside_gas = 0.01;
  scene.paint({halfPlane(0, {0.375, 0.0}, 0.0), rest(1)}, one, one);
  scene.move(
      [=](int material, Vector2 const &x) {
        return x[0] > 0.0 && x[0] < 1.0 && material == 0 ? Vector2{by, 0.0} : Vector2{0.0, 0.0};
      });
  return scene;
}

/// Of the pair of a cell, after a remap.
double fieldOf(ResultOnHost const &result, int cell, int material, PairField field)
{
  return result.state.record(result.pairs.find(cell, material), field);
}

double leastFraction(ResultOnHost const &result)
{
  double least = 1.0;
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
    least = std::min(least, result.state.record(pair, VolumeFraction));
  return least;
}

void freeSides(Scene &scene)
{
  Boundary out;
  out.kind = BoundaryKind::Outflow;
  scene.setBoundaries({out, out, out, out});
}

/// A bar 0.2 < x < 0.5 + excess on a 10 x 1 mesh: its front has just entered the cell at 0.5.
Scene barWithSliver(double excess)
{
  Scene scene(10, 1, 0.0, twoLaws());
  freeSides(scene);
  Layer const left{-1, [](Vector2 const &) { return lineThrough({0.2, 0.5}, 0.0); }};
  scene.paint({left, halfPlane(0, {0.5 + excess, 0.5}, 0.0)}, one, one);
  return scene;
}

} // namespace

TEST(Policies, sliverOf1e10_survivesWithoutMerging)
{
  Scene scene = barWithSliver(0.0);
  scene.options.merge_below = 0.0;
  scene.move([](int, Vector2 const &) { return Vector2{1e-11, 0.0}; });
  ResultOnHost const result = scene.remapped();
  EXPECT_NEAR(leastFraction(result), 1e-10, 1e-15);
  EXPECT_EQ(result.pairs.num_pairs, 4);
  Totals const t = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
  EXPECT_NEAR(t.mass, 0.3, 1e-15);
  EXPECT_NEAR(t.momentum[0], 0.3e-11, 1e-25);
}

TEST(Policies, specificVolumeThatRanAway_isBoundedByTheCell)
{
  for (double const excess : {1.0, 1e6})
  {
    Scene scene = barWithSliver(0.02);
    for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
      if (scene.pairs.cell(pair) == 5)
        scene.state.record(pair, SpecificVolume) *= excess;
    scene.move([](int, Vector2 const &) { return Vector2{0.01, 0.0}; });
    ResultOnHost const result = scene.remapped();
    Totals const t = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
    EXPECT_NEAR(t.mass, 0.32, 1e-15);
    EXPECT_NEAR(t.internal, 0.32, 1e-15);
    EXPECT_EQ(scene.report.bounded, excess > 1.0 ? 1 : 0);
    for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
    {
      double const volume = result.state.record(pair, Mass) * result.state.record(pair, SpecificVolume);
      EXPECT_LE(volume, 2.0 * scene.mesh.cell_volume(result.pairs.cell(pair)) * (1.0 + 1e-15));
    }
  }
}

TEST(Policies, fragmentBelowThreshold_mergesWithoutLoss)
{
  Scene scene = barWithSliver(0.0);
  scene.move([](int, Vector2 const &) { return Vector2{1e-8, 0.0}; });
  ResultOnHost const result = scene.remapped();
  EXPECT_EQ(scene.report.merged, 1);
  EXPECT_EQ(result.pairs.num_pairs, 3);
  Totals const t = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
  EXPECT_NEAR(t.mass, 0.3, 1e-15);
  EXPECT_NEAR(t.internal, 0.3, 1e-15);
  EXPECT_NEAR(t.momentum[0], 0.3e-8, 1e-22);
  EXPECT_NEAR(scene.report.overlap_volume, 1e-8, 1e-14);
}

TEST(Policies, fragmentWithoutNeighbour_isKept)
{
  Scene scene(3, 3, 0.0, twoLaws());
  freeSides(scene);
  scene.paint({halfPlane(0, {1e-5, 0.0}, Math::pi / 4.0)}, one, one);
  scene.move([](int, Vector2 const &) { return Vector2{0.01, 0.01}; });
  ResultOnHost const result = scene.remapped();
  ASSERT_EQ(result.pairs.num_pairs, 1);
  EXPECT_EQ(scene.report.merged, 0);
  EXPECT_NEAR(result.state.record(0, Mass), scene.state.record(0, Mass), 1e-22);
}

TEST(Policies, overlappingMaterials_areScaledAndBooked)
{
  Scene scene(4, 1, 0.0, twoLaws());
  scene.paint({halfPlane(0, {0.375, 0.0}, 0.0), rest(1)}, one, one);
  scene.move(
      [](int material, Vector2 const &x) {
        return x[0] > 0.0 && x[0] < 1.0 && material == 0 ? Vector2{0.02, 0.0} : Vector2{0.0, 0.0};
      });
  ResultOnHost const result = scene.remapped();
  EXPECT_NEAR(scene.report.overlap_volume, 0.02, 1e-14);
  EXPECT_NEAR(largestSumOfFractions(scene.mesh, result), 1.0, 1e-15);
  Totals const t = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
  EXPECT_NEAR(t.mass, 1.0, 1e-15);
  EXPECT_NEAR(t.volume, 1.0, 1e-15);
}

TEST(Policies, spuriousGap_isClosedWhenSmallAndBookedWhenLarge)
{
  for (double gap : {1e-4, 0.02})
  {
    Scene scene(4, 1, 0.0, twoLaws());
    scene.options.close_void_below = 1e-3;
    scene.paint({halfPlane(0, {0.375, 0.0}, 0.0), rest(1)}, one, one);
    scene.move(
        [=](int material, Vector2 const &x) {
          return x[0] > 0.0 && x[0] < 1.0 && material == 0 ? Vector2{-gap, 0.0} : Vector2{0.0, 0.0};
        });
    ResultOnHost const result = scene.remapped();
    bool const small = gap < 1e-3;
    EXPECT_NEAR(scene.report.closed_volume, small ? gap : 0.0, 1e-14);
    EXPECT_NEAR(scene.report.void_volume, small ? 0.0 : gap, 1e-14);
    EXPECT_EQ(scene.report.overlap_volume, 0.0);
  }
}

TEST(Policies, gas_takesWhatABodyLeavesOrWants)
{
  constexpr double cell = 0.25, half = 0.125, shared = 1e-6 * cell, gamma = 1.4;
  for (double const by : {-1e-3, -1e-6, -1e-7, 1e-7, 1e-6, 1e-3, 0.01})
  {
    Scene scene = bodyBesideGas(by);
    double const before = scene.state.record(scene.pairs.find(1, 1), SpecificVolume);
    ResultOnHost const result = scene.remapped();
    double const taken = std::copysign(std::max(std::fabs(by) - shared, 0.0), -by);
    double const rest = cell / (cell + by + taken), grown = (half + taken) / half; // rest: what all share
    EXPECT_NEAR(fieldOf(result, 1, 0, VolumeFraction), rest * (half + by) / cell, 1e-14) << by;
    EXPECT_NEAR(fieldOf(result, 1, 1, VolumeFraction), rest * (half + taken) / cell, 1e-14) << by;
    EXPECT_NEAR(fieldOf(result, 1, 1, SpecificVolume), before * grown, 1e-14) << by;
    // at the pressure of the gas around, which has the same energy and density, up to what others count with at most
    EXPECT_NEAR(fieldOf(result, 1, 1, InternalEnergy), 1.0 - (gamma - 1.0) * taken / half, 1e-9 + 0.01 * std::fabs(by))
        << by;
    EXPECT_NEAR(scene.report.closed_volume, std::max(-by, 0.0), 1e-14);
    EXPECT_EQ(scene.report.void_volume, 0.0);
    Totals const t = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
    EXPECT_NEAR(t.mass, 1.0, 1e-15);
    EXPECT_NEAR(t.internal + scene.report.gas_work, 1.0, 1e-14);
    EXPECT_GE(taken * scene.report.gas_work, 0.0);
  }
}

TEST(Policies, gas_takesNoMoreThanATenthOfIt)
{
  Scene opened = bodyBesideGas(-1e-3);
  opened.options.close_void_beside_gas = 3e-3; // 7.5e-4 of the volume
  ResultOnHost const result = opened.remapped();
  EXPECT_EQ(opened.report.closed_volume, 0.0);
  EXPECT_NEAR(opened.report.void_volume, 1e-3, 1e-14);
  EXPECT_NEAR(fieldOf(result, 1, 1, VolumeFraction), 0.5, 1e-14);

  Scene pressed = bodyBesideGas(0.02);
  double const before = pressed.state.record(pressed.pairs.find(1, 1), SpecificVolume);
  ResultOnHost const squeezed = pressed.remapped();
  EXPECT_NEAR(fieldOf(squeezed, 1, 1, SpecificVolume), 0.9 * before, 1e-14);
  EXPECT_NEAR(largestSumOfFractions(pressed.mesh, squeezed), 1.0, 1e-15);
  EXPECT_NEAR(fieldOf(squeezed, 1, 1, VolumeFraction), 0.5 * 0.9 / (1.0 + 0.08 - 0.05), 1e-14);
}

/// Energies per mass of what lies beside a body in half of a cell, and of the body, the cell's energy, and the mass and
/// heat of what lies beside the body, after a remap.
struct CoolingCell
{
  double fluid, body, of_cell, fluid_mass, heat;
};

CoolingCell cooled(double energy, double cool_gas_below, double start_energy, double sound_speed = 0.0,
                   double around = 1.0)
{
  Scene scene = bodyBesideGas(0.01, sound_speed);
  scene.options.close_void_beside_gas = 0.0;
  scene.options.cool_gas_below = cool_gas_below;
  scene.options.start_energy = View<double *>("start_energy", 2);
  Kokkos::deep_copy(scene.options.start_energy, start_energy);
  for (int cell = 2; cell < 4; ++cell)
    scene.state.record(scene.pairs.find(cell, 1), InternalEnergy) = around;
  scene.state.record(scene.pairs.find(1, 1), InternalEnergy) = energy;
  ResultOnHost const result = scene.remapped();
  double of_cell = 0.0;
  for (int pair = result.pairs.offset(1); pair < result.pairs.offset(2); ++pair)
    of_cell += result.state.record(pair, Mass) * result.state.record(pair, InternalEnergy);
  return {fieldOf(result, 1, 1, InternalEnergy), fieldOf(result, 1, 0, InternalEnergy), of_cell,
          fieldOf(result, 1, 1, Mass), scene.report.gas_heat};
}

TEST(Policies, thinGas_isNoWarmerThanTwiceWhatWasOrIsAround)
{
  EXPECT_NEAR(cooled(10.0, 0.6, 0.0).fluid, 2.0, 1e-14);
  EXPECT_NEAR(cooled(10.0, 0.6, 3.0).fluid, 6.0, 1e-14);
  EXPECT_NEAR(cooled(1.9, 0.6, 0.0).fluid, 1.9, 1e-14);
}

TEST(Policies, thinGasWithoutAnythingToCompareWith_keepsItsHeat)
{
  EXPECT_NEAR(cooled(10.0, 0.6, 0.0, 0.0, 0.0).fluid, 10.0, 1e-13);
}

TEST(Policies, heatOfThinGas_goesToWhatLiesBesideIt)
{
  CoolingCell const kept = cooled(10.0, 0.0, 0.0), given = cooled(10.0, 0.6, 0.0);
  EXPECT_NEAR(given.heat, 8.0 * given.fluid_mass, 1e-14);
  EXPECT_EQ(kept.heat, 0.0);
  EXPECT_NEAR(kept.body, 1.0, 1e-14);
  EXPECT_GT(given.body, 2.0);
  EXPECT_NEAR(given.of_cell, kept.of_cell, 1e-14 * kept.of_cell);
}

TEST(Policies, whatIsNoThinGas_keepsItsHeat)
{
  EXPECT_NEAR(cooled(10.0, 0.0, 0.0).fluid, 10.0, 1e-13);
  EXPECT_NEAR(cooled(10.0, 0.4, 0.0).fluid, 10.0, 1e-13);
  EXPECT_NEAR(cooled(10.0, 0.6, 0.0, 1500.0).fluid, 10.0, 1e-13);
}

TEST(Policies, gasThatIsNotAskedTo_takesNothing)
{
  for (double const by : {-1e-3, 0.01})
  {
    Scene scene = bodyBesideGas(by);
    scene.options.close_void_beside_gas = 0.0;
    double const before = scene.state.record(scene.pairs.find(1, 1), SpecificVolume);
    ResultOnHost const result = scene.remapped();
    EXPECT_EQ(fieldOf(result, 1, 1, SpecificVolume), before);
    EXPECT_EQ(scene.report.closed_volume, 0.0);
  }
}

TEST(Policies, liquid_keepsItsDensity)
{
  for (double const by : {-1e-3, 0.01})
  {
    Scene scene = bodyBesideGas(by, 1500.0);
    double const before = scene.state.record(scene.pairs.find(1, 1), SpecificVolume);
    ResultOnHost const result = scene.remapped();
    EXPECT_EQ(fieldOf(result, 1, 1, SpecificVolume), before);
    EXPECT_EQ(scene.report.closed_volume, 0.0);
  }
}

TEST(Policies, rigidBody_takesItsExactVolumeAndPushesNothingOut)
{
  Scene scene = sceneWithRigidBody(one);
  scene.move([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
  ResultOnHost const result = scene.remapped();
  EXPECT_NEAR(scene.report.overlap_volume, 0.01, 1e-14);
  EXPECT_LE(largestSumOfFractions(scene.mesh, result), 1.0 + 1e-15);
  EXPECT_NEAR(totals(scene.mesh, result.pairs, result.state.record, result.state.velocity, 0).mass, 0.4, 1e-15);
  EXPECT_NEAR(totals(scene.mesh, result.pairs, result.state.record, result.state.velocity, 1).volume, 0.61, 1e-14);
  for (int dof = 0; dof < result.dof_nodes.num_dof_nodes; ++dof)
    EXPECT_EQ(result.state.velocity(dof, 0), 0.0);
}

/// What deformable material keeps in a cell that a rigid body covers is all of it, or 1e-10 of the cell.
TEST(Policies, splinterInACellThatARigidBodyCovers_isKeptWithinTheCell)
{
  for (double const part : {5e-11, 1e-10, 2e-10})
  {
    Scene scene = sceneWithRigidBody(one);
    scene.options.merge_below = 0.0;
    scene.move(
        [=](int material, Vector2 const &x) {
          return Vector2{material == 0 && x[0] > 0.1 ? 0.1 + 0.25 * part : 0.0, 0.0};
        });
    ResultOnHost const result = scene.remapped();
    EXPECT_LE(largestSumOfFractions(scene.mesh, result), 1.0);
    for (int row = 0; row < 4; ++row)
    {
      int const cell = 4 * row + 2, pair = result.pairs.find(cell, 0);
      ASSERT_GE(pair, 0);
      EXPECT_NEAR(result.state.record(pair, VolumeFraction), std::min(part, 1e-10), 1e-15);
    }
  }
}

TEST(Policies, emptiedCell_losesItsPairAndDofNodes)
{
  Scene scene = barWithSliver(0.005);
  scene.move([](int, Vector2 const &) { return Vector2{-0.02, 0.0}; });
  ResultOnHost const result = scene.remapped();
  EXPECT_EQ(result.pairs.cell_kind(5), VoidCell);
  EXPECT_EQ(result.pairs.cell_kind(3), PureCell);
  EXPECT_EQ(result.pairs.cell_kind(1), MixedCell);
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
    for (int k = 0; k < 4; ++k)
      EXPECT_EQ(result.dof_nodes.node(result.pairs.dof_node(pair, k)),
                scene.mesh.cell_node(result.pairs.cell(pair), k));
}

TEST(Policies, fragmentBesideAnOutflow_leavesInOneStep)
{
  // 0.97 < x < 1 in the last cell of the bar's mesh.
  for (int order = 1; order <= 3; ++order)
    for (double const step : {0.029, 0.031, 0.05, 0.09})
    {
      Scene scene(10, 1, 0.0, twoLaws());
      freeSides(scene);
      scene.paint({halfPlane(-1, {0.97, 0.5}, 0.0), rest(0)}, one, one);
      scene.options.order = order;
      scene.move([step](int, Vector2 const &) { return Vector2{step, 0.0}; });
      ResultOnHost const result = scene.remapped();
      double const gone = std::min(step, 0.03);
      EXPECT_EQ(result.pairs.num_pairs, gone < 0.03 ? 1 : 0);
      EXPECT_NEAR(scene.report.outflow_mass, gone, 1e-15) << "order " << order << ", step " << step;
      EXPECT_NEAR(scene.report.outflow_momentum[0], gone * step, 1e-15);
      EXPECT_NEAR(scene.report.outflow_energy, gone * (1.0 + 0.5 * step * step), 1e-15);
      EXPECT_EQ(scene.report.overlap_volume, 0.0);
    }
}

TEST(Policies, bodiesAlongCurvedSlipWalls_slideAlongThemAndKeepTheirMass)
{
  // A bend 1 < r < 2, 0 < angle < 1.2 with two bodies and void at both ends, turning about the centre.
  Scene scene(8, 12, 0.0, twoLaws());
  for (auto &x : scene.host_mesh.node)
    x = {(1.0 + x[0]) * std::cos(1.2 * x[1]), (1.0 + x[0]) * std::sin(1.2 * x[1])};
  Boundary wall, out;
  out.kind = BoundaryKind::Outflow;
  scene.setBoundaries({wall, wall, out, out});
  auto const ray = [](int material, double angle) { return halfPlane(material, {0.0, 0.0}, angle + 0.5 * Math::pi); };
  scene.paint({ray(-1, 0.33), ray(0, 0.62), ray(1, 0.87)}, one, one);
  double const turn = 0.03;
  scene.move([&](int, Vector2 const &x) { return turn * perpendicular(x); });
  Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
  ResultOnHost const result = scene.remapped();
  Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
  EXPECT_EQ(scene.report.failures, 0);
  EXPECT_NEAR(after.mass, before.mass, 1e-15);
  EXPECT_NEAR(after.internal, before.internal, 1e-15);
  // Had the walls' nodes been fixed, they would stand still: a fifth of the speed at a wall's cells.
  double worst = 0.0;
  for (int dof = 0; dof < result.dof_nodes.num_dof_nodes; ++dof)
  {
    int const node = result.dof_nodes.node(dof);
    Vector2 const x{scene.mesh.node_position(node, 0), scene.mesh.node_position(node, 1)};
    Vector2 const v{result.state.velocity(dof, 0), result.state.velocity(dof, 1)};
    worst = std::max(worst, norm(v - turn * perpendicular(x)) / turn);
  }
  EXPECT_LT(worst, 0.1);
  // What crosses the chords of the walls is of second order in the turn of a step and in the bend at a node.
  EXPECT_LT(scene.report.overlap_volume + scene.report.void_volume + scene.report.closed_volume, 1e-3);
}
