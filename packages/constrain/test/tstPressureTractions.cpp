// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <Harmos_ContactRows.hpp>
#include <Harmos_PressureTractions.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace Harmos;
using namespace HarmosTest;

namespace
{

constexpr double pressure = 3.0;

/// A fluid and a body of which each cell of the fourth row holds a piece, along a line of its own: steps lie between
/// them on the cell faces, too short for rows.
TinyScene steps(int fluid, double body_density, double open = 0.0)
{
  auto const line = [](Quadrilateral const &q)
  {
    int const column = static_cast<int>(std::floor(0.25 * (q[0][0] + q[1][0] + q[2][0] + q[3][0])));
    double const slope = 0.2 * std::sin(2.3 * column), height = 3.45 + 0.1 * std::cos(1.7 * column);
    Vector2 const n = normalised(Vector2{-slope, 1.0});
    return Plane2{n, dot(n, Vector2{column + 0.5, height})};
  };
  auto const piece = [line](Quadrilateral const &q, bool above, double aside)
  {
    Plane2 plane = line(q);
    plane.offset += aside;
    Region part;
    clip(wholeCell(q), above ? Plane2{-plane.normal, -plane.offset} : plane, part);
    return part;
  };
  std::vector<double> density(2, body_density);
  density[static_cast<std::size_t>(fluid)] = 1.0;
  TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(8, 8)),
                  {{0, [piece](Quadrilateral const &q) { return piece(q, false, 0.0); }},
                   {1, [piece, open](Quadrilateral const &q) { return piece(q, true, open); }}},
                  2, {BoundaryKind::SlipWall, BoundaryKind::SlipWall, BoundaryKind::SlipWall, BoundaryKind::SlipWall},
                  Kinematics::Xfem, density);
  std::vector<int> is_fluid(2, 0);
  is_fluid[static_cast<std::size_t>(fluid)] = 1;
  scene.options.fluid = deviceCopy("fluid", is_fluid);
  scene.options.short_segments = deviceCopy(
      "short_segments", std::vector<ShortSegments>{fluid == 0 ? ShortSegments::Kept : ShortSegments::Dropped,
                                                   fluid == 1 ? ShortSegments::Kept : ShortSegments::Dropped});
  scene.options.impedance = deviceCopy("impedance", std::vector<double>(2, 1.0));
  scene.dt = 1.0;
  return scene;
}

/// Pressure p in all of the fluid's pairs.
void press(TinyScene &scene, double p)
{
  scene.stress.pressure = View<double *[3]>("pressure", scene.pairs.num_pairs);
  auto const pressures = Kokkos::create_mirror_view(scene.stress.pressure);
  auto const record = onHost(scene.record);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
  {
    pressures(pair, 0) = p;
    pressures(pair, 1) = pressures(pair, 2) = record(pair, VolumeFraction);
  }
  Kokkos::deep_copy(scene.stress.pressure, pressures);
}

