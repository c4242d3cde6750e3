// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_CutGradients.hpp>

#include <Harmos_AreaWeight.hpp>
#include <Harmos_Bilinear.hpp>
#include <Harmos_Fullness.hpp>
#include <detail/Harmos_PairAccess.hpp>

namespace Harmos
{
namespace
{

/// d N_I / dx at reference coordinates in [0, 1]^2. [1/length]
KOKKOS_INLINE_FUNCTION void gradientsAt(Quadrilateral const &q, Vector2 const &xi, Vector2 gradient[4])
{
  Vector2 const along = (1.0 - xi[1]) * (q[1] - q[0]) + xi[1] * (q[2] - q[3]); // dx/dxi
  Vector2 const across = (1.0 - xi[0]) * (q[3] - q[0]) + xi[0] * (q[2] - q[1]);
  double const inverse = 1.0 / cross(along, across);
  Vector2 const of_xi{inverse * across[1], -inverse * across[0]}, of_eta{-inverse * along[1], inverse * along[0]};
  double const d_xi[4] = {xi[1] - 1.0, 1.0 - xi[1], xi[1], -xi[1]};
  double const d_eta[4] = {xi[0] - 1.0, -xi[0], xi[0], 1.0 - xi[0]};
  for (int k = 0; k < 4; ++k)
    gradient[k] = d_xi[k] * of_xi + d_eta[k] * of_eta;
}

/// Integrals of the shape functions over a region, per its ring's volume: midpoints of the edges of its triangles.
KOKKOS_INLINE_FUNCTION void hoopMeans(Quadrilateral const &q, Region const &region, double hoop[4])
{
  double ring = 0.0;
  for (int k = 0; k < 4; ++k)
    hoop[k] = 0.0;
  for (int i = 2; i < region.size; ++i)
  {
    Vector2 const corner[3] = {region[0], region[i - 1], region[i]};
    double const area = 0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]);
    ring += area * (corner[0][0] + corner[1][0] + corner[2][0]) / 3.0;
    for (int j = 0; j < 3; ++j)
    {
      double N[4];
      shapeFunctionsAt(q, 0.5 * (corner[j] + corner[(j + 1) % 3]), N);
      for (int k = 0; k < 4; ++k)
        hoop[k] += area / 3.0 * N[k];
    }
  }
  for (int k = 0; k < 4; ++k)
    hoop[k] /= ring;
}

struct CutGradientFunctor
{
  Mesh mesh;
  CellMaterialPairs pairs;
  FilledRegions regions;
  View<Material *> materials;
  CutCellStress where;
  View<double *[12]> gradient;

  KOKKOS_INLINE_FUNCTION void store(int row, int cell, Quadrilateral const &q, double share) const
  {
    constexpr double least_area = 1e-13; // of the cell
    Region const &region = regions.polygon(row);
    bool const thin = region.size < 3 || !(area(region) > least_area * mesh.cell_area(cell));
    Vector2 centre{0.0, 0.0};
    int const count = region.size > 0 ? region.size : 4;
    for (int i = 0; i < count; ++i)
      centre += (1.0 / count) * (region.size > 0 ? region[i] : q[i]);
    if (!thin)
      centre = volumeCentroid(region, mesh.geometry);
    Vector2 const xi = referenceCoordinates(q, centre);
    Vector2 slope[4];
    gradientsAt(q, xi, slope);
    bool const ring = mesh.geometry == Geometry::Axisymmetric;
    detail::Corners<double> const corners = detail::cellCorners(mesh, cell);
    auto const plane = detail::meanGradient(corners);
    double const mean[4][2] = {
        {plane.x0, plane.y0}, {plane.x1, plane.y1}, {-plane.x0, -plane.y0}, {-plane.x1, -plane.y1}};
    auto const about = detail::ringGradient(corners);
    double hoop[4] = {};
    if (ring && !thin)
      hoopMeans(q, region, hoop);
    bool const keeps_mean = ring && thin; // its centroid may lie on the axis
    for (int k = 0; k < 4; ++k)
    {
      double const mean_x = ring ? about.x[k] / about.volume : mean[k][0] / plane.area;
      double const mean_y = ring ? about.y[k] / about.volume : mean[k][1] / plane.area;
      gradient(row, 3 * k + CutGradientX) = keeps_mean ? 0.0 : share * (slope[k][0] - mean_x);
      gradient(row, 3 * k + CutGradientY) = keeps_mean ? 0.0 : share * (slope[k][1] - mean_y);
      gradient(row, 3 * k + CutHoop) = ring && !thin ? share * (hoop[k] - about.hoop[k] / about.volume) : 0.0;
    }
  }

  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    int const cell = regions.mixed_cell(i);
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    int const first = regions.cell_region(cell), count = pairs.offset(cell + 1) - pairs.offset(cell);
    double const full = where == CutCellStress::FullCells ? fullness(mesh, pairs, regions, cell) : 1.0;
    for (int k = 0; k < count; ++k)
    {
      Material const &material = materials(pairs.material(pairs.offset(cell) + k));
      if (actsOnFilledRegion(where, material))
        store(first + k, cell, q, actsInFullCells(where, material) ? full : 1.0);
    }
  }
};

} // namespace

void computeCutGradients(Mesh const &mesh, CellMaterialPairs const &pairs, FilledRegions const &regions,
                         View<Material *> const &materials, CutCellStress where, CutGradients &cut)
{
  cut.cell_region = regions.cell_region;
  int const count = static_cast<int>(regions.polygon.extent(0));
  if (static_cast<int>(cut.gradient.extent(0)) < count)
    cut.gradient = View<double *[12]>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::lagrange::cut_gradient"),
                                      count + count / 8);
  Kokkos::parallel_for("Harmos::lagrange::cutGradients", RangePolicy(0, regions.num_mixed_cells),
                       CutGradientFunctor{mesh, pairs, regions, materials, where, cut.gradient});
}

} // namespace Harmos
