// SPDX-License-Identifier: BSD-3-Clause
#include "Impact.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

/// What the start of a scene says that `spoil` has made incomplete.
template <class Spoil>
std::string refusal(Spoil const &spoil)
{
  Impact impact;
  spoil(impact.scene, impact.state);
  try
  {
    startCycle(impact.scene, impact.state);
  }
  catch (std::runtime_error const &error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(StartCycle, NamesWhatASceneLacks)
{
  EXPECT_NE(refusal([](Scene &s, CycleState &) { s.exchange = nullptr; }).find("scene.exchange"), std::string::npos);
  EXPECT_NE(refusal([](Scene &s, CycleState &) { s.constraint.interaction = {}; }).find("0 x 0; expected: 2 x 2"),
            std::string::npos);
  EXPECT_NE(refusal([](Scene &s, CycleState &) { s.boundary = {}; }).find("scene.boundary"), std::string::npos);
  EXPECT_NE(refusal([](Scene &, CycleState &s) { s.pairs = {}; }).find("state.pairs"), std::string::npos);
  EXPECT_NE(refusal([](Scene &, CycleState &s) { s.state.velocity = {}; }).find("state.state.velocity"),
            std::string::npos);
}

TEST(StartCycle, NamesAMaterialThatTheSceneDoesNotHave)
{
  std::string const text = refusal(
      [](Scene &s, CycleState &)
      {
        s.materials = deviceCopy("materials", std::vector<Material>{metal(8930.0)});
        s.constraint.interaction = View<PairInteraction **>("interaction", 1, 1);
      });
  EXPECT_NE(text.find("names material 1; expected: less than 1"), std::string::npos) << text;
}

TEST(StartCycle, RefusesLongCellsOnSeveralRanksAlone)
{
  struct Two : Exchange
  {
    int size() const override { return 2; }
  } const two;
  std::vector<double> const lines = gradedCoordinates(0.0, 1.0, 40, 1.0);
  for (double const height : {0.2, 4.0 / 40.0, 0.25})
  {
    Impact impact;
    impact.scene.mesh = buildMesh(rectilinearMesh(lines, {0.0, height}));
    impact.scene.boundary = buildBoundaryConditions(impact.scene.mesh, impact.scene.boundary.boundary);
    impact.scene.exchange = &two;
    std::string said;
    try
    {
      startCycle(impact.scene, impact.state);
    }
    catch (std::runtime_error const &error)
    {
      said = error.what();
    }
    EXPECT_EQ(said.find("aspect ratio above 4") != std::string::npos, height > 0.1) << height << said;
  }
}

TEST(StartCycle, DamageIsTrackedWhereALawCanFail)
{
  Impact impact;
  EXPECT_FALSE(impact.state.state.tracks_damage);
  Material brittle = metal(8930.0);
  brittle.failure.spall_pressure = 1e9;
  impact.scene.materials = deviceCopy("materials", std::vector<Material>{brittle, metal(2700.0)});
  startCycle(impact.scene, impact.state);
  EXPECT_TRUE(impact.state.state.tracks_damage);
  EXPECT_EQ(static_cast<int>(impact.state.state.damage.extent(0)), impact.state.pairs.num_pairs);
}

TEST(StartCycle, GivesTheStableStepOfSoundOverACell)
{
  Impact impact;
  Material const m = metal(2700.0);
  double const c = std::sqrt(m.sound_speed0 * m.sound_speed0 + 4.0 * m.shear_modulus / (3.0 * m.density0));
  double const stable = impact.scene.lagrange.courant / 40.0 / c;
  EXPECT_LT(impact.state.dt, 1.05 * stable);
  EXPECT_GT(impact.state.dt, 0.5 * stable);
}

TEST(StartCycle, AnAdvanceWithoutItIsRefused)
{
  Impact impact;
  impact.state.started = false;
  EXPECT_THROW(advance(impact.scene, impact.state, impact.times), std::runtime_error);
}
