// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_CutGradients.hpp>

#include <Harmos_BentEdge.hpp>
#include <Harmos_Bilinear.hpp>
#include <Harmos_Fullness.hpp>
#include <Harmos_Moments.hpp>
#include <Harmos_SlipMirrors.hpp>
#include <detail/Harmos_CornerGradients.hpp>

namespace Harmos
{
namespace
{

/// Derivatives of a region's volume by the positions of the cell's corners, as the region's outline is moved.
KOKKOS_INLINE_FUNCTION void volumeDerivatives(Quadrilateral const &q, Region const &region, AreaWeight const &ring,
                                              double full, double shortest, Vector2 derivative[4])
{
  for (int k = 0; k < 4; ++k)
    derivative[k] = {0.0, 0.0};
  double const cell_area = area(q);
  double N_first[4], N_next[4], N[4], N_middle[4];
  shapeFunctionsAt(q, region[0], N_first);
  for (int k = 0; k < 4; ++k)
    N_next[k] = N_first[k];
  for (int i = 0; i < region.size; ++i)
  {
    Vector2 const a = region[i], b = region[region.next(i)];
    for (int k = 0; k < 4; ++k)
      N[k] = N_next[k];
    shapeFunctionsAt(q, b, N_next);
    shapeFunctionsAt(q, 0.5 * (a + b), N_middle);
    EdgeWeights const w = edgeWeights(ring, a, b, bendOf(b - a, cell_area, full, shortest, N_middle));
    Vector2 const normal{b[1] - a[1], a[0] - b[0]}; // times the length
    for (int k = 0; k < 4; ++k)
      derivative[k] += (w.first * N[k] + w.middle * N_middle[k] + w.second * N_next[k]) * normal;
  }
}

/// A bound of what the means of the shape functions' gradients over two parts of a cell can differ by: sqrt(2) of its
/// longest side over its area for either, were the cell a rectangle.
KOKKOS_INLINE_FUNCTION double steepestDifference(Quadrilateral const &q)
{
  double longest = 0.0;
  for (int k = 0; k < 4; ++k)
    longest = Math::max(longest, norm(q[(k + 1) % 4] - q[k]));
  return 3.0 * longest / area(q);
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

/// A symmetric tensor.
struct SquaredExtent
{
  double xx, xy, yy;

  KOKKOS_INLINE_FUNCTION double along(Vector2 const &n) const
  {
    return n[0] * n[0] * xx + 2.0 * n[0] * n[1] * xy + n[1] * n[1] * yy;
  }
};

/// 12 / area times the second moments about the centroid.
template <int Capacity>
KOKKOS_INLINE_FUNCTION SquaredExtent squaredExtent(Polygon<Capacity> const &polygon)
{
  auto const m = moments<2>(polygon, polygon[0]);
  Vector2 const c = m.centroid();
  double const scale = 12.0 / m.volume();
  return {scale * m.second(0, 0) - 12.0 * c[0] * c[0], scale * m.second(0, 1) - 12.0 * c[0] * c[1],
          scale * m.second(1, 1) - 12.0 * c[1] * c[1]};
}

/// The part of a face of a cell that a region of it lies on.
KOKKOS_INLINE_FUNCTION double partOfFace(Quadrilateral const &q, int face, Region const &region)
{
  double length = 0.0;
  for (int i = 0; i < region.size; ++i)
  {
    Vector2 const a = region[i], b = region[region.next(i)];
    if (isOnFace(q, face, a) && isOnFace(q, face, b))
      length += norm(b - a);
  }
  return length / norm(q[(face + 1) % 4] - q[face]);
}

/// Columns of CutGradients::extent.
enum ExtentColumn : int
{
  ExtentXX = 0, // squaredExtent; below zero: a region without an area
  ExtentXY = 1,
  ExtentYY = 2,
  PartOfFace = 3 // of the cell's faces k = 0..3
};

/// The extents of the regions, each by itself, and what parts of their cells' faces they lie on.
struct ExtentFunctor
{
  Mesh mesh;
  CellMaterialPairs pairs;
  FilledRegions regions;
  View<Material *> materials;
  CutCellStress where;
  View<double *[7]> extent;

  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    int const cell = regions.mixed_cell(i), begin = pairs.offset(cell);
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    for (int pair = begin; pair < pairs.offset(cell + 1); ++pair)
    {
      if (!actsOnFilledRegion(where, materials(pairs.material(pair))))
        continue;
      int const row = regions.cell_region(cell) + pair - begin;
      Region const &region = regions.polygon(row);
      bool const any = region.size >= 3 && area(region) > 0.0;
      SquaredExtent const own = any ? squaredExtent(region) : SquaredExtent{-1.0, 0.0, -1.0};
      extent(row, ExtentXX) = own.xx;
      extent(row, ExtentXY) = own.xy;
      extent(row, ExtentYY) = own.yy;
      for (int face = 0; face < 4; ++face)
        extent(row, PartOfFace + face) = any ? partOfFace(q, face, region) : 0.0;
    }
  }
};

struct CutGradientFunctor
{
  Mesh mesh;
  CellMaterialPairs pairs;
  View<double *[num_pair_fields]> record;
  FilledRegions regions;
  View<Material *> materials;
  View<Boundary *> boundary;
  CutCellStress where;
  double shortest_bent_edge;
  View<int *> first_row;
  View<double *[12]> gradient;
  View<double *[3]> lost_extent;
  View<double *[7]> extent;

