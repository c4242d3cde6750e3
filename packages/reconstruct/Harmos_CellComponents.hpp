// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CELL_COMPONENTS_HPP
#define HARMOS_CELL_COMPONENTS_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_OutlineCorner.hpp>

namespace Harmos
{

/// Void as a component of a cell.
constexpr int void_material = -1;

/// A set of a cell's components: bit k stands for component k.
using ComponentSet = unsigned;

/// What the reconstruction reads.
struct ReconstructionField
{
  Mesh mesh;
  CellMaterialPairs pairs;
  View<double *[num_pair_fields]> record;
  View<double *[2]> centroid; // read where centroids are used
  View<int *> exact = {};     // materials: 1 where volumes and centroids are those of the body's shape; extent 0: none
  View<int *> fluid = {};     // materials: 1 where it has no strength; extent 0: none
  View<int *> wall = {};      // boundaries: 1 where it is a contact wall; extent 0: none
  RigidCorners corners = {};
};

/// Whether a face of a cell is a contact wall.
KOKKOS_INLINE_FUNCTION bool isContactWall(ReconstructionField const &field, int cell, int face)
{
  if (field.wall.extent(0) == 0 || field.mesh.face_neighbour(cell, face) >= 0)
    return false;
  int const boundary = field.mesh.face_boundary(cell, face);
  return boundary >= 0 && field.wall(boundary) == 1;
}

/// Whether some face of it is.
KOKKOS_INLINE_FUNCTION bool isAtWall(ReconstructionField const &field, int cell)
{
  return isContactWall(field, cell, 0) || isContactWall(field, cell, 1) || isContactWall(field, cell, 2) ||
         isContactWall(field, cell, 3);
}

/// The components of a mixed cell (its materials, ascending, then void where there is some) in the cell's own
/// coordinates xi = (x - corner) / size, size^2 = cell area: there the cell has unit area and digits stay. Its weighted
/// volume there is one as well.
struct CellComponents
{
  int cell;
  Vector2 corner;    // the cell's node 0 [length]
  double size;       // [length]
  Region polygon;    // the cell; area 1
  AreaWeight weight; // at points xi; axisymmetric: the radius over the cell's mean radius
  int count;
  int material[max_components];
  double volume[max_components];    // volume fractions
  Vector2 centroid[max_components]; // meaningful where centroids were asked for
  ComponentSet exact;               // those whose volumes and centroids are their shape's

  KOKKOS_INLINE_FUNCTION ComponentSet all() const { return (1u << count) - 1u; }
  KOKKOS_INLINE_FUNCTION bool holds(ComponentSet set, int k) const { return (set >> k) & 1u; }
  KOKKOS_INLINE_FUNCTION bool isExact(ComponentSet set) const { return (set & ~exact) == 0u; }
  KOKKOS_INLINE_FUNCTION Vector2 toUnit(Vector2 const &x) const { return (1.0 / size) * (x - corner); }
  KOKKOS_INLINE_FUNCTION Vector2 fromUnit(Vector2 const &xi) const { return corner + size * xi; }

  /// Weighted moments of a region about its first vertex.
  HARMOS_LARGE_FUNCTION Moments<1> momentsOf(Region const &region) const
  {
    return moments<1>(region, region[0], {weight.at(region[0]), weight.slope});
  }

  KOKKOS_INLINE_FUNCTION double volumeOfRegion(Region const &region) const
  {
    return weight.uniform() || region.empty() ? area(region) : momentsOf(region).volume();
  }

  /// First moment of a region less that which component k would have at its centroid with the region's volume.
  KOKKOS_INLINE_FUNCTION Vector2 firstMiss(Region const &region, int k) const
  {
    return firstMiss(momentsOf(region), region, k);
  }

  /// \param m momentsOf(region)
  KOKKOS_INLINE_FUNCTION Vector2 firstMiss(Moments<1> const &m, Region const &region, int k) const
  {
    return Vector2{m.first(0), m.first(1)} + m.volume() * (region[0] - centroid[k]);
  }

  KOKKOS_INLINE_FUNCTION double volumeOf(ComponentSet set) const
  {
    double sum = 0.0;
    for (int k = 0; k < count; ++k)
      sum += holds(set, k) ? volume[k] : 0.0;
    return sum;
  }

  /// Volume-weighted sum of the centroids of a set.
  KOKKOS_INLINE_FUNCTION Vector2 firstMomentOf(ComponentSet set) const
  {
    Vector2 sum{0.0, 0.0};
    for (int k = 0; k < count; ++k)
      if (holds(set, k))
        sum += volume[k] * centroid[k];
    return sum;
  }

