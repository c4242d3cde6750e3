// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_CornerContacts.hpp>
#include <Harmos_JoinedSegments.hpp>
#include <Harmos_PlannedRows.hpp>
#include <Harmos_SideMotion.hpp>

namespace Harmos
{

namespace
{

constexpr double least_rise = 0.05;   // sine of the angle between face and edge
constexpr double lies_flat = 0.95;    // cosine of that between face and tip
constexpr double straight = 0.95;     // cosine of that between pieces of an edge
constexpr double longest_tip = 0.5;   // that is pressed [cells]
constexpr double shortest_edge = 0.3; // of a corner, and face below it [cells]
constexpr double most_overlap = 0.05; // of the corner with the face, where their cells miss each other [cells]

struct CornerFinder
{
  Mesh mesh;
  CellMaterialPairs pairs;
  InterfaceSegments segments;
  View<InterfaceSegment *> segment; // theirs
  View<RayHit *> hit;
  SegmentBins bins;
  BodyTable bodies;
  SegmentBearing bearing;
  ConstraintOptions options;
  BondedPlaces bonded;
  Motion before;
  double dt;
  View<Boundary *> boundary;

  KOKKOS_INLINE_FUNCTION bool isSolid(int material) const { return material >= 0 && !bearing.presses(material); }

  /// Whether a segment is a step between the lines of two cells rather than an edge of its body.
  KOKKOS_INLINE_FUNCTION bool isStep(InterfaceSegment const &s) const { return exposesLittle(s, options.exposed_face); }

  KOKKOS_INLINE_FUNCTION bool touchesAnother(int i) const { return touches(segment(i), hit(i)); }

  /// Whether segment j begins where segment i ends (side 1), or ends where it begins (0).
  KOKKOS_INLINE_FUNCTION bool follows(int i, int j, int side) const
  {
    constexpr double near = 1e-6; // [cells]
    InterfaceSegment const &a = segment(i), &b = segment(j);
    if (b.material != a.material)
      return false;
    Vector2 const apart = endOf(b, 1 - side) - endOf(a, side);
    return dot(apart, apart) <= near * near * a.cell_size * a.cell_size;
  }

  /// The next segment along the outline, in the same cell or across a face; -1: none.
  /// \param side 1: behind segment i, 0: before it.
  KOKKOS_INLINE_FUNCTION int next(int i, int side = 1) const
  {
    int const cell = segment(i).cell;
    for (int j = i + 1; j < segments.count && segment(j).cell == cell; ++j)
      if (follows(i, j, side))
        return j;
    for (int j = i - 1; j >= 0 && segment(j).cell == cell; --j)
      if (follows(i, j, side))
        return j;
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    Vector2 const end = endOf(segment(i), side);
    for (int k = 0; k < 4; ++k)
    {
      int const beyond = isOnFace(q, k, end) ? mesh.face_neighbour(cell, k) : -1;
      for (int j = beyond >= 0 ? segments.firstOf(beyond / 4) : segments.count;
           j < segments.count && segment(j).cell == beyond / 4; ++j)
        if (follows(i, j, side))
          return j;
    }
    return -1;
  }

  /// How far the outline goes on straight from segment i to one side, that included, as far as it is asked. [cells]
  KOKKOS_INLINE_FUNCTION double straightLength(int i, int side, double enough) const
  {
    constexpr int most_pieces = 6;
    double length = segment(i).length;
    int at = next(i, side);
    for (int pieces = 0; pieces < most_pieces && at >= 0 && at != i && length < enough * segment(i).cell_size; ++pieces)
    {
      if (!isStep(segment(at)))
      {
        if (dot(segment(at).normal, segment(i).normal) < straight)
          break;
        length += segment(at).length;
      }
      at = next(at, side);
    }
    return length / segment(i).cell_size;
  }

