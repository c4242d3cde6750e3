// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BODY_TABLE_HPP
#define HARMOS_BODY_TABLE_HPP

#include <Harmos_RigidBody.hpp>
#include <Harmos_RigidSurfaces.hpp>

#include <vector>

namespace Harmos
{

/// Rigid bodies as the kernels see them.
struct BodyTable
{
  View<int *> of_material; // materials: number of the body, -1: deformable
  View<RigidBody *> body;
  bool outlined = false;       // contact between rigid bodies, and with walls, has its rows from their outlines
  RigidSurfaces surfaces = {}; // at the present pose; none where the outlines are not known

  /// Number of the body of a material; -1: deformable, -2: a wall (material -1).
  KOKKOS_INLINE_FUNCTION int of(int material) const { return material < 0 ? -2 : of_material(material); }

  /// Fixed and prescribed bodies, and walls: what no impulse moves.
  KOKKOS_INLINE_FUNCTION bool driven(int number) const
  {
    return number == -2 || (number >= 0 && body(number).motion != RigidMotion::Free);
  }
};

/// Throws std::runtime_error where the material of a body is not below num_materials.
BodyTable buildBodyTable(std::vector<RigidBody> const &bodies, int num_materials, WorkArrays const &work = {});

/// The table of the same bodies with other velocities; no contact of theirs comes from outlines.
BodyTable withBodies(BodyTable const &table, std::vector<RigidBody> const &bodies, WorkArrays const &work = {});

} // namespace Harmos

#endif
