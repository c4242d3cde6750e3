// SPDX-License-Identifier: BSD-3-Clause
#include "DeckExample.hpp"

#include <Harmos_DeckReader.hpp>
#include <Harmos_EquationOfState.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace Harmos;

namespace
{

Deck example(std::vector<std::string> const &overrides = {})
{
  return readDeckText(exampleDeck(), "deck.yaml", overrides);
}

} // namespace

TEST(Deck, Values_arriveAsWritten)
{
  Deck const deck = example();
  EXPECT_EQ(deck.title, "sliding block");
  EXPECT_EQ(deck.x.to, 4.0);
  EXPECT_EQ(deck.y.cells, 16);
  EXPECT_EQ(deck.boundary[Left].kind, BoundaryKind::Outflow);
  EXPECT_EQ(deck.boundary[Bottom].kind, BoundaryKind::SlipWall);
  EXPECT_EQ(deck.boundary[Top].kind, BoundaryKind::ContactWall);
  ASSERT_EQ(deck.laws.size(), 4u);
  EXPECT_EQ(deck.laws[0].law.shear_modulus, 3.0e6);
  EXPECT_EQ(deck.laws[1].law.eos, EosKind::MieGruneisen);
  EXPECT_EQ(deck.laws[1].law.strength, StrengthKind::Plastic);
  EXPECT_EQ(deck.laws[1].law.yield, 400.0e6);
  EXPECT_EQ(deck.laws[2].law.gruneisen, 1.4);
  EXPECT_TRUE(deck.laws[3].rigid);
  EXPECT_EQ(deck.output.fields.every_time, 0.1);
  ASSERT_EQ(deck.probes.size(), 1u);
  EXPECT_EQ(deck.probes[0].name, "middle");
}

TEST(Deck, RowsOfHistory_comeEveryCycle_onlyWhereNoOtherRhythmIsGiven)
{
  auto const every_cycles = [](std::vector<std::string> const &overrides)
  { return example(overrides).output.history.every_cycles; };
  EXPECT_EQ(every_cycles({}), 1);
  EXPECT_EQ(every_cycles({"output/history/at_end=false"}), 1);
  EXPECT_EQ(every_cycles({"output/history/every_time=0.0"}), 1);
  EXPECT_EQ(every_cycles({"output/history/every_time=0.1"}), 0);
  EXPECT_EQ(every_cycles({"output/history/every_wall_seconds=10"}), 0);
  EXPECT_EQ(every_cycles({"output/history/every_time=0.1", "output/history/every_cycles=5"}), 5);
  // What was chosen stands among the defaults of the summary, and holds when that is read as a deck.
  Deck const by_time = example({"output/history/every_time=0.1"});
  EXPECT_NE(by_time.yaml.find("every_cycles"), std::string::npos);
  EXPECT_EQ(readDeckText(by_time.yaml, "echo", {"output/history/every_time=0.0"}).output.history.every_cycles, 0);
}

TEST(Deck, PolygonOverlap_isMeasuredWhereTheHistoryShowsIt)
{
  Deck const plain = example({});
  EXPECT_FALSE(plain.remap.measure_overlap);
  Deck const measured = example({"output/history/polygon_overlap=true"});
  EXPECT_TRUE(measured.remap.measure_overlap);
  EXPECT_EQ(measured.output.history.every_cycles, 1);
}

TEST(Deck, Bodies_keepTheirOrder_andJoinedOnesShareAField)
{
  Deck const deck = example();
  std::vector<std::string> names;
  for (BodySpec const &body : deck.bodies)
    names.push_back(body.name);
  EXPECT_EQ(names, (std::vector<std::string>{"lower", "gas", "slider", "ring", "patch"}));
  ASSERT_EQ(deck.fields.size(), 4u);
  EXPECT_EQ(deck.bodies[4].field, deck.bodies[2].field);
  EXPECT_EQ(deck.fields[2].name, "slider");
  EXPECT_EQ(deck.num_rigid_bodies, 1);
  EXPECT_EQ(deck.fieldMaterial(0).rigid_body, 0);
  EXPECT_EQ(deck.fieldMaterial(1).rigid_body, -1);
}