  /// Whether a segment is a piece of a face, rather than of what the lines of several cells leave of one.
  KOKKOS_INLINE_FUNCTION bool isPieceOfFace(int f) const
  {
    double const length = segment(f).length / segment(f).cell_size;
    return straightLength(f, 0, shortest_edge) + straightLength(f, 1, shortest_edge) - length >= shortest_edge;
  }

  /// The next segment behind i along the outline that is no step; -1: none.
  KOKKOS_INLINE_FUNCTION int nextEdge(int i) const
  {
    constexpr int most_pieces = 6;
    int at = next(i);
    for (int pieces = 0; pieces < most_pieces && at >= 0 && isStep(segment(at)); ++pieces)
      at = next(at);
    return at;
  }

  /// visit(j) for what lies between segment i and the next edge, which touches nothing: what touches another body, and
  /// pieces too short for an edge beside that.
  /// \return That edge; -1: there is none, or what lies between is longer than a tip.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION int behindTip(int i, Visitor const &visit) const
  {
    constexpr int most_pieces = 6;
    InterfaceSegment const &a = segment(i);
    double length = 0.0;
    bool touched = false;
    int after = nextEdge(i);
    for (int pieces = 0; pieces < most_pieces && after >= 0 && after != i; ++pieces)
    {
      InterfaceSegment const &s = segment(after);
      bool const touching = touchesAnother(after);
      if (isStep(s) || (!touching && dot(a.normal, s.normal) > straight))
        return -1; // the second: the edge itself goes on
      if (!touching && (pieces == 0 || touched) && isLong(after))
        return after;
      length += s.length;
      if (length > longest_tip * a.cell_size)
        return -1;
      visit(after);
      touched = touched || touching;
      after = nextEdge(after);
    }
    return -1;
  }

  /// Whether segment i, or what goes on straight behind it, is long enough for an edge.
  KOKKOS_INLINE_FUNCTION bool isLong(int i) const { return straightLength(i, 1, shortest_edge) >= shortest_edge; }

  /// Where the lines of two edges meet.
  static KOKKOS_INLINE_FUNCTION Vector2 crossingOf(InterfaceSegment const &a, InterfaceSegment const &b)
  {
    Vector2 const along = perpendicular(a.normal);
    return endOf(a, 1) + (dot(b.normal, endOf(b, 0) - endOf(a, 1)) / dot(b.normal, along)) * along;
  }

  KOKKOS_INLINE_FUNCTION bool isRigid(int material) const { return bodies.of(material) >= 0; }

  /// The corner that segment i leads to, without its face; without segment behind it where there is none.
  KOKKOS_INLINE_FUNCTION CornerContact cornerBehind(int i) const
  {
    // Cosines of the turn; chords of discs of three cells' radius turn by less from cell to cell.
    constexpr double in_cell = 0.8, across = 0.6, most_turn = -0.87; // the last: corners of 30 degrees
    InterfaceSegment const &a = segment(i);
    CornerContact corner{-1, {i, -1}, -1, -1, i, {0.0, 0.0}, {0.0, 0.0}, 0.0};
    if (!isSolid(a.material) || isStep(a) || touchesAnother(i))
      return corner;
    int longest = -1;
    int const after = behindTip(i,
                                [&](int j)
                                {
                                  if (touchesAnother(j) && (longest < 0 || segment(j).length > segment(longest).length))
                                    longest = j;
                                });
    if (after < 0)
      return corner;
    InterfaceSegment const &b = segment(after);
    double const turn = dot(a.normal, b.normal);
    if (turn > (a.cell == b.cell ? in_cell : across) || turn < most_turn || !(cross(a.normal, b.normal) > 0.0))
      return corner;
    if (straightLength(i, 0, shortest_edge) < shortest_edge)
      return corner;
    corner.edge[1] = after;
    corner.foot = 0.5 * (endOf(a, 1) + endOf(b, 0));
    if (longest >= 0)
    {
      corner.tip = longest;
      corner.foot = isRigid(a.material) ? crossingOf(a, b) : segment(longest).midpoint;
    }
    corner.segment = corner.tip >= 0 ? corner.tip : b.length > a.length ? after : i;
    return corner;
  }

