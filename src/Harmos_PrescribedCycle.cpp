// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_PrescribedCycle.hpp"

#include "Harmos_PhaseTimer.hpp"
#include "Harmos_RestoreVolumes.hpp"

#include <Harmos_StateExchange.hpp>

namespace Harmos
{
namespace
{

/// Mean velocity of the dof nodes' trajectories from t to t + dt. [m/s]
void setMeanVelocities(Mesh const &mesh, NodeMaterialPairs const &dof_nodes, PrescribedField const &field, double t,
                       double dt, View<double *[2]> const &velocity)
{
  auto const position = mesh.node_position;
  Kokkos::parallel_for(
      "Harmos::setMeanVelocities", RangePolicy(0, dof_nodes.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        int const node = dof_nodes.node(dof);
        Vector2 const u = field.displacement({position(node, 0), position(node, 1)}, t, dt);
        for (int d = 0; d < 2; ++d)
          velocity(dof, d) = u[d] / dt;
      });
}

void setMasses(Mesh const &mesh, CellMaterialPairs const &pairs, View<Material *> const &materials,
               View<double *[num_pair_fields]> const &record)
{
  Kokkos::parallel_for(
      "Harmos::setMasses", RangePolicy(0, pairs.num_pairs), KOKKOS_LAMBDA(int pair) {
        record(pair, Mass) = materials(pairs.material(pair)).density0 *
                             (record(pair, VolumeFraction) * mesh.cell_area(pairs.cell(pair)));
      });
}

/// Energy and momentum of all materials, this rank.
struct Motion
{
  double energy = 0.0;
  Vector2 momentum = {0.0, 0.0};
};

Motion motionOf(Scene const &scene, CycleState const &s)
{
  int const materials = static_cast<int>(scene.materials.extent(0));
  MaterialSums const sums = materialSums(scene.mesh, s.pairs, s.state.record, s.state.velocity, materials);
  Motion motion;
  for (int m = 0; m < materials; ++m)
  {
    motion.energy += sums(m, SumKineticEnergy) + sums(m, SumInternalEnergy);
    motion.momentum += Vector2{sums(m, SumMomentumX), sums(m, SumMomentumY)};
  }
  return motion;
}

/// The ledger closes: all change of energy and momentum comes from the field. What the remap alone would have lost
/// means nothing where the velocities are given anew.
void bookField(Scene const &scene, Motion const &before, Motion const &after, CycleReport &report)
{
  report.remap.kinetic_loss = 0.0;
  double sums[3] = {after.energy - before.energy, after.momentum[0] - before.momentum[0],
                    after.momentum[1] - before.momentum[1]};
  scene.exchange->sum(sums, 3);
  report.external_work = sums[0];
  report.external_impulse = {sums[1], sums[2]};
}

} // namespace

void setPrescribedVelocities(Scene const &scene, CycleState &s)
{
  PrescribedField const field = scene.prescribed;
  auto const position = scene.mesh.node_position;
  auto const dof_nodes = s.dof_nodes;
  auto const velocity = s.state.velocity;
  double const t = s.time;
  Kokkos::parallel_for(
      "Harmos::setPrescribedVelocities", RangePolicy(0, dof_nodes.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        int const node = dof_nodes.node(dof);
        Vector2 const v = field.velocityAt({position(node, 0), position(node, 1)}, t);
        for (int d = 0; d < 2; ++d)
          velocity(dof, d) = v[d];
      });
}

SideCrossing findSideCrossing(Scene const &scene, CycleState const &s)
{
  constexpr double tolerance = 1e-10; // of the face
  Mesh const mesh = scene.mesh;
  auto const pairs = s.pairs;
  PrescribedField const field = scene.prescribed;
  double const t = s.time, dt = s.dt;
  int first = mesh.num_cells;
  Kokkos::parallel_reduce(
      "Harmos::findSideCrossing", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &least) {
        if (pairs.offset(cell) == pairs.offset(cell + 1) || mesh.cell_depth(cell) != 0 || cell >= least)
          return;
        Quadrilateral const q = cellQuadrilateral(mesh, cell);
        for (int face = 0; face < 4; ++face)
        {
          if (mesh.face_boundary(cell, face) < 0)
            continue;
          Vector2 const a = q[face], b = q[(face + 1) % 4], edge = b - a;
          double const across = Math::max(Math::fabs(cross(edge, field.displacement(a, t, dt))),
                                          Math::fabs(cross(edge, field.displacement(b, t, dt))));
          if (across > tolerance * dot(edge, edge))
            least = cell;
        }
      },
      Kokkos::Min<int>(first));
  SideCrossing crossing;
  if (first >= mesh.num_cells)
    return crossing;
  int pair = 0;
  crossing.cell = first;
  Kokkos::deep_copy(pair, Kokkos::subview(pairs.offset, first));
  Kokkos::deep_copy(crossing.material, Kokkos::subview(pairs.material, pair));
  return crossing;
}

CycleReport advancePrescribed(Scene const &scene, CycleState &s, PhaseTimes &times)
{
  Exchange const &exchange = *scene.exchange;
  Mesh const &mesh = scene.mesh;
  int const materials = static_cast<int>(scene.materials.extent(0));
  CycleReport report;
  report.dt = s.dt;
  SideCrossing const crossing = findSideCrossing(scene, s);
  report.crossing_cell = crossing.cell;
  report.crossing_material = crossing.material;
  if (exchange.max(crossing.cell >= 0 ? 1.0 : 0.0) > 0.0)
    return report;
  Motion const before = motionOf(scene, s);
  std::vector<double> const volume = materialVolumes(mesh, s.pairs, s.state.record, materials, exchange);
  {
    PhaseTimer timer("lagrange", times.lagrange);
    prepareWork(s.pairs, s.dof_nodes, s.work);
    setMeanVelocities(mesh, s.dof_nodes, scene.prescribed, s.time, s.dt, s.work.half);
  }
  moveTracers(pointField(scene, s), s.work.half, s.dt, false, exchange, s.tracers);
  {
    PhaseTimer timer("remap", times.remap);
    RemapResult result =
        remap(mesh, scene.kinematics, s.pairs, s.dof_nodes, s.state, s.regions, scene.boundary, scene.materials,
              s.work.half, s.dt, {}, scene.remap, report.remap, s.remap_work, {}, *scene.exchange);
    s.pairs = result.pairs;
    s.dof_nodes = result.dof_nodes;
    s.state = result.state;
  }
  {
    PhaseTimer timer("exchange", times.exchange);
    exchangeState(mesh, scene.kinematics, exchange, mesh.halo, s.pairs, s.dof_nodes, s.state);
  }
  {
    PhaseTimer timer("lagrange", times.lagrange);
    report.restored_volume = restoreVolumes(mesh, s.pairs, s.state.record, volume, exchange).moved;
    setMasses(mesh, s.pairs, scene.materials, s.state.record);
    setMeanVelocities(mesh, s.dof_nodes, scene.prescribed, s.time, s.dt, s.state.velocity);
  }
  {
    PhaseTimer timer("reconstruct", times.reconstruct);
    reconstructState(scene, s, report.reconstruction);
  }
  bookField(scene, before, motionOf(scene, s), report);
  s.limit = {scene.max_dt, -1, -1};
  s.time += s.dt;
  s.dt = scene.max_dt;
  ++s.cycle;
  return report;
}

} // namespace Harmos
