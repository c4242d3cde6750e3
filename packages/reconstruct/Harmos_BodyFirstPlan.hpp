// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BODY_FIRST_PLAN_HPP
#define HARMOS_BODY_FIRST_PLAN_HPP

#include <Harmos_ContinuedLines.hpp>
#include <Harmos_CornerCell.hpp>
#include <Harmos_PartedPlan.hpp>

namespace Harmos
{

/// Turn the second line of a sequence to where the neighbours have least misfit: the best of 24 angles, and between its
/// neighbours by golden section, to 1e-6. \return The misfit.
HARMOS_LARGE_FUNCTION double turnSecondLine(CellComponents const &components, BodyAround const (&around)[2],
                                            RemovalPlan &plan)
{
  constexpr int angles = 24, sections = 27;
  constexpr double spacing = 2.0 * Math::pi / angles, golden = 0.6180339887498949;
  Vector2 const start = plan.normal[1], along = perpendicular(start);
  auto const misfitAt = [&](double angle)
  {
    plan.normal[1] = Math::cos(angle) * start + Math::sin(angle) * along;
    return continuedMisfit(components, plan, around);
  };
  double best = 0.0, least = 1e300;
  for (int i = 0; i < angles; ++i)
  {
    double const misfit = misfitAt(i * spacing);
    if (misfit < least)
    {
      least = misfit;
      best = i * spacing;
    }
  }
  double low = best - spacing, high = best + spacing;
  double angle[2] = {high - golden * (high - low), low + golden * (high - low)};
  double misfit[2] = {misfitAt(angle[0]), misfitAt(angle[1])};
  for (int i = 0; i < sections; ++i)
  {
    bool const lower = misfit[0] < misfit[1];
    (lower ? high : low) = angle[lower ? 1 : 0];
    angle[lower ? 1 : 0] = angle[lower ? 0 : 1];
    misfit[lower ? 1 : 0] = misfit[lower ? 0 : 1];
    double const next = lower ? high - golden * (high - low) : low + golden * (high - low);
    angle[lower ? 0 : 1] = next;
    misfit[lower ? 0 : 1] = misfitAt(next);
  }
  double const nearer = misfit[0] < misfit[1] ? angle[0] : angle[1];
  return misfitAt(Math::min(misfit[0], misfit[1]) < least ? nearer : best);
}

/// Two bodies and void, none a sliver, that the given sequence cuts void off first: one body first, where the
/// neighbours say so. Whether that is so: another first component.
///
/// Where a block ends on a bar that goes on below the void, the void's line cut first takes the bar's corner away, and
/// the bar's line tilts for it: all three first moments stay as well as with the bar cut first, to what bent edges
/// leave of them. Round-off decided, and the next cycle found a bar that ended under the void; blocks hooked to it.
/// The neighbours, full of the bar, know better. So where both lines, continued, miss them by a tenth of a cell, the
/// body goes first whose lines miss them by a tenth of that, if the error (momentError) is that of first moments off by
/// a tenth of the least volume at most. Of solids that have not flowed a third is enough, where another corner is in a
/// neighbour, if the first moments are missed by five times what void first misses at most. Void of some 1e-3 of the
/// cell has no centroid to speak of where the bodies' edges are bent: if by that the lines of neither order fit, the
/// void's is turned to the neighbours. Void between the bodies stays with the order that suits the moments.
HARMOS_LARGE_FUNCTION RemovalPlan bodyFirstPlan(ReconstructionField const &field, CellComponents const &components,
                                                SliverBounds const &slivers, RemovalPlan const &given)
{
  constexpr double much_better = 1e-2; // square
  constexpr double most_miss = 0.1;    // of the least volume
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
  if (!(misfit > poor_continuation))
    return given;
  RemovalPlan best = given;
  double const most_error = mayHaveStraightEdges(field, components) ? as_good_error * given.error : 0.0;
  double best_misfit = misfit;
  int unfinished = given.unfinished;
  for (int pass = 0; pass < 2 && best_misfit >= much_better * misfit; ++pass)
  {
    bool const turned = pass == 1;
    for (int first = 0; first < 2; ++first)
    {
      int const order[max_components] = {first, 1 - first, open};
      RemovalPlan plan = fixedPlan(field, components, ReconstructionMethod::MomentOfFluid, slivers, order);
      unfinished += turned ? 0 : plan.unfinished;
      double const its_misfit =
          turned ? turnSecondLine(components, around, plan) : continuedMisfit(components, plan, around);
      plan.error = momentErrors(components, slivers, plan);
      bool const suits = (its_misfit < much_better * misfit && plan.error <= most_miss * most_miss * least * least) ||
                         (its_misfit < better_continuation * misfit && plan.error <= most_error);
      if (its_misfit < best_misfit && suits)
      {
        best = plan;
        best_misfit = its_misfit;
      }
    }
  }
  best.unfinished = unfinished;
  return best;
}

} // namespace Harmos

#endif
