// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_TimeStep.hpp"

#include "Harmos_ContactState.hpp"
#include "Harmos_PhaseTimer.hpp"
#include "Harmos_PrescribedCycle.hpp"

#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Paint.hpp>
#include <Harmos_StateExchange.hpp>

#include <cmath>
#include <stdexcept>

namespace Harmos
{
namespace
{

constexpr int most_repeats = 8;
constexpr double largest_growth = 1.05; // of dt from one cycle to the next
constexpr double largest_shared_aspect =
    2.125; // largestAspectRatio of a rectangle with sides 1 : 4 (doc/decisions/0003)

/// Work of gravity with v_mean = (v^{n-1/2} + v^{n+1/2})/2 on deformable bodies, owned nodes. [J/m]
double gravityWork(Scene const &scene, CycleState const &s, double dt)
{
  auto const dof_mass = s.work.dof_mass;
  auto const half = s.work.half;
  Vector2 const g = scene.lagrange.gravity;
  if (g[0] == 0.0 && g[1] == 0.0)
    return 0.0;
  auto const owned = scene.mesh.node_owned;
  auto const dof_nodes = s.dof_nodes;
  auto const velocity = s.state.velocity;
  double sum = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::gravityWork", RangePolicy(0, dof_nodes.num_dof_nodes),
      KOKKOS_LAMBDA(int dof, double &part) {
        if (owned(dof_nodes.node(dof)) == 1)
          part += 0.5 * dt * dof_mass(dof) *
                  (g[0] * (velocity(dof, 0) + half(dof, 0)) + g[1] * (velocity(dof, 1) + half(dof, 1)));
      },
      sum);
  return sum;
}

/// Free rigid bodies fall; the others keep their motion.
std::vector<RigidBody> predictBodies(std::vector<RigidBody> bodies, Vector2 const &gravity, double dt)
{
  for (RigidBody &body : bodies)
    if (body.motion == RigidMotion::Free)
      body.velocity += dt * gravity;
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

/// Set the rigid velocities after a remap. In `single` the nodes that a rigid material has newly reached are stopped,
/// or driven: what that does to the deformable materials is work and impulse of the rigid bodies.
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

/// What must not exceed one, over all ranks: the travel of a node over 0.9 of the least altitude around it, and the
/// part of a pure cell that swept faces take away. The latter is below one where all nodes travel less than 0.7 of
/// that.
double largestTravel(Scene const &scene, CycleState const &s, double dt, TravelReport const &travel)
{
  double const ratio = scene.exchange->max(travel.largest_ratio);
  if (!scene.remap.swept_faces || !(ratio > 0.6) || ratio > 1.0)
    return ratio;
  return Math::max(ratio, scene.exchange->max(largestSweptPart(scene.mesh, s.pairs, s.work.half, dt)));
}

/// Work and impulse from outside, of this cycle, over all ranks; what travel limits took counts as contact loss.
void bookExternal(Scene const &scene, CycleState const &s, std::vector<RigidBody> const &bodies_n,
                  PredictionSums const &prediction, TravelReport const &travel, double gravity_work,
                  CycleReport &report)
{
  Vector2 const nodal = prediction.wall_impulse + prediction.gravity_impulse + prediction.driven_impulse +
                        travel.wall_impulse + report.remap.wall_impulse;
  double sums[4] = {prediction.wall_work + gravity_work + prediction.driven_work, nodal[0], nodal[1],
                    travel.energy_loss};
  scene.exchange->sum(sums, 4);
  // The constraint's sums, and the bodies, are the same on all ranks already.
  report.external_work = sums[0] + report.constraint.driven_work;
  report.external_impulse = Vector2{sums[1], sums[2]} + report.constraint.external_impulse;
  report.constraint.contact_loss += sums[3];
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    if (s.bodies[b].motion == RigidMotion::Free)
    {
      Vector2 const weight = (report.dt * s.bodies[b].mass) * scene.lagrange.gravity;
      report.external_impulse += weight;
      report.external_work += 0.5 * dot(weight, bodies_n[b].velocity + s.bodies[b].velocity);
    }
}

bool samePoses(std::vector<RigidBody> const &a, std::vector<RigidBody> const &b)
{
  bool same = a.size() == b.size();
  for (std::size_t i = 0; i < a.size() && same; ++i)
    same = a[i].centre[0] == b[i].centre[0] && a[i].centre[1] == b[i].centre[1] && a[i].angle == b[i].angle;
  return same;
}

/// What the rigid bodies fill at their new poses; where none has moved, the rows of the last cycle.
RigidRows const &rigidRows(Scene const &scene, CycleState &state)
{
  if (state.rigid_rows.offset.extent(0) > 0 && samePoses(state.bodies, state.rigid_pose))
    return state.rigid_rows;
  std::vector<Shape> shapes;
  std::vector<int> materials;
  for (std::size_t b = 0; b < state.bodies.size(); ++b)
  {
    RigidBody const &start = scene.rigid_start[b];
    RigidBody const &body = state.bodies[b];
    shapes.push_back(scene.rigid_shape[b].moved(body.centre - start.centre, body.angle - start.angle));
    materials.push_back(body.material);
  }
  if (!shapes.empty())
  {
    PaintedRows const painted = rigidVolumes(scene.mesh, shapes, materials);
    state.rigid_rows = {painted.offset, painted.material, painted.volume_fraction, painted.centroid};
    state.rigid_pose = state.bodies;
  }
  return state.rigid_rows;
}

/// Nodes of a turning rigid block: on their circles, not on the tangents along which velocities would move them.
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

/// Node positions of a body-fitted mesh follow their (only) dof node, those of a turning rigid block its pose; the
/// velocity becomes v^{n+1/2}.
void moveMesh(Mesh &mesh, NodeMaterialPairs const &dof_nodes, int num_materials, std::vector<RigidBody> const &bodies_n,
              std::vector<RigidBody> const &bodies, View<double *[2]> const &velocity, View<double *[2]> const &half,
              double dt)
{
  View<int *> const turns("Harmos::turns", num_materials);
  auto const turning = Kokkos::create_mirror_view(turns);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].angular_velocity != 0.0)
    {
      turning(bodies[b].material) = 1;
      turnRigidNodes(mesh, dof_nodes, bodies_n[b], bodies[b], dt);
    }
  Kokkos::deep_copy(turns, turning);
  auto const position = mesh.node_position;
  Kokkos::parallel_for(
      "Harmos::moveMesh", RangePolicy(0, dof_nodes.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        int const node = dof_nodes.node(dof);
        bool const turned = turns(dof_nodes.material(dof)) == 1;
        for (int d = 0; d < 2; ++d)
        {
          position(node, d) += turned ? 0.0 : dt * half(dof, d);
          velocity(dof, d) = half(dof, d);
        }
      });
  updateVolumes(mesh);
}

