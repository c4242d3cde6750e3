// SPDX-License-Identifier: BSD-3-Clause
#include "DeckExample.hpp"

#include <Harmos_DeckReader.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

std::string messageOfText(std::string const &text, std::vector<std::string> const &overrides = {})
{
  try
  {
    readDeckText(text, "deck.yaml", overrides);
  }
  catch (DeckError const &error)
  {
    std::string const message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "accepted";
}

/// The message after overriding the example.
std::string message(std::vector<std::string> const &overrides)
{
  return messageOfText(exampleDeck(), overrides);
}

#define EXPECT_STARTS(text, start) EXPECT_EQ((text).substr(0, std::string(start).size()), start)
#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

} // namespace

TEST(DeckErrors, MisspeltKey_suggestsTheNearestAndListsAllowed)
{
  std::string const m = message({"materials/copper/densty=1"});
  EXPECT_STARTS(m, "deck.yaml: materials/copper/densty: unknown key; did you mean density?; allowed: eos, density");
  EXPECT_STARTS(message({"meshh={x: 1}"}), "deck.yaml: meshh: unknown key; did you mean mesh?");
  EXPECT_STARTS(message({"bodies/slider/shpe=disc"}),
                "deck.yaml: bodies/slider/shpe: unknown key; did you mean shape?");
}

TEST(DeckErrors, MisspeltRequiredKey_isNotReportedAsMissing)
{
  std::string deck = exampleDeck();
  deck.replace(deck.find("shape: annulus"), 14, "shpe: annulus");
  EXPECT_STARTS(messageOfText(deck), "deck.yaml: bodies/ring/shpe: unknown key; did you mean shape?");
  deck = exampleDeck();
  deck.replace(deck.find("end_time"), 8, "end_tim");
  EXPECT_STARTS(messageOfText(deck), "deck.yaml: run/end_tim: unknown key; did you mean end_time?");
}

TEST(DeckErrors, KeyOfAnotherKind_saysWhereItBelongs)
{
  EXPECT_STARTS(message({"bodies/slider/radius=1"}),
                "deck.yaml: bodies/slider/radius: does not belong here, only where shape = disc; allowed: ");
  EXPECT_STARTS(message({"materials/block/slope=1"}),
                "deck.yaml: materials/block/slope: does not belong here, only where eos = mie-gruneisen");
  EXPECT_STARTS(message({"boundaries/left/velocity=[1, 0]"}),
                "deck.yaml: boundaries/left/velocity: does not belong here, only where type = inflow");
}

TEST(DeckErrors, MissingKey_saysWhatIsExpected)
{
  std::string deck = exampleDeck();
  deck.replace(deck.find("{end_time: 1}"), 13, "{max_cycles: 1}");
  EXPECT_EQ(messageOfText(deck), "deck.yaml: run/end_time: missing; expected: number > 0 [s]");
  deck = exampleDeck();
  deck.replace(deck.find("shape: annulus, "), 16, "");
  EXPECT_EQ(
      messageOfText(deck),
      "deck.yaml: bodies/ring/shape: missing; expected: rectangle | disc | annulus | polygon | half-plane | mesh part");
  EXPECT_EQ(messageOfText("harmos:\n  title: x\n"), "deck.yaml: mesh/x/from: missing; expected: number [m]");
}

TEST(DeckErrors, WrongType_showsValueAndExpectation)
{
  EXPECT_EQ(message({"materials/copper/density=heavy"}),
            "deck.yaml: materials/copper/density: \"heavy\" is of the wrong type; expected: number in [1e-30, 1e+30] "
            "[kg/m^3]");
  EXPECT_EQ(message({"mesh/x/cells=4.5"}), "deck.yaml: mesh/x/cells: 4.5 is of the wrong type; expected: integer >= 1");
  EXPECT_EQ(message({"title=5"}),
            "deck.yaml: title: 5 is of the wrong type; expected: text of one line, ASCII, without # and backslash");
  EXPECT_EQ(message({"output/vtu=1"}), "deck.yaml: output/vtu: 1 is of the wrong type; expected: true | false");
  EXPECT_EQ(message({"gravity=9.81"}),
            "deck.yaml: gravity: 9.81 is of the wrong type; expected: array of 2 numbers [m/s^2]");
  EXPECT_EQ(message({"gravity=[0, down]"}),
            "deck.yaml: gravity: [\"0\", \"down\"] is of the wrong type; expected: array of 2 numbers [m/s^2]");
  EXPECT_STARTS(message({"run/end_time={a: 1}"}),
                "deck.yaml: run/end_time: a map is of the wrong type; expected: number");
  EXPECT_STARTS(message({"run=3"}), "deck.yaml: run: 3 is no map; expected: a map with the keys end_time, max_cycles");
  EXPECT_STARTS(message({"bodies/slider=3"}),
                "deck.yaml: bodies/slider: 3 is no map; expected: a map with the keys material");
  EXPECT_EQ(message({"probes/a=foo"}),
            "deck.yaml: probes/a: \"foo\" is no map; expected: a map with the keys position");
  EXPECT_EQ(message({"interactions/x=3"}),
            "deck.yaml: interactions/x: 3 is no map; expected: a map with the keys between, and, type");
  EXPECT_STARTS(message({"interactions/defalt=bonded"}),
                "deck.yaml: interactions/defalt: unknown key; did you mean default?");
}