TEST(Deck, Shapes_areNormalised)
{
  Deck const deck = example();
  EXPECT_EQ(deck.bodies[0].shape.normal[1], 1.0);
  EXPECT_DOUBLE_EQ(deck.bodies[2].shape.angle, 0.5 * Math::pi);
  EXPECT_EQ(deck.bodies[2].shape.size[0], 1.0);
  // The polygon was written clockwise.
  std::vector<Vector2> const &p = deck.bodies[4].shape.points;
  ASSERT_EQ(p.size(), 3u);
  EXPECT_DOUBLE_EQ(cross(p[1] - p[0], p[2] - p[0]), 0.25);
  EXPECT_NEAR(deck.bodies[4].shape.center[0], -2.5 / 3.0, 1e-15);
  EXPECT_NEAR(deck.bodies[4].shape.center[1], 0.5 / 3.0, 1e-15);
}

TEST(Deck, Outline_turnsAboutTheCentreThenShifts)
{
  Deck const deck =
      example({"bodies/slider/center=[1.0, 0.0]", "bodies/slider/size=[2, 1]", "bodies/slider/shift=[0.25, 0]"});
  std::vector<Vector2> const p = outlinePoints(deck.bodies[2].shape);
  ASSERT_EQ(p.size(), 4u);
  EXPECT_NEAR(p[0][0], 1.75, 1e-15);
  EXPECT_NEAR(p[0][1], -1.0, 1e-15);
  EXPECT_EQ(deck.bodies[2].shape.reference()[0], 1.25);
}

TEST(Deck, Interactions_areASymmetricMatrixOfFields)
{
  Deck const deck = example();
  int const n = static_cast<int>(deck.fields.size());
  int const slider = 2, ring = 3;
  for (int at : {slider * n + ring, ring * n + slider})
  {
    EXPECT_EQ(deck.interaction[at].kind, Interaction::Bonded);
    EXPECT_EQ(deck.interaction[at].strength.tensile, 0.0);
    EXPECT_EQ(deck.interaction[at].strength.shear, 5.0e6);
  }
  auto const bonded = [](PairInteraction const &law) { return law.kind == Interaction::Bonded; };
  EXPECT_EQ(std::count_if(deck.interaction.begin(), deck.interaction.end(), bonded), 2);
}

TEST(Deck, Pressure_isMetByTheInitialState)
{
  Deck const gas = example();
  EXPECT_NEAR(equationOfState(gas.laws[2].law, 1.0 / gas.bodies[1].density, gas.bodies[1].internal_energy).pressure,
              1e5, 1e-9);
  for (std::string const name : {"slider", "ring"})
    for (double const pressure : {-1e5, 2e6})
    {
      Deck const deck = example({"bodies/" + name + "/pressure=" + numberText(pressure)});
      BodySpec const &body = deck.bodies[name == "ring" ? 3 : 2];
      Material const &law = deck.laws[body.law].law;
      EXPECT_NEAR(equationOfState(law, 1.0 / body.density, body.internal_energy).pressure, pressure, 1e-6 * 1e6);
    }
  // Without a Grueneisen coefficient only the density can carry it, along the curved Hugoniot as well.
  Deck const deck = example({"materials/copper/gruneisen=0", "bodies/ring/pressure=2.0e9"});
  EXPECT_NEAR(equationOfState(deck.laws[1].law, 1.0 / deck.bodies[3].density, 0.0).pressure, 2e9, 1e-2);
  EXPECT_EQ(deck.bodies[3].internal_energy, 0.0);
}

// Rows, stress and moved outlines take the same edges for too short to bend.
TEST(Deck, shortestSegment_isOneForRowsStressAndOutlines)
{
  for (double const shortest : {0.0, 0.1, 0.3})
  {
    Deck const deck = example({"numerics/constraint/shortest_segment=" + std::to_string(shortest)});
    EXPECT_EQ(deck.constraint.shortest_segment, shortest);
    EXPECT_EQ(deck.lagrange.shortest_bent_edge, shortest);
    EXPECT_EQ(deck.remap.shortest_bent_edge, shortest);
  }
}

