// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckReader.hpp>
#include <Harmos_EquationOfState.hpp>
#include <Harmos_Temperature.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

using namespace Harmos;

namespace
{

std::string deckWith(std::string const &material)
{
  return R"(harmos:
  mesh: {x: {from: 0, to: 1, cells: 8}, y: {from: 0, to: 1, cells: 8}}
  materials:
    metal: )" +
         material + R"(
  bodies: {disc: {material: metal, shape: disc, center: [0.5, 0.5], radius: 0.15}}
  run: {end_time: 8}
)";
}

std::string const copper = "eos: mie-gruneisen, density: 8930, sound_speed: 3940, slope: 1.489, gruneisen: 2.02, ";
std::string const johnson_cook =
    "strength: johnson-cook, shear_modulus: 46.0e9, yield_stress: 90.0e6, hardening_modulus: 292.0e6, "
    "hardening_exponent: 0.31, rate_coefficient: 0.025, softening_exponent: 1.09, heat_capacity: 383, "
    "reference_temperature: 298, melting_temperature: 1356";
std::string const tillotson =
    "eos: tillotson, density: 2700, bulk_modulus: 75.2e9, quadratic_modulus: 65.0e9, a: 0.5, b: 1.63, "
    "vapour_energy: 5.0e6, incipient_vaporisation: 3.0e6, complete_vaporisation: 13.9e6";

Material law(std::string const &material, std::vector<std::string> const &overrides = {})
{
  return readDeckText(deckWith("{" + material + "}"), "deck.yaml", overrides).laws[0].law;
}

std::string message(std::string const &material, std::vector<std::string> const &overrides = {},
                    std::string const &file = "deck.yaml")
{
  try
  {
    readDeckText(deckWith("{" + material + "}"), file, overrides);
  }
  catch (DeckError const &error)
  {
    return error.what();
  }
  return "accepted";
}

#define EXPECT_STARTS(text, start) EXPECT_EQ((text).substr(0, std::string(start).size()), start) << (text)

/// A material file beside a deck, for the life of a test.
class MaterialFile
{
public:
  explicit MaterialFile(std::string const &text) : folder_(testing::TempDir()) { std::ofstream(path()) << text; }
  ~MaterialFile() { std::remove(path().c_str()); }
  std::string deck() const { return folder_ + "deck.yaml"; }
  std::string path() const { return folder_ + "harmos_metal.yaml"; }

private:
  std::string folder_;
};

std::string asFile(std::string keys)
{
  for (std::size_t at = keys.find(", "); at != std::string::npos; at = keys.find(", "))
    keys.replace(at, 2, "\n  ");
  return "# a source\nmaterial:\n  " + keys + "\n";
}

} // namespace

TEST(DeckMaterials, JohnsonCook_arrivesAsWritten)
{
  Material const m = law(copper + johnson_cook);
  EXPECT_EQ(m.strength, StrengthKind::JohnsonCook);
  EXPECT_EQ(m.hardening, 292e6);
  EXPECT_EQ(m.flow.hardening_exponent, 0.31);
  EXPECT_EQ(m.flow.rate_coefficient, 0.025);
  EXPECT_EQ(m.flow.reference_rate, 1.0);
  EXPECT_EQ(m.flow.melting_temperature, 1356.0);
  EXPECT_NEAR(temperature(m, 1.0 / 8930.0, 383e2), 398.0, 1e-9);
}

TEST(DeckMaterials, SteinbergGuinanAndPowerHardening_arriveAsWritten)
{
  Material const m =
      law(copper + "strength: steinberg-guinan, shear_modulus: 47.7e9, yield_stress: 0.12e9, largest_yield_stress: "
                   "0.64e9, hardening_coefficient: 36, hardening_exponent: 0.45, pressure_coefficient: 2.83e-11, "
                   "temperature_coefficient: 3.77e-4, heat_capacity: 383, melting_temperature: 1790, "
                   "melting_exponent: 1.5");
  EXPECT_EQ(m.strength, StrengthKind::SteinbergGuinan);
  EXPECT_EQ(m.hardening, 36.0);
  EXPECT_EQ(m.flow.largest_yield, 0.64e9);
  EXPECT_EQ(m.flow.pressure_coefficient, 2.83e-11);
  EXPECT_EQ(m.flow.melting_exponent, 1.5);
  EXPECT_EQ(m.thermal.reference_temperature, 300.0);
  Material const p = law(copper + "strength: power hardening, shear_modulus: 46.0e9, yield_stress: 90.0e6, "
                                  "hardening_modulus: 292.0e6, hardening_exponent: 0.31");
  EXPECT_EQ(p.strength, StrengthKind::PowerHardening);
  EXPECT_EQ(p.flow.hardening_exponent, 0.31);
}

TEST(DeckMaterials, Tillotson_arrivesAsWrittenAndMeetsAnInitialPressure)
{
  Material const m = law(tillotson);
  EXPECT_EQ(m.eos, EosKind::Tillotson);
  EXPECT_EQ(m.tillotson.alpha, 5.0);
  EXPECT_DOUBLE_EQ(m.sound_speed0, std::sqrt(75.2e9 / 2700.0));
  Deck const deck = readDeckText(deckWith("{" + tillotson + "}"), "deck.yaml", {"bodies/disc/pressure=2.0e9"});
  EXPECT_NEAR(equationOfState(m, 1.0 / 2700.0, deck.bodies[0].internal_energy).pressure, 2e9, 1.0);
}

