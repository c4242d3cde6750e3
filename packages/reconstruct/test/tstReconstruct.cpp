// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructScene.hpp"

#include <Harmos_FractionGradient.hpp>
#include <Harmos_LineCut.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

struct Result
{
  FilledRegions regions;
  ReconstructionReport report;
};

Result run(Scene const &scene, ReconstructionMethod method, double sliver = 1e-3, std::vector<int> const &order = {})
{
  ReconstructionOptions options;
  options.method = method;
  options.sliver = sliver;
  if (!order.empty())
    options.order = deviceCopy("order", order);
  Result result;
  result.regions = reconstruct(scene.mesh, scene.pairs, scene.state, options, result.report);
  return result;
}

Vector2 randomPoint(std::mt19937 &random, double size)
{
  std::uniform_real_distribution<double> uniform(0.3 * size, 0.7 * size);
  double const x = uniform(random);
  return {x, uniform(random)};
}

/// The largest misplaced volume over straight lines at many angles on shaken meshes; material 0 against material 1 or
/// against void.
double worstStraightLine(double sliver, bool with_void)
{
  std::mt19937 random(11);
  double worst = 0.0;
  for (int i = 0; i < 40; ++i)
  {
    Mesh const mesh = makeMesh(10, 10, 0.7, 0.25, 100 + i);
    Plane2 const line = halfPlane(9.7 * i + 1.0, randomPoint(random, 7.0));
    std::vector<Body> all{{line}};
    if (!with_void)
      all.push_back({opposite(line)});
    Scene const scene = paint(mesh, bodies(all));
    Result const result = run(scene, ReconstructionMethod::MomentOfFluid, sliver);
    EXPECT_EQ(result.report.failures, 0);
    EXPECT_GT(result.regions.num_mixed_cells, 5);
    worst = std::max(worst, misplacedVolume(scene, result.regions, all));
  }
  return worst;
}

/// By cell: Youngs' gradient of the first component, and the least-squares one.
View<double *[4]> bothGradients(ReconstructionField const &field)
{
  View<double *[4]> const gradient("gradient", field.mesh.num_cells);
  Kokkos::parallel_for(
      "gradients", RangePolicy(0, field.mesh.num_cells), KOKKOS_LAMBDA(int const cell) {
        CellComponents const components = cellComponents(field, cell, false);
        Vector2 const youngs = (1.0 / components.size) * youngsGradient(field, components, {1u, 0u});
        Vector2 const fitted = (1.0 / components.size) *
                               leastSquaresGradient(field, components, CellNeighbours(field, components), {1u, 0u});
        for (int d = 0; d < 2; ++d)
        {
          gradient(cell, d) = youngs[d];
          gradient(cell, 2 + d) = fitted[d];
        }
      });
  return gradient;
}

} // namespace

TEST(Reconstruct, straightLinesOnShakenQuads_momentOfFluidIsExact)
{
  double const two = worstStraightLine(0.0, false), one = worstStraightLine(0.0, true);
  std::printf("misplaced volume: %.1e two materials, %.1e with void\n", two, one);
  EXPECT_LT(two, 1e-12);
  EXPECT_LT(one, 1e-12);
}

TEST(Reconstruct, straightLinesOnShakenQuads_leastSquaresIsExact)
{
  double const two = worstStraightLine(1.0, false), one = worstStraightLine(1.0, true);
  std::printf("misplaced volume: %.1e two materials, %.1e with void\n", two, one);
  EXPECT_LT(two, 1e-12);
  EXPECT_LT(one, 1e-12);
}

TEST(Reconstruct, straightLinesWithDefaults_areExact)
{
  EXPECT_LT(worstStraightLine(1e-3, false), 1e-12);
  EXPECT_LT(worstStraightLine(1e-3, true), 1e-12);
}