  KOKKOS_INLINE_FUNCTION void storeLost(int row, double share, SquaredExtent const &whole,
                                        SquaredExtent const &own) const
  {
    lost_extent(row, LostExtentXX) = share * (whole.xx - own.xx);
    lost_extent(row, LostExtentXY) = share * (whole.xy - own.xy);
    lost_extent(row, LostExtentYY) = share * (whole.yy - own.yy);
  }

  KOKKOS_INLINE_FUNCTION SquaredExtent ownExtent(int row) const
  {
    return {extent(row, ExtentXX), extent(row, ExtentXY), extent(row, ExtentYY)};
  }

  /// Whether a material goes on beyond a face (Mesh::face_neighbour).
  /// \param open In: the part of the face that this side lies on. Out: that both do.
  KOKKOS_INLINE_FUNCTION bool isContinued(int beyond, int material, double &open, SquaredExtent &continued) const
  {
    int const other = beyond / 4, pair = beyond < 0 ? -1 : pairs.find(other, material);
    if (pair < 0)
      return false;
    int const first = regions.cell_region(other);
    if (first < 0)
    {
      continued = squaredExtent(cellQuadrilateral(mesh, other));
      return true;
    }
    int const row = first + pair - pairs.offset(other);
    continued = ownExtent(row);
    open = Math::min(open, extent(row, PartOfFace + beyond % 4));
    return continued.xx >= 0.0 && open > 0.0;
  }

  /// Square of the extent of a region and of what continues it in the cells beyond its faces, at most that of its cell:
  /// along a principal axis e of the region, those have n . e times their extent along the normal n of the face, times
  /// the part of the face that both sides lie on. A part of a cell beside a full one has the extent of its cell, a film
  /// its thickness. Beyond a slip wall is the region's own image.
  KOKKOS_INLINE_FUNCTION SquaredExtent reach(int row, int cell, int material, Quadrilateral const &q,
                                             SquaredExtent const &whole) const
  {
    SquaredExtent const own = ownExtent(row);
    double const angle = 0.5 * Math::atan2(own.xy, 0.5 * (own.xx - own.yy));
    Vector2 const axis[2] = {{Math::cos(angle), Math::sin(angle)}, {-Math::sin(angle), Math::cos(angle)}};
    double length[2];
    for (int i = 0; i < 2; ++i)
      length[i] = Math::sqrt(Math::max(own.along(axis[i]), 0.0));
    for (int face = 0; face < 4; ++face)
    {
      double open = extent(row, PartOfFace + face);
      SquaredExtent continued = own;
      if (!(open > 0.0) || (!SlipMirrors::isSlip(mesh, boundary, cell, face) &&
                            !isContinued(mesh.face_neighbour(cell, face), material, open, continued)))
        continue;
      Vector2 const side = q[(face + 1) % 4] - q[face];
      Vector2 const normal = (1.0 / norm(side)) * Vector2{side[1], -side[0]};
      double const more = open * Math::sqrt(Math::max(continued.along(normal), 0.0));
      for (int i = 0; i < 2; ++i)
        length[i] += more * Math::fabs(dot(normal, axis[i]));
    }
    SquaredExtent sum = {0.0, 0.0, 0.0};
    for (int i = 0; i < 2; ++i)
    {
      double const square = Math::min(length[i] * length[i], whole.along(axis[i]));
      sum.xx += square * axis[i][0] * axis[i][0];
      sum.xy += square * axis[i][0] * axis[i][1];
      sum.yy += square * axis[i][1] * axis[i][1];
    }
    return sum;
  }