TEST(DeckMaterials, ValuesThatContradict_areRefused)
{
  EXPECT_STARTS(message(copper + johnson_cook, {"materials/metal/melting_temperature=200"}),
                "deck.yaml: materials/metal/melting_temperature: 200.0 is not above reference_temperature = 298.0");
  EXPECT_STARTS(message(tillotson, {"materials/metal/complete_vaporisation=1.0e6"}),
                "deck.yaml: materials/metal/complete_vaporisation: 1000000.0 is not above");
  EXPECT_STARTS(message(copper + johnson_cook, {"materials/metal/strength=plastic"}), "deck.yaml: materials/metal/");
  EXPECT_STARTS(message(copper + "tension_limit: 1.0e9", {"bodies/disc/pressure=-2.0e9"}),
                "deck.yaml: bodies/disc/pressure: ");
}

TEST(DeckMaterials, Failure_arrivesAsWritten)
{
  std::string const damage = ", damage: johnson-cook, D1: 0.54, D2: 4.89, D3: -3.03, D4: 0.014, D5: 1.12";
  Material const m = law(copper + johnson_cook + damage + ", spall_pressure: 1.5e9, spall_stress: 2.0e9");
  EXPECT_TRUE(m.failure.damages);
  EXPECT_EQ(m.failure.d[0], 0.54);
  EXPECT_EQ(m.failure.d[2], -3.03);
  EXPECT_EQ(m.failure.d[4], 1.12);
  EXPECT_EQ(m.failure.spall_pressure, 1.5e9);
  EXPECT_EQ(m.failure.spall_stress, 2.0e9);
  EXPECT_FALSE(law(copper + johnson_cook).failure.damages);
  EXPECT_EQ(law(copper + johnson_cook).failure.spall_pressure, no_limit);
}

TEST(DeckMaterials, FailureThatCannotBe_isRefused)
{
  EXPECT_STARTS(
      message(copper + "strength: plastic, shear_modulus: 46.0e9, yield_stress: 90.0e6, damage: johnson-cook"),
      "deck.yaml: materials/metal/damage: does not belong here, only where ");
  EXPECT_STARTS(message(copper + johnson_cook + ", damage: johnson-cook, D1: 0.54"),
                "deck.yaml: materials/metal/D2: missing; expected: number");
  EXPECT_EQ(
      message(copper + "tension_limit: 1.0e9, spall_pressure: 2.0e9"),
      "deck.yaml: materials/metal/spall_pressure: 2000000000.0 is never reached: tension_limit = 1000000000.0 cuts "
      "the tension off; expected: at most that");
  EXPECT_STARTS(message(copper + "tension_limit: 1.0e9, spall_stress: 2.0e9"),
                "deck.yaml: materials/metal/spall_stress: 2000000000.0 is never reached without strength");
  EXPECT_STARTS(
      message(copper + "spall_pressure: 2.0e9", {"numerics/remap/return_kinetic_defect=true"}),
      "deck.yaml: numerics/remap/return_kinetic_defect: true does not go with materials that can fail (metal)");
}

TEST(DeckMaterials, From_readsALawFromAFileAndTheDecksKeysWin)
{
  MaterialFile const file(asFile(copper + johnson_cook));
  auto const read = [&](std::vector<std::string> const &overrides)
  { return readDeckText(deckWith("{from: harmos_metal.yaml}"), file.deck(), overrides); };
  Deck const deck = read({});
  EXPECT_EQ(deck.laws[0].law.strength, StrengthKind::JohnsonCook);
  EXPECT_EQ(deck.laws[0].law.yield, 90e6);
  EXPECT_EQ(deck.yaml.find("harmos_metal"), std::string::npos) << deck.yaml; // the echo needs no file
  EXPECT_EQ(readDeckText(deck.yaml, "echo.yaml").laws[0].law.yield, 90e6);
  EXPECT_EQ(read({"materials/metal/yield_stress=1.0e8"}).laws[0].law.yield, 1e8);
  // another strength: what the file says of the old one means nothing
  Material const fluid = read({"materials/metal/strength=none"}).laws[0].law;
  EXPECT_EQ(fluid.strength, StrengthKind::None);
  EXPECT_EQ(fluid.slope, 1.489);
  Material const linear = read({"materials/metal/strength=plastic"}).laws[0].law;
  EXPECT_EQ(linear.hardening, 292e6);
  EXPECT_EQ(linear.flow.hardening_exponent, 1.0);
}

TEST(DeckMaterials, FromWithAWrongFile_saysWhatIsWrong)
{
  EXPECT_EQ(message("from: no_such.yaml", {}, "some/deck.yaml"),
            "some/deck.yaml: materials/metal/from: some/no_such.yaml: cannot be read: there is no such file");
  MaterialFile const wrong("metal:\n  eos: rigid\n");
  EXPECT_STARTS(message("from: harmos_metal.yaml", {}, wrong.deck()),
                wrong.deck() + ": materials/metal/from: " + wrong.path() +
                    ": outermost key is metal; expected: material");
  MaterialFile const misspelt(asFile(copper + "strenght: none"));
  EXPECT_NE(message("from: harmos_metal.yaml", {}, misspelt.deck()).find("did you mean strength?"), std::string::npos);
}
