// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_NORMAL_FIT_HPP
#define HARMOS_NORMAL_FIT_HPP

#include <Harmos_Pack.hpp>
#include <Harmos_Vector.hpp>

namespace Harmos
{

/// Most segments of each side that one fit takes (7 x 7 cells hold about 15 around a simple interface); a whole number
/// of packs.
constexpr int max_fit_samples = 96;

/// One segment near the point where the contact normal is wanted; lengths in cells.
struct FitSample
{
  Vector2 offset; // of its midpoint from the point
  Vector2 normal; // unit, from material a to material b on both sides
  double length;
  double weight; // fitWeight
  int side;      // 0: of a, 1: of b
};

/// The samples of one side, by component. Behind the last one the pack is filled with samples of no weight.
struct FitSide
{
  int count = 0;
  double x[max_fit_samples], y[max_fit_samples], normal_x[max_fit_samples], normal_y[max_fit_samples];
  double length[max_fit_samples], weight[max_fit_samples], omega[max_fit_samples]; // omega: robust factor of the weight

  KOKKOS_INLINE_FUNCTION void set(int j, Vector2 const &offset, Vector2 const &normal, double its_length,
                                  double its_weight)
  {
    x[j] = offset[0];
    y[j] = offset[1];
    normal_x[j] = normal[0];
    normal_y[j] = normal[1];
    length[j] = its_length;
    weight[j] = its_weight;
    omega[j] = 1.0;
  }

  KOKKOS_INLINE_FUNCTION void fillPack()
  {
    for (int j = count; j < numPacks(count) * pack_width; ++j)
      set(j, {0.0, 0.0}, {0.0, 0.0}, 0.0, 0.0);
  }
};

struct FitSamples
{
  FitSide side[2];

  /// False, and no change, when there is no room.
  KOKKOS_INLINE_FUNCTION bool push(FitSample const &s)
  {
    FitSide &of = side[s.side];
    if (of.count == max_fit_samples)
      return false;
    of.set(of.count++, s.offset, s.normal, s.length, s.weight);
    return true;
  }
};

constexpr double fit_reach = 4.0; // distance from which on segments have no weight [cells]

/// Base weight L (1 - d^2/16)_+^2 / (1 + (g/0.3)^2) of segments at distance d with gap g. [cells]
KOKKOS_INLINE_FUNCTION Pack fitWeight(Pack const &length, Pack const &distance_squared, Pack const &gap)
{
  Pack const kernel = Math::max(Pack(0.0), Pack(1.0) - distance_squared / Pack(fit_reach * fit_reach));
  Pack const g = gap / Pack(0.3);
  return length * kernel * kernel / (Pack(1.0) + g * g);
}

/// One pass of the fit: a weighted least-squares parabola y = alpha_s + beta t + gamma t^2 / 2 in the frame (t, n).
struct ParabolaFit
{
  double alpha[2] = {0.0, 0.0};
  double beta = 0.0;
  double gamma = 0.0;
};

/// Solve the symmetric positive (semi)definite 4 x 4 system A x = b by LDL^T; directions without a pivot get x = 0.
KOKKOS_INLINE_FUNCTION void solve4(double A[4][4], double b[4])
{
  double inverse[4]; // of the pivots
  for (int k = 0; k < 4; ++k)
  {
    inverse[k] = A[k][k] > 1e-300 ? 1.0 / A[k][k] : 0.0;
    for (int i = k + 1; i < 4; ++i)
    {
      double const l = A[i][k] * inverse[k];
      for (int j = k + 1; j < 4; ++j)
        A[i][j] -= l * A[k][j];
      b[i] -= l * b[k];
    }
  }
  for (int k = 3; k >= 0; --k)
  {
    for (int j = k + 1; j < 4; ++j)
      b[k] -= A[k][j] * b[j];
    b[k] *= inverse[k];
  }
}

constexpr double fit_least_cosine = 0.7; // segments (and rows) that are tilted more against the normal are left out

/// A pack of samples in the frame of one pass: positions, heights, projected lengths squared over 12, and slopes.
struct FitPoints
{
  Pack t, y, spread, slope, along;

  KOKKOS_FORCEINLINE_FUNCTION FitPoints(FitSide const &s, int j, Vector2 const &n)
  {
    Pack const nx = n[0], ny = n[1], x = loadPack(s.x + j), z = loadPack(s.y + j);
    Pack const a = loadPack(s.normal_x + j), b = loadPack(s.normal_y + j);
    along = a * nx + b * ny;
    t = x * ny - z * nx;
    y = x * nx + z * ny;
    Pack const projected = loadPack(s.length + j) * along;
    spread = projected * projected * Pack(1.0 / 12.0);
    // The line's tangent is -perpendicular(normal) seen along t; those that are left out must not divide by zero.
    slope = (b * nx - a * ny) / Math::max(along, Pack(0.5 * fit_least_cosine));
  }

