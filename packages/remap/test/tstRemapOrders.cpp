// SPDX-License-Identifier: BSD-3-Clause
#include "RandomMesh.hpp"

#include <gtest/gtest.h>

#include <cstdio>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

double sine(Vector2 const &x)
{
  return 2.0 + std::sin(2.0 * Math::pi * x[0]) * std::sin(2.0 * Math::pi * x[1]);
}

RemapOptions optionsOf(int order, bool swept, RemapLimiter limiter)
{
  RemapOptions options;
  options.order = order;
  options.swept_faces = swept;
  options.limiter = limiter;
  return options;
}

/// Sum over the cells of area times |remapped - exact density| of the sine.
double densityError(Scene &scene)
{
  ResultOnHost const result = scene.remapped();
  double sum = 0.0;
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
    sum += std::fabs(result.state.record(cell, Mass) -
                     gaussAverage(cellQuadrilateral(scene.mesh, cell), sine) * scene.mesh.cell_area(cell));
  return sum;
}

double error(int n, RemapOptions const &options)
{
  Scene scene = regularToRandom(n, 0.25, sine);
  scene.options = options;
  return densityError(scene);
}

/// Mean absolute error of a specific internal energy on a density that varies, from the regular mesh to a random one.
double energyError(int n, RemapOptions const &options)
{
  auto const wave = [](Vector2 const &x) { return 3.0 + std::cos(5.0 * x[0] + 4.0 * x[1]); };
  auto const product = [&](Vector2 const &x) { return wave(x) * sine(x); };
  Scene scene = regularToRandom(n, 0.25, wave);
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
  {
    Quadrilateral const q = movedCell(scene, cell);
    scene.state.record(cell, InternalEnergy) = gaussAverage(q, product) / gaussAverage(q, wave);
  }
  scene.options = options;
  ResultOnHost const result = scene.remapped();
  double sum = 0.0;
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
  {
    Quadrilateral const q = cellQuadrilateral(scene.mesh, cell);
    sum += scene.mesh.cell_area(cell) *
           std::fabs(result.state.record(cell, InternalEnergy) - gaussAverage(q, product) / gaussAverage(q, wave));
  }
  return sum;
}

/// Errors of another program on this problem (regular to random mesh, Barth-Jespersen but for the boundary's cells),
/// 32^2 and 64^2.
struct Peer
{
  bool swept;
  double coarse, fine;
};

/// How far the remap of random densities and energies between 1 and 2 leaves that range.
double overshoot(RemapOptions const &options)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(1.0, 2.0);
  double beyond = 0.0;
  for (int sample = 0; sample < 4; ++sample)
  {
    Scene scene = regularToRandom(16, 0.25, [&](Vector2 const &) { return 1.0; });
    for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
    {
      scene.state.record(cell, Mass) = area(movedCell(scene, cell)) * std::round(uniform(random));
      for (int f : {SpecificVolume, InternalEnergy, PlasticStrain})
        scene.state.record(cell, f) = uniform(random);
    }
    scene.options = options;
    ResultOnHost const result = scene.remapped();
    for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
    {
      double const density = result.state.record(cell, Mass) / scene.mesh.cell_area(cell);
      beyond = std::max({beyond, density - 2.0, 1.0 - density});
      for (int f : {SpecificVolume, InternalEnergy, PlasticStrain})
        beyond = std::max({beyond, result.state.record(cell, f) - 2.0, 1.0 - result.state.record(cell, f)});
    }
  }
  return beyond;
}

} // namespace

TEST(RandomMesh, smoothDensity_isNoWorseThanAPeerProgram)
{
  for (Peer const &peer : {Peer{false, 2.19e-4, 4.39e-5}, Peer{true, 3.22e-4, 7.05e-5}})
  {
    RemapOptions const options = optionsOf(2, peer.swept, RemapLimiter::RangeInside);
    double const coarse = error(32, options), fine = error(64, options);
    std::printf("second order, %s: 32 %.3e, 64 %.3e\n", peer.swept ? "swept" : "intersected", coarse, fine);
    EXPECT_LE(coarse, peer.coarse);
    EXPECT_LE(fine, peer.fine);
    EXPECT_GT(std::log2(coarse / fine), 1.9);
    EXPECT_LT(fine, 0.05 * error(64, optionsOf(1, peer.swept, RemapLimiter::Range)));
  }
}