/// Longest diagonal's square over the area, halved: of a rectangle of sides a < b it is (b/a + a/b)/2. Owned cells.
double largestAspectRatio(Mesh const &mesh)
{
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::largestAspectRatio", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, double &most) {
        Quadrilateral const q = cellQuadrilateral(mesh, cell);
        double const diagonal = Math::max(dot(q[2] - q[0], q[2] - q[0]), dot(q[3] - q[1], q[3] - q[1]));
        if (mesh.cell_depth(cell) == 0)
          most = Math::max(most, 0.5 * diagonal / mesh.cell_area(cell));
      },
      Kokkos::Max<double>(largest));
  return largest;
}

/// Move the mesh to where the host code wants it. \return Where it was; extent 0: nobody wants it moved.
View<double *[2]> moveToTarget(Scene &scene, CycleState &s, double dt)
{
  if (!scene.target_mesh)
    return {};
  Mesh &mesh = scene.mesh;
  View<double *[2]> const start = mesh.node_position;
  View<double *[2]> const target("Harmos::target", mesh.num_nodes);
  Kokkos::deep_copy(target, start);
  scene.target_mesh(mesh, s, dt, target);
  exchangeNodePositions(mesh, *scene.exchange, mesh.halo, target);
  mesh.node_position = target;
  separateGeometry(mesh);
  updateGeometry(mesh);
  if (scene.exchange->max(countInvertedCells(mesh)) > 0.0)
    throw std::runtime_error("the target mesh has cells that are not strictly convex");
  if (scene.exchange->size() > 1 && scene.exchange->max(largestAspectRatio(mesh)) > largest_shared_aspect)
    throw std::runtime_error("the target mesh has cells of an aspect ratio above 4, which run on one rank only");
  computeNodeAltitudes(mesh, s.work);
  s.rigid_rows = {}; // they belong to the cells
  return start;
}

