// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ROW_BUILDER_HPP
#define HARMOS_ROW_BUILDER_HPP

#include <Harmos_BentEdge.hpp>
#include <Harmos_BondedPlaces.hpp>
#include <Harmos_ContactRows.hpp>
#include <Harmos_CornerContacts.hpp>
#include <Harmos_CurvedGap.hpp>
#include <Harmos_FacingSegments.hpp>
#include <Harmos_Fullness.hpp>
#include <Harmos_LinePoint.hpp>
#include <Harmos_PlannedRows.hpp>
#include <Harmos_SegmentBearing.hpp>
#include <Harmos_SideMotion.hpp>

namespace Harmos
{

struct RowBuilder
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  FilledRegions regions;
  SegmentBearing bearing;
  InterfaceSegments segments;
  View<InterfaceSegment *> segment; // theirs
  View<RayHit *> hit;
  FacingSegments facing;
  BodyTable bodies;
  View<Boundary *> boundary;
  BondedPlaces bonded;
  ConstraintOptions options;
  SegmentBins bins;
  Motion before;
  double dt;
  CornerContacts corners = {};

  KOKKOS_INLINE_FUNCTION int bodyOf(int material) const { return bodies.of(material); }

  KOKKOS_INLINE_FUNCTION bool isSlave(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    constexpr double finer = 0.8;
    if (b.material < 0 || a.cell_size < finer * b.cell_size)
      return true;
    return a.material < b.material && !(b.cell_size < finer * a.cell_size);
  }

  /// Whether two sides are bonded, at a's point.
  KOKKOS_INLINE_FUNCTION bool areBonded(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    return bonded.at(a.point, a.cell_size, a.material, b.material);
  }

  /// Whether one of two sides is a fluid whose pressure acts on all of its outline.
  KOKKOS_INLINE_FUNCTION bool isPressed(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    return bearing.isPressed(a) || bearing.isPressed(b);
  }

  /// Whether the rows between two sides come from their outlines (Harmos_OutlineRows.hpp).
  KOKKOS_INLINE_FUNCTION bool meetByOutline(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    return bodies.outlined && bodyOf(a.material) >= 0 && bodyOf(b.material) != -1 && !areBonded(a, b);
  }

  /// Whether two sides pass each other by so much in this step that no length is too short for a row.
  KOKKOS_INLINE_FUNCTION bool pass(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    if (!(dt > 0.0))
      return false;
    Vector2 const apart = dt * (motionOf(a).at(a.midpoint) - motionOf(b).at(a.midpoint));
    double const least = most_approach * a.cell_size;
    return dot(apart, apart) > least * least;
  }

  KOKKOS_INLINE_FUNCTION double fullnessOf(int cell) const
  {
    return fullness(mesh, pairs, regions, cell, [this](int material) { return bearing.presses(material); });
  }

  /// Whether a segment carries a row for its length, whatever it faces.
  KOKKOS_INLINE_FUNCTION bool isLong(InterfaceSegment const &a) const
  {
    return a.parts * a.length >= options.shortest_segment * a.cell_size;
  }

  /// Whether segment a, which faces b, carries no row for its length. Where tractions are shared its own goes to the
  /// rows at its ends, but where bodies pass each other: what lies still wants few rows, what goes through wants many.
  KOKKOS_INLINE_FUNCTION bool isTooShort(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    if (isLong(a))
      return false;
    return a.parts * a.length < bearing.shortest(a, b, fullnessOf(a.cell)) &&
           !(bearing.balance(a, b) == ShortSegments::Shared && pass(a, b));
  }

  KOKKOS_INLINE_FUNCTION SlipMirrors mirrorsOf(int cell) const { return {mesh, boundary, cell, mirrored_rows}; }

  KOKKOS_INLINE_FUNCTION JoinedSegments joinedSegments() const { return {mesh, segments.count, segment, hit, bearing}; }

  /// Whether segment i carries a row, if its line is long enough.
  KOKKOS_INLINE_FUNCTION bool mayCarryRow(int i) const
  {
    InterfaceSegment const &a = segment(i);
    if (a.material < 0 || hit(i).segment < 0 || mesh.cell_depth(a.cell) != 0)
      return false;
    InterfaceSegment const &b = segment(hit(i).segment);
    if ((exposesLittle(a, options.exposed_face) && !isPressed(a, b) && !liesOnEdge(a, b)) || !isSlave(a, b) ||
        (bodies.driven(bodyOf(a.material)) && bodies.driven(bodyOf(b.material))) || meetByOutline(a, b) ||
        corners.isBorne(segment, i, b.material) ||
        (touches(a, hit(i)) && corners.isBorne(segment, hit(i).segment, a.material)))
      return false;
    return b.material < 0 || haveOwnNodes(a);
  }

