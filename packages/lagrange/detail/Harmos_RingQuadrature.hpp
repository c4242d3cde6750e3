// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RING_QUADRATURE_HPP
#define HARMOS_RING_QUADRATURE_HPP

#include <Harmos_AreaWeight.hpp>
#include <Harmos_Strength.hpp>
#include <detail/Harmos_MeanQuadrature.hpp>

#include <type_traits>

namespace Harmos
{
namespace detail
{

/// Mean gradients over the ring that a quadrilateral sweeps, per radian, all integrals exact, x = r and y = z:
///   x_I = integral of r dN_I/dr dA, y_I = integral of r dN_I/dz dA, hoop_I = integral of N_I dA, V = sum hoop_I r_I.
/// (x_I + hoop_I, y_I) = dV/dx_I, so that V tr D = dV/dt; sum x_I = sum y_I = 0: no net axial force.
template <class T>
struct RingGradient
{
  MeanGradient<T> plane;
  T volume;
  T x[4], y[4], hoop[4];
};

template <class T>
KOKKOS_INLINE_FUNCTION RingGradient<T> ringGradient(Corners<T> const &c)
{
  RingGradient<T> b;
  b.plane = meanGradient(c);
  T const double_area = 2.0 * b.plane.area;
  // the Jacobian at the corners, linear over the cell: opposite ones sum to twice the area
  T jacobian[4];
  jacobian[0] = (c.x[1] - c.x[0]) * (c.y[3] - c.y[0]) - (c.x[3] - c.x[0]) * (c.y[1] - c.y[0]);
  jacobian[1] = (c.x[2] - c.x[1]) * (c.y[0] - c.y[1]) - (c.x[0] - c.x[1]) * (c.y[2] - c.y[1]);
  jacobian[2] = double_area - jacobian[0];
  jacobian[3] = double_area - jacobian[1];
  b.volume = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    int const next = (k + 1) % 4, last = (k + 3) % 4;
    b.hoop[k] = (jacobian[k] + double_area) * (1.0 / 12.0);
    b.volume += b.hoop[k] * c.x[k];
    T const both = c.x[last] + c.x[next] + c.x[k];
    b.y[k] = (c.x[last] - c.x[next]) * both * (1.0 / 6.0);
    T const ahead = (c.y[next] - c.y[k]) * (2.0 * c.x[k] + c.x[next]);
    T const behind = (c.y[k] - c.y[last]) * (2.0 * c.x[k] + c.x[last]);
    b.x[k] = (ahead + behind) * (1.0 / 6.0) - b.hoop[k];
  }
  return b;
}

/// What a cell's mean gradients are in a geometry.
template <Geometry geometry, class T>
KOKKOS_INLINE_FUNCTION auto cellGradient(Corners<T> const &c)
{
  if constexpr (geometry == Geometry::Planar)
    return meanGradient(c);
  else
    return ringGradient(c);
}

template <class T>
KOKKOS_INLINE_FUNCTION MeanGradient<T> const &planeOf(MeanGradient<T> const &b)
{
  return b;
}
template <class T>
KOKKOS_INLINE_FUNCTION MeanGradient<T> const &planeOf(RingGradient<T> const &b)
{
  return b.plane;
}
template <class T>
KOKKOS_INLINE_FUNCTION T const &volumeOf(MeanGradient<T> const &b)
{
  return b.area;
}
template <class T>
KOKKOS_INLINE_FUNCTION T const &volumeOf(RingGradient<T> const &b)
{
  return b.volume;
}

/// Volume times the mean velocity gradient of a ring, with u_r / r.
template <class T>
struct ScaledRingVelocityGradient : ScaledVelocityGradient<T>
{
  T hoop;
};

template <class T>
KOKKOS_INLINE_FUNCTION ScaledRingVelocityGradient<T> velocityGradient(RingGradient<T> const &b, Corners<T> const &v)
{
  ScaledRingVelocityGradient<T> g;
  g.xx = g.xy = g.yx = g.yy = g.hoop = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    g.xx += b.x[k] * v.x[k];
    g.xy += b.y[k] * v.x[k];
    g.yx += b.x[k] * v.y[k];
    g.yy += b.y[k] * v.y[k];
    g.hoop += b.hoop[k] * v.x[k];
  }
  return g;
}

/// Volume times the trace.
template <class T>
KOKKOS_INLINE_FUNCTION T traceOf(ScaledVelocityGradient<T> const &g)
{
  return g.xx + g.yy;
}
template <class T>
KOKKOS_INLINE_FUNCTION T traceOf(ScaledRingVelocityGradient<T> const &g)
{
  return g.xx + g.yy + g.hoop;
}

/// Minus a stress times the force volume over the cell's volume.
template <class T>
struct ScaledStress
{
  T xx, yy, xy, hoop;
};

