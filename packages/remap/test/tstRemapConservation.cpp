// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

double heat(int material, Vector2 const &x)
{
  return 2.0 + 0.5 * material + std::cos(4.0 * x[0] + 3.0 * x[1]);
}

/// Smooth in the box, tangential on its sides.
Vector2 swirl(int, Vector2 const &x)
{
  double const pi = Math::pi;
  return {0.012 * std::sin(pi * x[0]) * std::cos(2.0 * pi * x[1]), -0.01 * std::cos(pi * x[0]) * std::sin(pi * x[1])};
}

/// Materials move apart and into each other.
Vector2 slip(int material, Vector2 const &x)
{
  return swirl(material, x) +
         (material == 0 ? 0.004 : -0.003) * Vector2{std::sin(Math::pi * x[0]), 0.3 * std::sin(Math::pi * x[1])};
}

void expectConserved(Scene &scene, int materials)
{
  ResultOnHost const result = scene.remapped();
  Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
  Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
  double const scale = std::sqrt(2.0 * before.mass * before.kinetic);
  for (int m = 0; m < materials; ++m)
  {
    Totals const b = totals(scene.mesh, scene.pairs, scene.state.record, scene.half, m);
    Totals const a = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity, m);
    EXPECT_NEAR(a.mass, b.mass, 1e-14 * b.mass);
    EXPECT_NEAR(a.thermodynamic_volume, b.thermodynamic_volume, 1e-14 * b.thermodynamic_volume);
    EXPECT_NEAR(a.plastic, b.plastic, 1e-14 * b.plastic);
  }
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d] - scene.report.wall_impulse[d], before.momentum[d], 1e-14 * scale);
  if (scene.options.return_kinetic_defect)
  {
    EXPECT_NEAR(after.internal + after.kinetic, before.internal + before.kinetic,
                1e-14 * (before.internal + before.kinetic));
    EXPECT_NEAR(scene.report.kinetic_loss, 0.0, 1e-14 * before.internal);
  }
  else
  {
    EXPECT_NEAR(after.internal, before.internal, 1e-14 * before.internal);
    EXPECT_NEAR(scene.report.kinetic_loss, before.kinetic - after.kinetic, 1e-13 * before.kinetic);
    EXPECT_GT(scene.report.kinetic_loss, 0.0);
  }
  EXPECT_EQ(scene.report.failures, 0);
  EXPECT_LE(largestSumOfFractions(scene.mesh, result), 1.0 + 1e-15);
}

} // namespace

TEST(Conservation, pureRegionOrDiscInVoid_randomMeshAndMotion_conservesAll)
{
  for (Layer const &layer : {rest(0), disc(0, {0.45, 0.55}, 0.31)})
    for (int order : {1, 2})
      for (bool heat_returned : {false, true})
      {
        Scene scene(17, 15, 0.2, twoLaws());
        scene.options.order = order;
        scene.options.return_kinetic_defect = heat_returned;
        scene.paint({layer}, wave, heat);
        scene.move(swirl);
        expectConserved(scene, 1);
      }
}

TEST(Conservation, twoMaterialsWithOwnVelocities_conserveAll)
{
  for (Kinematics kinematics : {Kinematics::Xfem, Kinematics::Single})
    for (bool heat_returned : {false, true})
    {
      Scene scene(16, 16, 0.2, twoLaws());
      scene.kinematics = kinematics;
      scene.options.return_kinetic_defect = heat_returned;
      scene.paint({disc(0, {0.5, 0.5}, 0.3), rest(1)}, wave, heat);
      scene.move(slip);
      expectConserved(scene, 2);
    }
}

TEST(Conservation, threeMaterialsAndVoid_conserveAll)
{
  Scene scene(13, 15, 0.2, twoLaws());
  scene.paint({halfPlane(2, {0.3, 0.3}, 2.0), halfPlane(0, {0.5, 0.5}, 0.4), halfPlane(1, {0.8, 0.8}, 1.1)}, wave,
              heat);
  scene.move(slip);
  expectConserved(scene, 3);
}

TEST(Conservation, regionPushedThroughContactWall_keepsItsMassAndMomentum)
{
  Scene scene(10, 10, 0.2, twoLaws(), BoundaryKind::ContactWall);
  scene.options.return_kinetic_defect = true;
  scene.paint({rest(0)}, wave, heat);
  scene.move([](int, Vector2 const &) { return Vector2{0.02, -0.01}; });
  expectConserved(scene, 1);
}

