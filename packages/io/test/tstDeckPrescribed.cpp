// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckReader.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

Deck read(std::vector<std::string> const &overrides = {})
{
  return readDeckText(R"(harmos:
  mesh: {x: {from: 0, to: 1, cells: 8}, y: {from: 0, to: 1, cells: 8}}
  prescribed_velocity: {field: vortex, period: 8, speed: 2}
  materials: {fluid: {eos: stiffened, density: 1, sound_speed: 1}, stone: {eos: rigid, density: 1}}
  bodies: {disc: {material: fluid, shape: disc, center: [0.5, 0.75], radius: 0.15}}
  run: {end_time: 8}
)",
                      "deck.yaml", overrides);
}

std::string message(std::string const &override)
{
  try
  {
    read({override});
  }
  catch (DeckError const &error)
  {
    return error.what();
  }
  return "accepted";
}

void expectRefused(std::string const &override, std::string const &start)
{
  EXPECT_EQ(message(override).substr(0, start.size()), start) << message(override);
}

} // namespace

TEST(DeckPrescribed, jitter_isBelowAQuarterOfACellAndNotForBlocks)
{
  EXPECT_EQ(read().jitter, 0.0);
  EXPECT_EQ(read({"mesh/jitter=0.2", "mesh/jitter_seed=7"}).jitter, 0.2);
  EXPECT_EQ(read({"mesh/jitter=0.2", "mesh/jitter_seed=7"}).jitter_seed, 7);
  expectRefused("mesh/jitter=0.25", "deck.yaml: mesh/jitter: 0.25 is out of range");
  expectRefused("mesh/jitter_seed=-1", "deck.yaml: mesh/jitter_seed: -1 is out of range");
  try
  {
    readDeckText(R"(harmos:
  kinematics: lagrangian
  mesh: {x: {from: 0, to: 1, cells: 8}, y: {from: 0, to: 1, cells: 8}, jitter: 0.1}
  materials: {fluid: {eos: stiffened, density: 1, sound_speed: 1}}
  bodies: {block: {material: fluid, shape: rectangle, center: [0.5, 0.5], size: [0.5, 0.5]}}
  run: {end_time: 8}
)",
                 "deck.yaml", {});
    FAIL();
  }
  catch (DeckError const &error)
  {
    EXPECT_STREQ(error.what(), "deck.yaml: mesh/jitter: the blocks of kinematics lagrangian have none; expected: 0");
  }
}

TEST(DeckPrescribed, everyField_hasItsParameters)
{
  PrescribedField const vortex = read().prescribed;
  EXPECT_EQ(vortex.kind, FieldKind::Vortex);
  EXPECT_EQ(vortex.period, 8.0);
  EXPECT_EQ(vortex.speed, 2.0);
  EXPECT_EQ(vortex.length, 1.0);
  PrescribedField const rotation =
      read({"prescribed_velocity={field: rotation, center: [0.5, 0.25], angular_velocity: 3}"}).prescribed;
  EXPECT_EQ(rotation.kind, FieldKind::Rotation);
  EXPECT_EQ(rotation.centre[1], 0.25);
  EXPECT_EQ(rotation.angular_velocity, 3.0);
  EXPECT_EQ(rotation.period, 0.0);
  EXPECT_EQ(read({"prescribed_velocity={field: translation, velocity: [1, -2]}"}).prescribed.velocity[1], -2.0);
  EXPECT_EQ(read({"prescribed_velocity={field: deformation, corner: [1, -2]}"}).prescribed.corner[1], -2.0);
  EXPECT_EQ(read({"prescribed_velocity={field: none}"}).prescribed.kind, FieldKind::None);
}

