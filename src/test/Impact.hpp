// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_IMPACT_HPP
#define HARMOS_TEST_IMPACT_HPP

#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Paint.hpp>
#include <Harmos_TimeStep.hpp>

namespace Harmos
{
namespace Test
{

inline Material metal(double density)
{
  Material m;
  m.eos = EosKind::MieGruneisen;
  m.strength = StrengthKind::Plastic;
  m.density0 = density;
  m.sound_speed0 = 4000.0;
  m.slope = 1.4;
  m.gruneisen = 2.0;
  m.shear_modulus = 30e9;
  m.yield = 0.2e9;
  return m;
}

/// A disc that hits a block, in the unit square between slip walls; cells of h = 1/40 or another.
struct Impact
{
  Exchange alone;
  Scene scene;
  CycleState state;
  PhaseTimes times;
  double work = 0.0, loss = 0.0;
  Vector2 impulse = {0.0, 0.0};
  long long failures = 0;

  explicit Impact(int cells_a_side = 40)
  {
    std::vector<double> const lines = gradedCoordinates(0.0, 1.0, cells_a_side, 1.0);
    scene.mesh = buildMesh(rectilinearMesh(lines, lines));
    scene.boundary = buildBoundaryConditions(scene.mesh, deviceCopy("boundary", std::vector<Boundary>(4)));
    scene.materials = deviceCopy("materials", std::vector<Material>{metal(8930.0), metal(2700.0)});
    scene.constraint.interaction = View<PairInteraction **>("interaction", 2, 2);
    scene.exchange = &alone;
    Body disc, block;
    disc.shape = Shape::disc({0.33, 0.52}, 0.15);
    disc.velocity = {300.0, 30.0};
    disc.density = 8930.0;
    block.shape = Shape::rectangle({0.65, 0.5}, {0.31, 0.53});
    block.material = 1;
    block.density = 2700.0;
    disc.specific_volume = 1.0 / disc.density;
    block.specific_volume = 1.0 / block.density;
    Painting const painting = paint(scene.mesh, {disc, block});
    state.pairs = painting.pairs;
    state.state.record = painting.record;
    state.state.centroid = painting.centroid;
    state.dof_nodes = buildDofNodes(scene.mesh, scene.kinematics, state.state.record, state.pairs);
    state.state.velocity = paintedVelocity(scene.mesh, {disc, block}, painting, state.dof_nodes);
    startCycle(scene, state);
    Tracer tracer;
    tracer.position = {0.33, 0.52};
    tracer.material = 0;
    tracer.cell = locatePoints(scene.mesh, {tracer.position}, alone)[0];
    state.tracers.push_back(tracer);
  }

  /// Cycles up to a time.
  void run(double end)
  {
    while (state.time < end && failures == 0)
    {
      CycleReport const report = advance(scene, state, times);
      work += report.external_work;
      loss += report.constraint.contact_loss + report.remap.kinetic_loss;
      impulse += report.external_impulse;
      failures += report.remap.failures + report.reconstruction.failures + report.update.inverted;
    }
  }

  MaterialSums sums() const
  {
    return materialSums(scene.mesh, state.pairs, state.state.record, state.state.velocity, 2);
  }
};

} // namespace Test
} // namespace Harmos

#endif
