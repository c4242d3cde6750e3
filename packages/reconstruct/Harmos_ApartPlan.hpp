// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_APART_PLAN_HPP
#define HARMOS_APART_PLAN_HPP

#include <Harmos_CornerCell.hpp>

namespace Harmos
{

/// One body of a cell, all else as void.
HARMOS_LARGE_FUNCTION CellComponents alone(CellComponents const &components, int body)
{
  CellComponents c = components;
  c.count = 2;
  c.material[0] = components.material[body];
  c.material[1] = void_material;
  c.volume[0] = components.volume[body];
  c.volume[1] = 1.0 - c.volume[0];
  c.centroid[0] = components.centroid[body];
  Moments<1> const m = c.momentsOf(c.polygon);
  Vector2 const all = Vector2{m.first(0), m.first(1)} + m.volume() * c.polygon[0];
  c.centroid[1] = (1.0 / c.volume[1]) * (all - c.volume[0] * c.centroid[0]);
  return c;
}

/// The region of a body that a plan has apart from the others.
HARMOS_LARGE_FUNCTION Region regionAlone(CellComponents const &components, RemovalPlan const &plan, int body)
{
  double const volume = components.volume[body], beyond = 1.0 - volume - plan.open[body];
  PartBehind const one =
      partBehind(components.polygon, plan.normal[2 * body], volume + beyond, plan.open[body], components.weight);
  if (!(beyond > least_void))
    return one.inside;
  return partBehind(one.inside, plan.normal[2 * body + 1], volume, beyond, components.weight).inside;
}

/// How a body that is drawn alone has the centroid that it should have.
enum class DrawnAlone
{
  Exact, // to 1e-4 of the smaller of body and rest
  Bent,  // to 2e-3 of it, as curved edges of five cells' radius do
  Missed
};

/// Draw a body of a cell alone: by one straight line, or two that meet in a corner, where these leave its centroid.
///
/// Tips below film_volume, whose centroids are less sure, may miss it by 0.02 of the cell; slivers are drawn by one
/// line that least squares place.
///
/// \param plan   Gets the body's normals and `open`; the squared miss of its first moment is added to `error`.
/// \param region Out: the body's, in the cell's unit coordinates.
/// \return How the centroid was met.
HARMOS_LARGE_FUNCTION DrawnAlone drawAlone(ReconstructionField const &field, CellComponents const &components, int body,
                                           SliverBounds const &slivers, RemovalPlan &plan, Region &region)
{
  constexpr double exact = 1e-4, bent = 2e-3, tip_miss = 0.02, least_miss = 1e-8; // of the volume; of the cell
  CellComponents const c = alone(components, body);
  bool const body_is_smaller = c.volume[0] <= c.volume[1];
  int const smaller = body_is_smaller ? 0 : 1;
  double const volume = c.volume[smaller];
  plan.open[body] = c.volume[1];
  plan.normal[2 * body + 1] = {0.0, 0.0};
  if (components.volume[body] < slivers.of(components, body))
  {
    SliverBounds bounds = slivers;
    bounds.fragments = components.holds(slivers.fragments, body) ? 1u : 0u;
    CutNormal const cut = cutNormal(field, c, ReconstructionMethod::MomentOfFluid, bounds, c.polygon, 1u, 2u);
    plan.unfinished += cut.converged ? 0 : 1;
    plan.normal[2 * body] = cut.normal;
    region = regionAlone(components, plan, body);
    return DrawnAlone::Exact;
  }
  MomentOfFluidLine const line = momentOfFluidLine(c.polygon, volume, c.centroid[smaller], c.weight);
  plan.unfinished += line.converged ? 0 : 1;
  plan.normal[2 * body] = body_is_smaller ? line.normal : -line.normal;
  double error = volume * volume * line.squared_error;
  if (error > removal_tie)
  {
    CornerCell const corner = exactCornerCell(field, c, 0, c.polygon, nullptr, plan.normal[2 * body], true);
    if (corner.error < 1e300)
    {
      for (int l = 0; l < 2; ++l)
        plan.normal[2 * body + l] = corner.line[l].normal;
      plan.open[body] = corner.open;
      error = corner.residual[0] * corner.residual[0] + corner.residual[1] * corner.residual[1];
    }
  }
  plan.error += error;
  region = regionAlone(components, plan, body);
  double const miss = Math::max((components.volume[body] < film_volume ? tip_miss : exact) * volume, least_miss);
  return error <= miss * miss                         ? DrawnAlone::Exact
         : error <= (bent * volume) * (bent * volume) ? DrawnAlone::Bent
                                                      : DrawnAlone::Missed;
}

/// Whether no point of one convex region is nearer than `least` to another's: a line at an edge of one parts them.
HARMOS_LARGE_FUNCTION bool clearOf(Region const &a, Region const &b, double least)
{
  for (int pass = 0; pass < 2; ++pass)
  {
    Region const &own = pass == 0 ? a : b, &other = pass == 0 ? b : a;
    for (int i = 0; i < own.size; ++i)
    {
      Vector2 const along = own[own.next(i)] - own[i];
      double nearest = 1e300;
      for (int j = 0; j < other.size; ++j)
        nearest = Math::min(nearest, cross(other[j] - own[i], along));
      if (nearest > least * norm(along))
        return true;
    }
  }
  return false;
}

/// Distance of a point from a convex region; 0 inside.
HARMOS_LARGE_FUNCTION double distanceFrom(Region const &region, Vector2 const &point)
{
  bool inside = true;
  double nearest = 1e300;
  for (int i = 0; i < region.size; ++i)
  {
    Vector2 const &a = region[i], along = region[region.next(i)] - a;
    inside = inside && cross(along, point - a) >= 0.0;
    double const squared = dot(along, along);
    double const at = squared > 0.0 ? Math::clamp(dot(point - a, along) / squared, 0.0, 1.0) : 0.0;
    nearest = Math::min(nearest, norm(point - a - at * along));
  }
  return inside ? 0.0 : nearest;
}

/// Whether a body is a tip, below a hundredth of the cell, that two lines leave as it is, and the given sequence draws
/// all along its cell's side: a tenth of a cell and more beyond it. By its centroid such a film, which may lean a
/// little, is as good; it is the neighbours that tell the tip. And the film touches what meets the side elsewhere.
HARMOS_LARGE_FUNCTION bool savesTip(CellComponents const &components, RemovalPlan const &plan, RemovalPlan const &given,
                                    Region const &region, int body)
{
  constexpr double beyond = 0.1, largest = 0.01; // [cells]; of the cell
  Vector2 const second = plan.normal[2 * body + 1];
  if (!(components.volume[body] < largest) || (second[0] == 0.0 && second[1] == 0.0))
    return false;
  double farthest = 0.0;
  forEachPart(components, given,
              [&](Region const &part, int k, Vector2 const &)
              {
                for (int i = 0; k == body && i < part.size; ++i)
                  farthest = Math::max(farthest, distanceFrom(region, part[i]));
              });
  return farthest > beyond;
}

/// Bodies and void that the given plan does not leave as they are, in sequence: where each of them, drawn as if it were
/// alone in the cell, stays as it is, and none reaches into another, they are apart, and void is what is left.
///
/// Corners of two bodies that pass each other at a distance share cells with void both between them and beyond. All
/// other plans have bodies meet somewhere where void is not all between them; so they touched, and felt each other
/// through a tenth of a cell of void. Bodies with bent edges count where their regions keep 0.01 cells away from each
/// other: what bends is a chord to some thousandths of a cell. Matter that has flowed has no straight edges: its cells
/// are left to the other plans.
HARMOS_LARGE_FUNCTION RemovalPlan apartPlan(ReconstructionField const &field, CellComponents const &components,
                                            SliverBounds const &slivers, RemovalPlan const &given)
{
  constexpr double much_better = 0.1;     // of the given plan's error
  constexpr double least_overlap = 1e-13; // of the cell
  constexpr double clear = 0.01;          // of the cell's side
  int const bodies = components.count - 1;
  if (bodies < 2 || bodies > RemovalPlan::most_apart || components.material[bodies] != void_material ||
      given.error <= removal_tie)
    return given;
  for (int k = 0; k < bodies; ++k)
    if (hasFlowed(field, components, k))
      return given;
  RemovalPlan plan = given;
  plan.apart = true;
  plan.parted = plan.corner = plan.filmed = false;
  plan.error = 0.0;
  Region region[RemovalPlan::most_apart];
  bool bent = false, saves = false;
  for (int k = 0; k < bodies; ++k)
  {
    DrawnAlone const drawn = drawAlone(field, components, k, slivers, plan, region[k]);
    if (drawn == DrawnAlone::Missed)
      return given;
    bent = bent || drawn == DrawnAlone::Bent;
    saves = saves || savesTip(components, plan, given, region[k], k);
    for (int j = 0; j < k; ++j)
    {
      if (bent && !clearOf(region[j], region[k], clear))
        return given;
      Region common;
      clipConvex(region[j], region[k], common);
      if (!common.empty() && area(common) > least_overlap)
        return given;
    }
  }
  return saves || plan.error <= much_better * given.error ? plan : given;
}

} // namespace Harmos

#endif