TEST(DeckPrescribed, whatMeansNothingWithIt_isRefused)
{
  expectRefused("gravity=[0, -9.81]", "deck.yaml: gravity: it means nothing with a prescribed_velocity");
  expectRefused("bodies/disc/velocity=[1, 0]", "deck.yaml: bodies/disc/velocity: it means nothing");
  expectRefused("bodies/disc/angular_velocity=1", "deck.yaml: bodies/disc/angular_velocity: it means nothing");
  expectRefused("bodies/disc/density=2", "deck.yaml: bodies/disc/density: with a prescribed_velocity the density is");
  expectRefused("bodies/disc/material=stone", "deck.yaml: bodies/disc/material: a rigid law means nothing");
  expectRefused("boundaries/left={type: outflow}", "deck.yaml: boundaries/left/type: material that moves with");
  expectRefused("mesh/smoother/relax=0.1", "deck.yaml: mesh/smoother: it means nothing with a prescribed_velocity");
  expectRefused("interactions/default=bonded", "deck.yaml: interactions: a bond or friction means nothing");
  expectRefused("numerics/remap/return_kinetic_defect=true", "deck.yaml: numerics/remap/return_kinetic_defect: true");
  expectRefused("bodies/disc={material: fluid, shape: rectangle, center: [0.5, 0.5], size: [1, 1]}", "accepted");
}

TEST(DeckPrescribed, kinematicsLagrangian_isRefused)
{
  try
  {
    read(
        {"kinematics=lagrangian", "bodies/disc={material: fluid, shape: rectangle, center: [0.5, 0.5], size: [1, 1]}"});
    FAIL() << "accepted";
  }
  catch (DeckError const &error)
  {
    EXPECT_EQ(std::string(error.what()),
              "deck.yaml: kinematics: lagrangian means nothing with a prescribed_velocity: it has no remap");
  }
}

TEST(DeckPrescribed, parametersOfAnotherField_sayWhereTheyBelong)
{
  expectRefused("prescribed_velocity/angular_velocity=1",
                "deck.yaml: prescribed_velocity/angular_velocity: does not belong here, only where field = rotation");
  expectRefused("prescribed_velocity={field: rotation}",
                "deck.yaml: prescribed_velocity/center: missing; expected: array of 2 numbers [m]");
}

TEST(DeckPrescribed, sliver_belongsToMomentOfFluid)
{
  EXPECT_EQ(read().reconstruction.sliver, 1e-6);
  EXPECT_EQ(read({"numerics/reconstruction/method=least squares"}).reconstruction.sliver, 1.0);
  expectRefused("numerics/reconstruction={method: youngs, sliver: 0.1}",
                "deck.yaml: numerics/reconstruction/sliver: does not belong here, only where method = moment of fluid");
}

TEST(DeckIdleKeys, keysWithoutUseForTheKinematics_areNamedWhereTheyDifferFromTheirDefaults)
{
  EXPECT_TRUE(read().idle_keys.empty());
  EXPECT_TRUE(read({"numerics/remap/order=1", "numerics/constraint/method=multipliers"}).idle_keys.empty());
  std::vector<std::string> const of_mechanics = {"numerics/linear_viscosity", "numerics/constraint/solver"};
  EXPECT_EQ(read({"numerics/linear_viscosity=0.1", "numerics/constraint/solver=row sums"}).idle_keys, of_mechanics);

  auto const blocks = [](std::string const &kinematics, std::vector<std::string> overrides)
  {
    overrides.push_back("kinematics=" + kinematics);
    return readDeckText(R"(harmos:
  mesh: {x: {from: 0, to: 1, cells: 8}, y: {from: 0, to: 1, cells: 8}}
  materials: {fluid: {eos: stiffened, density: 1, sound_speed: 1}}
  bodies: {block: {material: fluid, shape: rectangle, center: [0.5, 0.5], size: [0.5, 0.5]}}
  run: {end_time: 8}
)",
                        "deck.yaml", overrides)
        .idle_keys;
  };
  std::vector<std::string> const given = {"numerics/subzonal_pressure=0.1", "numerics/reconstruction/method=youngs",
                                          "numerics/remap/order=3", "numerics/remap/limiter=range inside"};
  std::vector<std::string> const of_remap = {"numerics/reconstruction/method", "numerics/remap/order"};
  EXPECT_EQ(blocks("lagrangian", given), of_remap);
  for (char const *kinematics : {"xfem", "single"})
    EXPECT_EQ(blocks(kinematics, given), std::vector<std::string>{"numerics/subzonal_pressure"});
  std::vector<std::string> const parted = {"numerics/remap/part_overlaps=false"};
  EXPECT_TRUE(blocks("xfem", parted).empty());
  EXPECT_EQ(blocks("single", parted), std::vector<std::string>{"numerics/remap/part_overlaps"});
}