  /// `in` for the samples that the fit takes, `out` for the others.
  KOKKOS_FORCEINLINE_FUNCTION Pack choose(Pack const &in, Pack const &out) const
  {
    return select(Pack(fit_least_cosine) <= along, in, out);
  }
};

/// Moments of one side's samples: what the normal equations are made of.
struct FitMoments
{
  double w, wt, wq, wy; // of the side's own offset
  double tt, tq, qq, ty, qy;
};

KOKKOS_INLINE_FUNCTION FitMoments fitMoments(FitSide const &s, Vector2 const &n)
{
  Pack w = 0.0, wt = 0.0, wq = 0.0, wy = 0.0, tt = 0.0, tq = 0.0, qq = 0.0, ty = 0.0, qy = 0.0;
  for (int j = 0; j < s.count; j += pack_width)
  {
    FitPoints const p(s, j, n);
    Pack const a = p.choose(loadPack(s.weight + j) * loadPack(s.omega + j), Pack(0.0));
    Pack const u = Pack(0.1) * a * p.spread;
    Pack const q = Pack(0.5) * (p.t * p.t + p.spread);
    Pack const at = a * p.t, aq = a * q, ut = u * p.t;
    w += a;
    wt += at;
    wq += aq;
    wy += a * p.y;
    tt += at * p.t + u;
    tq += at * q + ut;
    qq += aq * q + ut * p.t;
    ty += at * p.y + u * p.slope;
    qy += aq * p.y + ut * p.slope;
  }
  return {laneSum(w),  laneSum(wt), laneSum(wq), laneSum(wy), laneSum(tt),
          laneSum(tq), laneSum(qq), laneSum(ty), laneSum(qy)};
}

/// Minimise sum w omega (r^2 + 0.1 spread s^2) + W kappa gamma^2 with
/// r = y - alpha_s - beta t - gamma (t^2 + spread) / 2, s = slope - beta - gamma t, W = sum w omega.
KOKKOS_INLINE_FUNCTION ParabolaFit fitParabola(FitMoments const &a, FitMoments const &b, double kappa)
{
  double const beta_beta = a.tt + b.tt, beta_gamma = a.tq + b.tq;
  double const gamma_gamma = (a.qq + b.qq) + (a.w + b.w) * kappa;
  double A[4][4] = {{a.w, 0.0, a.wt, a.wq},
                    {0.0, b.w, b.wt, b.wq},
                    {a.wt, b.wt, beta_beta, beta_gamma},
                    {a.wq, b.wq, beta_gamma, gamma_gamma}};
  double x[4] = {a.wy, b.wy, a.ty + b.ty, a.qy + b.qy};
  solve4(A, x);
  ParabolaFit fit;
  fit.alpha[0] = x[0];
  fit.alpha[1] = x[1];
  fit.beta = x[2];
  fit.gamma = x[3];
  return fit;
}

/// Robust factors omega of a side's samples in the next pass; returns the weighted sum of its squared misfits.
KOKKOS_INLINE_FUNCTION double reweigh(FitSide &s, Vector2 const &n, ParabolaFit const &fit, double alpha)
{
  Pack const largest = 0.25; // of a squared misfit
  Pack const beta = fit.beta, gamma = fit.gamma, one = 1.0;
  Pack misfit = 0.0;
  for (int j = 0; j < s.count; j += pack_width)
  {
    FitPoints const p(s, j, n);
    Pack const r = p.y - Pack(alpha) - beta * p.t - Pack(0.5) * gamma * (p.t * p.t + p.spread);
    Pack const d = p.slope - beta - gamma * p.t;
    Pack const e2 = p.choose(r * r + p.spread * d * d, largest);
    storePack(s.omega + j, one / (one + e2 * Pack(1.0 / (0.025 * 0.025))));
    misfit += loadPack(s.weight + j) * Math::min(e2, largest);
  }
  return laneSum(misfit);
}

/// \brief Normal of the interface between two materials at a point, from the segments of both around it.
///
/// A robust local parabola, shared in slope and curvature by the two sides, each with its own offset; the curvature's
/// ridge follows from the fit's own misfit, so that flat interfaces are averaged and curved ones are not flattened.
/// Three passes: fit, turn the frame by the slope beta (|beta| <= 1), reweigh. Two where the first one leaves next to
/// no misfit.
///
/// \param samples  Segments around the point; those of zero weight count for nothing.
/// \param fallback Unit vector; returned when the samples have no mean normal (no sample at all).
/// \return Unit normal from a to b.
KOKKOS_INLINE_FUNCTION Vector2 fitNormal(FitSamples &samples, Vector2 const &fallback)
{
  Pack mean_x = 0.0, mean_y = 0.0, weights = 0.0;
  for (FitSide &s : samples.side)
  {
    s.fillPack();
    for (int j = 0; j < s.count; j += pack_width)
    {
      Pack const w = loadPack(s.weight + j), length = loadPack(s.length + j);
      Pack const of_normal = w * length * length;
      mean_x += of_normal * loadPack(s.normal_x + j);
      mean_y += of_normal * loadPack(s.normal_y + j);
      weights += w;
    }
  }
  Vector2 const mean{laneSum(mean_x), laneSum(mean_y)};
  double const total = laneSum(weights);
  if (!(norm(mean) > 0.0))
    return fallback;
  // Weights then hardly differ from one, and the ridge is at its least: a third pass turned normals by 1e-10 at most.
  constexpr double next_to_none = 1e-3; // root mean square misfit [cells]
  int passes = 3;
  Vector2 n = normalised(mean);
  double kappa = 0.1; // the curvature's ridge
  for (int pass = 1; pass <= passes; ++pass)
  {
    ParabolaFit const fit = fitParabola(fitMoments(samples.side[0], n), fitMoments(samples.side[1], n), kappa);
    if (pass < passes)
    {
      double const misfit =
          reweigh(samples.side[0], n, fit, fit.alpha[0]) + reweigh(samples.side[1], n, fit, fit.alpha[1]);
      kappa = Math::min(1.0, Math::max(misfit / total, 0.003 * 0.003) / 0.01);
      if (misfit <= next_to_none * next_to_none * total)
        passes = 2;
    }
    double const beta = Math::clamp(fit.beta, -1.0, 1.0);
    n = normalised(n + beta * perpendicular(n)); // n - beta t with t = -perpendicular(n)
  }
  return n;
}

} // namespace Harmos

#endif