  /// In kinematics `single` both sides of an interface move with the same dof nodes.
  KOKKOS_INLINE_FUNCTION bool haveOwnNodes(InterfaceSegment const &a) const
  {
    return dof_nodes.material(pairs.dof_node(a.pair, 0)) != -1;
  }

  /// From a to b, of the wall or the outline of a rigid body that a meets, or is of; zero where there is none.
  KOKKOS_INLINE_FUNCTION Vector2 exactNormal(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    if (b.material < 0)
      return -b.normal;
    int const body_a = bodyOf(a.material), body_b = bodyOf(b.material);
    if (body_b >= 0)
      return -bodies.surfaces.normalAt(body_b, b.midpoint, b.normal, b.cell_size, a.point);
    if (body_a >= 0)
      return bodies.surfaces.normalAt(body_a, a.midpoint, a.normal, a.cell_size, a.point);
    return {0.0, 0.0};
  }

  /// The normal of the row of a segment, or a part of one, that faces another; zero where it carries none. Beside a
  /// fluid each segment is borne along its own normal where none is told by those around it.
  KOKKOS_INLINE_FUNCTION Vector2 rowNormal(InterfaceSegment const &a, int facing_it) const
  {
    InterfaceSegment const &b = segment(facing_it);
    bool const pressed = isPressed(a, b);
    Vector2 n = exactNormal(a, b);
    if (n[0] == 0.0 && n[1] == 0.0)
      n = contactNormal(segment, facing, mirrorsOf(a.cell), options.shortest_segment, a, facing_it, pressed);
    if (dot(a.normal, n) >= fit_least_cosine)
      return n;
    return pressed ? a.normal : Vector2{0.0, 0.0};
  }

  /// Whether a segment of a cell face lies along the wall or the straight edge of a rigid body that it meets.
  KOKKOS_INLINE_FUNCTION bool liesOnEdge(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    constexpr double along = 0.9999; // cosine
    return a.face >= 0 && dot(a.normal, exactNormal(a, b)) >= along;
  }

  /// Whether a segment of a cell face has a row, however small a part of the face it is, where it lies along an
  /// interface that follows the mesh there, and is no step; and however short at walls, edges and between fluids
  /// (beside round solids short ones would be too many, and gas stick to them).
  KOKKOS_INLINE_FUNCTION bool mayLieOnFace(InterfaceSegment const &a, InterfaceSegment const &b, bool is_short) const
  {
    bool const of_a = bearing.isPressed(a), of_b = bearing.isPressed(b);
    return a.face >= 0 && ((of_a && of_b) || (!is_short && (of_a || of_b)) || liesOnEdge(a, b));
  }

  KOKKOS_INLINE_FUNCTION SideMotion motionOf(InterfaceSegment const &s) const
  {
    return sideMotion(mesh, pairs, before, s);
  }

  /// Whether in this step an end of a segment would go through what it faces while its middle is held.
  KOKKOS_INLINE_FUNCTION bool endGoesThrough(InterfaceSegment const &a, RayHit const &to) const
  {
    InterfaceSegment const &b = segment(to.segment);
    if (!(dt > 0.0) || options.placement != Placement::Midpoint || a.parts > 1 || areBonded(a, b))
      return false;
    double const slope = dot(a.normal, b.normal);
    SideMotion const of_a = motionOf(a), of_b = motionOf(b);
    if (dt * mostClosing(of_a, of_b, a.normal) <= most_approach * a.cell_size)
      return false;
    for (double const side : {-0.5, 0.5})
    {
      Vector2 const end = a.midpoint + (side * a.length) * perpendicular(a.normal);
      double const gap = dot(b.midpoint - end, b.normal) / slope; // to the line of b
      double const comes = dt * closingSpeed(of_a, of_b, a.normal, end, gap);
      if (comes <= most_approach * a.cell_size)
        continue;
      double const middle = dt * closingSpeed(of_a, of_b, a.normal, a.midpoint, to.gap);
      if ((to.gap - gap) + (comes - middle) > least_lead * a.cell_size)
        return true;
    }
    return false;
  }

