// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RigidMotion.hpp"

#include <Harmos_Paint.hpp>

#include <cmath>

namespace Harmos
{
namespace
{

bool samePoses(std::vector<RigidBody> const &a, std::vector<RigidBody> const &b)
{
  bool same = a.size() == b.size();
  for (std::size_t i = 0; i < a.size() && same; ++i)
    same = a[i].centre[0] == b[i].centre[0] && a[i].centre[1] == b[i].centre[1] && a[i].angle == b[i].angle;
  return same;
}

} // namespace

std::vector<RigidBody> predictBodies(std::vector<RigidBody> bodies, Vector2 const &gravity, double kick)
{
  for (RigidBody &body : bodies)
    if (body.motion == RigidMotion::Free)
      body.velocity += kick * gravity;
  return bodies;
}

void moveBodies(std::vector<RigidBody> &bodies, double dt)
{
  for (RigidBody &body : bodies)
  {
    body.centre += dt * body.velocity;
    body.angle += dt * body.angular_velocity;
  }
}

void holdRigidNodes(Scene const &scene, CycleState &s, PredictionSums &prediction)
{
  if (scene.kinematics != Kinematics::Single || s.bodies.empty())
  {
    setRigidVelocities(scene, s);
    return;
  }
  int const materials = static_cast<int>(scene.materials.extent(0));
  MaterialSums const before = materialSums(scene.mesh, s.pairs, s.state.record, s.state.velocity, materials);
  setRigidVelocities(scene, s);
  MaterialSums const after = materialSums(scene.mesh, s.pairs, s.state.record, s.state.velocity, materials);
  std::vector<bool> rigid(materials, false);
  for (RigidBody const &body : s.bodies)
    rigid[body.material] = true;
  for (int m = 0; m < materials; ++m)
    if (!rigid[m])
    {
      prediction.driven_impulse +=
          Vector2{after(m, SumMomentumX) - before(m, SumMomentumX), after(m, SumMomentumY) - before(m, SumMomentumY)};
      prediction.driven_work += after(m, SumKineticEnergy) - before(m, SumKineticEnergy);
    }
}

std::vector<Shape> presentShapes(Scene const &scene, std::vector<RigidBody> const &bodies)
{
  std::vector<Shape> shapes;
  for (std::size_t b = 0; b < bodies.size(); ++b)
  {
    RigidBody const &start = scene.rigid_start[b];
    shapes.push_back(scene.rigid_shape[b].moved(bodies[b].centre - start.centre, bodies[b].angle - start.angle));
  }
  return shapes;
}

RigidRows const &rigidRows(Scene const &scene, CycleState &state)
{
  if (state.rigid_rows.offset.extent(0) > 0 && samePoses(state.bodies, state.rigid_pose))
    return state.rigid_rows;
  std::vector<Shape> const shapes = presentShapes(scene, state.bodies);
  std::vector<int> materials;
  for (RigidBody const &body : state.bodies)
    materials.push_back(body.material);
  if (!shapes.empty())
  {
    PaintedRows const painted = rigidVolumes(scene.mesh, shapes, materials);
    state.rigid_rows = {painted.offset, painted.material, painted.volume_fraction, painted.centroid};
    state.rigid_corners = {painted.offset, painted.material, painted.volume_fraction, painted.corner};
    state.rigid_pose = state.bodies;
  }
  return state.rigid_rows;
}

void turnRigidNodes(Mesh const &mesh, NodeMaterialPairs const &dof_nodes, RigidBody const &body_n,
                    RigidBody const &body, double dt)
{
  auto const position = mesh.node_position;
  double const c = std::cos(dt * body.angular_velocity), s = std::sin(dt * body.angular_velocity);
  Kokkos::parallel_for(
      "Harmos::turnRigidNodes", RangePolicy(0, dof_nodes.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        if (dof_nodes.material(dof) != body.material)
          return;
        int const node = dof_nodes.node(dof);
        double const x = position(node, 0) - body_n.centre[0], y = position(node, 1) - body_n.centre[1];
        position(node, 0) = body.centre[0] + (c * x - s * y);
        position(node, 1) = body.centre[1] + (s * x + c * y);
      });
}

void setRigidVelocities(Scene const &scene, CycleState &s)
{
  if (s.bodies.empty())
    return;
  auto const mesh = scene.mesh;
  auto const pairs = s.pairs;
  auto const dof_nodes = s.dof_nodes;
  auto const boundary = scene.boundary;
  auto const velocity = s.state.velocity;
  for (RigidBody const &body : s.bodies)
  {
    Kokkos::parallel_for(
        "Harmos::setRigidVelocities", RangePolicy(0, pairs.num_pairs), KOKKOS_LAMBDA(int pair) {
          if (pairs.material(pair) != body.material)
            return;
          for (int k = 0; k < 4; ++k)
          {
            int const node = mesh.cell_node(pairs.cell(pair), k);
            Vector2 v = body.velocityAt({mesh.node_position(node, 0), mesh.node_position(node, 1)});
            int const dof = pairs.dof_node(pair, k), condition = boundary.node_index(node);
            if (condition >= 0 && dof_nodes.material(dof) < 0) // what shares the node stays in the mesh
              v = boundary.condition(condition).apply(v);
            velocity(dof, 0) = v[0];
            velocity(dof, 1) = v[1];
          }
        });
  }
}

} // namespace Harmos
