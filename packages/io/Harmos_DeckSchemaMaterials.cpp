// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SchemaRules.hpp>

namespace Harmos
{

using namespace SchemaRules;

namespace
{

void addModulus(ParameterList &list)
{
  add(list, "shear_modulus", 0.0, required(number(positive, "Pa")), "shear modulus of the reference state");
}

void addYield(ParameterList &list)
{
  addModulus(list);
  add(list, "yield_stress", 0.0, required(number(positive, "Pa")), "initial yield stress in simple tension");
}

void addTemperature(ParameterList &list)
{
  add(list, "heat_capacity", 0.0, required(number(positive, "J/(kg K)")), "at constant volume");
  add(list, "reference_temperature", 300.0, number(positive, "K"), "of the reference density and energy");
  add(list, "melting_temperature", 0.0, required(number(positive, "K")),
      "where the yield stress is gone; above the reference temperature");
}

void addSpall(ParameterList &list)
{
  add(list, "spall_pressure", 0.0, number(not_negative, "Pa"),
      "what reaches this tension (minus the pressure) fails: it carries neither tension nor shear any more, void "
      "opens; 0: never");
  add(list, "spall_stress", 0.0, number(not_negative, "Pa"),
      "the same for the largest principal stress (tension positive); 0: never");
}

/// Johnson-Cook damage, beside the strength that gives strain rate and temperature.
void addDamage(ParameterList &list)
{
  add(list, "damage", std::string("none"), choice({"none", "johnson-cook"}),
      "johnson-cook: fails where the sum of d eps / ((D1 + D2 exp(D3 x)) (1 + D4 ln rate) (1 + D5 T*)) reaches 1, "
      "x = -p / q");
  ParameterList &damage = list.sublist("damage = johnson-cook");
  for (char const *key : {"D1", "D2", "D3", "D4", "D5"})
    add(damage, key, 0.0, required(number(any)), "of Johnson and Cook (1985)");
}

void addStrength(ParameterList &list)
{
  add(list, "strength", std::string("none"),
      choice({"none", "elastic", "plastic", "power hardening", "johnson-cook", "steinberg-guinan"}),
      "none: a fluid; elastic: linear deviator; else von Mises, radial return. plastic: linear hardening; power "
      "hardening: Y = yield_stress + hardening_modulus eps^hardening_exponent; johnson-cook: that times (1 + "
      "rate_coefficient ln rate) (1 - T*^softening_exponent); steinberg-guinan: modulus and yield stress with pressure "
      "and temperature");
  addModulus(list.sublist("strength = elastic"));
  ParameterList &plastic = list.sublist("strength = plastic");
  addYield(plastic);
  add(plastic, "hardening_modulus", 0.0, number(not_negative, "Pa"),
      "growth of the yield stress per equivalent plastic strain; 0: perfectly plastic");
  for (char const *law : {"power hardening", "johnson-cook"})
  {
    ParameterList &power = list.sublist(std::string("strength = ") + law);
    addYield(power);
    add(power, "hardening_modulus", 0.0, required(number(not_negative, "Pa")), "factor of eps^hardening_exponent");
    add(power, "hardening_exponent", 0.0, required(number({0.0, 2.0, true, false})), "exponent of the plastic strain");
  }
  ParameterList &johnson_cook = list.sublist("strength = johnson-cook");
  add(johnson_cook, "rate_coefficient", 0.0, number(not_negative),
      "growth of the yield stress with the logarithm of the plastic strain rate");
  add(johnson_cook, "reference_rate", 1.0, number(positive, "1/s"), "below it the rate has no effect");
  add(johnson_cook, "softening_exponent", 0.0, required(number(positive)),
      "exponent of T* = (T - reference_temperature) / (melting_temperature - reference_temperature)");
  addTemperature(johnson_cook);
  addDamage(johnson_cook);
  ParameterList &steinberg = list.sublist("strength = steinberg-guinan");
  addYield(steinberg);
  add(steinberg, "largest_yield_stress", 0.0, required(number(positive, "Pa")),
      "limit of the work hardening, before pressure and temperature");
  add(steinberg, "hardening_coefficient", 0.0, required(number(not_negative)),
      "beta in Y = yield_stress (1 + beta (eps + initial_plastic_strain))^hardening_exponent");
  add(steinberg, "hardening_exponent", 0.0, required(number(not_negative)), "n");
  add(steinberg, "initial_plastic_strain", 0.0, number(not_negative), "work hardening before the run");
  add(steinberg, "pressure_coefficient", 0.0, required(number(not_negative, "1/Pa")),
      "A in G / G0 = 1 + A p (rho / rho0)^(-1/3) - B (T - 300 K)");
  add(steinberg, "temperature_coefficient", 0.0, required(number(not_negative, "1/K")), "B there");
  addTemperature(steinberg);
  add(steinberg, "melting_exponent", 0.0, required(number(not_negative)),
      "a in T_m = melting_temperature exp(2 a (1 - rho0 / rho)) (rho / rho0)^(2 (gruneisen - a - 1/3))");
}

void addTillotson(ParameterList &list)
{
  add(list, "bulk_modulus", 0.0, required(number(positive, "Pa")), "A of Tillotson; with density the sound speed");
  add(list, "quadratic_modulus", 0.0, required(number(not_negative, "Pa")), "B of Tillotson");
  add(list, "a", 0.0, required(number(not_negative)), "Grueneisen coefficient of the hot, thin vapour");
  add(list, "b", 0.0, required(number(not_negative)), "a + b: Grueneisen coefficient of the cold solid");
  add(list, "alpha", 5.0, number(not_negative), "decay of the solid's terms in the vapour");
  add(list, "beta", 5.0, number(not_negative), "decay of the elastic term in the vapour");
  add(list, "vapour_energy", 0.0, required(number(positive, "J/kg")), "E0 of Tillotson");
  add(list, "incipient_vaporisation", 0.0, required(number(positive, "J/kg")), "energy where vapour begins to form");
  add(list, "complete_vaporisation", 0.0, required(number(positive, "J/kg")),
      "energy where all is vapour, above incipient_vaporisation");
}

} // namespace

void addMaterials(ParameterList &materials)
{
  ParameterList &list = materials.sublist("NAME");
  add(list, "eos", std::string(), required(choice({"stiffened", "mie-gruneisen", "tillotson", "ideal gas", "rigid"})),
      "stiffened: p = c0^2 (rho - rho0) + gruneisen rho (e - e0); mie-gruneisen: Hugoniot Us = c0 + slope up; "
      "tillotson: solid to vapour; ideal gas: p = (gamma - 1) rho e; rigid: moves as a rigid body");
  add(list, "density", 0.0, required(number(plausible_density, "kg/m^3")), "reference density rho0");
  for (char const *eos : {"stiffened", "mie-gruneisen", "tillotson"})
  {
    ParameterList &solid = list.sublist(std::string("eos = ") + eos);
    if (eos == std::string("tillotson"))
      addTillotson(solid);
    else
      add(solid, "sound_speed", 0.0, required(number(positive, "m/s")), "bulk sound speed c0 of the reference state");
    if (eos == std::string("mie-gruneisen"))
      add(solid, "slope", 0.0, required(number(not_negative)), "slope of shock over particle velocity");
    if (eos != std::string("tillotson"))
    {
      add(solid, "gruneisen", 0.0, number(not_negative), "Grueneisen coefficient of the reference state");
      add(solid, "internal_energy", 0.0, number(any, "J/kg"), "internal energy e0 of the reference state");
    }
    add(solid, "tension_limit", 0.0, number(not_negative, "Pa"),
        "the pressure does not fall below minus this (a cut-off: the material then stretches without more resistance, "
        "where spall_pressure opens void); 0: no limit");
    addSpall(solid);
    addStrength(solid);
  }
  ParameterList &gas = list.sublist("eos = ideal gas");
  add(gas, "gamma", 0.0, required(number({1.0, infinity, true, false})), "ratio of specific heats");
  add(gas, "internal_energy", 0.0, number(not_negative, "J/kg"), "internal energy that bodies start with by default");
  add(list, "from", std::string(), optional(rulesOf(KeyType::Text), "no file"),
      "file with the keys of a law, from the deck's folder (example/materials has a library); the keys given here win");
}

} // namespace Harmos
