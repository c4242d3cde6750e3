// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshSmoother.hpp>

namespace Harmos
{

namespace
{

/// What a node condition, and boundaries that nodes do not slide along, leave of a displacement.
struct Sliding
{
  Mesh mesh;
  BoundaryConditions conditions;

  KOKKOS_INLINE_FUNCTION bool stays(int node) const
  {
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const cell = mesh.node_cell.item(i) / 4, corner = mesh.node_cell.item(i) % 4;
      for (int face : {corner, (corner + 3) % 4})
      {
        int const number = mesh.face_boundary(cell, face);
        if (number >= 0 && conditions.boundary(number).kind != BoundaryKind::SlipWall)
          return true;
      }
    }
    return false;
  }

  KOKKOS_INLINE_FUNCTION Vector2 operator()(int node, Vector2 const &displacement) const
  {
    if (stays(node))
      return {0.0, 0.0};
    int const condition = conditions.node_index(node);
    return condition < 0 ? displacement : conditions.condition(condition).project(displacement);
  }
};

} // namespace

void smoothNodes(Mesh const &mesh, BoundaryConditions const &conditions, MeshSmoother const &smoother,
                 View<double *[2]> const &motion, View<double *[2]> const &target)
{
  Sliding const sliding{mesh, conditions};
  double const follow = smoother.follow, relax = smoother.relax;
  View<double *[2]> const moved("Harmos::mesh::moved", mesh.num_nodes);
  Kokkos::parallel_for(
      "Harmos::mesh::followMaterial", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        Vector2 const u = sliding(node, {follow * motion(node, 0), follow * motion(node, 1)});
        for (int d = 0; d < 2; ++d)
          moved(node, d) = mesh.node_position(node, d) + u[d];
      });
  Kokkos::parallel_for(
      "Harmos::mesh::smoothNodes", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        int const first = mesh.node_cell.offset(node), end = mesh.node_cell.offset(node + 1);
        Vector2 const x{moved(node, 0), moved(node, 1)};
        Vector2 sum{0.0, 0.0};
        for (int i = first; i < end; ++i)
        {
          int const cell = mesh.node_cell.item(i) / 4, corner = mesh.node_cell.item(i) % 4;
          int const before = mesh.cell_node(cell, (corner + 3) % 4), after = mesh.cell_node(cell, (corner + 1) % 4);
          sum += Vector2{moved(before, 0) + moved(after, 0), moved(before, 1) + moved(after, 1)};
        }
        Vector2 const mean = (0.5 / (end - first)) * sum;
        Vector2 const y = x + sliding(node, relax * (mean - x));
        target(node, 0) = y[0];
        target(node, 1) = y[1];
      });
}

} // namespace Harmos
