// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

Vector2 slip(int material, Vector2 const &x)
{
  double const s = std::sin(Math::pi * x[0]) * std::sin(Math::pi * x[1]);
  return s * Vector2{0.011 + 0.004 * material, 0.009 * std::cos(3.0 * x[1]) - 0.005 * material};
}

Scene makeScene(std::vector<Layer> const &layers, std::vector<int> const &owner, int halo, int order = 2,
                bool about_axis = false)
{
  Scene scene(24, 20, 0.2, twoLaws());
  if (about_axis)
    scene.aboutAxis();
  scene.options.return_kinetic_defect = true;
  scene.options.merge_below = 1e-2; // many merges
  scene.options.order = order;
  if (!owner.empty())
    scene.distribute(owner, halo);
  scene.paint(layers, wave, wave);
  scene.move(slip);
  return scene;
}

} // namespace

TEST(Ranks, ownedCellsOfAPart_holdTheBitsOfTheWhole)
{
  std::vector<std::vector<Layer>> const layers = {
      {rest(0)}, {disc(0, {0.45, 0.5}, 0.3)}, {disc(0, {0.45, 0.5}, 0.27), halfPlane(2, {0.5, 0.5}, 0.3), rest(1)}};
  for (auto const &layer : layers)
  {
    Scene whole = makeScene(layer, {}, 0);
    ResultOnHost const all = whole.remapped();
    for (int column : {8, 11, 15})
      for (int halo : {3, 5})
      {
        std::vector<int> owner(24 * 20);
        for (int cell = 0; cell < 24 * 20; ++cell)
          owner[cell] = cell % 24 < column + (cell / 24) % 3 ? 0 : 1;
        Scene part = makeScene(layer, owner, halo);
        ResultOnHost const result = part.remapped();
        long long const n = differences(part, result, all);
        std::printf("halo %d: %lld values differ\n", halo, n);
        if (halo == 5)
        {
          EXPECT_EQ(n, 0);
        }
      }
  }
}

TEST(Ranks, ownedCellsOfAPart_holdTheBitsOfTheWholeInThirdOrder)
{
  std::vector<Layer> const layers = {disc(0, {0.45, 0.5}, 0.2), rest(1)};
  for (bool about_axis : {false, true})
  {
    ResultOnHost const all = makeScene(layers, {}, 0, 3, about_axis).remapped();
    std::vector<int> owner(24 * 20);
    for (int cell = 0; cell < 24 * 20; ++cell)
      owner[cell] = cell % 24 < 11 + (cell / 24) % 3 ? 0 : 1;
    Scene part = makeScene(layers, owner, 5, 3, about_axis);
    EXPECT_EQ(differences(part, part.remapped(), all), 0) << about_axis;
  }
}

// Where a part holds no interface, only three layers of its halo are swept: those that stand apart in its numbers.
TEST(Ranks, ownedCellsOfAPureBodyCutAcrossItsNumbers_holdTheBitsOfTheWhole)
{
  for (bool about_axis : {false, true})
    for (int order : {1, 2, 3})
    {
      ResultOnHost const all = makeScene({rest(0)}, {}, 0, order, about_axis).remapped();
      for (int low : {0, 1})
      {
        std::vector<int> owner(24 * 20);
        for (int cell = 0; cell < 24 * 20; ++cell)
          owner[cell] = cell < 24 * 9 + 5 ? low : 1 - low;
        Scene part = makeScene({rest(0)}, owner, 7, order, about_axis);
        EXPECT_EQ(differences(part, part.remapped(), all), 0) << about_axis << " order " << order << " low " << low;
      }
    }
}
