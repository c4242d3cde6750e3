// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_InterfaceCells.hpp>
#include <Harmos_InterfaceSegments.hpp>

#include <stdexcept>

namespace Harmos
{

namespace
{

// Shorter pieces, and distances to a line, count as nothing. [cell sizes]
constexpr double negligible = 1e-8;

constexpr int max_covers = 2 * max_components;

/// What lies beyond an edge: intervals of arc length, each of one material.
struct EdgeCovers
{
  int count = 0;
  double begin[max_covers];
  double end[max_covers];
  int material[max_covers];
};

/// An edge of a counter-clockwise region.
struct Edge
{
  Vector2 start, direction, normal; // direction and normal are unit vectors
  double length;
};

KOKKOS_INLINE_FUNCTION Edge edgeBetween(Vector2 const &a, Vector2 const &b)
{
  Edge edge{a, b - a, {0.0, 0.0}, 0.0};
  edge.length = norm(edge.direction);
  if (edge.length > 0.0)
    edge.direction *= 1.0 / edge.length;
  edge.normal = -perpendicular(edge.direction);
  return edge;
}

/// What the segments of one cell share.
struct CellFrame
{
  Quadrilateral corner;
  Edge face[4];
  double size;      // sqrt of the area
  double tolerance; // shorter pieces, and distances to a line, count as nothing
};

KOKKOS_INLINE_FUNCTION CellFrame cellFrame(Mesh const &mesh, int cell)
{
  CellFrame frame;
  frame.corner = cellQuadrilateral(mesh, cell);
  for (int k = 0; k < 4; ++k)
    frame.face[k] = edgeBetween(frame.corner[k], frame.corner[(k + 1) % 4]);
  frame.size = Math::sqrt(mesh.cell_area(cell));
  frame.tolerance = negligible * frame.size;
  return frame;
}

/// Add the intervals of an edge that a region's edges touch from the other side.
KOKKOS_INLINE_FUNCTION void addCover(Edge const &edge, Region const &region, int material, double tolerance,
                                     EdgeCovers &covers)
{
  if (region.empty())
    return;
  Vector2 a = region[region.size - 1] - edge.start;
  bool a_near = Math::fabs(dot(a, edge.normal)) <= tolerance;
  for (int i = 0; i < region.size && covers.count < max_covers; ++i)
  {
    Vector2 const b = region[i] - edge.start;
    bool const b_near = Math::fabs(dot(b, edge.normal)) <= tolerance;
    if (a_near && b_near)
    {
      double const end = Math::min(dot(a, edge.direction), edge.length);
      double const begin = Math::max(dot(b, edge.direction), 0.0);
      if (end - begin > tolerance)
      {
        covers.begin[covers.count] = begin;
        covers.end[covers.count] = end;
        covers.material[covers.count++] = material;
      }
    }
    a = b;
    a_near = b_near;
  }
}

/// The cell face that the edge a -> b lies on, with the face's own direction; -1: none.
KOKKOS_INLINE_FUNCTION int faceOfEdge(CellFrame const &frame, Vector2 const &a, Vector2 const &b)
{
  for (int k = 0; k < 4; ++k)
  {
    Edge const &face = frame.face[k];
    if (dot(face.direction, b - a) > 0.0 && Math::fabs(dot(a - face.start, face.normal)) <= frame.tolerance &&
        Math::fabs(dot(b - face.start, face.normal)) <= frame.tolerance)
      return k;
  }
  return -1;
}

/// Maximal pieces of an edge beyond which lies one other material, or void.
struct EdgePieces
{
  int count = 0;
  double total = 0.0;
  double begin[2 * max_covers + 1];
  double end[2 * max_covers + 1];
};

KOKKOS_INLINE_FUNCTION void exposedPieces(double length, EdgeCovers const &covers, int material, double tolerance,
                                          EdgePieces &pieces)
{
  double at[2 * max_covers + 2];
  int count = 0;
  at[count++] = 0.0;
  at[count++] = length;
  for (int i = 0; i < covers.count; ++i)
    for (int k = 0; k < 2; ++k)
    {
      double const s = k == 0 ? covers.begin[i] : covers.end[i];
      int j = count++;
      for (; j > 0 && at[j - 1] > s; --j)
        at[j] = at[j - 1];
      at[j] = s;
    }
  int last = -2; // what lies beyond the last piece; -1 is void
  for (int i = 0; i + 1 < count; ++i)
  {
    if (at[i + 1] - at[i] <= tolerance)
      continue;
    double const middle = 0.5 * (at[i] + at[i + 1]);
    int beyond = -1;
    for (int c = covers.count - 1; c >= 0; --c)
      if (covers.begin[c] < middle && middle < covers.end[c])
        beyond = covers.material[c];
    if (beyond != material)
    {
      pieces.total += at[i + 1] - at[i];
      if (beyond == last)
        pieces.end[pieces.count - 1] = at[i + 1];
      else
      {
        pieces.begin[pieces.count] = at[i];
        pieces.end[pieces.count++] = at[i + 1];
      }
    }
    last = beyond;
  }
}

/// Beyond the edge lies one thing: a wall, void or a pure cell.
KOKKOS_INLINE_FUNCTION void wholeEdge(double length, EdgePieces &pieces)
{
  pieces.count = 1;
  pieces.total = pieces.end[0] = length;
  pieces.begin[0] = 0.0;
}

/// Points of a piece: how many, and how far from its ends where there are two. Free faces of a body-fitted mesh have
/// two: with one point a face, corners that sink and rise by turns satisfy every row, and nothing but the stiffness of
/// long cells would hold them.
struct PiecePoints
{
  int count;
  double inset; // part of the piece's length
};

KOKKOS_INLINE_FUNCTION PiecePoints piecePoints(Placement placement, bool free)
{
  constexpr double end_inset = 1e-3; // the ray of an end itself would graze the piece that it looks at
  if (placement == Placement::SegmentEnds)
    return {2, end_inset};
  bool const two = free || placement == Placement::GaussPoints || placement == Placement::Mortar;
  return {two ? 2 : 1, gauss_point};
}

/// Writes the segments of single cells.
struct SegmentFinder
{
  Mesh mesh;
  CellMaterialPairs pairs;
  FilledRegions regions;
  CellSurface surface;
  View<InterfaceSegment *> segment;
  Placement placement;