//   \  void  /          Two materials and void meet at a T, turned by any angle: the half-plane 0, above it the
//    \ 1    /           quarter-plane 1, void in the rest. Only some orders of removal are exact.
//  ---T-------
//      0
TEST(Reconstruct, tJunctionOfTwoMaterialsAndVoid_isExact)
{
  std::mt19937 random(13);
  double worst = 0.0;
  for (double const angle : {0.0, 15.0, 30.0, 45.0, 75.0, 160.0, 200.0, 290.0})
    for (int i = 0; i < 20; ++i)
    {
      Mesh const mesh = makeMesh(6, 6, 0.5, i % 2 == 0 ? 0.0 : 0.2, 10 + i);
      Vector2 const corner = randomPoint(random, 3.0);
      Plane2 const base = halfPlane(angle + 90.0, corner);
      std::vector<Body> all{{base}, {opposite(base), halfPlane(angle, corner)}};
      if (i % 4 > 1) // then the exact order is not the ascending one
        std::swap(all[0], all[1]);
      Scene const scene = paint(mesh, bodies(all));
      Result const result = run(scene, ReconstructionMethod::MomentOfFluid, 0.0);
      double const misplaced = misplacedVolume(scene, result.regions, all);
      EXPECT_LT(misplaced, 1e-12) << "angle " << angle << " corner " << corner[0] << ' ' << corner[1];
      EXPECT_EQ(result.report.failures, 0);
      worst = std::max(worst, misplaced);
    }
  std::printf("misplaced volume %.1e\n", worst);
}

TEST(Reconstruct, fixedOrder_isExactWhenRightAndWrongWhenWrong)
{
  Mesh const mesh = makeMesh(5, 5, 1.0);
  Plane2 const base = halfPlane(105.0, {2.4, 2.6});
  std::vector<Body> const all{{base}, {opposite(base), halfPlane(15.0, {2.4, 2.6})}};
  Scene const scene = paint(mesh, bodies(all));
  auto const method = ReconstructionMethod::MomentOfFluid;
  EXPECT_LT(misplacedVolume(scene, run(scene, method, 0.0, {0, 1}).regions, all), 1e-12);
  EXPECT_LT(misplacedVolume(scene, run(scene, method, 0.0, {0, void_material, 1}).regions, all), 1e-12);
  EXPECT_GT(misplacedVolume(scene, run(scene, method, 0.0, {1, 0}).regions, all), 1e-3);
  EXPECT_GT(misplacedVolume(scene, run(scene, method, 0.0, {void_material}).regions, all), 1e-3);
}

// A block lifts off a floor by a thin wedge of void, and its centroid is off by as little as remaps leave it.
TEST(Reconstruct, floorWithTheMomentsOfItsShape_keepsItsFaceBelowAWedgeOfVoid)
{
  double misplaced[2] = {0.0, 0.0};
  for (int i = 0; i < 60; ++i)
  {
    std::mt19937 random(static_cast<unsigned>(i));
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Mesh const mesh = makeMesh(8, 8, 1.0);
    Vector2 const tip{4.2 + uniform(random), 4.3 + uniform(random)};
    double const angle = 60.0 + 5.0 * uniform(random);
    Plane2 const floor = halfPlane(angle, tip);
    Plane2 const base = opposite(halfPlane(angle + 1.0 + 0.8 * uniform(random), tip));
    CellFills const exact = bodies({{floor}, {opposite(floor), base}});
    CellFills const noisy = [&](int cell, Quadrilateral const &quad)
    {
      std::vector<Fill> fills = exact(cell, quad);
      if (fills.size() == 2)
        fills[1].centroid += 3e-3 * Vector2{uniform(random), uniform(random)};
      return fills;
    };
    Scene const scene = paint(mesh, noisy);
    for (int known = 0; known < 2; ++known)
    {
      ReconstructionOptions options;
      if (known == 1)
        options.exact = deviceCopy("exact", std::vector<int>{1, 0});
      ReconstructionReport report;
      FilledRegions const regions = reconstruct(scene.mesh, scene.pairs, scene.state, options, report);
      misplaced[known] = std::max(misplaced[known], misplacedVolume(scene, regions, {{floor}, {}}));
    }
  }
  std::printf("misplaced volume %.1e, with the floor known as exact %.1e\n", misplaced[0], misplaced[1]);
  EXPECT_GT(misplaced[0], 1e-3);
  EXPECT_LT(misplaced[1], 1e-6); // a sliver goes by least squares
}

