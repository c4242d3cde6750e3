// SPDX-License-Identifier: BSD-3-Clause
#include "Impact.hpp"

#include <Harmos_Temperature.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

template <class V, class T>
void setOne(V const &view, int index, T const &value)
{
  Kokkos::deep_copy(Kokkos::subview(view, index), value);
}

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

template <class Spoil>
void expectRefused(std::string const &words, Spoil const &spoil)
{
  std::string const said = refusal(spoil);
  EXPECT_NE(said.find(words), std::string::npos) << "said: " << said << "\nexpected: " << words;
}

template <class Spoil>
void expectLawRefused(std::string const &words, Spoil const &spoil)
{
  Material law = metal(8930.0);
  spoil(law);
  expectRefused("scene.materials(0)." + words,
                [&](Scene &s, CycleState &) {
                  s.materials = deviceCopy("materials", std::vector<Material>{law, metal(2700.0)});
                });
}

void expectBoundaryRefused(std::string const &words, Boundary const &side)
{
  expectRefused("scene.boundary." + words, [&](Scene &s, CycleState &) { setOne(s.boundary.boundary, 2, side); });
}

} // namespace

TEST(StartCycle, NamesWhatASceneLacks)
{
  expectRefused("scene.exchange is not set", [](Scene &s, CycleState &) { s.exchange = nullptr; });
  expectRefused("0 x 0; expected: 2 x 2", [](Scene &s, CycleState &) { s.constraint.interaction = {}; });
  expectRefused("scene.boundary does not belong", [](Scene &s, CycleState &) { s.boundary = {}; });
  expectRefused("state.pairs does not belong", [](Scene &, CycleState &s) { s.pairs = {}; });
  expectRefused("fewer records or centroids", [](Scene &, CycleState &s) { s.state.record = {}; });
  expectRefused("fewer records or centroids", [](Scene &, CycleState &s) { s.state.centroid = {}; });
  expectRefused("state.state.velocity has fewer", [](Scene &, CycleState &s) { s.state.velocity = {}; });
}

TEST(StartCycle, NamesAMaterialThatTheSceneDoesNotHave)
{
  expectRefused("material 1: expected: state.pairs with materials from 0 to 0",
                [](Scene &s, CycleState &)
                {
                  s.materials = deviceCopy("materials", std::vector<Material>{metal(8930.0)});
                  s.constraint.interaction = View<PairInteraction **>("interaction", 1, 1);
                });
  expectRefused("material -3: expected: state.pairs with materials from 0 to 1",
                [](Scene &, CycleState &s) { setOne(s.pairs.material, 5, -3); });
}

TEST(StartCycle, RefusesPairsAndDofNodesThatDoNotBelongTogether)
{
  expectRefused("see buildDofNodes", [](Scene &, CycleState &s) { s.dof_nodes = {}; });
  expectRefused("see buildDofNodes",
                [](Scene &, CycleState &s) { setOne(Kokkos::subview(s.pairs.dof_node, 5, Kokkos::ALL), 1, 99999); });
  expectRefused("see buildDofNodes",
                [](Scene &, CycleState &s) { setOne(Kokkos::subview(s.pairs.dof_node, 5, Kokkos::ALL), 1, -1); });
  expectRefused("see buildDofNodes", [](Scene &s, CycleState &) { s.kinematics = Kinematics::Single; });
  expectRefused("the rows of state.pairs are wrong", [](Scene &, CycleState &s) { setOne(s.pairs.cell, 5, 0); });
  expectRefused("the rows of state.pairs are wrong", [](Scene &, CycleState &s) { --s.pairs.num_pairs; });
  expectRefused("state.state.damage", [](Scene &, CycleState &s) { s.state.tracks_damage = true; });
}

TEST(StartCycle, RefusesRecordsAndVelocitiesWithoutAMeaning)
{
  double const nan = std::nan(""), infinity = HUGE_VAL;
  struct Wrong
  {
    PairField field;
    double value;
  };
  for (Wrong const &wrong :
       {Wrong{Mass, nan}, Wrong{Mass, -1.0}, Wrong{Mass, infinity}, Wrong{VolumeFraction, 2.0},
        Wrong{VolumeFraction, -0.5}, Wrong{VolumeFraction, nan}, Wrong{SpecificVolume, 0.0}, Wrong{InternalEnergy, nan},
        Wrong{InternalEnergy, infinity}, Wrong{PlasticStrain, nan}, Wrong{DeviatorXY, nan}})
    expectRefused("state.state.record is (", [&](Scene &, CycleState &s)
                  { setOne(Kokkos::subview(s.state.record, 5, Kokkos::ALL), wrong.field, wrong.value); });
  for (double const value : {nan, infinity})
    expectRefused("state.state.velocity is (0, " + std::string(value == infinity ? "inf" : "nan") + ")",
                  [&](Scene &, CycleState &s) { setOne(Kokkos::subview(s.state.velocity, 0, Kokkos::ALL), 1, value); });
}

