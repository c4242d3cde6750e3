// SPDX-License-Identifier: BSD-3-Clause
// A program that has its own mesh, partition and Tpetra maps, and lets Harmos advance the materials on them.
//
// The mesh is an O-grid around a hole, cut into sectors, one a rank. A copper disc flies across it into an aluminium
// block; nothing touches the rim. Momentum and mass must stay; the exit status says whether they do.
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Paint.hpp>
#include <Harmos_TimeStep.hpp>
#include <Harmos_TpetraExchange.hpp>

#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>

#include <cmath>
#include <cstdio>
#include <stdexcept>

using namespace Harmos;
using Map = Tpetra::Map<>;

namespace
{

constexpr int num_around = 120, num_across = 24;
constexpr double inner_radius = 0.5, outer_radius = 1.5; // [m]
constexpr int num_cycles = 200;
enum Rim : int
{
  InnerRim,
  OuterRim
};

/// The host's own unstructured mesh: cell i of ring j joins rays i and i + 1; the last one closes the ring.
HostMesh makeOGrid()
{
  HostMesh mesh;
  for (int j = 0; j <= num_across; ++j)
    for (int i = 0; i < num_around; ++i)
    {
      double const angle = 2.0 * Math::pi * i / num_around;
      double const radius = inner_radius + (outer_radius - inner_radius) * j / num_across;
      mesh.node.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  for (int j = 0; j < num_across; ++j)
    for (int i = 0; i < num_around; ++i)
    {
      int const next = (i + 1) % num_around;
      int const low = j * num_around, high = low + num_around;
      mesh.cell.push_back({low + i, high + i, high + next, low + next}); // counter-clockwise
      mesh.face_boundary.push_back({-1, j == num_across - 1 ? OuterRim : -1, -1, j == 0 ? InnerRim : -1});
    }
  return mesh;
}

/// The host's own partition: sectors of equal angle; on two ranks they part where the disc hits the block.
std::vector<int> sectorOwners(HostMesh const &mesh, int ranks)
{
  std::vector<int> owner;
  for (std::size_t cell = 0; cell < mesh.cell.size(); ++cell)
    owner.push_back(static_cast<int>((cell + num_around / 4) % num_around) * ranks / num_around);
  return owner;
}

/// The host's map of its cells, and the one of the cells that Harmos' local mesh owns: they must agree, item by item.
bool mapsAgree(Teuchos::RCP<Teuchos::Comm<int> const> const &comm, std::vector<int> const &owner, Mesh const &mesh)
{
  auto const none = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  std::vector<Map::global_ordinal_type> mine, local;
  for (std::size_t cell = 0; cell < owner.size(); ++cell)
    if (owner[cell] == comm->getRank())
      mine.push_back(static_cast<Map::global_ordinal_type>(cell));
  auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_global);
  auto const depth = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_depth);
  for (int cell = 0; cell < mesh.num_cells; ++cell)
    if (depth(cell) == 0)
      local.push_back(static_cast<Map::global_ordinal_type>(global(cell)));
  Map const host_map(none, Teuchos::ArrayView<Map::global_ordinal_type const>(mine), 0, comm);
  Map const harmos_map(none, Teuchos::ArrayView<Map::global_ordinal_type const>(local), 0, comm);
  return host_map.isSameAs(harmos_map);
}

std::vector<Material> makeMaterials()
{
  Material copper; // number 0
  copper.eos = EosKind::MieGruneisen;
  copper.strength = StrengthKind::Plastic;
  copper.density0 = 8930.0;
  copper.sound_speed0 = 3940.0;
  copper.slope = 1.489;
  copper.gruneisen = 2.0;
  copper.shear_modulus = 45.0e9;
  copper.yield = 90.0e6;
  Material aluminium; // number 1
  aluminium.eos = EosKind::Stiffened;
  aluminium.strength = StrengthKind::Elastic;
  aluminium.density0 = 2700.0;
  aluminium.sound_speed0 = 5000.0;
  aluminium.shear_modulus = 27.0e9;
  return {copper, aluminium};
}

std::vector<Body> makeBodies()
{
  Body disc;
  disc.shape = Shape::disc({-0.16, 1.0}, 0.15);
  disc.material = 0;
  disc.velocity = {200.0, 0.0};
  disc.density = 8930.0;
  disc.specific_volume = 1.0 / disc.density;
  disc.name = "disc";
  Body block;
  block.shape = Shape::rectangle({0.15, 1.0}, {0.3, 0.4});
  block.material = 1;
  block.density = 2700.0;
  block.specific_volume = 1.0 / block.density;
  block.name = "block";
  return {disc, block};
}

Scene makeScene(Mesh const &mesh, Exchange const &exchange)
{
  Scene scene;
  scene.kinematics = Kinematics::Xfem;
  scene.mesh = mesh;
  Boundary open;
  open.kind = BoundaryKind::Outflow;
  scene.boundary = buildBoundaryConditions(mesh, deviceCopy("boundary", std::vector<Boundary>{open, open}));
  scene.materials = deviceCopy("materials", makeMaterials());
  scene.constraint.interaction = View<PairInteraction **>("interaction", 2, 2); // of itself: sliding
  scene.exchange = &exchange;
  return scene;
}

