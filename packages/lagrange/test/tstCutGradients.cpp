// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <Harmos_AreaWeight.hpp>
#include <Harmos_Bilinear.hpp>
#include <detail/Harmos_RingQuadrature.hpp>

#include <numeric>

using namespace Harmos;

namespace
{

/// The cell [2, 2.4] x [1, 1.3] and regions in it, each a material of its own.
struct CutCell
{
  Mesh mesh;
  Quadrilateral corners;
  CellMaterialPairs pairs;
  FilledRegions regions;
  CutGradients cut;

  CutCell(Geometry geometry, std::vector<Region> const &parts, Material const &material = Material(),
          CutCellStress where = CutCellStress::FilledRegions, double compression = 1.0, double plastic_strain = 0.0,
          double drift = 0.0, BoundaryConditions const &boundary = {})
  {
    mesh = buildMesh(rectilinearMesh({2.0, 2.4}, {1.0, 1.3}));
    setGeometry(mesh, geometry);
    auto const x = Harmos::onHost(mesh.node_position);
    auto const node = Harmos::onHost(mesh.cell_node);
    for (int k = 0; k < 4; ++k)
      corners.push({x(node(0, k), 0), x(node(0, k), 1)});
    pairs.offset = deviceCopy("offset", std::vector<int>{0, static_cast<int>(parts.size())});
    regions.num_mixed_cells = 1;
    regions.mixed_cell = deviceCopy("mixed_cell", std::vector<int>{0});
    regions.cell_region = deviceCopy("cell_region", std::vector<int>{0});
    regions.polygon = deviceCopy("polygon", parts);
    std::vector<int> number(parts.size());
    std::iota(number.begin(), number.end(), 0);
    pairs.material = deviceCopy("material", number);
    View<double *[num_pair_fields]> const record("record", parts.size());
    auto const r = Kokkos::create_mirror_view(record);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      r(i, SpecificVolume) = 1.0 / (compression * material.density0);
      r(i, PlasticStrain) = plastic_strain;
      r(i, Mass) = volume(parts[i], geometry) / ((1.0 + drift) * r(i, SpecificVolume));
    }
    Kokkos::deep_copy(record, r);
    computeCutGradients(mesh, pairs, record, regions,
                        deviceCopy("materials", std::vector<Material>(parts.size(), material)), boundary, where,
                        LagrangeOptions().shortest_bent_edge, cut);
  }

  /// What the stress over a region does to a corner, per stress: its volume times the whole gradient, with the hoop's
  /// part for d = 0 about an axis.
  double force(Region const &region, int row, int corner, int d) const
  {
    auto const g = Harmos::onHost(cut.gradient);
    detail::Corners<double> c;
    for (int k = 0; k < 4; ++k)
    {
      c.x[k] = corners[k][0];
      c.y[k] = corners[k][1];
    }
    double mean;
    if (mesh.geometry == Geometry::Axisymmetric)
    {
      auto const b = detail::ringGradient(c);
      mean = (d == 0 ? b.x[corner] + b.hoop[corner] : b.y[corner]) / b.volume;
    }
    else
    {
      auto const b = detail::meanGradient(c);
      double const x[4] = {b.x0, b.x1, -b.x0, -b.x1}, y[4] = {b.y0, b.y1, -b.y0, -b.y1};
      mean = (d == 0 ? x[corner] : y[corner]) / b.area;
    }
    double const more = g(row, 3 * corner + d) + (d == 0 ? g(row, 3 * corner + CutHoop) : 0.0);
    return volume(region, mesh.geometry) * (mean + more);
  }
};

/// Volume of a region of the cell when one corner moves by u in direction d; edges inside the cell bend in the middle.
double movedVolume(CutCell const &cell, Region const &region, int corner, int d, double u, bool bent)
{
  Region moved;
  for (int i = 0; i < region.size; ++i)
    for (double const t : {0.0, 0.5})
    {
      Vector2 x = (1.0 - t) * region[i] + t * region[region.next(i)];
      double N[4];
      shapeFunctionsAt(cell.corners, x, N);
      if (t > 0.0 && !(bent && std::min({N[0], N[1], N[2], N[3]}) > 1e-12))
        continue;
      x[d] += N[corner] * u;
      moved.push(x);
    }
  return volume(moved, cell.mesh.geometry);
}

Region polygon(std::vector<Vector2> const &vertices)
{
  Region r;
  for (Vector2 const &v : vertices)
    r.push(v);
  return r;
}

Material elasticSolid()
{
  Material solid;
  solid.strength = StrengthKind::Elastic;
  solid.density0 = 2700.0;
  return solid;
}