  /// What a segment, or a part of one, meets along its ray; where it is one of few short pieces that lie on each other,
  /// at the rim of a contact or of bodies about to touch, as far away as both sides' arcs are. The free sides of a
  /// body-fitted mesh are no chords, and what is bonded stays so; but bonds are found (dt = 0) where arcs touch.
  KOKKOS_INLINE_FUNCTION RayHit alongArcs(InterfaceSegment const &a, RayHit const &to, Vector2 const &normal) const
  {
    constexpr double longest = 0.5, few = 1.5; // [cells]
    InterfaceSegment const &b = segment(to.segment);
    double const h = a.cell_size;
    bool const fitted = a.face >= 0 && mesh.face_neighbour(a.cell, a.face) < 0;
    if (to.gap > touching_gap * h || a.parts * a.length > longest * h || fitted || b.material < 0 || isPressed(a, b) ||
        (dt > 0.0 && areBonded(a, b)))
      return to;
    SlipMirrors const mirrors = mirrorsOf(a.cell);
    if (touchingLength(facing, mirrors, a, b.material) > few)
      return to;
    return {to.segment, Math::max(to.gap, h * curvedGap(bins, mirrors, a, b.material, normal)), to.cosine};
  }

  KOKKOS_INLINE_FUNCTION void plan(int i, PlannedRows &rows) const
  {
    rows.count = 0;
    rows.joined = false;
    rows.corner = corners.carriedBy(i);
    if (rows.corner >= 0)
      return planCorner(i, rows);
    if (!mayCarryRow(i))
      return;
    JoinedSegments::Line line;
    rows.joined = !exposesLittle(segment(i), options.exposed_face) && joinedSegments().find(i, line);
    if (!rows.joined)
    {
      planAlong(segment(i), hit(i), i, rows);
      return;
    }
    RayHit to = hit(i);
    to.gap = line.gap;
    if (line.carrier == i)
      planAlong(line.whole, to, i, rows);
  }

  /// The row of a corner and a face, which segment i carries.
  KOKKOS_INLINE_FUNCTION void planCorner(int i, PlannedRows &rows) const
  {
    InterfaceSegment const &a = segment(i);
    CornerContact const &contact = corners.contact(rows.corner);
    InterfaceSegment const &face = segment(contact.face);
    if (mesh.cell_depth(a.cell) != 0 || (face.material >= 0 && !haveOwnNodes(a)))
      return;
    rows.count = 1;
    bool const at_wall = face.material < 0;
    Vector2 const &n = contact.normal, corner = contact.foot + contact.gap * n;
    rows.normal[0] = at_wall ? -n : n;
    double gap = at_wall ? contact.gap : gapAboveArc(bins, mirrorsOf(face.cell), face, corner, n, contact.gap);
    InterfaceSegment const &tip = segment(contact.segment);
    if (dt > 0.0 && !cornerRebounds(mesh, boundary, options.interaction, tip, face))
    {
      Vector2 const closing = motionOf(face).at(contact.foot) - motionOf(tip).at(corner);
      gap = closedInStep(gap, dt * dot(closing, n), face.cell_size);
    }
    rows.hit[0] = {at_wall ? contact.face : contact.segment, gap, -dot(face.normal, tip.normal)};
  }

  /// The rows of segment i along `a`: the segment, or the line that it is a piece of.
  KOKKOS_INLINE_FUNCTION void planAlong(InterfaceSegment const &a, RayHit const &to, int i, PlannedRows &rows) const
  {
    InterfaceSegment const &b = segment(to.segment);
    constexpr double along = 0.99; // cosine
    bool const too_short = isTooShort(a, b), on_face = too_short || exposesLittle(a, options.exposed_face);
    if (on_face && !mayLieOnFace(a, b, too_short))
      return;
    rows.hit[0] = to;
    Vector2 const n = rows.normal[0] = rowNormal(a, to.segment);
    if ((n[0] == 0.0 && n[1] == 0.0) || (on_face && dot(a.normal, n) < along))
      return;
    rows.count = 1;
    if (endGoesThrough(a, to))
      planHalves(a, i, rows);
    for (int half = 0; half < rows.count; ++half)
      rows.hit[half] = alongArcs(rows.count == 2 ? halfOf(a, half) : a, rows.hit[half], rows.normal[half]);
  }

  /// Two rows in the place of one, where both halves of the line of segment i carry one.
  KOKKOS_INLINE_FUNCTION void planHalves(InterfaceSegment const &whole, int i, PlannedRows &rows) const
  {
    PlannedRows two = {};
    two.joined = rows.joined;
    for (; two.count < 2; ++two.count)
    {
      InterfaceSegment const s = halfOf(whole, two.count);
      RayHit const to = castRay(mesh, segments, bins, s, i);
      if (to.segment < 0 || segment(to.segment).material != segment(hit(i).segment).material)
        return;
      Vector2 const n = rowNormal(s, to.segment);
      if (n[0] == 0.0 && n[1] == 0.0)
        return;
      two.hit[two.count] = to;
      two.normal[two.count] = n;
    }
    rows = two;
  }

