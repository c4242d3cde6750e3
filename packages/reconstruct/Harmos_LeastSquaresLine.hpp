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

constexpr double open_volume = 1e-2; // of a cell: its void tells where that of its neighbour comes in
constexpr double largest_tip = 0.3;  // of the cell: a body below may be a tip, with void along it (placingSet)

namespace Detail
{

/// Middle of a chord that is weighted along its length; its integral of the weight.
struct WeightedChord
{
  double length;
  Vector2 middle;
};

KOKKOS_INLINE_FUNCTION WeightedChord weightedChord(Vector2 const &begin, Vector2 const &end, AreaWeight const &weight)
{
  WeightedChord chord{norm(end - begin), 0.5 * (begin + end)};
  if (weight.uniform())
    return chord;
  double const middle = weight.at(chord.middle);
  if (middle > 0.0)
    chord.middle += (weight.slope * (end[0] - begin[0]) / (12.0 * middle)) * (end - begin);
  chord.length *= middle;
  return chord;
}

/// Misfit of a line of given angle with exact volume in the own polygon, and its Gauss-Newton gradient and Hessian.
struct LineMisfit
{
  double value, gradient, hessian;
};

struct LineFitProblem
{
  static constexpr double least_misfit = 1e-31; // is as good as none

  CellNeighbours const &neighbours;
  Region const &polygon; // the part of the own cell that is divided
  double inside_volume, outside_volume;
  FractionDifference set; // whose fractions in the neighbours are fitted
  bool set_is_inside;
  Pack stored[CellNeighbours::stored_packs]; // fractions of what shall lie inside the line; 0 where none is present

  KOKKOS_INLINE_FUNCTION Pack turned(Pack const &given, int p) const
  {
    return set_is_inside ? given : neighbours.present(p) - given;
  }

  KOKKOS_INLINE_FUNCTION void store(NeighbourValues const &given)
  {
    for (int p = 0; p < Math::min(neighbours.packs(), CellNeighbours::stored_packs); ++p)
      stored[p] = turned(given.stored[p], p);
  }

  KOKKOS_INLINE_FUNCTION Pack fraction(int p) const
  {
    return p < CellNeighbours::stored_packs ? stored[p] : turned(neighbours.values(set, p), p);
  }

  /// \param behind Parts of the neighbours behind the line; \param rate Their derivatives; out: those of the residuals.
  KOKKOS_FORCEINLINE_FUNCTION Pack residual(int p, Pack const &behind, Pack &) const { return behind - fraction(p); }
};

/// What is neither inside nor outside may lie on either side of the line: the inside's fractions are the least that may
/// lie behind it, what the outside's leave the most.
struct BoundedFitProblem : LineFitProblem
{
  static constexpr double least_misfit = 1e-10; // many lines keep to the bounds

  FractionDifference outside;
  Pack stored_most[CellNeighbours::stored_packs];

  KOKKOS_INLINE_FUNCTION BoundedFitProblem(LineFitProblem const &of_inside, FractionDifference const &its_outside,
                                           NeighbourValues const &given)
      : LineFitProblem(of_inside), outside(its_outside)
  {
    for (int p = 0; p < Math::min(neighbours.packs(), CellNeighbours::stored_packs); ++p)
      stored_most[p] = neighbours.present(p) - given.stored[p];
  }

  KOKKOS_INLINE_FUNCTION Pack most(int p) const
  {
    return p < CellNeighbours::stored_packs ? stored_most[p] : neighbours.present(p) - neighbours.values(outside, p);
  }