/// A corner of the cell of 0.01 of its area, half of least_whole_part.
Region tipOfACell()
{
  return polygon({{2.4, 1.0}, {2.4, 1.06}, {2.36, 1.0}});
}

auto gradientsOf(std::vector<Region> const &parts, Material const &material, CutCellStress where,
                 double compression = 1.0, double plastic_strain = 0.0, double drift = 0.0,
                 Geometry geometry = Geometry::Planar)
{
  return Harmos::onHost(CutCell(geometry, parts, material, where, compression, plastic_strain, drift).cut.gradient);
}

} // namespace

TEST(CutGradients, areTheDerivativesOfTheMovedRegionsVolume)
{
  // Work of a pressure is the pressure times the change of the volume that the moved region has in the remap: alone in
  // a cell with void, and two that fill it. Central differences are exact for areas, and to u^2 for rings.
  Region const left = polygon({{2.0, 1.0}, {2.31, 1.0}, {2.13, 1.3}, {2.0, 1.3}}),
               right = polygon({{2.31, 1.0}, {2.4, 1.0}, {2.4, 1.3}, {2.13, 1.3}}),
               tip = polygon({{2.4, 1.22}, {2.4, 1.3}, {2.27, 1.3}}),
               five = polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.17}, {2.29, 1.3}, {2.0, 1.3}});
  constexpr double u = 1e-4;
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (std::vector<Region> const &parts : std::vector<std::vector<Region>>{{left}, {tip}, {five}, {left, right}})
    {
      CutCell const cell(geometry, parts);
      for (std::size_t part = 0; part < parts.size(); ++part)
        for (int corner = 0; corner < 4; ++corner)
          for (int d = 0; d < 2; ++d)
          {
            auto const moved = [&](double by)
            { return movedVolume(cell, parts[part], corner, d, by, parts.size() > 1); };
            EXPECT_NEAR(cell.force(parts[part], static_cast<int>(part), corner, d), (moved(u) - moved(-u)) / (2.0 * u),
                        1e-9);
          }
    }
}

TEST(CutGradients, ofPartsThatFillACellAddUpToItsMean)
{
  Region const left = polygon({{2.0, 1.0}, {2.31, 1.0}, {2.13, 1.3}, {2.0, 1.3}}),
               right = polygon({{2.31, 1.0}, {2.4, 1.0}, {2.4, 1.3}, {2.13, 1.3}});
  auto const g = gradientsOf({left, right}, Material(), CutCellStress::FilledRegions);
  for (int k = 0; k < 12; ++k)
    EXPECT_NEAR(area(left) * g(0, k) + area(right) * g(1, k), 0.0, 1e-15);
}

TEST(CutGradients, ofSolidsFollowTheFullnessOfTheirCell)
{
  // Lower and upper part of the cell [2, 2.4] x [1, 1.3] with void above y = top: full at 1.3, half full at 0.5% of
  // void.
  Region const lower = polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.1}, {2.0, 1.1}});
  Material const solid = elasticSolid();
  for (double const open : {0.0, 0.005, 0.02})
  {
    double const top = 1.3 - 0.3 * open;
    Region const upper = polygon({{2.0, 1.1}, {2.4, 1.1}, {2.4, top}, {2.0, top}});
    auto const all = gradientsOf({lower, upper}, solid, CutCellStress::FilledRegions);
    auto const full = gradientsOf({lower, upper}, solid, CutCellStress::FullCells);
    auto const fluid = gradientsOf({lower, upper}, Material(), CutCellStress::FullCells);
    double const share = open == 0.0 ? 1.0 : open == 0.005 ? 0.5 : 0.0;
    for (int region = 0; region < 2; ++region)
      for (int k = 0; k < 12; ++k)
      {
        EXPECT_NEAR(full(region, k), share * all(region, k), 1e-11);
        EXPECT_NEAR(fluid(region, k), all(region, k), 1e-11); // edges along the cell are straight, bent or not
      }
    EXPECT_GT(std::fabs(all(0, CutGradientX)), 0.1); // the parts do have gradients of their own
  }
}

