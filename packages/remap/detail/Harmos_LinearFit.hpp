// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LINEAR_FIT_HPP
#define HARMOS_LINEAR_FIT_HPP

#include <Harmos_Vector.hpp>
#include <detail/Harmos_FieldPack.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Normal equations of a least-squares gradient weighted by a part over distance squared.
struct LinearFit
{
  double xx = 0.0, xy = 0.0, yy = 0.0;
  FieldPack x{0.0}, y{0.0};

  KOKKOS_INLINE_FUNCTION void add(Vector2 const &d, double part, FieldPack const &difference)
  {
    double const distance2 = dot(d, d);
    if (!(distance2 > 0.0))
      return;
    double const w = part / distance2;
    xx += w * d[0] * d[0];
    xy += w * d[0] * d[1];
    yy += w * d[1] * d[1];
    addTimes(x, w * d[0], difference);
    addTimes(y, w * d[1], difference);
  }

  /// The gradient; along a line where all neighbours lie on one.
  KOKKOS_INLINE_FUNCTION void solve(FieldPack &gx, FieldPack &gy) const
  {
    double const trace = xx + yy;
    double const det = xx * yy - xy * xy;
    bool const line = det < 1e-6 * trace * trace;
    double const scale = trace > 0.0 ? 1.0 / (line ? trace : det) : 0.0;
    gx = FieldPack(scale * (line ? 1.0 : yy)) * x;
    addTimes(gx, scale * (line ? 0.0 : -xy), y);
    gy = FieldPack(scale * (line ? 1.0 : xx)) * y;
    addTimes(gy, scale * (line ? 0.0 : -xy), x);
  }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
