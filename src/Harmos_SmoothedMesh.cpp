// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_SmoothedMesh.hpp"

#include <Harmos_MeshBuilder.hpp>

namespace Harmos
{
namespace
{

constexpr int most_halvings = 4;
constexpr double largest_part_of_altitude = 0.9, largest_part_of_cell = 0.95;

/// dt times the mean velocity of the materials at each node. [length]
View<double *[2]> materialMotion(Mesh const &mesh, CycleState const &s, double dt)
{
  View<double *[2]> const motion("Harmos::materialMotion", mesh.num_nodes);
  auto const dof_nodes = s.dof_nodes;
  auto const mass = s.work.dof_mass;
  auto const half = s.work.half;
  Kokkos::parallel_for(
      "Harmos::materialMotion", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        double sum = 0.0;
        Vector2 momentum{0.0, 0.0};
        for (int dof = dof_nodes.offset(node); dof < dof_nodes.offset(node + 1); ++dof)
        {
          sum += mass(dof);
          momentum += mass(dof) * Vector2{half(dof, 0), half(dof, 1)};
        }
        for (int d = 0; d < 2; ++d)
          motion(node, d) = sum > 0.0 ? dt * momentum[d] / sum : 0.0;
      });
  return motion;
}

/// Whether the remap can go from the mesh to another one (smoothedMesh), on this rank.
bool reachable(Mesh const &mesh, CycleState const &s, double dt, View<double *[2]> const &target)
{
  Mesh next = mesh;
  next.node_position = target;
  separateGeometry(next);
  updateGeometry(next);
  int strayed = 0;
  LagrangeWork altitudes;
  computeNodeAltitudes(next, altitudes);
  auto const altitude = altitudes.node_altitude;
  auto const dof_nodes = s.dof_nodes;
  auto const half = s.work.half;
  auto const position = mesh.node_position;
  Kokkos::parallel_reduce(
      "Harmos::strayed", RangePolicy(0, dof_nodes.num_dof_nodes),
      KOKKOS_LAMBDA(int dof, int &count) {
        int const node = dof_nodes.node(dof);
        if (mesh.node_depth(node) != 0)
          return;
        Vector2 const way{position(node, 0) + dt * half(dof, 0) - target(node, 0),
                          position(node, 1) + dt * half(dof, 1) - target(node, 1)};
        count += norm(way) <= largest_part_of_altitude * altitude(node) ? 0 : 1;
      },
      strayed);
  return strayed == 0 && countInvertedCells(next) == 0 &&
         largestSweptPart(next, s.pairs, half, dt, position) <= largest_part_of_cell;
}

} // namespace

TargetMesh smoothedMesh(MeshSmoother const &smoother, BoundaryConditions const &boundary, Exchange const &exchange)
{
  Exchange const *const ranks = &exchange;
  return [smoother, boundary, ranks](Mesh const &mesh, CycleState const &s, double dt, View<double *[2]> const &target)
  {
    auto const position = mesh.node_position;
    smoothNodes(mesh, boundary, smoother, materialMotion(mesh, s, dt), target);
    for (int halvings = 0;; ++halvings)
    {
      bool const rests = halvings > most_halvings;
      if (rests)
        Kokkos::deep_copy(target, position);
      if (rests || ranks->max(reachable(mesh, s, dt, target) ? 0.0 : 1.0) == 0.0)
        return;
      Kokkos::parallel_for(
          "Harmos::halveMeshStep", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
            for (int d = 0; d < 2; ++d)
              target(node, d) = 0.5 * (position(node, d) + target(node, d));
          });
    }
  };
}

} // namespace Harmos
