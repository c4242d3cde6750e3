// SPDX-License-Identifier: BSD-3-Clause
// Prints the bits of the state after some cycles of a copper disc that hits an aluminium block in front of a rigid
// wall, in one number: the same for any number of threads (see test same_bits_on_any_number_of_threads).
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Paint.hpp>
#include <Harmos_TimeStep.hpp>

#include <cstdint>
#include <cstdio>
#include <cstring>

using namespace Harmos;

namespace
{

template <class T>
View<T *> onDevice(std::string const &label, std::vector<T> const &values)
{
  View<T *> const view(label, values.size());
  auto const host = Kokkos::create_mirror_view(view);
  for (std::size_t i = 0; i < values.size(); ++i)
    host(i) = values[i];
  Kokkos::deep_copy(view, host);
  return view;
}

Material metal(double density, double sound_speed, double shear_modulus, double yield)
{
  Material m;
  m.eos = EosKind::MieGruneisen;
  m.strength = StrengthKind::Plastic;
  m.density0 = density;
  m.sound_speed0 = sound_speed;
  m.slope = 1.4;
  m.gruneisen = 2.0;
  m.shear_modulus = shear_modulus;
  m.yield = yield;
  return m;
}

Body body(Shape const &shape, int material, double density, Vector2 const &velocity)
{
  Body b;
  b.shape = shape;
  b.material = material;
  b.velocity = velocity;
  b.density = density;
  b.specific_volume = 1.0 / density;
  return b;
}

std::vector<Body> bodies()
{
  return {body(Shape::disc({0.33, 0.52}, 0.15), 0, 8930.0, {400.0, 30.0}),
          body(Shape::rectangle({0.65, 0.5}, {0.31, 0.53}), 1, 2700.0, {0.0, 0.0})};
}

CycleState makeState(Scene const &scene)
{
  CycleState s;
  Painting const painting = paint(scene.mesh, bodies());
  s.pairs = painting.pairs;
  s.state.record = painting.record;
  s.state.centroid = painting.centroid;
  s.dof_nodes = buildDofNodes(scene.mesh, scene.kinematics, s.state.record, s.pairs);
  s.state.velocity = paintedVelocity(scene.mesh, bodies(), painting, s.dof_nodes);
  ReconstructionReport report;
  reconstructState(scene, s, report);
  prepareWork(s.pairs, s.dof_nodes, s.work);
  computeNodeAltitudes(scene.mesh, s.work);
  computeDofMass(scene.mesh, s.pairs, s.dof_nodes, s.state, scene.materials, s.work);
  s.limit = stableTimeStep(scene.mesh, s.pairs, s.state, scene.materials, scene.lagrange, s.work);
  s.dt = s.limit.dt;
  return s;
}

/// Fowler-Noll-Vo hash, 64 bits.
template <class V>
void hash(V const &view, std::uint64_t &bits)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
  auto const *const bytes = reinterpret_cast<unsigned char const *>(host.data());
  for (std::size_t i = 0; i < host.size() * sizeof(typename V::value_type); ++i)
    bits = (bits ^ bytes[i]) * 1099511628211ull;
}

void run()
{
  Exchange const alone;
  HostMesh const whole = rectilinearMesh(gradedCoordinates(0.0, 1.0, 60, 1.0), gradedCoordinates(0.0, 1.0, 60, 1.0));
  Scene scene;
  scene.mesh = buildLocalMesh(whole, std::vector<int>(whole.cell.size(), 0), 0, 0);
  scene.boundary = buildBoundaryConditions(scene.mesh, onDevice("boundary", std::vector<Boundary>(4)));
  scene.materials = onDevice(
      "materials", std::vector<Material>{metal(8930.0, 3940.0, 45e9, 90e6), metal(2700.0, 5300.0, 27e9, 0.3e9)});
  scene.constraint.interaction = View<int **>("interaction", 2, 2);
  scene.exchange = &alone;
  CycleState state = makeState(scene);
  PhaseTimes times;
  long long rows = 0;
  for (int cycle = 0; cycle < 120; ++cycle)
    rows += advance(scene, state, times).constraint.rows;
  std::uint64_t bits = 14695981039346656037ull;
  hash(state.state.record, bits);
  hash(state.state.centroid, bits);
  hash(state.state.velocity, bits);
  std::printf("%d pairs, %lld contact rows, bits %016llx\n", state.pairs.num_pairs, rows,
              static_cast<unsigned long long>(bits));
}

} // namespace

int main(int argc, char **argv)
{
  Kokkos::ScopeGuard const kokkos(argc, argv);
  run();
}