TEST(DeckErrors, NumbersWithoutBound_areNamedAsSuch)
{
  EXPECT_EQ(message({"run/end_time=1e400"}),
            "deck.yaml: run/end_time: \"1e400\" is no finite number or too large; expected: number > 0 [s]");
  EXPECT_EQ(message({"mesh/x/cells=100000000000"}),
            "deck.yaml: mesh/x/cells: 100000000000 is no finite number or too large; expected: integer >= 1");
  for (std::string const value : {".nan", ".inf", "nan", "-1e999"})
    EXPECT_EQ(message({"gravity=[0.0, " + value + "]"}), "deck.yaml: gravity: [\"0.0\", \"" + value +
                                                             "\"] is no finite number or too large; expected: array "
                                                             "of 2 numbers [m/s^2]");
}

TEST(DeckErrors, KeyWithoutValue_saysSo)
{
  EXPECT_STARTS(messageOfText("harmos:\n  title:\n  mesh:\n    x: {from: 1}\n"),
                "deck.yaml: title: no value is of the wrong type");
}

TEST(DeckErrors, ImpossibleValue_showsTheRange)
{
  EXPECT_EQ(message({"materials/copper/density=-1"}),
            "deck.yaml: materials/copper/density: -1 is out of range; expected: number in [1e-30, 1e+30] [kg/m^3]");
  EXPECT_STARTS(message({"materials/copper/density=1e-300"}),
                "deck.yaml: materials/copper/density: 1e-300 is out of range; expected: number in [1e-30, 1e+30]");
  EXPECT_EQ(message({"numerics/courant=1.5"}),
            "deck.yaml: numerics/courant: 1.5 is out of range; expected: number in [1e-06, 1)");
  EXPECT_EQ(message({"numerics/remap/order=4"}),
            "deck.yaml: numerics/remap/order: 4 is out of range; expected: integer in [1, 3]");
  EXPECT_EQ(message({"numerics/remap/order=3", "numerics/remap/hessian=contour"}),
            "deck.yaml: numerics/remap/hessian: \"contour\" is by intersection alone; expected: "
            "numerics/remap/swept_faces false");
  EXPECT_EQ(message({"numerics/remap/hessian=contour"}),
            "deck.yaml: numerics/remap/hessian: \"contour\" is for the third order; expected: numerics/remap/order 3");
  EXPECT_EQ(message({"gravity=[1, 2, 3]"}),
            "deck.yaml: gravity: [1, 2, 3] has the wrong length; expected: array of 2 numbers [m/s^2]");
  EXPECT_EQ(
      message({"kinematics=xfme"}),
      "deck.yaml: kinematics: \"xfme\" is not allowed; did you mean \"xfem\"?; expected: xfem | single | lagrangian");
  EXPECT_EQ(message({"geometry=cylindrical"}),
            "deck.yaml: geometry: \"cylindrical\" is not allowed; expected: planar | axisymmetric");
  EXPECT_STARTS(message({"boundaries/left/friction=0.1"}),
                "deck.yaml: boundaries/left/friction: does not belong here, only where type = contact wall");
  EXPECT_HAS(message({"mesh/x/to=-3"}), "mesh/x/to: -3.0 is not above from = -2.0");
}