TEST(Deck, Defaults_areThoseOfTheOptionStructs)
{
  Deck const deck = example();
  EXPECT_EQ(deck.lagrange.courant, LagrangeOptions().courant);
  EXPECT_EQ(deck.lagrange.cut_cell_stress, LagrangeOptions().cut_cell_stress);
  EXPECT_EQ(deck.lagrange.hourglass_viscosity, LagrangeOptions().hourglass_viscosity);
  EXPECT_EQ(deck.constraint.tolerance, ConstraintOptions().tolerance);
  EXPECT_EQ(deck.constraint.max_iterations, ConstraintOptions().max_iterations);
  EXPECT_EQ(deck.remap.merge_below, RemapOptions().merge_below);
  EXPECT_EQ(deck.reconstruction.sliver, ReconstructionOptions().sliver);
  EXPECT_EQ(deck.output.history.every_cycles, 1);
  EXPECT_EQ(deck.bodies[3].density, 8930.0);
  EXPECT_TRUE(deck.removal_order.empty());
  EXPECT_EQ(deck.constraint.speed_scale, 5.0 * 0.3);
}

TEST(Deck, Overrides_replaceValuesAndMakeMaps)
{
  Deck const deck = example({"kinematics=single", "interactions={default: sliding}", "bodies/slider/angle=30",
                             "run/end_time=2", "numerics/remap/order=1", "numerics/remap/limiter=van leer",
                             "numerics/remap/swept_faces=false", "numerics/remap/part_overlaps=false",
                             "numerics/reconstruction/removal_order=[ring, void, slider, gas, lower]",
                             "boundaries/left={type: inflow, body: slider, velocity: [2, 0]}"});
  EXPECT_EQ(deck.kinematics, Kinematics::Single);
  EXPECT_DOUBLE_EQ(deck.bodies[2].shape.angle, Math::pi / 6.0);
  EXPECT_EQ(deck.run.end_time, 2.0);
  EXPECT_EQ(deck.remap.order, 1);
  EXPECT_EQ(deck.remap.limiter, RemapLimiter::VanLeer);
  EXPECT_FALSE(deck.remap.swept_faces);
  EXPECT_FALSE(deck.remap.part_overlaps);
  EXPECT_EQ(deck.removal_order, (std::vector<int>{3, -1, 2, 1, 0}));
  EXPECT_EQ(deck.boundary[Left].kind, BoundaryKind::Inflow);
  EXPECT_EQ(deck.boundary[Left].material, 2);
  EXPECT_EQ(deck.boundary[Left].specific_volume, 1.0 / 1000.0);
}

TEST(Deck, Words_mayBeWrittenWithBlanksHyphensOrUnderscores)
{
  for (std::string const word : {"slip wall", "slip-wall", "slip_wall"})
    EXPECT_EQ(example({"boundaries/left/type=" + word}).boundary[Left].kind, BoundaryKind::SlipWall);
}

TEST(Deck, LagrangianBlocks_getCellsOfTheMeshSize)
{
  Deck const deck =
      readDeckText("harmos:\n"
                   "  kinematics: lagrangian\n"
                   "  mesh: {x: {from: 0, to: 4, cells: 40}, y: {from: 0, to: 1, cells: 5}}\n"
                   "  materials:\n"
                   "    m: {eos: stiffened, density: 1, sound_speed: 1}\n"
                   "  bodies:\n"
                   "    a: {material: m, shape: rectangle, center: [1, 0.5], size: [1, 1]}\n"
                   "    b: {material: m, shape: rectangle, center: [3, 0.5], size: [1, 1], cells: [3, 7]}\n"
                   "  boundaries: {left: {type: prescribed, normal_velocity: -2}}\n"
                   "  run: {end_time: 1}",
                   "deck.yaml");
  EXPECT_EQ(deck.bodies[0].cells[0], 10);
  EXPECT_EQ(deck.bodies[0].cells[1], 5);
  EXPECT_EQ(deck.bodies[1].cells[1], 7);
  EXPECT_EQ(deck.boundary[Left].velocity[0], 2.0);
}

