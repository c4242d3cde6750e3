// SPDX-License-Identifier: BSD-3-Clause
#include "TestMetals.hpp"

#include <Harmos_EquationOfState.hpp>
#include <Harmos_FlowStress.hpp>

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

Material gas()
{
  Material m;
  m.eos = EosKind::IdealGas;
  m.gruneisen = 1.4;
  m.density0 = 1.0;
  return m;
}

/// c^2 = dp/drho|_e + (p / rho^2) dp/de|_rho by central differences.
double soundSpeedSquaredByDifferences(Material const &m, double sv, double e)
{
  double const rho = 1.0 / sv;
  double const drho = 1e-5 * rho;
  double const de = 1e-4 * (std::fabs(e) + 1e4);
  double const p_rho =
      (equationOfState(m, 1.0 / (rho + drho), e).pressure - equationOfState(m, 1.0 / (rho - drho), e).pressure) /
      (2.0 * drho);
  double const p_e = (equationOfState(m, sv, e + de).pressure - equationOfState(m, sv, e - de).pressure) / (2.0 * de);
  return p_rho + equationOfState(m, sv, e).pressure / (rho * rho) * p_e;
}

} // namespace

TEST(EquationOfState, AllKinds_soundSpeedMatchesDifferencesOfPressure)
{
  for (Material const &m : {copper(), stiff()})
    for (double const compression : {0.8, 0.95, 1.05, 1.3, 1.6})
      for (double const e : {0.0, 1e5, 2e6})
      {
        double const sv = 1.0 / (compression * m.density0);
        double const c2 = equationOfState(m, sv, e).sound_speed_squared;
        EXPECT_NEAR(c2 / soundSpeedSquaredByDifferences(m, sv, e), 1.0, 2e-7) << compression << " " << e;
      }
  EXPECT_NEAR(equationOfState(gas(), 0.5, 2e5).sound_speed_squared / soundSpeedSquaredByDifferences(gas(), 0.5, 2e5),
              1.0, 1e-7);
}

TEST(EquationOfState, Tillotson_soundSpeedMatchesDifferencesOfPressureInEveryRegion)
{
  Material const m = tillotsonAluminium();
  // dense, cold expanded, mixture, vapour
  for (double const compression : {1.6, 1.05, 0.9, 0.6, 0.3})
    for (double const e : {1e5, 2e6, 6e6, 12e6, 20e6, 60e6})
    {
      double const sv = 1.0 / (compression * m.density0);
      EosState<double> const state = equationOfState(m, sv, e);
      double const expected = soundSpeedSquaredByDifferences(m, sv, e);
      if (expected > 1e-4 * m.sound_speed0 * m.sound_speed0)
      {
        EXPECT_NEAR(state.sound_speed_squared / expected, 1.0, 1e-6) << compression << " " << e;
        EXPECT_TRUE(eosInRange(m, sv, e));
      }
      else
        EXPECT_FALSE(eosInRange(m, sv, e)) << compression << " " << e;
    }
}

TEST(EquationOfState, AllKinds_pressureAlongAnIsentropeRisesWithTheReturnedSoundSpeed)
{
  // de = -p dsv by Runge-Kutta steps: at constant entropy dp/drho is c^2
  Material tillotson = tillotsonAluminium();
  for (Material const &m : {copper(), stiff(), gas(), tillotson})
    for (double const compression : {0.97, 1.02, 1.3})
    {
      double const sv0 = 1.0 / (compression * m.density0), e0 = 3e5;
      auto const along = [&](double part)
      {
        double sv = sv0, e = e0;
        int const steps = 20;
        double const d = part * sv0 / steps;
        for (int i = 0; i < steps; ++i, sv += d)
        {
          double const k1 = -equationOfState(m, sv, e).pressure;
          double const k2 = -equationOfState(m, sv + 0.5 * d, e + 0.5 * d * k1).pressure;
          double const k3 = -equationOfState(m, sv + 0.5 * d, e + 0.5 * d * k2).pressure;
          double const k4 = -equationOfState(m, sv + d, e + d * k3).pressure;
          e += d * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
        }
        return equationOfState(m, sv, e).pressure;
      };
      double const h = 1e-4;
      double const c2 = -sv0 * (along(h) - along(-h)) / (2.0 * h);
      EXPECT_NEAR(c2 / equationOfState(m, sv0, e0).sound_speed_squared, 1.0, 2e-6) << compression;
    }
}

TEST(EquationOfState, Tillotson_isContinuousAcrossItsRegions)
{
  Material const m = tillotsonAluminium();
  double const tiny = 1e-9;
  for (double const e : {1e6, 8e6, 30e6})
    EXPECT_NEAR(equationOfState(m, (1.0 - tiny) / m.density0, e).pressure /
                    equationOfState(m, (1.0 + tiny) / m.density0, e).pressure,
                1.0, 1e-7);
  for (double const e : {m.tillotson.incipient, m.tillotson.complete})
    EXPECT_NEAR(equationOfState(m, 1.5 / m.density0, e * (1.0 - tiny)).pressure /
                    equationOfState(m, 1.5 / m.density0, e * (1.0 + tiny)).pressure,
                1.0, 1e-7);
}