TEST(DeckErrors, WhatHasNoMeaningAboutAnAxis_isRefused)
{
  auto const about_axis = [](std::vector<std::string> more)
  {
    more.insert(more.begin(), {"geometry=axisymmetric", "bodies/patch/points=[3, 0, 3.5, 0, 3, 0.5]"});
    return message(more);
  };
  std::string const from = "mesh/x/from=0", left = "boundaries/left/type=slip wall";
  EXPECT_EQ(about_axis({}), "deck.yaml: mesh/x/from: -2.0 is a radius with geometry axisymmetric; expected: >= 0");
  EXPECT_EQ(about_axis({from}), "deck.yaml: boundaries/left/type: the side is the axis with geometry "
                                "axisymmetric and mesh/x/from 0; expected: slip wall");
  EXPECT_EQ(about_axis({from, left, "gravity=[1, 0]"}),
            "deck.yaml: gravity: it has a radial part with geometry axisymmetric; expected: [0, g]");
  EXPECT_HAS(about_axis({from, left}), "bodies/ring/angular_velocity: a ring does not turn with geometry axisymmetric");
}

TEST(DeckErrors, ShapesThatCannotBe_areRefused)
{
  EXPECT_HAS(message({"bodies/lower/normal=[0, 0]"}), "bodies/lower/normal: [0.0, 0.0] has no direction");
  EXPECT_HAS(message({"bodies/ring/inner_radius=1"}), "bodies/ring/inner_radius: 1.0 is not below outer_radius 0.3");
  EXPECT_HAS(message({"bodies/patch/points=[0,0,1,1,2,2]"}), "bodies/patch/points: the polygon has no area");
  EXPECT_HAS(message({"bodies/patch/points=[0,0,1,1,1,0,0,2]"}), "bodies/patch/points: edges of the polygon cross");
  EXPECT_HAS(message({"bodies/patch/points=[0,0,1,1,1,0,0]"}),
             "bodies/patch/points: 7 numbers; expected: an even number");
  EXPECT_EQ(
      message({"bodies/slider/size=[1e-17, 1e-17]", "bodies/slider/shift=[0.3, 0]"}),
      "deck.yaml: bodies/slider/size: [1e-17, 1e-17] is lost in the digits of the place; expected: a larger body");
  EXPECT_HAS(message({"bodies/patch/points=[0, 0, 1e-17, 0, 0, 1e-17]", "bodies/patch/shift=[0.3, 0.3]"}),
             "bodies/patch/points: they are lost in the digits of the place");
  EXPECT_HAS(message({"bodies/ring/center=[20, 0]"}), "bodies/ring: lies wholly outside of the mesh");
  EXPECT_HAS(message({"bodies/slider/shift=[0, 3]"}), "bodies/slider: lies wholly outside of the mesh");
  EXPECT_HAS(message({"bodies/lower/point=[0, -5]"}), "bodies/lower: lies wholly outside of the mesh");
  EXPECT_EQ(message({"bodies/lower/point=[0, -5]", "bodies/lower/angle=180"}), "accepted");
}

TEST(DeckErrors, NamesThatDoNotExist_listThoseThatDo)
{
  EXPECT_EQ(message({"bodies/ring/material=cooper"}),
            "deck.yaml: bodies/ring/material: \"cooper\" is no material; expected one of: block, copper, air, platen");
  EXPECT_HAS(message({"interactions/glue/and=nobody"}),
             "interactions/glue/and: \"nobody\" is no body; expected one of: lower, gas");
  EXPECT_HAS(message({"bodies/slider/join=ring"}),
             "bodies/slider/join: \"ring\" is no earlier body; expected one of: lower, gas");
  EXPECT_HAS(
      message({"numerics/reconstruction/removal_order=[ring, patch]"}),
      "removal_order: \"patch\" is no field (a body that joins none); expected one of: lower, gas, slider, ring, void");
  EXPECT_HAS(message({"numerics/reconstruction/removal_order=[ring, ring]"}), "\"ring\" comes twice");
  EXPECT_HAS(message({"numerics/reconstruction/removal_order=[ring, gas]"}), "\"lower\" is not in it");
  EXPECT_HAS(message({"bodies/void={material: air, shape: disc, center: [0, 0], radius: 0.1, pressure: 1}"}),
             "bodies/void: this name has a meaning of its own");
  EXPECT_HAS(message({"probes/2nd={position: [0, 0]}"}), "probes/2nd: not a name");
  EXPECT_HAS(message({"probes/middle/position=[0, 7]"}), "probes/middle/position: [0.0, 7.0] lies outside of the mesh");
}