  KOKKOS_INLINE_FUNCTION Pack residual(int p, Pack const &behind, Pack &rate) const
  {
    Pack const zero = 0.0, over_least = behind - fraction(p), over_most = behind - most(p);
    Pack const r = select(over_least < zero, over_least, select(over_most > zero, over_most, zero));
    rate = select(r == zero, zero, rate);
    return r;
  }
};

/// What a line leaves of quadrilaterals: the volume inside, and the rate at which it grows where the line turns.
struct InsidePart
{
  Pack volume, rate;
};

/// Without branches: with d the distances of the corners from the line, s their places along it (from the point about
/// which it turns), and f the part of an edge that lies inside, the area is the sum of f (d_a s_b - s_a d_b) / 2, since
/// the chord, seen from a point of the line, adds nothing.
///
/// Turning by dtheta about the middle m of the own chord, which keeps the volume there, moves the chord (middle m_j,
/// length L_j) of neighbour j so that its inside grows by L_j tau.(m - m_j) dtheta, tau = perpendicular(n): half the
/// difference of the squares of its ends' places.
///
/// Weighted by w = w_m + slope x, x from m: each edge's part adds, with its ends p, q, their cross product times
/// w_m / 2 + slope (x_p + x_q) / 6; the chord's ends add w_m s^2 / 2 + slope tau_x s^3 / 3 to the rate.
KOKKOS_INLINE_FUNCTION InsidePart insidePart(NeighbourPack const &quad, Vector2 const &normal, Vector2 const &middle,
                                             AreaWeight const &weight)
{
  bool const uniform = weight.uniform();
  Pack const slope = weight.slope, mean = weight.at(middle);
  Pack const nx = normal[0], ny = normal[1], mx = middle[0], my = middle[1], zero = 0.0, one = 1.0;
  Pack d[4], s[4];
  for (int k = 0; k < 4; ++k)
  {
    Pack const x = quad.x[k] - mx, y = quad.y[k] - my;
    d[k] = nx * x + ny * y;
    s[k] = nx * y - ny * x;
  }
  InsidePart part{zero, zero};
  for (int k = 0; k < 4; ++k)
  {
    int const b = (k + 1) & 3;
    auto const a_inside = d[k] <= zero, b_inside = d[b] <= zero;
    auto const leaves = both(a_inside, no(b_inside)), enters = both(no(a_inside), b_inside);
    Pack const crosses = select(leaves, one, select(enters, one, zero));
    Pack const t = d[k] / select(crosses > zero, Pack(d[k] - d[b]), one);
    Pack const inside = select(a_inside, select(b_inside, one, t), select(b_inside, Pack(one - t), zero));
    Pack const twice_area = inside * (d[k] * s[b] - s[k] * d[b]);
    Pack const place = s[k] + t * (s[b] - s[k]), square = place * place;
    if (uniform)
    {
      part.volume += twice_area;
      part.rate += select(leaves, square, select(enters, Pack(-square), zero));
      continue;
    }
    Pack const xa = select(a_inside, Pack(nx * d[k] - ny * s[k]), Pack(-(ny * place)));
    Pack const xb = select(b_inside, Pack(nx * d[b] - ny * s[b]), Pack(-(ny * place)));
    part.volume += twice_area * (mean + slope * (xa + xb) * (1.0 / 3.0));
    Pack const gain = square * (mean - slope * ny * place * (2.0 / 3.0));
    part.rate += select(leaves, gain, select(enters, Pack(-gain), zero));
  }
  part.volume = Pack(0.5) * part.volume;
  part.rate = Pack(0.5) * part.rate;
  return part;
}

template <class Problem>
HARMOS_LARGE_FUNCTION LineMisfit lineMisfit(Problem const &problem, Vector2 const &normal)
{
  bool const cut_inside = problem.inside_volume <= problem.outside_volume;
  AreaWeight const weight = problem.neighbours.weight();
  LineCut const own = cut_inside ? lineCut(problem.polygon, normal, problem.inside_volume, weight)
                                 : lineCut(problem.polygon, -normal, problem.outside_volume, weight);
  Vector2 const middle = weightedChord(own.begin, own.end, weight).middle;
  Pack value = 0.0, gradient = 0.0, hessian = 0.0;
  NeighbourPack spare;
  for (int p = 0; p < problem.neighbours.packs(); ++p)
  {
    NeighbourPack const &quad = problem.neighbours.pack(p, spare);
    InsidePart const part = insidePart(quad, normal, middle, weight);
    Pack const per_volume = quad.present / quad.volume;
    Pack rate = part.rate * per_volume;
    Pack const residual = problem.residual(p, part.volume * per_volume, rate);
    value += residual * residual;
    gradient += rate * residual;
    hessian += rate * rate;
  }
  double const inverse_count = 1.0 / Math::max(1, problem.neighbours.count());
  return {laneSum(value) * inverse_count, laneSum(gradient) * inverse_count, laneSum(hessian) * inverse_count};
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
template <class Problem>
HARMOS_LARGE_FUNCTION LeastSquaresLine fitAngle(Problem const &problem, Vector2 const &start)
{
  constexpr int max_iterations = 100; // a dozen to the bracket, 33 halvings of it, and what the secant tries between
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
    if (!(now.hessian > 0.0) || now.value <= Problem::least_misfit)
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
HARMOS_LARGE_FUNCTION bool othersNear(ReconstructionField const &field, CellComponents const &components,
                                      ComponentSet either)
{
  Rows const &neighbours = field.mesh.cell_neighbour;
  for (int n = neighbours.offset(components.cell); n < neighbours.offset(components.cell + 1); ++n)
    if (setFraction(field, components, either, neighbours.item(n)) < 1.0 - 1e-12)
      return true;
  return false;
}

/// Whether some neighbour holds enough void to tell where that of this cell comes in.
KOKKOS_INLINE_FUNCTION bool isOpenNear(ReconstructionField const &field, CellComponents const &components)
{
  ComponentSet const open = components.setOfMaterial(void_material);
  Rows const &neighbours = field.mesh.cell_neighbour;
  for (int n = neighbours.offset(components.cell); n < neighbours.offset(components.cell + 1); ++n)
    if (setFraction(field, components, open, neighbours.item(n)) >= open_volume)
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
/// fallback. Where these are poor too, and the line parts a body from void that comes in from a neighbour, in what a
/// third component has left, what is neither inside nor outside may lie on either side: the inside's fraction is then
/// the least, the rest of the outside's the most that may lie behind the line. (Between two blocks that part on a third
/// one a strip of void comes down, whose end in the cell of one block's corner is bounded by that block's face: neither
/// is the void a half-plane nor the block, but the other block may lie where it does.)
///
/// \param polygon  Of the own cell, what is left to divide (unit coordinates).
/// \param inside, outside Disjoint sets of components that fill the polygon.
/// \param fallback Unit normal; the answer where neither fraction has a gradient.
///
/// Pilliod & Puckett, J. Comput. Phys. 199 (2004) 465-502 (LVIRA); the analytic derivative is ours.
HARMOS_LARGE_FUNCTION LeastSquaresLine leastSquaresLine(ReconstructionField const &field,
                                                        CellComponents const &components, Region const &polygon,
                                                        ComponentSet inside, ComponentSet outside,
                                                        Vector2 const &fallback)
{
  constexpr double poor_misfit = 1e-2; // a tenth of a cell
  LeastSquaresLine best{fallback, 1.0, true};
  bool converged = true;
  double const inside_volume = components.volumeOf(inside), outside_volume = components.volumeOf(outside);
  CellNeighbours const neighbours(field, components);
  int const sides = Detail::othersNear(field, components, inside | outside) ? 2 : 1;
  for (int start = 0; start < sides && best.misfit > poor_misfit; ++start)
    for (int side = 0; side < sides; ++side)
    {
      ComponentSet const set = side == 0 ? inside : outside;
      NeighbourValues const given(field, components, neighbours, FractionDifference{set, 0u});
      Vector2 const gradient = leastSquaresGradient(field, components, neighbours, {set, 0u}, given);
      if (norm(gradient) < 1e-13)
        continue;
      Vector2 const along_gradient = (side == 0 ? -1.0 : 1.0) * normalised(gradient);
      Detail::LineFitProblem problem{neighbours, polygon, inside_volume, outside_volume, {set, 0u}, side == 0, {}};
      problem.store(given);
      LeastSquaresLine const line = Detail::fitAngle(problem, start == 0 ? along_gradient : fallback);
      converged = converged && line.converged;
      if (line.misfit < best.misfit)
        best = line;
    }
  ComponentSet const open = components.setOfMaterial(void_material);
  bool const of_void = (inside == open || outside == open) && (inside | outside) != components.all();
  double const body = inside == open ? outside_volume : inside_volume;
  if (best.misfit > poor_misfit && of_void && body > largest_tip && Detail::isOpenNear(field, components))
  {
    FractionDifference const in{inside, 0u}, out{outside, 0u};
    Detail::LineFitProblem of_inside{neighbours, polygon, inside_volume, outside_volume, in, true, {}};
    of_inside.store(NeighbourValues(field, components, neighbours, in));
    Detail::BoundedFitProblem const problem(of_inside, out, NeighbourValues(field, components, neighbours, out));
    for (int start = 0; start < 2 && best.misfit > 0.0; ++start)
    {
      LeastSquaresLine const line = Detail::fitAngle(problem, start == 0 ? best.normal : fallback);
      converged = converged && line.converged;
      if (line.misfit < best.misfit)
        best = line;
    }
  }
  best.converged = converged;
  return best;
}

} // namespace Harmos

#endif
