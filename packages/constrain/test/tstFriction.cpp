// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <Harmos_ConstraintSums.hpp>
#include <Harmos_OnHost.hpp>

#include <gtest/gtest.h>

using namespace HarmosTest;

namespace
{

constexpr double V = 100.0; // closing speed

PairInteraction rubbing(double coefficient)
{
  return {Interaction::Friction, coefficient, 0.0, {}};
}

/// A row of cells: block 0 left of x = 5.3, block 1 right of it, with masses 2 and 3 times their lengths.
TinyScene rubbingBlocks(double coefficient)
{
  TinyScene scene(rectilinearMesh(uniform(10, 10), uniform(1, 1)),
                  {boxBody(0, 0, 0, 5.3, 1), boxBody(1, 5.3, 0, 10, 1)}, 2, open_box, Kinematics::Xfem, {2.0, 3.0});
  scene.setInteraction(0, 1, rubbing(coefficient));
  return scene;
}

struct Impulses
{
  double normal, tangential; // on block 1 by block 0: along x, along y
  ConstraintReport report;
};

Impulses impulses(TinyScene &scene)
{
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  Vector2 const f = report.pair_force[3 * 1].impulse;
  return {f[0], f[1], report};
}

/// v_b - v_a of the first row, along its normal.
double openingOf(ContactRows const &rows, View<double *[2]> const &velocity, BodyTable const &bodies)
{
  View<ContactRow *> const row = rows.row;
  View<double *> const opening("opening", 1);
  Kokkos::parallel_for(
      "openingOf", RangePolicy(0, 1),
      KOKKOS_LAMBDA(int) { opening(0) = dot(row(0).normal, relativeVelocity(row(0), velocity, bodies)); });
  return Harmos::onHost(opening)(0);
}

} // namespace

TEST(Friction, anImpulseStaysAtTheBoundThatItsGradientPressesItOn)
{
  ImpulseBounds const before = ImpulseBounds::ofFriction(2.0), wider = ImpulseBounds::ofFriction(3.0),
                      narrower = ImpulseBounds::ofFriction(1.0);
  EXPECT_EQ(wider.follow(before, 2.0, -1.0), 3.0);
  EXPECT_EQ(wider.follow(before, -2.0, 1.0), -3.0);
  EXPECT_EQ(wider.follow(before, 2.0, 1.0), 2.0);
  EXPECT_EQ(wider.follow(before, 0.5, -1.0), 0.5);
  EXPECT_EQ(narrower.follow(before, 1.5, 1.0), 1.0);
  EXPECT_EQ(narrower.follow(before, -2.0, -1.0), -1.0);
}

// Whatever the solver: blocks of masses 2 and 3 close by c times what p would change if both had 3.
TEST(Friction, rowsThatRub_giveWayByAMillionth)
{
  double const if_alike = (2.0 / 3.0) / (1.0 / 2.0 + 1.0 / 3.0);
  for (MultiplierMethod const solver :
       {MultiplierMethod::ProjectedNewton, MultiplierMethod::ConjugateGradients, MultiplierMethod::RowSums})
    for (double const friction : {0.0, 0.5})
    {
      TinyScene scene(rectilinearMesh(uniform(2, 2), uniform(1, 1)), {boxBody(0, 0, 0, 1, 1), boxBody(1, 1, 0, 2, 1)},
                      2, open_box, Kinematics::Xfem, {2.0, 3.0});
      scene.setInteraction(0, 1, friction > 0.0 ? rubbing(friction) : PairInteraction{});
      scene.options.solver = solver;
      scene.options.tolerance = 1e-12;
      scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? V : 0.0, 0.0}; });
      impulses(scene);
      BodyTable const none = buildBodyTable({}, 2);
      ContactRows const rows = findContactRows(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions,
                                               scene.conditions, none, scene.bonds, scene.options, *scene.exchange);
      ASSERT_EQ(rows.count, 1);
      double const left = openingOf(rows, scene.half, none);
      EXPECT_NEAR(left, friction > 0.0 ? -rubbing_compliance * if_alike * V : 0.0, 1e-3 * rubbing_compliance * V);
    }
}

