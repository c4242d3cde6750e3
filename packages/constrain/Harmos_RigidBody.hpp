// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RIGID_BODY_HPP
#define HARMOS_RIGID_BODY_HPP

#include <Harmos_Vector.hpp>

#include <vector>

namespace Harmos
{

enum class RigidMotion : int
{
  Fixed,      // does not move
  Prescribed, // constant velocity and angular velocity
  Free        // follows from impulse and torque
};

/// A rigid body: a material whose velocity field is V + omega x (x - X).
struct RigidBody
{
  int material = -1;
  RigidMotion motion = RigidMotion::Fixed;
  bool axial = false;   // moves along y alone: rings about an axis (startCycle sets it by the mesh's geometry)
  double mass = 0.0;    // [kg/m], or per radian [kg]
  double inertia = 0.0; // about the centre of mass, per depth [kg m]
  Vector2 centre = {0.0, 0.0};
  double angle = 0.0; // [rad], of the outline against its body frame
  Vector2 velocity = {0.0, 0.0};
  double angular_velocity = 0.0;

  KOKKOS_INLINE_FUNCTION Vector2 velocityAt(Vector2 const &x) const
  {
    return velocity + angular_velocity * perpendicular(x - centre);
  }
  KOKKOS_INLINE_FUNCTION double inverseMass() const { return motion == RigidMotion::Free ? 1.0 / mass : 0.0; }
  KOKKOS_INLINE_FUNCTION double inverseInertia() const
  {
    return motion == RigidMotion::Free && !axial ? 1.0 / inertia : 0.0;
  }
};

} // namespace Harmos

#endif
