// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BILINEAR_HPP
#define HARMOS_BILINEAR_HPP

#include <Harmos_Polygon.hpp>

namespace Harmos
{

using Quadrilateral = Polygon<4>;

/// Bilinear shape functions N_I at reference coordinates (xi, eta) in [0, 1]^2, corners counter-clockwise from (0, 0).
KOKKOS_INLINE_FUNCTION void shapeFunctions(Vector2 const &xi, double N[4])
{
  N[0] = (1.0 - xi[0]) * (1.0 - xi[1]);
  N[1] = xi[0] * (1.0 - xi[1]);
  N[2] = xi[0] * xi[1];
  N[3] = (1.0 - xi[0]) * xi[1];
}

/// The same iteration where the derivatives do not change: its second step corrects round-off of the first.
KOKKOS_INLINE_FUNCTION Vector2 parallelogramCoordinates(Vector2 const &e1, Vector2 const &e2, Vector2 const &d)
{
  double const det = cross(e1, e2), inverse = det != 0.0 ? 1.0 / det : 0.0;
  Vector2 xi{0.5, 0.5};
  for (int i = 0; i < 20; ++i)
  {
    Vector2 const residual = d - (xi[0] * e1 + xi[1] * e2);
    Vector2 const step{inverse * cross(residual, e2), inverse * cross(e1, residual)};
    xi += step;
    if (Math::fabs(step[0]) + Math::fabs(step[1]) < 1e-15)
      break;
  }
  return xi;
}

/// Reference coordinates of a point: Newton's iteration on x(xi) = point from the centre, at most 20 steps.
///
/// Exact after one step on parallelograms. Points slightly outside give coordinates slightly outside [0, 1]; nothing
/// is clamped. Converges for every point of a convex quadrilateral.
KOKKOS_INLINE_FUNCTION Vector2 referenceCoordinates(Quadrilateral const &cell, Vector2 const &point)
{
  Vector2 const e1 = cell[1] - cell[0];
  Vector2 const e2 = cell[3] - cell[0];
  Vector2 const twist = (cell[0] - cell[1]) + (cell[2] - cell[3]);
  Vector2 const d = point - cell[0];
  if (twist[0] == 0.0 && twist[1] == 0.0)
    return parallelogramCoordinates(e1, e2, d);
  double const scale = Math::fabs(cross(e1, e2)) + Math::fabs(cross(twist, e2)) + Math::fabs(cross(e1, twist));
  Vector2 xi{0.5, 0.5};
  for (int i = 0; i < 20; ++i)
  {
    Vector2 const residual = d - (xi[0] * e1 + xi[1] * e2 + (xi[0] * xi[1]) * twist);
    Vector2 const a = e1 + xi[1] * twist;
    Vector2 const b = e2 + xi[0] * twist;
    double const det = cross(a, b);
    if (Math::fabs(det) <= 1e-14 * scale)
      break;
    Vector2 const step{cross(residual, b) / det, cross(a, residual) / det};
    xi += step;
    if (Math::fabs(step[0]) + Math::fabs(step[1]) < 1e-15)
      break;
  }
  return xi;
}

/// Shape functions of a cell at a physical point.
KOKKOS_INLINE_FUNCTION void shapeFunctionsAt(Quadrilateral const &cell, Vector2 const &point, double N[4])
{
  shapeFunctions(referenceCoordinates(cell, point), N);
}

/// Whether a point of a cell lies on its face k.
KOKKOS_INLINE_FUNCTION bool isOnFace(Quadrilateral const &q, int k, Vector2 const &x)
{
  constexpr double distance = 1e-6; // in lengths of the face
  Vector2 const face = q[(k + 1) % 4] - q[k];
  return Math::fabs(cross(face, x - q[k])) <= distance * dot(face, face);
}

} // namespace Harmos

#endif