TEST(CutGradients, ofFluidsAloneBendTheirEdgesUntilATenthOfTheCellIsVoid)
{
  // Beyond x = right of the cell [2, 2.4] x [1, 1.3] lies void: none, 5% and 10% of the cell; a solid's edges are
  // straight from 1% on.
  Region const left = polygon({{2.0, 1.0}, {2.31, 1.0}, {2.13, 1.3}, {2.0, 1.3}});
  auto const gradients = [&](Material const &material, double open)
  {
    double const right = 2.4 - 0.4 * open;
    Region const rest = polygon({{2.31, 1.0}, {right, 1.0}, {right, 1.3}, {2.13, 1.3}});
    return gradientsOf({left, rest}, material, CutCellStress::FilledRegions);
  };
  auto const bent = gradients(Material(), 0.0), half = gradients(Material(), 0.05),
             straight = gradients(Material(), 0.1), solid = gradients(elasticSolid(), 0.05),
             alone = gradientsOf({left}, Material(), CutCellStress::FilledRegions);
  for (int k = 0; k < 12; ++k)
  {
    EXPECT_NEAR(straight(0, k), alone(0, k), 1e-11);
    EXPECT_NEAR(half(0, k), 0.5 * (bent(0, k) + straight(0, k)), 1e-11);
    EXPECT_NEAR(solid(0, k), straight(0, k), 1e-11);
  }
  EXPECT_GT(std::fabs(bent(0, CutGradientX) - straight(0, CutGradientX)), 0.1);
}

TEST(CutGradients, ofWornTipsGoBackToTheMean)
{
  Region const tip = tipOfACell(), rest = polygon({{2.0, 1.0}, {2.36, 1.0}, {2.4, 1.06}, {2.4, 1.3}, {2.0, 1.3}});
  Material const solid = elasticSolid();
  auto const all = gradientsOf({rest, tip}, solid, CutCellStress::FilledRegions);
  struct
  {
    double compression, plastic_strain, share; // share: of the tip's own gradient
  } const cases[] = {{1.0, 0.0, 1.0},        {1.0, 0.04, 1.0}, {1.0 / 0.96, 0.0, 1.0}, {1.0, 0.07, 0.8},
                     {1.0 / 1.09, 0.0, 0.6}, {1.0, 0.3, 0.5},  {0.5, 0.0, 0.5}};
  for (auto const &c : cases)
  {
    auto const g = gradientsOf({rest, tip}, solid, CutCellStress::FullCells, c.compression, c.plastic_strain);
    for (int k = 0; k < 12; ++k)
    {
      EXPECT_NEAR(g(0, k), all(0, k), 1e-9) << c.compression << " " << c.plastic_strain;
      EXPECT_NEAR(g(1, k), c.share * all(1, k), 1e-9) << c.compression << " " << c.plastic_strain;
    }
  }
}

TEST(CutGradients, ofTipsBesideVoidGoBackToTheMean)
{
  // Void above y = top: none, 2e-4 and 2e-3 of the cell.
  Region const tip = tipOfACell();
  Material const solid = elasticSolid();
  struct
  {
    double open, share; // share: of the tip's own gradient, with the cell's fullness
  } const cases[] = {{0.0, 1.0}, {2e-4, 0.98 * 0.8}, {2e-3, 0.8 * 0.5}};
  for (auto const &c : cases)
  {
    double const top = 1.3 - 0.3 * c.open;
    Region const rest = polygon({{2.0, 1.0}, {2.36, 1.0}, {2.4, 1.06}, {2.4, top}, {2.0, top}});
    auto const all = gradientsOf({rest, tip}, solid, CutCellStress::FilledRegions);
    auto const g = gradientsOf({rest, tip}, solid, CutCellStress::FullCells);
    double const bends = std::fabs(all(1, CutGradientX));
    EXPECT_NEAR(g(1, CutGradientX), c.share * all(1, CutGradientX), 1e-6 * bends) << c.open;
  }
}

TEST(CutGradients, ofALoneSolidAreNothingBeyondTheMeanInFullCells)
{
  for (double const drift : {0.0, 0.02})
  {
    auto const g = gradientsOf({polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.3}, {2.01, 1.3}})}, elasticSolid(),
                               CutCellStress::FullCells, 1.0, 0.0, drift);
    for (int k = 0; k < 12; ++k)
      EXPECT_EQ(g(0, k), 0.0);
  }
}

TEST(CutGradients, ofAnIntactSolidBesideVoidWhoseVolumesHaveDriftedApartAreItsRegions)
{
  Material const solid = elasticSolid();
  std::vector<Region> const most = {polygon({{2.0, 1.1}, {2.4, 1.1}, {2.4, 1.2}, {2.01, 1.3}}),
                                    polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.1}, {2.0, 1.1}})};
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
  {
    auto const all = gradientsOf(most, solid, CutCellStress::FilledRegions, 1.0, 0.0, 0.0, geometry);
    struct
    {
      double drift, plastic_strain, share; // share: of the region's own gradient
    } const cases[] = {{0.002, 0.0, 0.0},  {0.0065, 0.0, 0.5}, {0.02, 0.0, 1.0}, {-0.0065, 0.0, 0.5},
                       {-0.02, 0.04, 1.0}, {0.02, 0.1, 0.5},   {0.02, 0.2, 0.0}};
    for (auto const &c : cases)
    {
      auto const g = gradientsOf(most, solid, CutCellStress::FullCells, 1.0, c.plastic_strain, c.drift, geometry);
      for (int k = 0; k < 12; ++k)
        EXPECT_NEAR(g(0, k), c.share * all(0, k), 1e-9) << c.drift << " " << c.plastic_strain;
    }
  }
}

