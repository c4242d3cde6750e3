// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BoundaryConditions.hpp>

#include <stdexcept>
#include <string>

namespace Harmos
{

namespace
{

constexpr double corner_cosine = 0.70710678118654752; // cos 45 degrees

/// Gathers the condition of one node from the boundary faces around it, face by face.
///
/// What fixes the velocity goes before what fixes its normal part, and `Fixed` before `Inflow`: a node where an
/// inflow meets a wall at rest is at rest. Normals are gathered in up to two directions, 45 degrees apart or more.
struct ConditionGather
{
  bool fixed = false;
  bool inflow = false;
  Vector2 velocity = {0.0, 0.0}; // of both
  int directions = 0;
  Vector2 sum[2] = {{0.0, 0.0}, {0.0, 0.0}}; // of the faces' normals times their lengths
  double flux[2] = {0.0, 0.0};               // of their normal velocities times their lengths

  /// \param normal Of the face's length.
  KOKKOS_INLINE_FUNCTION void addNormal(Vector2 const &normal, double value)
  {
    double const length = norm(normal);
    int place = 0;
    while (place < directions && dot(sum[place], normal) <= corner_cosine * norm(sum[place]) * length)
      ++place;
    if (place == 2)
      return;
    directions = Math::max(directions, place + 1);
    sum[place] += normal;
    flux[place] += value * length;
  }

  KOKKOS_INLINE_FUNCTION void add(Boundary const &boundary, Vector2 const &normal)
  {
    switch (boundary.kind)
    {
    case BoundaryKind::Fixed:
      fixed = true;
      break;
    case BoundaryKind::Inflow:
      if (inflow)
        break;
      inflow = true;
      velocity = boundary.velocity;
      break;
    case BoundaryKind::SlipWall:
      addNormal(normal, 0.0);
      break;
    case BoundaryKind::Prescribed:
      addNormal(normal, dot(boundary.velocity, normalised(normal)));
      break;
    case BoundaryKind::ContactWall:
    case BoundaryKind::Outflow:
      break;
    }
  }

  KOKKOS_INLINE_FUNCTION NodeCondition condition() const
  {
    NodeCondition result;
    if (fixed || inflow)
    {
      result.count = 2;
      result.value[0] = fixed ? 0.0 : velocity[0];
      result.value[1] = fixed ? 0.0 : velocity[1];
      return result;
    }
    result.count = directions;
    for (int i = 0; i < directions; ++i)
    {
      double const length = norm(sum[i]);
      // divided, so that a normal along an axis is exactly that: a wall's node must not leave it by round-off
      result.normal[i] = Vector2{sum[i][0] / length, sum[i][1] / length};
      result.value[i] = flux[i] / length;
    }
    return result;
  }
};

KOKKOS_INLINE_FUNCTION NodeCondition nodeCondition(Mesh const &mesh, View<Boundary *> const &boundary, int node)
{
  ConditionGather gather;
  for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
  {
    int const cell = mesh.node_cell.item(i) / 4;
    int const corner = mesh.node_cell.item(i) % 4;
    int const faces[2] = {corner, (corner + 3) % 4};
    for (int const face : faces)
    {
      int const number = mesh.face_boundary(cell, face);
      if (number < 0)
        continue;
      Quadrilateral const q = cellQuadrilateral(mesh, cell);
      Vector2 const along = q[(face + 1) % 4] - q[face];
      gather.add(boundary(number), -perpendicular(along));
    }
  }
  return gather.condition();
}

int largestBoundaryNumber(Mesh const &mesh)
{
  auto const face_boundary = mesh.face_boundary;
  int largest = -1;
  Kokkos::parallel_reduce(
      "Harmos::mesh::largestBoundaryNumber", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &max) {
        for (int k = 0; k < 4; ++k)
          max = Math::max(max, face_boundary(cell, k));
      },
      Kokkos::Max<int>(largest));
  return mesh.num_cells > 0 ? largest : -1;
}

} // namespace

BoundaryConditions buildBoundaryConditions(Mesh const &mesh, View<Boundary *> const &boundary)
{
  int const largest = largestBoundaryNumber(mesh);
  if (largest >= static_cast<int>(boundary.extent(0)))
    throw std::runtime_error("boundary conditions: the mesh has boundary " + std::to_string(largest) + ", only " +
                             std::to_string(boundary.extent(0)) + " are given");
  Mesh const m = mesh;
  BoundaryConditions result;
  result.boundary = boundary;
  result.node_index = View<int *>("Harmos::mesh::condition_index", mesh.num_nodes);
  auto const node_index = result.node_index;
  int total = 0;
  Kokkos::parallel_scan(
      "Harmos::mesh::countNodeConditions", RangePolicy(0, mesh.num_nodes),
      KOKKOS_LAMBDA(int node, int &sum, bool final) {
        int const has = nodeCondition(m, boundary, node).count > 0 ? 1 : 0;
        if (final)
          node_index(node) = has == 1 ? sum : -1;
        sum += has;
      },
      total);
  result.condition = View<NodeCondition *>("Harmos::mesh::node_condition", total);
  auto const condition = result.condition;
  Kokkos::parallel_for(
      "Harmos::mesh::fillNodeConditions", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        if (node_index(node) >= 0)
          condition(node_index(node)) = nodeCondition(m, boundary, node);
      });
  return result;
}

} // namespace Harmos
