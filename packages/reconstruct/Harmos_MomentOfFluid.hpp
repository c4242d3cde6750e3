// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MOMENT_OF_FLUID_HPP
#define HARMOS_MOMENT_OF_FLUID_HPP

#include <Harmos_LineCut.hpp>

namespace Harmos
{

struct MomentOfFluidLine
{
  Vector2 normal;       // unit, leaves the part
  Vector2 centroid;     // of the part that is cut off [length]
  double squared_error; // |centroid - reference|^2 [length^2]
  int iterations;       // cuts evaluated
  bool converged;       // false: the search for the angle met its bound (the volume is exact all the same)
};

namespace Detail
{

/// Centroid of a cut and the rate dx/dtheta = -tau I / V at which it moves along the chord when the line turns by theta
/// about the chord's (weighted) middle, which keeps the volume; I = integral of w s^2 ds along the chord about that
/// middle, L^3 / 12 for the weight one.
struct TurningCut
{
  Vector2 centroid;
  double rate; // I / V
};

/// With the weight w = w_m + k s along the chord, s from its midpoint: the integrals of w, w s, w s^2 are w_m L,
/// k L^3 / 12, w_m L^3 / 12. With w = w_b + k x, x from the chord's begin, a triangle 0, a, b of twice the area c has
/// the integrals c (w_b / 2 + k (a_x + b_x) / 6) of w and
/// c (w_b (a + b) / 6 + k ((a_x + b_x) (a + b) + a_x a + b_x b) / 24) of w x; the chord's own edges add nothing.
HARMOS_LARGE_FUNCTION TurningCut weightedTurningCut(Region const &polygon, Vector2 const &normal, double volume,
                                                    AreaWeight const &weight)
{
  LineCut const cut = lineCut(polygon, normal, volume, weight);
  Vector2 const chord = cut.end - cut.begin;
  double const at_begin = weight.at(cut.begin), k = weight.slope;
  double sum = 0.0; // six times the volume
  Vector2 first{0.0, 0.0}, a = chord;
  for (int i = cut.first;; i = polygon.next(i))
  {
    Vector2 const b = polygon[i] - cut.begin, both = a + b;
    double const c = cross(a, b);
    sum += c * (3.0 * at_begin + k * both[0]);
    first += c * ((at_begin + 0.25 * k * both[0]) * both + (0.25 * k) * (a[0] * a + b[0] * b));
    a = b;
    if (i == cut.last)
      break;
  }
  TurningCut result{cut.begin, 0.0};
  if (sum > 0.0)
  {
    double const length2 = dot(chord, chord), length = Math::sqrt(length2), cubed = length * length2 * (1.0 / 12.0);
    double const middle = at_begin + 0.5 * k * chord[0];
    double const moment = length > 0.0 ? k * chord[0] * length2 * (1.0 / 12.0) : 0.0;
    double const about_middle = middle * cubed - (middle * length > 0.0 ? moment * moment / (middle * length) : 0.0);
    double const inverse = 1.0 / sum;
    result.centroid += inverse * first;
    result.rate = 6.0 * inverse * about_middle;
  }
  return result;
}

HARMOS_LARGE_FUNCTION TurningCut turningCut(Region const &polygon, Vector2 const &normal, double volume,
                                            AreaWeight const &weight)
{
  if (!weight.uniform())
    return weightedTurningCut(polygon, normal, volume, weight);
  LineCut const cut = lineCut(polygon, normal, volume);
  // Moments about the chord's begin, whose own edges add nothing: once around from the chord's end.
  double twice_area = 0.0;
  Vector2 first{0.0, 0.0}, a = cut.end - cut.begin;
  double const length = norm(a);
  for (int i = cut.first;; i = polygon.next(i))
  {
    Vector2 const b = polygon[i] - cut.begin;
    double const c = cross(a, b);
    twice_area += c;
    first += c * (a + b);
    a = b;
    if (i == cut.last)
      break;
  }
  TurningCut result{cut.begin, 0.0};
  if (twice_area > 0.0)
  {
    double const inverse = 1.0 / (3.0 * twice_area);
    result.centroid += inverse * first;
    result.rate = 0.5 * length * length * length * inverse;
  }
  return result;
}

/// A local minimum of |x(theta) - c|^2 from a given direction. Stationary where g = (x - c).tau = 0, tau along the
/// chord; g' = -I/V - (x - c).n. Newton's method, kept inside the bracket g(low) > 0 > g(high) by bisection. It
/// ends with a step whose square is round-off: that one needs no further cut.
HARMOS_LARGE_FUNCTION MomentOfFluidLine localMinimum(Region const &polygon, Vector2 const &start, double volume,
                                                     Vector2 const &reference, AreaWeight const &weight)
{
  constexpr int max_iterations = 100;  // a dozen to the bracket, 50 halvings of it, and what Newton tries between
  constexpr double tolerance = 4e-16;  // of the unit cell: the round-off of the centroid
  constexpr double resolution = 1e-15; // of an angle up to a turn
  constexpr double last_step = 1e-8;
  Vector2 const start_along = perpendicular(start);
  double theta = 0.0, low = 0.0, high = 0.0, last_slope = 1e300;
  bool has_low = false, has_high = false;
  MomentOfFluidLine line{start, reference, 0.0, 0, true};
  for (int i = 0; i < max_iterations; ++i)
  {
    if (i > 0)
      line.normal = Math::cos(theta) * start + Math::sin(theta) * start_along;
    TurningCut const cut = turningCut(polygon, line.normal, volume, weight);
    Vector2 const miss = cut.centroid - reference;
    line.centroid = cut.centroid;
    line.squared_error = dot(miss, miss);
    line.iterations = i + 1;
    double const g = dot(miss, perpendicular(line.normal));
    if (Math::fabs(g) <= tolerance)
      return line;
    (g > 0.0 ? low : high) = theta;
    (g > 0.0 ? has_low : has_high) = true;
    double const curvature = cut.rate + dot(miss, line.normal); // -g'
    double step = curvature > 0.0 ? g / curvature : (g > 0.0 ? 0.5 : -0.5);
    step = Math::clamp(step, -0.5, 0.5);
    double next = theta + step;
    bool const slow = Math::fabs(g) > 0.5 * last_slope;
    bool const bisect = has_low && has_high && (slow || (next - low) * (next - high) >= 0.0);
    if (curvature > 0.0 && !bisect && Math::fabs(step) <= last_step)
    {
      Vector2 const along = perpendicular(line.normal);
      line.centroid -= (cut.rate * step) * along;
      line.normal = Math::cos(next) * start + Math::sin(next) * start_along;
      return line;
    }
    if (bisect)
      next = 0.5 * (low + high);
    last_slope = Math::fabs(g);
    if (Math::fabs(next - theta) <= resolution)
      return line;
    theta = next;
  }
  line.converged = false;
  return line;
}

} // namespace Detail

/// The line that cuts a given volume off a convex polygon with the centroid nearest to a given one.
///
/// Minimises F(theta) = |x(theta) - c|^2 over the normal's angle, V exact at every theta. First start: the normal that
/// an ellipse with the polygon's second moments S would have, n ~ -S^-1 (c - x_polygon); when its residual is not
/// small, a second start from n ~ -(c - x_polygon), and the better one is kept. Straight interfaces are exact.
///
/// Give it the smaller part: a nearly full polygon's centroid does not depend on the angle.
///
/// \param polygon   In coordinates in which the cell has unit area and lies near the origin.
/// \param volume    Of the part, in (0, |polygon|).
/// \param reference c, the part's given centroid.
/// \param weight    Of area elements; volume and centroids are weighted with it.
///
/// Dyadechko & Shashkov, J. Comput. Phys. 227 (2008) 5361-5384; derivative by Lemoine et al., J. Comput. Phys. 330
/// (2017) 1-14 in this notation.
HARMOS_LARGE_FUNCTION MomentOfFluidLine momentOfFluidLine(Region const &polygon, double volume,
                                                          Vector2 const &reference, AreaWeight const &weight = {})
{
  double const small_residual = 1e-4 * volume; // a hundredth of the part's size, squared
  Moments<2> const m = moments<2>(polygon, polygon[0]);
  Vector2 const centroid = m.centroid();
  Vector2 towards = polygon[0] + centroid - reference;
  if (!weight.uniform())
    towards =
        polygon[0] + moments<1>(polygon, polygon[0], {weight.at(polygon[0]), weight.slope}).centroid() - reference;
  double const sxx = m.second(0, 0) / m.volume() - centroid[0] * centroid[0];
  double const sxy = m.second(0, 1) / m.volume() - centroid[0] * centroid[1];
  double const syy = m.second(1, 1) / m.volume() - centroid[1] * centroid[1];
  Vector2 plain = normalised(towards);
  if (dot(plain, plain) == 0.0)
    plain = {1.0, 0.0};
  Vector2 scaled = normalised(Vector2{syy * towards[0] - sxy * towards[1], sxx * towards[1] - sxy * towards[0]});
  if (dot(scaled, scaled) == 0.0)
    scaled = plain;
  MomentOfFluidLine line = Detail::localMinimum(polygon, scaled, volume, reference, weight);
  if (line.squared_error > small_residual)
  {
    MomentOfFluidLine const second = Detail::localMinimum(polygon, plain, volume, reference, weight);
    int const iterations = line.iterations + second.iterations;
    bool const converged = line.converged && second.converged;
    if (second.squared_error < line.squared_error - 1e-20)
      line = second;
    line.iterations = iterations;
    line.converged = converged;
  }
  return line;
}

} // namespace Harmos

#endif
