// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

constexpr double steepness = 12.0; // a density e times that of 1/12 further left

double steepDensity(int, Vector2 const &x)
{
  return std::exp(steepness * (x[0] - 0.7 * x[1]));
}

double hotWhereThin(int, Vector2 const &x)
{
  return std::exp(-steepness * (x[0] - 0.7 * x[1]));
}

/// Linear: what a face takes is known exactly to the one who knows where the mass is.
double risingDensity(Vector2 const &x)
{
  return 1.0 + 8.0 * x[0] + 4.0 * x[1];
}

double fallingEnergy(Vector2 const &x)
{
  return 2.0 - x[0] - 0.5 * x[1];
}

/// Tangential on the sides of the box.
Vector2 swirl(int, Vector2 const &x)
{
  double const pi = Math::pi;
  return {0.01 * std::sin(pi * x[0]) * std::cos(pi * x[1]), -0.01 * std::cos(pi * x[0]) * std::sin(pi * x[1])};
}

Vector2 randomVelocity(int, Vector2 const &x)
{
  std::mt19937 random(static_cast<unsigned>(1e6 * x[0] + 1e3 * x[1]));
  std::uniform_real_distribution<double> component(-0.01, 0.01);
  double const u = component(random);
  return {u, component(random)};
}

/// A front across x, so that limiters work on both of its sides.
double front(int, Vector2 const &x)
{
  return 0.1 + 1.0 / (1.0 + std::exp(40.0 * (x[0] - 0.45)));
}

