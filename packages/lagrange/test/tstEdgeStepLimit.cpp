// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <Harmos_Clip.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

constexpr double no_viscosity = 0.0;
constexpr double allowed = 1.005; // of the square of what stays at its place

/// What of a unit cell lies on the inner side of lines.
Region partOfCell(int i, int j, std::vector<Plane2> const &lines)
{
  double const x = i, y = j;
  Region r;
  for (Vector2 const &v : {Vector2{x, y}, Vector2{x + 1.0, y}, Vector2{x + 1.0, y + 1.0}, Vector2{x, y + 1.0}})
    r.push(v);
  for (Plane2 const &line : lines)
  {
    Region kept;
    clip(r, line, kept);
    r = kept;
  }
  return r;
}

/// A convex body (material 0) in n x n unit cells, void or material 1 around it, stress over what it fills.
struct CutBody
{
  Scene s;
  FilledRegions regions;

  CutBody(int n, std::vector<Plane2> const &lines, Material const &material, double linear_viscosity = no_viscosity,
          Geometry geometry = Geometry::Planar,
          std::vector<BoundaryKind> const &kinds = std::vector<BoundaryKind>(4, BoundaryKind::Outflow))
  {
    auto const fraction = [&](int i, int j)
    {
      Region const r = partOfCell(i, j, lines);
      double const part = r.size < 3 ? 0.0 : area(r);
      return part > 1.0 - 1e-9 ? 1.0 : part;
    };
    s = makeScene(
        n, n, 0.0, {material},
        [&](int i, int j) {
          return fraction(i, j) > 1e-9 ? std::vector<Fill>{{0, fraction(i, j)}} : std::vector<Fill>{};
        },
        Kinematics::Xfem, kinds, geometry);
    s.options.cut_cell_stress = CutCellStress::FilledRegions;
    s.options.linear_viscosity = linear_viscosity;
    s.options.quadratic_viscosity = s.options.hourglass_viscosity = 0.0;
    std::vector<int> mixed, first(n * n, -1);
    std::vector<Region> polygon;
    for (int c = 0; c < n * n; ++c)
    {
      double const part = fraction(c % n, c / n);
      if (part <= 1e-9 || part == 1.0)
        continue;
      mixed.push_back(c);
      first[c] = static_cast<int>(polygon.size());
      polygon.push_back(partOfCell(c % n, c / n, lines));
    }
    regions.num_mixed_cells = static_cast<int>(mixed.size());
    regions.mixed_cell = deviceCopy("mixed_cell", mixed);
    regions.cell_region = deviceCopy("cell_region", first);
    regions.polygon = deviceCopy("polygon", polygon);
    computeCutGradients(s.mesh, s.pairs, s.state.record, regions, s.materials, s.boundary, s.options.cut_cell_stress,
                        s.options.shortest_bent_edge, s.work.cut);
  }

  TimeStepLimit limit(double dt = 10.0)
  {
    return edgeStepLimit(s.mesh, s.pairs, s.dof_nodes, s.state, regions, s.boundary, s.materials, s.options, dt,
                         s.work);
  }

  /// Energy of the pairs of the cells from column `first` on.
  void heat(int n, int first, double energy)
  {
    auto const record = onHost(s.state.record);
    auto const cell = onHost(s.pairs.cell);
    for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
      if (cell(pair) % n >= first)
        record(pair, InternalEnergy) = energy;
    Kokkos::deep_copy(s.state.record, record);
  }

  /// 2 / omega of the largest frequency, by power iteration with the kernels' own strains and forces.
  double stableStep()
  {
    constexpr double small = 1e-7;
    View<double *[num_pair_fields]> const rest("rest", s.pairs.num_pairs);
    Kokkos::deep_copy(rest, s.state.record);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-small, small);
    std::vector<Vector2> u(s.dof_nodes.num_dof_nodes);
    for (Vector2 &v : u)
      v = {unit(random), unit(random)};
    double omega_squared = 0.0;
    for (int turn = 0; turn < 400; ++turn)
    {
      s.setVelocity([&](int dof, Vector2) { return u[dof]; });
      Kokkos::deep_copy(s.state.record, rest);
      Kokkos::deep_copy(s.work.corner_force, 0.0);
      Kokkos::deep_copy(s.work.half, s.state.velocity);
      TimeStepLimit unused;
      s.update(1.0, unused);
      s.setVelocity([](int, Vector2) { return Vector2{0.0, 0.0}; });
      s.predict(1.0);
      auto const a = onHost(s.work.predicted);
      double before = 0.0, after = 0.0;
      for (std::size_t dof = 0; dof < u.size(); ++dof)
      {
        before += dot(u[dof], u[dof]);
        u[dof] = {-a(dof, 0), -a(dof, 1)};
        after += dot(u[dof], u[dof]);
      }
      omega_squared = std::sqrt(after / before);
      for (Vector2 &v : u)
        v = (small / std::sqrt(after)) * v;
    }
    Kokkos::deep_copy(s.state.record, rest);
    return 2.0 / std::sqrt(omega_squared);
  }
};

