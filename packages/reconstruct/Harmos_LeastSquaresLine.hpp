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
  bool converged; // false: the search for the angle met its bound (the volume is exact all the same)
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
  double distance[4];
  for (int k = 0; k < 4; ++k)
    distance[k] = line.distance(quad[k]);
  double const nearest = Math::min(Math::min(distance[0], distance[1]), Math::min(distance[2], distance[3]));
  double const farthest = Math::max(Math::max(distance[0], distance[1]), Math::max(distance[2], distance[3]));
  if (nearest > 0.0)
    return part;
  if (farthest <= 0.0)
  {
    part.area = area(quad);
    return part;
  }
  Vector2 chord[2] = {{0.0, 0.0}, {0.0, 0.0}};
  int crossings = 0;
  Vector2 a = quad[3], previous{0.0, 0.0}; // relative to origin, a point of the result
  double da = distance[3];
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
    double const db = distance[k];
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

/// A neighbour as the fit sees it.
struct FitNeighbour
{
  Quadrilateral quad; // in the own cell's unit coordinates
  double inverse_area;
  double fraction; // of what shall lie inside the line
};

struct LineFitProblem
{
  static constexpr int max_stored = 12; // further neighbours (of irregular nodes) are gathered again for every angle

  ReconstructionField const &field;
  CellComponents const &components;
  Region const &polygon; // the part of the own cell that is divided
  double inside_volume, outside_volume;
  ComponentSet set; // whose fractions in the neighbours are fitted
  bool set_is_inside;
  int num_neighbours;
  FitNeighbour stored[max_stored];

  KOKKOS_INLINE_FUNCTION FitNeighbour gather(int n) const
  {
    Rows const &rows = field.mesh.cell_neighbour;
    int const cell = rows.item(rows.offset(components.cell) + n);
    FitNeighbour neighbour;
    neighbour.quad = unitQuadrilateral(field.mesh, components, cell);
    neighbour.inverse_area = 1.0 / area(neighbour.quad);
    double const given = setFraction(field, components, set, cell);
    neighbour.fraction = set_is_inside ? given : 1.0 - given;
    return neighbour;
  }

  KOKKOS_INLINE_FUNCTION void store()
  {
    Rows const &rows = field.mesh.cell_neighbour;
    num_neighbours = rows.offset(components.cell + 1) - rows.offset(components.cell);
    for (int n = 0; n < Math::min(num_neighbours, max_stored); ++n)
      stored[n] = gather(n);
  }
};

/// Turning by dtheta about the middle m of the own chord, which keeps the volume there, moves the chord (middle m_j,
/// length L_j) of neighbour j so that its inside grows by L_j tau.(m - m_j) dtheta, tau = perpendicular(n).
KOKKOS_INLINE_FUNCTION void addMisfit(FitNeighbour const &neighbour, Plane2 const &line, Vector2 const &middle,
                                      LineMisfit &sum)
{
  HalfPlanePart const part = halfPlanePart(neighbour.quad, line);
  double const residual = part.area * neighbour.inverse_area - neighbour.fraction;
  double const rate =
      part.chord_length * dot(perpendicular(line.normal), middle - part.chord_middle) * neighbour.inverse_area;
  sum.value += residual * residual;
  sum.gradient += rate * residual;
  sum.hessian += rate * rate;
}

KOKKOS_INLINE_FUNCTION LineMisfit lineMisfit(LineFitProblem const &problem, Vector2 const &normal)
{
  bool const cut_inside = problem.inside_volume <= problem.outside_volume;
  LineCut const own = cut_inside ? lineCut(problem.polygon, normal, problem.inside_volume)
                                 : lineCut(problem.polygon, -normal, problem.outside_volume);
  Plane2 const line{normal, cut_inside ? own.offset : -own.offset};
  Vector2 const middle = 0.5 * (own.begin + own.end);
  LineMisfit sum{0.0, 0.0, 0.0};
  for (int n = 0; n < Math::min(problem.num_neighbours, LineFitProblem::max_stored); ++n)
    addMisfit(problem.stored[n], line, middle, sum);
  for (int n = LineFitProblem::max_stored; n < problem.num_neighbours; ++n)
    addMisfit(problem.gather(n), line, middle, sum);
  double const inverse_count = 1.0 / Math::max(1, problem.num_neighbours);
  return {sum.value * inverse_count, sum.gradient * inverse_count, sum.hessian * inverse_count};
}

/// Angles between which the misfit has a minimum, as its slope's signs tell.
struct AngleBracket
{
  double low = 0.0, high = 0.0; // the misfit falls at low and rises at high
  bool has_low = false, has_high = false;

  KOKKOS_INLINE_FUNCTION bool closed() const { return has_low && has_high; }
  KOKKOS_INLINE_FUNCTION bool holds(double angle) const { return (angle - low) * (angle - high) < 0.0; }

