// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BODY_FIRST_PLAN_HPP
#define HARMOS_BODY_FIRST_PLAN_HPP

#include <Harmos_BodyAround.hpp>
#include <Harmos_PartedPlan.hpp>

namespace Harmos
{

/// Mean over the neighbours of the squared differences between what both bodies fill there and what a sequence of cuts
/// gives them when its two lines go on.
/// \param components Two bodies and void.
/// \param around Of body 0 and of body 1.
KOKKOS_INLINE_FUNCTION double continuedMisfit(CellComponents const &components, RemovalPlan const &plan,
                                              BodyAround const (&around)[2])
{
  double const volume[3] = {components.volume[plan.component[0]], components.volume[plan.component[1]],
                            components.volume[plan.component[2]]};
  Division const one = divide(components.polygon, plan.normal[0], volume[0], volume[1] + volume[2], components.weight);
  Plane2 const second = divide(one.outside, plan.normal[1], volume[1], volume[2], components.weight).line;
  Plane2 const beyond_first{-one.line.normal, -one.line.offset}, beyond_second{-second.normal, -second.offset};
  Plane2 const bounds[3][2] = {{one.line, {}}, {beyond_first, second}, {beyond_first, beyond_second}};
  double misfit = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    int const k = plan.component[i];
    for (int j = 0; k < 2 && j < around[k].count; ++j)
    {
      double const miss = around[k].miss(j, bounds[i], i == 0 ? 1 : 2);
      misfit += miss * miss;
    }
  }
  return misfit / Math::max(1, around[0].count);
}

/// Two bodies and void, none a sliver, that the given sequence cuts void off first: one body first, where the
/// neighbours say so. Whether that is so: another first component.
///
/// Where a block ends on a bar that goes on below the void, the void's line cut first takes the bar's corner away, and
/// the bar's line tilts for it: all three first moments stay as well as with the bar cut first, to what bent edges
/// leave of them. Round-off decided, and the next cycle found a bar that ended under the void; blocks hooked to it.
/// The neighbours, full of the bar, know better. So where both lines, continued, miss them by a tenth of a cell, the
/// body goes first whose lines miss them by a tenth of that, if no first moment is off by more than a tenth of the
/// least volume. Void between the bodies stays with the order that suits the moments.
KOKKOS_INLINE_FUNCTION RemovalPlan bodyFirstPlan(ReconstructionField const &field, CellComponents const &components,
                                                 SliverBounds const &slivers, RemovalPlan const &given)
{
  constexpr double poor_misfit = 1e-2, much_better = 1e-2; // squares
  constexpr double most_miss = 0.1;                        // of the least volume
  constexpr int open = 2;
  if (components.count != 3 || components.material[open] != void_material || given.component[0] != open ||
      given.error <= removal_tie)
    return given;
  double least = 1.0;
  for (int k = 0; k < 3; ++k)
  {
    if (components.volume[k] < slivers.of(components, k))
      return given;
    least = Math::min(least, components.volume[k]);
  }
  if (!voidIsBeside(components))
    return given;
  BodyAround const around[2] = {BodyAround(field, components, 0), BodyAround(field, components, 1)};
  double const misfit = continuedMisfit(components, given, around);
  if (!(misfit > poor_misfit))
    return given;
  RemovalPlan best = given;
  double best_misfit = much_better * misfit;
  for (int first = 0; first < 2; ++first)
  {
    int const order[max_components] = {first, 1 - first, open};
    RemovalPlan plan = fixedPlan(field, components, ReconstructionMethod::MomentOfFluid, slivers, order);
    plan.error = 0.0;
    forEachPart(components, plan,
                [&](Region const &part, int k, Vector2 const &normal)
                { plan.error += momentError(components, slivers, part, k, normal); });
    double const its_misfit = continuedMisfit(components, plan, around);
    best.unfinished += plan.unfinished;
    if (its_misfit < best_misfit && plan.error <= most_miss * most_miss * least * least)
    {
      plan.unfinished = best.unfinished;
      best = plan;
      best_misfit = its_misfit;
    }
  }
  return best;
}

} // namespace Harmos

#endif
