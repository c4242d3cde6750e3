// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DENTED_PLAN_HPP
#define HARMOS_DENTED_PLAN_HPP

#include <Harmos_Clip.hpp>
#include <Harmos_CornerCell.hpp>

namespace Harmos
{

/// The part of a polygon, which need not be convex, behind a line.
struct PartOfDent
{
  Region region;
  bool whole; // in one piece
};

/// Where a function changes its sign between two points, by false position; the end that stays counts by half (the
/// Illinois method; Dowell & Jarratt, BIT 11 (1971) 168).
///
/// \param of_low, of_high The function there. \param tolerance Of the function.
template <class Function>
HARMOS_LARGE_FUNCTION double signChange(Function const &function, double low, double of_low, double high,
                                        double of_high, double tolerance)
{
  constexpr int most_steps = 100;
  double x = high;
  int kept = 0; // the end that stayed in the last step: -1: low, 1: high
  for (int i = 0; i < most_steps && low != high && of_low != of_high; ++i)
  {
    x = high - of_high * (high - low) / (of_high - of_low);
    if (!((x - low) * (x - high) < 0.0))
      x = 0.5 * (low + high);
    double const of_x = function(x);
    if (Math::fabs(of_x) <= tolerance)
      break;
    if (of_x * of_high > 0.0)
    {
      high = x;
      of_high = of_x;
      of_low *= kept == -1 ? 0.5 : 1.0;
      kept = -1;
    }
    else
    {
      low = x;
      of_low = of_x;
      of_high *= kept == 1 ? 0.5 : 1.0;
      kept = 1;
    }
  }
  return x;
}

/// The part of a given volume behind a line of a given normal of what lies around a corner: clipped with the offset d
/// of V(d) = volume, which is monotonic (signChange).
HARMOS_LARGE_FUNCTION PartOfDent partOfDent(CellComponents const &components, Region const &around,
                                            Vector2 const &normal, double volume)
{
  constexpr double tolerance = 1e-15; // of the cell
  double low = 1e300, high = -1e300;
  for (int i = 0; i < around.size; ++i)
  {
    low = Math::min(low, dot(normal, around[i]));
    high = Math::max(high, dot(normal, around[i]));
  }
  PartOfDent part;
  auto const over = [&](double offset)
  {
    clip(around, Plane2{normal, offset}, part.region);
    return components.volumeOfRegion(part.region) - volume;
  };
  double const offset = signChange(over, low, -volume, high, over(high), tolerance);
  // Where the line crosses the outline more than twice the corner keeps what is behind it together.
  int crossings = 0;
  bool holds_tip = false;
  for (int i = 0; i < around.size; ++i)
  {
    Vector2 const &a = around[i], &b = around[around.next(i)], &c = around[around.next(around.next(i))];
    crossings += (dot(normal, a) <= offset) != (dot(normal, b) <= offset) ? 1 : 0;
    holds_tip = holds_tip || (cross(b - a, c - b) < 0.0 && dot(normal, b) <= offset);
  }
  part.whole = crossings <= 2 || holds_tip;
  return part;
}

/// Of a body around a corner, and void, the normal of the line between them: stationary |x(theta) - c|^2 as in
/// momentOfFluidLine, whose derivative has the sign of (x - c) . tau, tau along the line; sought within 0.6 of the line
/// that the body alone would have. Zero where there is none.
HARMOS_LARGE_FUNCTION Vector2 normalBesideDent(CellComponents const &components, Region const &around, int body)
{
  constexpr double stride = 0.15, farthest = 0.6, tolerance = 1e-15;
  double const volume = components.volume[body];
  Vector2 const start =
      momentOfFluidLine(components.polygon, volume, components.centroid[body], components.weight).normal;
  auto const normalAt = [&](double theta)
  { return Math::cos(theta) * start + Math::sin(theta) * perpendicular(start); };
  auto const slope = [&](double theta)
  {
    Vector2 const n = normalAt(theta);
    return dot(components.firstMiss(partOfDent(components, around, n, volume).region, body), perpendicular(n));
  };
  double low = 0.0, of_low = slope(0.0), high = low, of_high = of_low;
  double const way = of_low > 0.0 ? stride : -stride;
  while (of_high * of_low > 0.0 && Math::fabs(high) < farthest)
  {
    low = high;
    of_low = of_high;
    high += way;
    of_high = slope(high);
  }
  if (of_high * of_low > 0.0)
    return {0.0, 0.0};
  return normalAt(signChange(slope, low, of_low, high, of_high, tolerance * volume));
}

/// The regions of a rigid body's corner and of the body around it.
struct DentedCell
{
  Region corner, around; // empty where there is no such plan
};

HARMOS_LARGE_FUNCTION DentedCell dentedCell(CellComponents const &components, RemovalPlan const &plan)
{
  int const body = plan.component[0], other = plan.component[1];
  double const open = components.count > 2 ? components.volume[2] : 0.0;
  CellComponents filled = components; // void belongs to what is around
  filled.count = 2;
  filled.volume[other] += open;
  EmbeddedCorner const corner = embeddedCorner(filled, body, other, plan.normal[0], plan.normal[1], plan.void_part);
  DentedCell cell{corner.inside, corner.around};
  if (open > 0.0 && !corner.around.empty())
  {
    PartOfDent const part = partOfDent(components, corner.around, plan.normal[2], components.volume[other]);
    cell.around = part.whole ? part.region : Region();
  }
  return cell;
}

/// A rigid body, and another one, and maybe void, none a sliver, which the given plan does not leave as they are: where
/// the rigid one lies behind two edges of its outline these leave it exactly as it is, and a third line leaves the void
/// of what is around it. The other one has a dent where the corner goes in.
///
/// With straight cuts alone a corner that had gone in by a hundredth of a cell was drawn as a chord: contact was lost
/// (doc/decisions/0038).
HARMOS_LARGE_FUNCTION RemovalPlan dentedPlan(ReconstructionField const &field, CellComponents const &components,
                                             SliverBounds const &slivers, RemovalPlan const &given)
{
  bool const open = components.material[components.count - 1] == void_material;
  int const bodies = components.count - (open ? 1 : 0);
  if (components.exact == 0u || bodies != 2 || given.error <= removal_tie)
    return given;
  for (int body = 0; body < 2; ++body)
  {
    int const other = 1 - body;
    if (!components.isExact(1u << body) || components.isExact(1u << other) ||
        components.volume[0] < slivers.of(components, 0) || components.volume[1] < slivers.of(components, 1))
      continue;
    OutlineCorner const corner = outlineCorner(field, components, body);
    if (corner.kind != CornerKind::Convex)
      continue;
    RemovalPlan plan = given;
    plan.corner = plan.parted = false;
    plan.dented = true;
    plan.set(0, body, corner.normal[0]);
    plan.set(1, other, corner.normal[1]);
    plan.void_part = corner.beyond;
    plan.error = 0.0;
    if (open)
    {
      CellComponents filled = components;
      filled.count = 2;
      filled.volume[other] += components.volume[2];
      Region const around = dentedCell(filled, plan).around;
      if (around.empty())
        continue;
      bool const thin = components.volume[2] < slivers.of_void;
      plan.set(
          2, 2,
          thin ? cutNormal(field, components, ReconstructionMethod::MomentOfFluid, slivers, components.polygon, 3u, 4u)
                     .normal
               : normalBesideDent(components, around, other));
      if (plan.normal[2][0] == 0.0 && plan.normal[2][1] == 0.0)
        continue;
    }
    if (!dentedCell(components, plan).around.empty())
      return plan;
  }
  return given;
}

} // namespace Harmos

#endif
