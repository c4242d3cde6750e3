// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_InterfaceSegments.hpp>

#include <stdexcept>

namespace Harmos
{

namespace
{

// Shorter pieces, and distances to a line, count as nothing. [cell sizes]
constexpr double negligible = 1e-8;

// Distance of a free face's two points from its corners, part of its length: Gauss points. Nearer to the corners they
// condition the rows better, but let a corner of the other body sink deeper between them.
constexpr double gauss_point = 0.21132486540518713;

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

  KOKKOS_INLINE_FUNCTION Edge(Vector2 const &a, Vector2 const &b)
      : start(a), direction(b - a), normal{0.0, 0.0}, length(norm(direction))
  {
    if (length > 0.0)
      direction *= 1.0 / length;
    normal = -perpendicular(direction);
  }
};

/// Add the intervals of an edge that a region's edges touch from the other side.
KOKKOS_INLINE_FUNCTION void addCover(Edge const &edge, Region const &region, int material, double tolerance,
                                     EdgeCovers &covers)
{
  for (int i = 0; i < region.size && covers.count < max_covers; ++i)
  {
    Vector2 const a = region[i] - edge.start;
    Vector2 const b = region[region.next(i)] - edge.start;
    double const end = Math::min(dot(a, edge.direction), edge.length);
    double const begin = Math::max(dot(b, edge.direction), 0.0);
    if (end - begin <= tolerance || Math::fabs(dot(a, edge.normal)) > tolerance ||
        Math::fabs(dot(b, edge.normal)) > tolerance)
      continue;
    covers.begin[covers.count] = begin;
    covers.end[covers.count] = end;
    covers.material[covers.count++] = material;
  }
}

/// The cell face that an edge lies on, with the face's own direction; -1: none.
KOKKOS_INLINE_FUNCTION int faceOfEdge(Quadrilateral const &cell, Edge const &edge, double tolerance)
{
  Vector2 const end = edge.start + edge.length * edge.direction;
  for (int k = 0; k < 4; ++k)
  {
    Edge const face(cell[k], cell[(k + 1) % 4]);
    if (dot(face.direction, edge.direction) > 0.0 &&
        Math::fabs(dot(edge.start - face.start, face.normal)) <= tolerance &&
        Math::fabs(dot(end - face.start, face.normal)) <= tolerance)
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

KOKKOS_INLINE_FUNCTION EdgePieces exposedPieces(double length, EdgeCovers const &covers, int material, double tolerance)
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
  EdgePieces pieces;
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
  return pieces;
}

/// Both halves of a free face of a body-fitted mesh. With one point a face, corners that sink and rise by turns satisfy
/// every row: nothing but the stiffness of long cells would hold them. Two points leave no such motion.
KOKKOS_INLINE_FUNCTION EdgePieces halves(double length)
{
  EdgePieces pieces;
  pieces.count = 2;
  pieces.total = length;
  pieces.end[0] = pieces.begin[1] = 0.5 * length;
  pieces.begin[0] = 0.0;
  pieces.end[1] = length;
  return pieces;
}

/// Counts, or writes, the segments of single cells.
struct SegmentFinder
{
  Mesh mesh;
  CellMaterialPairs pairs;
  FilledRegions regions;
  View<Boundary *> boundary;
  View<InterfaceSegment *> segment;

  KOKKOS_INLINE_FUNCTION bool contactWall(int cell, int face) const
  {
    int const b = mesh.face_boundary(cell, face);
    return b >= 0 && boundary(b).kind == BoundaryKind::ContactWall;
  }

  /// False where no segment can lie: a pure cell among its like, void away from contact walls.
  KOKKOS_INLINE_FUNCTION bool visits(int cell) const
  {
    if (mesh.halo > 0 && mesh.cell_depth(cell) >= mesh.halo)
      return false;
    int const kind = pairs.cell_kind(cell);
    if (kind == MixedCell)
      return true;
    for (int k = 0; k < 4; ++k)
    {
      int const across = mesh.face_neighbour(cell, k);
      if (across < 0)
      {
        if (contactWall(cell, k) || (kind == PureCell && mesh.face_boundary(cell, k) < 0))
          return true;
      }
      else if (kind == PureCell && !pureOf(across / 4, pairs.material(pairs.offset(cell))))
        return true;
    }
    return false;
  }

  KOKKOS_INLINE_FUNCTION bool pureOf(int cell, int material) const
  {
    return pairs.cell_kind(cell) == PureCell && pairs.material(pairs.offset(cell)) == material;
  }

  KOKKOS_INLINE_FUNCTION void coverBy(int cell, int except, Edge const &edge, double tolerance,
                                      EdgeCovers &covers) const
  {
    for (int other = pairs.offset(cell); other < pairs.offset(cell + 1); ++other)
      if (other != except)
        addCover(edge, regions.region(mesh, pairs, other), pairs.material(other), tolerance, covers);
  }

  /// Segments of one edge; returns their number; writes them from `first` on when first >= 0.
  KOKKOS_INLINE_FUNCTION int edgeSegments(int pair, Edge const &edge, Quadrilateral const &cell_shape, double cell_size,
                                          int number, int first) const
  {
    int const cell = pairs.cell(pair);
    int const material = pairs.material(pair);
    double const tolerance = negligible * cell_size;
    int const face = faceOfEdge(cell_shape, edge, tolerance);
    EdgeCovers covers;
    if (face < 0)
      coverBy(cell, pair, edge, tolerance, covers);
    else
    {
      int const across = mesh.face_neighbour(cell, face);
      if (across >= 0 ? pureOf(across / 4, material) : mesh.face_boundary(cell, face) >= 0 && !contactWall(cell, face))
        return 0;
      if (across >= 0)
        coverBy(across / 4, -1, edge, tolerance, covers);
    }
    bool const free = face >= 0 && mesh.face_neighbour(cell, face) < 0 && mesh.face_boundary(cell, face) < 0;
    EdgePieces const pieces = free ? halves(edge.length) : exposedPieces(edge.length, covers, material, tolerance);
    if (first < 0)
      return pieces.count;
    double const exposed = face < 0 ? 1.0 : pieces.total / norm(cell_shape[(face + 1) % 4] - cell_shape[face]);
    for (int i = 0; i < pieces.count; ++i)
    {
      InterfaceSegment s = emptySegment(cell, cell_shape, cell_size);
      s.midpoint = edge.start + 0.5 * (pieces.begin[i] + pieces.end[i]) * edge.direction;
      s.point =
          free ? edge.start + (i == 0 ? gauss_point : 1.0 - gauss_point) * edge.length * edge.direction : s.midpoint;
      s.normal = edge.normal;
      s.length = pieces.end[i] - pieces.begin[i];
      s.exposed = exposed;
      s.number = number + i;
      s.pair = pair;
      s.material = material;
      s.face = face;
      segment(first + i) = s;
    }
    return pieces.count;
  }

  static KOKKOS_INLINE_FUNCTION InterfaceSegment emptySegment(int cell, Quadrilateral const &q, double cell_size)
  {
    InterfaceSegment s = {};
    Vector2 const e1 = 0.5 * ((q[1] - q[0]) + (q[2] - q[3]));
    Vector2 const e2 = 0.5 * ((q[3] - q[0]) + (q[2] - q[1]));
    double const det = cross(e1, e2);
    s.cell_centre = 0.25 * ((q[0] + q[1]) + (q[2] + q[3]));
    s.lattice[0] = (-1.0 / det) * perpendicular(e2);
    s.lattice[1] = (1.0 / det) * perpendicular(e1);
    s.cell_size = cell_size;
    s.cell = cell;
    return s;
  }

  /// All segments of a cell; returns their number; writes them from `first` on when first >= 0.
  KOKKOS_INLINE_FUNCTION int cellSegments(int cell, int first) const
  {
    Quadrilateral const shape = cellQuadrilateral(mesh, cell);
    double const cell_size = Math::sqrt(mesh.cell_area(cell));
    int count = 0;
    for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
    {
      Region const region = regions.region(mesh, pairs, pair);
      for (int i = 0; i < region.size; ++i)
      {
        Edge const edge(region[i], region[region.next(i)]);
        if (edge.length > negligible * cell_size)
          count += edgeSegments(pair, edge, shape, cell_size, count, first < 0 ? first : first + count);
      }
    }
    for (int k = 0; k < 4; ++k)
    {
      if (!contactWall(cell, k))
        continue;
      Edge const face(shape[k], shape[(k + 1) % 4]);
      if (first >= 0)
      {
        InterfaceSegment s = emptySegment(cell, shape, cell_size);
        s.point = s.midpoint = face.start + 0.5 * face.length * face.direction;
        s.normal = -face.normal;
        s.length = face.length;
        s.exposed = 1.0;
        s.number = count;
        s.pair = s.material = -1;
        s.face = k;
        segment(first + count) = s;
      }
      ++count;
    }
    return count;
  }
};

} // namespace

InterfaceSegments findInterfaceSegments(Mesh const &mesh, CellMaterialPairs const &pairs, FilledRegions const &regions,
                                        BoundaryConditions const &conditions)
{
  SegmentFinder finder{mesh, pairs, regions, conditions.boundary, {}};
  View<int *> const place("Harmos::constrain::place", mesh.num_cells);
  int num_visited = 0;
  Kokkos::parallel_scan(
      "Harmos::constrain::countInterfaceCells", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum, bool final) {
        int const visited = finder.visits(cell) ? 1 : 0;
        if (final)
          place(cell) = visited ? sum : -1;
        sum += visited;
      },
      num_visited);
  View<int *> const visited("Harmos::constrain::interface_cell", num_visited);
  View<int *> const first("Harmos::constrain::first_segment", num_visited);
  Kokkos::parallel_for(
      "Harmos::constrain::listInterfaceCells", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        if (place(cell) >= 0)
          visited(place(cell)) = cell;
      });
  int most = 0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::countSegments", RangePolicy(0, num_visited),
      KOKKOS_LAMBDA(int i, int &largest) {
        first(i) = finder.cellSegments(visited(i), -1);
        largest = Math::max(largest, first(i));
      },
      Kokkos::Max<int>(most));
  if (num_visited > 0 && most > max_cell_segments)
    throw std::runtime_error("interface segments: " + std::to_string(most) + " in one cell, at most " +
                             std::to_string(max_cell_segments));
  InterfaceSegments result;
  Kokkos::parallel_scan(
      "Harmos::constrain::scanSegments", RangePolicy(0, num_visited),
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        int const count = first(i);
        if (final)
          first(i) = sum;
        sum += count;
      },
      result.count);
  result.segment = View<InterfaceSegment *>(
      Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::segment"), result.count);
  finder.segment = result.segment;
  Kokkos::parallel_for(
      "Harmos::constrain::writeSegments", RangePolicy(0, num_visited),
      KOKKOS_LAMBDA(int i) { finder.cellSegments(visited(i), first(i)); });
  return result;
}

} // namespace Harmos
