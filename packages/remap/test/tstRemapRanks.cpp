// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

double wave(int material, Vector2 const &x)
{
  return 1.0 + material + 0.4 * std::sin(7.0 * x[0]) * std::cos(5.0 * x[1]);
}

Vector2 slip(int material, Vector2 const &x)
{
  double const s = std::sin(Math::pi * x[0]) * std::sin(Math::pi * x[1]);
  return s * Vector2{0.011 + 0.004 * material, 0.009 * std::cos(3.0 * x[1]) - 0.005 * material};
}

Scene makeScene(std::vector<Layer> const &layers, std::vector<int> const &owner, int halo)
{
  Scene scene(24, 20, 0.2, twoLaws());
  scene.options.return_kinetic_defect = true;
  scene.options.merge_below = 1e-2; // many merges
  if (!owner.empty())
    scene.distribute(owner, halo);
  scene.paint(layers, wave, wave);
  scene.move(slip);
  return scene;
}

/// Owned cells of `part` hold the bits of the same cells of the whole.
long long differences(Scene const &part, RemapResult const &a, RemapResult const &b)
{
  long long count = 0;
  for (int cell = 0; cell < part.mesh.num_cells; ++cell)
  {
    if (part.mesh.cell_depth(cell) != 0)
      continue;
    int const global = static_cast<int>(part.mesh.cell_global(cell));
    int const pairs = a.pairs.offset(cell + 1) - a.pairs.offset(cell);
    if (pairs != b.pairs.offset(global + 1) - b.pairs.offset(global))
    {
      ++count;
      continue;
    }
    for (int i = 0; i < pairs; ++i)
    {
      int const pa = a.pairs.offset(cell) + i, pb = b.pairs.offset(global) + i;
      for (int f = 0; f < num_pair_fields; ++f)
        count += a.state.record(pa, f) != b.state.record(pb, f);
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < 2; ++d)
          count += a.state.velocity(a.pairs.dof_node(pa, k), d) != b.state.velocity(b.pairs.dof_node(pb, k), d);
    }
  }
  return count;
}

} // namespace

TEST(Ranks, ownedCellsOfAPart_holdTheBitsOfTheWhole)
{
  std::vector<std::vector<Layer>> const layers = {
      {rest(0)}, {disc(0, {0.45, 0.5}, 0.3)}, {disc(0, {0.45, 0.5}, 0.27), halfPlane(2, {0.5, 0.5}, 0.3), rest(1)}};
  for (auto const &layer : layers)
  {
    Scene whole = makeScene(layer, {}, 0);
    RemapResult const all = whole.remapped();
    for (int column : {8, 11, 15})
      for (int halo : {3, 5})
      {
        std::vector<int> owner(24 * 20);
        for (int cell = 0; cell < 24 * 20; ++cell)
          owner[cell] = cell % 24 < column + (cell / 24) % 3 ? 0 : 1;
        Scene part = makeScene(layer, owner, halo);
        RemapResult const result = part.remapped();
        long long const n = differences(part, result, all);
        std::printf("halo %d: %lld values differ\n", halo, n);
        if (halo == 5)
        {
          EXPECT_EQ(n, 0);
        }
      }
  }
}
