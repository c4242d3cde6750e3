// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <Harmos_Clip.hpp>
#include <Harmos_LumpedForces.hpp>

#include <array>
#include <cmath>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

constexpr int nx = 4, ny = 8;

using Forces = std::vector<std::array<double, 8>>;

/// A fluid behind a line, void beyond it, on 4 x 8 unit cells; its pressure by height.
struct Fluid
{
  Scene s;
  FilledRegions regions;

  Fluid(Plane2 const &line, std::function<double(double)> const &compression, Geometry geometry = Geometry::Planar)
  {
    std::vector<std::vector<Fill>> contents(nx * ny);
    std::vector<int> mixed, first(nx * ny, -1);
    std::vector<Region> polygons;
    for (int c = 0; c < nx * ny; ++c)
    {
      double const x = c % nx, y = c / nx;
      Region cell, part;
      for (Vector2 const &corner : {Vector2{x, y}, Vector2{x + 1, y}, Vector2{x + 1, y + 1}, Vector2{x, y + 1}})
        cell.push(corner);
      clip(cell, line, part);
      double const fraction = part.empty() ? 0.0 : volume(part, geometry) / volume(cell, geometry);
      if (!(fraction > 0.0))
        continue;
      contents[c] = {{0, fraction}};
      if (fraction > 1.0 - 1e-12)
        continue;
      first[c] = static_cast<int>(polygons.size());
      mixed.push_back(c);
      polygons.push_back(part);
    }
    s = makeScene(
        nx, ny, 0.0, {fluid()}, [&](int i, int j) { return contents[i + nx * j]; }, Kinematics::Xfem,
        std::vector<BoundaryKind>(4, BoundaryKind::Outflow), geometry);
    regions.num_mixed_cells = static_cast<int>(mixed.size());
    regions.mixed_cell = deviceCopy("mixed_cell", mixed);
    regions.cell_region = deviceCopy("cell_region", first);
    regions.polygon = deviceCopy("polygon", polygons);
    auto const r = onHost(s.state.record);
    auto const cell = onHost(s.pairs.cell);
    for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
    {
      double const squeezed = 1.0 - compression(cell(pair) / nx + 0.5);
      r(pair, Mass) /= squeezed;
      r(pair, SpecificVolume) *= squeezed;
    }
    Kokkos::deep_copy(s.state.record, r);
    computeCutGradients(s.mesh, s.pairs, s.state.record, regions, s.materials, s.boundary, CutCellStress::FilledRegions,
                        LagrangeOptions().shortest_bent_edge, s.work.cut);
    s.work.keeps_pressure = true;
    prepareWork(s.pairs, s.dof_nodes, s.work);
    computeCornerForces(s.mesh, s.pairs, s.state, s.materials, LagrangeOptions(), s.work);
  }

  Forces forces() const
  {
    auto const f = onHost(s.work.corner_force);
    Forces all(s.pairs.num_pairs);
    for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
      for (int k = 0; k < 8; ++k)
        all[pair][k] = f(pair, k);
    return all;
  }

  Forces added()
  {
    Forces const before = forces();
    EXPECT_TRUE(locateCutFluids(s.mesh, s.pairs, regions, s.materials, LagrangeOptions(), s.work));
    addLumpedForces(s.mesh, s.pairs, s.state, regions, s.boundary, s.materials, LagrangeOptions(), s.work);
    Forces change = forces();
    for (std::size_t i = 0; i < change.size(); ++i)
      for (int k = 0; k < 8; ++k)
        change[i][k] -= before[i][k];
    return change;
  }

  /// Accelerations at the nodes of a level.
  std::vector<double> accelerationsUp(int level) const
  {
    Forces const f = forces();
    auto const cell = onHost(s.pairs.cell);
    auto const node = onHost(s.mesh.cell_node);
    auto const x = onHost(s.mesh.node_position);
    auto const r = onHost(s.state.record);
    std::vector<double> force(nx + 1, 0.0), mass(nx + 1, 0.0), a;
    for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
      for (int k = 0; k < 4; ++k)
      {
        int const n = node(cell(pair), k);
        if (std::lround(x(n, 1)) != level)
          continue;
        force[std::lround(x(n, 0))] += f[pair][2 * k + 1];
        mass[std::lround(x(n, 0))] += s.mesh.corner_share(cell(pair), k) * r(pair, Mass);
      }
    for (int i = 0; i <= nx; ++i)
      if (mass[i] > 0.0)
        a.push_back(force[i] / mass[i]);
    return a;
  }
};