/// Integrals of the density and of density times energy over a quadrilateral, by 4 x 4 Gauss points.
Vector2 massAndHeat(Vector2 const (&q)[4])
{
  double const point[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  double const weight[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  Vector2 sum{0.0, 0.0};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
    {
      double const a = 0.5 * (1.0 + point[i]), b = 0.5 * (1.0 + point[j]);
      Vector2 const x = (1.0 - a) * ((1.0 - b) * q[0] + b * q[3]) + a * ((1.0 - b) * q[1] + b * q[2]);
      Vector2 const along = (1.0 - b) * (q[1] - q[0]) + b * (q[2] - q[3]);
      Vector2 const across = (1.0 - a) * (q[3] - q[0]) + a * (q[2] - q[1]);
      double const mass = 0.25 * weight[i] * weight[j] * cross(along, across) * risingDensity(x);
      sum += Vector2{mass, mass * fallingEnergy(x)};
    }
  return sum;
}

/// Mean error of the remapped energies where density and energy are linear: exact means on the moved mesh, against
/// those on the mesh, away from its boundary.
double errorOfEnergy(int cells)
{
  Scene scene(cells, cells, 0.0, twoLaws());
  scene.options.limiter = RemapLimiter::None;
  scene.paint({rest(0)}, steepDensity, hotWhereThin);
  scene.move(swirl);
  std::vector<double> exact(scene.pairs.num_pairs);
  double error = 0.0;
  int count = 0;
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
  {
    Vector2 here[4], moved[4];
    for (int k = 0; k < 4; ++k)
    {
      int const node = scene.mesh.cell_node(scene.pairs.cell(pair), k), dof = scene.pairs.dof_node(pair, k);
      here[k] = {scene.mesh.node_position(node, 0), scene.mesh.node_position(node, 1)};
      moved[k] = here[k] + scene.dt * Vector2{scene.half(dof, 0), scene.half(dof, 1)};
    }
    Vector2 const before = massAndHeat(moved);
    scene.state.record(pair, Mass) = before[0];
    scene.state.record(pair, InternalEnergy) = before[1] / before[0];
    Vector2 const after = massAndHeat(here);
    exact[pair] = after[1] / after[0];
  }
  ResultOnHost const result = scene.remapped();
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
  {
    int const cell = scene.pairs.cell(pair), i = cell % cells, j = cell / cells;
    if (i < 2 || j < 2 || i >= cells - 2 || j >= cells - 2)
      continue;
    error += std::fabs(result.state.record(pair, InternalEnergy) - exact[pair]);
    ++count;
  }
  return error / count;
}

/// A front that moves along the mesh comes out alike with and without noise across.
void expectNoiseToStaySmall(std::vector<Layer> const &layers, int order, std::vector<double> const &amplitudes)
{
  for (bool about_axis : {false, true})
  {
    for (double across : amplitudes)
    {
      Scene scene(24, 12, 0.0, twoLaws());
      if (about_axis)
        scene.aboutAxis();
      scene.options.order = order;
      scene.paint(layers, front, front);
      auto const remapped = [&](double noise)
      {
        scene.move(
            [&](int m, Vector2 const &x)
            {
              double const v = x[1] > 0.0 && x[1] < 1.0 ? 100.0 * noise * randomVelocity(m, x)[0] : 0.0;
              return Vector2{0.02 * std::sin(Math::pi * x[0]), v};
            });
        return scene.remapped();
      };
      ResultOnHost const quiet = remapped(0.0), noisy = remapped(across);
      ASSERT_EQ(quiet.pairs.num_pairs, noisy.pairs.num_pairs);
      for (int pair = 0; pair < quiet.pairs.num_pairs; ++pair)
        for (int f = 0; f < num_pair_fields; ++f)
          EXPECT_NEAR(noisy.state.record(pair, f), quiet.state.record(pair, f), 1e-9 + 1000.0 * across)
              << "order " << order << ", pair " << pair << ", field " << f << ", across " << across;
    }
  }
}

} // namespace

TEST(Swept, steepDensity_pureCellsKeepTheirVolume)
{
  for (bool about_axis : {false, true})
    for (int order : {1, 2, 3})
    {
      Scene scene(16, 12, 0.2, twoLaws());
      if (about_axis)
        scene.aboutAxis();
      scene.options.order = order;
      scene.paint({rest(0)}, steepDensity, hotWhereThin);
      scene.move(swirl);
      for (int pair = 0; pair < scene.pairs.num_pairs; ++pair) // the gas fills the moved cells
      {
        double area = 0.0, ring = 0.0;
        Quadrilateral q;
        q.size = 4;
        for (int k = 0; k < 4; ++k)
        {
          int const node = scene.mesh.cell_node(pair, k), dof = scene.pairs.dof_node(pair, k);
          q[k] = {scene.mesh.node_position(node, 0) + scene.half(dof, 0),
                  scene.mesh.node_position(node, 1) + scene.half(dof, 1)};
        }
        area = moments<1>(q, q[0], areaWeight(Geometry::Planar, q[0])).volume();
        ring = moments<1>(q, q[0], areaWeight(Geometry::Axisymmetric, q[0])).volume();
        scene.state.record(pair, SpecificVolume) = (about_axis ? ring : area) / scene.state.record(pair, Mass);
      }
      ResultOnHost const result = scene.remapped();
      for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
        EXPECT_NEAR(result.state.record(pair, Mass) * result.state.record(pair, SpecificVolume) /
                        scene.mesh.cell_volume(pair),
                    1.0, 1e-12)
            << "order " << order << ", cell " << pair << (about_axis ? ", about an axis" : "");
    }
}

TEST(Swept, returnedKineticEnergy_atFirstOrder_isNeverNegative)
{
  for (bool about_axis : {false, true})
  {
    Scene scene(16, 12, 0.2, twoLaws());
    if (about_axis)
      scene.aboutAxis();
    scene.options.order = 1;
    scene.options.return_kinetic_defect = true;
    scene.paint({rest(0)}, steepDensity, [](int, Vector2 const &) { return 0.0; });
    scene.move([](int m, Vector2 const &x) { return Vector2{0.02, 0.01} + randomVelocity(m, x); });
    ResultOnHost const result = scene.remapped();
    double least = 0.0, largest = 0.0;
    for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
    {
      least = std::min(least, result.state.record(pair, InternalEnergy));
      largest = std::max(largest, result.state.record(pair, InternalEnergy));
    }
    EXPECT_GT(largest, 1e-6);
    EXPECT_GE(least, -1e-12 * largest);
  }
}

TEST(Swept, linearDensityAndEnergy_energyComesFromWhereTheMassIs)
{
  double const coarse = errorOfEnergy(16), fine = errorOfEnergy(32);
  EXPECT_GT(coarse, 3.9 * fine);
  EXPECT_LT(fine, 1e-7); // 9e-7 with the deviations at the centroids of volume
}

TEST(Swept, facesThatTakeNextToNothing_doNotBoundWhatTheOthersTake)
{
  // 1e-120: velocities ahead of a wave, whose products with themselves are still numbers
  for (int order : {2, 3})
    expectNoiseToStaySmall({rest(0)}, order, {1e-12, 1e-20, 1e-60, 1e-120});
}

TEST(Swept, overlaysThatTakeNextToNothing_doNotBoundWhatTheOthersTake)
{
  expectNoiseToStaySmall({halfPlane(0, {0.47, 0.0}, 0.0), rest(1)}, 2, {1e-10, 1e-12, 1e-14});
}
