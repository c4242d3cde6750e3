// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Failure.hpp>

#include "TestMetals.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

/// Steel 4340, Johnson & Cook (1983, 1985).
Material steel()
{
  Material m = copper();
  m.density0 = 7830.0;
  m.sound_speed0 = 4578.0;
  m.slope = 1.33;
  m.gruneisen = 1.67;
  m.energy0 = 0.0;
  m.strength = StrengthKind::JohnsonCook;
  m.shear_modulus = 77.5e9;
  m.yield = 792e6;
  m.hardening = 510e6;
  m.flow.hardening_exponent = 0.26;
  m.flow.rate_coefficient = 0.014;
  m.flow.softening_exponent = 1.03;
  m.flow.melting_temperature = 1793.0;
  setThermalCurve(m, 477.0, 294.0);
  m.failure.damages = true;
  double const d[5] = {0.05, 3.44, -2.12, 0.002, 0.61};
  for (int i = 0; i < 5; ++i)
    m.failure.d[i] = d[i];
  return m;
}

/// A state with the pressure and the deviator of simple tension q.
FailureState stressed(Material const &m, double pressure, double q, double increment)
{
  double low = 0.9 / m.density0, high = 1.1 / m.density0;
  for (int i = 0; i < 200; ++i)
  {
    double const middle = 0.5 * (low + high);
    (equationOfState(m, middle, 0.0).pressure > pressure ? low : high) = middle;
  }
  return {low, 0.0, {2.0 * q / 3.0, -q / 3.0, 0.0}, increment};
}

} // namespace

TEST(Failure, FailureStrainsOf4340_areThoseOfThePaperSFigures)
{
  // Johnson & Cook, Eng. Fract. Mech. 21 (1985): torsion (x = 0), a smooth tensile bar (1/3), a sharp notch (1)
  Material const m = steel();
  EXPECT_NEAR(failureStrain(m, 0.0, 1.0, 0.0), 3.49, 1e-12);
  EXPECT_NEAR(failureStrain(m, 1.0 / 3.0, 1.0, 0.0), 1.747, 1e-3);
  EXPECT_NEAR(failureStrain(m, 1.0, 1.0, 0.0), 0.463, 1e-3);
  // a thousandfold rate and half way to melting
  EXPECT_NEAR(failureStrain(m, 0.0, 1000.0, 0.5), 3.49 * (1.0 + 0.002 * std::log(1000.0)) * 1.305, 1e-12);
  // below the reference rate and beyond the range nothing changes
  EXPECT_EQ(failureStrain(m, 0.0, 1e-3, 0.0), failureStrain(m, 0.0, 1.0, 0.0));
  EXPECT_EQ(failureStrain(m, 4.0, 1.0, 0.0), failureStrain(m, largest_triaxiality, 1.0, 0.0));
}

TEST(Failure, AConstantFailureStrain_isThatAtAnyTriaxiality)
{
  Material m = steel();
  double const constant[5] = {0.3, 0.0, -1.0, 0.0, 0.0};
  for (int i = 0; i < 5; ++i)
    m.failure.d[i] = constant[i];
  for (double const triaxiality : {-1e6, -1e3, 0.0, 1.0})
    EXPECT_EQ(failureStrain(m, triaxiality, 1.0, 0.0), 0.3);
}

TEST(Failure, DamageAtConstantTriaxiality_isTheIntegralAndEndsInFailure)
{
  Material const m = steel();
  double const q = 1e9, dt = 1e-9, increment = 1e-3; // 1e6 / s
  FailureState const state = stressed(m, -q / 3.0, q, increment);
  double const hot = homologousTemperature(m, temperature(m, state.specific_volume, 0.0));
  double const strain = (0.05 + 3.44 * std::exp(-2.12 / 3.0)) * (1.0 + 0.002 * std::log(1e6)) * (1.0 + 0.61 * hot);
  int const steps = static_cast<int>(strain / increment);
  double damage = 0.0;
  for (int i = 1; i <= steps; ++i)
  {
    damage = damageAfter(m, state, damage, dt);
    ASSERT_NEAR(damage, i * increment / strain, 1e-6 * i / steps) << i;
  }
  EXPECT_FALSE(isFailed(m, damage, true));
  EXPECT_EQ(damageAfter(m, state, damage, dt), failed_damage);
  EXPECT_EQ(damageAfter(m, {state.specific_volume, 0.0, state.deviator, 0.0}, 0.3, dt), 0.3);
}

TEST(Failure, Spall_failsAtItsStressAndNotBelow)
{
  Material m = copper();
  m.strength = StrengthKind::Elastic;
  m.energy0 = 0.0;
  m.failure.spall_pressure = 2e9;
  EXPECT_TRUE(canFail(m));
  EXPECT_EQ(damageAfter(m, stressed(m, -1.999e9, 0.0, 0.0), 0.0, 1.0), 0.0);
  EXPECT_EQ(damageAfter(m, stressed(m, -2.001e9, 0.0, 0.0), 0.0, 1.0), failed_damage);
  m.failure = FailureLaw();
  EXPECT_FALSE(canFail(m));
  m.failure.spall_stress = 2e9;
  // -p + 2 q / 3 of simple tension, along any axis, the third one included
  for (double const q : {0.6e9, -0.6e9})
  {
    double const largest = q > 0.0 ? 2.0 * q / 3.0 : -q / 3.0;
    EXPECT_EQ(damageAfter(m, stressed(m, -1.999e9 + largest, q, 0.0), 0.0, 1.0), 0.0);
    EXPECT_EQ(damageAfter(m, stressed(m, -2.001e9 + largest, q, 0.0), 0.0, 1.0), failed_damage);
  }
}

TEST(Failure, LargestPrincipalStress_isTheLargestEigenvalue)
{
  // s = Q diag(3, 1) Q^T by 30 degrees, less the pressure; zz = -4
  double const c = std::cos(Math::pi / 6.0), s = std::sin(Math::pi / 6.0);
  Deviator<double> const turned = {3.0 * c * c + s * s, 3.0 * s * s + c * c, 2.0 * c * s};
  EXPECT_NEAR(largestPrincipalStress(0.5, turned), 2.5, 1e-14);
  EXPECT_NEAR(largestPrincipalStress(0.5, {-turned.xx, -turned.yy, -turned.xy}), 3.5, 1e-14);
}

TEST(Failure, UnstressedVolume_isWhereThePressureVanishes)
{
  Material tillotson = copper();
  tillotson.eos = EosKind::Tillotson;
  tillotson.tillotson = {0.5, 1.5, 139e9, 110e9, 5.0, 5.0, 32.5e6, 1.38e6, 6.92e6};
  tillotson.sound_speed0 = std::sqrt(139e9 / 8930.0);
  for (Material m : {copper(), stiff(), tillotson})
    for (double const energy : {1.0e3, 2.0e4, 3.0e5})
      for (double const stretch : {1.001, 1.02, 1.2})
      {
        double const sv = stretch / m.density0;
        if (equationOfState(m, sv, energy).pressure >= 0.0)
          continue;
        double const free = unstressedVolume(m, sv, energy);
        EXPECT_LT(free, sv);
        EXPECT_NEAR(equationOfState(m, free, energy).pressure / (m.density0 * m.sound_speed0 * m.sound_speed0), 0.0,
                    1e-11);
      }
}
