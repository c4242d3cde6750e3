// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_NORMAL_FIT_HPP
#define HARMOS_NORMAL_FIT_HPP

#include <Harmos_Vector.hpp>

namespace Harmos
{

/// Most segments that one fit takes (7 x 7 cells hold about 30 around a simple interface).
constexpr int max_fit_samples = 192;

/// One segment near the point where the contact normal is wanted; lengths in cells.
struct FitSample
{
  Vector2 offset; // of its midpoint from the point
  Vector2 normal; // unit, from material a to material b on both sides
  double length;
  double weight; // fitWeight
  int side;      // 0: of a, 1: of b
};

/// Base weight L (1 - d^2/16)_+^2 / (1 + (g/0.3)^2) of a segment at distance d with gap g. [cells]
KOKKOS_INLINE_FUNCTION double fitWeight(double length, double distance_squared, double gap)
{
  double const kernel = Math::max(0.0, 1.0 - distance_squared / 16.0);
  double const g = gap / 0.3;
  return length * kernel * kernel / (1.0 + g * g);
}

/// One pass of the fit: a weighted least-squares parabola y = alpha_s + beta t + gamma t^2 / 2 in the frame (t, n).
struct ParabolaFit
{
  double alpha[2] = {0.0, 0.0};
  double beta = 0.0;
  double gamma = 0.0;
};

/// A segment in the frame of the fit: its position, height, projected length squared over 12, and slope.
struct FitPoint
{
  double t, y, spread, slope;

  KOKKOS_INLINE_FUNCTION FitPoint(FitSample const &s, Vector2 const &n)
      : t(-dot(s.offset, perpendicular(n))), y(dot(s.offset, n))
  {
    double const along = dot(s.normal, n);
    double const projected = s.length * along;
    spread = projected * projected / 12.0;
    slope = dot(s.normal, perpendicular(n)) / along; // the line's tangent is -perpendicular(normal) seen along t
  }
};

/// Solve the symmetric positive (semi)definite 4 x 4 system A x = b by LDL^T; directions without a pivot get x = 0.
KOKKOS_INLINE_FUNCTION void solve4(double A[4][4], double b[4])
{
  for (int k = 0; k < 4; ++k)
  {
    bool const empty = !(A[k][k] > 1e-300);
    for (int i = k + 1; i < 4; ++i)
    {
      double const l = empty ? 0.0 : A[i][k] / A[k][k];
      for (int j = k + 1; j < 4; ++j)
        A[i][j] -= l * A[k][j];
      b[i] -= l * b[k];
    }
    if (empty)
      b[k] = 0.0;
  }
  for (int k = 3; k >= 0; --k)
  {
    if (!(A[k][k] > 1e-300))
      continue;
    for (int j = k + 1; j < 4; ++j)
      b[k] -= A[k][j] * b[j];
    b[k] /= A[k][k];
  }
}

constexpr double fit_least_cosine = 0.7; // segments (and rows) that are tilted more against the normal are left out

/// Minimise sum w omega (r^2 + 0.1 spread s^2) + W kappa gamma^2 with
/// r = y - alpha_s - beta t - gamma (t^2 + spread) / 2, s = slope - beta - gamma t, W = sum w omega.
KOKKOS_INLINE_FUNCTION ParabolaFit fitParabola(FitSample const *sample, double const *omega, int count,
                                               Vector2 const &n, double kappa)
{
  double A[4][4] = {};
  double b[4] = {};
  double total = 0.0;
  for (int j = 0; j < count; ++j)
  {
    if (dot(sample[j].normal, n) < fit_least_cosine)
      continue;
    FitPoint const p(sample[j], n);
    double const w = sample[j].weight * omega[j];
    double const u = 0.1 * w * p.spread;
    int const side = sample[j].side;
    double const row[4] = {side == 0 ? 1.0 : 0.0, side == 0 ? 0.0 : 1.0, p.t, 0.5 * (p.t * p.t + p.spread)};
    double const slope_row[4] = {0.0, 0.0, 1.0, p.t};
    for (int r = 0; r < 4; ++r)
    {
      for (int c = 0; c < 4; ++c)
        A[r][c] += w * row[r] * row[c] + u * slope_row[r] * slope_row[c];
      b[r] += w * row[r] * p.y + u * slope_row[r] * p.slope;
    }
    total += w;
  }
  A[3][3] += total * kappa;
  solve4(A, b);
  ParabolaFit fit;
  fit.alpha[0] = b[0];
  fit.alpha[1] = b[1];
  fit.beta = b[2];
  fit.gamma = b[3];
  return fit;
}

/// Robust weights omega of the next pass and its curvature ridge kappa, from the misfit of this one.
KOKKOS_INLINE_FUNCTION double reweigh(FitSample const *sample, double *omega, int count, Vector2 const &n,
                                      ParabolaFit const &fit)
{
  double misfit = 0.0, weight = 0.0;
  for (int j = 0; j < count; ++j)
  {
    double e2 = 0.25;
    if (dot(sample[j].normal, n) >= fit_least_cosine)
    {
      FitPoint const p(sample[j], n);
      double const r = p.y - fit.alpha[sample[j].side] - fit.beta * p.t - 0.5 * fit.gamma * (p.t * p.t + p.spread);
      double const s = p.slope - fit.beta - fit.gamma * p.t;
      e2 = r * r + p.spread * s * s;
    }
    omega[j] = 1.0 / (1.0 + e2 / (0.025 * 0.025));
    misfit += sample[j].weight * Math::min(e2, 0.25);
    weight += sample[j].weight;
  }
  double const sigma2 = weight > 0.0 ? misfit / weight : 0.0;
  return Math::min(1.0, Math::max(sigma2, 0.003 * 0.003) / 0.01);
}

/// \brief Normal of the interface between two materials at a point, from the segments of both around it.
///
/// A robust local parabola, shared in slope and curvature by the two sides, each with its own offset; the curvature's
/// ridge follows from the fit's own misfit, so that flat interfaces are averaged and curved ones are not flattened.
/// Three passes: fit, turn the frame by the slope beta (|beta| <= 1), reweigh.
///
/// \param sample   Segments around the point; those of zero weight count for nothing.
/// \param omega    Work array of `count`.
/// \param fallback Unit vector; returned when the samples have no mean normal (no sample at all).
/// \return Unit normal from a to b.
KOKKOS_INLINE_FUNCTION Vector2 fitNormal(FitSample const *sample, double *omega, int count, Vector2 const &fallback)
{
  Vector2 mean{0.0, 0.0};
  for (int j = 0; j < count; ++j)
  {
    mean += (sample[j].weight * sample[j].length * sample[j].length) * sample[j].normal;
    omega[j] = 1.0;
  }
  if (!(norm(mean) > 0.0))
    return fallback;
  Vector2 n = normalised(mean);
  double kappa = 0.1;
  for (int pass = 0; pass < 3; ++pass)
  {
    ParabolaFit const fit = fitParabola(sample, omega, count, n, kappa);
    kappa = reweigh(sample, omega, count, n, fit);
    double const beta = Math::clamp(fit.beta, -1.0, 1.0);
    n = normalised(n + beta * perpendicular(n)); // n - beta t with t = -perpendicular(n)
  }
  return n;
}

} // namespace Harmos

#endif
