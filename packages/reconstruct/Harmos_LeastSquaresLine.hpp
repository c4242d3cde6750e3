// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LEAST_SQUARES_LINE_HPP
#define HARMOS_LEAST_SQUARES_LINE_HPP

#include <Harmos_FractionGradient.hpp>
#include <Harmos_LineCut.hpp>

namespace Harmos
{

struct LeastSquaresLine
{
  Vector2 normal; // unit, leaves the inside
  double misfit;  // mean over the neighbours of (fraction behind the line - fraction)^2
};

namespace Detail
{

/// Area of a convex polygon on the inside of a line, and the chord that the line makes in it.
struct HalfPlanePart
{
  double area, chord_length;
  Vector2 chord_middle;
};

KOKKOS_INLINE_FUNCTION HalfPlanePart halfPlanePart(Quadrilateral const &quad, Plane2 const &line)
{
  HalfPlanePart part{0.0, 0.0, {0.0, 0.0}};
  Vector2 chord[2] = {{0.0, 0.0}, {0.0, 0.0}};
  int crossings = 0;
  Vector2 a = quad[3], previous{0.0, 0.0}; // relative to origin, a point of the result
  double da = line.distance(a);
  Vector2 const origin = quad[0];
  Vector2 first{0.0, 0.0};
  int kept = 0;
  double twice_area = 0.0;
  auto const keep = [&](Vector2 const &x)
  {
    Vector2 const r = x - origin;
    if (kept++ == 0)
      first = r;
    else
      twice_area += cross(previous - first, r - first);
    previous = r;
  };
  for (int k = 0; k < 4; ++k)
  {
    Vector2 const b = quad[k];
    double const db = line.distance(b);
    if ((da <= 0.0) != (db <= 0.0))
    {
      Vector2 const x = a + (da / (da - db)) * (b - a);
      if (crossings < 2)
        chord[crossings++] = x;
      keep(x);
    }
    if (db <= 0.0)
      keep(b);
    a = b;
    da = db;
  }
  part.area = 0.5 * twice_area;
  if (crossings == 2)
  {
    part.chord_length = norm(chord[1] - chord[0]);
    part.chord_middle = 0.5 * (chord[0] + chord[1]);
  }
  return part;
}

/// Misfit of a line of given angle with exact volume in the own polygon, and its Gauss-Newton gradient and Hessian.
struct LineMisfit
{
  double value, gradient, hessian;
};

struct LineFitProblem
{
  Region const &polygon; // the part of the own cell that is divided
  double inside_volume, outside_volume;
  ComponentSet set; // whose fractions in the neighbours are fitted
  bool set_is_inside;
};

/// Turning by dtheta about the middle m of the own chord, which keeps the volume there, moves the chord (middle m_j,
/// length L_j) of neighbour j so that its inside grows by L_j tau.(m - m_j) dtheta, tau = perpendicular(n).
KOKKOS_INLINE_FUNCTION LineMisfit lineMisfit(ReconstructionField const &field, CellComponents const &components,
                                             LineFitProblem const &problem, Vector2 const &normal)
{
  Division const own = divide(problem.polygon, normal, problem.inside_volume, problem.outside_volume);
  Vector2 const middle = 0.5 * (own.chord_begin + own.chord_end);
  Vector2 const along = perpendicular(normal);
  Rows const &neighbours = field.mesh.cell_neighbour;
  int const begin = neighbours.offset(components.cell), end = neighbours.offset(components.cell + 1);
  LineMisfit sum{0.0, 0.0, 0.0};
  for (int n = begin; n < end; ++n)
  {
    int const j = neighbours.item(n);
    Quadrilateral const quad = unitQuadrilateral(field.mesh, components, j);
    double const inverse_area = 1.0 / area(quad);
    HalfPlanePart const part = halfPlanePart(quad, own.line);
    double const given = setFraction(field, components, problem.set, j);
    double const residual = part.area * inverse_area - (problem.set_is_inside ? given : 1.0 - given);
    double const rate = part.chord_length * dot(along, middle - part.chord_middle) * inverse_area;
    sum.value += residual * residual;
    sum.gradient += rate * residual;
    sum.hessian += rate * rate;
  }
  double const inverse_count = 1.0 / Math::max(1, end - begin);
  return {sum.value * inverse_count, sum.gradient * inverse_count, sum.hessian * inverse_count};
}

/// Gauss-Newton in the angle with step halving; every accepted step lowers the misfit.
KOKKOS_INLINE_FUNCTION LeastSquaresLine fitAngle(ReconstructionField const &field, CellComponents const &components,
                                                 LineFitProblem const &problem, Vector2 const &start)
{
  constexpr int max_iterations = 20, max_halvings = 6;
  Vector2 normal = start;
  LineMisfit now = lineMisfit(field, components, problem, normal);
  for (int i = 0; i < max_iterations && now.hessian > 0.0 && now.value > 1e-31; ++i)
  {
    double step = Math::clamp(-now.gradient / now.hessian, -0.5, 0.5);
    if (Math::fabs(now.gradient * step) < 1e-13 * now.value)
      break;
    bool lower = false;
    for (int halving = 0; halving <= max_halvings && !lower; ++halving, step *= 0.5)
    {
      Vector2 const trial = normalised(Math::cos(step) * normal + Math::sin(step) * perpendicular(normal));
      LineMisfit const next = lineMisfit(field, components, problem, trial);
      lower = next.value < now.value;
      if (lower)
      {
        now = next;
        normal = trial;
      }
    }
    if (!lower || Math::fabs(step) < 1e-10)
      break;
  }
  return {normal, now.value};
}

/// Whether some neighbour holds anything but the two sets.
KOKKOS_INLINE_FUNCTION bool othersNear(ReconstructionField const &field, CellComponents const &components,
                                       ComponentSet either)
{
  Rows const &neighbours = field.mesh.cell_neighbour;
  for (int n = neighbours.offset(components.cell); n < neighbours.offset(components.cell + 1); ++n)
    if (setFraction(field, components, either, neighbours.item(n)) < 1.0 - 1e-12)
      return true;
  return false;
}

} // namespace Detail

/// A line whose continuation into the vertex neighbours reproduces their volume fractions best, with exact volume in
/// the own polygon: needs no centroid, so it stays clean for tiny fractions.
///
/// Minimises over the angle the mean of (fraction behind the line - f_j)^2 by Gauss-Newton from the weighted
/// least-squares gradient; straight interfaces are exact. Where a third component is near, the inside's fractions and
/// the outside's tell different stories (a thin void between two bodies has no gradient of its own, but the body
/// behind it has): both are fitted and the lower misfit wins.
///
/// \param polygon  Of the own cell, what is left to divide (unit coordinates).
/// \param inside, outside Disjoint sets of components that fill the polygon.
/// \param fallback Unit normal taken where neither fraction has a gradient.
///
/// Pilliod & Puckett, J. Comput. Phys. 199 (2004) 465-502 (LVIRA); the analytic derivative is ours.
KOKKOS_INLINE_FUNCTION LeastSquaresLine leastSquaresLine(ReconstructionField const &field,
                                                         CellComponents const &components, Region const &polygon,
                                                         ComponentSet inside, ComponentSet outside,
                                                         Vector2 const &fallback)
{
  LeastSquaresLine best{fallback, 1.0};
  double const inside_volume = components.volumeOf(inside), outside_volume = components.volumeOf(outside);
  int const sides = Detail::othersNear(field, components, inside | outside) ? 2 : 1;
  for (int side = 0; side < sides; ++side)
  {
    ComponentSet const set = side == 0 ? inside : outside;
    Vector2 const gradient = leastSquaresGradient(field, components, {set, 0u});
    if (norm(gradient) < 1e-13)
      continue;
    Vector2 const start = (side == 0 ? -1.0 : 1.0) * normalised(gradient);
    Detail::LineFitProblem const problem{polygon, inside_volume, outside_volume, set, side == 0};
    LeastSquaresLine const line = Detail::fitAngle(field, components, problem, start);
    if (line.misfit < best.misfit)
      best = line;
  }
  return best;
}

} // namespace Harmos

#endif
