// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MEAN_QUADRATURE_HPP
#define HARMOS_MEAN_QUADRATURE_HPP

#include <Harmos_Pack.hpp>

namespace Harmos
{
namespace detail
{

/// A vector at each corner of a quadrilateral (positions, velocities or forces).
template <class T>
struct Corners
{
  T x[4], y[4];
};

/// a + s b
template <class T>
KOKKOS_INLINE_FUNCTION Corners<T> moved(Corners<T> const &a, double s, Corners<T> const &b)
{
  Corners<T> result;
  HARMOS_UNROLL
  for (int k = 0; k < 4; ++k)
  {
    result.x[k] = a.x[k] + s * b.x[k];
    result.y[k] = a.y[k] + s * b.y[k];
  }
  return result;
}

/// Mean gradient of the bilinear shape functions, times the area: area B_I = integral of grad N_I
/// = (y_{I+1} - y_{I-1}, x_{I-1} - x_{I+1}) / 2. Stored for I = 0, 1; B_2 = -B_0, B_3 = -B_1.
template <class T>
struct MeanGradient
{
  T area;
  T x0, y0, x1, y1;
};

template <class T>
KOKKOS_INLINE_FUNCTION MeanGradient<T> meanGradient(Corners<T> const &c)
{
  MeanGradient<T> b;
  b.x0 = 0.5 * (c.y[1] - c.y[3]);
  b.y0 = 0.5 * (c.x[3] - c.x[1]);
  b.x1 = 0.5 * (c.y[2] - c.y[0]);
  b.y1 = 0.5 * (c.x[0] - c.x[2]);
  b.area = (c.x[0] - c.x[2]) * b.x0 + (c.x[1] - c.x[3]) * b.x1;
  return b;
}

/// Area times the mean velocity gradient, xy = area du_x/dy.
template <class T>
struct ScaledVelocityGradient
{
  T xx, xy, yx, yy;
};

template <class T>
KOKKOS_INLINE_FUNCTION ScaledVelocityGradient<T> velocityGradient(MeanGradient<T> const &b, Corners<T> const &v)
{
  T const u0 = v.x[0] - v.x[2];
  T const u1 = v.x[1] - v.x[3];
  T const v0 = v.y[0] - v.y[2];
  T const v1 = v.y[1] - v.y[3];
  return {u0 * b.x0 + u1 * b.x1, u0 * b.y0 + u1 * b.y1, v0 * b.x0 + v1 * b.x1, v0 * b.y0 + v1 * b.y1};
}

/// gamma_I = Gamma_I - (sum_J Gamma_J x_J) . B_I, Gamma = (1, -1, 1, -1): orthogonal to all linear fields.
/// gamma = (1 - g0, -1 - g1, 1 + g0, -1 + g1). Flanagan & Belytschko 1981.
template <class T>
struct HourglassVector
{
  T g0, g1;

  KOKKOS_INLINE_FUNCTION T amplitude(T const (&u)[4]) const
  {
    return ((u[0] - u[1]) + (u[2] - u[3])) - g0 * (u[0] - u[2]) - g1 * (u[1] - u[3]);
  }
};

template <class T>
KOKKOS_INLINE_FUNCTION HourglassVector<T> hourglassVector(MeanGradient<T> const &b, T inverse_area, Corners<T> const &c)
{
  T const hx = ((c.x[0] - c.x[1]) + (c.x[2] - c.x[3])) * inverse_area;
  T const hy = ((c.y[0] - c.y[1]) + (c.y[2] - c.y[3])) * inverse_area;
  return {hx * b.x0 + hy * b.y0, hx * b.x1 + hy * b.y1};
}

/// Squared length of the longer mid-line (joining the middles of opposite edges).
///
/// area / mid-line is the length of the time step: on a parallelogram the altitude, and there the least
/// 2 c / omega over all plane waves, since grad = 2 (p grad xi + q grad eta) with |p| + |q| <= 1.
template <class T>
KOKKOS_INLINE_FUNCTION T longestMidlineSquared(MeanGradient<T> const &b)
{
  T const across_x = b.x1 - b.x0;
  T const across_y = b.y1 - b.y0;
  T const along_x = b.x1 + b.x0;
  T const along_y = b.y1 + b.y0;
  return Math::max(T(across_x * across_x + across_y * across_y), T(along_x * along_x + along_y * along_y));
}

/// Twice the least area of a triangle of three successive corners: <= 0 where the cell is folded or not convex.
template <class T>
KOKKOS_INLINE_FUNCTION T leastCornerArea(Corners<T> const &c)
{
  T ex[4], ey[4];
  HARMOS_UNROLL
  for (int k = 0; k < 4; ++k)
  {
    ex[k] = c.x[(k + 1) % 4] - c.x[k];
    ey[k] = c.y[(k + 1) % 4] - c.y[k];
  }
  T const a0 = ex[3] * ey[0] - ey[3] * ex[0];
  T const a1 = ex[0] * ey[1] - ey[0] * ex[1];
  T const a2 = ex[1] * ey[2] - ey[1] * ex[2];
  T const a3 = ex[2] * ey[3] - ey[2] * ex[3];
  return Math::min(Math::min(a0, a1), Math::min(a2, a3));
}

/// Least distance of a corner from the lines of the two edges that it does not touch.
KOKKOS_INLINE_FUNCTION double leastAltitude(Corners<double> const &c)
{
  double least = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    int const next = (k + 1) % 4;
    double const ex = c.x[next] - c.x[k];
    double const ey = c.y[next] - c.y[k];
    double const inverse = 1.0 / Math::sqrt(ex * ex + ey * ey);
    for (int j = k + 2; j < k + 4; ++j)
    {
      double const distance = (ex * (c.y[j % 4] - c.y[k]) - ey * (c.x[j % 4] - c.x[k])) * inverse;
      least = k == 0 && j == 2 ? distance : Math::min(least, distance);
    }
  }
  return least;
}

} // namespace detail
} // namespace Harmos

#endif