TEST(EquationOfState, TillotsonDenseAndHot_isTheSolidsFormula)
{
  Material const m = tillotsonAluminium();
  double const e = 30e6, rho = 1.1 * 2700.0; // above E_cv, but dense
  double const w = 1.0 + e / (5e6 * 1.21);
  double const expected = (0.5 + 1.63 / w) * rho * e + 75.2e9 * 0.1 + 65e9 * 0.01;
  EXPECT_NEAR(equationOfState(m, 1.0 / rho, e).pressure / expected, 1.0, 1e-12);
}

namespace
{

/// Speed of the shock behind which the material moves at u: p(sv, u^2 / 2) = rho0 Us u.
double shockSpeed(Material const &m, double u)
{
  double low = u, high = 10.0 * u + 1e4;
  for (int i = 0; i < 100; ++i)
  {
    double const us = 0.5 * (low + high);
    double const sv = (us - u) / (us * m.density0);
    (equationOfState(m, sv, 0.5 * u * u).pressure > m.density0 * us * u ? low : high) = us;
  }
  return low;
}

} // namespace

TEST(EquationOfState, TillotsonsAluminium_meetsTheMeasuredHugoniotTo500GigapascalWithinTwoPerCent)
{
  // Mitchell & Nellis, J. Appl. Phys. 52 (1981) 3363; Knudson et al., J. Appl. Phys. 94 (2003) 4420 (u above 6.3 km/s)
  Material const m = tillotsonAluminium();
  for (double const u : {500.0, 1000.0, 2000.0, 3000.0, 4000.0, 6000.0})
    EXPECT_NEAR(shockSpeed(m, u) / (5386.0 + 1.339 * u), 1.0, 0.02) << u;
  for (double const u : {6500.0, 8000.0, 10000.0})
    EXPECT_NEAR(shockSpeed(m, u) / (6322.0 + 1.189 * u), 1.0, 0.01) << u;
}

TEST(EquationOfState, TillotsonsIron_meetsTheMeasuredHugoniotTo260GigapascalWithinFourPerCent)
{
  // Us = 3.955 + 1.58 u above the transition at 13 GPa: McQueen et al., High-Velocity Impact Phenomena (1970), ch. VII
  Material m = tillotsonAluminium();
  m.density0 = 7800.0;
  m.tillotson = {0.5, 1.5, 128.0e9, 105.0e9, 5.0, 5.0, 9.5e6, 2.4e6, 8.67e6};
  m.sound_speed0 = std::sqrt(128.0e9 / 7800.0);
  for (double const u : {500.0, 1000.0, 2000.0, 3000.0, 4000.0})
    EXPECT_NEAR(shockSpeed(m, u) / (3955.0 + 1.58 * u), 1.0, 0.04) << u;
}

TEST(EquationOfState, TillotsonsVapour_becomesAnIdealGasWithGammaOnePlusA)
{
  Material const m = tillotsonAluminium();
  double const rho = 1e-3 * m.density0, e = 50e6;
  auto const state = equationOfState(m, 1.0 / rho, e);
  EXPECT_NEAR(state.pressure / (0.5 * rho * e), 1.0, 1e-12);
  EXPECT_NEAR(state.sound_speed_squared / (1.5 * 0.5 * e), 1.0, 1e-12);
}

TEST(EquationOfState, RangesEnd_whereNoStableAnswerIsLeft)
{
  Material m = copper();
  EXPECT_TRUE(eosInRange(m, 1.05 / m.density0, m.energy0));
  EXPECT_FALSE(eosInRange(m, 3.0 / m.density0, m.energy0)); // c^2 on its floor
  m.tension_limit = 1.2e9;
  EXPECT_TRUE(eosInRange(m, 3.0 / m.density0, m.energy0)); // cut off before that
  EXPECT_FALSE(eosInRange(gas(), 1.0, -1.0));
  EXPECT_TRUE(eosInRange(gas(), 1.0, 1.0));
  Material const t = tillotsonAluminium();
  EXPECT_TRUE(eosInRange(t, 1.0 / t.density0, -0.1 * t.tillotson.energy));
  EXPECT_FALSE(eosInRange(t, 1.0 / t.density0, -0.6 * t.tillotson.energy));
  EXPECT_FALSE(eosInRange(t, 1.0 / t.density0, -2.0 * t.tillotson.energy)); // beyond the pole, c^2 > 0 again
}

TEST(EquationOfState, ReferenceState_hasNoPressureAndSoundSpeedC0)
{
  for (Material const &m : {copper(), stiff()})
  {
    auto const state = equationOfState(m, 1.0 / m.density0, m.energy0);
    EXPECT_NEAR(state.pressure, 0.0, 1e-3);
    EXPECT_NEAR(state.sound_speed_squared / (m.sound_speed0 * m.sound_speed0), 1.0, 1e-12);
  }
}