/// v* of the fluid by p n on all edges of its regions: the ends and the middle of those inside of cells count as the
/// volume that they sweep does, those on cell faces in the middle.
void drive(TinyScene &scene, int fluid, double p)
{
  auto const corner = cellsOf(scene.mesh);
  auto const regions = regionsOf(scene);
  auto const material = onHost(scene.pairs.material);
  auto const cell = onHost(scene.pairs.cell);
  auto const dof_node = onHost(scene.pairs.dof_node);
  auto const mass = onHost(scene.dof_mass);
  auto const predicted = onHost(scene.predicted);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
  {
    if (material(pair) != fluid)
      continue;
    Quadrilateral const &q = corner(cell(pair));
    Region const &region = regions(pair);
    for (int i = 0; i < region.size; ++i)
    {
      Vector2 const a = region[i], b = region[(i + 1) % region.size], edge = b - a;
      Vector2 const load = scene.dt * p * Vector2{edge[1], -edge[0]};
      bool const on_face = std::fabs(edge[0]) < 1e-12 || std::fabs(edge[1]) < 1e-12;
      double const part[3] = {on_face ? 0.0 : 0.25, on_face ? 1.0 : 0.5, on_face ? 0.0 : 0.25};
      for (int j = 0; j < 3; ++j)
      {
        double N[4];
        shapeFunctionsAt(q, a + (0.5 * j) * edge, N);
        for (int k = 0; k < 4; ++k)
          for (int d = 0; d < 2; ++d)
          {
            int const dof = dof_node(pair, k);
            predicted(dof, d) += part[j] * N[k] * load[d] / mass(dof);
          }
      }
    }
  }
  auto const node = onHost(scene.dof_nodes.node);
  auto const node_index = onHost(scene.conditions.node_index);
  auto const condition = onHost(scene.conditions.condition);
  for (int dof = 0; dof < scene.dof_nodes.num_dof_nodes; ++dof)
  {
    int const index = node_index(node(dof));
    if (index < 0)
      continue;
    Vector2 const v = condition(index).apply({predicted(dof, 0), predicted(dof, 1)});
    predicted(dof, 0) = v[0];
    predicted(dof, 1) = v[1];
  }
  Kokkos::deep_copy(scene.predicted, predicted);
}

double fastest(TinyScene const &scene)
{
  auto const half = onHost(scene.half);
  double most = 0.0;
  for (int dof = 0; dof < scene.dof_nodes.num_dof_nodes; ++dof)
    most = std::max({most, std::fabs(half(dof, 0)), std::fabs(half(dof, 1))});
  return most;
}

double largest(View<double *[2]> const &first, View<double *[2]> const &second)
{
  auto const v = onHost(first);
  auto const w = onHost(second);
  double most = 0.0;
  for (std::size_t dof = 0; dof < v.extent(0); ++dof)
    most = std::max({most, std::fabs(v(dof, 0) - w(dof, 0)), std::fabs(v(dof, 1) - w(dof, 1))});
  return most;
}

} // namespace

TEST(PressureTractions, fluidOfOnePressure_restsOnAnyFacets)
{
  for (int const fluid : {0, 1})
  {
    TinyScene scene = steps(fluid, 1e9);
    drive(scene, fluid, pressure);
    scene.constrain();
    EXPECT_GT(fastest(scene), 0.1); // by the steps
    press(scene, pressure);
    ConstraintReport const report = scene.constrain();
    EXPECT_LT(fastest(scene), 1e-7);
    // What the body bears is the pressure on all of the interface: the box's width.
    Vector2 const on_fluid = report.pair_force[static_cast<std::size_t>(3 * fluid + 1 - fluid)].impulse;
    EXPECT_NEAR(on_fluid[1], (fluid == 0 ? -8.0 : 8.0) * pressure, 1e-6);
  }
}

TEST(PressureTractions, keepMomentumAndTellTheirWork)
{
  auto const moving = [](double speed)
  {
    TinyScene scene = steps(1, 2.0);
    scene.setVelocity(
        [speed](int material, Vector2 const &x) {
          return speed * (material == 0 ? Vector2{1.0, 0.5 * x[0]} : Vector2{-2.0 * x[1], -1.0});
        });
    return scene;
  };
  TinyScene scene = moving(0.003);
  press(scene, pressure);
  TinyScene::Sums const before = scene.sums(scene.predicted, -2);
  ConstraintReport const report = scene.constrain();
  TinyScene::Sums const after = scene.sums(scene.half, -2);
  // What the walls take is told.
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d] - before.momentum[d], report.external_impulse[d], 1e-12);
  EXPECT_NEAR(after.kinetic - before.kinetic, report.driven_work - report.contact_loss, 1e-11);
  TinyScene plain = moving(0.003);
  plain.constrain();
  EXPECT_GT(largest(plain.half, scene.half), 1e-2);
  // They act on nothing that slides at a speed near sqrt(p / density).
  TinyScene fast = moving(3.0), fast_and_plain = moving(3.0);
  press(fast, pressure);
  fast.constrain();
  fast_and_plain.constrain();
  EXPECT_EQ(largest(fast_and_plain.half, fast.half), 0.0);
}

