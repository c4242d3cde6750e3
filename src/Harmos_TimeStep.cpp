// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_TimeStep.hpp"

#include "Harmos_ContactState.hpp"
#include "Harmos_PhaseTimer.hpp"
#include "Harmos_PrescribedCycle.hpp"
#include "Harmos_RigidMotion.hpp"
#include "Harmos_TargetMesh.hpp"

#include <Harmos_LumpedForces.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_StateExchange.hpp>

#include <cmath>
#include <stdexcept>

namespace Harmos
{
namespace
{

constexpr int most_repeats = 8;
constexpr double largest_growth = 1.05; // of dt from one cycle to the next

/// Work of gravity with v_mean = (v^{n-1/2} + v^{n+1/2})/2 on deformable bodies, owned nodes. [J/m]
double gravityWork(Scene const &scene, CycleState const &s, double kick)
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
          part += 0.5 * kick * dof_mass(dof) *
                  (g[0] * (velocity(dof, 0) + half(dof, 0)) + g[1] * (velocity(dof, 1) + half(dof, 1)));
      },
      sum);
  return sum;
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
      Vector2 const weight = (report.kick * s.bodies[b].mass) * scene.lagrange.gravity;
      report.external_impulse += weight;
      report.external_work += 0.5 * dot(weight, bodies_n[b].velocity + s.bodies[b].velocity);
    }
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

/// The step of this cycle is one that is stable in cut cells and at free edges too. Collective.
void limitAtEdges(Scene const &scene, CycleState &s)
{
  TimeStepLimit const limit = edgeStepLimit(scene.mesh, s.pairs, s.dof_nodes, s.state, s.regions, scene.boundary,
                                            scene.materials, scene.lagrange, s.dt, s.work);
  if (limit.dt < s.limit.dt)
    s.limit = limit;
  s.dt = Math::min(s.dt, scene.exchange->min(limit.dt));
}

/// Forces of a step of dt and the velocities that they predict.
PredictionSums accelerate(Scene &scene, CycleState &s, double dt, double kick)
{
  LagrangeOptions options = scene.lagrange;
  options.energy_lag = 0.5 * dt; // of the step that lies behind, which the one ahead stands for
  options.kick = kick;
  bool const body_fitted = scene.kinematics == Kinematics::Lagrangian;
  bool const lumps = s.work.keeps_pressure && !body_fitted &&
                     locateCutFluids(scene.mesh, s.pairs, s.regions, scene.materials, options, s.work);
  if (!body_fitted && !lumps)
    return computeForcesAndPredict(scene.mesh, s.pairs, s.dof_nodes, s.state, scene.boundary, scene.materials, options,
                                   kick, s.work);
  computeCornerForces(scene.mesh, s.pairs, s.state, scene.materials, options, s.work);
  if (lumps)
    addLumpedForces(scene.mesh, s.pairs, s.state, s.regions, scene.boundary, scene.materials, options, s.work);
  if (body_fitted)
    addSubzonalForces(scene.mesh, s.pairs, s.state, scene.materials, scene.subzone_fraction,
                      scene.lagrange.subzonal_pressure, s.work);
  return predictVelocities(scene.mesh, s.pairs, s.dof_nodes, s.state, scene.boundary, scene.materials, options, kick,
                           s.work);
}

/// The scene's options with the rigid bodies' corners at the poses of the last `rigidRows`.
ReconstructionOptions withCorners(Scene const &scene, CycleState const &s)
{
  ReconstructionOptions options = scene.reconstruction;
  options.corners = s.rigid_corners;
  return options;
}

} // namespace

PointField pointField(Scene const &scene, CycleState const &s)
{
  return {scene.mesh, s.pairs, s.state, s.regions, scene.materials};
}

void reconstructState(Scene const &scene, CycleState &s, ReconstructionReport &report)
{
  if (scene.kinematics != Kinematics::Lagrangian)
    rigidRows(scene, s);
  s.regions = reconstruct(scene.mesh, s.pairs, s.state, withCorners(scene, s), report);
}

CycleReport advance(Scene &scene, CycleState &s, PhaseTimes &times)
{
  if (!s.started)
    throw std::runtime_error("advance: the state has not been started; see startCycle");
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
    if (scene.kinematics == Kinematics::Xfem && scene.lagrange.cut_cell_stress != CutCellStress::CellMean)
      computeCutGradients(mesh, s.pairs, s.state.record, s.regions, scene.materials, scene.boundary,
                          scene.lagrange.cut_cell_stress, scene.lagrange.shortest_bent_edge, work.cut);
    limitAtEdges(scene, s);
  }

  if (s.cycle == 0)
    placeBonds(scene, s);
  PredictionSums prediction;
  TravelReport travel;
  double dt = s.dt, kick = 0.0;
  PairStress stress;
  if (scene.constraint.method == ConstraintMethod::Nitsche)
    stress.cauchy = pairStress(s, scene.materials);
  if (work.keeps_pressure)
    stress.pressure = work.pressure;
  std::vector<RigidBody> const bodies_n = s.bodies;
  std::vector<Shape> const outlines = scene.kinematics == Kinematics::Single || scene.rigid_shape.empty()
                                          ? std::vector<Shape>()
                                          : presentShapes(scene, s.bodies);
  for (;; dt *= 0.5, ++report.repeats)
  {
    kick = 0.5 * (s.last_dt + dt);
    {
      PhaseTimer timer("lagrange", times.lagrange);
      prediction = accelerate(scene, s, dt, kick);
    }
    {
      PhaseTimer timer("constrain", times.constrain);
      s.bodies = predictBodies(bodies_n, scene.lagrange.gravity, kick);
      work.half = work.constrained;
      report.constraint =
          constrainVelocities(mesh, s.pairs, s.dof_nodes, s.regions, scene.boundary, work.dof_mass, s.state.velocity,
                              work.predicted, work.half, bodies_n, s.bodies, dt, kick, stress, s.bonds,
                              scene.constraint, exchange, s.force, &s.constraint_work, outlines);
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
  report.kick = kick;
  s.force = report.constraint.force;
  report.broken_bonds = breakBonds(report.constraint.bond_load, scene.constraint, kick, s.bonds);
  if (scene.kinematics != Kinematics::Lagrangian)
  {
    PhaseTimer timer("exchange", times.exchange);
    exchangeDofVelocities(exchange, mesh.halo, s.pairs, work.half);
  }
  double const gravity_work = gravityWork(scene, s, kick);

  TimeStepLimit next;
  {
    PhaseTimer timer("lagrange", times.lagrange);
    keepForFailure(s.pairs, s.state, work);
    if (closes)
      closeMixedCells(mesh, s.pairs, s.state, scene.materials, dt, work);
    report.update = updatePairs(mesh, s.pairs, s.state, scene.materials, scene.lagrange, dt, kick, work, next);
    report.failure = failPairs(mesh, scene.kinematics, s.pairs, s.state, scene.materials, dt, work);
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
      s.regions = refill(mesh, s.pairs, s.state, s.regions, withCorners(scene, s), report.reconstruction);
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
  s.last_dt = dt;
  s.time += dt;
  ++s.cycle;
  bookExternal(scene, s, bodies_n, prediction, travel, gravity_work, report);
  return report;
}

} // namespace Harmos