TEST(RandomMesh, linearDensity_isRemappedExactlyWithoutLimiterByBothStages)
{
  for (bool swept : {false, true})
  {
    auto const linear = [](Vector2 const &x) { return 2.0 + x[0] - 0.5 * x[1]; };
    Scene scene = regularToRandom(12, 0.25, linear);
    scene.options = optionsOf(2, swept, RemapLimiter::None);
    ResultOnHost const result = scene.remapped();
    for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
    {
      Quadrilateral const q = cellQuadrilateral(scene.mesh, cell);
      EXPECT_NEAR(result.state.record(cell, Mass), gaussAverage(q, linear) * area(q), 1e-14) << "cell " << cell;
    }
  }
}

TEST(RandomMesh, randomDensityAndPrimitives_stayWithinTheirRange)
{
  for (int order : {1, 2, 3})
    for (bool swept : {false, true})
      for (RemapLimiter limiter : {RemapLimiter::Range, RemapLimiter::RangeInside})
        EXPECT_LE(overshoot(optionsOf(order, swept, limiter)), 1e-12) << order << swept;
}

TEST(RandomMesh, whatAContactWallPushesBack_staysWithinTheRangeToo)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(1.0, 2.0);
  for (int order : {2, 3})
  {
    Scene scene(12, 12, 0.2, twoLaws(), BoundaryKind::ContactWall);
    auto const noise = [&](int, Vector2 const &) { return std::round(uniform(random)); };
    scene.paint({rest(0)}, noise, noise);
    // Cells at the right wall stretch both ways: the inner neighbours get one end, the wall pushes back the other.
    scene.move(
        [](int, Vector2 const &x)
        {
          double const from_wall = std::round(12.0 * (1.0 - x[0]));
          return Vector2{from_wall == 0.0 ? 0.4 / 12.0 : from_wall == 1.0 ? -0.4 / 12.0 : 0.0, 0.0};
        });
    scene.options = optionsOf(order, false, RemapLimiter::Range);
    ResultOnHost const result = scene.remapped();
    EXPECT_EQ(scene.report.failures, 0);
    for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
    {
      EXPECT_GE(result.state.record(pair, InternalEnergy), 1.0 - 1e-12);
      EXPECT_LE(result.state.record(pair, InternalEnergy), 2.0 + 1e-12);
    }
  }
}

TEST(RandomMesh, otherLimiters_overshoot)
{
  for (bool swept : {false, true})
  {
    double const van_leer = overshoot(optionsOf(2, swept, RemapLimiter::VanLeer));
    double const none = overshoot(optionsOf(2, swept, RemapLimiter::None));
    std::printf("%s: overshoot of a range of one: van Leer %.3f, no limiter %.3f\n", swept ? "swept" : "intersected",
                van_leer, none);
    EXPECT_GT(van_leer, 1e-6);
    EXPECT_GT(none, van_leer);
  }
}

TEST(ThirdOrder, smoothDensityFromARegularMesh_errorFallsWithTheCubeOfTheCellSize)
{
  for (bool swept : {false, true})
    for (RemapLimiter limiter : {RemapLimiter::RangeInside, RemapLimiter::None})
    {
      double const coarse = error(32, optionsOf(3, swept, limiter)), fine = error(64, optionsOf(3, swept, limiter));
      std::printf("third order, %s: 32 %.3e, 64 %.3e, slope %.2f\n", swept ? "swept" : "intersected", coarse, fine,
                  std::log2(coarse / fine));
      EXPECT_GT(std::log2(coarse / fine), 2.8);
      EXPECT_LT(fine, 0.3 * error(64, optionsOf(2, swept, limiter)));
    }
}

TEST(ThirdOrder, energyOnADensityThatVaries_isOfThirdOrderToo)
{
  for (bool swept : {false, true})
  {
    RemapOptions const options = optionsOf(3, swept, RemapLimiter::None);
    double const coarse = energyError(32, options), fine = energyError(64, options);
    std::printf("energy, %s: 32 %.3e, 64 %.3e, slope %.2f\n", swept ? "swept" : "intersected", coarse, fine,
                std::log2(coarse / fine));
    EXPECT_GT(std::log2(coarse / fine), 2.8);
  }
}

TEST(ThirdOrder, quadraticDensity_isRemappedExactlyFromARandomMesh)
{
  auto const quadratic = [](Vector2 const &x) { return 2.0 + x[0] - 0.5 * x[1] + x[0] * x[0] - x[0] * x[1] * 1.5; };
  int const n = 12;
  for (bool swept : {false, true})
  {
    Scene scene = randomToRegular(n, 0.25, quadratic);
    scene.options = optionsOf(3, swept, RemapLimiter::None);
    ResultOnHost const result = scene.remapped();
    for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
    {
      Quadrilateral const q = cellQuadrilateral(scene.mesh, cell);
      double const rim = 1.5 / n; // cells at the boundary lack the neighbours that a fit needs
      if (q[0][0] > rim && q[0][1] > rim && q[2][0] < 1.0 - rim && q[2][1] < 1.0 - rim)
      {
        EXPECT_NEAR(result.state.record(cell, Mass), gaussAverage(q, quadratic) * area(q), 1e-14) << "cell " << cell;
      }
    }
  }
}

