// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CORNER_CELL_HPP
#define HARMOS_CORNER_CELL_HPP

#include <Harmos_Clip.hpp>
#include <Harmos_RemovalPlan.hpp>

namespace Harmos
{

/// One body and void: two lines cut void off the cell, and the body keeps a convex corner.
struct CornerCell
{
  static constexpr int most_residuals = 2 + 8;
  double x[3] = {
      0.0, 0.0, 0.0}; // angles of both normals, which leave the body; the part of the void that the first line cuts off
  Vector2 normal[2];
  double residual[most_residuals] = {};
  double error = 1e300; // sum of their squares
};

/// Residuals: the body's first moment less the given one, and by neighbour sqrt(weight / N) times (part inside both
/// lines - fraction).
struct CornerProblem
{
  ReconstructionField const &field;
  CellComponents const &components; // body, void
  int first, count;
  double scale;
  double fraction[8];

  KOKKOS_INLINE_FUNCTION CornerProblem(ReconstructionField const &f, CellComponents const &c, double of_misfit)
      : field(f), components(c), first(f.mesh.cell_neighbour.offset(c.cell)),
        count(Math::min(8, f.mesh.cell_neighbour.offset(c.cell + 1) - first)),
        scale(Math::sqrt(of_misfit * Math::min(c.volume[0], c.volume[1]) / Math::max(1, count)))
  {
    for (int j = 0; j < count; ++j)
      fraction[j] = setFraction(field, components, 1u, field.mesh.cell_neighbour.item(first + j));
  }

  KOKKOS_INLINE_FUNCTION void measure(Region const &body, Plane2 const *line, int lines, CornerCell &cell) const
  {
    Moments<1> const m = components.momentsOf(body);
    Vector2 const miss = Vector2{m.first(0), m.first(1)} + m.volume() * (body[0] - components.centroid[0]);
    cell.residual[0] = miss[0];
    cell.residual[1] = miss[1];
    for (int j = 0; j < count; ++j)
    {
      Quadrilateral const quad = unitQuadrilateral(field.mesh, components, field.mesh.cell_neighbour.item(first + j));
      Region part, next;
      clip(quad, line[0], part);
      if (lines == 2 && !part.empty())
      {
        clip(part, line[1], next);
        part = next;
      }
      double const inside = part.empty() ? 0.0 : components.volumeOfRegion(part);
      cell.residual[2 + j] = scale * (inside / volume(quad, components.weight) - fraction[j]);
    }
    cell.error = 0.0;
    for (int i = 0; i < 2 + count; ++i)
      cell.error += cell.residual[i] * cell.residual[i];
  }

  KOKKOS_INLINE_FUNCTION CornerCell at(double a, double b, double part) const
  {
    CornerCell cell;
    part = Math::clamp(part, 1e-3, 1.0 - 1e-3);
    cell.x[0] = a;
    cell.x[1] = b;
    cell.x[2] = part;
    cell.normal[0] = {Math::cos(a), Math::sin(a)};
    cell.normal[1] = {Math::cos(b), Math::sin(b)};
    double const open = part * components.volume[1], rest = components.volume[1] - open;
    Division const one =
        divide(components.polygon, cell.normal[0], components.volume[0] + rest, open, components.weight);
    Division const two = divide(one.inside, cell.normal[1], components.volume[0], rest, components.weight);
    Plane2 const line[2] = {one.line, two.line};
    measure(two.inside, line, 2, cell);
    return cell;
  }