TEST(EquationOfState, MieGruneisen_isContinuousWithItsSlopeAtTheReferenceDensity)
{
  Material const m = copper();
  double const e = 3e5;
  double const sv = 1.0 / m.density0;
  auto const left = equationOfState(m, sv * (1.0 - 1e-9), e);
  auto const right = equationOfState(m, sv * (1.0 + 1e-9), e);
  EXPECT_NEAR(left.pressure / right.pressure, 1.0, 1e-6);
  EXPECT_NEAR(left.sound_speed_squared / right.sound_speed_squared, 1.0, 1e-7);
}

TEST(EquationOfState, MieGruneisen_shockStatesLieOnTheHugoniot)
{
  // rho0 Us = rho (Us - u), P = rho0 Us u, e - e0 = u^2 / 2
  Material const m = copper();
  for (double const u : {500.0, 3320.0})
  {
    double const shock = m.sound_speed0 + m.slope * u;
    double const sv = (shock - u) / (shock * m.density0);
    double const expected = m.density0 * shock * u;
    EXPECT_NEAR(equationOfState(m, sv, m.energy0 + 0.5 * u * u).pressure / expected, 1.0, 1e-12);
    EXPECT_TRUE(eosInRange(m, sv, m.energy0 + 0.5 * u * u));
  }
  // copper on copper at 1 km/s: 20.92 GPa
  double const shock = m.sound_speed0 + m.slope * 500.0;
  EXPECT_NEAR(m.density0 * shock * 500.0, 20.92e9, 0.01e9);
}

TEST(EquationOfState, MieGruneisen_pastThePoleStaysFiniteAndIsOutOfRange)
{
  Material const m = copper();
  double const sv = (1.0 - 1.0 / m.slope) / m.density0;
  auto const state = equationOfState(m, sv, 0.0);
  EXPECT_TRUE(std::isfinite(state.pressure) && std::isfinite(state.sound_speed_squared));
  EXPECT_GT(state.pressure, 0.0);
  EXPECT_FALSE(eosInRange(m, sv, 0.0));
  EXPECT_FALSE(eosInRange(m, -sv, 0.0));
  EXPECT_TRUE(eosInRange(stiff(), sv, 0.0));
}

TEST(EquationOfState, StrongTension_keepsASoundSpeed)
{
  Material const m = copper();
  auto const state = equationOfState(m, 3.0 / m.density0, 0.0);
  EXPECT_LT(state.pressure, 0.0);
  EXPECT_DOUBLE_EQ(state.sound_speed_squared, 1e-4 * m.sound_speed0 * m.sound_speed0);
}

TEST(EquationOfState, TensionLimit_cutsThePressureOffAndNothingElse)
{
  Material free;
  free.eos = EosKind::MieGruneisen;
  free.density0 = 2703.0;
  free.sound_speed0 = 5240.0;
  free.slope = 1.4;
  free.gruneisen = 1.97;
  Material limited = free;
  limited.tension_limit = 1.2e9;
  double const mild = 1.01 / 2703.0, strong = 1.10 / 2703.0;
  EXPECT_GT(equationOfState(free, mild, 0.0).pressure, -1.2e9);
  EXPECT_EQ(equationOfState(limited, mild, 0.0).pressure, equationOfState(free, mild, 0.0).pressure);
  EXPECT_LT(equationOfState(free, strong, 0.0).pressure, -5e9);
  EXPECT_EQ(equationOfState(limited, strong, 0.0).pressure, -1.2e9);
  EXPECT_DOUBLE_EQ(equationOfState(limited, strong, 0.0).sound_speed_squared,
                   equationOfState(free, strong, 0.0).sound_speed_squared);
}

TEST(EquationOfState, StiffenedWithoutGruneisen_isLinearInDensity)
{
  Material m = stiff();
  m.gruneisen = 0.0;
  for (double const mu : {-0.3, 0.0, 0.2})
  {
    auto const state = equationOfState(m, 1.0 / (m.density0 * (1.0 + mu)), 5e5);
    EXPECT_NEAR(state.pressure, m.density0 * m.sound_speed0 * m.sound_speed0 * mu, 1.0);
    EXPECT_DOUBLE_EQ(state.sound_speed_squared, m.sound_speed0 * m.sound_speed0);
  }
}

TEST(LongitudinalSoundSpeed, SixtySixtyOne_is6409MetresPerSecond)
{
  Material m;
  m.density0 = 2703.0;
  m.sound_speed0 = 5240.0;
  m.shear_modulus = 27.6e9;
  double const c2 = m.sound_speed0 * m.sound_speed0;
  EXPECT_DOUBLE_EQ(longitudinalSoundSpeedSquared(m, c2, 1.0 / m.density0, 0.0), c2); // no strength
  m.strength = StrengthKind::Plastic;
  EXPECT_NEAR(std::sqrt(longitudinalSoundSpeedSquared(m, c2, 1.0 / m.density0, 0.0)), 6409.0, 0.5);
}
