// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Borrowed.hpp>
#include <Harmos_BridgedRegion.hpp>
#include <Harmos_EdgePieces.hpp>
#include <Harmos_InterfaceCells.hpp>
#include <Harmos_InterfaceSegments.hpp>
#include <Harmos_Pack.hpp>

#include <stdexcept>

namespace Harmos
{

namespace
{

// Shorter pieces, and distances to a line, count as nothing. [cell sizes]
constexpr double negligible = 1e-8;

/// A cell with the lines of its faces, in columns.
struct CellFrame
{
  static constexpr int room = pack_width > 4 ? pack_width : 4;

  Quadrilateral corner;
  double x[room], y[room], along_x[room], along_y[room], length[room]; // of the faces: start, direction
  double size;                                                         // sqrt of the area
  double tolerance; // shorter pieces, and distances to a line, count as nothing

  KOKKOS_FORCEINLINE_FUNCTION Vector2 direction(int k) const { return {along_x[k], along_y[k]}; }

  KOKKOS_FORCEINLINE_FUNCTION Edge face(int k) const
  {
    return {corner[k], direction(k), -perpendicular(direction(k)), length[k]};
  }

  /// The faces on whose lines a point lies: a bit each.
  KOKKOS_FORCEINLINE_FUNCTION unsigned facesAt(Vector2 const &point) const
  {
    unsigned faces = 0;
    HARMOS_UNROLL
    for (int k = 0; k < 4; k += pack_width)
    {
      Pack const dx = Pack(point[0]) - loadPack(x + k), dy = Pack(point[1]) - loadPack(y + k);
      Pack const apart = Math::fabs(dx * loadPack(along_y + k) - dy * loadPack(along_x + k));
      faces |= lanesOf(apart <= Pack(tolerance)) << k;
    }
    return faces & 15u;
  }
};

KOKKOS_INLINE_FUNCTION CellFrame cellFrame(Mesh const &mesh, int cell)
{
  constexpr double least = 1e-300; // a face without length has no direction
  CellFrame frame;
  frame.corner = cellQuadrilateral(mesh, cell);
  for (int k = 0; k < CellFrame::room; ++k)
  {
    Vector2 const &start = frame.corner[k & 3], along = frame.corner[(k + 1) & 3] - start;
    frame.x[k] = start[0];
    frame.y[k] = start[1];
    frame.along_x[k] = along[0];
    frame.along_y[k] = along[1];
  }
  HARMOS_UNROLL
  for (int k = 0; k < 4; k += pack_width)
  {
    Pack const dx = loadPack(frame.along_x + k), dy = loadPack(frame.along_y + k);
    Pack const length = Math::sqrt(dx * dx + dy * dy), inverse = Pack(1.0) / Math::max(length, Pack(least));
    storePack(frame.length + k, length);
    storePack(frame.along_x + k, inverse * dx);
    storePack(frame.along_y + k, inverse * dy);
  }
  frame.size = Math::sqrt(mesh.cell_area(cell));
  frame.tolerance = negligible * frame.size;
  return frame;
}

/// The cell face that the edge a -> b lies on, with the face's own direction; -1: none.
/// \param faces On whose lines both of its ends lie.
KOKKOS_INLINE_FUNCTION int faceOfEdge(CellFrame const &frame, unsigned faces, Vector2 const &a, Vector2 const &b)
{
  for (int k = 0; faces >> k != 0u; ++k)
    if ((faces >> k & 1u) != 0u && dot(frame.direction(k), b - a) > 0.0)
      return k;
  return -1;
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
    Region const &region = regions.polygon(first + like - pairs.offset(cell));
    if (region.empty())
      return false;
    Vector2 a = region[region.size - 1] - edge.start;
    bool a_near = Math::fabs(dot(a, edge.normal)) <= tolerance;
    for (int i = 0; i < region.size; ++i)
    {
      Vector2 const b = region[i] - edge.start;
      bool const b_near = Math::fabs(dot(b, edge.normal)) <= tolerance;
      if (a_near && b_near)
      {
        double const end = Math::min(dot(a, edge.direction), edge.length);
        double const begin = Math::max(dot(b, edge.direction), 0.0);
        if (end - begin > tolerance) // the only one, if it is whole
          return begin <= tolerance && end >= edge.length - tolerance;
      }
      a = b;
      a_near = b_near;
    }
    return false;
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
    double const exposed = face < 0 ? 1.0 : pieces.total / frame.length[face];
    int const room = static_cast<int>(segment.extent(0));
    int count = 0;
    for (int piece = 0; piece < pieces.count; ++piece)
    {
      double const begin = pieces.begin[piece], length = pieces.end[piece] - begin;
      for (int half = 0; half < points.count; ++half, ++count)
      {
        if (first + count >= room)
          continue;
        InterfaceSegment &s = segment(first + count);
        s.cell_centre = blank.cell_centre;
        s.lattice[0] = blank.lattice[0];
        s.lattice[1] = blank.lattice[1];
        s.cell_size = blank.cell_size;
        s.cell = cell;
        s.length = points.count == 1 ? length : 0.5 * length;
        s.midpoint = edge.start + (begin + (half + 0.5) * s.length) * edge.direction;
        s.point = balancePoint(mesh.geometry, s.midpoint, edge.direction, s.length);
        if (points.count == 2)
          s.point = edge.start + (begin + (half == 0 ? points.inset : 1.0 - points.inset) * length) * edge.direction;
        s.normal = edge.normal;
        s.parts = points.count;
        s.exposed = exposed;
        s.number = number + count;
        s.pair = pair;
        s.material = material;
        s.face = face;
      }
    }
    return count;
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
        if (!isHidden(cell, k, pairs.material(begin)) && frame.length[k] > frame.tolerance)
          count += edgeSegments(begin, frame.face(k), k, frame, blank, count, first + count);
      return count;
    }
    int const first_region = regions.cell_region(cell);
    for (int pair = begin; pair < pairs.offset(cell + 1); ++pair)
    {
      Region const &region = regions.polygon(first_region + pair - begin);
      unsigned const faces_at_first = region.empty() ? 0u : frame.facesAt(region[0]);
      unsigned faces_at_next = faces_at_first;
      for (int i = 0; i < region.size; ++i)
      {
        int const next = region.next(i);
        Vector2 const a = region[i], b = region[next];
        unsigned const faces_at_a = faces_at_next;
        faces_at_next = next == 0 ? faces_at_first : frame.facesAt(b);
        int const face = faceOfEdge(frame, faces_at_a & faces_at_next, a, b);
        if (face >= 0 && isHidden(cell, face, pairs.material(pair)))
          continue;
        Edge const edge = edgeBetween(a, b);
        if (edge.length > frame.tolerance && !(face < 0 && isBridge(region, i)))
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
        Edge const face = frame.face(k);
        s = blank;
        s.midpoint = face.start + 0.5 * face.length * face.direction;
        s.point = balancePoint(mesh.geometry, s.midpoint, face.direction, face.length);
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
  launchScan(
      "Harmos::constrain::writeSegments", num_visited,
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
  InterfaceCells own;
  InterfaceCells &cells = kept != nullptr ? *kept : own;
  CellSurface const surface = cellSurface(mesh, pairs, conditions);
  listInterfaceCells(surface, dof_nodes, cells, work);
  if (cells.count == 0)
    return {};
  CellSurface const its_surface{borrowed(mesh), borrowed(pairs), borrowed(conditions.boundary), surface.walls};
  SegmentFinder finder{its_surface.mesh, its_surface.pairs, borrowed(regions), its_surface, {}, placement};
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
  launchReduce(
      "Harmos::constrain::mostSegments", num_visited,
      KOKKOS_LAMBDA(int i, int &largest) {
        largest = Math::max(largest, (i + 1 < num_visited ? first(i + 1) : total) - first(i));
      },
      Kokkos::Max<int>(most));
  if (num_visited > 0 && most > max_cell_segments)
    throw std::runtime_error("interface segments: " + std::to_string(most) + " in one cell, at most " +
                             std::to_string(max_cell_segments));
  result.segment = finder.segment;
  result.num_cells = num_visited;
  result.cell = visited;
  result.first = first;
  return result;
}

} // namespace Harmos
