// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_CheckScene.hpp"

#include "Harmos_Require.hpp"
#include "Harmos_TargetMesh.hpp"

#include <algorithm>

namespace Harmos
{
namespace
{

using namespace detail;

template <class V>
auto hostCopy(V const &view)
{
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
}

/// What one rank alone finds wrong all ranks throw, that of the first. Collective.
template <class Check>
void checkTogether(Exchange const &exchange, Check const &check)
{
  std::string mine;
  try
  {
    check();
  }
  catch (std::runtime_error const &error)
  {
    mine = error.what();
  }
  mine += '\n';
  std::vector<char> const all = exchange.gather({mine.begin(), mine.end()});
  auto const from = std::find_if(all.begin(), all.end(), [](char c) { return c != '\n'; });
  require(from == all.end(), {from, std::find(from, all.end(), '\n')});
}

void checkOptions(Scene const &scene)
{
  require(scene.max_dt > 0.0, "scene.max_dt is " + text(scene.max_dt) + "; expected: above 0");
  LagrangeOptions const &lagrange = scene.lagrange;
  require(lagrange.courant > 0.0 && lagrange.courant < 1.0,
          "scene.lagrange.courant is " + text(lagrange.courant) + "; expected: between 0 and 1");
  requireNotNegative("scene.lagrange.linear_viscosity", lagrange.linear_viscosity);
  requireNotNegative("scene.lagrange.quadratic_viscosity", lagrange.quadratic_viscosity);
  requireNotNegative("scene.lagrange.hourglass_viscosity", lagrange.hourglass_viscosity);
  requireFinite("scene.lagrange.gravity", lagrange.gravity[0]);
  requireFinite("scene.lagrange.gravity", lagrange.gravity[1]);
}

void requireRestitution(std::string const &entry, double value)
{
  require(value >= 0.0 && value <= 1.0, entry + " is " + text(value) + "; expected: from 0 to 1");
}

void checkInteractions(Scene const &scene)
{
  auto const table = hostCopy(scene.constraint.interaction);
  int const count = static_cast<int>(table.extent(0));
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b)
    {
      PairInteraction const &law = table(a, b), &other = table(b, a);
      std::string const entry = "scene.constraint.interaction(" + std::to_string(a) + ", " + std::to_string(b) + ")";
      if (law.kind == Interaction::Friction)
        requireNotNegative(entry + ".friction", law.friction);
      if (law.kind != Interaction::Bonded)
        requireRestitution(entry + ".restitution", law.restitution);
      else
      {
        requireNotNegative(entry + ".strength.tensile", law.strength.tensile);
        requireNotNegative(entry + ".strength.shear", law.strength.shear);
      }
      require(law.kind == other.kind && law.friction == other.friction && law.restitution == other.restitution &&
                  law.strength.tensile == other.strength.tensile && law.strength.shear == other.strength.shear,
              entry + " is not that of the same two the other way round; expected: a symmetric table");
    }
}

void checkSizes(Scene const &scene)
{
  std::string const n = std::to_string(scene.materials.extent(0));
  auto const &table = scene.constraint.interaction;
  require(table.extent(0) == scene.materials.extent(0) && table.extent(1) == scene.materials.extent(0),
          "scene.constraint.interaction is " + std::to_string(table.extent(0)) + " x " +
              std::to_string(table.extent(1)) + "; expected: " + n + " x " + n + ", as many as materials");
  require(static_cast<int>(scene.boundary.node_index.extent(0)) == scene.mesh.num_nodes,
          "scene.boundary does not belong to scene.mesh; see buildBoundaryConditions");
  require(scene.rigid_shape.size() == scene.rigid_start.size() ||
              (scene.kinematics == Kinematics::Lagrangian && scene.rigid_shape.empty()),
          "scene.rigid_shape and scene.rigid_start differ in number");
}

void checkBoundaryNumbers(Scene const &scene)
{
  Mesh const mesh = scene.mesh;
  int const count = static_cast<int>(scene.boundary.boundary.extent(0));
  int const face = firstWrong(
      "Harmos::checkBoundaryNumbers", 4 * mesh.num_cells, KOKKOS_LAMBDA(int i) {
        int const number = mesh.face_boundary(i / 4, i % 4);
        return number < -1 || number >= count;
      });
  if (face >= 0)
    require(false, placeOf("cell", mesh.cell_global, face / 4, *scene.exchange) + ": face " + std::to_string(face % 4) +
                       " lies on boundary " + std::to_string(hostCopy(mesh.face_boundary)(face / 4, face % 4)) +
                       "; expected: less than " + std::to_string(count) + ", the number in scene.boundary, or -1");
}

/// Whether mesh and exchange are of as many ranks.
void checkHalo(Scene const &scene)
{
  Mesh const &mesh = scene.mesh;
  int const ranks = scene.exchange->size();
  require(ranks > 1 || mesh.num_owned_cells == mesh.num_cells,
          "scene.exchange is of one rank, and " + std::to_string(mesh.num_cells - mesh.num_owned_cells) +
              " cells of scene.mesh belong to others; expected: a TpetraExchange of this mesh");
  if (ranks == 1)
    return;
  require(scene.kinematics != Kinematics::Lagrangian, "lagrangian kinematics runs on one rank only");
  require(mesh.halo >= halo_layers, "scene.mesh has a halo of " + std::to_string(mesh.halo) + " layers; expected: " +
                                        std::to_string(halo_layers) + " (halo_layers) on several ranks");
}

/// Whether all halo cells, those in `received`, come from somewhere.
void checkOwners(Scene const &scene, View<int *> const &received)
{
  Mesh const &mesh = scene.mesh;
  auto const cell = hostCopy(received);
  auto const depth = hostCopy(mesh.cell_depth);
  std::vector<char> comes(mesh.num_cells, 0);
  for (std::size_t i = 0; i < cell.extent(0); ++i)
    comes[cell(i)] = 1;
  for (int c = 0; c < mesh.num_cells; ++c)
    if (depth(c) > 0 && comes[c] == 0)
      require(false, placeOf("cell", mesh.cell_global, c, *scene.exchange) +
                         " lies in the halo and comes from no rank; expected: owners from 0 to " +
                         std::to_string(scene.exchange->size() - 1) + ", and an exchange of scene.mesh");
}

} // namespace