  KOKKOS_INLINE_FUNCTION void coverBy(int cell, int except, Edge const &edge, double tolerance,
                                      EdgeCovers &covers) const
  {
    int const first = regions.cell_region(cell), begin = pairs.offset(cell);
    for (int other = begin; other < pairs.offset(cell + 1); ++other)
      if (other != except)
      {
        if (first >= 0)
          addCover(edge, regions.polygon(first + other - begin), pairs.material(other), tolerance, covers);
        else
          addCover(edge, regions.region(mesh, pairs, other), pairs.material(other), tolerance, covers);
      }
  }

  /// Whether the region of the same material across a face lies beyond the whole edge: most edges on faces.
  KOKKOS_INLINE_FUNCTION bool coveredByLike(int cell, int material, Edge const &edge, double tolerance) const
  {
    int const like = pairs.find(cell, material), first = regions.cell_region(cell);
    if (like < 0 || first < 0)
      return false;
    EdgeCovers covers;
    addCover(edge, regions.polygon(first + like - pairs.offset(cell)), material, tolerance, covers);
    return covers.count == 1 && covers.begin[0] <= tolerance && covers.end[0] >= edge.length - tolerance;
  }

  /// Whether the region of a material in a cell has the edge from a to b, corner for corner.
  KOKKOS_INLINE_FUNCTION bool hasEdge(int cell, int material, Vector2 const &a, Vector2 const &b) const
  {
    int const like = pairs.find(cell, material), first = regions.cell_region(cell);
    if (like < 0 || first < 0)
      return false;
    Region const &region = regions.polygon(first + like - pairs.offset(cell));
    for (int i = 0; i < region.size; ++i)
      if (region[i][0] == a[0] && region[i][1] == a[1])
      {
        Vector2 const &next = region[region.next(i)];
        return next[0] == b[0] && next[1] == b[1];
      }
    return false;
  }

  /// Whether nothing of a material can show through a face: it lies beyond too, or nothing that contact heeds.
  KOKKOS_INLINE_FUNCTION bool isHidden(int cell, int face, int material) const
  {
    int const across = mesh.face_neighbour(cell, face);
    return across >= 0 ? surface.filling(across / 4) == material
                       : mesh.face_boundary(cell, face) >= 0 && !surface.contactWall(cell, face);
  }