// Two bodies with a thin void or a thin foil (material 0) between them: it has no gradient of its own, the bodies have.
TEST(Reconstruct, thinVoidOrFoilBetweenTwoBodies_liesBetweenThem)
{
  for (double const gap : {1e-3, 1e-4, 1e-6, 1e-9})
    for (double const angle : {0.0, 15.0, 30.0, 45.0, 70.0})
    {
      Mesh const mesh = makeMesh(8, 8, 1.0);
      Plane2 const line = halfPlane(angle, {4.2, 4.3});
      Plane2 const other{-line.normal, -line.offset - gap};
      for (bool const foil : {false, true})
      {
        std::vector<Body> all{{line}, {other}};
        if (foil)
          all = {{opposite(line), opposite(other)}, {line}, {other}};
        Scene const scene = paint(mesh, bodies(all));
        Result const result = run(scene, ReconstructionMethod::MomentOfFluid);
        EXPECT_EQ(result.report.failures, 0);
        EXPECT_LT(misplacedVolume(scene, result.regions, all), 1e-3 * gap) << "gap " << gap << " angle " << angle;
      }
    }
}

// What lets orders that begin with a sliver go untried (leastSliverPenalty).
TEST(Reconstruct, lineThatCutsASliverOffACell_hasAQuarterOfAVertexNeighbourBehindIt)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> turn(0.0, 2.0 * Math::pi), exponent(-12.0, -3.0);
  double least = 1.0;
  for (int i = 0; i < 4000; ++i)
  {
    Geometry const geometry = i % 2 == 0 ? Geometry::Planar : Geometry::Axisymmetric;
    Mesh const mesh =
        makeMesh(i % 4 < 2 ? 5 : 3, 5, 1.0, 0.25, 1 + i); // the inner cells of three columns are near r = 0
    int const columns = i % 4 < 2 ? 5 : 3, own = 2 * columns + columns / 2;
    auto const x = onHost(mesh.node_position);
    auto const node = onHost(mesh.cell_node);
    auto const volumeBehind = [&](int cell, Body const &behind)
    {
      Quadrilateral const quad = hostQuadrilateral(x, node, cell);
      return moments<1>(intersection(quad, behind), quad[0], areaWeight(geometry, quad[0])).volume() /
             volume(quad, geometry);
    };
    Quadrilateral const quad = hostQuadrilateral(x, node, own);
    Region polygon;
    for (int k = 0; k < 4; ++k)
      polygon.push(quad[k]);
    double const angle = turn(random);
    Vector2 const normal{std::cos(angle), std::sin(angle)};
    double const part = std::pow(10.0, exponent(random));
    LineCut const cut = lineCut(polygon, normal, part * volume(quad, geometry), areaWeight(geometry, {0.0, 0.0}));
    double most = 0.0;
    for (int row = -1; row <= 1; ++row)
      for (int column = -1; column <= 1; ++column)
        if (row != 0 || column != 0)
          most = std::max(most, volumeBehind(own + row * columns + column, {Plane2{normal, dot(normal, cut.begin)}}));
    least = std::min(least, most);
  }
  EXPECT_GT(least, 0.25);
  std::printf("least part of the fullest neighbour %.2f\n", least);
}

