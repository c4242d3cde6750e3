// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Strength.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

/// OFHC copper, Johnson & Cook (1983).
Material johnsonCookCopper()
{
  Material m;
  m.eos = EosKind::MieGruneisen;
  m.strength = StrengthKind::JohnsonCook;
  m.density0 = 8930.0;
  m.sound_speed0 = 3940.0;
  m.slope = 1.489;
  m.gruneisen = 2.02;
  m.shear_modulus = 46e9;
  m.yield = 90e6;
  m.hardening = 292e6;
  m.flow.hardening_exponent = 0.31;
  m.flow.rate_coefficient = 0.025;
  m.flow.softening_exponent = 1.09;
  m.flow.melting_temperature = 1356.0;
  setThermalCurve(m, 383.0, 298.0);
  return m;
}

/// OFHC copper, Steinberg, UCRL-MA-106439 (1996).
Material steinbergCopper()
{
  Material m = johnsonCookCopper();
  m.strength = StrengthKind::SteinbergGuinan;
  m.shear_modulus = 47.7e9;
  m.yield = 0.12e9;
  m.hardening = 36.0;
  m.flow = FlowLaw();
  m.flow.hardening_exponent = 0.45;
  m.flow.largest_yield = 0.64e9;
  m.flow.pressure_coefficient = 2.83e-11;
  m.flow.temperature_coefficient = 3.77e-4;
  m.flow.melting_temperature = 1790.0;
  m.flow.melting_exponent = 1.5;
  setThermalCurve(m, 383.0, 300.0);
  return m;
}

Material powerLaw()
{
  Material m = johnsonCookCopper();
  m.strength = StrengthKind::PowerHardening;
  m.flow = FlowLaw();
  m.flow.hardening_exponent = 0.31;
  return m;
}

double equivalent(Deviator<double> const &s)
{
  return std::sqrt(3.0 * secondInvariant(s));
}

double energyAt(Material const &m, double sv, double t)
{
  return (t - temperature(m, sv, 0.0)) * m.thermal.heat_capacity;
}

} // namespace

TEST(FlowStress, JohnsonCookCopper_isTheFormulaAtThePublishedParameters)
{
  Material const m = johnsonCookCopper();
  // (90 + 292 * 0.3^0.31) (1 + 0.025 ln 1000) (1 - 0.5^1.09) MPa at T* = 1/2
  double const expected =
      (90.0 + 292.0 * std::pow(0.3, 0.31)) * (1.0 + 0.025 * std::log(1000.0)) * (1.0 - std::pow(0.5, 1.09)) * 1e6;
  double const f = softening(m, 1.0, 0.0, 0.5 * (298.0 + 1356.0));
  EXPECT_NEAR(flowStress(m, 0.3, 1e-3, 1e-6, f).stress / expected, 1.0, 1e-14);
  EXPECT_EQ(flowStress(m, 0.0, 0.0, 1e-6, 1.0).stress, 90e6);
  EXPECT_EQ(flowStress(m, 0.0, 1e-7, 1e-6, 1.0).stress, 90e6); // below the reference rate
  EXPECT_EQ(softening(m, 1.0, 0.0, 200.0), 1.0);
  EXPECT_EQ(softening(m, 1.0, 0.0, 1356.0), 0.0);
}

TEST(FlowStress, SteinbergGuinanCopper_hardensSaturatesAndStiffensAsPublished)
{
  Material const m = steinbergCopper();
  EXPECT_NEAR(flowStress(m, 0.1, 0.0, 1.0, 1.0).stress / (0.12e9 * std::pow(1.0 + 3.6, 0.45)), 1.0, 1e-14);
  EXPECT_EQ(flowStress(m, 10.0, 0.0, 1.0, 1.0).stress, 0.64e9);
  EXPECT_EQ(flowStress(m, 10.0, 0.0, 1.0, 1.0).by_strain, 0.0);
  // 20 GPa, x = 1.12, 350 K: 1 + 0.0283 * 20 / 1.12^(1/3) - 3.77e-4 * 50
  EXPECT_NEAR(softening(m, 1.12, 20e9, 350.0), 1.0 + 0.566 / std::cbrt(1.12) - 0.01885, 1e-12);
  // Lindemann at x = 1.2: ln T_m / T_m0 = 3 (1 - 1/1.2) + 2 (2.02 - 1.5 - 1/3) ln 1.2
  EXPECT_NEAR(meltingTemperature(m, 1.2) / 1790.0, std::exp(0.5 + 2.0 * (0.52 - 1.0 / 3.0) * std::log(1.2)), 1e-12);
  EXPECT_GT(softening(m, 1.2, 50e9, 0.99 * meltingTemperature(m, 1.2)), 0.0);
  EXPECT_EQ(softening(m, 1.2, 50e9, 1.01 * meltingTemperature(m, 1.2)), 0.0);
}