CycleState makeState(Scene &scene)
{
  CycleState s;
  std::vector<Body> const bodies = makeBodies();
  Painting painting = paint(scene.mesh, bodies);
  s.pairs = painting.pairs;
  s.state.record = painting.record;
  s.state.centroid = painting.centroid;
  s.dof_nodes = buildDofNodes(scene.mesh, scene.kinematics, s.state.record, s.pairs);
  s.state.velocity = paintedVelocity(scene.mesh, bodies, painting, s.dof_nodes);
  if (startCycle(scene, s).failures > 0)
    throw std::runtime_error("an interface of the start could not be placed");
  return s;
}

/// Totals of the deformable materials over all ranks.
struct Totals
{
  double mass, speed_momentum; // sum m, sum m |v|
  Vector2 momentum;
};

Totals totalsOf(Scene const &scene, CycleState const &s)
{
  auto const mesh = scene.mesh;
  auto const pairs = s.pairs;
  auto const record = s.state.record;
  auto const velocity = s.state.velocity;
  double sums[4] = {};
  Kokkos::parallel_reduce(
      "HostApplication::totals", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, double &mass, double &speed, double &x, double &y) {
        if (mesh.cell_depth(pairs.cell(pair)) != 0)
          return;
        double const quarter = 0.25 * record(pair, Mass); // each corner's share
        mass += record(pair, Mass);
        for (int k = 0; k < 4; ++k)
        {
          Vector2 const v{velocity(pairs.dof_node(pair, k), 0), velocity(pairs.dof_node(pair, k), 1)};
          speed += quarter * norm(v);
          x += quarter * v[0];
          y += quarter * v[1];
        }
      },
      sums[0], sums[1], sums[2], sums[3]);
  scene.exchange->sum(sums, 4);
  return {sums[0], sums[1], {sums[2], sums[3]}};
}

/// Largest corner force, and the largest sum of a pair's four corner forces, over all ranks. [N/m]
struct CornerForces
{
  double largest, unbalanced;
};

CornerForces cornerForcesOf(Scene const &scene, View<double *[8]> const &force, int num_pairs)
{
  double largest = 0.0, unbalanced = 0.0;
  Kokkos::parallel_reduce(
      "HostApplication::cornerForces", RangePolicy(0, num_pairs),
      KOKKOS_LAMBDA(int pair, double &most, double &rest) {
        Vector2 sum{0.0, 0.0};
        for (int k = 0; k < 4; ++k)
        {
          Vector2 const f{force(pair, 2 * k), force(pair, 2 * k + 1)};
          most = Math::max(most, norm(f));
          sum += f;
        }
        rest = Math::max(rest, norm(sum));
      },
      Kokkos::Max<double>(largest), Kokkos::Max<double>(unbalanced));
  return {scene.exchange->max(largest), scene.exchange->max(unbalanced)};
}

int run(Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  bool const speaks = comm->getRank() == 0;
  HostMesh const whole = makeOGrid();
  checkHostMesh(whole);
  std::vector<int> const owner = sectorOwners(whole, comm->getSize());
  Mesh const mesh = buildLocalMesh(whole, owner, comm->getRank(), comm->getSize() > 1 ? halo_layers : 0);
  if (!mapsAgree(comm, owner, mesh))
  {
    if (speaks)
      std::printf("the host's map of cells is not that of the local meshes\n");
    return 1;
  }
  TpetraExchange const exchange(comm, mesh);
  Scene scene = makeScene(mesh, exchange);
  CycleState state = makeState(scene);

  Totals const first = totalsOf(scene, state);
  PhaseTimes times;
  double contact_impulse = 0.0;
  CornerForces forces{};
  for (int cycle = 0; cycle < num_cycles; ++cycle)
  {
    int const num_pairs = state.pairs.num_pairs; // corner forces belong to the pairs that the cycle starts with
    CycleReport const report = advance(scene, state, times);
    if (report.update.inverted + report.update.not_a_number + report.remap.failures > 0)
    {
      if (speaks)
        std::printf("cycle %d failed\n", cycle);
      return 1;
    }
    contact_impulse += report.constraint.pair_force[1].normal_impulse; // row 0 (copper), column 1 (aluminium)
    CornerForces const now = cornerForcesOf(scene, state.work.corner_force, num_pairs);
    forces = {Math::max(forces.largest, now.largest), Math::max(forces.unbalanced, now.unbalanced)};
  }
  Totals const last = totalsOf(scene, state);
  double const balance_error = forces.unbalanced / forces.largest; // a pair's corner forces add up to zero
  double const mass_error = std::fabs(last.mass - first.mass) / first.mass;
  double const momentum_error = norm(last.momentum - first.momentum) / last.speed_momentum;
  if (speaks)
  {
    std::printf("ranks %d  cycles %lld  t %.6g s  dt %.3g s\n", comm->getSize(), state.cycle, state.time, state.dt);
    std::printf("contact impulse       %.9g N s/m\n", contact_impulse);
    std::printf("largest corner force  %.9g N/m\n", forces.largest);
    std::printf("force balance error   %.2e\n", balance_error);
    std::printf("mass error            %.2e\n", mass_error);
    std::printf("momentum error        %.2e\n", momentum_error);
  }
  return mass_error <= 1e-12 && momentum_error <= 1e-12 && balance_error <= 1e-12 ? 0 : 1;
}

} // namespace

int main(int argc, char **argv)
{
  Tpetra::ScopeGuard scope(&argc, &argv);
  try
  {
    return run(Tpetra::getDefaultComm());
  }
  catch (std::exception const &problem)
  {
    std::fprintf(stderr, "host_application: %s\n", problem.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  return 1;
}