/// On a mesh that has moved under the state: its stable step, and the cells of the tracers.
void settleOnTarget(Scene const &scene, CycleState &s, TimeStepLimit &next)
{
  prepareWork(s.pairs, s.dof_nodes, s.work);
  computeDofMass(scene.mesh, s.pairs, s.dof_nodes, s.state, scene.materials, s.work);
  next = stableTimeStep(scene.mesh, s.pairs, s.state, scene.materials, scene.lagrange, s.work);
  for (std::vector<Tracer> *const tracers : {&s.tracers, &s.bond_tracers})
  {
    std::vector<Vector2> points;
    for (Tracer const &tracer : *tracers)
      points.push_back(tracer.position);
    std::vector<long long> const cell = locatePoints(scene.mesh, points, *scene.exchange);
    for (std::size_t i = 0; i < cell.size(); ++i)
      (*tracers)[i].cell = cell[i];
  }
}

/// What has no meaning together. \throw std::runtime_error
void checkTarget(Scene const &scene)
{
  if (!scene.target_mesh)
    return;
  if (scene.kinematics == Kinematics::Lagrangian)
    throw std::runtime_error("a target mesh means nothing in lagrangian kinematics: the mesh is the material's");
  if (scene.prescribed.kind != FieldKind::None)
    throw std::runtime_error("a target mesh means nothing with a prescribed field, which keeps the cells' volumes");
}

} // namespace

void setRigidVelocities(Scene const &scene, CycleState &s)
{
  if (s.bodies.empty())
    return;
  auto const mesh = scene.mesh;
  auto const pairs = s.pairs;
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
            Vector2 const v = body.velocityAt({mesh.node_position(node, 0), mesh.node_position(node, 1)});
            velocity(pairs.dof_node(pair, k), 0) = v[0];
            velocity(pairs.dof_node(pair, k), 1) = v[1];
          }
        });
  }
}

PointField pointField(Scene const &scene, CycleState const &s)
{
  return {scene.mesh, s.pairs, s.state, s.regions, scene.materials};
}

void reconstructState(Scene const &scene, CycleState &s, ReconstructionReport &report)
{
  s.regions = reconstruct(scene.mesh, s.pairs, s.state, scene.reconstruction, report);
}