std::string placeOf(char const *what, View<long long *> const &global, int local, Exchange const &exchange)
{
  std::string const place = std::string(what) + " " + std::to_string(hostCopy(global)(local));
  return exchange.size() == 1 ? place : place + " on rank " + std::to_string(exchange.rank());
}

void checkBodies(Scene const &scene, CycleState const &s, std::vector<Material> const &laws)
{
  int const count = static_cast<int>(scene.rigid_start.size()), num_materials = static_cast<int>(laws.size());
  require(s.bodies.empty() || static_cast<int>(s.bodies.size()) == count,
          "state.bodies are " + std::to_string(s.bodies.size()) + "; expected: " + std::to_string(count) +
              ", as many as scene.rigid_start, or none");
  bool const fresh = s.bodies.empty();
  std::vector<RigidBody> const &bodies = fresh ? scene.rigid_start : s.bodies;
  for (int m = 0; m < num_materials; ++m)
  {
    int const body = laws[m].rigid_body;
    std::string const entry = "scene.materials(" + std::to_string(m) + ").rigid_body is " + std::to_string(body);
    require(body < count, entry + "; expected: less than " + std::to_string(count) +
                              ", the number of bodies in scene.rigid_start, or -1");
    if (body >= 0)
      require(bodies[body].material == m,
              entry + ", whose material is " + std::to_string(bodies[body].material) + "; expected: the same");
  }
  for (int b = 0; b < count; ++b)
  {
    RigidBody const &body = bodies[b];
    std::string const path = (fresh ? "scene.rigid_start[" : "state.bodies[") + std::to_string(b) + "].";
    require(body.material >= 0 && body.material < num_materials && laws[body.material].rigid_body == b,
            path + "material is " + std::to_string(body.material) + "; expected: a material whose rigid_body is " +
                std::to_string(b));
    for (int d = 0; d < 2; ++d)
    {
      requireFinite(path + "centre", body.centre[d]);
      requireFinite(path + "velocity", body.velocity[d]);
    }
    requireFinite(path + "angle", body.angle);
    requireFinite(path + "angular_velocity", body.angular_velocity);
    if (body.motion != RigidMotion::Free)
      continue;
    requirePositive(path + "mass", body.mass);
    if (!body.axial)
      requirePositive(path + "inertia", body.inertia);
  }
}

void checkBoundaries(Scene const &scene, std::vector<Material> const &laws)
{
  checkBoundaryNumbers(scene);
  auto const boundary = hostCopy(scene.boundary.boundary);
  int const count = static_cast<int>(boundary.extent(0));
  bool const lagrangian = scene.kinematics == Kinematics::Lagrangian;
  for (int b = 0; b < count; ++b)
  {
    Boundary const &side = boundary(b);
    std::string const path = "scene.boundary.boundary(" + std::to_string(b) + ").";
    if (side.kind == BoundaryKind::ContactWall)
    {
      requireNotNegative(path + "friction", side.friction);
      requireRestitution(path + "restitution", side.restitution);
    }
    if (side.kind != BoundaryKind::Inflow && side.kind != BoundaryKind::Prescribed)
      continue;
    requireFinite(path + "velocity", side.velocity[0]);
    requireFinite(path + "velocity", side.velocity[1]);
    require(side.kind != BoundaryKind::Prescribed || lagrangian,
            path + "kind is Prescribed; expected: another one, or lagrangian kinematics");
    if (side.kind == BoundaryKind::Prescribed)
      continue;
    require(!lagrangian, path + "kind is Inflow; lagrangian kinematics has none, its mesh moves along");
    require(side.material >= 0 && side.material < static_cast<int>(laws.size()) && laws[side.material].rigid_body < 0,
            path + "material is " + std::to_string(side.material) + "; expected: one that deforms, of the " +
                std::to_string(laws.size()) + " in scene.materials");
    requirePositive(path + "specific_volume", side.specific_volume);
    requireFinite(path + "internal_energy", side.internal_energy);
  }
}

void checkScene(Scene const &scene, CycleState const &state)
{
  require(scene.exchange != nullptr, "scene.exchange is not set; a host code on one rank gives a Harmos::Exchange");
  Exchange const &exchange = *scene.exchange;
  checkTogether(exchange,
                [&]
                {
                  auto const materials = hostCopy(scene.materials);
                  std::vector<Material> const laws(materials.data(), materials.data() + materials.extent(0));
                  checkSizes(scene);
                  checkHalo(scene);
                  checkOptions(scene);
                  checkMaterials(laws);
                  checkBodies(scene, state, laws);
                  checkInteractions(scene);
                  checkBoundaries(scene, laws);
                });
  if (exchange.size() > 1)
  {
    HaloCells const halo = exchange.haloCells(scene.mesh.halo);
    checkTogether(exchange, [&] { checkOwners(scene, halo.received); });
    std::string const why = whyNotShared(scene);
    require(why.empty(), "the mesh has " + why);
  }
  checkTogether(exchange, [&] { checkState(scene, state); });
}

} // namespace Harmos
