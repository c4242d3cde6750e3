// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_EquationOfState.hpp>
#include <Harmos_Strength.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

Material aluminium()
{
  Material m;
  m.strength = StrengthKind::Plastic;
  m.density0 = 2703.0;
  m.sound_speed0 = 5240.0;
  m.shear_modulus = 27.6e9;
  m.yield = 0.29e9;
  m.hardening = 0.1e9;
  return m;
}

double equivalent(Deviator<double> const &s)
{
  return std::sqrt(3.0 * secondInvariant(s));
}

} // namespace

TEST(SecondInvariant, PureShearAndUniaxial_areTheTextbookValues)
{
  EXPECT_DOUBLE_EQ(secondInvariant(Deviator<double>{0.0, 0.0, 3.0}), 9.0);
  EXPECT_DOUBLE_EQ(equivalent({2.0 / 3.0, -1.0 / 3.0, 0.0}), 1.0); // uniaxial stress 1
}

TEST(Rotate, ManySpins_keepTheSecondInvariant)
{
  Deviator<double> s{3.0, -1.0, 2.0};
  double const before = secondInvariant(s);
  for (double const w : {1e-6, 0.01, -0.3, 1.0, -5.0, 100.0})
  {
    s = rotate(s, w);
    EXPECT_NEAR(secondInvariant(s) / before, 1.0, 2e-15);
  }
}

TEST(Rotate, SmallSpins_addUpToTheRotatedTensor)
{
  double const angle = 0.7;
  int const steps = 2000;
  Deviator<double> s{3.0, -1.0, 2.0};
  for (int i = 0; i < steps; ++i)
    s = rotate(s, angle / steps);
  double const c = std::cos(angle), n = std::sin(angle);
  EXPECT_NEAR(s.xx, c * c * 3.0 - n * n * 1.0 - 2.0 * c * n * 2.0, 1e-6);
  EXPECT_NEAR(s.yy, n * n * 3.0 - c * c * 1.0 + 2.0 * c * n * 2.0, 1e-6);
  EXPECT_NEAR(s.xy, c * n * (3.0 + 1.0) + (c * c - n * n) * 2.0, 1e-6);
}

TEST(Rotate, SpinOfTwo_turnsByNinetyDegrees)
{
  auto const s = rotate(Deviator<double>{3.0, -1.0, 2.0}, 2.0); // 2 atan(1)
  EXPECT_NEAR(s.xx, -1.0, 1e-15);
  EXPECT_NEAR(s.yy, 3.0, 1e-15);
  EXPECT_NEAR(s.xy, -2.0, 1e-15);
}

TEST(RadialReturn, TrialOutside_landsOnTheHardenedSurface)
{
  Material const m = aluminium();
  for (Deviator<double> const &trial :
       {Deviator<double>{1e9, -0.2e9, 0.4e9}, Deviator<double>{0.0, 0.0, -3e9}, Deviator<double>{0.2e9, 0.1e9, 0.1e9}})
  {
    auto const result = radialReturn(m, trial, 0.05);
    double const eps = 0.05 + result.plastic_strain_increment;
    EXPECT_GT(result.plastic_strain_increment, 0.0);
    EXPECT_NEAR(equivalent(result.deviator) / yieldStress(m, eps), 1.0, 1e-14);
    EXPECT_NEAR(result.deviator.xx * trial.xy, result.deviator.xy * trial.xx, 1e-14 * std::fabs(trial.xx * trial.xy));
    // plastic strain is what the elastic strain lost: 3 G d_eps = drop of the equivalent stress
    EXPECT_NEAR(3.0 * m.shear_modulus * result.plastic_strain_increment,
                equivalent(trial) - equivalent(result.deviator), 1e-6 * equivalent(trial));
  }
}

TEST(RadialReturn, TrialInsideOrOtherLaws_areElasticOrZero)
{
  Material m = aluminium();
  Deviator<double> const trial{0.1e9, -0.05e9, 0.02e9};
  auto result = radialReturn(m, trial, 0.0);
  EXPECT_EQ(result.deviator.xx, trial.xx);
  EXPECT_EQ(result.plastic_strain_increment, 0.0);
  m.strength = StrengthKind::Elastic;
  result = radialReturn(m, {1e12, 0.0, 0.0}, 0.0);
  EXPECT_EQ(result.deviator.xx, 1e12);
  m.strength = StrengthKind::None;
  result = radialReturn(m, trial, 0.0);
  EXPECT_EQ(result.deviator.xx, 0.0);
  EXPECT_EQ(result.deviator.yy, 0.0);
  EXPECT_EQ(result.deviator.xy, 0.0);
}

TEST(RadialReturn, SoftenedToNothing_leavesNoDeviator)
{
  Material m = aluminium();
  m.hardening = -1e9;
  EXPECT_EQ(yieldStress(m, 10.0), 0.0);
  m.hardening = 0.0;
  m.yield = 0.0;
  EXPECT_NEAR(equivalent(radialReturn(m, {1e9, 0.0, 0.0}, 0.0).deviator), 0.0, 1e-6);
}

TEST(UniaxialStrain, ElasticThenYield_reachesTheHugoniotElasticLimit)
{
  Material m = aluminium();
  m.hardening = 0.0;
  double const bulk = m.density0 * m.sound_speed0 * m.sound_speed0;
  double const step = -1e-7;
  Deviator<double> s{0.0, 0.0, 0.0};
  double strain = 0.0;
  // elastic: s_xx = 4/3 G strain; the limit of -sigma_xx = K |strain| + 2/3 Y is Y (K / 2G + 2/3) = 0.583 GPa
  for (;;)
  {
    auto const result = radialReturn(m, elasticTrial(m.shear_modulus, s, {step, 0.0, 0.0}), 0.0);
    if (result.plastic_strain_increment > 0.0)
      break;
    s = result.deviator;
    strain += step;
    ASSERT_NEAR(s.xx, 4.0 / 3.0 * m.shear_modulus * strain, 1e-9 * m.yield);
    ASSERT_NEAR(s.yy, -0.5 * s.xx, 1e-9 * m.yield);
  }
  double const limit = -bulk * strain - s.xx;
  EXPECT_NEAR(limit, m.yield * (bulk / (2.0 * m.shear_modulus) + 2.0 / 3.0), 1e-4 * limit);
  EXPECT_NEAR(limit, 0.583e9, 0.001e9);
}