CycleReport advance(Scene &scene, CycleState &s, PhaseTimes &times)
{
  checkTarget(scene);
  if (scene.prescribed.kind != FieldKind::None)
    return advancePrescribed(scene, s, times);
  Exchange const &exchange = *scene.exchange;
  Mesh const &mesh = scene.mesh;
  CycleReport report;
  LagrangeWork &work = s.work;
  bool const closes = scene.kinematics == Kinematics::Single && scene.lagrange.closure == Closure::Compressibility;
  {
    PhaseTimer timer("lagrange", times.lagrange);
    prepareWork(s.pairs, s.dof_nodes, work);
    LagrangeOptions options = scene.lagrange;
    options.energy_lag = 0.5 * s.dt; // of the step that lies behind, which the one ahead stands for
    computeCornerForces(mesh, s.pairs, s.state, scene.materials, options, work);
    if (scene.kinematics == Kinematics::Lagrangian)
      addSubzonalForces(mesh, s.pairs, s.state, scene.materials, scene.subzone_fraction,
                        scene.lagrange.subzonal_pressure, work);
  }

  if (s.cycle == 0)
    placeBonds(scene, s);
  PredictionSums prediction;
  TravelReport travel;
  double dt = s.dt;
  View<double *[3]> const stress =
      scene.constraint.method == ConstraintMethod::Nitsche ? pairStress(s, scene.materials) : View<double *[3]>();
  std::vector<RigidBody> const bodies_n = s.bodies;
  for (;; dt *= 0.5, ++report.repeats)
  {
    {
      PhaseTimer timer("lagrange", times.lagrange);
      prediction = predictVelocities(mesh, s.pairs, s.dof_nodes, s.state, scene.boundary, scene.materials,
                                     scene.lagrange, dt, work);
    }
    {
      PhaseTimer timer("constrain", times.constrain);
      s.bodies = predictBodies(bodies_n, scene.lagrange.gravity, dt);
      report.constraint = constrainVelocities(mesh, s.pairs, s.dof_nodes, s.regions, scene.boundary, work.dof_mass,
                                              s.state.velocity, work.predicted, work.half, bodies_n, s.bodies, dt,
                                              stress, s.bonds, scene.constraint, exchange, s.force);
    }
    // What moves with its mesh outruns no neighbourhood: only the sheared and thinned cells of the reference would pay.
    if (scene.kinematics == Kinematics::Lagrangian)
      break;
    PhaseTimer timer("lagrange", times.lagrange);
    travel =
        limitTravel(mesh, s.pairs, s.dof_nodes, s.state, scene.boundary, scene.materials, scene.lagrange, dt, work);
    report.light_nodes = travel.limited;
    if (largestTravel(scene, s, dt, travel) <= 1.0 || report.repeats == most_repeats)
      break;
  }
  report.dt = dt;
  s.force = report.constraint.force;
  report.broken_bonds = breakBonds(report.constraint.bond_load, scene.constraint, dt, s.bonds);
  if (scene.kinematics != Kinematics::Lagrangian)
  {
    PhaseTimer timer("exchange", times.exchange);
    exchangeDofVelocities(exchange, mesh.halo, s.pairs, work.half);
  }
  double const gravity_work = gravityWork(scene, s, dt);

  TimeStepLimit next;
  {
    PhaseTimer timer("lagrange", times.lagrange);
    keepForFailure(s.pairs, s.state, work);
    if (closes)
      closeMixedCells(mesh, s.pairs, s.state, scene.materials, dt, work);
    report.update = updatePairs(mesh, s.pairs, s.state, scene.materials, scene.lagrange, dt, work, next);
    report.failure = failPairs(mesh, scene.kinematics, s.pairs, s.state, scene.materials, !closes, dt, work);
  }
  moveBodies(s.bodies, dt);
  moveTracers(pointField(scene, s), work.half, dt, scene.kinematics == Kinematics::Lagrangian, exchange, s.tracers);
  moveBonds(scene, s, dt);

  if (scene.kinematics == Kinematics::Lagrangian)
  {
    PhaseTimer timer("lagrange", times.lagrange);
    moveMesh(scene.mesh, s.dof_nodes, static_cast<int>(scene.materials.extent(0)), bodies_n, s.bodies, s.state.velocity,
             work.half, dt);
    setRigidVelocities(scene, s);
    computeNodeAltitudes(mesh, work);
  }
  else
  {
    // Volume fractions have changed within the cells.
    if (closes || report.failure.fractions_changed)
    {
      PhaseTimer timer("reconstruct", times.reconstruct);
      reconstructState(scene, s, report.reconstruction);
    }
    {
      PhaseTimer timer("remap", times.remap);
      View<double *[2]> const start = moveToTarget(scene, s, dt);
      RigidRows const &rigid = rigidRows(scene, s);
      RemapResult result =
          remap(mesh, scene.kinematics, s.pairs, s.dof_nodes, s.state, s.regions, scene.boundary, scene.materials,
                work.half, dt, rigid, scene.remap, report.remap, s.remap_work, start, *scene.exchange);
      s.pairs = result.pairs;
      s.dof_nodes = result.dof_nodes;
      s.state = result.state;
    }
    PhaseTimer timer("exchange", times.exchange);
    exchangeState(mesh, scene.kinematics, exchange, mesh.halo, s.pairs, s.dof_nodes, s.state);
    holdRigidNodes(scene, s, prediction);
    if (scene.target_mesh)
      settleOnTarget(scene, s, next);
  }
  {
    PhaseTimer timer("reconstruct", times.reconstruct);
    reconstructState(scene, s, report.reconstruction);
  }

  s.limit = next;
  s.dt = Math::min(Math::min(exchange.min(next.dt), scene.max_dt), largest_growth * dt);
  s.time += dt;
  ++s.cycle;
  bookExternal(scene, s, bodies_n, prediction, travel, gravity_work, report);
  return report;
}

} // namespace Harmos
