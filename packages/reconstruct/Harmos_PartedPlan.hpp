// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PARTED_PLAN_HPP
#define HARMOS_PARTED_PLAN_HPP

#include <Harmos_CornerCell.hpp>
#include <Harmos_FilmPlan.hpp>
#include <Harmos_PartedCell.hpp>
#include <Harmos_RemovalPlan.hpp>

namespace Harmos
{

constexpr double parting_misfit = 0.1; // of the smaller body's volume times the parting line's misfit

/// The parting line that cutting body 0, body 1 or the void off first would draw, the own lines placed anew.
HARMOS_LARGE_FUNCTION PartedCell partedAsOrder(PartingProblem const &problem, SliverBounds const &slivers, int first)
{
  CellComponents const &c = problem.components;
  auto const normalOf = [&](Region const &polygon, ComponentSet inside, ComponentSet outside) {
    return cutNormal(problem.field, c, ReconstructionMethod::MomentOfFluid, slivers, polygon, inside, outside).normal;
  };
  Vector2 normal;
  double void_part = first == 0 ? 0.0 : c.volume[2];
  if (first < 2)
    normal = (first == 0 ? 1.0 : -1.0) * normalOf(c.polygon, 1u << first, 7u & ~(1u << first));
  else
  {
    Division const open = divide(c.polygon, normalOf(c.polygon, 4u, 3u), c.volume[2], c.volumeOf(3u), c.weight);
    normal = normalOf(open.outside, 1u, 2u);
    Division const bodies = divide(open.outside, normal, c.volume[0], c.volume[1], c.weight);
    Region below;
    clip(open.inside, Plane2{normal, bodies.line.offset}, below);
    void_part = below.empty() ? 0.0 : c.volumeOfRegion(below);
  }
  return problem.at(Math::atan2(normal[1], normal[0]), void_part);
}

/// Whether the void lies beside the bodies, as at their ends, rather than between them: its centroid, seen from that of
/// both bodies, across the line from one to the other.
KOKKOS_INLINE_FUNCTION bool voidIsBeside(CellComponents const &c)
{
  Vector2 const both = (1.0 / c.volumeOf(3u)) * (c.volume[0] * c.centroid[0] + c.volume[1] * c.centroid[1]);
  Vector2 const apart = c.centroid[1] - c.centroid[0], towards = c.centroid[2] - both;
  return 2.0 * Math::fabs(cross(apart, towards)) > Math::fabs(dot(apart, towards));
}

/// Whether both bodies of a parted cell have void, each behind a line at an angle to the parting one whose squared
/// cosine is accepted.
template <class Accepts>
KOKKOS_INLINE_FUNCTION bool bothLines(PartedCell const &cell, Accepts const &accepts)
{
  bool both = true;
  for (int k = 0; k < 2; ++k)
  {
    double const along = dot(cell.own[k], cell.normal);
    both = both && cell.lined[k] && accepts(along * along);
  }
  return both;
}

/// Whether both bodies end in a parted cell: behind lines more than 45 degrees from the parting one.
KOKKOS_INLINE_FUNCTION bool bothEnd(PartedCell const &cell)
{
  return bothLines(cell, [](double squared) { return 2.0 * squared <= 1.0; });
}

/// Whether the void of a parted cell lies between its bodies: behind lines within 30 degrees of the parting one.
KOKKOS_INLINE_FUNCTION bool voidIsBetween(PartedCell const &cell)
{
  return bothLines(cell, [](double squared) { return 4.0 * squared > 3.0; });
}

/// A parted cell near a line that the neighbours agree to, where the error is at most exact: without one, the error of
/// what is returned is above it.
///
/// With the bodies left out, the neighbours' misfit alone is made least first, from twelve lines about Youngs' normal
/// between the bodies' fractions. No exact cell has a larger misfit than it may have error: beside a curved interface
/// the search ends here.
HARMOS_LARGE_FUNCTION PartedCell exactPartedCell(PartingProblem &problem, double exact)
{
  constexpr int angles = 3, parts = 4, lines = 2, line_steps = 8, max_steps = 20;
  constexpr double spread = 0.5; // between the angles
  CellComponents const &c = problem.components;
  Vector2 const apart = -youngsGradient(problem.field, c, {1u, 2u});
  double const middle = Math::atan2(apart[1], apart[0]);
  problem.line_alone = true;
  PartedCell line[lines] = {};
  for (int i = 0; i < angles; ++i)
  {
    PartedCell best = {};
    for (int j = 0; j < parts; ++j)
    {
      PartedCell const trial =
          problem.at(middle + (i - angles / 2) * spread, c.volume[2] * j / static_cast<double>(parts - 1));
      if (trial.error < best.error)
        best = trial;
    }
    int const worse = line[0].error > line[1].error ? 0 : 1;
    if (best.error < line[worse].error)
      line[worse] = best;
  }
  if (line[1].error < line[0].error)
  {
    PartedCell const first = line[1];
    line[1] = line[0];
    line[0] = first;
  }
  for (int l = 0; l < lines; ++l)
    line[l] = bestPartedCell(problem, line[l], line_steps);
  problem.line_alone = false;
  PartedCell cell = {};
  for (int l = 0; l < lines && !(cell.error <= exact); ++l)
    if (line[l].error <= exact)
      cell = bestPartedCell(problem, problem.at(line[l].angle, line[l].void_part), max_steps);
  return cell;
}

/// Two bodies and void, none a sliver, that the given sequence of cuts does not leave as they are: part the cell where
/// both bodies end there, and it suits their centroids better.
///
/// A void that seems to lie between the bodies is bounded by faces along that line; each body's own centroid places it,
/// and four free parameters would follow noise. Void whose centroid is not beside both bodies may be that, or, of
/// solids that have not flowed, at both ends, the one of them about to leave the cell. A body that one cut leaves
/// exact, as a rigid floor, seems to have no end there. In these cases only an exact cell is taken: an error, the
/// neighbours' misfit included, of at most 1e-4 of that of cutting in sequence (what bent edges leave of an exact one
/// is up to 2e-6 of it just before a corner leaves the cell). Where bodies below film_volume go by least squares, tips
/// leave no cell exact: there the sequence stays, and the neighbours' lines are not asked.
///
/// What a sequence of cuts misses while corners pass each other is little in a cycle, and forgotten with it: the next
/// one has the centroids of what was cut. The sum does not stay little: the line between the bodies turned upright
/// within a cell of slip, and the bodies were hooked to each other.
///
/// The search begins at the best of the lines that the three orders would draw, and at the next best where it ends
/// nowhere near an exact cell; then at the neighbours' lines.
HARMOS_LARGE_FUNCTION RemovalPlan partedPlan(ReconstructionField const &field, CellComponents const &components,
                                             SliverBounds const &slivers, RemovalPlan const &sequence)
{
  constexpr double near_exact = 1e-4; // of the sequence's error
  constexpr int max_steps = 20;
  if (components.count != 3 || components.material[2] != void_material || sequence.error <= removal_tie)
    return sequence;
  for (int k = 0; k < 3; ++k)
    if (components.volume[k] < slivers.of(components, k))
      return sequence;
  bool const wants_exact = slivers.of_body < film_volume;
  bool only_exact = !voidIsBeside(components);
  if (only_exact && !(wants_exact && mayHaveStraightEdges(field, components)))
    return sequence;
  PartingProblem problem(field, components, parting_misfit);
  PartedCell start[3];
  for (int first = 2; first >= 0 && !only_exact; --first)
  {
    start[first] = partedAsOrder(problem, slivers, first);
    only_exact = first == 2 ? voidIsBetween(start[first])
                            : dot(start[first].miss[first], start[first].miss[first]) <= removal_tie;
  }
  if (only_exact && !wants_exact)
    return sequence;
  double const exact = near_exact * sequence.error;
  PartedCell cell = {};
  for (int tries = 0; tries < (only_exact ? 0 : 2) && !(cell.error <= exact); ++tries)
  {
    int best = 0;
    for (int first = 1; first < 3; ++first)
      best = start[first].error < start[best].error ? first : best;
    PartedCell const trial = bestPartedCell(problem, start[best], max_steps);
    if (trial.error < cell.error)
      cell = trial;
    start[best].error = 1e300;
  }
  if (wants_exact && !(cell.error <= exact))
  {
    PartedCell const trial = exactPartedCell(problem, exact);
    if (trial.error <= exact)
      cell = trial;
  }
  if (!bothEnd(cell) || !(dot(cell.miss[0], cell.miss[0]) + dot(cell.miss[1], cell.miss[1]) < sequence.error))
    return sequence;
  RemovalPlan plan = sequence;
  plan.parted = true;
  plan.error = cell.error;
  plan.void_part = cell.void_part;
  plan.unfinished += cell.converged ? 0 : 1;
  plan.set(0, 0, cell.normal);
  plan.set(1, 1, cell.own[0]);
  plan.set(2, 2, cell.own[1]);
  return plan;
}

/// Whether a cell's void is small enough for a film between bodies, and no sliver by volume.
KOKKOS_INLINE_FUNCTION bool mayBeFilm(CellComponents const &components, double sliver)
{
  int const last = components.count - 1;
  double const volume = components.volume[last];
  return components.material[last] == void_material && volume >= sliver && volume < film_volume;
}

/// Whether a plan that is a sequence of two bodies and void puts the void beyond the line between the bodies, seen from
/// all void of its neighbours.
///
/// A tip of void comes in from there. Overlaps along the line between the bodies move the centroid of 1e-5 of the cell
/// by a part of the cell: void took the corner of the one that goes on below, though it is the other that ends.
HARMOS_LARGE_FUNCTION bool voidIsAcross(ReconstructionField const &field, CellComponents const &components,
                                        RemovalPlan const &plan)
{
  if (components.count != 3 || components.material[2] != void_material || plan.parted || plan.corner || plan.apart ||
      plan.filmed)
    return false;
  int const between = plan.component[0] == 2 ? 1 : 0; // the cut with a body on either side
  Region polygon = components.polygon;
  ComponentSet rest = components.all();
  Plane2 line = {};
  Region open;
  for (int i = 0; i < 2; ++i)
  {
    int const k = plan.component[i];
    rest &= ~(1u << k);
    Division const cut =
        divide(polygon, plan.normal[i], components.volume[k], components.volumeOf(rest), components.weight);
    if (i == between)
      line = cut.line;
    if (k == 2)
      open = cut.inside;
    polygon = cut.outside;
  }
  if (plan.component[2] == 2)
    open = polygon;
  if (open.empty())
    return false;
  Vector2 const own = open[0] + components.momentsOf(open).centroid();
  double const side = dot(line.normal, own) - line.offset;
  bool some = false;
  Rows const &neighbours = field.mesh.cell_neighbour;
  for (int n = neighbours.offset(components.cell); n < neighbours.offset(components.cell + 1); ++n)
  {
    int const cell = neighbours.item(n);
    if (setFraction(field, components, 1u << 2, cell) < open_volume || componentCount(field, cell) > max_components)
      continue;
    CellComponents const there = cellComponents(field, cell, true);
    Vector2 const centroid = components.toUnit(there.fromUnit(there.centroid[there.count - 1]));
    if ((dot(line.normal, centroid) - line.offset) * side > 0.0)
      return false;
    some = true;
  }
  return some;
}

/// Void below `film_volume` is one of two things. The tip of a void that comes in from a neighbour, as when a body's
/// corner slides over another body's face: its centroid says where it is, while least squares, which see straight
/// bodies, lay it between them as a film. Or a film between two bodies that touch: its centroid is what the errors of
/// theirs leave, and where it lies along the film turns the line; least squares keep it still. Or both (see
/// filmPlan).
///
/// So where a neighbour is open the cell, cut by least squares (the given plan), is cut once more by void's centroid.
/// That counts where it leaves no first moment off by more than a tenth of the void's volume. Nothing is tried where
/// the bodies miss 30 times that volume already: at a curved interface.
HARMOS_LARGE_FUNCTION RemovalPlan planForThinVoid(ReconstructionField const &field, CellComponents const &components,
                                                  SliverBounds const &films, RemovalPlan const &plan)
{
  constexpr double least_miss = 0.1, most_miss = 30.0; // of the void's volume
  int const last = components.count - 1;
  double const volume = components.volume[last];
  if (!mayBeFilm(components, films.of_body) || plan.error <= removal_tie)
    return plan;
  bool const may_be_tip = Detail::isOpenNear(field, components);
  if (!may_be_tip && components.count != 4)
    return plan;
  SliverBounds tips = films;
  tips.of_void = films.of_body;
  double const error = momentErrors(components, films, plan);
  if (error > most_miss * most_miss * volume * volume)
    return plan;
  if (may_be_tip)
  {
    RemovalPlan const tip = partedPlan(field, components, tips, bestPlan(field, components, tips));
    if (tip.error <= least_miss * least_miss * volume * volume && tip.error < plan.error &&
        !voidIsAcross(field, components, tip) && suitsNeighbours(field, components, plan, tip))
      return tip;
  }
  return filmPlan(field, components, films, plan, error);
}

} // namespace Harmos

#endif