double speedOf(Material const &m)
{
  return std::sqrt(m.sound_speed0 * m.sound_speed0 + 4.0 / 3.0 * m.shear_modulus / m.density0);
}

std::vector<Plane2> squareOf(Vector2 centre, double side, double angle)
{
  std::vector<Plane2> lines;
  for (int k = 0; k < 4; ++k)
  {
    double const a = angle + 0.5 * k * std::acos(-1.0);
    Vector2 const n{std::cos(a), std::sin(a)};
    lines.push_back({n, dot(n, centre) + 0.5 * side});
  }
  return lines;
}

std::vector<Plane2> rectangle(Vector2 low, Vector2 high)
{
  return {{{-1.0, 0.0}, -low[0]}, {{1.0, 0.0}, high[0]}, {{0.0, -1.0}, -low[1]}, {{0.0, 1.0}, high[1]}};
}

std::vector<BoundaryKind> axisOnTheLeft()
{
  return {BoundaryKind::SlipWall, BoundaryKind::Outflow, BoundaryKind::Outflow, BoundaryKind::Outflow};
}

} // namespace

TEST(EdgeStepLimit, TriangleOfFluidAlone_hasItsExactStepButForTheMargin)
{
  // Straight edges: gradients (-1, -1), (1, 0), (0, 0), (0, 1) of the corners, a quarter of the mass at each of them:
  // omega^2 = 4 c^2 sum_I |B_I|^2 = 16 c^2.
  double const root = std::sqrt(0.5), c = speedOf(fluid());
  CutBody body(3, {{{-1.0, 0.0}, -1.0}, {{0.0, -1.0}, -1.0}, {{root, root}, root * 3.0}}, fluid());
  EXPECT_NEAR(body.stableStep(), 0.5 / c, 1e-6);
  EXPECT_NEAR(body.limit().dt, 0.5 / c / std::sqrt(allowed), 1e-7);
  EXPECT_EQ(body.limit().cell, 4);
  EXPECT_EQ(body.limit().material, 0);
}

TEST(EdgeStepLimit, Viscosity_entersAsInPureCells)
{
  double const root = std::sqrt(0.5);
  CutBody body(3, {{{-1.0, 0.0}, -1.0}, {{0.0, -1.0}, -1.0}, {{root, root}, root * 3.0}}, fluid(), 0.06);
  double const c = speedOf(fluid()), lambda = 4.0 * allowed, q = 0.06 * c * lambda;
  EXPECT_NEAR(body.limit().dt, 1.0 / (q + std::sqrt(q * q + c * c * lambda)), 1e-7);
}

TEST(EdgeStepLimit, ObliqueBodies_areNearWhatTheirLargestFrequencyAllows)
{
  for (Material const &material : {fluid(), elastic()})
    for (double const angle : {0.0, 0.2, 0.7})
      for (double const side : {0.9, 2.3, 5.0})
      {
        CutBody body(8, squareOf({4.13, 3.9}, side, angle), material);
        double const limit = body.limit().dt, stable = body.stableStep();
        EXPECT_GE(stable, 0.999 * limit) << "angle " << angle << ", side " << side;
        EXPECT_LE(stable, 1.01 * limit) << "angle " << angle << ", side " << side;
      }
}

TEST(EdgeStepLimit, ColdGasBesideHot_asksForNoShorterStepThanHotGasAlone)
{
  Material gas = fluid();
  gas.eos = EosKind::IdealGas;
  gas.gruneisen = 1.4; // gamma
  for (double const angle : {0.0, 0.2, 0.7})
    for (double const side : {2.3, 5.0})
    {
      auto const limitWithHotFrom = [&](int column)
      {
        CutBody body(8, squareOf({4.13, 3.9}, side, angle), gas, 0.06);
        body.heat(8, 0, 1.0);
        body.heat(8, column, 400.0); // twenty times the speed of sound
        return body.limit().dt;
      };
      double const hot = limitWithHotFrom(0), cold = limitWithHotFrom(8);
      EXPECT_NEAR(cold, 20.0 * hot, 1e-9 * cold);
      for (int column = 3; column < 6; ++column)
        EXPECT_GE(limitWithHotFrom(column), 0.999 * hot) << angle << ' ' << side << ' ' << column;
    }
}

TEST(EdgeStepLimit, SliverAlongAFaceOfABody_leavesTheStepOfFullCells)
{
  for (double const sliver : {1e-2, 1e-4})
  {
    CutBody body(8, {{{1.0, 0.0}, 4.0 + sliver}}, elastic(), no_viscosity, Geometry::Planar,
                 std::vector<BoundaryKind>(4, BoundaryKind::SlipWall));
    EXPECT_GT(body.limit().dt * speedOf(elastic()), 0.95);
  }
}