  /// Whether all faces of a pure cell are hidden, some by a region that has the very face: most cells beside mixed
  /// ones.
  KOKKOS_INLINE_FUNCTION bool isHidden(int cell) const
  {
    int const material = surface.filling(cell);
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    bool hidden = material >= 0;
    for (int k = 0; hidden && k < 4; ++k)
    {
      int const across = mesh.face_neighbour(cell, k);
      hidden = isHidden(cell, k, material) || (across >= 0 && hasEdge(across / 4, material, q[(k + 1) & 3], q[k]));
      hidden = hidden && !(surface.walls && surface.contactWall(cell, k));
    }
    return hidden;
  }

  /// Write the segments of one edge of a pair's region, on a face of its cell or (face = -1) inside, from `first` on,
  /// as far as there is room; returns their number. `blank` holds what the cell's segments share.
  KOKKOS_INLINE_FUNCTION int edgeSegments(int pair, Edge const &edge, int face, CellFrame const &frame,
                                          InterfaceSegment const &blank, int number, int first) const
  {
    int const cell = blank.cell;
    int const material = pairs.material(pair);
    int const across = face < 0 ? -1 : mesh.face_neighbour(cell, face);
    bool const outer = face >= 0 && across < 0;
    bool const free = outer && mesh.face_boundary(cell, face) < 0;
    EdgePieces pieces;
    if (outer || (across >= 0 && surface.filling(across / 4) != mixed_filling))
      wholeEdge(edge.length, pieces);
    else
    {
      if (across >= 0 && coveredByLike(across / 4, material, edge, frame.tolerance))
        return 0;
      EdgeCovers covers;
      coverBy(face < 0 ? cell : across / 4, face < 0 ? pair : -1, edge, frame.tolerance, covers);
      exposedPieces(edge.length, covers, material, frame.tolerance, pieces);
    }
    PiecePoints const points = piecePoints(placement, free);
    double const exposed = face < 0 ? 1.0 : pieces.total / frame.face[face].length;
    int const count = pieces.count * points.count;
    for (int i = 0; i < count && first + i < static_cast<int>(segment.extent(0)); ++i)
    {
      InterfaceSegment &s = segment(first + i);
      s = blank;
      int const half = i % points.count;
      double const begin = pieces.begin[i / points.count], length = pieces.end[i / points.count] - begin;
      s.length = length / points.count;
      s.midpoint = edge.start + (begin + (half + 0.5) * s.length) * edge.direction;
      s.point = middleOf(s.midpoint, edge.direction, s.length);
      if (points.count == 2)
        s.point = edge.start + (begin + (half == 0 ? points.inset : 1.0 - points.inset) * length) * edge.direction;
      s.normal = edge.normal;
      s.parts = points.count;
      s.exposed = exposed;
      s.number = number + i;
      s.pair = pair;
      s.material = material;
      s.face = face;
    }
    return count;
  }

  /// Where the segment's area balances. Axisymmetric: its ring's, s = L^2 r' / (12 r) beyond the midpoint; a uniform
  /// pressure over the ring then loads its nodes as ring shares lump their masses.
  KOKKOS_INLINE_FUNCTION Vector2 middleOf(Vector2 const &midpoint, Vector2 const &direction, double length) const
  {
    if (mesh.geometry == Geometry::Planar || !(midpoint[0] > 0.0))
      return midpoint;
    return midpoint + (length * length * direction[0] / (12.0 * midpoint[0])) * direction;
  }

  static KOKKOS_INLINE_FUNCTION InterfaceSegment blankSegment(int cell, CellFrame const &frame)
  {
    InterfaceSegment s = {};
    Quadrilateral const &q = frame.corner;
    Vector2 const e1 = 0.5 * ((q[1] - q[0]) + (q[2] - q[3]));
    Vector2 const e2 = 0.5 * ((q[3] - q[0]) + (q[2] - q[1]));
    double const det = cross(e1, e2);
    s.cell_centre = 0.25 * ((q[0] + q[1]) + (q[2] + q[3]));
    s.lattice[0] = (-1.0 / det) * perpendicular(e2);
    s.lattice[1] = (1.0 / det) * perpendicular(e1);
    s.cell_size = frame.size;
    s.cell = cell;
    return s;
  }