TEST(Deck, GradedAxis_sumsToItsLength_andEndsExactly)
{
  AxisSpec axis{-1.0, 2.0, 7, 3.0};
  EXPECT_EQ(axis.position(0), -1.0);
  EXPECT_EQ(axis.position(7), 2.0);
  double const first = axis.position(1) - axis.position(0);
  double const last = axis.position(7) - axis.position(6);
  EXPECT_NEAR(last / first, 3.0, 1e-13);
  EXPECT_NEAR((axis.position(3) - axis.position(2)) / (axis.position(2) - axis.position(1)), std::pow(3.0, 1.0 / 6.0),
              1e-13);
}

// Bodies are placed, and joined, in the order of the deck.
TEST(Deck, aBodyThatIsSetAnew_keepsItsPlace)
{
  Deck const deck = example({"bodies/slider={material: block, shape: disc, center: [0, 0], radius: 0.4, cut: true}"});
  ASSERT_EQ(deck.bodies.size(), 5u);
  EXPECT_EQ(deck.bodies[2].name, "slider");
  EXPECT_EQ(deck.bodies[2].shape.kind, ShapeKind::Disc);
  EXPECT_EQ(deck.bodies[4].field, deck.bodies[2].field);
}

TEST(Deck, cornersOnAStraightSide_areNone)
{
  Deck const deck = example({"bodies/patch/points=[-0.75, 0.0, -1, 0, -1, 0.25, -1, 0.5, -0.5, 0]"});
  EXPECT_EQ(deck.bodies[4].shape.points.size(), 3u);
}

TEST(Deck, Echo_readsBackToTheSameDeck)
{
  std::vector<std::string> const overrides = {
      "title='It''s: 100 % of {it}, \"so\"'", "bodies/slider/shift=[0.1, 1.0e-17]",
      "materials/block/density=1.0000000000000002e+20", "numerics/constraint/tolerance=0.1e-5"};
  Deck const deck = example(overrides);
  Deck const again = readDeckText(deck.yaml, "echo.yaml");
  EXPECT_EQ(again.yaml, deck.yaml);
  EXPECT_EQ(again.json, deck.json);
  EXPECT_EQ(again.title, "It's: 100 % of {it}, \"so\"");
  EXPECT_EQ(again.laws[0].law.density0, deck.laws[0].law.density0);
  EXPECT_EQ(again.bodies[2].shape.shift[1], 1.0e-17);
  // Types stay: with defaults filled in, completing changes nothing.
  Teuchos::ParameterList const raw = parseDeck(deck.yaml, "echo.yaml");
  EXPECT_TRUE(raw.sublist("run").isType<double>("end_time"));
  EXPECT_TRUE(raw.sublist("run").isType<int>("max_cycles"));
  EXPECT_TRUE(raw.sublist("output").isType<bool>("vtu"));
}

TEST(Deck, Json_holdsDefaultsAndQuotes)
{
  std::string const json = example({"title='a \"b\"'"}).json;
  EXPECT_NE(json.find("\"title\": \"a \\\"b\\\"\""), std::string::npos);
  EXPECT_NE(json.find("\"removal_order\": []"), std::string::npos);
  EXPECT_NE(json.find("\"end_time\": 1.0"), std::string::npos);
  EXPECT_EQ(std::count(json.begin(), json.end(), '{'), std::count(json.begin(), json.end(), '}'));
}

TEST(Deck, ExampleOfTheManual_isACompleteDeck)
{
  std::ifstream file(HARMOS_DECK_MANUAL);
  std::ostringstream content;
  content << file.rdbuf();
  std::string const text = content.str();
  std::string const fence = "```yaml\n";
  std::size_t const from = text.find(fence);
  ASSERT_NE(from, std::string::npos);
  std::size_t const begin = from + fence.size();
  Deck const deck = readDeckText(text.substr(begin, text.find("```", begin) - begin), "deck.md");
  EXPECT_EQ(deck.bodies.size(), 3u);
  EXPECT_EQ(deck.num_rigid_bodies, 2);
}