  /// Whether a corner of a material may stand on face f.
  KOKKOS_INLINE_FUNCTION bool mayBear(int f, int material) const
  {
    InterfaceSegment const &face = segment(f);
    if (face.material == material || isStep(face) || (bodies.of(face.material) != -1 && isRigid(material)))
      return false;
    if (face.material < 0)
      return true;
    return isSolid(face.material) && !bonded.at(face.point, face.cell_size, face.material, material) &&
           (hit(f).segment < 0 || segment(hit(f).segment).material == material);
  }

  KOKKOS_INLINE_FUNCTION SideMotion motionOf(int i) const { return sideMotion(mesh, pairs, before, segment(i)); }

  /// Whether a corner comes so fast that facets are to be held by two rows (most_approach).
  KOKKOS_INLINE_FUNCTION bool comesFast(CornerContact const &contact) const
  {
    if (!(dt > 0.0))
      return false;
    Vector2 const corner = contact.foot + contact.gap * contact.normal;
    Vector2 const apart = motionOf(contact.face).at(contact.foot) - motionOf(contact.segment).at(corner);
    return dt * norm(apart) > most_approach * segment(contact.face).cell_size;
  }

  /// The normal of face f at a point of it.
  KOKKOS_INLINE_FUNCTION Vector2 normalAt(int f, Vector2 const &foot) const
  {
    InterfaceSegment const &face = segment(f);
    if (face.material < 0)
      return face.normal;
    Vector2 n{0.0, 0.0};
    if (isRigid(face.material))
      n = bodies.surfaces.normalAt(bodies.of(face.material), face.midpoint, face.normal, face.cell_size, foot);
    return n[0] == 0.0 && n[1] == 0.0 ? sideNormal(bins, {mesh, boundary, face.cell, mirrored_rows}, face, foot) : n;
  }