TEST(FlowStress, SlopeOfEveryLaw_matchesDifferencesOfTheStress)
{
  for (Material const &m : {johnsonCookCopper(), steinbergCopper(), powerLaw()})
    for (double const x : {1e-4, 1e-2})
    {
      double const h = 1e-6 * x;
      auto const y = [&](double d) { return flowStress(m, 0.02 + x + d, x + d, 1e-6, 0.8).stress; };
      EXPECT_NEAR((y(h) - y(-h)) / (2.0 * h) / flowStress(m, 0.02 + x, x, 1e-6, 0.8).by_strain, 1.0, 1e-5);
    }
}

TEST(PlasticIncrement, AnyTrialStress_landsOnTheSurfaceAtItsOwnRate)
{
  for (Material const &m : {johnsonCookCopper(), steinbergCopper(), powerLaw()})
    for (double const strain : {0.0, 1e-6, 0.3})
      for (double const over : {1.0001, 1.1, 3.0, 100.0})
        for (double const dt : {1e-12, 1e-8, 1e-3})
        {
          double const q = over * flowStress(m, strain, 0.0, dt, 0.9).stress;
          double const x = plasticIncrement(m, q, strain, dt, 0.9, m.shear_modulus);
          EXPECT_GT(x, 0.0);
          double const left = q - 3.0 * m.shear_modulus * x;
          EXPECT_NEAR(left / flowStress(m, strain + x, x, dt, 0.9).stress, 1.0, 1e-8)
              << strain << " " << over << " " << dt;
        }
  EXPECT_EQ(plasticIncrement(johnsonCookCopper(), 80e6, 0.0, 1e-8, 1.0, 46e9), 0.0);
}

TEST(StrainedDeviator, ConstantShearRate_reachesTheFlowStressOfThatRateWhateverTheStep)
{
  // simple shear: d eps = 2 / sqrt(3) |d eps_xy|; adiabatic heating left out by a fixed energy
  Material const m = johnsonCookCopper();
  double const rate = 1e4, strain = 0.05;
  double const sv = 1.0 / m.density0, e = energyAt(m, sv, 298.0);
  for (int const steps : {100, 1000})
  {
    double const dt = strain / rate / steps;
    Deviator<double> s{0.0, 0.0, 0.0};
    double eps = 0.0;
    for (int i = 0; i < steps; ++i)
    {
      StrainIncrement<double> const d{0.0, 0.0, 0.5 * std::sqrt(3.0) * rate * dt};
      auto const result = strainedDeviator(m, s, d, eps, sv, e, dt);
      s = result.deviator;
      eps += result.plastic_strain_increment;
    }
    double const expected = (90e6 + 292e6 * std::pow(eps, 0.31)) * (1.0 + 0.025 * std::log(rate));
    EXPECT_NEAR(equivalent(s) / expected, 1.0, 1e-3) << steps;
  }
}

TEST(StrainedDeviator, MoltenMaterial_hasNoDeviator)
{
  for (Material const &m : {johnsonCookCopper(), steinbergCopper()})
  {
    double const sv = 1.0 / m.density0, e = energyAt(m, sv, 2000.0);
    auto const result =
        strainedDeviator(m, {1e8, -2e7, 3e7}, StrainIncrement<double>{1e-3, 0.0, 0.0}, 0.1, sv, e, 1e-8);
    EXPECT_EQ(equivalent(result.deviator), 0.0);
  }
  EXPECT_EQ(shearModulus(steinbergCopper(), 1.0 / 8930.0, energyAt(steinbergCopper(), 1.0 / 8930.0, 2000.0)), 0.0);
}

