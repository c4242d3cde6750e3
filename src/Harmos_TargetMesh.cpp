// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_TargetMesh.hpp"

#include <Harmos_MeshBuilder.hpp>
#include <Harmos_StateExchange.hpp>

namespace Harmos
{

double largestElongation(Mesh const &mesh)
{
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::largestElongation", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, double &most) {
        if (mesh.cell_depth(cell) == 0)
          most = Math::max(most, elongation(cellQuadrilateral(mesh, cell)));
      },
      Kokkos::Max<double>(largest));
  return largest;
}

bool contactCanArise(Kinematics kinematics, std::size_t num_materials, std::vector<Boundary> const &boundary)
{
  for (Boundary const &b : boundary)
    if (b.kind == BoundaryKind::ContactWall)
      return true;
  return kinematics != Kinematics::Single && num_materials > 1;
}

std::string whyNotShared(Scene const &scene)
{
  if (scene.exchange->size() == 1 || scene.prescribed.kind != FieldKind::None)
    return "";
  auto const device = scene.boundary.boundary;
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), device);
  std::vector<Boundary> const boundary(host.data(), host.data() + host.extent(0));
  if (!contactCanArise(scene.kinematics, scene.materials.extent(0), boundary) ||
      !(scene.exchange->max(largestElongation(scene.mesh)) > largest_shared_aspect))
    return "";
  return "cells of an aspect ratio above 4, across which contact reaches on one rank only";
}

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
    throw TargetMeshError("the target mesh has cells that are not strictly convex");
  if (std::string const why = whyNotShared(scene); !why.empty())
    throw TargetMeshError("the target mesh has " + why);
  computeNodeAltitudes(mesh, s.work);
  s.rigid_rows = {}; // they belong to the cells
  return start;
}

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

void checkTarget(Scene const &scene)
{
  if (!scene.target_mesh)
    return;
  if (scene.kinematics == Kinematics::Lagrangian)
    throw std::runtime_error("a target mesh means nothing in lagrangian kinematics: the mesh is the material's");
  if (scene.prescribed.kind != FieldKind::None)
    throw std::runtime_error("a target mesh means nothing with a prescribed field, which keeps the cells' volumes");
}

} // namespace Harmos
