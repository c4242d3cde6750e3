// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <Harmos_Failure.hpp>

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

/// K = rho0 c0^2 = 18 Pa; fails at a tension of 0.09 Pa, a strain of about 0.5 per cent.
Material brittle()
{
  Material m = elastic();
  m.failure.spall_pressure = 0.09;
  return m;
}

Scene trackedScene(std::vector<Material> const &laws, std::function<std::vector<Fill>(int, int)> const &contents,
                   Kinematics kinematics = Kinematics::Xfem)
{
  Scene s = makeScene(2, 1, 0.0, laws, contents, kinematics);
  s.state.tracks_damage = true;
  s.state.damage = View<double *>("damage", s.pairs.num_pairs);
  s.state.centroid = View<double *[2]>("centroid", s.pairs.num_pairs);
  return s;
}

/// Sum of |f| over the corners of the first pair when it is at rest at `specific_volume`, full of its cell, and has
/// this damage.
double forceAtRest(double specific_volume, double damage)
{
  Scene s = trackedScene({brittle()}, full);
  auto const r = onHost(s.state.record);
  r(0, SpecificVolume) = specific_volume;
  Kokkos::deep_copy(s.state.record, r);
  Kokkos::deep_copy(s.state.damage, damage);
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  auto const f = onHost(s.work.corner_force);
  double sum = 0.0;
  for (int i = 0; i < 8; ++i)
    sum += std::fabs(f(0, i));
  return sum;
}

/// One step of dt = 1 in which the left cell is strained by `rate` and the right one moves along.
FailureReport strainLeftCell(Scene &s, double rate, Kinematics kinematics = Kinematics::Xfem)
{
  s.options.energy_lag = 0.5;
  s.setVelocity([&](int, Vector2 x) { return Vector2{rate * Math::min(x[0], 1.0), 0.0}; });
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  Kokkos::deep_copy(s.work.half, s.state.velocity);
  keepForFailure(s.pairs, s.state, s.work);
  TimeStepLimit next;
  s.update(1.0, next);
  return failPairs(s.mesh, kinematics, s.pairs, s.state, s.materials, 1.0, s.work);
}

double pressure(Scene const &s, Material const &law, int pair)
{
  auto const r = onHost(s.state.record);
  return equationOfState(law, r(pair, SpecificVolume), r(pair, InternalEnergy)).pressure;
}

} // namespace

TEST(FailPairs, TensionBelowTheLimit_leavesTheBitsOfTheUpdate)
{
  Scene s = trackedScene({brittle()}, full), plain = makeScene(2, 1, 0.0, {elastic()}, full);
  FailureReport const report = strainLeftCell(s, 0.004);
  plain.setVelocity([](int, Vector2 x) { return Vector2{0.004 * Math::min(x[0], 1.0), 0.0}; });
  computeCornerForces(plain.mesh, plain.pairs, plain.state, plain.materials, plain.options, plain.work);
  Kokkos::deep_copy(plain.work.half, plain.state.velocity);
  TimeStepLimit next;
  plain.update(1.0, next);
  EXPECT_EQ(report.failed, 0);
  EXPECT_FALSE(report.fractions_changed);
  auto const a = onHost(s.state.record), b = onHost(plain.state.record);
  for (int f = 0; f < num_pair_fields; ++f)
    EXPECT_EQ(a(0, f), b(0, f)) << f;
}