// Slow shear: the nodes of the interface take one common tangential velocity, with less than the bound.
TEST(Friction, belowItsBound_sticks)
{
  TinyScene scene = rubbingBlocks(0.5);
  scene.setVelocity(
      [](int material, Vector2 const &) {
        return material == 0 ? Vector2{V, 0.1 * V} : Vector2{-V, 0.0};
      });
  Impulses const p = impulses(scene);
  EXPECT_GT(p.tangential, 0.0);
  EXPECT_LT(p.tangential, 0.5 * p.normal);
  // Equal masses act along both directions: the tangential impulse is to the normal one as the velocities.
  EXPECT_NEAR(p.tangential / p.normal, 0.1 * V / (2.0 * V), 1e-9);
}

TEST(Friction, atItsBound_opposesTheSlidingByTheCoefficient)
{
  for (double const sign : {1.0, -1.0})
    for (double const coefficient : {0.1, 0.5, 1.5})
    {
      TinyScene scene = rubbingBlocks(coefficient);
      scene.setVelocity(
          [sign](int material, Vector2 const &) {
            return material == 0 ? Vector2{V, sign * 10.0 * V} : Vector2{-V, 0.0};
          });
      Impulses const p = impulses(scene);
      EXPECT_NEAR(p.tangential, sign * coefficient * p.normal, 1e-9 * p.normal);
      EXPECT_GT(p.report.contact_loss, 0.0);
    }
}

TEST(Friction, ofAPartingPair_isExactlyZero)
{
  TinyScene scene = rubbingBlocks(0.5);
  scene.setVelocity([](int material, Vector2 const &) { return material == 0 ? Vector2{-V, V} : Vector2{V, 0.0}; });
  Impulses const p = impulses(scene);
  EXPECT_EQ(p.normal, 0.0);
  EXPECT_EQ(p.tangential, 0.0);
}

// Oblique interface, many rows, both solvers: Coulomb's law row by row through the sums, momentum exact.
TEST(Friction, bothSolvers_findTheSameImpulses)
{
  Vector2 const n{std::cos(0.4), std::sin(0.4)}, along = perpendicular(n), o{3.1, 2.9};
  double tangential[2];
  for (int solver = 0; solver < 2; ++solver)
  {
    TinyScene scene(
        rectilinearMesh(uniform(6, 6), uniform(6, 6)),
        {polygonBody(0, {o - 20 * along, o - 20 * along - 20 * n, o + 20 * along - 20 * n, o + 20 * along}),
         polygonBody(1, {o + 20 * along, o + 20 * along + 20 * n, o - 20 * along + 20 * n, o - 20 * along})},
        2, open_box);
    scene.options.tolerance = 1e-10;
    scene.options.max_iterations = 100000;
    scene.options.solver = solver == 0 ? MultiplierMethod::ConjugateGradients : MultiplierMethod::RowSums;
    scene.setInteraction(0, 1, rubbing(0.3));
    scene.setVelocity(
        [&](int material, Vector2 const &x)
        { return (material == 0 ? V : -V) * n + (material == 0 ? 0.9 * V * std::sin(x[0]) : 0.0) * along; });
    ConstraintReport const report = scene.constrain();
    EXPECT_TRUE(report.converged) << report.residual;
    auto const before = scene.sums(scene.predicted, -2), after = scene.sums(scene.half, -2);
    EXPECT_NEAR(norm(after.momentum - before.momentum), 0.0, 1e-13 * before.mass * V);
    EXPECT_LE(after.kinetic, before.kinetic);
    Vector2 const f = report.pair_force[3 * 1].impulse;
    EXPECT_LE(std::fabs(dot(f, along)), 0.3 * dot(f, n));
    tangential[solver] = dot(f, along);
    RecordProperty("iterations", report.iterations);
  }
  EXPECT_NEAR(tangential[0], tangential[1], 1e-6 * std::fabs(tangential[0]));
}