TEST(Reconstruct, stripOfCells_everyMethodFindsTheUprightInterface)
{
  for (double const fraction : {1e-12, 1e-6, 0.01, 0.5, 0.99, 1.0 - 1e-6})
  {
    Mesh const mesh = makeMesh(7, 1, 1.0);
    Plane2 const line = halfPlane(0.0, {3.0 + fraction, 0.0});
    for (bool const with_void : {false, true})
    {
      std::vector<Body> all{{line}};
      if (!with_void)
        all.push_back({opposite(line)});
      Scene const scene = paint(mesh, bodies(all));
      for (double const sliver : {0.0, 1e-3, 1.0})
        EXPECT_LT(misplacedVolume(scene, run(scene, ReconstructionMethod::MomentOfFluid, sliver).regions, all), 1e-14);
      EXPECT_LT(misplacedVolume(scene, run(scene, ReconstructionMethod::Youngs).regions, all), 1e-14);
    }
  }
}

TEST(Reconstruct, bothGradients_areExactForLinearFractionsOnShakenQuads)
{
  Mesh const mesh = makeMesh(7, 7, 0.5, 0.2);
  Scene const scene = paint(mesh,
                            [](int, Quadrilateral const &quad)
                            {
                              Vector2 const x = quadrilateralCentroid(quad);
                              return std::vector<Fill>{{0, (0.2 + 0.1 * x[0] + 0.05 * x[1]) * area(quad), x}};
                            });
  ReconstructionField const field{scene.mesh, scene.pairs, scene.state.record, scene.state.centroid};
  auto const host = onHost(bothGradients(field));
  for (int cell = 0; cell < mesh.num_cells; ++cell)
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(host(cell, i), i % 2 == 0 ? 0.1 : 0.05, 1e-13) << "cell " << cell;
}

TEST(Reconstruct, youngsOnSquares_keepsInterfacesAlongTheGridAndDiagonal)
{
  Mesh const mesh = makeMesh(9, 9, 1.0);
  for (double const angle : {0.0, 90.0, 180.0, 270.0})
  {
    std::vector<Body> const all{{halfPlane(angle, {4.3, 4.6})}, {opposite(halfPlane(angle, {4.3, 4.6}))}};
    Scene const scene = paint(mesh, bodies(all));
    Result const result = run(scene, ReconstructionMethod::Youngs);
    EXPECT_LT(misplacedVolume(scene, result.regions, all), 1e-13);
    EXPECT_EQ(result.report.failures, 0);
  }
}

// Six layers and void: seven components in the middle cell, so greedily.
TEST(Reconstruct, sevenParallelLayersInOneCell_areExactAndCountedAsGreedy)
{
  Mesh const mesh = makeMesh(3, 3, 1.0, 0.1);
  std::vector<Body> all;
  double const width = 0.12;
  for (int m = 0; m < 6; ++m)
  {
    Plane2 below = halfPlane(90.0, {0.0, 1.15 + width * m});
    Plane2 const above = halfPlane(90.0, {0.0, 1.15 + width * (m + 1)});
    all.push_back(m == 0 ? Body{above} : Body{above, opposite(below)});
  }
  Scene const scene = paint(mesh, bodies(all));
  Result const result = run(scene, ReconstructionMethod::MomentOfFluid, 0.0);
  EXPECT_GE(result.report.greedy_cells, 1);
  EXPECT_EQ(result.report.failures, 0);
  EXPECT_LT(misplacedVolume(scene, result.regions, all), 1e-12);
}

TEST(Reconstruct, moreThanTwelveComponents_areReportedWithTheCell)
{
  Mesh const mesh = makeMesh(3, 3, 1.0);
  Scene const scene = paint(mesh,
                            [](int cell, Quadrilateral const &quad)
                            {
                              std::vector<Fill> fills;
                              for (int m = 0; m < (cell == 4 ? 12 : 1); ++m)
                                fills.push_back({m, (cell == 4 ? 0.05 : 1.0) * area(quad), {1.0 + 0.05 * m, 1.5}});
                              return fills;
                            });
  Result const result = run(scene, ReconstructionMethod::MomentOfFluid);
  EXPECT_EQ(result.report.failures, 1);
  EXPECT_EQ(result.report.first_failed_cell, 4);
}