  KOKKOS_INLINE_FUNCTION CornerCell straight(Vector2 const &normal) const
  {
    CornerCell cell;
    Division const one =
        divide(components.polygon, normal, components.volume[0], components.volume[1], components.weight);
    measure(one.inside, &one.line, 1, cell);
    return cell;
  }
};

KOKKOS_INLINE_FUNCTION CornerCell bestCornerCell(CornerProblem const &problem, CornerCell const &start)
{
  constexpr int max_steps = 20;
  constexpr double difference = 1e-7, exact = 1e-24;
  CornerCell best = start;
  double damping = 1e-3;
  int const n = 2 + problem.count;
  for (int step = 0; step < max_steps && best.error > exact; ++step)
  {
    double jacobian[3][CornerCell::most_residuals];
    for (int p = 0; p < 3; ++p)
    {
      double x[3] = {best.x[0], best.x[1], best.x[2]};
      double const d = p == 2 && x[2] > 0.5 ? -difference : difference;
      x[p] += d;
      CornerCell const near = problem.at(x[0], x[1], x[2]);
      for (int i = 0; i < n; ++i)
        jacobian[p][i] = (near.residual[i] - best.residual[i]) / d;
    }
    double a[3][3], g[3];
    for (int p = 0; p < 3; ++p)
    {
      g[p] = 0.0;
      for (int i = 0; i < n; ++i)
        g[p] -= jacobian[p][i] * best.residual[i];
      for (int q = 0; q < 3; ++q)
      {
        a[p][q] = 0.0;
        for (int i = 0; i < n; ++i)
          a[p][q] += jacobian[p][i] * jacobian[q][i];
      }
    }
    bool gains = false;
    for (int tries = 0; tries < 6; ++tries)
    {
      double const shift = damping * (a[0][0] + a[1][1] + a[2][2]) / 3.0 + 1e-300;
      double const m00 = a[0][0] + shift, m11 = a[1][1] + shift, m22 = a[2][2] + shift;
      double const c00 = m11 * m22 - a[1][2] * a[1][2], c01 = a[0][2] * a[1][2] - a[0][1] * m22,
                   c02 = a[0][1] * a[1][2] - m11 * a[0][2], c11 = m00 * m22 - a[0][2] * a[0][2],
                   c12 = a[0][1] * a[0][2] - m00 * a[1][2], c22 = m00 * m11 - a[0][1] * a[0][1];
      double const det = m00 * c00 + a[0][1] * c01 + a[0][2] * c02;
      if (!(det > 0.0))
      {
        damping = Math::max(10.0 * damping, 1e-8);
        continue;
      }
      double const dx = Math::clamp((c00 * g[0] + c01 * g[1] + c02 * g[2]) / det, -0.3, 0.3);
      double const dy = Math::clamp((c01 * g[0] + c11 * g[1] + c12 * g[2]) / det, -0.3, 0.3);
      double const dz = Math::clamp((c02 * g[0] + c12 * g[1] + c22 * g[2]) / det, -0.3, 0.3);
      CornerCell const next = problem.at(best.x[0] + dx, best.x[1] + dy, best.x[2] + dz);
      bool const better = next.error < best.error;
      gains = next.error < 0.999 * best.error;
      if (better)
        best = next;
      damping = better ? 0.1 * damping : Math::max(10.0 * damping, 1e-8);
      if (better)
        break;
    }
    if (!gains)
      break;
  }
  return best;
}

KOKKOS_INLINE_FUNCTION RemovalPlan cornerPlan(ReconstructionField const &field, CellComponents const &components,
                                              double sliver, RemovalPlan const &straight)
{
  constexpr double misfit_weight = 0.1, least_miss = 3e-5, much_better = 0.01, poor_misfit = 1e-2;
  if (components.count != 2 || components.material[1] != void_material)
    return straight;
  if (components.volume[0] < sliver || components.volume[1] < sliver)
    return straight;
  Vector2 const n = straight.component[0] == 0 ? straight.normal[0] : -straight.normal[0];
  Division const cut = divide(components.polygon, n, components.volume[0], components.volume[1], components.weight);
  double const smaller = Math::min(components.volume[0], components.volume[1]);
  Moments<1> const m = components.momentsOf(cut.inside);
  Vector2 const miss = Vector2{m.first(0), m.first(1)} + m.volume() * (cut.inside[0] - components.centroid[0]);
  // A convex corner's centroid lies farther out than the line's part.
  if (!(norm(miss) > least_miss * smaller) || dot(miss, n) > 0.0)
    return straight;
  CornerProblem const problem(field, components, misfit_weight);
  CornerCell const line = problem.straight(n);
  double misfit = 0.0;
  for (int j = 0; j < problem.count; ++j)
    misfit += line.residual[2 + j] * line.residual[2 + j];
  if (misfit <= misfit_weight * smaller * poor_misfit)
    return straight;
  double const error = line.error, angle = Math::atan2(n[1], n[0]);
  double const aside = 0.2 * smaller / components.volume[1];
  CornerCell start[3] = {problem.at(angle - 0.25 * Math::pi, angle + 0.25 * Math::pi, 0.5),
                         problem.at(angle, angle + 0.5 * Math::pi, 1.0 - aside),
                         problem.at(angle, angle - 0.5 * Math::pi, 1.0 - aside)};
  CornerCell cell = {};
  for (int tries = 0; tries < 2 && !(cell.error <= 1e-6 * error); ++tries)
  {
    int best = 0;
    for (int i = 1; i < 3; ++i)
      best = start[i].error < start[best].error ? i : best;
    CornerCell const trial = bestCornerCell(problem, start[best]);
    if (trial.error < cell.error)
      cell = trial;
    start[best].error = 1e300;
  }
  double const between = dot(cell.normal[0], cell.normal[1]);
  if (!(cell.error < much_better * error) || !(between < 0.866) || !(between > -0.866))
    return straight;
  RemovalPlan plan = straight;
  plan.corner = true;
  plan.void_part = cell.x[2] * components.volume[1];
  plan.set(0, 0, cell.normal[0]);
  plan.set(1, 1, cell.normal[1]);
  return plan;
}

} // namespace Harmos

#endif
