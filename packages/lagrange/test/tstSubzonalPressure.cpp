// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <Harmos_SubzonalPressure.hpp>

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

auto subzonalForces(Scene &s, View<double *[4]> const &fraction, double merit)
{
  prepareWork(s.pairs, s.dof_nodes, s.work);
  Kokkos::deep_copy(s.work.corner_force, 0.0);
  addSubzonalForces(s.mesh, s.pairs, s.state, s.materials, fraction, merit, s.work);
  return onHost(s.work.corner_force);
}

void moveNodes(Scene &s, std::function<Vector2(Vector2)> const &map)
{
  auto const x = onHost(s.mesh.node_position);
  for (int n = 0; n < s.mesh.num_nodes; ++n)
  {
    Vector2 const moved = map({x(n, 0), x(n, 1)});
    x(n, 0) = moved[0];
    x(n, 1) = moved[1];
  }
  Kokkos::deep_copy(s.mesh.node_position, x);
  updateGeometry(s.mesh);
}

/// sum over corners of f . displacement
double work(Scene &s, View<double *[4]> const &fraction, std::function<Vector2(Vector2)> const &displacement)
{
  auto const f = subzonalForces(s, fraction, 1.0);
  auto const cell_node = onHost(s.mesh.cell_node);
  auto const x = onHost(s.mesh.node_position);
  double sum = 0.0;
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
    for (int k = 0; k < 4; ++k)
    {
      int const n = cell_node(pair, k);
      Vector2 const d = displacement({x(n, 0), x(n, 1)});
      sum += f(pair, 2 * k) * d[0] + f(pair, 2 * k + 1) * d[1];
    }
  return sum;
}

} // namespace

TEST(SubzonalPressure, FractionsOfAnyCell_addUpToOneAndAreQuartersOnParallelograms)
{
  Scene const skew = makeScene(4, 4, 0.25, {elastic()}, full);
  Scene square = makeScene(4, 4, 0.0, {elastic()}, full);
  moveNodes(square, [](Vector2 x) { return Vector2{x[0] + 0.4 * x[1], 0.1 * x[0] + 2.0 * x[1]}; });
  auto const any = onHost(subzoneFractions(skew.mesh));
  auto const quarter = onHost(subzoneFractions(square.mesh));
  for (int c = 0; c < 16; ++c)
  {
    EXPECT_NEAR(any(c, 0) + any(c, 1) + any(c, 2) + any(c, 3), 1.0, 1e-14);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(quarter(c, k), 0.25, 1e-14);
  }
}

TEST(SubzonalPressure, LinearMotionOfADistortedMesh_feelsNothing)
{
  Scene s = makeScene(5, 4, 0.25, {elastic()}, full);
  auto const fraction = subzoneFractions(s.mesh);
  moveNodes(s, [](Vector2 x) { return Vector2{1.5 * x[0] - 0.6 * x[1], 0.2 * x[0] + 0.3 * x[1]}; });
  auto const f = subzonalForces(s, fraction, 1.0);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
    for (int i = 0; i < 8; ++i)
      EXPECT_NEAR(f(pair, i), 0.0, 1e-12);
}

TEST(SubzonalPressure, AnyMotion_hasNoForceAndNoMoment)
{
  Scene s = makeScene(5, 5, 0.25, {elastic()}, full);
  auto const fraction = subzoneFractions(s.mesh);
  moveNodes(s, [](Vector2 x) { return Vector2{x[0] + 0.02 * x[0] * x[1], x[1] - 0.03 * x[0] * x[1]}; });
  auto const f = subzonalForces(s, fraction, 1.0);
  expectBalanced(s, f, 1e-14, 1e-13);
}

TEST(SubzonalPressure, Wedge_isPushedOpenByTheStatedPressure)
{
  // A unit square whose left edge shrinks to 0.6.
  Scene s = makeScene(1, 1, 0.0, {fluid()}, full);
  auto const fraction = subzoneFractions(s.mesh);
  moveNodes(s, [](Vector2 x) { return x[0] == 0.0 ? Vector2{0.0, 0.2 + 0.6 * x[1]} : x; });
  // Opening the left edge without changing the cell's area: work = sum over subzones of dp dA, areas by hand:
  // A_left = (3 a + b) / 16 each, a = 0.6 + e, b = 1 - e.
  auto const open = [](Vector2 x) { return Vector2{0.0, (x[0] == 0.0 ? 1.0 : -1.0) * (x[1] < 0.5 ? -0.5 : 0.5)}; };
  double const c2_rho = 9.0 * 2.0; // of the fluid at its reference density
  double const a_left = (3.0 * 0.6 + 1.0) / 16.0, a_right = (0.6 + 3.0) / 16.0, quarter = 0.25 * 0.8;
  double const expected = 2.0 * (2.0 / 16.0) * c2_rho * ((quarter / a_left - 1.0) - (quarter / a_right - 1.0));
  EXPECT_NEAR(work(s, fraction, open), expected, 1e-13 * expected);
}
