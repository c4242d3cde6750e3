// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FILM_PLAN_HPP
#define HARMOS_FILM_PLAN_HPP

#include <Harmos_ContinuedLines.hpp>
#include <Harmos_CornerCell.hpp>

namespace Harmos
{

/// A cell that is cut as a filmed plan says.
struct FilmedCell
{
  Region region[max_exhaustive_components]; // of the bodies, by component
  Vector2 miss[max_exhaustive_components];  // their first moments found, less the given ones
  double error = 0.0;                       // sum of their squares
};

/// Cuts off what a filmed plan has before its last two bodies, and returns what is left.
/// \param in_place Of the void: what lies where the plan has it.
/// \param region Takes the regions of the bodies that are cut off, by component; may be null.
HARMOS_LARGE_FUNCTION Region beforeLastTwo(CellComponents const &components, RemovalPlan const &plan, double in_place,
                                           Region *region = nullptr)
{
  int const open = components.count - 1;
  Region polygon = components.polygon;
  double rest = 1.0;
  for (int i = 0; i + 2 < components.count; ++i)
  {
    int const k = plan.component[i];
    double const volume = k == open ? in_place : components.volume[k];
    rest -= volume;
    if (!(volume > least_void))
      continue;
    Division const division = divide(polygon, plan.normal[i], volume, rest, components.weight);
    if (region != nullptr && k != open)
      region[k] = division.inside;
    polygon = division.outside;
  }
  return polygon;
}

/// \param plan Void neither last nor last but one; the normal before the last leaves the last body but one.
/// \param in_place Of the void: what is cut off where the plan has it. The rest is a film between the last two bodies,
/// parallel to their line.
HARMOS_LARGE_FUNCTION FilmedCell filmedCell(CellComponents const &components, RemovalPlan const &plan, double in_place)
{
  int const count = components.count, open = count - 1;
  int const near = plan.component[count - 2], far = plan.component[count - 1];
  Vector2 const &normal = plan.normal[count - 2];
  double const film = components.volume[open] - in_place;
  FilmedCell cell;
  Region const polygon = beforeLastTwo(components, plan, in_place, cell.region);
  Division const two =
      divide(polygon, normal, components.volume[near], components.volume[far] + film, components.weight);
  cell.region[near] = two.inside;
  cell.region[far] = film > least_void
                         ? divide(two.outside, normal, film, components.volume[far], components.weight).outside
                         : two.outside;
  for (int k = 0; k < open; ++k)
  {
    cell.miss[k] = cell.region[k].empty() ? Vector2{1.0, 0.0} : components.firstMiss(cell.region[k], k);
    cell.error += dot(cell.miss[k], cell.miss[k]);
  }
  return cell;
}

/// Places the line between the last two bodies by the centroid of the smaller one, and shares the void: the misses are
/// linear in the film's part as long as it is thin, and the sum of their squares is made least. Twice, since the part
/// that lies before the two bounds them.
/// \param plan Void not last nor last but one.
HARMOS_LARGE_FUNCTION void placeFilms(CellComponents const &components, RemovalPlan &plan)
{
  constexpr int passes = 2;
  int const count = components.count, open = count - 1;
  double const all = components.volume[open];
  int const a = plan.component[count - 2], b = plan.component[count - 1];
  int const smaller = components.volume[a] <= components.volume[b] ? a : b;
  plan.filmed = true;
  plan.void_part = 0.0;
  plan.component[count - 2] = smaller;
  plan.component[count - 1] = a + b - smaller;
  for (int pass = 0; pass < passes; ++pass)
  {
    MomentOfFluidLine const line =
        momentOfFluidLine(beforeLastTwo(components, plan, plan.void_part), components.volume[smaller],
                          components.centroid[smaller], components.weight);
    plan.normal[count - 2] = line.normal;
    plan.unfinished += line.converged ? 0 : 1;
    FilmedCell const none = filmedCell(components, plan, all), whole = filmedCell(components, plan, 0.0);
    double along = 0.0, squared = 0.0;
    for (int k = 0; k < open; ++k)
    {
      Vector2 const change = whole.miss[k] - none.miss[k];
      along -= dot(none.miss[k], change);
      squared += dot(change, change);
    }
    plan.void_part = all * (1.0 - (squared > 0.0 ? Math::clamp(along / squared, 0.0, 1.0) : 0.0));
  }
  plan.error = filmedCell(components, plan, plan.void_part).error;
}

/// Whether the lines of a sequence of cuts, continued, suit the neighbours as well as those of the given one do, or
/// miss them by no tenth of a cell. Three bodies with straight edges, and void; lines of others end in the cell.
HARMOS_LARGE_FUNCTION bool suitsNeighbours(ReconstructionField const &field, CellComponents const &components,
                                           RemovalPlan const &given, RemovalPlan const &sequence)
{
  if (components.count != 4 || !mayHaveStraightEdges(field, components))
    return true;
  BodyAround const around[3] = {BodyAround(field, components, 0), BodyAround(field, components, 1),
                                BodyAround(field, components, 2)};
  double const misfit = continuedMisfit(components, sequence, around);
  return misfit <= poor_continuation || misfit <= continuedMisfit(components, given, around);
}

/// The lines of a filmed plan of three bodies, its films closed.
KOKKOS_INLINE_FUNCTION RemovalPlan withoutFilms(RemovalPlan const &film)
{
  RemovalPlan lines = film;
  lines.filmed = false;
  lines.set(1, film.component[2], film.normal[2]);
  lines.set(2, film.component[3], -film.normal[2]);
  lines.set(3, film.component[1], {0.0, 0.0});
  return lines;
}

/// Three bodies, none a sliver, and void below `film_volume`: two films, along one body that is cut off first and
/// between the other two. That body is the one along which least squares have put all void, where two films halve what
/// the given plan misses of the bodies' first moments; or any, where they leave a third of it and, if the given plan
/// cuts off another first, the neighbours agree (suitsNeighbours: what bent edges leave of the moments may be less for
/// a plan that takes the bar's tip away).
///
/// At a T, where two bodies face each other beyond a third, least squares see the bar: its edge goes on in all
/// neighbours, the line between the two in those beyond it alone. All void came to lie along the bar, and the next
/// centroids came from there: the ends of two blocks that part from each other stood off the third by a wedge that
/// grew. What the void misses there grows with it, until a sequence misses less that cuts a block's line on through the
/// bar: the bar lost its tip to the block, and both hooked to each other.
/// \param error Of the given plan: sum over the bodies of momentError.
HARMOS_LARGE_FUNCTION RemovalPlan filmPlan(ReconstructionField const &field, CellComponents const &components,
                                           SliverBounds const &slivers, RemovalPlan const &given, double error)
{
  constexpr double much_better = 0.25, with_another_first = 0.1; // of the error
  constexpr int open = 3;
  if (components.count != 4 || given.parted || error <= removal_tie)
    return given;
  for (int k = 0; k < open; ++k)
    if (components.volume[k] < slivers.of(components, k))
      return given;
  RemovalPlan best = given;
  double least = error;
  int unfinished = given.unfinished;
  for (int first = 0; first < open; ++first)
  {
    bool const as_given = first == given.component[0] && given.component[1] == open;
    ComponentSet const others = components.all() & ~(1u << first);
    RemovalPlan plan = given;
    plan.unfinished = 0;
    plan.set(0, first, given.normal[0]);
    if (!as_given)
    {
      CutNormal const cut = cutNormal(field, components, ReconstructionMethod::MomentOfFluid, slivers,
                                      components.polygon, 1u << first, others);
      plan.normal[0] = cut.normal;
      plan.unfinished = cut.converged ? 0 : 1;
    }
    plan.set(1, open, plan.normal[0]);
    for (int i = 2; i < 4; ++i) // placeFilms draws their line
      plan.set(i, (first + i - 1) % open, {1.0, 0.0});
    placeFilms(components, plan);
    unfinished += plan.unfinished;
    if (plan.error < (as_given ? much_better : with_another_first) * error && plan.error < least &&
        (first == given.component[0] || suitsNeighbours(field, components, given, withoutFilms(plan))))
    {
      best = plan;
      least = plan.error;
    }
  }
  best.unfinished = unfinished;
  return best;
}

} // namespace Harmos

#endif