  /// How the traction of a row acts on a side.
  struct Traction
  {
    Vector2 middle;  // of what bears it
    Vector2 half;    // from there to an end; zero: it acts at a point
    double bend;     // of the segment's image in the middle (edgeWeights)
    double share[2]; // lengths of the segments at the ends whose tractions it takes, over its own
  };

  /// Weights by which the volumes on both sides of a segment follow the nodes (edgeWeights), so that rows and the
  /// stress over what a material fills speak of the same change of volume, and the traction acts on the nodes as the
  /// stress does; at a point: the shape functions. Sides that move as a rigid body, or not at all, have none.
  KOKKOS_INLINE_FUNCTION void fillSide(InterfaceSegment const &s, Traction const &traction, int body, int dof[4],
                                       double weight[4]) const
  {
    for (int k = 0; k < 4; ++k)
    {
      weight[k] = 0.0;
      dof[k] = body == -1 ? pairs.dof_node(s.pair, k) : -1;
    }
    if (body != -1)
      return;
    Quadrilateral const q = cellQuadrilateral(mesh, s.cell);
    if (traction.half[0] == 0.0 && traction.half[1] == 0.0)
    {
      shapeFunctionsAt(q, traction.middle, weight);
      return;
    }
    AreaWeight const ring = areaWeight(mesh.geometry, {0.0, 0.0});
    Vector2 const x[3] = {traction.middle - traction.half, traction.middle, traction.middle + traction.half};
    EdgeWeights const own = edgeWeights(ring, x[0], x[2], traction.bend);
    double const part[3] = {own.first + 0.5 * traction.share[0] * ring.at(x[0]), own.middle,
                            own.second + 0.5 * traction.share[1] * ring.at(x[2])};
    double const total = part[0] + part[1] + part[2];
    if (!(total > 0.0)) // on the axis
    {
      shapeFunctionsAt(q, traction.middle, weight);
      return;
    }
    for (int i = 0; i < 3; ++i)
    {
      double N[4];
      shapeFunctionsAt(q, x[i], N);
      for (int k = 0; k < 4; ++k)
        weight[k] += part[i] / total * N[k];
    }
  }

  /// The same of segment i at a corner's contact: as a point of its line, or of the corner itself.
  KOKKOS_INLINE_FUNCTION void fillCorner(CornerContact const &contact, int i, Vector2 const &point, int body,
                                         int dof[4], double weight[4]) const
  {
    InterfaceSegment const &s = segment(i);
    fillSide(s, {point, {0.0, 0.0}, 0.0, {0.0, 0.0}}, body, dof, weight);
    if (body == -1 && (i == contact.face || i == contact.tip))
      linePointWeights(mesh, segments, i, point, fullnessOf(s.cell), options.shortest_segment, weight);
  }

  /// Length of the segment between the same materials that goes on beyond the cell face on which an end of segment a
  /// lies, where it is too short for a row and shares its traction; else zero.
  KOKKOS_INLINE_FUNCTION double shortBeyond(InterfaceSegment const &a, InterfaceSegment const &b,
                                            Vector2 const &end) const
  {
    double const near = options.shortest_segment * a.cell_size;
    Quadrilateral const q = cellQuadrilateral(mesh, a.cell);
    for (int k = 0; k < 4; ++k)
    {
      int const beyond = mesh.face_neighbour(a.cell, k);
      if (beyond < 0 || !isOnFace(q, k, end))
        continue;
      int const cell = beyond / 4;
      for (int i = segments.firstOf(cell); i < segments.count && segment(i).cell == cell; ++i)
      {
        if (segment(i).material != a.material || hit(i).segment < 0 || isLong(segment(i)))
          continue; // no line is shorter than one of its pieces
        JoinedSegments::Line line;
        InterfaceSegment const &s = joinedSegments().find(i, line) ? line.whole : segment(i);
        InterfaceSegment const &faced = segment(hit(i).segment);
        if (faced.material != b.material || bearing.balance(s, faced) != ShortSegments::Shared || !isTooShort(s, faced))
          continue;
        Vector2 const half = (0.5 * s.length) * perpendicular(s.normal);
        Vector2 const from = s.midpoint - half - end, to = s.midpoint + half - end;
        if (Math::min(dot(from, from), dot(to, to)) < near * near)
          return s.length;
      }
    }
    return 0.0;
  }