TEST(ThirdOrder, smoothDensityFromARandomMesh_isOfThirdOrderToo)
{
  for (bool swept : {false, true})
  {
    double e[2];
    for (int i = 0; i < 2; ++i)
    {
      Scene scene = randomToRegular(32 << i, 0.25, sine);
      scene.options = optionsOf(3, swept, RemapLimiter::None);
      e[i] = densityError(scene);
    }
    std::printf("from a random mesh, %s: 32 %.3e, 64 %.3e, slope %.2f\n", swept ? "swept" : "intersected", e[0], e[1],
                std::log2(e[0] / e[1]));
    EXPECT_GT(std::log2(e[0] / e[1]), 2.8);
  }
}

TEST(ThirdOrder, contourIntegrals_keepTheOrderOnRegularMeshesOnly)
{
  double regular[2], irregular[2];
  for (int i = 0; i < 2; ++i)
    for (bool random : {false, true})
    {
      int const n = 32 << i;
      Scene scene = random ? randomToRegular(n, 0.25, sine) : regularToRandom(n, 0.25, sine);
      scene.options = optionsOf(3, false, RemapLimiter::None);
      scene.options.hessian = RemapHessian::Contour;
      (random ? irregular : regular)[i] = densityError(scene);
    }
  std::printf("contour: regular 32 %.3e, 64 %.3e, slope %.2f; random 32 %.3e, 64 %.3e, slope %.2f\n", regular[0],
              regular[1], std::log2(regular[0] / regular[1]), irregular[0], irregular[1],
              std::log2(irregular[0] / irregular[1]));
  EXPECT_GT(std::log2(regular[0] / regular[1]), 2.8);
  EXPECT_LT(std::log2(irregular[0] / irregular[1]), 2.5);
}

namespace
{

void expectConservationWithinRange(bool swept)
{
  Scene scene(16, 16, 0.2, twoLaws());
  scene.options = optionsOf(3, swept, RemapLimiter::Range);
  auto const wave = [](int material, Vector2 const &x) { return 2.0 + material + std::sin(9.0 * x[0] + 7.0 * x[1]); };
  scene.paint({disc(0, {0.45, 0.5}, 0.3), rest(1)}, wave, wave);
  scene.move(
      [](int, Vector2 const &x)
      {
        double const wall = std::sin(Math::pi * x[0]) * std::sin(Math::pi * x[1]);
        return 0.015 * wall * Vector2{std::cos(9.0 * x[1]), std::sin(8.0 * x[0])};
      });
  double low[2] = {1e9, 1e9}, high[2] = {0.0, 0.0};
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
  {
    int const m = scene.pairs.material(pair);
    low[m] = std::min(low[m], scene.state.record(pair, InternalEnergy));
    high[m] = std::max(high[m], scene.state.record(pair, InternalEnergy));
  }
  ResultOnHost const result = scene.remapped();
  EXPECT_EQ(scene.report.failures, 0);
  for (int m : {0, 1})
  {
    Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half, m);
    Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity, m);
    EXPECT_NEAR(after.mass, before.mass, 1e-14 * before.mass);
    EXPECT_NEAR(after.internal, before.internal, 1e-14 * before.internal);
  }
  Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
  Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d] - scene.report.wall_impulse[d], before.momentum[d], 1e-15 * before.mass);
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
  {
    int const m = result.pairs.material(pair);
    EXPECT_GE(result.state.record(pair, InternalEnergy), low[m] * (1.0 - 1e-12));
    EXPECT_LE(result.state.record(pair, InternalEnergy), high[m] * (1.0 + 1e-12));
  }
}

} // namespace

TEST(ThirdOrder, twoMaterials_conserveMassMomentumAndEnergyAndStayWithinRange)
{
  expectConservationWithinRange(false);
  expectConservationWithinRange(true);
}

TEST(ThirdOrder, contourIntegralsWithSweptFaces_areRefused)
{
  RemapOptions options = optionsOf(3, true, RemapLimiter::Range);
  options.hessian = RemapHessian::Contour;
  EXPECT_THROW(error(4, options), std::runtime_error);
}