TEST(DeckErrors, OptionsThatDoNotGoTogether_areRefused)
{
  EXPECT_HAS(message({"kinematics=single",
                      "bodies/lower={material: platen, shape: disc, center: [0, 0], radius: 1, motion: free}"}),
             "bodies/lower/motion: a free rigid body needs a velocity field of its own");
  EXPECT_HAS(message({"bodies/lower/motion=free"}), "a half-plane has no finite mass");
  EXPECT_HAS(message({"bodies/lower/velocity=[1, 0]"}), "bodies/lower/motion: a fixed body has no velocity");
  EXPECT_HAS(message({"bodies/ring/motion=free"}),
             "bodies/ring/motion: belongs to rigid bodies, and copper is no rigid law");
  EXPECT_HAS(message({"bodies/lower/pressure=1"}), "bodies/lower/pressure: means nothing for a rigid body");
  EXPECT_HAS(message({"bodies/patch/join=ring"}), "bodies/patch/join: \"ring\" has the law copper, not block");
  EXPECT_HAS(message({"interactions/glue/between=slider"}), "interactions/glue: both bodies share one velocity field");
  EXPECT_HAS(message({"boundaries/left={type: prescribed, normal_velocity: 1}"}),
             "boundaries/left/type: a prescribed velocity needs kinematics lagrangian");
  EXPECT_HAS(message({"boundaries/left={type: inflow, body: gas, velocity: [-1, 0], pressure: 1}"}),
             "boundaries/left/velocity: does not point into the mesh");
  EXPECT_HAS(message({"boundaries/left={type: inflow, body: lower, velocity: [1, 0]}"}), "a rigid body cannot flow in");
  EXPECT_HAS(message({"bodies/ring/pressure=1", "bodies/ring/internal_energy=1"}),
             "given together with internal_energy");
  EXPECT_HAS(message({"bodies/slider/pressure=1", "bodies/slider/density=999"}),
             "follows from the density in this law");
  EXPECT_HAS(message({"bodies/gas={material: air, shape: disc, center: [0, 0], radius: 1}"}),
             "bodies/gas: an ideal gas needs a positive");
  EXPECT_HAS(message({"bodies/ring/density=1.0e6"}),
             "bodies/ring/density: 1000000.0 is beyond the range of the law's equation of state");
}

TEST(DeckErrors, Lagrangian_takesConvexBlocksWithoutInflow)
{
  std::string const head = "harmos:\n  kinematics: lagrangian\n"
                           "  mesh: {x: {from: 0, to: 4, cells: 4}, y: {from: 0, to: 1, cells: 1}}\n"
                           "  materials:\n    m: {eos: stiffened, density: 1, sound_speed: 1}\n"
                           "  run: {end_time: 1}\n  bodies:\n";
  std::string const block = head + "    a: {material: m, shape: rectangle, center: [1, 0.5], size: [1, 1]}\n";
  EXPECT_EQ(messageOfText(block), "accepted");
  EXPECT_HAS(messageOfText(block, {"boundaries/left={type: inflow, body: a, velocity: [1, 0]}"}), "has no inflow");
  EXPECT_HAS(messageOfText(block, {"bodies/a/cut=true"}), "cannot cut blocks");
  EXPECT_HAS(messageOfText(block, {"output/history/polygon_overlap=true"}),
             "output/history/polygon_overlap: true in kinematics lagrangian");
  EXPECT_HAS(messageOfText(block, {"bodies/a/cells=[1, 2.5]"}), "bodies/a/cells: expected: two integers");
  EXPECT_HAS(messageOfText(block, {"bodies/a/cells=[1000000, 1000000]"}), "bodies/a/cells: more cells than 32-bit");
  EXPECT_HAS(messageOfText(block, {"bodies/a/cells=[20000, 20000]",
                                   "bodies/b={material: m, shape: rectangle, center: [2, 0.5], size: [1, 1], "
                                   "cells: [20000, 20000]}"}),
             "bodies: 800000000 cells in all, more than 32-bit face numbers reach; expected: at most 536870911");
  EXPECT_HAS(messageOfText(block, {"bodies/a/cells=[40, 1]", "bodies/a/cells_grading=[1e20, 1]"}),
             "bodies/a/cells_grading: 1e+20 makes cells of no size");
  for (char const *key : {"cells", "cells_grading"})
    EXPECT_HAS(messageOfText(block, {"kinematics=xfem", std::string("bodies/a/") + key + "=[4, 2]"}),
               std::string("bodies/a/") + key + ": a body of another kinematics than lagrangian is painted");
  EXPECT_EQ(messageOfText(block, {"kinematics=xfem", "bodies/a/cells_grading=[1, 1]"}), "accepted");
  EXPECT_HAS(messageOfText(head + "    a: {material: m, shape: disc, center: [1, 0.5], radius: 1}\n"),
             "bodies/a/shape: kinematics lagrangian meshes blocks");
  EXPECT_HAS(messageOfText(head + "    a: {material: m, shape: polygon, points: [0,0, 1,0, 0.2,0.2, 0,1]}\n"),
             "a lagrangian block must be convex");
}

