// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

double density(int material, Vector2 const &x)
{
  return 1.5 + material + 0.3 * x[0];
}
double energy(int material, Vector2 const &)
{
  return 0.7 - 0.2 * material;
}

/// Damage 0.2 + 0.6 x, and failed_damage's 2 in a strip.
void setDamage(Scene &scene)
{
  scene.device.state.tracks_damage = true;
  scene.device.state.damage = View<double *>("damage", scene.pairs.num_pairs);
  scene.state.damage = Kokkos::create_mirror_view(scene.device.state.damage);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
  {
    double const x = (scene.pairs.cell(pair) % 24 + 0.5) / 24.0;
    scene.state.damage(pair) = std::abs(x - 0.5) < 0.06 ? 2.0 : 0.2 + 0.6 * x;
  }
}

double damageMass(PairsOnHost const &pairs, StateOnHost const &state)
{
  double sum = 0.0;
  for (int pair = 0; pair < pairs.num_pairs; ++pair)
    sum += state.record(pair, Mass) * state.damage(pair);
  return sum;
}

} // namespace

TEST(Damage, DiscsInVoid_keepTheMassOfTheirDamageAndItsBounds)
{
  for (bool const swept : {true, false})
    for (int const order : {1, 2})
    {
      Scene scene(24, 22, 0.2, twoLaws());
      Boundary free;
      free.kind = BoundaryKind::Outflow;
      scene.setBoundaries({free, free, free, free});
      scene.options.swept_faces = swept;
      scene.options.order = order;
      scene.paint({disc(0, {0.45, 0.5}, 0.25), disc(1, {0.5, 0.5}, 0.35)}, density, energy);
      setDamage(scene);
      scene.move([](int, Vector2 const &) { return Vector2{0.017, -0.011}; });
      double const before = damageMass(scene.pairs, scene.state);
      ResultOnHost const result = scene.remapped();
      ASSERT_TRUE(result.state.tracks_damage);
      EXPECT_NEAR(damageMass(result.pairs, result.state), before, 1e-13 * before) << swept << order;
      for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
      {
        EXPECT_GE(result.state.damage(pair), 0.2 - 1e-12);
        EXPECT_LE(result.state.damage(pair), 2.0 + 1e-12);
      }
    }
}

TEST(Damage, TrackedDamage_changesNoBitOfTheOtherFields)
{
  auto const run = [](bool tracked)
  {
    Scene scene(24, 22, 0.2, twoLaws());
    scene.paint({disc(0, {0.45, 0.5}, 0.25), rest(1)}, density, energy);
    if (tracked)
      setDamage(scene);
    scene.move(
        [](int, Vector2 const &x) {
          return Vector2{0.01 * std::sin(Math::pi * x[0]), 0.01 * std::sin(Math::pi * x[1])};
        });
    return scene.remapped();
  };
  ResultOnHost const with = run(true), without = run(false);
  ASSERT_EQ(with.pairs.num_pairs, without.pairs.num_pairs);
  for (int pair = 0; pair < with.pairs.num_pairs; ++pair)
    for (int f = 0; f < num_pair_fields; ++f)
      ASSERT_EQ(with.state.record(pair, f), without.state.record(pair, f)) << pair << " " << f;
  for (int dof = 0; dof < with.dof_nodes.num_dof_nodes; ++dof)
    for (int d = 0; d < 2; ++d)
      ASSERT_EQ(with.state.velocity(dof, d), without.state.velocity(dof, d));
}

TEST(Damage, WithTheKineticDefectReturned_isRefused)
{
  Scene scene(24, 22, 0.2, twoLaws());
  scene.paint({rest(0)}, density, energy);
  setDamage(scene);
  scene.move([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
  scene.options.return_kinetic_defect = true;
  EXPECT_THROW(scene.remapped(), std::runtime_error);
}
