// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BENT_EDGE_HPP
#define HARMOS_BENT_EDGE_HPP

#include <Harmos_AreaWeight.hpp>
#include <Harmos_Bilinear.hpp>

namespace Harmos
{

/// What the displacements u of an edge's ends and middle weigh in the volume that the edge sweeps, per length: with the
/// edge's normal n and length L the volume is L n . (first u_1 + middle u_m + second u_2), to first order in u.
struct EdgeWeights
{
  double first, middle, second;
};

/// Weights of an edge from a to b whose image runs straight between the images of its ends (bend 0), in two straight
/// pieces through the image of its middle (bend 1), or through a point between, `bend` of the way from the chord's
/// middle. Planar: 1/2, 0, 1/2 and 1/4, 1/2, 1/4. About an axis each straight piece from x_i to x_j has
/// (2 r_i + r_j)/6, (r_i + 2 r_j)/6 of its length.
///
/// \param ring Area weight (planar: one; axisymmetric: the radius) in the frame of a and b. Sum: its mean on the edge.
KOKKOS_INLINE_FUNCTION EdgeWeights edgeWeights(AreaWeight const &ring, Vector2 const &a, Vector2 const &b, double bend)
{
  double const r_a = ring.at(a), r_b = ring.at(b), r_m = 0.5 * (r_a + r_b), straight = 1.0 - bend;
  return {straight * (2.0 * r_a + r_b) / 6.0 + bend * (2.0 * r_a + r_m) / 12.0, 0.5 * bend * r_m,
          straight * (r_a + 2.0 * r_b) / 6.0 + bend * (r_m + 2.0 * r_b) / 12.0};
}

/// How far an edge of a region bends, in a cell of area `cell_area` that is full by `full`. On a cell face, where two
/// shape functions vanish, motion is linear and images are straight.
///
/// \param shortest Length below which an edge stays straight, in cell sizes (ConstraintOptions::shortest_segment): its
///                 traction goes to what is beyond its ends (ShortSegments::Shared), which then is what its moved image
///                 asks for.
/// \param N_middle Shape functions at the edge's middle.
KOKKOS_INLINE_FUNCTION double bendOf(Vector2 const &edge, double cell_area, double full, double shortest,
                                     double const N_middle[4])
{
  constexpr double least = 1e-6; // of a shape function, inside
  bool const inside = Math::min(Math::min(N_middle[0], N_middle[1]), Math::min(N_middle[2], N_middle[3])) > least;
  return inside && dot(edge, edge) >= shortest * shortest * cell_area ? full : 0.0;
}

} // namespace Harmos

#endif