TEST(PressureTractions, actOnlyWhereAFluidPresses)
{
  auto const changes = [](double p, double open, Interaction kind)
  {
    TinyScene scene = steps(1, 2.0, open);
    scene.setInteraction(0, 1, {kind, 0.0, 0.0, {}});
    scene.setVelocity([](int material, Vector2 const &) { return Vector2{0.0, material == 0 ? -1e-3 : 1e-3}; });
    scene.constrain();
    View<double *[2]> const without("without", scene.half.extent(0));
    Kokkos::deep_copy(without, scene.half);
    press(scene, p);
    scene.constrain();
    return largest(without, scene.half);
  };
  EXPECT_GT(changes(pressure, 0.0, Interaction::Sliding), 0.1);
  EXPECT_GT(changes(pressure, 5e-4, Interaction::Sliding), 0.1);
  EXPECT_EQ(changes(-pressure, 0.0, Interaction::Sliding), 0.0);
  EXPECT_EQ(changes(pressure, 0.3, Interaction::Sliding), 0.0); // more than the steps
  EXPECT_EQ(changes(pressure, 0.0, Interaction::Bonded), 0.0);
}

TEST(PressureTractions, doNotHoldVoidOpenThatThePressureCloses)
{
  TinyScene scene = steps(1, 2.0, 0.3);
  drive(scene, 1, pressure);
  scene.constrain();
  EXPECT_GT(fastest(scene), 0.3 / scene.dt); // the fluid goes into it
  View<double *[2]> const without("without", scene.half.extent(0));
  Kokkos::deep_copy(without, scene.half);
  press(scene, pressure);
  scene.constrain();
  EXPECT_EQ(largest(without, scene.half), 0.0);
}

/// Tractions of one cell where its fluid has `own` times the pressure of all others, over those where it has as much.
double loadOver(double own)
{
  TinyScene scene = steps(1, 2.0);
  int const cell = 3 * 8 + 4;
  auto const loads = [&](double p)
  {
    press(scene, pressure);
    auto const pressures = onHost(scene.stress.pressure);
    pressures(scene.pairOf(cell, 1), 0) = p;
    Kokkos::deep_copy(scene.stress.pressure, pressures);
    PressureTractions tractions;
    tractions.pressure = scene.stress.pressure;
    findContactRows(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions,
                    buildBodyTable(scene.bodies_n, 2), scene.bonds, scene.options, *scene.exchange,
                    {scene.predicted, buildBodyTable(scene.bodies_n, 2)}, scene.dt, nullptr, {}, {}, &tractions);
    auto const row = onHost(tractions.rows.row);
    auto const load = onHost(tractions.load);
    double sum = 0.0;
    for (int r = 0; r < tractions.rows.count; ++r)
      if (row(r).material_a == 1 && row(r).cell_a == cell)
        sum += std::hypot(load(r, 0), load(r, 1));
    return sum;
  };
  return loads(own * pressure) / loads(pressure);
}

TEST(PressureTractions, areTheMeanOfPressuresUpToTheCellsOwn)
{
  TinyScene const scene = steps(1, 2.0);
  int const cell = 3 * 8 + 4;
  auto const record = onHost(scene.record);
  double const part = record(scene.pairOf(cell, 1), VolumeFraction);
  double volume = 0.0;
  for (int row = 2; row < 5; ++row)
    for (int column = 3; column < 6; ++column)
      if (int const pair = scene.pairOf(8 * row + column, 1); pair >= 0)
        volume += record(pair, VolumeFraction);
  double const own = part / volume;
  EXPECT_NEAR(loadOver(3.0), 1.0 + 2.0 * own, 1e-12);
  EXPECT_NEAR(loadOver(1.05), 1.0 + 0.05 * own, 1e-12);
  EXPECT_NEAR(loadOver(0.2), 0.2 * (1.1 - 0.1 * own), 1e-12);
}