// A block slides along a contact wall: its rows rub with the wall's coefficient.
TEST(Friction, ofAContactWall_takesTheCoefficientTimesTheNormalImpulse)
{
  std::vector<BoundaryKind> kinds(4, BoundaryKind::Outflow);
  kinds[2] = BoundaryKind::ContactWall;
  TinyScene scene(rectilinearMesh(uniform(6, 6), uniform(4, 4)), {boxBody(0, 1, 0, 5, 2.5)}, 1, kinds);
  auto const boundary = Kokkos::create_mirror_view(scene.conditions.boundary);
  Kokkos::deep_copy(boundary, scene.conditions.boundary);
  boundary(2).friction = 0.25;
  Kokkos::deep_copy(scene.conditions.boundary, boundary);
  scene.setVelocity([](int, Vector2 const &) { return Vector2{10.0 * V, -V}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_GT(report.external_impulse[1], 0.0);
  EXPECT_NEAR(report.external_impulse[0], -0.25 * report.external_impulse[1], 1e-9 * report.external_impulse[1]);
}

// Two bonds of one interface: the broken one lets its rows slide and part, the whole one holds what is nearer to it.
TEST(Bonds, theNearestBond_decides)
{
  TinyScene scene(rectilinearMesh(uniform(2, 2), uniform(8, 8)), {boxBody(0, 0, 0, 0.7, 8), boxBody(1, 0.7, 0, 2, 8)},
                  2, open_box);
  scene.setInteraction(0, 1, {Interaction::Bonded, 0.0, 0.0, {1.0, 0.0}});
  scene.bonds = findBonds(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions, {}, scene.options,
                          *scene.exchange);
  ASSERT_EQ(scene.bonds.size(), 8u);
  for (Bond &bond : scene.bonds)
    bond.broken = bond.point[1] > 4.0;
  scene.setVelocity([](int material, Vector2 const &) { return material == 0 ? Vector2{-V, 0.0} : Vector2{V, 0.0}; });
  ConstraintReport const report = scene.constrain();
  EXPECT_EQ(report.rows, 8 + 4);
  for (std::size_t i = 0; i < scene.bonds.size(); ++i)
  {
    EXPECT_NEAR(report.bond_load[i].length, 1.0, 1e-12);
    if (scene.bonds[i].broken)
      EXPECT_EQ(report.bond_load[i].normal, 0.0);
    else
      EXPECT_LT(report.bond_load[i].normal, 0.0); // tension
  }
  EXPECT_EQ(breakBonds(report.bond_load, scene.options, scene.dt, scene.bonds), 4);
}

// On a grid line alternating multipliers move no inner node: the bonds carry the mean, and their sum is all there is.
TEST(Bonds, multipliersThatAlternate_loadThemAlike)
{
  TinyScene scene(rectilinearMesh(uniform(2, 2), uniform(8, 8)), {boxBody(0, 0, 0, 1, 8), boxBody(1, 1, 0, 2, 8)}, 2,
                  open_box);
  scene.setInteraction(0, 1, {Interaction::Bonded, 0.0, 0.0, {1.0, 1.0}});
  scene.bonds = findBonds(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions, {}, scene.options,
                          *scene.exchange);
  BodyTable const none = buildBodyTable({}, 2);
  ContactRows const rows = findContactRows(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions,
                                           none, scene.bonds, scene.options, *scene.exchange);
  ContactSystem const system =
      buildContactSystem(scene.mesh, scene.pairs, rows, scene.dof_nodes, scene.conditions, scene.dof_mass,
                         {scene.velocity_n, none}, {scene.predicted, none}, {}, scene.dt);
  View<double *[2]> const impulse("impulse", rows.count);
  auto const p = Kokkos::create_mirror_view(impulse);
  for (int i = 0; i < rows.count; ++i)
  {
    p(i, 0) = i % 2 == 0 ? -9.0 : 7.0; // of rows of length one: -1 in the mean
    p(i, 1) = i % 2 == 0 ? -3.0 : 7.0; // 2 in the mean
  }
  Kokkos::deep_copy(impulse, p);
  std::vector<BondLoad> load(scene.bonds.size());
  sumBondLoads(system, rows, impulse, *scene.exchange, load);
  ASSERT_EQ(load.size(), 8u);
  double sum = 0.0;
  for (std::size_t i = 0; i < load.size(); ++i)
  {
    sum += load[i].normal;
    if (scene.bonds[i].point[1] > 1.0 && scene.bonds[i].point[1] < 7.0)
    {
      EXPECT_NEAR(load[i].normal, -1.0, 1e-12);
      EXPECT_NEAR(load[i].tangential, 2.0, 1e-12);
    }
  }
  EXPECT_NEAR(sum, 4.0 * (7.0 - 9.0), 1e-12);
}

// A corner cell with a fifth of the interface has no patch of its own.
TEST(Bonds, ofCutOffSegments_areThoseOfTheirNeighbours)
{
  TinyScene scene(rectilinearMesh(uniform(2, 2), uniform(8, 8)),
                  {boxBody(0, 0, 0, 0.7, 5.2), boxBody(1, 0.7, 0, 2, 5.2)}, 2, open_box);
  scene.setInteraction(0, 1, {Interaction::Bonded, 0.0, 0.0, {1.0, 0.0}});
  scene.bonds = findBonds(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions, {}, scene.options,
                          *scene.exchange);
  EXPECT_EQ(scene.bonds.size(), 5u);
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? -V : V, 0.0}; });
  ConstraintReport const report = scene.constrain();
  double length = 0.0;
  for (BondLoad const &load : report.bond_load)
    length += load.length;
  EXPECT_NEAR(length, 5.2, 1e-12);
}

