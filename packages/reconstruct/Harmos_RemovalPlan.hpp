// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMOVAL_PLAN_HPP
#define HARMOS_REMOVAL_PLAN_HPP

#include <Harmos_Clip.hpp>
#include <Harmos_LeastSquaresLine.hpp>
#include <Harmos_MomentOfFluid.hpp>
#include <Harmos_Reconstruct.hpp>

namespace Harmos
{

constexpr int max_exhaustive_components = 5; // more are cut off greedily

/// In which order a cell's components are cut off, and with which normals; the last one keeps the remainder. Or the
/// cell is parted: normal[0] leaves the part that component 0 shares with void_part of the void, normal[1] and
/// normal[2] leave components 0 and 1 in their parts. Or the last body that is left has a corner: of the polygon that
/// it shares with void (or, of two bodies that fill the cell, with the other one) the last two normals, which leave the
/// body, cut off void_part and then the rest of the void (of the other body). Or
/// void is in two places: void_part of it where the plan has it, the rest between the last two bodies, along their
/// line. Or component 0 of the plan is a rigid body's corner that the first two normals leave, void_part the first, and
/// normal[2] leaves component 1 in what is around it. Or component 0 of the plan is a rigid body with a notch: the
/// first two normals, which leave the notch, cut void_part and then the rest of the body off the cell, and the others
/// share the notch in sequence, by normal[i + 1] for component i. Or the bodies are apart: normal[2 k], which leaves
/// body k, cuts open[k] off the cell, normal[2 k + 1] the rest of what body k does not fill.
struct RemovalPlan
{
  static constexpr int most_apart = 3; // bodies

  int count = 0;
  int component[max_components];
  Vector2 normal[max_components]; // of the cut that removes component[i], leaves it; i < count - 1
  double error = 0.0;             // the measure that orders are compared by
  int unfinished = 0;             // searches for an angle, in all orders tried, that met their bound
  bool embedded = false;          // corner: inside of the other body
  bool parted = false, corner = false, filmed = false, apart = false, dented = false, notched = false;
  double void_part = 0.0;       // of the cell
  double open[most_apart] = {}; // of the cell

  KOKKOS_INLINE_FUNCTION void set(int i, int which, Vector2 const &its_normal)
  {
    component[i] = which;
    normal[i] = its_normal;
  }
};

constexpr double sliver_penalty = 0.1; // of its volume times its line's misfit
constexpr double thin_volume = 1e-3;   // of the cell: a line that cuts it off passes near the cell's border
constexpr double removal_tie = 1e-20;  // orders whose errors differ by less are as good
constexpr double film_volume = 1e-3;   // of the cell: void below may be a film between two bodies

/// Volumes, of the cell, below which a component is a sliver: its line comes from least squares over the neighbours.
/// The remap carries a body's own centroid; that of void is what the bodies' errors leave, and needs more volume to
/// mean something (see planForThinVoid). A fragment's needs more as well (see sliverBounds).
struct SliverBounds
{
  double of_body, of_void;
  double of_fragment = film_volume;
  ComponentSet fragments = 0u; // bodies

  KOKKOS_INLINE_FUNCTION double of(CellComponents const &components, int k) const
  {
    if (components.holds(fragments, k))
      return of_fragment;
    return components.material[k] == void_material ? of_void : of_body;
  }