TEST(CutGradients, ofAWholeCellAreNothingBeyondItsMean)
{
  Region const whole = polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.3}, {2.0, 1.3}});
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
  {
    CutCell const cell(geometry, {whole});
    auto const g = Harmos::onHost(cell.cut.gradient);
    for (int k = 0; k < 12; ++k)
      EXPECT_NEAR(g(0, k), 0.0, 1e-13);
  }
}

TEST(CutGradients, lostExtent_isWhatARegionLacksOfItsCell)
{
  Region const film = polygon({{2.0, 1.1}, {2.4, 1.1}, {2.4, 1.103}, {2.0, 1.103}});
  Region const whole = polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.3}, {2.0, 1.3}});
  Region const thread = polygon({{2.0, 1.1}, {2.4, 1.1}, {2.4, 1.1 + 1e-8}, {2.0, 1.1 + 1e-8}});
  double const lost[3][2] = {{0.0, 0.09 - 9e-6}, {0.0, 0.0}, {0.0, 0.09}};
  Region const part[3] = {film, whole, thread};
  for (int i = 0; i < 3; ++i)
  {
    auto const e = Harmos::onHost(CutCell(Geometry::Planar, {part[i]}).cut.lost_extent);
    EXPECT_NEAR(e(0, LostExtentXX), lost[i][0], 1e-14);
    EXPECT_NEAR(e(0, LostExtentXY), 0.0, 1e-14);
    EXPECT_NEAR(e(0, LostExtentYY), lost[i][1], 1e-14);
  }
}

TEST(CutGradients, lostExtent_countsTheImageBeyondASlipWall)
{
  // the left 0.15 of a cell 0.4 wide: beyond a mirror there goes on another 0.15
  Region const part = polygon({{2.0, 1.0}, {2.15, 1.0}, {2.15, 1.3}, {2.0, 1.3}});
  BoundaryKind const kind[2] = {BoundaryKind::Outflow, BoundaryKind::SlipWall};
  double const extent[2] = {0.15, 0.3};
  for (int i = 0; i < 2; ++i)
  {
    std::vector<Boundary> walls(4);
    for (Boundary &wall : walls)
      wall.kind = kind[i];
    BoundaryConditions conditions;
    conditions.boundary = deviceCopy("boundary", walls);
    CutCell const c(Geometry::Planar, {part}, Material(), CutCellStress::FilledRegions, 1.0, 0.0, 0.0, conditions);
    auto const e = Harmos::onHost(c.cut.lost_extent);
    EXPECT_NEAR(e(0, LostExtentXX), 0.16 - extent[i] * extent[i], 1e-14);
    EXPECT_NEAR(e(0, LostExtentXY), 0.0, 1e-14);
    EXPECT_NEAR(e(0, LostExtentYY), 0.0, 1e-14);
  }
}

TEST(CutGradients, ofAThreadAndOfNothingAreFinite)
{
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (Region const &part : {polygon({{2.0, 1.0}, {2.0, 1.0}, {2.0, 1.3}}), polygon({})})
    {
      auto const g = Harmos::onHost(CutCell(geometry, {part}).cut.gradient);
      for (int k = 0; k < 12; ++k)
        EXPECT_TRUE(std::isfinite(g(0, k)));
    }
}

TEST(CutGradients, ofAFilmWhoseSidesMoveInUnequalPiecesAreAtMostThoseOfTheShapeFunctions)
{
  Vector2 const from = {2.0, 1.05}, to = {2.4, 1.2}, across = {-0.15e-5, 0.4e-5};
  Vector2 const bend = from + 0.6 * (to - from);
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (Region const &film : {polygon({from, to, to + across, from + across}),
                               polygon({from, to, to + across, bend + across, from + across})})
    {
      auto const g = Harmos::onHost(CutCell(geometry, {film}).cut.gradient);
      for (int k = 0; k < 4; ++k)
        EXPECT_LE(std::hypot(g(0, 3 * k + CutGradientX), g(0, 3 * k + CutGradientY)), 10.1) << film.size;
    }
}