TEST(StartCycle, RefusesLawsThatAreNotFilledIn)
{
  double const nan = std::nan("");
  expectLawRefused("density0 is 0", [](Material &m) { m = Material(); });
  expectLawRefused("density0 is 0", [](Material &m) { m.density0 = 0.0; });
  expectLawRefused("density0 is nan", [&](Material &m) { m.density0 = nan; });
  expectLawRefused("sound_speed0 is 0", [](Material &m) { m.sound_speed0 = 0.0; });
  expectLawRefused("sound_speed0 is nan", [&](Material &m) { m.sound_speed0 = nan; });
  expectLawRefused("slope is nan", [&](Material &m) { m.slope = nan; });
  expectLawRefused("gruneisen is nan", [&](Material &m) { m.gruneisen = nan; });
  expectLawRefused("energy0 is nan", [&](Material &m) { m.energy0 = nan; });
  expectLawRefused("tension_limit is nan", [&](Material &m) { m.tension_limit = nan; });
  expectLawRefused("shear_modulus is -1e+09", [](Material &m) { m.shear_modulus = -1e9; });
  expectLawRefused("shear_modulus is nan", [&](Material &m) { m.shear_modulus = nan; });
  expectLawRefused("yield is 0", [](Material &m) { m.yield = 0.0; });
  expectLawRefused("hardening is nan", [&](Material &m) { m.hardening = nan; });
  expectLawRefused("failure.spall_stress is nan", [&](Material &m) { m.failure.spall_stress = nan; });
  expectLawRefused("failure.spall_pressure is 0", [](Material &m) { m.failure.spall_pressure = 0.0; });
  expectLawRefused("thermal.heat_capacity is 0", [](Material &m) { m.failure.damages = true; });
  expectLawRefused("gruneisen is 0; expected: above 1",
                   [](Material &m)
                   {
                     m.eos = EosKind::IdealGas;
                     m.gruneisen = 0.0;
                   });
  expectLawRefused("tillotson.bulk is 0", [](Material &m) { m.eos = EosKind::Tillotson; });
  for (StrengthKind const hot : {StrengthKind::JohnsonCook, StrengthKind::SteinbergGuinan})
    expectLawRefused("thermal.heat_capacity is 0", [&](Material &m) { m.strength = hot; });
}

TEST(StartCycle, TakesEveryLawThatIsFilledIn)
{
  Material gas;
  gas.eos = EosKind::IdealGas;
  gas.density0 = 1.2;
  gas.gruneisen = 1.4;
  Material hot = metal(2700.0);
  setThermalCurve(hot, 900.0, 300.0);
  hot.flow.melting_temperature = 930.0;
  Material johnson_cook = hot, steinberg = hot, power = metal(2700.0), hydro = metal(2700.0), elastic = metal(2700.0);
  johnson_cook.strength = StrengthKind::JohnsonCook;
  johnson_cook.failure.damages = true;
  steinberg.strength = StrengthKind::SteinbergGuinan;
  power.strength = StrengthKind::PowerHardening;
  elastic.strength = StrengthKind::Elastic;
  elastic.yield = 0.0;
  hydro.strength = StrengthKind::None;
  hydro.shear_modulus = hydro.yield = 0.0;
  hydro.tension_limit = HUGE_VAL;
  Material tillotson = metal(2700.0);
  tillotson.eos = EosKind::Tillotson;
  tillotson.tillotson = {0.5, 1.63, 75.2e9, 65e9, 5.0, 5.0, 5e6, 3e6, 15e6};
  for (Material const &law : {gas, johnson_cook, steinberg, power, hydro, elastic, tillotson})
    EXPECT_EQ(refusal(
                  [&](Scene &s, CycleState &) {
                    s.materials = deviceCopy("materials", std::vector<Material>{law, metal(2700.0)});
                  }),
              "");
}