/// Forces on the nodes of a uniform stress, and the hourglass resistance (hx, hy) along gamma.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION Corners<T> stressForces(MeanGradient<T> const &b, ScaledStress<T> const &s,
                                                    HourglassVector<T> const &gamma, T const &hx, T const &hy)
{
  T const fx0 = b.x0 * s.xx + b.y0 * s.xy + hx * gamma.g0;
  T const fy0 = b.x0 * s.xy + b.y0 * s.yy + hy * gamma.g0;
  T const fx1 = b.x1 * s.xx + b.y1 * s.xy + hx * gamma.g1;
  T const fy1 = b.x1 * s.xy + b.y1 * s.yy + hy * gamma.g1;
  return {{fx0 - hx, fx1 + hx, -fx0 - hx, hx - fx1}, {fy0 - hy, fy1 + hy, -fy0 - hy, hy - fy1}};
}
template <class T>
KOKKOS_FORCEINLINE_FUNCTION Corners<T> stressForces(RingGradient<T> const &b, ScaledStress<T> const &s,
                                                    HourglassVector<T> const &gamma, T const &hx, T const &hy)
{
  T const along[4] = {gamma.g0 - 1.0, gamma.g1 + 1.0, -1.0 - gamma.g0, 1.0 - gamma.g1}; // - gamma_I
  Corners<T> f;
  for (int k = 0; k < 4; ++k)
  {
    f.x[k] = b.x[k] * s.xx + b.y[k] * s.xy + b.hoop[k] * s.hoop + hx * along[k];
    f.y[k] = b.x[k] * s.xy + b.y[k] * s.yy + hy * along[k];
  }
  return f;
}

/// A cell's motion through a step: volumes before, in the middle and after; the gradient at mid-step.
template <class T, class Gradient>
struct StepMotion
{
  T volume_n, volume_mid, volume_np1;
  Gradient gradient; // times volume_mid
  MeanGradient<T> plane_np1;
};

/// Planar. Positions move in a straight line, so that the mid-step gradient is the mean of both ends; its area is not.
template <Geometry geometry, class T, std::enable_if_t<geometry == Geometry::Planar, int> = 0>
KOKKOS_FORCEINLINE_FUNCTION StepMotion<T, ScaledVelocityGradient<T>>
stepMotion(Corners<T> const &x, Corners<T> const &x_np1, Corners<T> const &v)
{
  MeanGradient<T> const b_n = meanGradient(x);
  MeanGradient<T> const b_np1 = meanGradient(x_np1);
  MeanGradient<T> b;
  b.x0 = 0.5 * (b_n.x0 + b_np1.x0);
  b.y0 = 0.5 * (b_n.y0 + b_np1.y0);
  b.x1 = 0.5 * (b_n.x1 + b_np1.x1);
  b.y1 = 0.5 * (b_n.y1 + b_np1.y1);
  T const mid_x02 = 0.5 * ((x.x[0] - x.x[2]) + (x_np1.x[0] - x_np1.x[2]));
  T const mid_x13 = 0.5 * ((x.x[1] - x.x[3]) + (x_np1.x[1] - x_np1.x[3]));
  b.area = mid_x02 * b.x0 + mid_x13 * b.x1;
  return {b_n.area, b.area, b_np1.area, velocityGradient(b, v), b_np1};
}

/// Axisymmetric: the gradient at the mid-step positions. The volume is a cubic of time, so that its change is that
/// gradient's trace times dt to third order only; the specific volume follows the volumes themselves.
template <Geometry geometry, class T, std::enable_if_t<geometry == Geometry::Axisymmetric, int> = 0>
KOKKOS_FORCEINLINE_FUNCTION StepMotion<T, ScaledRingVelocityGradient<T>>
stepMotion(Corners<T> const &x, Corners<T> const &x_np1, Corners<T> const &v)
{
  Corners<T> middle;
  for (int k = 0; k < 4; ++k)
  {
    middle.x[k] = 0.5 * (x.x[k] + x_np1.x[k]);
    middle.y[k] = 0.5 * (x.y[k] + x_np1.y[k]);
  }
  RingGradient<T> const b = ringGradient(middle);
  RingGradient<T> const b_np1 = ringGradient(x_np1);
  return {ringGradient(x).volume, b.volume, b_np1.volume, velocityGradient(b, v), b_np1.plane};
}

/// Strain increment of a step for the deviator: in a ring less the hoop strain on all axes, which leaves the deviator
/// as it is and the hoop component zero.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION StrainIncrement<T> strainIncrement(ScaledVelocityGradient<T> const &g, T const &step)
{
  return {step * g.xx, step * g.yy, (0.5 * step) * (g.xy + g.yx)};
}
template <class T>
KOKKOS_FORCEINLINE_FUNCTION StrainIncrement<T> strainIncrement(ScaledRingVelocityGradient<T> const &g, T const &step)
{
  return {step * (g.xx - g.hoop), step * (g.yy - g.hoop), (0.5 * step) * (g.xy + g.yx)};
}

} // namespace detail
} // namespace Harmos

#endif
