// SPDX-License-Identifier: BSD-3-Clause
#include "TestMetals.hpp"

#include <Harmos_EquationOfState.hpp>
#include <Harmos_Temperature.hpp>

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

Material warm(Material m)
{
  setThermalCurve(m, 383.0, 300.0);
  return m;
}

/// d(1/T)/dsv at constant e less d(p/T)/de at constant sv, over the first: zero where T ds = de + p dsv is exact.
double maxwellError(Material const &m, double sv, double e)
{
  double const dv = 1e-5 * sv, de = 1e2;
  double const by_sv = (1.0 / temperature(m, sv + dv, e) - 1.0 / temperature(m, sv - dv, e)) / (2.0 * dv);
  double const by_e = (equationOfState(m, sv, e + de).pressure / temperature(m, sv, e + de) -
                       equationOfState(m, sv, e - de).pressure / temperature(m, sv, e - de)) /
                      (2.0 * de);
  return std::fabs(by_sv / by_e - 1.0);
}

/// Energy and temperature on the isentrope through the reference state, by Runge-Kutta.
void isentrope(Material const &m, double eta, double &e, double &t)
{
  bool const mie = m.eos == EosKind::MieGruneisen;
  int const steps = 2000;
  double const d = -eta / (steps * m.density0);
  e = m.energy0;
  t = m.thermal.reference_temperature;
  for (int i = 0; i < steps; ++i)
  {
    double const sv = 1.0 / m.density0 + i * d;
    auto const p = [&](double v, double energy) { return -equationOfState(m, v, energy).pressure; };
    auto const r = [&](double v) { return mie ? -m.gruneisen * m.density0 : -m.gruneisen / v; };
    double const k1 = p(sv, e), k2 = p(sv + 0.5 * d, e + 0.5 * d * k1), k3 = p(sv + 0.5 * d, e + 0.5 * d * k2),
                 k4 = p(sv + d, e + d * k3);
    e += d * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
    t *= std::exp(d * (r(sv) + 4.0 * r(sv + 0.5 * d) + r(sv + d)) / 6.0);
  }
}

} // namespace

TEST(Temperature, ReferenceState_hasTheReferenceTemperature)
{
  for (Material const &m : {warm(copper()), warm(stiff())})
  {
    EXPECT_NEAR(temperature(m, 1.0 / m.density0, m.energy0), 300.0, 1e-10);
    EXPECT_NEAR(temperature(m, 1.0 / m.density0, m.energy0 + 383.0 * 100.0), 400.0, 1e-10); // de = c_v dT
  }
}

TEST(Temperature, IsentropeOfTheReferenceState_isFollowed)
{
  for (Material const &m : {warm(copper()), warm(stiff())})
    for (double const eta : {-0.1, -0.02, 0.05, 0.15, 0.25})
    {
      double e, t;
      isentrope(m, eta, e, t);
      EXPECT_NEAR(temperature(m, (1.0 - eta) / m.density0, e), t, 1e-3 * t) << eta;
    }
}

TEST(Temperature, PressureAndTemperature_obeyMaxwellsRelation)
{
  for (Material const &m : {warm(copper()), warm(stiff())})
    for (double const eta : {-0.05, 0.02, 0.1, 0.2})
      for (double const heat : {2e4, 2e5})
      {
        double e, t;
        isentrope(m, eta, e, t);
        EXPECT_LT(maxwellError(m, (1.0 - eta) / m.density0, e + heat), 2e-3) << eta << " " << heat;
      }
}

TEST(Temperature, CopperOnItsHugoniot_isThatOfWalshAndChristiansEquation)
{
  // dT/dsv + gamma / sv T = (p_H + (sv0 - sv) dp_H/dsv) / (2 c_v): Walsh & Christian, Phys. Rev. 97 (1955) 1544
  Material const m = warm(copper());
  double const c = m.sound_speed0, s = m.slope;
  auto const hugoniot = [&](double eta) { return m.density0 * c * c * eta / ((1.0 - s * eta) * (1.0 - s * eta)); };
  auto const slope = [&](double eta)
  { return m.density0 * c * c * (1.0 + s * eta) / ((1.0 - s * eta) * (1.0 - s * eta) * (1.0 - s * eta)); };
  double t = 300.0, eta = 0.0;
  int const steps = 200000;
  double const d = 0.3 / steps;
  for (int i = 0; i < steps; ++i, eta += d)
  {
    double const mid = eta + 0.5 * d; // dT/deta = gamma0 T - (p_H - eta dp_H/deta) / (2 rho0 c_v)
    auto const rate = [&](double x, double temperature)
    { return m.gruneisen * temperature - (hugoniot(x) - x * slope(x)) / (2.0 * m.density0 * 383.0); };
    t += d * rate(mid, t + 0.5 * d * rate(eta, t));
    if (i == steps / 3 || i == steps / 2 || i == steps - 1)
    {
      double const e = m.energy0 + 0.5 * hugoniot(eta + d) * (eta + d) / m.density0;
      EXPECT_NEAR(temperature(m, (1.0 - eta - d) / m.density0, e) / t, 1.0, eta < 0.2 ? 1e-4 : 5e-3) << eta;
    }
  }
}

TEST(Temperature, BeyondItsSeries_staysFiniteAndGrowsWithEnergy)
{
  for (Material const &m : {warm(copper()), warm(stiff())})
    for (double const sv : {0.3, 5.0, 100.0})
    {
      double const cold = temperature(m, sv / m.density0, 0.0), hot = temperature(m, sv / m.density0, 1e6);
      EXPECT_TRUE(std::isfinite(cold));
      EXPECT_NEAR(hot - cold, 1e6 / 383.0, 1e-6);
    }
}

TEST(Temperature, TillotsonAtLowEnergy_obeysMaxwellsRelation)
{
  Material m = tillotsonAluminium();
  setThermalCurve(m, 890.0, 300.0);
  EXPECT_NEAR(temperature(m, 1.0 / m.density0, 0.0), 300.0, 1e-10);
  // gamma falls with e / E0, and the error with it
  for (double const sv : {0.99, 1.01})
  {
    EXPECT_LT(maxwellError(m, sv / m.density0, 1e5), 0.1);
    EXPECT_LT(maxwellError(m, sv / m.density0, 1e4), 0.01);
  }
}
