// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CORNER_FIT_HPP
#define HARMOS_CORNER_FIT_HPP

#include <detail/Harmos_LinearFit.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Least-squares gradients of the velocities of a cell's four corners, and how far one gradient tells them all.
struct CornerFit : LinearFit
{
  FieldPack square{0.0}; // weighted squares of the differences

  KOKKOS_INLINE_FUNCTION void add(Vector2 const &d, double part, FieldPack const &difference)
  {
    double const distance2 = dot(d, d);
    if (!(distance2 > 0.0))
      return;
    LinearFit::add(d, part, difference);
    addTimes(square, part / distance2, difference * difference);
  }

  /// One where velocities around are linear, zero where they are not. With the mean G of the four gradients, Delta_kn
  /// the difference of corner k to neighbour n at distance d_n and r_k = x_k - x of a corner from the cell's middle,
  ///
  ///   E = sum_kn w_n (Delta_kn - G d_n)^2 + sum_k (v_k - v - G r_k)^2 / r_k^2 ,
  ///
  /// S the same with G = 0: one where E is below least_misfit S, zero above most_misfit S. The corners tell steps from
  /// slopes where neighbours lie on one side only: they go on beyond the rim of a body.
  /// \param x,v Places and velocities of the corners. \param gx,gy What solve has found.
  /// \param[out] linear For the two components.
  KOKKOS_INLINE_FUNCTION void linearity(Vector2 const (&x)[4], FieldPack const &v, FieldPack const &gx,
                                        FieldPack const &gy, double (&linear)[2]) const
  {
    constexpr double least_misfit = 0.01, most_misfit = 0.05;
    double at[8], ax[8], ay[8], bx[8], by[8], s[8];
    v.store(at);
    gx.store(ax);
    gy.store(ay);
    LinearFit::x.store(bx);
    LinearFit::y.store(by);
    square.store(s);
    Vector2 const middle = 0.25 * ((x[0] + x[1]) + (x[2] + x[3]));
    for (int c = 0; c < 2; ++c)
    {
      double const mean = 0.25 * ((at[c] + at[2 + c]) + (at[4 + c] + at[6 + c]));
      Vector2 const g{0.25 * ((ax[c] + ax[2 + c]) + (ax[4 + c] + ax[6 + c])),
                      0.25 * ((ay[c] + ay[2 + c]) + (ay[4 + c] + ay[6 + c]))};
      double all = 0.0, misfit = 0.0;
      for (int k = 0; k < 4; ++k)
      {
        Vector2 const r = x[k] - middle;
        double const rise = at[2 * k + c] - mean, rest = rise - dot(g, r), weight = 1.0 / dot(r, r);
        all += s[2 * k + c] + weight * rise * rise;
        misfit += s[2 * k + c] - (g[0] * bx[2 * k + c] + g[1] * by[2 * k + c]) + weight * rest * rest;
      }
      double const part = all > 0.0 ? (most_misfit - misfit / all) / (most_misfit - least_misfit) : 0.0;
      linear[c] = Math::max(0.0, Math::min(1.0, part));
    }
  }
};

/// Range of the velocities of a cell's corners. All four may have each other's: at the rim of a body, beyond which
/// there is no cell of it, a corner's own would not leave a linear field alone. Where velocities are linear it goes as
/// far beyond a corner's own as it does on the other side.
KOKKOS_INLINE_FUNCTION void shareRange(FieldPack const &v, double const (&linear)[2], FieldPack &lower,
                                       FieldPack &upper)
{
  double at[8], low[8], high[8];
  v.store(at);
  lower.store(low);
  upper.store(high);
  for (int c = 0; c < 2; ++c)
  {
    double const least = Math::min(Math::min(low[c], low[2 + c]), Math::min(low[4 + c], low[6 + c]));
    double const most = Math::max(Math::max(high[c], high[2 + c]), Math::max(high[4 + c], high[6 + c]));
    for (int k = 0; k < 4; ++k)
    {
      low[2 * k + c] = Math::min(least, at[2 * k + c] - linear[c] * (most - at[2 * k + c]));
      high[2 * k + c] = Math::max(most, at[2 * k + c] + linear[c] * (at[2 * k + c] - least));
    }
  }
  lower = FieldPack(low);
  upper = FieldPack(high);
}

} // namespace RemapDetail
} // namespace Harmos

#endif