TEST(FailPairs, TensionAboveTheLimit_becomesVoidWithMassAndEnergyKept)
{
  Scene s = trackedScene({brittle()}, full);
  FailureReport const report = strainLeftCell(s, 0.02);
  auto const r = onHost(s.state.record);
  EXPECT_EQ(report.failed, 1);
  EXPECT_TRUE(report.fractions_changed);
  EXPECT_EQ(onHost(s.state.damage)(0), failed_damage);
  EXPECT_NEAR(pressure(s, brittle(), 0), 0.0, 1e-10);
  EXPECT_EQ(r(0, DeviatorXX), 0.0);
  // the moved cell is 1.02 long and the material fills 1 of it
  EXPECT_NEAR(r(0, VolumeFraction) * 1.02, 1.0, 1e-9);
  EXPECT_NEAR(r(0, SpecificVolume), 0.5, 1e-9);
  EXPECT_EQ(r(0, Mass), 2.0);
  EXPECT_EQ(r(0, InternalEnergy), 0.0); // there were no forces in this step
  auto const kind = onHost(s.pairs.cell_kind);
  EXPECT_EQ(kind(0), static_cast<int>(MixedCell));
  EXPECT_EQ(kind(1), static_cast<int>(PureCell));
  EXPECT_DOUBLE_EQ(onHost(s.state.centroid)(0, 0), 0.5);
  EXPECT_EQ(onHost(s.state.centroid)(1, 0), 0.0); // stays pure: its bits stay, as on a rank without failure
  EXPECT_EQ(r(1, VolumeFraction), 1.0);
}

TEST(FailPairs, FailedPairCompressed_closesItsVoidBeforeItFeelsPressure)
{
  Scene s = trackedScene({brittle()}, [](int i, int) { return std::vector<Fill>{{0, i == 0 ? 0.95 : 1.0}}; });
  Kokkos::deep_copy(s.state.damage, failed_damage);
  strainLeftCell(s, -0.03);
  auto r = onHost(s.state.record);
  EXPECT_NEAR(r(0, VolumeFraction) * 0.97, 0.95, 1e-15);
  EXPECT_NEAR(r(0, SpecificVolume), 0.5, 1e-15);
  // On the unmoved cell again: its void and 1 per cent more.
  double const fraction = 0.95, strain = (1.0 - fraction) + 0.01;
  r(0, VolumeFraction) = fraction;
  Kokkos::deep_copy(s.state.record, r);
  strainLeftCell(s, -strain);
  r = onHost(s.state.record);
  EXPECT_EQ(r(0, VolumeFraction), 1.0);
  double const part = (strain - (1.0 - fraction) / fraction) / strain;
  EXPECT_NEAR(r(0, SpecificVolume) / 0.5, std::pow(1.0 - strain, part), 1e-14);
  EXPECT_GT(pressure(s, brittle(), 0), 0.0);
  EXPECT_EQ(onHost(s.pairs.cell_kind)(0), static_cast<int>(PureCell));
  EXPECT_EQ(r(0, DeviatorXX), 0.0);
}

/// Internal energy, and specific volume, of the left cell's pair under pressure after a compression by 10 per cent.
std::pair<double, double> compressedUnderPressure(double fraction, double damage)
{
  Scene s = trackedScene({brittle()}, [&](int i, int) { return std::vector<Fill>{{0, i == 0 ? fraction : 1.0}}; });
  auto r = onHost(s.state.record);
  r(0, SpecificVolume) = 0.45;
  Kokkos::deep_copy(s.state.record, r);
  Kokkos::deep_copy(s.state.damage, damage);
  strainLeftCell(s, -0.1);
  r = onHost(s.state.record);
  return {r(0, InternalEnergy), r(0, SpecificVolume)};
}

TEST(FailPairs, FailedPairUnderPressure_isNotHeatedWhileItsVoidCloses)
{
  auto const sound = compressedUnderPressure(0.95, 0.0);
  EXPECT_GT(sound.first, 0.0);
  EXPECT_NEAR(sound.second, 0.9 * 0.45, 1e-15);
  auto const loose = compressedUnderPressure(0.5, failed_damage);
  EXPECT_EQ(loose.first, 0.0);
  EXPECT_NEAR(loose.second, 0.45, 1e-15);
  // 0.05 of void to 0.95 of material: the rest of the compression does work
  auto const closed = compressedUnderPressure(0.95, failed_damage);
  EXPECT_NEAR(closed.first / sound.first, (0.1 - 0.05 / 0.95) / 0.1, 1e-13);
}

/// Volume fraction and specific volume of a failed pair with void and this outline, of a mass that takes up half of the
/// cell, after a strain.
std::pair<double, double> strainedWithOutline(double outline, double strain)
{
  Scene s = trackedScene({brittle()}, [](int i, int) { return std::vector<Fill>{{0, i == 0 ? 0.5 : 1.0}}; });
  auto r = onHost(s.state.record);
  r(0, VolumeFraction) = outline;
  Kokkos::deep_copy(s.state.record, r);
  Kokkos::deep_copy(s.state.damage, failed_damage);
  strainLeftCell(s, strain);
  r = onHost(s.state.record);
  return {r(0, VolumeFraction), r(0, SpecificVolume)};
}