TEST(Conservation, massesThatDoNotMove_keepTheirBits)
{
  Scene scene(12, 12, 0.2, twoLaws());
  scene.options.return_kinetic_defect = true;
  scene.paint({disc(0, {0.5, 0.5}, 0.3), halfPlane(1, {0.5, 0.5}, 0.2)}, wave, heat);
  scene.dt = 0.0;
  scene.move(slip);
  ResultOnHost const result = scene.remapped();
  ASSERT_EQ(result.pairs.num_pairs, scene.pairs.num_pairs);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
    for (int f = 0; f < num_pair_fields; ++f)
      EXPECT_EQ(result.state.record(pair, f), scene.state.record(pair, f));
  for (int dof = 0; dof < scene.dof_nodes.num_dof_nodes; ++dof)
    for (int d = 0; d < 2; ++d)
      EXPECT_EQ(result.state.velocity(dof, d), scene.half(dof, d));
  double const kinetic = totals(scene.mesh, scene.pairs, scene.state.record, scene.half, 0).kinetic;
  EXPECT_NEAR(scene.report.kinetic_loss, 0.0, 1e-14 * kinetic); // two sums of the same numbers
  EXPECT_EQ(scene.report.overlap_volume + scene.report.void_volume + scene.report.closed_volume, 0.0);
}

namespace
{

constexpr double needle_cell = 1.0 / 3.0;

//            C     A needle along a cell's diagonal, bent by the bilinear map by forty times its thickness: edge AQ
//      P  .  '     then crosses edge CP, and what lies beyond the crossing would count as a negative volume.
//    . ' Q
//  A
Scene needle(double thickness, Vector2 const &corner, BoundaryKind kind)
{
  Scene scene(3, 3, 0.0, twoLaws(), kind);
  Vector2 const across = perpendicular(normalised(Vector2{1.0, 1.0}));
  auto const point = [&](double s, double offset) {
    return corner + needle_cell * (s * Vector2{1.0, 1.0} + offset * across);
  };
  Vector2 const vertex[4] = {point(0.1, 0.0), point(0.7, -thickness), point(0.9, 0.0), point(0.3, thickness)};
  std::vector<Layer> layers;
  for (int k = 0; k < 4; ++k) // all on the outer side of an edge is void
  {
    Vector2 const inward = normalised(perpendicular(vertex[(k + 1) % 4] - vertex[k]));
    layers.push_back({-1, [=](Vector2 const &) { return Plane2{inward, dot(inward, vertex[k])}; }});
  }
  layers.push_back(rest(0));
  scene.paint(
      layers, [](int, Vector2 const &) { return 1.0; }, [](int, Vector2 const &) { return 2.0; });
  return scene;
}

/// After the move of a needle: its centroid.
Vector2 expectKept(Scene &scene, int pairs, double thickness)
{
  Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
  ResultOnHost const result = scene.remapped();
  Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity);
  EXPECT_EQ(scene.report.failures, 0) << "thickness " << thickness;
  EXPECT_EQ(result.pairs.num_pairs, pairs);
  EXPECT_NEAR(after.mass / before.mass, 1.0, 1e-14);
  EXPECT_NEAR(after.volume, before.volume, 1e-16);
  EXPECT_NEAR(after.internal / before.internal, 1.0, 1e-14);
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-14 * norm(before.momentum));
  Vector2 moment{0.0, 0.0};
  for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
    moment += result.state.record(pair, Mass) * Vector2{result.state.centroid(pair, 0), result.state.centroid(pair, 1)};
  return (1.0 / after.mass) * moment;
}

} // namespace

TEST(Conservation, needleThatItsMotionWouldFold_movesAsAWhole)
{
  for (double const thickness : {1e-3, 1e-6, 1e-9})
  {
    double const h = needle_cell;
    Scene scene = needle(thickness, {h, h}, BoundaryKind::Outflow);
    ASSERT_EQ(scene.pairs.num_pairs, 1);
    Vector2 const shift{0.5 * h, 0.0}, across = perpendicular(normalised(Vector2{1.0, 1.0}));
    scene.move(
        [&](int, Vector2 const &x)
        {
          bool const on_diagonal = (x[0] < 0.5) == (x[1] < 0.5);
          return shift + (on_diagonal ? -0.01 : 0.01) * h * across;
        });
    Vector2 const still{scene.state.centroid(0, 0), scene.state.centroid(0, 1)};
    EXPECT_LT(norm(expectKept(scene, 2, thickness) - (still + shift)), 0.011 * h);
  }
}

TEST(Conservation, needleBesideAWallThatItsMotionWouldFold_doesNotCrossTheWall)
{
  for (double const thickness : {1e-3, 1e-6, 1e-9})
  {
    double const h = needle_cell;
    Scene scene = needle(thickness, {0.0, h}, BoundaryKind::SlipWall);
    ASSERT_EQ(scene.pairs.num_pairs, 1);
    // Its middle moves by 0.15 h to the wall, of which its lower end is 0.1 h away.
    scene.move(
        [&](int, Vector2 const &x)
        {
          bool const on_diagonal = (x[0] < 0.5 * h) == (x[1] < 0.5);
          return Vector2{x[0] < 0.5 * h ? 0.0 : -0.3 * h, (on_diagonal ? -0.01 : 0.01) * h};
        });
    double const still = scene.state.centroid(0, 0);
    EXPECT_NEAR(expectKept(scene, 1, thickness)[0], still - 0.1 * h, 1e-8);
  }
}
