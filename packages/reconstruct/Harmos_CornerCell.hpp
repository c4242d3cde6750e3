// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CORNER_CELL_HPP
#define HARMOS_CORNER_CELL_HPP

#include <Harmos_BridgedRegion.hpp>
#include <Harmos_CornerProblem.hpp>
#include <Harmos_RemovalPlan.hpp>

namespace Harmos
{

/// Mean over the neighbours of (fraction behind a straight line between a body and void - fraction of the body)^2.
KOKKOS_INLINE_FUNCTION double straightMisfit(ReconstructionField const &field, CellComponents const &components,
                                             int body, Region const &polygon, Vector2 const &normal)
{
  if (isAtWall(field, components.cell)) // beyond which the line may be missed as well
  {
    double const volume = components.volume[body], open = components.volume[components.count - 1];
    Plane2 const line = partBehind(polygon, normal, volume, open, components.weight).line;
    BodyAround const around(field, components, body);
    double sum = 0.0;
    for (int j = 0; j < around.count; ++j)
    {
      double const miss = around.miss(j, &line, 1);
      sum += miss * miss;
    }
    return sum / Math::max(1, around.count);
  }
  CellNeighbours const neighbours(field, components);
  FractionDifference const set{1u << body, 0u};
  Detail::LineFitProblem problem{
      neighbours, polygon, components.volume[body], components.volume[components.count - 1], set, true, {}};
  problem.store(NeighbourValues(field, components, neighbours, set));
  return Detail::lineMisfit(problem, normal).value;
}

/// Whether a cell lacks some of the eight cells around it.
KOKKOS_INLINE_FUNCTION bool isAtBoundary(ReconstructionField const &field, int cell)
{
  return field.mesh.cell_neighbour.offset(cell + 1) - field.mesh.cell_neighbour.offset(cell) != 8;
}

/// Whether a body's matter has flowed in a cell.
KOKKOS_INLINE_FUNCTION bool hasFlowed(ReconstructionField const &field, CellComponents const &components, int body)
{
  return hasFlowed(field.record(field.pairs.find(components.cell, components.material[body]), PlasticStrain));
}

/// Whether a body has no strength.
KOKKOS_INLINE_FUNCTION bool isFluid(ReconstructionField const &field, CellComponents const &components, int body)
{
  return field.fluid.extent(0) > 0 && field.fluid(components.material[body]) == 1;
}

/// Whether all bodies of a cell may have straight edges: none is a fluid, none has flowed.
KOKKOS_INLINE_FUNCTION bool mayHaveStraightEdges(ReconstructionField const &field, CellComponents const &components)
{
  for (int k = 0; k < components.count; ++k)
    if (components.material[k] != void_material && (isFluid(field, components, k) || hasFlowed(field, components, k)))
      return false;
  return true;
}

/// Whether a cell around one holds a material that is none of its own.
KOKKOS_INLINE_FUNCTION bool othersAround(ReconstructionField const &field, CellComponents const &components)
{
  Rows const &around = field.mesh.cell_neighbour;
  for (int e = around.offset(components.cell); e < around.offset(components.cell + 1); ++e)
    for (int pair = field.pairs.offset(around.item(e)); pair < field.pairs.offset(around.item(e) + 1); ++pair)
    {
      int const material = field.pairs.material(pair);
      bool own = false;
      for (int k = 0; k < components.count; ++k)
        own = own || components.material[k] == material;
      if (!own)
        return true;
    }
  return false;
}

/// The corner of a body in the polygon that it shares with void, where two lines are exact and one is not: an error of
/// at most 1e-6 of that of the straight line. Elsewhere, as at curved surfaces, the error of what is returned is above.
///
/// Most cells are left after a look at the centroid, for a convex corner's lies farther out than the straight line's
/// part, and at the neighbours: the line through a corner's cell misses theirs by a tenth of a cell, and they hold what
/// lies beyond the corner. Nor has matter straight edges that has flowed; but it may be drawn out to a plate thinner
/// than a cell, and beyond a second body what goes on is not known. (In a cloud of debris all but 2% of the searches
/// ended nowhere, most of them in such matter, half of them in fragments.)
///
/// \param normal Of the straight line; leaves the body.
/// \param poor_misfit That of the straight line (straightMisfit) from which on it is looked for a corner; at the
///                    boundary a tenth.
/// \param thorough Of a body drawn alone, whose matter has not flowed: look also where the neighbours hardly miss the
///                 straight line, search to the end, and take tips at 1e-4 of the straight line's error.
/// \param edges What of the corner's edges is asked for.
HARMOS_LARGE_FUNCTION CornerCell exactCornerCell(ReconstructionField const &field, CellComponents const &components,
                                                 int body, Region const &polygon, Plane2 const *rim,
                                                 Vector2 const &normal, bool thorough, double poor_misfit = 1e-2,
                                                 CornerEdges edges = CornerEdges::Straight)
{
  double const hopeful = thorough ? 1e300 : 1e-3;
  constexpr double misfit_weight = 0.1, least_miss = 1e-9, near_exact = 1e-6, near_tip = 1e-4, near_bent = 1e-3;
  constexpr double quarter = 0.7853981633974483; // of pi
  constexpr int starts = 7, most_searches = 3;
  constexpr double centroid_first = 1e-3, shortest_bent = 0.1;
  constexpr double at_boundary = 0.1; // where cells are missing that would tell a tip before the boundary
  double const volume = components.volume[body], open = components.volume[components.count - 1];
  double const smaller = Math::min(volume, open);
  PartBehind const straight = partBehind(polygon, normal, volume, open, components.weight);
  Vector2 const miss = components.firstMiss(straight.inside, body);
  if (!(norm(miss) > least_miss * smaller) || dot(miss, normal) > 0.0 ||
      (!thorough && !(straightMisfit(field, components, body, polygon, normal) >
                      (isAtBoundary(field, components.cell) ? at_boundary : 1.0) * poor_misfit)))
    return {};
  CornerProblem problem(field, components, body, polygon, rim, misfit_weight);
  if (!problem.around.isTold())
    return {};
  CornerCell one_line;
  problem.measure(straight.inside, &straight.line, 1, one_line);
  double const near = edges == CornerEdges::Bent ? near_bent : thorough && volume < film_volume ? near_tip : near_exact;
  double const exact = near * one_line.error;
  double const angle = Math::atan2(normal[1], normal[0]);
  // Where the first line goes through the body's middle, what it leaves void.
  auto const openBeyond = [&](double of_angle)
  {
    Vector2 const n{Math::cos(of_angle), Math::sin(of_angle)};
    Region beyond;
    clip(polygon, Plane2{-n, -dot(n, components.centroid[body])}, beyond);
    return beyond.empty() ? 0.0 : Math::min(1.0, components.volumeOfRegion(beyond) / open);
  };
  double const aside = 0.2 * smaller / open, low = angle - quarter, high = angle + quarter;
  double const x[starts][CornerCell::unknowns] = {{low, high, 0.5},
                                                  {angle - 1.6 * quarter, angle + 1.6 * quarter, 0.5},
                                                  {angle - 0.4 * quarter, angle + 0.4 * quarter, 0.5},
                                                  {low, high, openBeyond(low)},
                                                  {high, low, openBeyond(high)},
                                                  {angle, angle + 2.0 * quarter, 1.0 - aside},
                                                  {angle, angle - 2.0 * quarter, 1.0 - aside}};
  // A plate thinner than a cell has two parallel faces: the straight line's part, shifted to the centroid.
  double const strip[CornerCell::unknowns] = {angle, angle + 4.0 * quarter, 1.0 + dot(miss, normal) / open};
  CornerCell cell = problem.at(strip);
  if (cell.error <= hopeful * one_line.error)
    cell = bestCornerCell(problem, cell, hopeful * one_line.error);
  bool const fragment = rim == nullptr && !problem.around.goesOn(volume);
  bool const flowed = !thorough && hasFlowed(field, components, body);
  if ((flowed || fragment) && !(cell.error <= exact))
    return {};
  CornerCell start[starts], nearest;
  for (int i = 0; i < starts && !(cell.error <= exact); ++i)
    start[i] = problem.at(x[i]);
  for (int tries = 0; tries < most_searches && !(cell.error <= exact); ++tries)
  {
    int best = 0;
    for (int i = 1; i < starts; ++i)
      best = start[i].error < start[best].error ? i : best;
    cell = start[best];
    if (volume < film_volume)
    {
      // The neighbours outweigh the centroid of a tip by far, and would end the search beside it.
      problem.scale *= centroid_first;
      cell = bestCornerCell(problem, problem.at(cell.x), 1e300);
      problem.scale /= centroid_first;
      cell = problem.at(cell.x);
    }
    cell = bestCornerCell(problem, cell, hopeful * one_line.error);
    start[best].error = 1e300;
    nearest = cell.error < nearest.error ? cell : nearest;
  }
  if (!(cell.error <= exact) && edges == CornerEdges::BentElsewhere && nearest.error <= near_bent * one_line.error &&
      nearest.shorterEdge() >= shortest_bent && !components.isExact(1u << body) &&
      mayHaveStraightEdges(field, components) &&
      (isAtBoundary(field, components.cell) ? isAtWall(field, components.cell) : othersAround(field, components)))
    cell = nearest;
  else if (!(cell.error <= exact))
  {
    cell.error = 1e300;
    return cell;
  }
  // Where bent edges leave something, the neighbours have their say after the body's centroid.
  double const found = cell.error;
  problem.scale *= centroid_first;
  cell = bestCornerCell(problem, problem.at(cell.x), 1e300);
  cell.error = found;
  return cell;
}

/// Whether both lines of a corner cut tips off their polygon, none of half a cell's length. Void below film_volume that
/// lies all along a face of the cell is what a bent edge leaves, and no corner.
KOKKOS_INLINE_FUNCTION bool cutsTips(CellComponents const &components, Region const &polygon, CornerCell const &cell,
                                     double volume, double void_volume)
{
  constexpr double longest = 0.5; // of the cell's side
  double const rest = void_volume - cell.open;
  PartBehind const one = partBehind(polygon, cell.line[0].normal, volume + rest, cell.open, components.weight);
  PartBehind const two = partBehind(one.inside, cell.line[1].normal, volume, rest, components.weight);
  return norm(one.chord_end - one.chord_begin) < longest && norm(two.chord_end - two.chord_begin) < longest;
}

/// What lies around a convex corner: all of a polygon but what two divisions, the second of the first one's inside,
/// leave of it. Not convex. Empty where their lines do not meet in the polygon.
HARMOS_LARGE_FUNCTION Region aroundCorner(Division const &one, Division const &two)
{
  auto const same = [](Vector2 const &a, Vector2 const &b) { return a[0] == b[0] && a[1] == b[1]; };
  Region const &first = one.outside, &second = two.outside;
  int begin = -1; // of the first part's way around that ends with the chord
  for (int i = 0; i < first.size; ++i)
  {
    Vector2 const &a = first[i], &b = first[(i + 1) % first.size];
    if ((same(a, one.chord_begin) && same(b, one.chord_end)) || (same(a, one.chord_end) && same(b, one.chord_begin)))
      begin = (i + 1) % first.size;
  }
  int shared = -1, num_shared = 0; // end of the first chord that the second line cuts off
  for (int i = 0; i < second.size; ++i)
    if (same(second[i], one.chord_begin) || same(second[i], one.chord_end))
    {
      shared = i;
      ++num_shared;
    }
  Region around;
  if (begin < 0 || num_shared != 1 || first.size + second.size - 1 > max_region_vertices)
    return around;
  for (int i = 0; i < first.size; ++i)
    around.push(first[(begin + i) % first.size]);
  for (int i = 1; i < second.size; ++i)
    around.push(second[(shared + i) % second.size]);
  return around;
}

/// What two divisions, the second of the first one's inside, leave of a cell where their lines do not meet in it: two
/// regions, bridged between vertices that lie on no face of the cell together. Empty where they meet.
HARMOS_LARGE_FUNCTION Region onBothSides(CellComponents const &components, Division const &one, Division const &two)
{
  constexpr double near = 1e-9; // [cells]
  auto const same = [](Vector2 const &a, Vector2 const &b) { return a[0] == b[0] && a[1] == b[1]; };
  Region const &first = one.outside, &second = two.outside, &cell = components.polygon;
  for (int i = 0; i < first.size; ++i)
    for (int j = 0; j < second.size; ++j)
      if (same(first[i], second[j]))
        return {};
  for (int i = 0; i < first.size; ++i)
    for (int j = 0; j < second.size; ++j)
    {
      bool along = false;
      for (int k = 0; k < cell.size; ++k)
      {
        Plane2 const face = edgeLine(cell[k], cell[cell.next(k)]);
        double const of_one = norm(face.normal) * near;
        along =
            along || (Math::fabs(face.distance(first[i])) < of_one && Math::fabs(face.distance(second[j])) < of_one);
      }
      bool const on_chords = (same(first[i], one.chord_begin) || same(first[i], one.chord_end)) &&
                             (same(second[j], two.chord_begin) || same(second[j], two.chord_end));
      if (on_chords && !along)
        return bridged(first, i, second, j);
    }
  return {};
}

/// Void, of the cell, that is a film between a body and what lies around its corner.
constexpr double most_void_around = 1e-5;

/// The regions of a body with a corner inside of another one. What void there is lies between them, along the second
/// line.
struct EmbeddedCorner
{
  Region inside, around; // empty where the lines do not meet in the cell
};

HARMOS_LARGE_FUNCTION EmbeddedCorner embeddedCorner(CellComponents const &components, int body, int other,
                                                    Vector2 const &first, Vector2 const &second, double first_part)
{
  double const own = components.volume[body], rest = components.volume[other] - first_part;
  double const open = components.count > 2 ? components.volume[2] : 0.0;
  Division const one = divide(components.polygon, first, own + open + rest, first_part, components.weight);
  Division const two = divide(one.inside, second, own + open, rest, components.weight);
  EmbeddedCorner corner;
  corner.around = aroundCorner(one, two);
  if (!corner.around.empty())
    corner.inside = open > 0.0 ? partBehind(two.inside, second, own, open, components.weight).inside : two.inside;
  return corner;
}

/// One body of two, and all the rest as the other, which stands where void does.
HARMOS_LARGE_FUNCTION CellComponents bodyAndRest(CellComponents const &components, int body, int other)
{
  CellComponents ordered = components;
  ordered.count = 2;
  ordered.exact = 0u;
  int const number[2] = {body, other};
  for (int k = 0; k < 2; ++k)
  {
    ordered.material[k] = components.material[number[k]];
    ordered.volume[k] = components.volume[number[k]];
    ordered.centroid[k] = components.centroid[number[k]];
    ordered.exact |= components.isExact(1u << number[k]) ? 1u << k : 0u;
  }
  ordered.volume[1] += components.count > 2 ? components.volume[2] : 0.0;
  return ordered;
}

/// Two bodies that fill a cell (but for a film of void), none a sliver, neither has flowed, and a straight line does
/// not leave them as they are: where one ends in a convex corner inside of the other, two lines leave both as they are.
/// Where a third is near by most searches would find no corner.
///
/// One of them is a fluid: its pressure acts on every side of its region, and drives it out at the ends of a chord.
HARMOS_LARGE_FUNCTION RemovalPlan embeddedCornerPlan(ReconstructionField const &field, CellComponents const &components,
                                                     SliverBounds const &slivers, RemovalPlan const &given)
{
  for (int k = 0; k < 2; ++k)
    if (components.volume[k] < slivers.of(components, k) || hasFlowed(field, components, k))
      return given;
  if (othersAround(field, components))
    return given;
  // Of the straight line: of corners 0.04 and more, beside round sides half is below.
  constexpr double poor_misfit = 0.02;
  for (int body = 0; body < 2; ++body)
  {
    int const other = 1 - body;
    CellComponents const ordered = bodyAndRest(components, body, other);
    Vector2 const normal =
        momentOfFluidLine(components.polygon, ordered.volume[0], ordered.centroid[0], components.weight).normal;
    CornerCell const cell = exactCornerCell(field, ordered, 0, components.polygon, nullptr, normal, false, poor_misfit);
    if (cell.error == 1e300)
      continue;
    RemovalPlan plan = given;
    plan.count = components.count;
    plan.corner = plan.embedded = true;
    plan.parted = false;
    plan.set(0, body, cell.line[0].normal);
    plan.set(1, other, cell.line[1].normal);
    if (components.count > 2)
      plan.set(2, 2, {0.0, 0.0});
    plan.void_part = Math::min(cell.open, components.volume[other]);
    plan.error = cell.error;
    if (!embeddedCorner(components, body, other, plan.normal[0], plan.normal[1], plan.void_part).around.empty())
      return plan;
  }
  return given;
}

/// Bodies and void, none a sliver, that the given plan does not leave as they are: where one body ends in a convex
/// corner, alone or beyond another body that a straight line cuts off exactly, two lines between it and the void leave
/// all as they are. Two bodies without void: embeddedCornerPlan. What presses the tip in the next cell bends the edges
/// of a body that is alone in its cell: where another one is around, two lines of a tenth of a cell at least that leave
/// a thousandth will do. (One line in the place of two broke the outline, and nothing felt the corner for 20 cycles.)
/// \param bends Whether what presses the corner may bend its edges (CornerEdges::Bent).
HARMOS_LARGE_FUNCTION RemovalPlan cornerPlan(ReconstructionField const &field, CellComponents const &components,
                                             SliverBounds const &slivers, RemovalPlan const &given, bool bends = false)
{
  // Squared misses of the body that a straight line cuts off; the second, where edges bend, of what the plan misses.
  constexpr double exact_miss = 1e-20, near_exact = 1e-6;
  constexpr double poor_misfit = 1e-2;
  int const bodies = components.count - 1;
  bool const filled = components.material[bodies] != void_material;
  if (given.error > removal_tie && components.material[1] != void_material &&
      (isFluid(field, components, 0) || isFluid(field, components, 1)) &&
      (components.count == 2 ? filled : components.count == 3 && !filled && components.volume[2] < most_void_around))
    return embeddedCornerPlan(field, components, slivers, given);
  if (bodies > 2 || components.material[bodies] != void_material || given.error <= removal_tie)
    return given;
  bool const thin = bodies == 1 && components.volume[1] < slivers.of_void;
  for (int k = 0; k < components.count; ++k)
    if (components.volume[k] < (thin ? slivers.of_body : slivers.of(components, k)))
      return given;
  RemovalPlan plan = given;
  plan.corner = true;
  plan.parted = false;
  for (int body = 0; body < bodies; ++body)
  {
    // Cuts of the given sequence are used again where they are the same.
    auto const lastCut = [&](int i) { return given.component[i] == body ? given.normal[i] : -given.normal[i]; };
    Region polygon = components.polygon;
    Plane2 line;
    Vector2 normal = given.normal[0];
    if (bodies == 1)
      normal = lastCut(0);
    else
    {
      int const other = 1 - body;
      bool const same = given.component[0] == other;
      auto const cut = [&](ComponentSet inside, ComponentSet outside)
      {
        CutNormal const found =
            cutNormal(field, components, ReconstructionMethod::MomentOfFluid, slivers, polygon, inside, outside);
        plan.unfinished += found.converged ? 0 : 1;
        return found.normal;
      };
      Vector2 const first = same ? given.normal[0] : cut(1u << other, (1u << body) | (1u << bodies));
      Division const division = divide(polygon, first, components.volume[other],
                                       components.volume[body] + components.volume[bodies], components.weight);
      double const most_miss = bends ? Math::max(exact_miss, near_exact * given.error) : exact_miss;
      if (momentError(components, slivers, division.inside, other, first) > most_miss)
        continue;
      plan.set(0, other, first);
      polygon = division.outside;
      line = division.line;
      normal = same ? lastCut(1) : cut(1u << body, 1u << bodies);
    }
    CornerEdges const edges = bends                  ? CornerEdges::Bent
                              : bodies == 1 && !thin ? CornerEdges::BentElsewhere
                                                     : CornerEdges::Straight;
    CornerCell const cell = exactCornerCell(field, components, body, polygon, bodies == 2 ? &line : nullptr, normal,
                                            false, poor_misfit, edges);
    if (cell.error == 1e300)
      continue;
    if (thin && !cutsTips(components, polygon, cell, components.volume[0], components.volume[1]))
      continue;
    plan.set(bodies - 1, body, cell.line[0].normal);
    plan.set(bodies, bodies, cell.line[1].normal);
    plan.void_part = cell.open;
    plan.error = cell.error;
    return plan;
  }
  return given;
}

/// Two solids that have not flowed, and void, that all exact plans leave: a corner of one that stands on the face of
/// the other, which bends its edges. (Six cycles after they had touched, at 20 m/s, steel's left more than an exact
/// one.)
///
/// Both edges rise from the face: where one lies on it a sequence of cuts has it.
HARMOS_LARGE_FUNCTION RemovalPlan pressedCornerPlan(ReconstructionField const &field, CellComponents const &components,
                                                    SliverBounds const &slivers, RemovalPlan const &given)
{
  constexpr double least_rise = 0.05; // sine of the angle between face and edge
  if (components.count != 3 || components.material[2] != void_material || !mayHaveStraightEdges(field, components))
    return given;
  RemovalPlan const plan = cornerPlan(field, components, slivers, given, true);
  bool const rises = Math::fabs(cross(plan.normal[0], plan.normal[1])) >= least_rise &&
                     Math::fabs(cross(plan.normal[0], plan.normal[2])) >= least_rise;
  return plan.corner && rises && plan.error <= given.error ? plan : given;
}

} // namespace Harmos

#endif
