// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CORNER_ROTATION_HPP
#define HARMOS_CORNER_ROTATION_HPP

#include <Harmos_Mesh.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Rotation r of corner numbers between two cells: corner k of `a` points as corner (k + r) % 4 of `b` does.
///
/// The half-index shift carries the velocity of like corners; cells may number theirs from any corner. r maximises
/// sum over k of (x_k - x_mean)_a . (x_{k+r} - x_mean)_b.
KOKKOS_INLINE_FUNCTION int cornerRotation(Mesh const &mesh, int a, int b)
{
  if (a == b)
    return 0;
  Quadrilateral const qa = cellQuadrilateral(mesh, a);
  Quadrilateral const qb = cellQuadrilateral(mesh, b);
  Vector2 const mean = 0.25 * ((qa[0] + qa[1]) + (qa[2] + qa[3])); // any shift of qb drops out of the sum
  int best = 0;
  double most = 0.0;
  for (int r = 0; r < 4; ++r)
  {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
      sum += dot(qa[k] - mean, qb[(k + r) % 4] - qb[0]);
    if (r == 0 || sum > most)
    {
      best = r;
      most = sum;
    }
  }
  return best;
}

} // namespace RemapDetail
} // namespace Harmos

#endif
