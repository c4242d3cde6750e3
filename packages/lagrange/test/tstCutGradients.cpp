// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <Harmos_AreaWeight.hpp>
#include <Harmos_Bilinear.hpp>
#include <detail/Harmos_PairAccess.hpp>
#include <detail/Harmos_RingQuadrature.hpp>

#include <numeric>

using namespace Harmos;

namespace
{

/// One cell, [2, 2.4] x [1, 1.3], whose one pair fills a given region.
struct CutCell
{
  Mesh mesh;
  CellMaterialPairs pairs;
  FilledRegions regions;
  CutGradients cut;

  CutCell(Geometry geometry, Region const &region)
  {
    mesh = buildMesh(rectilinearMesh({2.0, 2.4}, {1.0, 1.3}));
    setGeometry(mesh, geometry);
    pairs.offset = deviceCopy("offset", std::vector<int>{0, 1});
    regions.num_mixed_cells = 1;
    regions.mixed_cell = deviceCopy("mixed_cell", std::vector<int>{0});
    regions.cell_region = deviceCopy("cell_region", std::vector<int>{0});
    regions.polygon = deviceCopy("polygon", std::vector<Region>{region});
    pairs.material = deviceCopy("material", std::vector<int>{0});
    computeCutGradients(mesh, pairs, regions, deviceCopy("materials", std::vector<Material>(1)),
                        CutCellStress::FilledRegions, cut);
  }

  /// Integral over the region of (r) d N_I / dx_d, with N_I added for d = 0 about an axis.
  double integral(Region const &region, int corner, int d) const
  {
    auto const g = Harmos::onHost(cut.gradient);
    detail::Corners<double> const c = detail::cellCorners(mesh, 0);
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
    double const more = g(0, 3 * corner + d) + (d == 0 ? g(0, 3 * corner + CutHoop) : 0.0);
    return volume(region, mesh.geometry) * (mean + more);
  }
};

/// Integral of (r) N_I n_d along the outline: two Gauss points an edge are exact for cubics.
double alongOutline(Mesh const &mesh, Region const &region, int corner, int d)
{
  Quadrilateral const q = cellQuadrilateral(mesh, 0);
  double sum = 0.0;
  for (int i = 0; i < region.size; ++i)
  {
    Vector2 const a = region[i], b = region[(i + 1) % region.size];
    Vector2 const normal{b[1] - a[1], a[0] - b[0]}; // times the length
    for (double const t : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)})
    {
      Vector2 const x = (1.0 - t) * a + t * b;
      double N[4];
      shapeFunctionsAt(q, x, N);
      sum += 0.5 * areaWeight(mesh.geometry, {0.0, 0.0}).at(x) * N[corner] * normal[d];
    }
  }
  return sum;
}

Region polygon(std::vector<Vector2> const &vertices)
{
  Region r;
  for (Vector2 const &v : vertices)
    r.push(v);
  return r;
}

/// Rows of the gradients of regions that share the cell [2, 2.4] x [1, 1.3], each a material of its own.
auto gradientsOf(std::vector<Region> const &parts, Material const &material, CutCellStress where)
{
  Mesh const mesh = buildMesh(rectilinearMesh({2.0, 2.4}, {1.0, 1.3}));
  int const count = static_cast<int>(parts.size());
  CellMaterialPairs pairs;
  pairs.offset = deviceCopy("offset", std::vector<int>{0, count});
  std::vector<int> number(parts.size());
  std::iota(number.begin(), number.end(), 0);
  pairs.material = deviceCopy("material", number);
  FilledRegions regions;
  regions.num_mixed_cells = 1;
  regions.mixed_cell = deviceCopy("mixed_cell", std::vector<int>{0});
  regions.cell_region = deviceCopy("cell_region", std::vector<int>{0});
  regions.polygon = deviceCopy("polygon", parts);
  CutGradients cut;
  computeCutGradients(mesh, pairs, regions, deviceCopy("materials", std::vector<Material>(parts.size(), material)),
                      where, cut);
  return Harmos::onHost(cut.gradient);
}

} // namespace

TEST(CutGradients, areTheTractionsOfAUniformPressureOnTheOutline)
{
  // A pressure's forces on the part that a material fills are those of the same pressure on its outline.
  Region const parts[] = {polygon({{2.0, 1.0}, {2.31, 1.0}, {2.13, 1.3}, {2.0, 1.3}}),
                          polygon({{2.4, 1.22}, {2.4, 1.3}, {2.27, 1.3}}),
                          polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.17}, {2.29, 1.3}, {2.0, 1.3}})};
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (Region const &part : parts)
    {
      CutCell const cell(geometry, part);
      for (int corner = 0; corner < 4; ++corner)
        for (int d = 0; d < 2; ++d)
          EXPECT_NEAR(cell.integral(part, corner, d), alongOutline(cell.mesh, part, corner, d), 1e-14);
    }
}

TEST(CutGradients, ofSolidsFollowTheFullnessOfTheirCell)
{
  // Lower and upper part of the cell [2, 2.4] x [1, 1.3] with void above y = top: full at 1.3, half full at 0.5% of
  // void.
  Region const lower = polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.1}, {2.0, 1.1}});
  Material solid;
  solid.strength = StrengthKind::Elastic;
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
        EXPECT_EQ(fluid(region, k), all(region, k));
      }
    EXPECT_GT(std::fabs(all(0, CutGradientX)), 0.1); // the parts do have gradients of their own
  }
}

TEST(CutGradients, ofALoneSolidAreNothingBeyondTheMeanInFullCells)
{
  Material solid;
  solid.strength = StrengthKind::Elastic;
  auto const g =
      gradientsOf({polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.3}, {2.01, 1.3}})}, solid, CutCellStress::FullCells);
  for (int k = 0; k < 12; ++k)
    EXPECT_EQ(g(0, k), 0.0);
}

TEST(CutGradients, ofAWholeCellAreNothingBeyondItsMean)
{
  Region const whole = polygon({{2.0, 1.0}, {2.4, 1.0}, {2.4, 1.3}, {2.0, 1.3}});
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
  {
    CutCell const cell(geometry, whole);
    auto const g = Harmos::onHost(cell.cut.gradient);
    for (int k = 0; k < 12; ++k)
      EXPECT_NEAR(g(0, k), 0.0, 1e-13);
  }
}

TEST(CutGradients, ofAThreadAndOfNothingAreFinite)
{
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (Region const &part : {polygon({{2.0, 1.0}, {2.0, 1.0}, {2.0, 1.3}}), polygon({})})
    {
      auto const g = Harmos::onHost(CutCell(geometry, part).cut.gradient);
      for (int k = 0; k < 12; ++k)
        EXPECT_TRUE(std::isfinite(g(0, k)));
    }
}