  KOKKOS_INLINE_FUNCTION void store(int row, int cell, int material, Quadrilateral const &q, double full,
                                    double share) const
  {
    constexpr double least_volume = 1e-6; // of the cell's: below it the outline's round-off would count
    Region const &region = regions.polygon(row);
    AreaWeight const ring = areaWeight(mesh.geometry, {0.0, 0.0});
    double const filled = region.size < 3 ? 0.0 : volume(region, ring);
    SquaredExtent const whole = squaredExtent(q);
    storeLost(row, share, whole,
              share > 0.0 && extent(row, ExtentXX) >= 0.0 ? reach(row, cell, material, q, whole)
                                                          : SquaredExtent{0.0, 0.0, 0.0});
    if (!(filled > least_volume * mesh.cell_volume(cell)))
    {
      for (int column = 0; column < 12; ++column)
        gradient(row, column) = 0.0;
      return;
    }
    Vector2 derivative[4];
    volumeDerivatives(q, region, ring, full, shortest_bent_edge, derivative);
    double hoop[4] = {};
    if (mesh.geometry == Geometry::Axisymmetric)
      hoopMeans(q, region, hoop);
    detail::CornerGradients const mean = detail::cellGradients(mesh, cell);
    Vector2 beyond[4];
    for (int k = 0; k < 4; ++k)
      beyond[k] = {derivative[k][0] / filled - hoop[k] - mean.of[k][0], derivative[k][1] / filled - mean.of[k][1]};
    beyond[3] = Vector2{0.0, 0.0} - (beyond[0] + beyond[1] + beyond[2]); // nothing for a translation, to the last digit
    double largest = 0.0;
    for (int k = 0; k < 4; ++k)
      largest = Math::max(largest, norm(beyond[k]));
    double const most = steepestDifference(q);
    share *= largest > most ? most / largest : 1.0;
    for (int k = 0; k < 4; ++k)
    {
      gradient(row, 3 * k + CutGradientX) = share * beyond[k][0];
      gradient(row, 3 * k + CutGradientY) = share * beyond[k][1];
      gradient(row, 3 * k + CutHoop) = share * (hoop[k] - mean.hoop[k]);
    }
  }

  /// How far a solid that fills this part of a cell of several materials has the gradient of what it fills.
  KOKKOS_INLINE_FUNCTION double ownShare(int pair, Material const &material, double filled, double part,
                                         double full) const
  {
    double const strain =
        Math::max(Math::fabs(material.density0 * record(pair, SpecificVolume) - 1.0), record(pair, PlasticStrain));
    double const intact = Math::clamp((worn_strain - strain) / (worn_strain - intact_strain), 0.0, 1.0);
    double const closed = Math::max(0.0, 1.0 - (1.0 - full) * most_void_of_full_cell / most_void_beside_tip);
    double const whole = Math::min(1.0, part / least_whole_part);
    double const drift = Math::fabs(filled / (record(pair, Mass) * record(pair, SpecificVolume)) - 1.0);
    double const drifted = Math::clamp((drift - borne_drift) / (most_drift - borne_drift), 0.0, 1.0);
    return Math::max(full * Math::max(intact * closed, whole), drifted * intact * whole);
  }

  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    int const cell = regions.mixed_cell(i);
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    int const first = regions.cell_region(cell), count = pairs.offset(cell + 1) - pairs.offset(cell);
    double const full =
        fullness(mesh, pairs, regions, cell, [this](int material) { return isFluid(materials(material)); });
    bool any = false;
    for (int k = 0; k < count; ++k)
    {
      Material const &material = materials(pairs.material(pairs.offset(cell) + k));
      if (!actsOnFilledRegion(where, material))
        continue;
      Region const &region = regions.polygon(first + k);
      double share = 1.0;
      if (actsInFullCells(where, material))
        share = count < 2 ? 0.0
                          : ownShare(pairs.offset(cell) + k, material, volume(region, mesh.geometry),
                                     area(region) / mesh.cell_area(cell), full);
      store(first + k, cell, pairs.material(pairs.offset(cell) + k), q, full, share);
      any = any || share > 0.0;
    }
    if (any)
      first_row(cell) = first;
  }
};

} // namespace

void computeCutGradients(Mesh const &mesh, CellMaterialPairs const &pairs,
                         View<double *[num_pair_fields]> const &record, FilledRegions const &regions,
                         View<Material *> const &materials, BoundaryConditions const &boundary, CutCellStress where,
                         double shortest_bent_edge, CutGradients &cut)
{
  if (static_cast<int>(cut.first_row.extent(0)) != mesh.num_cells)
    cut.first_row =
        View<int *>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::lagrange::first_row"), mesh.num_cells);
  Kokkos::deep_copy(cut.first_row, -1);
  int const count = static_cast<int>(regions.polygon.extent(0));
  if (static_cast<int>(cut.gradient.extent(0)) < count)
    cut.gradient = View<double *[12]>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::lagrange::cut_gradient"),
                                      count + count / 8);
  if (cut.lost_extent.extent(0) < cut.gradient.extent(0))
    cut.lost_extent = View<double *[3]>(
        Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::lagrange::lost_extent"), cut.gradient.extent(0));
  if (cut.extent.extent(0) < cut.gradient.extent(0))
    cut.extent = View<double *[7]>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::lagrange::extent"),
                                   cut.gradient.extent(0));
  Kokkos::parallel_for("Harmos::lagrange::extents", RangePolicy(0, regions.num_mixed_cells),
                       ExtentFunctor{mesh, pairs, regions, materials, where, cut.extent});
  Kokkos::parallel_for("Harmos::lagrange::cutGradients", RangePolicy(0, regions.num_mixed_cells),
                       CutGradientFunctor{mesh, pairs, record, regions, materials, boundary.boundary, where,
                                          shortest_bent_edge, cut.first_row, cut.gradient, cut.lost_extent,
                                          cut.extent});
}

} // namespace Harmos