TEST(EdgeStepLimit, CellMeans_askForNothing)
{
  CutBody body(8, squareOf({4.13, 3.9}, 5.0, 0.7), elastic());
  body.s.options.cut_cell_stress = CutCellStress::Fluids;
  EXPECT_EQ(body.limit().dt, std::numeric_limits<double>::infinity());
  EXPECT_EQ(body.limit().cell, -1);
}

TEST(EdgeStepLimit, PartOfACellBetweenSlipWalls_isABarOfOneDimension)
{
  CutBody bar(1, {{{1.0, 0.0}, 0.5}}, elastic(), no_viscosity, Geometry::Planar,
              {BoundaryKind::Outflow, BoundaryKind::Outflow, BoundaryKind::SlipWall, BoundaryKind::SlipWall});
  EXPECT_EQ(bar.limit(0.99 / speedOf(elastic())).cell, -1);
  CutBody free(1, {{{1.0, 0.0}, 0.5}}, elastic());
  EXPECT_EQ(free.limit(0.99 / speedOf(elastic())).cell, 0);
}

TEST(EdgeStepLimit, WholeCellOfFluidAlone_hasItsExactStepButForTheMargin)
{
  CutBody body(3, rectangle({1.0, 1.0}, {2.0, 2.0}), fluid());
  double const c = speedOf(fluid());
  EXPECT_EQ(body.limit().cell, -1); // the options' Courant number is below what any whole cell asks for
  body.s.options.courant = 0.9;
  EXPECT_NEAR(body.stableStep(), std::sqrt(0.5) / c, 1e-6);
  EXPECT_NEAR(body.limit().dt, std::sqrt(0.5 / allowed) / c, 1e-7);
  EXPECT_EQ(body.limit().cell, 4);
  EXPECT_EQ(body.limit(0.68 / c).cell, -1);
}

TEST(EdgeStepLimit, WholeCellsAtFreeEdges_areNearWhatTheirLargestFrequencyAllows)
{
  for (Material const &material : {fluid(), elastic()})
    for (Vector2 const size :
         {Vector2{1.0, 1.0}, Vector2{1.0, 5.0}, Vector2{2.0, 2.0}, Vector2{2.0, 5.0}, Vector2{4.0, 5.0}})
    {
      CutBody body(8, rectangle({1.0, 1.0}, Vector2{1.0, 1.0} + size), material);
      body.s.options.courant = 0.9;
      double const limit = body.limit().dt, stable = body.stableStep();
      EXPECT_GE(stable, 0.999 * limit) << size[0] << " x " << size[1];
      EXPECT_LE(stable, 1.01 * limit) << size[0] << " x " << size[1];
    }
}

TEST(EdgeStepLimit, WholeCellsAboutAnAxis_feelTheHoop)
{
  for (Material const &material : {fluid(), elastic()})
    for (double const inner : {0.0, 1.0, 4.0})
      for (Vector2 const size : {Vector2{1.0, 1.0}, Vector2{2.0, 1.0}, Vector2{1.0, 4.0}, Vector2{3.0, 3.0}})
      {
        CutBody body(8, rectangle({inner, 1.0}, Vector2{inner, 1.0} + size), material, no_viscosity,
                     Geometry::Axisymmetric, axisOnTheLeft());
        body.s.options.courant = 0.9;
        double const limit = body.limit().dt, stable = body.stableStep();
        EXPECT_GE(stable, 0.999 * limit) << inner << ": " << size[0] << " x " << size[1];
        EXPECT_LE(stable, 1.01 * limit) << inner << ": " << size[0] << " x " << size[1];
      }
}

TEST(EdgeStepLimit, BodiesThatFillTheMesh_areFreeAtItsSides)
{
  for (Material const &material : {fluid(), elastic()})
    for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
      for (int const n : {1, 2, 5})
      {
        CutBody body(n, {}, material, no_viscosity, geometry,
                     geometry == Geometry::Planar ? std::vector<BoundaryKind>(4, BoundaryKind::Outflow)
                                                  : axisOnTheLeft());
        body.s.options.courant = 0.9;
        double const limit = body.limit().dt, stable = body.stableStep();
        EXPECT_GE(stable, 0.999 * limit) << n;
        EXPECT_LE(stable, 1.01 * limit) << n;
      }
}

TEST(EdgeStepLimit, EndOfABarBetweenSlipWalls_asksForNothing)
{
  CutBody bar(2, rectangle({0.0, 0.0}, {1.0, 2.0}), fluid(), no_viscosity, Geometry::Planar,
              {BoundaryKind::Outflow, BoundaryKind::Outflow, BoundaryKind::SlipWall, BoundaryKind::SlipWall});
  bar.s.options.courant = 0.99;
  EXPECT_GT(bar.limit(0.99 / speedOf(fluid())).dt, 0.95 / speedOf(fluid()));
}
