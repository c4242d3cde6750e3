// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

Vector2 swirl(int material, Vector2 const &x)
{
  double const s = std::sin(Math::pi * x[0]) * std::sin(Math::pi * x[1]);
  return s * Vector2{0.004 + 0.002 * material, 0.003 * std::cos(3.0 * x[1])};
}

ResultOnHost remapWith(Scene const &scene, RemapWork &work)
{
  RemapReport report;
  return scene.remapped(scene.mesh.on_device, report, work);
}

/// A disc of material 1 in material 0, and a corner of void: a small step changes few cells, a large one many.
void paintDisc(Scene &scene, Vector2 const &middle)
{
  scene.paint({halfPlane(-1, {0.12, 0.12}, 0.25 * Math::pi), disc(1, middle, 0.17), rest(0)}, wave, wave);
  scene.move(swirl);
}

} // namespace

TEST(Work, keptOverSteps_givesTheBitsOfAFreshRemap)
{
  Scene scene(48, 40, 0.2, twoLaws());
  RemapWork work;
  for (double const x : {0.40, 0.404, 0.41, 0.413, 0.42, 0.62, 0.622, 0.41, 0.41})
  {
    paintDisc(scene, {x, 0.5});
    EXPECT_EQ(differences(scene, remapWith(scene, work), scene.remapped()), 0) << "disc at " << x;
  }
}

TEST(Work, keptForAnotherMesh_isNotUsed)
{
  Scene first(48, 40, 0.2, twoLaws()), second(32, 40, 0.1, twoLaws());
  paintDisc(first, {0.45, 0.5});
  paintDisc(second, {0.55, 0.5});
  RemapWork work;
  for (Scene *scene : {&first, &second, &first})
    EXPECT_EQ(differences(*scene, remapWith(*scene, work), scene->remapped()), 0);
}

TEST(Work, whereManyMaterialsMeetInACell_theyAllFindRoom)
{
  Material law;
  law.density0 = 1.0;
  law.strength = StrengthKind::Elastic;
  Scene scene(9, 9, 0.0, std::vector<Material>(7, law));
  scene.options.merge_below = 0.0;
  // Stripes of a seventh of a cell across the middle cell; below and above are materials 0 and 6.
  std::vector<Layer> layers;
  for (int m = 0; m < 6; ++m)
    layers.push_back(halfPlane(m, {0.0, (4.0 + (m + 1) / 7.0) / 9.0}, 0.5 * Math::pi));
  layers.push_back(rest(6));
  scene.paint(layers, wave, wave);
  scene.move(
      [](int, Vector2 const &x) {
        return 0.02 * std::sin(Math::pi * x[0]) * Vector2{0.3, std::sin(Math::pi * x[1])};
      });
  RemapWork work;
  ResultOnHost const result = remapWith(scene, work);
  int most = 0;
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
    most = std::max(most, result.pairs.offset(cell + 1) - result.pairs.offset(cell));
  EXPECT_GE(most, 6);
  for (int m = 0; m < 7; ++m)
  {
    Totals const before = totals(scene.mesh, scene.pairs, scene.state.record, scene.half, m);
    Totals const after = totals(scene.mesh, result.pairs, result.state.record, result.state.velocity, m);
    EXPECT_NEAR(after.mass, before.mass, 1e-14 * before.mass) << "material " << m;
    EXPECT_NEAR(after.internal, before.internal, 1e-14 * before.internal) << "material " << m;
  }
}
