// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONVEX_PIECES_HPP
#define HARMOS_CONVEX_PIECES_HPP

#include <Harmos_Vector.hpp>

#include <vector>

namespace Harmos
{

/// Shoelace area, positive counter-clockwise, coordinates relative to the first point. [m^2]
double polygonArea(std::vector<Vector2> const &points);

/// Throws std::invalid_argument, naming the edges, where two edges of the polygon meet other than at a common corner.
void requireSimple(std::vector<Vector2> const &points);

/// Disjoint convex pieces (as indices, counter-clockwise) whose union is the polygon: itself where it is convex with at
/// most 16 corners, else triangles.
///
/// \param points A simple polygon, counter-clockwise, no two consecutive points equal.
/// Ear clipping: Meisters, Amer. Math. Monthly 82 (1975) 648-651.
std::vector<std::vector<int>> convexPieces(std::vector<Vector2> const &points);

} // namespace Harmos

#endif