TEST(StrainedDeviator, AdiabaticShear_heatsByThePlasticWorkAndSoftens)
{
  // e grows by the work; T - T0 = work / c_v at constant volume, and the stress follows (1 - T*^m)
  Material const m = johnsonCookCopper();
  double const sv = 1.0 / m.density0, dt = 1e-8, rate = 1e5;
  double e = 0.0, eps = 0.0, work = 0.0;
  Deviator<double> s{0.0, 0.0, 0.0};
  for (int i = 0; i < 3000; ++i)
  {
    double const d = 0.5 * std::sqrt(3.0) * rate * dt;
    auto const result = strainedDeviator(m, s, StrainIncrement<double>{0.0, 0.0, d}, eps, sv, e, dt);
    work += sv * (s.xy + result.deviator.xy) * d;
    e = work;
    s = result.deviator;
    eps += result.plastic_strain_increment;
  }
  double const t = 298.0 + work / 383.0;
  EXPECT_NEAR(temperature(m, sv, e), t, 1e-6);
  EXPECT_GT(t, 600.0);
  double const f = 1.0 - std::pow((t - 298.0) / (1356.0 - 298.0), 1.09);
  double const expected = (90e6 + 292e6 * std::pow(eps, 0.31)) * (1.0 + 0.025 * std::log(rate)) * f;
  EXPECT_NEAR(equivalent(s) / expected, 1.0, 2e-3);
}

TEST(StrainedDeviator, PacksAndDoubles_agree)
{
  for (Material const &m : {johnsonCookCopper(), steinbergCopper(), powerLaw()})
  {
    double const sv = 0.97 / m.density0;
    auto const xx = [](int lane) { return 1e8 * (1 + lane); };
    auto const energy = [](int lane) { return 2e5 * lane; };
    Pack const trial = packOf(xx), e = packOf(energy);
    StrainIncrement<Pack> const strain{Pack(1e-3), Pack(-2e-4), Pack(5e-4)};
    auto const pack =
        strainedDeviator(m, Deviator<Pack>{trial, Pack(2e7), Pack(0.0)}, strain, Pack(0.01), Pack(sv), e, 1e-8);
    for (int lane = 0; lane < pack_width; ++lane)
    {
      auto const one = strainedDeviator(m, Deviator<double>{xx(lane), 2e7, 0.0},
                                        StrainIncrement<double>{1e-3, -2e-4, 5e-4}, 0.01, sv, energy(lane), 1e-8);
      EXPECT_DOUBLE_EQ(laneOf(pack.deviator.xx, lane), one.deviator.xx);
      EXPECT_DOUBLE_EQ(laneOf(pack.plastic_strain_increment, lane), one.plastic_strain_increment);
    }
  }
}

TEST(LongitudinalSoundSpeed, MoltenJohnsonCook_isTheBulkOne)
{
  Material const m = johnsonCookCopper();
  double const c2 = 3940.0 * 3940.0, sv = 1.0 / m.density0;
  double const solid = c2 + 4.0 * m.shear_modulus * sv / 3.0;
  EXPECT_DOUBLE_EQ(longitudinalSoundSpeedSquared(m, c2, sv, energyAt(m, sv, 1350.0)), solid);
  EXPECT_EQ(longitudinalSoundSpeedSquared(m, c2, sv, energyAt(m, sv, 1360.0)), c2);
  // vapour: no modulus times a large specific volume
  EXPECT_EQ(longitudinalSoundSpeedSquared(m, c2, 1e4 * sv, 2e7), c2);
}

TEST(FlowStress, ShearOfAMelt_leavesNoPlasticStrain)
{
  for (Material const &m : {johnsonCookCopper(), steinbergCopper()})
  {
    double const sv = 1.0 / m.density0, hot = energyAt(m, sv, 2500.0), warm = energyAt(m, sv, 600.0);
    StrainIncrement<double> const shear = {0.0, 0.0, 0.01};
    for (double const energy : {hot, warm})
    {
      ReturnedStress<double> const r =
          strainedDeviator(m, Deviator<double>{1e6, 0.0, 0.0}, shear, 0.0, sv, energy, 1e-6);
      EXPECT_EQ(r.plastic_strain_increment > 0.0, energy == warm);
      EXPECT_EQ(equivalent(r.deviator) > 0.0, energy == warm);
    }
  }
}