TEST(StartCycle, RefusesRigidMaterialsAndBodiesThatDoNotMatch)
{
  for (int const body : {0, 5})
    expectLawRefused("rigid_body is " + std::to_string(body) + "; expected: less than 0",
                     [&](Material &m) { m.rigid_body = body; });
  auto const withBody = [](RigidBody const &body)
  {
    return [body](Scene &s, CycleState &)
    {
      Material rigid = metal(2700.0);
      rigid.rigid_body = 0;
      s.materials = deviceCopy("materials", std::vector<Material>{metal(8930.0), rigid});
      s.rigid_start = {body};
      s.rigid_shape = {Shape::rectangle({0.65, 0.5}, {0.31, 0.53})};
    };
  };
  RigidBody body;
  expectRefused("scene.materials(1).rigid_body is 0, whose material is -1", withBody(body));
  body.material = 0;
  expectRefused("scene.materials(1).rigid_body is 0, whose material is 0", withBody(body));
  body.material = 1;
  EXPECT_EQ(refusal(withBody(body)), "");
  body.motion = RigidMotion::Free;
  expectRefused("scene.rigid_start[0].mass is 0", withBody(body));
  body.mass = 1.0;
  expectRefused("scene.rigid_start[0].inertia is 0", withBody(body));
  body.velocity[1] = std::nan("");
  expectRefused("scene.rigid_start[0].velocity is nan", withBody(body));
  expectRefused("scene.rigid_start[0].material is 1",
                [&](Scene &s, CycleState &)
                {
                  s.rigid_start = {body};
                  s.rigid_shape = {Shape::disc({0.0, 0.0}, 1.0)};
                });
  expectRefused("state.bodies are 1; expected: 0", [&](Scene &, CycleState &s) { s.bodies = {body}; });
}

TEST(StartCycle, RefusesBoundariesWithoutAMeaning)
{
  Boundary prescribed, inflow, wall;
  prescribed.kind = BoundaryKind::Prescribed;
  inflow.kind = BoundaryKind::Inflow;
  wall.kind = BoundaryKind::ContactWall;
  wall.friction = std::nan("");
  expectBoundaryRefused("boundary(2).kind is Prescribed; expected: another one", prescribed);
  expectBoundaryRefused("boundary(2).material is -1", inflow);
  inflow.material = 2;
  expectBoundaryRefused("boundary(2).material is 2", inflow);
  inflow.material = 1;
  expectBoundaryRefused("boundary(2).specific_volume is 0", inflow);
  inflow.velocity = {0.0, HUGE_VAL};
  expectBoundaryRefused("boundary(2).velocity is inf", inflow);
  expectBoundaryRefused("boundary(2).friction is nan", wall);
  wall.friction = 0.0;
  wall.restitution = 1.5;
  expectBoundaryRefused("boundary(2).restitution is 1.5", wall);
  for (int const number : {-5, 4})
    expectRefused("lies on boundary " + std::to_string(number), [&](Scene &s, CycleState &)
                  { setOne(Kokkos::subview(s.mesh.face_boundary, 0, Kokkos::ALL), 0, number); });
}

TEST(StartCycle, RefusesOptionsAndInteractionsOutOfRange)
{
  double const nan = std::nan("");
  for (double const value : {nan, 0.0, -1.0})
  {
    expectRefused("scene.max_dt is", [&](Scene &s, CycleState &) { s.max_dt = value; });
    expectRefused("scene.lagrange.courant is", [&](Scene &s, CycleState &) { s.lagrange.courant = value; });
  }
  expectRefused("scene.lagrange.gravity is nan", [&](Scene &s, CycleState &) { s.lagrange.gravity[1] = nan; });
  expectRefused("scene.lagrange.linear_viscosity is nan",
                [&](Scene &s, CycleState &) { s.lagrange.linear_viscosity = nan; });
  PairInteraction law;
  law.kind = Interaction::Friction;
  law.friction = nan;
  auto const between = [&law](bool both)
  {
    return [&law, both](Scene &s, CycleState &)
    {
      setOne(Kokkos::subview(s.constraint.interaction, 0, Kokkos::ALL), 1, law);
      if (both)
        setOne(Kokkos::subview(s.constraint.interaction, 1, Kokkos::ALL), 0, law);
    };
  };
  expectRefused("scene.constraint.interaction(0, 1).friction is nan", between(true));
  law.friction = 0.3;
  EXPECT_EQ(refusal(between(true)), "");
  expectRefused("expected: a symmetric table", between(false));
  law.restitution = 2.0;
  expectRefused("scene.constraint.interaction(0, 1).restitution is 2", between(true));
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
    impact.scene.mesh.halo = halo_layers;
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
