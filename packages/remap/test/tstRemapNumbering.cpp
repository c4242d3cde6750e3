// SPDX-License-Identifier: BSD-3-Clause
#include "RemapScene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

Vector2 swirl(int, Vector2 const &x)
{
  return {0.011 * std::sin(6.0 * x[1] + 1.0), -0.013 * std::cos(5.0 * x[0] - 2.0 * x[1])};
}

Material yielding()
{
  Material law = twoLaws()[0];
  law.strength = StrengthKind::Plastic;
  law.yield = 0.3;
  law.hardening = 1.0;
  return law;
}

/// One material in a box, cells in the given order with corner 0 anywhere: where neighbours are no runs of cells.
struct Numbered
{
  Scene scene;
  ResultOnHost result;

  Numbered(int nx, int ny, std::vector<int> const &order, std::vector<int> const &turn, RemapLimiter limiter)
      : scene(nx, ny, 0.2, {yielding()})
  {
    HostMesh const rows = scene.host_mesh;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (int k = 0; k < 4; ++k)
      {
        scene.host_mesh.cell[i][k] = rows.cell[order[i]][(k + turn[i]) % 4];
        scene.host_mesh.face_boundary[i][k] = rows.face_boundary[order[i]][(k + turn[i]) % 4];
      }
    Boundary wall;
    wall.kind = BoundaryKind::SlipWall;
    scene.setBoundaries(std::vector<Boundary>(4, wall));
    scene.options.limiter = limiter;
    scene.paint({rest(0)}, wave, [](int, Vector2 const &x) { return 2.0 + std::cos(9.0 * x[0] * x[1]); });
    scene.move(swirl);
    result = scene.remapped();
  }
};

} // namespace

TEST(Numbering, cellsInAnyOrder_getTheSameRecordsAndVelocities)
{
  int const nx = 21, ny = 14, cells = nx * ny;
  std::vector<int> in_rows(cells), none(cells, 0), any(cells), turn(cells);
  std::iota(in_rows.begin(), in_rows.end(), 0);
  any = in_rows;
  std::mt19937 random(5);
  std::shuffle(any.begin(), any.end(), random);
  for (int &t : turn)
    t = static_cast<int>(random() % 4);
  for (RemapLimiter limiter :
       {RemapLimiter::Range, RemapLimiter::RangeInside, RemapLimiter::VanLeer, RemapLimiter::None})
  {
    Numbered const a(nx, ny, in_rows, none, limiter), b(nx, ny, any, turn, limiter);
    double moved = 0.0;
    for (int i = 0; i < cells; ++i)
      for (int f = 0; f < num_pair_fields; ++f)
      {
        double const x = a.result.state.record(any[i], f);
        EXPECT_NEAR(b.result.state.record(i, f), x, 1e-13);
        moved = std::max(moved, std::fabs(x - a.scene.state.record(any[i], f)));
      }
    EXPECT_GT(moved, 0.1);
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < 2; ++d)
          EXPECT_NEAR(b.result.state.velocity(b.result.pairs.dof_node(i, k), d),
                      a.result.state.velocity(a.result.pairs.dof_node(any[i], (k + turn[i]) % 4), d), 1e-15);
  }
}