TEST(FailPairs, OutlineThatIsNotTheVolume_isMendedWhereThereIsVoid)
{
  for (double const outline : {1e-3, 0.1, 0.5, 0.9})
  {
    auto const still = strainedWithOutline(outline, 0.0);
    EXPECT_NEAR(still.first, 0.5, 1e-15) << outline;
    EXPECT_NEAR(still.second, 0.5, 1e-15) << outline;
    // 0.5 of void to 0.5 of matter, whatever the outline says: all of it takes the strain
    auto const closing = strainedWithOutline(Math::min(outline, 0.5), -0.4);
    EXPECT_NEAR(closing.first * 0.6, 0.5, 1e-15) << outline;
    EXPECT_NEAR(closing.second, 0.5, 1e-15) << outline;
  }
}

TEST(FailPairs, CellWithMoreMatterThanRoom_resistsAtOnce)
{
  Scene s = trackedScene({brittle(), elastic()},
                         [](int i, int) {
                           return i == 0 ? std::vector<Fill>{{0, 0.6}, {1, 0.4}} : std::vector<Fill>{{1, 1.0}};
                         });
  auto r = onHost(s.state.record);
  r(0, VolumeFraction) = 0.1; // an overlap has cut its outline
  Kokkos::deep_copy(s.state.record, r);
  Kokkos::deep_copy(s.state.damage, failed_damage);
  strainLeftCell(s, -0.1);
  r = onHost(s.state.record);
  EXPECT_NEAR(r(0, SpecificVolume), 0.9 * 0.5, 1e-15);
  EXPECT_NEAR(r(0, VolumeFraction), 0.6, 1e-15);
}

TEST(FailPairs, TensionThatThePairCannotBear_pullsAtNoNode)
{
  EXPECT_GT(forceAtRest(0.501, 0.0), 0.01); // p = -0.036 Pa
  EXPECT_EQ(forceAtRest(0.501, failed_damage), 0.0);
  EXPECT_EQ(forceAtRest(0.55, 0.0), 0.0); // p = -1.6 Pa: what the remap has mixed
  EXPECT_GT(forceAtRest(0.49, failed_damage), 0.1);
  EXPECT_EQ(forceAtRest(0.49, failed_damage), forceAtRest(0.49, 0.0));
}

TEST(FailPairs, OtherMaterialsOfTheCell_areLeftAlone)
{
  Scene s = trackedScene({brittle(), elastic()},
                         [](int i, int) {
                           return i == 0 ? std::vector<Fill>{{0, 0.4}, {1, 0.5}} : std::vector<Fill>{{1, 1.0}};
                         });
  Kokkos::deep_copy(s.state.damage, failed_damage); // a law that cannot fail does not look at it
  strainLeftCell(s, -0.3);
  auto const r = onHost(s.state.record);
  EXPECT_EQ(r(1, VolumeFraction), 0.5);
  EXPECT_EQ(r(0, VolumeFraction), 0.5); // all of the void
  EXPECT_NEAR(r(0, SpecificVolume) / 0.5, std::pow(0.7, (0.3 - 0.1 / 0.4) / 0.3), 1e-14);
  EXPECT_NE(r(1, DeviatorXX), 0.0);
}

TEST(FailPairs, BodyFittedCell_keepsItsRegionAndItsVoidInside)
{
  Scene s = trackedScene({brittle()}, full, Kinematics::Lagrangian);
  FailureReport const report = strainLeftCell(s, 0.02, Kinematics::Lagrangian);
  EXPECT_EQ(report.failed, 1);
  EXPECT_FALSE(report.fractions_changed);
  EXPECT_EQ(onHost(s.pairs.cell_kind)(0), static_cast<int>(PureCell));
  EXPECT_NEAR(onHost(s.state.record)(0, VolumeFraction) * 1.02, 1.0, 1e-9);
}