double gradient(double y)
{
  return 1e-4 * (ny - y);
}

} // namespace

TEST(LumpedForces, ofAGradientAlongAnInterfaceGiveAllNodesOneAcceleration)
{
  for (double const part : {0.02, 0.3, 0.5, 0.9})
  {
    Fluid water(Plane2{{1.0, 0.0}, 1.0 + part}, gradient);
    std::vector<double> const before = water.accelerationsUp(4);
    EXPECT_GT(std::fabs(before[2] / before[0] - 1.0), 0.5 * (1.0 - part)); // by the part: what is to be mended
    water.added();
    std::vector<double> const a = water.accelerationsUp(4);
    ASSERT_EQ(a.size(), 3u);
    EXPECT_GT(a[0], 0.0);
    for (double const other : {a[1], a[2]})
      EXPECT_NEAR(other / a[0], 1.0, 2e-3); // masses grow with the pressure
  }
}

TEST(LumpedForces, ofOnePressureAreNone)
{
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (double const slope : {0.0, 0.1, 0.4})
    {
      Fluid gas(
          Plane2{normalised(Vector2{1.0, slope}), 1.7}, [](double) { return 0.01; }, geometry);
      Forces const f = gas.forces(), change = gas.added();
      double largest = 0.0;
      for (std::size_t i = 0; i < f.size(); ++i)
        for (int k = 0; k < 8; ++k)
          largest = std::max(largest, std::fabs(f[i][k]));
      for (std::size_t i = 0; i < f.size(); ++i)
        for (int k = 0; k < 8; ++k)
          EXPECT_NEAR(change[i][k], 0.0, 1e-12 * largest) << slope;
    }
}

TEST(LumpedForces, ofAPairAddUpToNothing)
{
  Fluid water(Plane2{normalised(Vector2{1.0, 0.3}), 2.1}, gradient);
  Forces const change = water.added();
  double largest = 0.0;
  for (std::size_t i = 0; i < change.size(); ++i)
    for (int d = 0; d < 2; ++d)
    {
      double sum = 0.0;
      for (int k = 0; k < 4; ++k)
      {
        sum += change[i][2 * k + d];
        largest = std::max(largest, std::fabs(change[i][2 * k + d]));
      }
      EXPECT_NEAR(sum, 0.0, 1e-15);
    }
  EXPECT_GT(largest, 1e-6);
}

TEST(LumpedForces, ofATipOfHigherPressureAreThoseThroughItsOpening)
{
  // A wedge below y = 3 at the wall x = 4, open above over 0.26 cells. The wall there bears the pressure of the cells
  // above; were it the wedge's, these would be driven along the wall's normal by the difference over half a cell.
  Fluid gas(Plane2{normalised(Vector2{-0.2, -0.98}), (-0.2 * 3.74 - 0.98 * 3.0) / std::hypot(0.2, 0.98)},
            [](double y) { return y < 3.0 ? 0.02 : 0.01; });
  Forces const change = gas.added();
  auto const cell = onHost(gas.s.pairs.cell);
  auto const pressure = onHost(gas.s.work.pressure);
  int wedge = -1, above = -1;
  for (int pair = 0; pair < gas.s.pairs.num_pairs; ++pair)
    if (cell(pair) == 2 * nx + 3)
      wedge = pair;
    else if (cell(pair) == 3 * nx + 3)
      above = pair;
  ASSERT_GE(wedge, 0);
  ASSERT_GE(above, 0);
  double const excess = pressure(wedge, 0) - pressure(above, 0), opening = 0.26;
  double const acceleration = excess * opening / (0.25 * pressure(above, 2));
  double largest = 0.0;
  for (double const f : change[wedge])
    largest = std::max(largest, std::fabs(f));
  EXPECT_GT(excess, 0.0);
  EXPECT_LT(largest, 0.25 * pressure(wedge, 2) * acceleration);
}
