// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CORNER_SHARES_HPP
#define HARMOS_CORNER_SHARES_HPP

#include <Harmos_Bilinear.hpp>

namespace Harmos
{

/// Parts of a cell's mass that its corners take; they sum to one in every cell.
struct CornerShares
{
  View<double *[4]> part; // empty: a quarter each

  KOKKOS_INLINE_FUNCTION bool quarters() const { return part.extent(0) == 0; }
  KOKKOS_INLINE_FUNCTION double operator()(int cell, int corner) const
  {
    return quarters() ? 0.25 : part(cell, corner);
  }
};

/// Lumped by the shape functions about an axis: share_k = integral of r N_k dA / integral of r dA.
///
/// The integrand is a cubic of either reference coordinate, for which two Gauss points each way are exact. On a
/// rectangle with radii a < b: (2a + b) / (6 (a + b)) inside and (a + 2b) / (6 (a + b)) outside, a sixth and a third at
/// the axis, as an axial stress there splits its force.
/// \param cell Convex, r >= 0 at its corners and not zero at all of them.
KOKKOS_INLINE_FUNCTION void ringShares(Quadrilateral const &cell, double share[4])
{
  double const low = 0.5 - 0.5 / 1.7320508075688772, gauss[2] = {low, 1.0 - low};
  double total = 0.0;
  for (int k = 0; k < 4; ++k)
    share[k] = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    Vector2 const xi{gauss[i % 2], gauss[i / 2]};
    double N[4];
    shapeFunctions(xi, N);
    Vector2 const a = (1.0 - xi[1]) * (cell[1] - cell[0]) + xi[1] * (cell[2] - cell[3]);
    Vector2 const b = (1.0 - xi[0]) * (cell[3] - cell[0]) + xi[0] * (cell[2] - cell[1]);
    double const r = (N[0] * cell[0][0] + N[1] * cell[1][0]) + (N[2] * cell[2][0] + N[3] * cell[3][0]);
    double const weight = r * cross(a, b);
    total += weight;
    for (int k = 0; k < 4; ++k)
      share[k] += weight * N[k];
  }
  for (int k = 0; k < 4; ++k)
    share[k] /= total;
}

} // namespace Harmos

#endif
