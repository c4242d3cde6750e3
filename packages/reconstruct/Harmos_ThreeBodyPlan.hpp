// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_THREE_BODY_PLAN_HPP
#define HARMOS_THREE_BODY_PLAN_HPP

#include <Harmos_ContinuedLines.hpp>
#include <Harmos_CornerCell.hpp>

namespace Harmos
{

/// Three bodies, none a sliver, with or without void, in the order that the neighbours tell, where the given sequence
/// is no order for them.
///
/// At a T whose junction is a hundredth of a cell from a face, the sequence that cuts a block first, its line right
/// through the bar's corner, misses the first moments by as little as the bar first does: what bent edges and bodies
/// that overlapped leave of them is of the same size as the corner, and the one or the other is less. Bars that lost
/// their corner to a block, or to void, in one cycle lost more in the next, and hooked. Continued into the neighbours,
/// the wrong lines miss what the bodies fill there by a tenth of a cell and more, the right ones by a thousandth. So
/// where the given lines miss it by a tenth (root of the mean square), an order is taken whose lines miss it by a third
/// of that at most, if it misses the first moments by five times what the given one does at most. An exact body
/// that goes first stays so. Fluids and matter that has flowed keep the given one: what they fill has no straight
/// edges.
HARMOS_LARGE_FUNCTION RemovalPlan threeBodyPlan(ReconstructionField const &field, CellComponents const &components,
                                                SliverBounds const &slivers, RemovalPlan const &given)
{
  constexpr int bodies = 3;
  int const count = components.count;
  int const bodies_here = components.material[count - 1] == void_material ? count - 1 : count;
  if (bodies_here != bodies || given.error <= removal_tie || !mayHaveStraightEdges(field, components))
    return given;
  for (int k = 0; k < bodies; ++k)
    if (components.volume[k] < slivers.of(components, k))
      return given;
  BodyAround const around[bodies] = {BodyAround(field, components, 0), BodyAround(field, components, 1),
                                     BodyAround(field, components, 2)};
  double const misfit = continuedMisfit(components, given, around);
  if (!(misfit > poor_continuation))
    return given;
  double const most_error = as_good_error * momentErrors(components, slivers, given);
  bool const keeps_first = components.holds(components.exact, given.component[0]);
  RemovalPlan best = given;
  double least = better_continuation * misfit;
  int unfinished = given.unfinished;
  for (int first = 0; first < count; ++first)
    for (int second = 0; second < count; ++second)
    {
      if (second == first || (keeps_first && first != given.component[0]))
        continue;
      int order[max_components] = {first, second};
      int at = 2;
      for (int k = 0; k < count; ++k)
        if (k != first && k != second)
          order[at++] = k;
      if (at == 3 && order[2] < second) // the last two interchanged
        continue;
      RemovalPlan plan = fixedPlan(field, components, ReconstructionMethod::MomentOfFluid, slivers, order);
      unfinished += plan.unfinished;
      double const its_misfit = continuedMisfit(components, plan, around);
      plan.error = momentErrors(components, slivers, plan);
      if (its_misfit < least && plan.error <= most_error)
      {
        best = plan;
        least = its_misfit;
      }
    }
  best.unfinished = unfinished;
  return best;
}

} // namespace Harmos

#endif