  /// Edges of the cell's regions: a pure cell's are its faces.
  KOKKOS_INLINE_FUNCTION int regionSegments(CellFrame const &frame, InterfaceSegment const &blank, int first) const
  {
    int const cell = blank.cell, begin = pairs.offset(cell);
    int count = 0;
    if (surface.filling(cell) >= 0)
    {
      for (int k = 0; k < 4; ++k)
        if (!isHidden(cell, k, pairs.material(begin)) && frame.face[k].length > frame.tolerance)
          count += edgeSegments(begin, frame.face[k], k, frame, blank, count, first + count);
      return count;
    }
    int const first_region = regions.cell_region(cell);
    for (int pair = begin; pair < pairs.offset(cell + 1); ++pair)
    {
      Region const &region = regions.polygon(first_region + pair - begin);
      for (int i = 0; i < region.size; ++i)
      {
        Vector2 const a = region[i], b = region[region.next(i)];
        int const face = faceOfEdge(frame, a, b);
        if (face >= 0 && isHidden(cell, face, pairs.material(pair)))
          continue;
        Edge const edge = edgeBetween(a, b);
        if (edge.length > frame.tolerance)
          count += edgeSegments(pair, edge, face, frame, blank, count, first + count);
      }
    }
    return count;
  }

  /// Write all segments of a cell from `first` on, as far as there is room; returns their number.
  KOKKOS_INLINE_FUNCTION int cellSegments(int cell, int first) const
  {
    if (isHidden(cell))
      return 0;
    CellFrame const frame = cellFrame(mesh, cell);
    InterfaceSegment const blank = blankSegment(cell, frame);
    int count = regionSegments(frame, blank, first);
    for (int k = 0; k < 4; ++k)
    {
      if (!surface.contactWall(cell, k))
        continue;
      if (first + count < static_cast<int>(segment.extent(0)))
      {
        InterfaceSegment &s = segment(first + count);
        Edge const &face = frame.face[k];
        s = blank;
        s.midpoint = face.start + 0.5 * face.length * face.direction;
        s.point = middleOf(s.midpoint, face.direction, face.length);
        s.normal = -face.normal;
        s.length = face.length;
        s.exposed = 1.0;
        s.parts = 1;
        s.number = count;
        s.pair = s.material = -1;
        s.face = k;
      }
      ++count;
    }
    return count;
  }
};

/// Write the segments of the listed cells one after the other as far as there is room; returns their number.
int writeSegments(SegmentFinder const &finder, View<int *> const &visited, int num_visited, View<int *> const &first)
{
  int count = 0;
  Kokkos::parallel_scan(
      "Harmos::constrain::writeSegments", RangePolicy(0, num_visited),
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        if (final)
          first(i) = sum;
        sum += finder.cellSegments(visited(i), final ? sum : static_cast<int>(finder.segment.extent(0)));
      },
      count);
  return count;
}

} // namespace

InterfaceSegments findInterfaceSegments(Mesh const &mesh, CellMaterialPairs const &pairs,
                                        NodeMaterialPairs const &dof_nodes, FilledRegions const &regions,
                                        BoundaryConditions const &conditions, Placement placement, InterfaceCells *kept,
                                        WorkArrays const &work)
{
  constexpr int usual_segments = 4; // of a cell; where there are more the room is enlarged
  SegmentFinder finder{mesh, pairs, regions, cellSurface(mesh, pairs, conditions), {}, placement};
  InterfaceCells own;
  InterfaceCells &cells = kept != nullptr ? *kept : own;
  listInterfaceCells(finder.surface, dof_nodes, cells, work);
  if (cells.count == 0)
    return {};
  int const num_visited = cells.count;
  View<int *> const visited = cells.cell;
  View<int *> const first = work.unset<int *>("Harmos::constrain::first_segment", num_visited);
  InterfaceSegments result;
  finder.segment = work.unset<InterfaceSegment *>("Harmos::constrain::segment", usual_segments * num_visited);
  result.count = writeSegments(finder, visited, num_visited, first);
  if (result.count > static_cast<int>(finder.segment.extent(0)))
  {
    finder.segment = work.unset<InterfaceSegment *>("Harmos::constrain::segment", result.count);
    writeSegments(finder, visited, num_visited, first);
  }
  int const total = result.count;
  int most = 0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::mostSegments", RangePolicy(0, num_visited),
      KOKKOS_LAMBDA(int i, int &largest) {
        largest = Math::max(largest, (i + 1 < num_visited ? first(i + 1) : total) - first(i));
      },
      Kokkos::Max<int>(most));
  if (num_visited > 0 && most > max_cell_segments)
    throw std::runtime_error("interface segments: " + std::to_string(most) + " in one cell, at most " +
                             std::to_string(max_cell_segments));
  result.segment = finder.segment;
  return result;
}

} // namespace Harmos