  KOKKOS_INLINE_FUNCTION ComponentSet setOfMaterial(int of_material) const
  {
    for (int k = 0; k < count; ++k)
      if (material[k] == of_material)
        return 1u << k;
    return 0u;
  }
};

/// Void counts as a component when more than this part of the cell is not filled.
constexpr double least_void = 1e-14;

KOKKOS_INLINE_FUNCTION bool hasVoid(ReconstructionField const &field, int cell)
{
  double filled = 0.0;
  for (int pair = field.pairs.offset(cell); pair < field.pairs.offset(cell + 1); ++pair)
    filled += field.record(pair, VolumeFraction);
  return 1.0 - filled > least_void;
}

/// Number of components of a mixed cell.
KOKKOS_INLINE_FUNCTION int componentCount(ReconstructionField const &field, int cell)
{
  return field.pairs.offset(cell + 1) - field.pairs.offset(cell) + (hasVoid(field, cell) ? 1 : 0);
}

/// \pre componentCount(field, cell) <= max_components.
/// \param with_centroids Read the pairs' centroids; the void's is what they leave of the cell's first moment.
HARMOS_LARGE_FUNCTION CellComponents cellComponents(ReconstructionField const &field, int cell, bool with_centroids)
{
  Quadrilateral const quad = cellQuadrilateral(field.mesh, cell);
  CellComponents c;
  c.cell = cell;
  c.corner = quad[0];
  c.size = Math::sqrt(area(quad));
  for (int k = 0; k < 4; ++k)
    c.polygon.push(c.toUnit(quad[k]));
  if (field.mesh.geometry == Geometry::Axisymmetric)
  {
    double const per_mean_radius = area(quad) / volume(quad, Geometry::Axisymmetric);
    c.weight = {per_mean_radius * c.corner[0], per_mean_radius * c.size};
  }
  c.count = 0;
  c.exact = 0u;
  bool const some_exact = field.exact.extent(0) > 0;
  double filled = 0.0;
  Vector2 first{0.0, 0.0};
  for (int pair = field.pairs.offset(cell); pair < field.pairs.offset(cell + 1); ++pair)
  {
    int const k = c.count++;
    c.material[k] = field.pairs.material(pair);
    if (some_exact && field.exact(c.material[k]) == 1)
      c.exact |= 1u << k;
    c.volume[k] = field.record(pair, VolumeFraction);
    filled += c.volume[k];
    c.centroid[k] = {0.0, 0.0};
    if (with_centroids)
    {
      c.centroid[k] = c.toUnit({field.centroid(pair, 0), field.centroid(pair, 1)});
      first += c.volume[k] * c.centroid[k];
    }
  }
  if (1.0 - filled > least_void)
  {
    int const k = c.count++;
    c.material[k] = void_material;
    c.volume[k] = 1.0 - filled;
    c.centroid[k] = {0.0, 0.0};
    if (with_centroids)
    {
      Moments<1> const m = c.momentsOf(c.polygon); // its first vertex is the origin of xi
      c.centroid[k] = (1.0 / c.volume[k]) * (Vector2{m.first(0), m.first(1)} - first);
    }
  }
  return c;
}

/// The corner that component k has by its outline; none where it does not fill what that leaves, under another body.
KOKKOS_INLINE_FUNCTION OutlineCorner outlineCorner(ReconstructionField const &field, CellComponents const &components,
                                                   int k)
{
  constexpr double tolerance = 1e-9; // of the cell
  RigidCorners const &rows = field.corners;
  if (rows.offset.extent(0) > 0)
    for (int r = rows.offset(components.cell); r < rows.offset(components.cell + 1); ++r)
      if (rows.material(r) == components.material[k] &&
          Math::fabs(rows.volume_fraction(r) - components.volume[k]) < tolerance)
        return rows.corner(r);
  return {};
}

/// Volume fraction in any cell of those materials (and void) that make up a set of components.
HARMOS_LARGE_FUNCTION double setFraction(ReconstructionField const &field, CellComponents const &components,
                                         ComponentSet set, int cell)
{
  int const kind = field.pairs.cell_kind(cell);
  if (kind == VoidCell)
    return (components.setOfMaterial(void_material) & set) != 0u ? 1.0 : 0.0;
  int const begin = field.pairs.offset(cell);
  if (kind == PureCell)
    return (components.setOfMaterial(field.pairs.material(begin)) & set) != 0u ? 1.0 : 0.0;
  double sum = 0.0, filled = 0.0;
  for (int pair = begin; pair < field.pairs.offset(cell + 1); ++pair)
  {
    double const fraction = field.record(pair, VolumeFraction);
    filled += fraction;
    if ((components.setOfMaterial(field.pairs.material(pair)) & set) != 0u)
      sum += fraction;
  }
  if ((components.setOfMaterial(void_material) & set) != 0u)
    sum += Math::max(0.0, 1.0 - filled);
  return sum;
}

/// A cell's corners in the coordinates of another one.
KOKKOS_INLINE_FUNCTION Quadrilateral unitQuadrilateral(Mesh const &mesh, CellComponents const &components, int cell)
{
  Quadrilateral quad = cellQuadrilateral(mesh, cell);
  for (int k = 0; k < 4; ++k)
    quad[k] = components.toUnit(quad[k]);
  return quad;
}

/// Centroid of a quadrilateral.
KOKKOS_INLINE_FUNCTION Vector2 quadrilateralCentroid(Quadrilateral const &quad)
{
  return quad[0] + moments<1>(quad, quad[0]).centroid();
}

} // namespace Harmos

#endif
