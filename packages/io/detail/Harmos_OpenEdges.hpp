// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_OPEN_EDGES_HPP
#define HARMOS_OPEN_EDGES_HPP

#include <Harmos_Polygon.hpp>

#include <vector>

namespace Harmos
{

/// A part of an edge of a filled region, in its parameter: 0 at the edge's begin, 1 at its end.
struct EdgePart
{
  double begin, end;
  int material; // that lies on the other side
};

/// The parts of the directed edge a->b (its region to the left) that the edges of another region cover.
///
/// An edge covers where it runs against a->b, is parallel to it and lies within `tolerance` of it. Lengths in metres.
void addCoveredParts(Vector2 const &a, Vector2 const &b, Region const &other, int material, double tolerance,
                     std::vector<EdgePart> &parts);

/// What is left of [0, 1], with material -1. \param parts Any order, may overlap.
std::vector<EdgePart> uncoveredParts(std::vector<EdgePart> parts, double least);

} // namespace Harmos

#endif
