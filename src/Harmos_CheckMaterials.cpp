// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_CheckScene.hpp"
#include "Harmos_Require.hpp"

#include <Harmos_FlowStress.hpp>

namespace Harmos
{
namespace
{

using namespace detail;

/// A bound that may be as good as none, infinity.
void requireBound(std::string const &entry, double value)
{
  require(value > 0.0, entry + " is " + text(value) + "; expected: above 0");
}

void requireAbove(std::string const &entry, double value, char const *other, double bound)
{
  require(value > bound, entry + " is " + text(value) + "; expected: above " + other + ", " + text(bound));
}

void checkTillotson(TillotsonLaw const &t, std::string const &law)
{
  std::string const path = law + ".tillotson.";
  requirePositive(path + "bulk", t.bulk);
  requireNotNegative(path + "quadratic", t.quadratic);
  requireNotNegative(path + "a", t.a);
  requireNotNegative(path + "b", t.b);
  requireNotNegative(path + "alpha", t.alpha);
  requireNotNegative(path + "beta", t.beta);
  requirePositive(path + "energy", t.energy);
  requirePositive(path + "incipient", t.incipient);
  requireAbove(path + "complete", t.complete, "incipient", t.incipient);
}

void checkEquationOfState(Material const &m, std::string const &law)
{
  requirePositive(law + ".density0", m.density0);
  requireFinite(law + ".energy0", m.energy0);
  require(m.tension_limit >= 0.0, law + ".tension_limit is " + text(m.tension_limit) + "; expected: 0 or more");
  if (m.eos == EosKind::IdealGas)
  {
    requireFinite(law + ".gruneisen", m.gruneisen);
    require(m.gruneisen > 1.0, law + ".gruneisen is " + text(m.gruneisen) + "; expected: above 1, gamma of a gas");
    return;
  }
  requirePositive(law + ".sound_speed0", m.sound_speed0);
  requireNotNegative(law + ".gruneisen", m.gruneisen);
  requireNotNegative(law + ".slope", m.slope);
  if (m.eos == EosKind::Tillotson)
    checkTillotson(m.tillotson, law);
}

void checkTemperature(Material const &m, std::string const &law)
{
  requirePositive(law + ".thermal.heat_capacity", m.thermal.heat_capacity); // setThermalCurve
  requirePositive(law + ".thermal.reference_temperature", m.thermal.reference_temperature);
  requireAbove(law + ".flow.melting_temperature", m.flow.melting_temperature, "thermal.reference_temperature",
               m.thermal.reference_temperature);
}

void checkFlowLaw(Material const &m, std::string const &law)
{
  FlowLaw const &flow = m.flow;
  std::string const path = law + ".flow.";
  requireNotNegative(path + "hardening_exponent", flow.hardening_exponent);
  if (m.strength == StrengthKind::PowerHardening)
    return;
  checkTemperature(m, law);
  if (m.strength == StrengthKind::JohnsonCook)
  {
    requireNotNegative(path + "rate_coefficient", flow.rate_coefficient);
    requirePositive(path + "reference_rate", flow.reference_rate);
    requirePositive(path + "softening_exponent", flow.softening_exponent);
    return;
  }
  requireNotNegative(path + "initial_strain", flow.initial_strain);
  require(flow.largest_yield >= m.yield,
          path + "largest_yield is " + text(flow.largest_yield) + "; expected: at least yield, " + text(m.yield));
  requireNotNegative(path + "pressure_coefficient", flow.pressure_coefficient);
  requireNotNegative(path + "temperature_coefficient", flow.temperature_coefficient);
  requireNotNegative(path + "melting_exponent", flow.melting_exponent);
}

void checkStrength(Material const &m, std::string const &law)
{
  if (m.strength == StrengthKind::None)
    return;
  requirePositive(law + ".shear_modulus", m.shear_modulus);
  if (m.strength == StrengthKind::Elastic)
    return;
  requirePositive(law + ".yield", m.yield);
  requireNotNegative(law + ".hardening", m.hardening);
  if (hasFlowLaw(m))
    checkFlowLaw(m, law);
}

void checkFailure(Material const &m, std::string const &law)
{
  requireBound(law + ".failure.spall_pressure", m.failure.spall_pressure);
  requireBound(law + ".failure.spall_stress", m.failure.spall_stress);
  if (!m.failure.damages)
    return;
  checkTemperature(m, law);
  for (double const d : m.failure.d)
    requireFinite(law + ".failure.d", d);
}

} // namespace

void checkMaterials(std::vector<Material> const &laws)
{
  for (std::size_t m = 0; m < laws.size(); ++m)
  {
    std::string const law = "scene.materials(" + std::to_string(m) + ")";
    if (laws[m].rigid_body >= 0)
    {
      requirePositive(law + ".density0", laws[m].density0);
      continue;
    }
    checkEquationOfState(laws[m], law);
    checkStrength(laws[m], law);
    checkFailure(laws[m], law);
  }
}

} // namespace Harmos