  KOKKOS_INLINE_FUNCTION void add(double angle, double gradient)
  {
    (gradient > 0.0 ? high : low) = angle;
    (gradient > 0.0 ? has_high : has_low) = true;
  }
};

/// A local minimum of the misfit over the angle: Gauss-Newton, from the second step on with the secant of the gradient
/// in place of the curvature, which lacks the part of the residuals.
///
/// Until two slopes of different sign enclose a minimum, every step lowers the misfit and steps grow where the slope
/// hardly falls (where no straight line fits, Gauss-Newton alone creeps); from then on they stay inside, by bisection
/// where the secant is slow.
KOKKOS_INLINE_FUNCTION LeastSquaresLine fitAngle(LineFitProblem const &problem, Vector2 const &start)
{
  constexpr int max_iterations = 60;
  constexpr double least_curvature = 0.1; // of the secant, of Gauss-Newton's: below it the latter is taken
  constexpr double longest_step = 0.5;
  Vector2 const along = perpendicular(start);
  Vector2 normal = start;
  LineMisfit now = lineMisfit(problem, normal);
  AngleBracket bracket;
  double angle = 0.0, curvature = now.hessian, stretch = 1.0;
  bool slow = false;
  for (int i = 0; i < max_iterations; ++i)
  {
    if (!(now.hessian > 0.0) || now.value <= 1e-31)
      return {normal, now.value, true};
    bracket.add(angle, now.gradient);
    double step = Math::clamp(-stretch * now.gradient / curvature, -longest_step, longest_step);
    if (Math::fabs(now.gradient * step) < 1e-13 * now.value)
      return {normal, now.value, true};
    bool const enclosed = bracket.closed();
    if (enclosed && (slow || !bracket.holds(angle + step)))
      step = 0.5 * (bracket.low + bracket.high) - angle;
    Vector2 const trial = normalised(Math::cos(angle + step) * start + Math::sin(angle + step) * along);
    LineMisfit const next = lineMisfit(problem, trial);
    if (Math::fabs(step) < 1e-10)
      return next.value < now.value ? LeastSquaresLine{trial, next.value, true}
                                    : LeastSquaresLine{normal, now.value, true};
    double const secant = (next.gradient - now.gradient) / step;
    slow = Math::fabs(next.gradient) > 0.5 * Math::fabs(now.gradient);
    bool const turned = (next.gradient > 0.0) != (now.gradient > 0.0);
    if (!enclosed && !(next.value < now.value))
    {
      // Beyond the minimum, or beyond a ridge: back, by the secant or by half.
      if (turned)
        bracket.add(angle + step, next.gradient);
      curvature = turned && secant > 0.0 ? secant : -2.0 * now.gradient / step;
      stretch = 1.0;
      slow = false;
      continue;
    }
    curvature = secant > least_curvature * next.hessian ? secant : next.hessian;
    stretch = slow && !turned && !enclosed ? 2.0 * stretch : 1.0;
    slow = slow && enclosed;
    angle += step;
    normal = trial;
    now = next;
  }
  return {normal, now.value, false};
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
/// behind it has): both are fitted and the lower misfit wins; where both fits are poor, they start once more from the
/// fallback.
///
/// \param polygon  Of the own cell, what is left to divide (unit coordinates).
/// \param inside, outside Disjoint sets of components that fill the polygon.
/// \param fallback Unit normal; the answer where neither fraction has a gradient.
///
/// Pilliod & Puckett, J. Comput. Phys. 199 (2004) 465-502 (LVIRA); the analytic derivative is ours.
KOKKOS_INLINE_FUNCTION LeastSquaresLine leastSquaresLine(ReconstructionField const &field,
                                                         CellComponents const &components, Region const &polygon,
                                                         ComponentSet inside, ComponentSet outside,
                                                         Vector2 const &fallback)
{
  constexpr double poor_misfit = 1e-2; // a tenth of a cell
  LeastSquaresLine best{fallback, 1.0, true};
  bool converged = true;
  double const inside_volume = components.volumeOf(inside), outside_volume = components.volumeOf(outside);
  int const sides = Detail::othersNear(field, components, inside | outside) ? 2 : 1;
  for (int start = 0; start < sides && best.misfit > poor_misfit; ++start)
    for (int side = 0; side < sides; ++side)
    {
      ComponentSet const set = side == 0 ? inside : outside;
      Vector2 const gradient = leastSquaresGradient(field, components, {set, 0u});
      if (norm(gradient) < 1e-13)
        continue;
      Vector2 const along_gradient = (side == 0 ? -1.0 : 1.0) * normalised(gradient);
      Detail::LineFitProblem problem{field, components, polygon, inside_volume, outside_volume, set, side == 0, 0, {}};
      problem.store();
      LeastSquaresLine const line = Detail::fitAngle(problem, start == 0 ? along_gradient : fallback);
      converged = converged && line.converged;
      if (line.misfit < best.misfit)
        best = line;
    }
  best.converged = converged;
  return best;
}

} // namespace Harmos

#endif