  /// Of several components together: that of a body.
  KOKKOS_INLINE_FUNCTION double ofSet(CellComponents const &components, ComponentSet set) const
  {
    for (int k = 0; k < components.count; ++k)
      if (set == 1u << k)
        return of(components, k);
    return of_body;
  }
};

/// The bounds in a cell, `sliver` (of the cell) for bodies that are no fragments.
///
/// A body that fills less than `film_volume` here and less than a tenth of every neighbour is a fragment, or a thread
/// thinner than a cell, and no tip of a body beyond. Placed by its centroid, the end of a thread was a speck that found
/// its way through other bodies, and the thread after it; least squares lay it along the face that it meets.
HARMOS_LARGE_FUNCTION SliverBounds sliverBounds(ReconstructionField const &field, CellComponents const &components,
                                                double sliver)
{
  constexpr double thick = 0.1; // fraction of a neighbour
  double const large = Math::max(sliver, film_volume);
  SliverBounds bounds{sliver, large, large};
  Rows const &neighbours = field.mesh.cell_neighbour;
  for (int k = 0; k < components.count; ++k)
  {
    if (components.material[k] == void_material || components.volume[k] < sliver || components.volume[k] >= large)
      continue;
    double most = 0.0;
    for (int n = neighbours.offset(components.cell); n < neighbours.offset(components.cell + 1) && most < thick; ++n)
      most = setFraction(field, components, 1u << k, neighbours.item(n));
    if (most < thick)
      bounds.fragments |= 1u << k;
  }
  return bounds;
}

/// Those of a set of components that place a line beside it: all, but of a tip with a sliver of void the tip.
///
/// Bodies that overlap by d of the cell close as much void somewhere else, and the void's centroid, what the bodies'
/// leave, moves by d/V_0 times half a cell. So a tip of 1e-2 of the cell that was placed as what a large body leaves,
/// film included, turned by up to 6 d/L^3 (L: its line, in cells); it slid on, into the body, by more than d in a
/// cycle, and a block hooked. Long lines hardly turn, and of two bodies that meet across a film both centroids tell the
/// line. Between several bodies the void has a place that their own centroids do not tell.
/// \param volume, rest Of the set and of what else the polygon holds.
KOKKOS_INLINE_FUNCTION ComponentSet placingSet(CellComponents const &components, SliverBounds const &slivers,
                                               Region const &polygon, ComponentSet set, double volume, double rest)
{
  constexpr double longest_line = 0.7; // of the cell's side
  ComponentSet const open = components.setOfMaterial(void_material), tip = set & ~open;
  bool const one_body = tip != 0u && (tip & (tip - 1u)) == 0u;
  double const own = components.volumeOf(tip);
  if (tip == set || !one_body || own > largest_tip || !(components.volumeOf(open) < slivers.of_void))
    return set;
  MomentOfFluidLine const line =
      momentOfFluidLine(polygon, own, (1.0 / own) * components.firstMomentOf(tip), components.weight);
  PartBehind const cut = partBehind(polygon, line.normal, volume, rest, components.weight);
  return norm(cut.chord_end - cut.chord_begin) < longest_line ? tip : set;
}

/// Normal of the line that divides a polygon into two sets of components.
struct CutNormal
{
  Vector2 normal; // unit, leaves the inside
  double penalty; // 0.1 V misfit where least squares placed a sliver of volume V
  double error;   // |first moment of the part that was placed by its centroid - the given one|^2
  bool converged; // of the search for the angle
};

/// Youngs: along the gradient of (fraction of the inside - fraction of the outside). Moment-of-fluid: by least squares
/// where the smaller side is a sliver, else from the centroid of the side that is exact alone, or of the smaller one.
HARMOS_LARGE_FUNCTION CutNormal cutNormal(ReconstructionField const &field, CellComponents const &components,
                                          ReconstructionMethod method, SliverBounds const &slivers,
                                          Region const &polygon, ComponentSet inside, ComponentSet outside)
{
  if (method == ReconstructionMethod::Youngs)
  {
    Vector2 const gradient = youngsGradient(field, components, {inside, outside});
    Vector2 const normal = norm(gradient) > 1e-13 ? -normalised(gradient) : Vector2{1.0, 0.0};
    return {normal, 0.0, 0.0, true};
  }
  double const inside_volume = components.volumeOf(inside), outside_volume = components.volumeOf(outside);
  bool cut_inside = inside_volume <= outside_volume;
  ComponentSet const smaller = cut_inside ? inside : outside;
  double volume = cut_inside ? inside_volume : outside_volume;
  if (volume < slivers.ofSet(components, smaller))
  {
    Vector2 const centroid = (1.0 / volume) * components.firstMomentOf(smaller);
    Vector2 const middle = polygon[0] + components.momentsOf(polygon).centroid();
    Vector2 fallback = normalised(cut_inside ? middle - centroid : centroid - middle);
    if (!(dot(fallback, fallback) > 0.5))
      fallback = {1.0, 0.0};
    LeastSquaresLine const line = leastSquaresLine(field, components, polygon, inside, outside, fallback);
    return {line.normal, sliver_penalty * volume * line.misfit, 0.0, line.converged};
  }
  if (components.isExact(inside) != components.isExact(outside))
    cut_inside = components.isExact(inside);
  ComponentSet const placing =
      placingSet(components, slivers, polygon, cut_inside ? inside : outside,
                 cut_inside ? inside_volume : outside_volume, cut_inside ? outside_volume : inside_volume);
  volume = components.volumeOf(placing);
  Vector2 const centroid = (1.0 / volume) * components.firstMomentOf(placing);
  MomentOfFluidLine const line = momentOfFluidLine(polygon, volume, centroid, components.weight);
  return {cut_inside ? line.normal : -line.normal, 0.0, volume * volume * line.squared_error, line.converged};
}

/// Whether the region found for a component, cut off along n, lies on the other side of one that is no sliver than the
/// component's own centroid.
KOKKOS_INLINE_FUNCTION bool beyondAnother(CellComponents const &components, SliverBounds const &slivers,
                                          Vector2 const &n, Vector2 const &found, int k)
{
  bool beyond = false;
  for (int j = 0; j < components.count; ++j)
  {
    Vector2 const &middle = components.centroid[j];
    beyond = beyond || (j != k && components.volume[j] >= slivers.of(components, j) &&
                        dot(n, found - middle) * dot(n, components.centroid[k] - middle) < 0.0);
  }
  return beyond;
}

/// |first moment of a region - its component's given one|^2, of a sliver nothing: its centroid is noise along it. And
/// where a body's region has come to lie beyond a component that is no sliver, 0.1 V times the squared distance across,
/// in the measure of the penalties. A sliver of void counts for nothing at all: its centroid is what the others' errors
/// leave.
///
/// First moments rather than centroids: what a straight line cannot follow moves the same first moment out of one
/// component and into its neighbour, whatever their sizes. But the first moment of a tip of 1e-5 of the cell, at the
/// wrong end of it, is less than what a bent face misses: that tells nothing of the side that it is on.
/// \param n Normal of the line that cuts the region off.
HARMOS_LARGE_FUNCTION double momentError(CellComponents const &components, SliverBounds const &slivers,
                                         Region const &region, int k, Vector2 const &n)
{
  double const volume = components.volume[k];
  bool const sliver = volume < slivers.of(components, k);
  if (region.empty() || (sliver && components.material[k] == void_material))
    return 0.0;
  Moments<1> const m = components.momentsOf(region);
  double misplaced = 0.0;
  if (components.material[k] != void_material)
  {
    Vector2 const found = region[0] + m.centroid();
    double const across = dot(n, found - components.centroid[k]);
    if (beyondAnother(components, slivers, n, found, k))
      misplaced = sliver_penalty * volume * across * across;
  }
  if (sliver)
    return misplaced;
  Vector2 const first = components.firstMiss(m, region, k);
  return dot(first, first) + misplaced;
}

/// visit(part, k, normal of the line that cuts it off) for the components of a plan that is a sequence, first removed
/// first; the last one lies beyond the line before.
template <class Visit>
KOKKOS_INLINE_FUNCTION void forEachPart(CellComponents const &components, RemovalPlan const &plan, Visit const &visit)
{
  Region polygon = components.polygon;
  ComponentSet rest = components.all();
  for (int i = 0; i + 1 < plan.count; ++i)
  {
    int const k = plan.component[i];
    rest &= ~(1u << k);
    Division const division =
        divide(polygon, plan.normal[i], components.volume[k], components.volumeOf(rest), components.weight);
    visit(division.inside, k, plan.normal[i]);
    polygon = division.outside;
  }
  visit(polygon, plan.component[plan.count - 1], plan.normal[Math::max(0, plan.count - 2)]);
}

/// Sum over the components of a plan that is a sequence of momentError.
HARMOS_LARGE_FUNCTION double momentErrors(CellComponents const &components, SliverBounds const &slivers,
                                          RemovalPlan const &plan)
{
  double error = 0.0;
  forEachPart(components, plan,
              [&](Region const &part, int k, Vector2 const &normal)
              { error += momentError(components, slivers, part, k, normal); });
  return error;
}

/// Removal in a given order.
HARMOS_LARGE_FUNCTION RemovalPlan fixedPlan(ReconstructionField const &field, CellComponents const &components,
                                            ReconstructionMethod method, SliverBounds const &slivers,
                                            int const order[max_components])
{
  RemovalPlan plan;
  plan.count = components.count;
  Region polygon = components.polygon;
  ComponentSet rest = components.all();
  for (int i = 0; i + 1 < components.count; ++i)
  {
    int const k = order[i];
    rest &= ~(1u << k);
    CutNormal const cut = cutNormal(field, components, method, slivers, polygon, 1u << k, rest);
    plan.set(i, k, cut.normal);
    plan.error += cut.error;
    plan.unfinished += cut.converged ? 0 : 1;
    if (i + 2 < components.count)
      polygon =
          divide(polygon, plan.normal[i], components.volume[k], components.volumeOf(rest), components.weight).outside;
  }
  plan.set(components.count - 1, order[components.count - 1], {1.0, 0.0});
  return plan;
}

/// Part of a sliver's volume that is the penalty of a line that cuts it off the whole cell, at least.
///
/// Such a line passes the cell at a corner or along a face, so that a quarter or more of some vertex neighbour lies
/// behind it (a whole one where faces run on straight). Where the neighbours hold little of the sliver's set, whichever
/// way it is counted, no line fits: the mean of (fraction behind - fraction)^2 is (1/4 - fraction)^2 / 8 or more. Zero
/// where the cell lacks neighbours.
HARMOS_LARGE_FUNCTION double leastSliverPenalty(ReconstructionField const &field, CellComponents const &components,
                                                ComponentSet others)
{
  constexpr double behind = 0.25;
  constexpr int usual_count = 8;
  Rows const &neighbours = field.mesh.cell_neighbour;
  int const begin = neighbours.offset(components.cell);
  if (neighbours.offset(components.cell + 1) - begin != usual_count)
    return 0.0;
  double least = behind;
  for (int n = begin; n < begin + usual_count; ++n)
    least = Math::min(least, behind - (1.0 - setFraction(field, components, others, neighbours.item(n))));
  return least > 0.0 ? sliver_penalty / usual_count * least * least : 0.0;
}

/// All orders of removal by depth-first search; the least sum of first-moment errors and sliver penalties wins, ties
/// (within 1e-20) go to the order that comes first. Partial sums that are no better, or cannot become so, are not
/// followed, cuts are shared by the orders that begin with them, and the last two components need one cut.
///
/// An exact component that one line leaves as it is has a straight face in the cell, and is cut off first whatever the
/// others miss: their noise would turn that face, or end it at a wedge of void.
///
/// Ahn & Shashkov, J. Comput. Phys. 226 (2007) 2096-2132, with first moments in place of centroids.
HARMOS_LARGE_FUNCTION RemovalPlan bestPlan(ReconstructionField const &field, CellComponents const &components,
                                           SliverBounds const &slivers)
{
  constexpr int max_count = max_exhaustive_components;
  Region polygon[max_count];
  ComponentSet rest[max_count];
  int candidate[max_count];
  double error[max_count];
  RemovalPlan plan, best;
  int const count = components.count;
  plan.count = best.count = count;
  best.error = 1e300;
  polygon[0] = components.polygon;
  rest[0] = components.all();
  candidate[0] = -1;
  error[0] = 0.0;
  bool straight = false; // the first one has a straight face
  // No sum is below zero: one within a tie of it is not beaten.
  for (int depth = 0; depth >= 0 && best.error > removal_tie;)
  {
    bool const two_left = depth == count - 2;
    int k = candidate[depth] + 1;
    while (k < count && !components.holds(rest[depth], k))
      ++k;
    if (k >= count || (two_left && candidate[depth] >= 0) || (depth == 0 && straight))
    {
      --depth;
      continue;
    }
    candidate[depth] = k;
    ComponentSet const others = rest[depth] & ~(1u << k);
    double const volume = components.volume[k];
    if (depth == 0 && volume < Math::min(slivers.of(components, k), thin_volume) && best.error < 1e300 &&
        volume * leastSliverPenalty(field, components, others) >= best.error)
      continue;
    CutNormal const cut =
        cutNormal(field, components, ReconstructionMethod::MomentOfFluid, slivers, polygon[depth], 1u << k, others);
    Division const division =
        divide(polygon[depth], cut.normal, components.volume[k], components.volumeOf(others), components.weight);
    plan.unfinished += cut.converged ? 0 : 1;
    double total = error[depth] + cut.penalty + momentError(components, slivers, division.inside, k, cut.normal);
    if (depth == 0 && components.holds(components.exact, k) && total <= removal_tie)
    {
      straight = true;
      best.error = 1e300;
    }
    int last = 0;
    while (!components.holds(others, last))
      ++last;
    if (two_left)
      total += momentError(components, slivers, division.outside, last, cut.normal);
    plan.set(depth, k, cut.normal);
    if (!(total < best.error - removal_tie))
      continue;
    if (two_left)
    {
      plan.set(depth + 1, last, {1.0, 0.0});
      plan.error = total;
      best = plan;
      continue;
    }
    ++depth;
    polygon[depth] = division.outside;
    rest[depth] = others;
    candidate[depth] = -1;
    error[depth] = total;
  }
  best.unfinished = plan.unfinished;
  return best;
}

/// One component after the other, each time the one whose cut has the least centroid error.
HARMOS_LARGE_FUNCTION RemovalPlan greedyPlan(ReconstructionField const &field, CellComponents const &components,
                                             SliverBounds const &slivers)
{
  RemovalPlan plan;
  plan.count = components.count;
  Region polygon = components.polygon;
  ComponentSet rest = components.all();
  for (int i = 0; i < components.count; ++i)
  {
    Region next;
    double least = 1e300;
    for (int k = 0; k < components.count; ++k)
    {
      if (!components.holds(rest, k))
        continue;
      ComponentSet const others = rest & ~(1u << k);
      if (others == 0u)
      {
        plan.set(i, k, {1.0, 0.0});
        break;
      }
      CutNormal const cut =
          cutNormal(field, components, ReconstructionMethod::MomentOfFluid, slivers, polygon, 1u << k, others);
      plan.unfinished += cut.converged ? 0 : 1;
      double const volume = components.volume[k];
      Division const division = divide(polygon, cut.normal, volume, components.volumeOf(others), components.weight);
      double const error =
          (momentError(components, slivers, division.inside, k, cut.normal) + cut.penalty) / (volume * volume);
      if (error < least - 1e-20)
      {
        least = error;
        plan.set(i, k, cut.normal);
        next = division.outside;
      }
    }
    rest &= ~(1u << plan.component[i]);
    polygon = next;
  }
  return plan;
}

} // namespace Harmos

#endif