// What is bonded holds across the round-off of a remap, not across void.
TEST(Bonds, holdAcrossNoGapWiderThanATenthOfACell)
{
  for (double const gap : {0.0, 0.05, 0.2, 0.6})
  {
    TinyScene scene(rectilinearMesh(uniform(2, 2), uniform(1, 1)),
                    {boxBody(0, 0, 0, 0.7, 1), boxBody(1, 0.7 + gap, 0, 2, 1)}, 2, open_box);
    scene.setInteraction(0, 1, {Interaction::Bonded, 0.0, 0.0, {}});
    scene.setVelocity([](int material, Vector2 const &) { return Vector2{material == 0 ? -V : V, 0.0}; });
    ConstraintReport const report = scene.constrain();
    if (gap < 0.1)
      EXPECT_LT(report.pair_force[3 * 1].normal_impulse, 0.0) << gap;
    else
      EXPECT_EQ(report.pair_force[3 * 1].normal_impulse, 0.0) << gap;
  }
}

TEST(Bonds, breakWhereTheSumOfSquaresReachesOne)
{
  BondStrength const strength{3.0, 4.0};
  EXPECT_FALSE(breaks({-2.99, 0.0}, strength));
  EXPECT_TRUE(breaks({-3.01, 0.0}, strength));
  EXPECT_FALSE(breaks({99.0, 3.99}, strength)); // pressure does not count
  EXPECT_TRUE(breaks({0.0, -4.01}, strength));
  EXPECT_TRUE(breaks({-3.0 * 0.8, 4.0 * 0.61}, strength));
  EXPECT_FALSE(breaks({-3.0 * 0.8, 4.0 * 0.59}, strength));
  EXPECT_FALSE(breaks({-1e9, 0.0}, {0.0, 4.0})); // no limit in tension
}

// The impulse m V that stops a row of nodes, m = rho h / 2, whatever the step; then rho c V in each.
TEST(Bonds, carryTheMeanOverTheTimeInWhichAWavePassesACell)
{
  for (double const dt : {0.5, 0.1, 0.01})
  {
    Bond bond;
    bond.transit = 1.0; // h / c with h = c = 1
    double most = 0.0;
    carry({-0.5, 0.0, 2.0}, dt, bond); // over a length of 2: rho V = 1/2
    EXPECT_NEAR(bond.traction[0], -0.25, 1e-14);
    for (double t = dt; t < 10.0; t += dt)
    {
      carry({-0.5 * 2.0 * dt, 0.25 * 2.0 * dt, 2.0}, dt, bond);
      most = std::max(most, -bond.traction[0]);
    }
    EXPECT_NEAR(bond.traction[0], -0.5, 1e-4);
    EXPECT_NEAR(bond.traction[1], 0.25, 1e-4);
    EXPECT_LE(most, 0.5);
  }
  Bond unknown;
  carry({-3.0, 2.0, 2.0}, 0.5, unknown); // at once
  EXPECT_EQ(unknown.traction[0], -3.0);
  EXPECT_EQ(unknown.traction[1], 2.0);
  carry({}, 0.5, unknown);
  EXPECT_EQ(unknown.traction[0], 0.0);
}
