// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_INTERFACE_SEGMENTS_HPP
#define HARMOS_INTERFACE_SEGMENTS_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_ConstraintOptions.hpp>
#include <Harmos_FilledRegions.hpp>
#include <Harmos_InterfaceCells.hpp>

namespace Harmos
{

/// Segments of one cell are numbered below this.
constexpr int max_cell_segments = 64;

/// Distance of two points of a piece from its ends, part of its length: Gauss points. Nearer to the ends they condition
/// the rows better, but let a corner of the other body sink deeper between them.
constexpr double gauss_point = 0.21132486540518713;

/// A straight piece of a filled region's boundary that does not face the same material, or of a contact wall.
struct InterfaceSegment
{
  Vector2 midpoint;
  Vector2 point;       // where its ray starts and its row stands: the midpoint, or one of two points of the whole piece
  Vector2 normal;      // unit; leaves the region (a wall's: points into the domain)
  Vector2 cell_centre; // mean of the cell's corners
  Vector2 lattice[2];  // d . lattice[i] counts the cells in a distance d along the cell's i-th direction [1/length]
  double length;       // [length]
  double cell_size;    // sqrt of the cell's area [length]
  double exposed;      // part of its cell face that this region exposes, in [0, 1]; 1 inside a cell
  int cell;
  int number;   // within the cell
  int pair;     // -1: wall
  int material; // -1: wall
  int face;     // of the cell; -1: an interface inside the cell
  int parts;    // the piece that this is a part of is so many times as long
};

/// Whether a segment is a small part of a cell face, as steps between the lines of two cells are.
KOKKOS_INLINE_FUNCTION bool exposesLittle(InterfaceSegment const &s, double least_exposed)
{
  return s.face >= 0 && s.exposed < least_exposed;
}

/// Ends of a segment: 0 before its midpoint along the outline of its region, which is counter-clockwise, 1 behind it.
KOKKOS_INLINE_FUNCTION Vector2 endOf(InterfaceSegment const &s, int end)
{
  return s.midpoint + ((end - 0.5) * s.length) * perpendicular(s.normal);
}

/// Where the area of a segment balances. Axisymmetric: its ring's, s = L^2 r' / (12 r) beyond the midpoint; a uniform
/// pressure over the ring then loads its nodes as ring shares lump their masses.
KOKKOS_INLINE_FUNCTION Vector2 balancePoint(Geometry geometry, Vector2 const &midpoint, Vector2 const &direction,
                                            double length)
{
  if (geometry == Geometry::Planar || !(midpoint[0] > 0.0))
    return midpoint;
  return midpoint + (length * length * direction[0] / (12.0 * midpoint[0])) * direction;
}

/// A half of a segment, with its Gauss point of the whole.
KOKKOS_INLINE_FUNCTION InterfaceSegment halfOf(InterfaceSegment const &whole, int half)
{
  Vector2 const along = (half == 0 ? whole.length : -whole.length) * perpendicular(whole.normal);
  InterfaceSegment s = whole;
  s.midpoint = whole.midpoint + 0.25 * along;
  s.point = whole.midpoint + (0.5 - gauss_point) * along;
  s.length = 0.5 * whole.length;
  s.parts = 2;
  return s;
}

/// All segments of this rank, ordered by cell and number within the cell (so by key).
struct InterfaceSegments
{
  int count = 0;
  View<InterfaceSegment *> segment; // count, and some room
  int num_cells = 0;                // that were looked at
  View<int *> cell;                 // ascending; num_cells, and some room
  View<int *> first;                // num_cells: first segment of each

  /// First segment of a cell; `count` where it was not looked at. Of a cell without segments: of another one. Every
  /// ray from a face asks: a search without branches.
  KOKKOS_INLINE_FUNCTION int firstOf(int wanted) const
  {
    int at = 0;
    for (int left = num_cells; left > 1;)
    {
      int const half = left / 2;
      at += cell(at + half) <= wanted ? half : 0;
      left -= half;
    }
    return num_cells > 0 && cell(at) == wanted ? first(at) : count;
  }
};

/// The boundaries of the filled regions: interface edges inside mixed cells, and the exposed parts of cell faces, which
/// are the parts of a region's edge on a face that the same material's region does not cover across the face.
///
/// An edge is split where the material beyond it changes (void counts). Contact walls are segments of material -1; a
/// region's edge on one is exposed; other domain boundaries carry nothing; a face with neither neighbour nor boundary
/// is a free surface (of a body-fitted block), in two halves, each with a Gauss point. Other pieces are cut in two
/// halves where `placement` wants two points. Cells of depth
/// mesh.halo (halo > 0) carry nothing: what lies beyond them is unknown.
///
/// Nothing is written where no segment can meet another body: in cells with one material alone, and no contact wall,
/// within two cells around them. (Free surfaces of body-fitted blocks are written all.)
///
/// Cost: six integers a cell and two a node are read, unless `kept` has the cells already; the rest follows the
/// interfaces. Throws std::runtime_error when a cell has more than max_cell_segments.
InterfaceSegments findInterfaceSegments(Mesh const &mesh, CellMaterialPairs const &pairs,
                                        NodeMaterialPairs const &dof_nodes, FilledRegions const &regions,
                                        BoundaryConditions const &conditions, Placement placement,
                                        InterfaceCells *kept = nullptr, WorkArrays const &work = {});

} // namespace Harmos

#endif
