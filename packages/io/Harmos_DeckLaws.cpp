// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckLaws.hpp>
#include <Harmos_DeckReader.hpp>
#include <Harmos_Temperature.hpp>

#include <cmath>

namespace Harmos
{

namespace
{

using Teuchos::ParameterList;

StrengthKind strengthOf(std::string const &word)
{
  return word == "elastic"            ? StrengthKind::Elastic
         : word == "plastic"          ? StrengthKind::Plastic
         : word == "power hardening"  ? StrengthKind::PowerHardening
         : word == "johnson-cook"     ? StrengthKind::JohnsonCook
         : word == "steinberg-guinan" ? StrengthKind::SteinbergGuinan
                                      : StrengthKind::None;
}

/// The numbers of a law's list; absent ones are zero.
struct LawNumbers
{
  ParameterList const &list;
  double operator()(char const *key) const { return list.isParameter(key) ? list.get<double>(key) : 0.0; }
  double operator()(char const *key, double absent) const
  {
    return list.isParameter(key) ? list.get<double>(key) : absent;
  }
};

void convertTillotson(DeckChecker const &check, LawNumbers const &value, std::string const &path, Material &law)
{
  TillotsonLaw &t = law.tillotson;
  t.a = value("a");
  t.b = value("b");
  t.bulk = value("bulk_modulus");
  t.quadratic = value("quadratic_modulus");
  t.alpha = value("alpha");
  t.beta = value("beta");
  t.energy = value("vapour_energy");
  t.incipient = value("incipient_vaporisation");
  t.complete = value("complete_vaporisation");
  check.require(t.complete > t.incipient, keyPath(path, "complete_vaporisation"),
                numberText(t.complete) + " is not above incipient_vaporisation = " + numberText(t.incipient));
  law.sound_speed0 = std::sqrt(t.bulk / law.density0);
  law.gruneisen = t.a + t.b;
}

void convertStrength(DeckChecker const &check, LawNumbers const &value, std::string const &path, Material &law)
{
  law.shear_modulus = value("shear_modulus");
  law.yield = value("yield_stress");
  bool const steinberg = law.strength == StrengthKind::SteinbergGuinan;
  law.hardening = value(steinberg ? "hardening_coefficient" : "hardening_modulus");
  FlowLaw &flow = law.flow;
  flow.hardening_exponent = value("hardening_exponent", 1.0);
  flow.rate_coefficient = value("rate_coefficient");
  flow.reference_rate = value("reference_rate", 1.0);
  flow.softening_exponent = value("softening_exponent", 1.0);
  flow.initial_strain = value("initial_plastic_strain");
  flow.largest_yield = value("largest_yield_stress", flow.largest_yield);
  check.require(flow.largest_yield >= law.yield, keyPath(path, "largest_yield_stress"),
                numberText(flow.largest_yield) + " is below yield_stress = " + numberText(law.yield) +
                    "; expected: at least that");
  flow.pressure_coefficient = value("pressure_coefficient");
  flow.temperature_coefficient = value("temperature_coefficient");
  flow.melting_exponent = value("melting_exponent");
  if (!value.list.isParameter("heat_capacity"))
    return;
  flow.melting_temperature = value("melting_temperature");
  double const reference = value("reference_temperature");
  check.require(flow.melting_temperature > reference, keyPath(path, "melting_temperature"),
                numberText(flow.melting_temperature) +
                    " is not above reference_temperature = " + numberText(reference));
  setThermalCurve(law, value("heat_capacity"), reference);
}

void convertFailure(DeckChecker const &check, LawNumbers const &value, std::string const &path, Material &law)
{
  FailureLaw &failure = law.failure;
  if (value("spall_pressure") > 0.0)
    failure.spall_pressure = value("spall_pressure");
  if (value("spall_stress") > 0.0)
    failure.spall_stress = value("spall_stress");
  check.require(failure.spall_pressure >= no_limit || failure.spall_pressure <= law.tension_limit,
                keyPath(path, "spall_pressure"),
                numberText(failure.spall_pressure) + " is never reached: tension_limit = " +
                    numberText(law.tension_limit) + " cuts the tension off; expected: at most that");
  check.require(law.strength != StrengthKind::None || failure.spall_stress >= no_limit ||
                    failure.spall_stress <= law.tension_limit,
                keyPath(path, "spall_stress"),
                numberText(failure.spall_stress) + " is never reached without strength: tension_limit = " +
                    numberText(law.tension_limit) + " cuts the tension off; expected: at most that");
  ParameterList const &list = value.list;
  failure.damages = list.isParameter("damage") && list.get<std::string>("damage") == "johnson-cook";
  char const *const key[5] = {"D1", "D2", "D3", "D4", "D5"};
  for (int i = 0; failure.damages && i < 5; ++i)
    failure.d[i] = value(key[i]);
}

} // namespace

void convertLaws(DeckChecker const &check, ParameterList const &materials, Deck &deck)
{
  for (auto i = materials.begin(); i != materials.end(); ++i)
  {
    ParameterList const &list = materials.sublist(materials.name(i));
    LawNumbers const value{list};
    LawSpec spec;
    spec.name = materials.name(i);
    std::string const path = "materials/" + spec.name;
    std::string const eos = list.get<std::string>("eos");
    spec.rigid = eos == "rigid";
    Material &law = spec.law;
    law.eos = eos == "mie-gruneisen" ? EosKind::MieGruneisen
              : eos == "ideal gas"   ? EosKind::IdealGas
              : eos == "tillotson"   ? EosKind::Tillotson
                                     : EosKind::Stiffened;
    law.density0 = value("density");
    law.sound_speed0 = value("sound_speed");
    law.slope = value("slope");
    law.gruneisen = eos == "ideal gas" ? value("gamma") : value("gruneisen");
    law.energy0 = value("internal_energy");
    if (law.eos == EosKind::Tillotson)
      convertTillotson(check, value, path, law);
    if (list.isParameter("strength"))
      law.strength = strengthOf(list.get<std::string>("strength"));
    convertStrength(check, value, path, law);
    if (value("tension_limit") > 0.0)
      law.tension_limit = value("tension_limit");
    convertFailure(check, value, path, law);
    deck.laws.push_back(spec);
  }
}

} // namespace Harmos
