// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LINE_POINT_HPP
#define HARMOS_LINE_POINT_HPP

#include <Harmos_BentEdge.hpp>
#include <Harmos_JoinedSegments.hpp>

namespace Harmos
{

/// Weights by which a point of a body's line through a cell follows the nodes, as the image of the line does that the
/// change of the body's volume goes by: straight between the images a, b of its ends, and bent towards that of its
/// middle as far as the cell is full. At s from 0 to 1
///
///   w = (1 - s) N(a) + s N(b) + bend (1 - |1 - 2 s|) (N(m) - (N(a) + N(b)) / 2).
///
/// A node that does not move what a material fills has no stress that could hold it: with N at the point a corner threw
/// the light node before a face out of its way, and went in without force (doc/decisions/0038). The weights add to one
/// and give the point's place, so that forces there keep momentum and angular momentum.
///
/// \param i      A piece of the line. \param full Part of the cell that is filled.
/// \param shortest Length below which a line stays straight (bendOf). [cells]
KOKKOS_INLINE_FUNCTION void linePointWeights(Mesh const &mesh, InterfaceSegments const &segments, int i,
                                             Vector2 const &point, double full, double shortest, double weight[4])
{
  View<InterfaceSegment *> const &segment = segments.segment;
  int const cell = segment(i).cell;
  auto const next = [&](int of, int side)
  {
    for (int j = segments.firstOf(cell); j < segments.count && segment(j).cell == cell; ++j)
      if (goesOnAlong(segment(of), segment(j), side))
        return j;
    return -1;
  };
  Vector2 end[2];
  for (int side = 0; side < 2; ++side)
  {
    int last = i;
    for (int j = next(i, side); j >= 0; j = next(j, side))
      last = j;
    end[side] = endOf(segment(last), side);
  }
  Vector2 const middle = 0.5 * (end[0] + end[1]), half = 0.5 * (end[1] - end[0]);
  Quadrilateral const q = cellQuadrilateral(mesh, cell);
  double first[4], of_middle[4], second[4];
  shapeFunctionsAt(q, end[0], first);
  shapeFunctionsAt(q, middle, of_middle);
  shapeFunctionsAt(q, end[1], second);
  double const along = dot(point - middle, half) / dot(half, half), tent = Math::max(0.0, 1.0 - Math::fabs(along));
  double const bend = bendOf(half + half, mesh.cell_area(cell), full, shortest, of_middle);
  for (int k = 0; k < 4; ++k)
  {
    double const straight = 0.5 * (first[k] + second[k]);
    weight[k] = straight + 0.5 * along * (second[k] - first[k]) + tent * bend * (of_middle[k] - straight);
  }
}

} // namespace Harmos

#endif
