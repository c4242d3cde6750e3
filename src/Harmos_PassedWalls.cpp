// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RigidMotion.hpp"
#include "Harmos_Run.hpp"

#include <Harmos_DeckBodies.hpp>

#include <algorithm>

namespace Harmos
{
namespace
{

/// Bodies that touch a side reach beyond it by round-off. [of the mesh's extent]
constexpr double touching = 1e-9;

/// Whether a box reaches beyond a side of the mesh.
bool isBeyond(Deck const &deck, Box const &box, int side)
{
  AxisSpec const &axis = side < 2 ? deck.x : deck.y;
  int const d = side / 2;
  double const slack = touching * (axis.to - axis.from);
  return side % 2 == 0 ? box.low[d] < axis.from - slack : box.high[d] > axis.to + slack;
}

/// A side that holds nodes of the mesh alone: rigid bodies have none.
bool holdsNodesAlone(Deck const &deck, int side)
{
  BoundaryKind const kind = deck.boundary[side].kind;
  bool const axis = deck.geometry == Geometry::Axisymmetric && side == 0;
  return (kind == BoundaryKind::SlipWall || kind == BoundaryKind::Fixed) && !axis;
}

std::string sideText(Deck const &deck, int side)
{
  return std::string(deck.boundary[side].kind == BoundaryKind::Fixed ? "the fixed side " : "the slip wall ") +
         side_name[side];
}

} // namespace

void watchWalls(Run &run)
{
  if (run.deck.kinematics == Kinematics::Lagrangian)
    return;
  std::vector<RigidBody> const &bodies = run.state.bodies;
  std::vector<Shape> const shapes = presentShapes(run.scene, bodies);
  std::vector<std::string> const names = materialNames(run.deck);
  for (int side = 0; side < num_boundary_sides; ++side)
    for (int b = 0; b < static_cast<int>(bodies.size()); ++b)
    {
      if (!holdsNodesAlone(run.deck, side) || bodies[b].motion != RigidMotion::Free)
        continue;
      if (!isBeyond(run.deck, shapes[b].boundingBox(), side))
        run.watched_walls.push_back({b, side});
      else
        warn(run, "the free rigid body " + names[bodies[b].material] + " reaches beyond " + sideText(run.deck, side) +
                      ": that does not hold it, and its mass is that of the whole body");
    }
}

void reportPassedWalls(Run &run)
{
  if (run.watched_walls.empty())
    return;
  std::vector<RigidBody> const &bodies = run.state.bodies;
  std::vector<Shape> const shapes = presentShapes(run.scene, bodies);
  auto const passed = [&](std::array<int, 2> const &pair)
  {
    if (!isBeyond(run.deck, shapes[pair[0]].boundingBox(), pair[1]))
      return false;
    warn(run, "cycle " + std::to_string(run.state.cycle) + ": the free rigid body " +
                  materialNames(run.deck)[bodies[pair[0]].material] + " goes through " + sideText(run.deck, pair[1]) +
                  ": only a contact wall would stop it");
    return true;
  };
  run.watched_walls.erase(std::remove_if(run.watched_walls.begin(), run.watched_walls.end(), passed),
                          run.watched_walls.end());
}

} // namespace Harmos