  /// How the traction of segment a acts: at its point, or over as much of it as its cell is full.
  KOKKOS_INLINE_FUNCTION Traction tractionOf(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    Traction found = {a.point, {0.0, 0.0}, 0.0, {0.0, 0.0}};
    ShortSegments const balance = bearing.balance(a, b);
    if (balance == ShortSegments::Dropped)
      return found;
    double const full = fullnessOf(a.cell);
    double const part = balance == ShortSegments::Kept ? 1.0 : full;
    Vector2 const half = (0.5 * a.length) * perpendicular(a.normal);
    bool const bends = isLong(a);
    if (a.parts == 1 || bends) // halves of a bent segment have its middle as an end
    {
      found.middle = a.point + part * (a.midpoint - a.point);
      found.half = part * half;
      found.bend = a.parts == 1 && bends ? full : 0.0;
    }
    else // the traction of half a straight one is its end's
    {
      Vector2 const end = a.midpoint + (dot(a.point - a.midpoint, half) > 0.0 ? half : -half);
      found.middle = a.point + part * (end - a.point);
    }
    if (balance == ShortSegments::Shared && full > 0.0)
      for (int end = 0; end < 2; ++end)
        found.share[end] =
            full * shortBeyond(a, b, a.midpoint + (end - 0.5) * a.length * perpendicular(a.normal)) / a.length;
    return found;
  }

  /// What acts along the row besides its normal contact.
  KOKKOS_INLINE_FUNCTION void setInteraction(InterfaceSegment const &b, ContactRow &row) const
  {
    row.bond = -1;
    if (b.material < 0)
    {
      Boundary const &wall = boundary(mesh.face_boundary(b.cell, b.face));
      row.friction = wall.friction;
      row.restitution = wall.restitution;
      return;
    }
    PairInteraction const &law = options.interaction(row.material_a, row.material_b);
    row.restitution = law.restitution;
    if (law.kind == Interaction::Friction)
      row.friction = law.friction;
    if (law.kind != Interaction::Bonded || row.gap > bond_gap * Math::sqrt(mesh.cell_area(row.cell_a)))
      return;
    if (law.strength.limited())
    {
      row.bond = bonded.nearest(row.point, Math::sqrt(mesh.cell_area(row.cell_a)), row.material_a, row.material_b);
      row.tied = row.bond >= 0 && !bonded.bonds.bond(row.bond).broken ? 1 : 0;
    }
    else
      row.tied = 1;
  }

  KOKKOS_INLINE_FUNCTION ContactRow makeRow(int i, PlannedRows const &rows, int half) const
  {
    JoinedSegments::Line line;
    InterfaceSegment const &whole = rows.joined && joinedSegments().find(i, line) ? line.whole : segment(i);
    InterfaceSegment a = rows.count == 2 ? halfOf(whole, half) : whole;
    if (rows.corner >= 0)
    {
      CornerContact const &contact = corners.contact(rows.corner);
      a.point = contact.foot + (i == contact.face ? 0.0 : contact.gap) * contact.normal;
    }
    InterfaceSegment const &b = segment(rows.hit[half].segment);
    ContactRow row = {};
    row.key = mesh.cell_global(a.cell) * max_cell_rows + 2 * a.number + half;
    row.material_a = a.material;
    row.material_b = b.material;
    row.body_a = bodyOf(a.material);
    row.body_b = bodyOf(b.material);
    row.cell_a = a.cell;
    row.cell_b = b.cell;
    row.point = a.point;
    row.normal = rows.normal[half];
    row.gap = rows.hit[half].gap;
    row.length = a.length * areaWeight(mesh.geometry, {0.0, 0.0}).at(a.midpoint);
    setInteraction(b, row);
    if (rows.corner >= 0)
    {
      row.tied = 0; // where its face is bonded a corner has no row
      row.bond = -1;
      CornerContact const &contact = corners.contact(rows.corner);
      fillCorner(contact, i, a.point, row.body_a, row.dof_a, row.weight_a);
      Vector2 const corner = contact.foot + contact.gap * contact.normal;
      fillCorner(contact, rows.hit[0].segment, corner, row.body_b, row.dof_b, row.weight_b);
      return row;
    }
    Traction traction = tractionOf(a, b);
    row.length *= 1.0 + 0.5 * (traction.share[0] + traction.share[1]);
    fillSide(a, traction, row.body_a, row.dof_a, row.weight_a);
    traction.middle += row.gap * a.normal;
    fillSide(b, traction, row.body_b, row.dof_b, row.weight_b);
    return row;
  }
};

} // namespace Harmos

#endif
