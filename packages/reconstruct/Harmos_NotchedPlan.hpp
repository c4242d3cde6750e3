// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_NOTCHED_PLAN_HPP
#define HARMOS_NOTCHED_PLAN_HPP

#include <Harmos_CornerCell.hpp>

namespace Harmos
{

/// Regions of a rigid body with a notch and of all that lies in it. Where the corner is in another cell the body is on
/// both sides: two regions, bridged.
struct NotchedCell
{
  Region notch, around; // empty where there is no such plan
};

HARMOS_LARGE_FUNCTION NotchedCell notchedCell(CellComponents const &components, RemovalPlan const &plan)
{
  double const rigid = components.volume[plan.component[0]], own = 1.0 - rigid, rest = rigid - plan.void_part;
  Division const one = divide(components.polygon, plan.normal[0], own + rest, plan.void_part, components.weight);
  Division const two = divide(one.inside, plan.normal[1], own, rest, components.weight);
  NotchedCell cell{two.inside, aroundCorner(one, two)};
  if (cell.around.empty())
    cell.around = onBothSides(components, one, two);
  return cell;
}

/// What lies in the notch as a cell of its own: its polygon, without the rigid body.
HARMOS_LARGE_FUNCTION CellComponents componentsIn(CellComponents const &components, Region const &notch, int rigid,
                                                  int (&number)[max_components])
{
  CellComponents inside = components;
  inside.polygon = notch;
  inside.count = 0;
  inside.exact = 0u;
  for (int k = 0; k < components.count; ++k)
    if (k != rigid)
    {
      int const i = inside.count++;
      number[i] = k;
      inside.material[i] = components.material[k];
      inside.volume[i] = components.volume[k];
      inside.centroid[i] = components.centroid[k];
    }
  return inside;
}

/// A rigid body with a notch in the cell (an inner corner, as that of a tank, or both sides of one), and others, and
/// maybe void: the two edges of its outline leave it exactly as it is, and what else there is shares what is between
/// them in the best order of straight cuts. Solids alone only where that leaves all bodies together more as they are.
///
/// With lines that had to suit a liquid as well, one that had been squeezed by 1e-6 was drawn across the corner as a
/// chord, and its pressure went through.
HARMOS_LARGE_FUNCTION RemovalPlan notchedPlan(ReconstructionField const &field, CellComponents const &components,
                                              SliverBounds const &slivers, RemovalPlan const &given)
{
  int rigid = -1;
  bool fluid = false;
  for (int k = 0; k < components.count; ++k)
  {
    fluid = fluid || (components.material[k] != void_material && isFluid(field, components, k));
    if (!components.isExact(1u << k))
      continue;
    if (rigid >= 0)
      return given;
    rigid = k;
  }
  if (rigid < 0 || given.error <= removal_tie || components.count > max_exhaustive_components ||
      components.volume[rigid] < slivers.of_body || 1.0 - components.volume[rigid] < slivers.of_body)
    return given;
  OutlineCorner const corner = outlineCorner(field, components, rigid);
  if (corner.kind != CornerKind::Notch)
    return given;
  RemovalPlan plan;
  plan.count = components.count;
  plan.notched = true;
  plan.set(0, rigid, corner.normal[0]);
  plan.normal[1] = corner.normal[1];
  plan.void_part = corner.beyond;
  NotchedCell const cell = notchedCell(components, plan);
  if (cell.around.empty())
    return given;
  int number[max_components];
  CellComponents const inside = componentsIn(components, cell.notch, rigid, number);
  RemovalPlan shared;
  if (inside.count > 1)
    shared = bestPlan(field, inside, sliverBounds(field, inside, slivers.of_body));
  else
    shared.set(0, 0, {1.0, 0.0});
  for (int i = 0; i < inside.count; ++i)
  {
    plan.component[i + 1] = number[shared.component[i]];
    plan.normal[i + 2] = shared.normal[i];
  }
  plan.error = shared.error;
  plan.unfinished = given.unfinished + shared.unfinished;
  return fluid || plan.error < given.error ? plan : given;
}

} // namespace Harmos

#endif