  /// Give a corner the nearest face below it, within one cell size. Where a rigid one has made a dent that is the face
  /// beside it, and the row stands in the dent.
  KOKKOS_INLINE_FUNCTION void findFace(CornerContact &contact) const
  {
    InterfaceSegment const &a = segment(contact.edge[0]);
    Vector2 const corner = contact.foot, back = -perpendicular(a.normal);
    Vector2 const on = perpendicular(segment(contact.edge[1]).normal);
    double const h = a.cell_size, reach = h + 0.5 * bins.size;
    bool const dents = contact.tip >= 0 && isRigid(a.material);
    double const beside = dents ? h : 1e-7 * h, deepest = dents ? longest_tip : most_overlap;
    double nearest = h;
    bins.forEach(corner - Vector2{reach, reach}, corner + Vector2{reach, reach},
                 [&](int, BinnedSegment const &s)
                 {
                   if (dot(back, s.normal) < least_rise || dot(on, s.normal) < least_rise ||
                       (contact.tip >= 0 && !dents && dot(segment(contact.tip).normal, s.normal) > -lies_flat))
                     return;
                   Vector2 const apart = corner - s.midpoint;
                   double const gap = dot(apart, s.normal), along = dot(apart, perpendicular(s.normal));
                   double const beyond = Math::max(Math::fabs(along) - 0.5 * s.length, 0.0);
                   if (!(Math::fabs(gap) + beyond < nearest) || gap < -deepest * h || beyond > beside ||
                       !mayBear(s.segment, a.material))
                     return;
                   nearest = Math::fabs(gap) + beyond;
                   contact.face = s.segment;
                   contact.foot = s.midpoint + along * perpendicular(s.normal);
                   contact.gap = Math::max(gap, 0.0);
                 });
    if (contact.face < 0)
      return;
    contact.normal = normalAt(contact.face, contact.foot);
    bool bears = isPieceOfFace(contact.face);
    if (dents)
    {
      int const dented = hit(contact.tip).segment;
      bears = bears && segment(dented).material == segment(contact.face).material;
      contact.face = dented;
      contact.foot = corner;
      contact.gap = 0.0;
    }
    if (!bears || comesFast(contact))
      contact.face = -1;
    contact.carrier = contact.face;
    if (contact.face >= 0 && segment(contact.face).material < 0)
      contact.carrier = contact.segment = contact.tip >= 0 ? contact.tip : contact.edge[0];
  }
};

/// The contacts that segments carry: of several above one face the nearest, of these the first.
void giveToCarriers(CornerFinder const &finder, CornerContacts &corners, WorkArrays const &work)
{
  int const num_segments = finder.segments.count;
  View<double *> const least = work.unset<double *>("Harmos::constrain::corner_gap", num_segments);
  corners.of_carrier = work.unset<int *>("Harmos::constrain::corner_of_carrier", num_segments);
  corners.of_edge = work.unset<int *[2]>("Harmos::constrain::corner_of_edge", num_segments);
  CornerContacts const c = corners;
  launchFor(
      "Harmos::constrain::noCorners", num_segments, KOKKOS_LAMBDA(int i) {
        least(i) = 1e300;
        c.of_carrier(i) = c.count;
        c.of_edge(i, 0) = c.of_edge(i, 1) = -1;
      });
  launchFor(
      "Harmos::constrain::nearestCorners", c.count, KOKKOS_LAMBDA(int k) {
        if (c.contact(k).face >= 0)
          Kokkos::atomic_fetch_min(&least(c.contact(k).carrier), c.contact(k).gap);
      });
  launchFor(
      "Harmos::constrain::cornersOfCarriers", c.count, KOKKOS_LAMBDA(int k) {
        CornerContact const &contact = c.contact(k);
        if (contact.face >= 0 && contact.gap == least(contact.carrier))
          Kokkos::atomic_fetch_min(&c.of_carrier(contact.carrier), k);
      });
  launchFor(
      "Harmos::constrain::cornersOfEdges", c.count, KOKKOS_LAMBDA(int k) {
        CornerContact const &contact = c.contact(k);
        if (contact.face < 0 || c.of_carrier(contact.carrier) != k)
          return;
        c.of_edge(contact.edge[0], 1) = k;
        c.of_edge(contact.edge[1], 0) = k;
        finder.behindTip(contact.edge[0],
                         [&](int j)
                         {
                           if (j == contact.tip || finder.isRigid(finder.segment(j).material) ||
                               !finder.touchesAnother(j))
                             c.of_edge(j, 0) = k;
                         });
      });
}

} // namespace

CornerContacts findCornerContacts(Mesh const &mesh, CellMaterialPairs const &pairs, InterfaceSegments const &segments,
                                  View<RayHit *> const &hit, SegmentBins const &bins, BodyTable const &bodies,
                                  SegmentBearing const &bearing, ConstraintOptions const &options,
                                  BondedPlaces const &bonded, Motion const &before, double dt,
                                  View<Boundary *> const &boundary, WorkArrays const &work)
{
  CornerFinder const finder{mesh,   pairs,   segments, segments.segment, hit,    bins,
                            bodies, bearing, options,  bonded,           before, dt,
                            boundary};
  View<int *> const leading = work.unset<int *>("Harmos::constrain::before_corner", segments.count);
  CornerContacts corners;
  launchScan(
      "Harmos::constrain::findCorners", segments.count,
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        if (finder.cornerBehind(i).edge[1] < 0)
          return;
        if (final)
          leading(sum) = i;
        ++sum;
      },
      corners.count);
  if (corners.count == 0)
    return corners;
  corners.contact = work.unset<CornerContact *>("Harmos::constrain::corner_contact", corners.count);
  View<CornerContact *> const contact = corners.contact;
  launchFor(
      "Harmos::constrain::facesBelowCorners", corners.count, KOKKOS_LAMBDA(int k) {
        contact(k) = finder.cornerBehind(leading(k));
        finder.findFace(contact(k));
      });
  giveToCarriers(finder, corners, work);
  return corners;
}

} // namespace Harmos
