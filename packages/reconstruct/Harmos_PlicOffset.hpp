// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PLIC_OFFSET_HPP
#define HARMOS_PLIC_OFFSET_HPP

#include <Harmos_LineCut.hpp>

namespace Harmos
{

struct PlicOffset
{
  double offset;       // [length]; meaningful whether or not converged
  double volume_error; // [length^2]; |volume below the line - target|
  bool converged;
};

/// \brief Place an interface line of known normal so that it cuts off a given volume.
///
/// Finds d with V(d) = | cell ∩ { x : n.x <= d } | = volume in closed form (see lineCut), from whichever side holds the
/// smaller volume.
///
/// \param cell      Convex polygon, counter-clockwise, at least 3 vertices. [length]
/// \param normal    Unit vector that leaves the material.
/// \param volume    Target, in [0, |cell|] (per unit depth in 2-D). [length^2]
/// \param tolerance Largest accepted |V(d) - volume|. [length^2]
/// \return `converged` is false when the target lies outside [0, |cell|] by more than the tolerance.
///
/// Rider & Kothe, J. Comput. Phys. 141 (1998) 112-141.
template <int Capacity>
KOKKOS_INLINE_FUNCTION PlicOffset plicOffset(Polygon<Capacity> const &cell, Vector2 const &normal, double volume,
                                             double tolerance)
{
  double const total = area(cell);
  bool const from_below = volume <= 0.5 * total;
  double const smaller = from_below ? volume : total - volume;
  LineCut const cut = lineCut(cell, from_below ? normal : -normal, smaller);
  PlicOffset result;
  result.offset = from_below ? cut.offset : -cut.offset;
  result.volume_error = Math::fabs(area(partBelow(cell, cut)) - smaller);
  result.converged = result.volume_error <= tolerance;
  return result;
}

} // namespace Harmos

#endif
