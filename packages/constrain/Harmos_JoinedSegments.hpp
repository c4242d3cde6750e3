// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_JOINED_SEGMENTS_HPP
#define HARMOS_JOINED_SEGMENTS_HPP

#include <Harmos_Bilinear.hpp>
#include <Harmos_RayCast.hpp>
#include <Harmos_SegmentBearing.hpp>

namespace Harmos
{

/// Whether the line of a segment goes on along another one of its cell, behind it (side 1) or before it (0).
KOKKOS_INLINE_FUNCTION bool goesOnAlong(InterfaceSegment const &a, InterfaceSegment const &b, int side)
{
  constexpr double near = 1e-6, straight = 0.9999; // [cells]; cosine
  if (b.material != a.material || dot(a.normal, b.normal) < straight)
    return false;
  if (!((side == 0 ? -1.0 : 1.0) * dot(b.midpoint - a.midpoint, perpendicular(a.normal)) > 0.0))
    return false; // pieces shorter than `near` would each be the next of the other
  Vector2 const apart = endOf(b, 1 - side) - endOf(a, side);
  return dot(apart, apart) <= near * near * a.cell_size * a.cell_size;
}

/// \brief Pieces of one line between two solids through a cell, which carry one row.
///
/// Void of 1e-6 of a cell, which bodies that are strained along each other leave, is a wedge along a part of the line:
/// beyond it the piece faces void, or the line has a bend of 1e-5 there. With a row for each piece the two sides could
/// not turn against each other in that cell, as they can in all others, from the cycle on in which the wedge appears:
/// what they did so was lost, 6% of the energy of blocks that ring in 400 cycles (doc/decisions/0035). A line that ends
/// inside of the cell, at a corner or where three bodies meet, keeps a row for each piece. So do all where tractions do
/// not go over to the rows beside (ShortSegments::Shared: solids whose stress acts over what they fill in full cells).
struct JoinedSegments
{
  Mesh const &mesh;
  int count; // of segments; those of a cell follow each other
  View<InterfaceSegment *> const &segment;
  View<RayHit *> const &hit;
  SegmentBearing const &bearing;

  /// The line that a segment is a piece of.
  struct Line
  {
    InterfaceSegment whole; // of the piece that carries the row, but for where it lies
    int carrier;            // the longest piece, the first of equal ones
    double gap;             // the least of the pieces'; of a row for half of it: what its own ray meets
  };

  /// Whether segment i is one of several pieces of a line through its cell; if so, that.
  KOKKOS_INLINE_FUNCTION bool find(int i, Line &line) const
  {
    if (!mayJoin(i))
      return false;
    Vector2 end[2] = {endOf(segment(i), 0), endOf(segment(i), 1)};
    double longest = segment(i).length;
    int pieces = 1;
    line.carrier = i;
    line.gap = hit(i).gap;
    for (int side = 0; side < 2; ++side)
      for (int j = next(i, side); j >= 0; j = next(j, side))
      {
        ++pieces;
        end[side] = endOf(segment(j), side);
        line.gap = Math::min(line.gap, hit(j).gap);
        if (segment(j).length > longest || (segment(j).length == longest && j < line.carrier))
        {
          longest = segment(j).length;
          line.carrier = j;
        }
      }
    if (pieces == 1 || !isOnFaces(segment(i).cell, end[0]) || !isOnFaces(segment(i).cell, end[1]))
      return false;
    Vector2 const along = end[1] - end[0];
    line.whole = segment(line.carrier);
    line.whole.length = norm(along);
    line.whole.midpoint = 0.5 * (end[0] + end[1]);
    Vector2 const direction = (1.0 / line.whole.length) * along;
    line.whole.normal = -perpendicular(direction);
    line.whole.point = balancePoint(mesh.geometry, line.whole.midpoint, direction, line.whole.length);
    return true;
  }

private:
  KOKKOS_INLINE_FUNCTION bool isOnFaces(int cell, Vector2 const &x) const
  {
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    return isOnFace(q, 0, x) || isOnFace(q, 1, x) || isOnFace(q, 2, x) || isOnFace(q, 3, x);
  }

  KOKKOS_INLINE_FUNCTION bool mayJoin(int i) const
  {
    InterfaceSegment const &a = segment(i);
    if (bearing.placement != Placement::Midpoint || a.parts != 1 || a.face >= 0 || a.material < 0 ||
        hit(i).segment < 0 || hit(i).gap > touching_gap * a.cell_size)
      return false;
    return bearing.balance(a, segment(hit(i).segment)) == ShortSegments::Shared;
  }

  /// The piece that goes on where piece i ends, on one side; -1: none.
  KOKKOS_INLINE_FUNCTION int next(int i, int side) const
  {
    InterfaceSegment const &a = segment(i);
    auto const goesOn = [&](int j)
    {
      return goesOnAlong(a, segment(j), side) && mayJoin(j) &&
             segment(hit(j).segment).material == segment(hit(i).segment).material;
    };
    for (int j = i + 1; j < count && segment(j).cell == a.cell; ++j)
      if (goesOn(j))
        return j;
    for (int j = i - 1; j >= 0 && segment(j).cell == a.cell; --j)
      if (goesOn(j))
        return j;
    return -1;
  }
};

} // namespace Harmos

#endif