TEST(DeckErrors, Yaml_isOneLineWithThePlace)
{
  EXPECT_STARTS(messageOfText("harmos:\n  a: 1\n   b: 2\n"),
                "deck.yaml: not readable as YAML: Parser failure at line 3 column 4; Expected one of");
  EXPECT_HAS(messageOfText("harmos:\n  a: {b: 1,\n      c: 2}\n"),
             "line 2: { } and [ ] must open and close on one line");
  EXPECT_HAS(messageOfText("harmos:\n  a: 1\n  a: 2\n"), "\"a\" already exists");
  EXPECT_HAS(messageOfText("harmos:\n  a: 1\n\tb: 2\n"), "line 3");
  EXPECT_EQ(messageOfText("harmos:\n  title: \xc3\xbc\n"),
            "deck.yaml: line 2 holds the byte 195; expected: ASCII text, but in comments");
  EXPECT_HAS(messageOfText(std::string("\x1b[31mharmos:\0", 14)), "line 1 holds the byte 27");
  EXPECT_HAS(messageOfText(""), "deck.yaml: empty");
  EXPECT_HAS(messageOfText("harmos: 3\n"), "one map under the outermost key harmos");
  for (char const *beside : {"other:\n  b: 1", "gravity: [0.0, -9.81]", "kinematics: single"})
    EXPECT_HAS(messageOfText(std::string("harmos:\n  a: 1\n") + beside + "\n"),
               "line 3 stands beside the outermost key harmos");
  EXPECT_HAS(messageOfText("harmoz:\n  a: 1\n"), "outermost key is harmoz; expected: harmos");
}

TEST(DeckErrors, NamesThatTheTablesUse_areRefusedWhereTheyWouldClash)
{
  std::string const body = "={material: block, shape: rectangle, center: [1.0, 0.8], size: [0.1, 0.1], cut: true}";
  EXPECT_HAS(message({"bodies/contact_wall" + body}), "bodies/contact_wall: this name has a meaning of its own");
  EXPECT_EQ(message({"bodies/wall_right" + body}), "accepted");
  EXPECT_EQ(message({"bodies/outside" + body}), "accepted");
  EXPECT_HAS(message({"bodies/outside" + body, "tracers/p={position: [0, 0]}"}), "bodies/outside: in tracers.csv");
}

TEST(DeckErrors, FieldsThatWouldNotBeWritten_areRefused)
{
  EXPECT_HAS(message({"output/xdmf=false"}), "output/fields: every_... without output/xdmf writes nothing");
  EXPECT_EQ(message({"output/xdmf=false", "output/fields/every_time=0.0"}), "accepted");
}

TEST(DeckErrors, NonAsciiComments_areNoError)
{
  EXPECT_EQ(messageOfText("# Gr\xc3\xbcneisen\n" + exampleDeck()), "accepted");
  EXPECT_EQ(messageOfText("\xEF\xBB\xBF" + exampleDeck()), "accepted");
}

TEST(DeckErrors, Overrides_sayWhatIsWrongWithThem)
{
  EXPECT_EQ(message({"run/end_time"}), "--set run/end_time: expected: path/to/key=value");
  EXPECT_EQ(message({"=1"}), "--set =1: expected: path/to/key=value");
  EXPECT_EQ(message({"title=a#b"}), "--set title=a#b: a # would begin a comment; expected: none");
  for (std::string const path : {"run/end_time/", "/run/end_time", "run//end_time"})
    EXPECT_HAS(message({path + "=1.0"}), "a part of the path is empty");
  EXPECT_HAS(message({"run/end_time/x=1"}), "--set run/end_time/x=1: end_time is no map");
  EXPECT_STARTS(message({"run/end_time=[1"}), "--set run/end_time=[1: not readable as YAML");
  EXPECT_STARTS(message({"run/end=1"}), "deck.yaml: run/end: unknown key");
}
