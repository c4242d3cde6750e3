// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RigidMotion.hpp"
#include "Harmos_Run.hpp"

#include <Harmos_Paint.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Harmos
{
namespace
{

/// How far two bodies together fill some cell beyond its volume, over that; 0: no cell. Collective.
double overlap(Run const &run, std::array<int, 2> const &pair)
{
  std::vector<Shape> const all = presentShapes(run.scene, run.state.bodies);
  Shape const shape[2] = {all[pair[0]], all[pair[1]]};
  bool const meet = shape[0].boundingBox().meets(shape[1].boundingBox());
  return run.exchange->max(meet ? mostFilled(run.scene.mesh, shape) - 1.0 : 0.0);
}

/// Bodies that touch overlap by round-off.
constexpr double touching = 1e-6;

/// How far two bodies must have moved against each other before they are looked at again. [cells]
constexpr double look_again = 0.05;

/// Most by which a point of the mesh's box has moved with one body against the other since they were looked at.
double movedSinceLook(Run const &run, WatchedBodies const &watched)
{
  auto const &x = run.deck.x, &y = run.deck.y;
  Vector2 shift{0.0, 0.0};
  double turned = 0.0;
  for (int k = 0; k < 2; ++k)
  {
    RigidBody const &body = run.state.bodies[watched.pair[k]];
    double farthest = 0.0;
    for (double const corner_x : {x.from, x.to})
      for (double const corner_y : {y.from, y.to})
        farthest = std::max(farthest, norm(Vector2{corner_x, corner_y} - body.centre));
    shift += (k == 0 ? 1.0 : -1.0) * (body.centre - watched.centre[k]);
    turned += std::fabs(body.angle - watched.angle[k]) * farthest;
  }
  return norm(shift) + turned;
}

/// Note where two bodies are looked at.
void look(Run const &run, WatchedBodies &watched)
{
  for (int k = 0; k < 2; ++k)
  {
    RigidBody const &body = run.state.bodies[watched.pair[k]];
    watched.centre[k] = body.centre;
    watched.angle[k] = body.angle;
  }
}

} // namespace

double mostFilled(Mesh const &mesh, Shape const (&shape)[2])
{
  std::vector<double> filled(mesh.num_cells, 0.0);
  double most = 0.0;
  for (Shape const &one : shape)
  {
    PaintedRows const rows = rigidVolumes(mesh, {one}, {0});
    auto const offset = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.offset);
    auto const fraction = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.volume_fraction);
    for (std::size_t cell = 0; cell < filled.size(); ++cell)
      for (int row = offset(cell); row < offset(cell + 1); ++row)
      {
        filled[cell] += fraction(row);
        most = std::max(most, filled[cell]);
      }
  }
  return most;
}

void watchRigidBodies(Run &run)
{
  std::vector<RigidBody> const &bodies = run.state.bodies;
  if (run.deck.kinematics == Kinematics::Lagrangian)
    return;
  for (int a = 0; a < static_cast<int>(bodies.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(bodies.size()); ++b)
    {
      bool const driven = bodies[a].motion != RigidMotion::Free && bodies[b].motion != RigidMotion::Free;
      bool const moves = bodies[a].motion == RigidMotion::Prescribed || bodies[b].motion == RigidMotion::Prescribed;
      // The deck may have cut one out of the other.
      if (driven && moves && !(overlap(run, {a, b}) > touching))
      {
        run.watched.push_back({{a, b}, {}, {}});
        look(run, run.watched.back());
      }
    }
}

void reportRigidOverlap(Run &run)
{
  double const least = look_again * std::min(run.deck.x.smallestCell(), run.deck.y.smallestCell());
  auto const ran = [&](WatchedBodies &watched)
  {
    if (movedSinceLook(run, watched) < least)
      return false;
    look(run, watched);
    std::array<int, 2> const &pair = watched.pair;
    double const part = overlap(run, pair);
    if (!(part > touching))
      return false;
    std::vector<std::string> const names = materialNames(run.deck);
    char text[80];
    std::snprintf(text, sizeof text, " run into one another, by %.2g of a cell: nothing keeps them apart", part);
    warn(run, "cycle " + std::to_string(run.state.cycle) + ": the rigid bodies " +
                  names[run.state.bodies[pair[0]].material] + " and " + names[run.state.bodies[pair[1]].material] +
                  text);
    return true;
  };
  run.watched.erase(std::remove_if(run.watched.begin(), run.watched.end(), ran), run.watched.end());
}

} // namespace Harmos
