// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SIDE_MOTION_HPP
#define HARMOS_SIDE_MOTION_HPP

#include <Harmos_ContactRows.hpp>

namespace Harmos
{

/// The motion of what a segment bounds, at v^{n-1/2}.
struct SideMotion
{
  int body;                    // BodyTable::of
  Quadrilateral cell;          // of a deformable one; of others nothing is set
  Vector2 velocity[4];         // of its corners
  RigidBody const *rigid_body; // of a rigid one

  /// Velocity at a point [m/s]: of a rigid body, zero of a wall, else sum_k N_k v_k.
  KOKKOS_INLINE_FUNCTION Vector2 at(Vector2 const &point) const
  {
    if (body >= 0)
      return rigid_body->velocityAt(point);
    Vector2 v{0.0, 0.0};
    if (body == -2)
      return v;
    double weight[4];
    shapeFunctionsAt(cell, point, weight);
    for (int k = 0; k < 4; ++k)
      v += weight[k] * velocity[k];
    return v;
  }
};

/// The motion of what segment s bounds. \param before v^{n-1/2}; the bodies of the result are its.
KOKKOS_INLINE_FUNCTION SideMotion sideMotion(Mesh const &mesh, CellMaterialPairs const &pairs, Motion const &before,
                                             InterfaceSegment const &s)
{
  SideMotion motion;
  motion.body = before.bodies.of(s.material);
  motion.rigid_body = motion.body >= 0 ? &before.bodies.body(motion.body) : nullptr;
  if (motion.body != -1)
    return motion;
  motion.cell = cellQuadrilateral(mesh, s.cell);
  for (int k = 0; k < 4; ++k)
  {
    int const dof = pairs.dof_node(s.pair, k);
    motion.velocity[k] = {before.velocity(dof, 0), before.velocity(dof, 1)};
  }
  return motion;
}

/// What a step may close of the gap g below a corner: the way w dt that the sides come by themselves, and a part of g,
///
///   min(g, max(w dt, 0) + a g),  a = 1/10 below 0.005 cells, 1 from 0.01 cells on, linear between.
///
/// A corner that is pressed, drawn anew by moments, comes to lie up to 0.005 cells above its face. Free to close all of
/// that at once, it is driven there by all of its stress, at g / dt, and stopped in the next step: a twentieth of a
/// square's energy each time. What flies freely goes by what it comes, and is not held.
/// \param way w dt [m].
KOKKOS_INLINE_FUNCTION double closedInStep(double gap, double way, double cell_size)
{
  constexpr double small = 0.005, least = 0.1;
  double const part = Math::clamp(least + (1.0 - least) * (gap / (small * cell_size) - 1.0), least, 1.0);
  return Math::min(gap, Math::max(way, 0.0) + part * gap);
}

/// Speed at which a point of side a approaches the point of side b that lies `gap` away along a's normal.
KOKKOS_INLINE_FUNCTION double closingSpeed(SideMotion const &a, SideMotion const &b, Vector2 const &normal,
                                           Vector2 const &point, double gap)
{
  return dot(normal, a.at(point) - b.at(point + gap * normal));
}

/// Bound of the speed at which a point of one side approaches the other along a normal, for deformable sides and points
/// within 1.5 cells of their cells: the absolute values of shape functions add to at most 16 there.
KOKKOS_INLINE_FUNCTION double mostClosing(SideMotion const &a, SideMotion const &b, Vector2 const &normal)
{
  constexpr double beyond = 8.0; // half of the sum
  if (a.body != -1 || b.body != -1)
    return 1e300;
  double mean = 0.0, range = 0.0;
  for (int side = 0; side < 2; ++side)
  {
    double low = 1e300, high = -1e300;
    for (Vector2 const &v : (side == 0 ? a : b).velocity)
    {
      double const along = dot(normal, v);
      low = Math::min(low, along);
      high = Math::max(high, along);
    }
    mean += (side == 0 ? 0.5 : -0.5) * (low + high);
    range += high - low;
  }
  return mean + beyond * range;
}

} // namespace Harmos

#endif
