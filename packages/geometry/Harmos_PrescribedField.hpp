// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PRESCRIBED_FIELD_HPP
#define HARMOS_PRESCRIBED_FIELD_HPP

#include <Harmos_Vector.hpp>

namespace Harmos
{

enum class FieldKind : int
{
  None = 0,
  Translation,
  Rotation,
  Vortex,
  Deformation
};

/// A divergence-free velocity field of position and time: v(x, t) = cos(pi t / period) v(x), or v(x) where period = 0.
///
///   translation: v = velocity
///   rotation:    v = angular_velocity z x (x - centre)
///   vortex:      v = (-d psi/dy, d psi/dx), psi = (speed L / pi) sin^2(pi a) sin^2(pi b), zero on the box's sides
///   deformation: psi = -(speed L / (4 pi)) sin(4 pi a) cos(4 pi b): sixteen vortices of alternating sense
/// with (a, b) = (x - corner) / L. A field with a period runs back: at t = period all is where it began.
///
/// Rider & Kothe, J. Comput. Phys. 141 (1998) 112-152; Smolarkiewicz, Mon. Weather Rev. 110 (1982) 1968-1983.
struct PrescribedField
{
  FieldKind kind = FieldKind::None;
  double period = 0.0;           // [s]; 0: steady
  Vector2 velocity = {0.0, 0.0}; // translation [m/s]
  Vector2 centre = {0.0, 0.0};   // rotation [m]
  double angular_velocity = 0.0; // rotation [rad/s]
  double speed = 1.0;            // vortex, deformation: the largest one [m/s]
  Vector2 corner = {0.0, 0.0};   // vortex, deformation: lower left corner of the square box [m]
  double length = 1.0;           // vortex, deformation: L, side of the box [m]

  KOKKOS_INLINE_FUNCTION double timeFactor(double t) const
  {
    return period > 0.0 ? Math::cos(Math::pi * t / period) : 1.0;
  }

  /// Integral of timeFactor from 0 to t. [s]
  KOKKOS_INLINE_FUNCTION double elapsed(double t) const
  {
    return period > 0.0 ? period / Math::pi * Math::sin(Math::pi * t / period) : t;
  }

  KOKKOS_INLINE_FUNCTION Vector2 velocityAt(Vector2 const &x, double t) const
  {
    double const factor = timeFactor(t);
    if (kind == FieldKind::Translation)
      return factor * velocity;
    if (kind == FieldKind::Rotation)
      return (factor * angular_velocity) * perpendicular(x - centre);
    double const frequency = kind == FieldKind::Vortex ? Math::pi : 4.0 * Math::pi;
    double const a = frequency * (x[0] - corner[0]) / length, b = frequency * (x[1] - corner[1]) / length;
    double const sa = Math::sin(a), ca = Math::cos(a), sb = Math::sin(b), cb = Math::cos(b);
    double const s = factor * speed;
    if (kind == FieldKind::Vortex)
      return {-2.0 * s * sa * sa * sb * cb, 2.0 * s * sa * ca * sb * sb};
    if (kind == FieldKind::Deformation)
      return {-s * sa * sb, -s * ca * cb};
    return {0.0, 0.0};
  }

  /// Where a point moves from t to t + dt, less where it was: Runge and Kutta's fourth-order step.
  KOKKOS_INLINE_FUNCTION Vector2 displacement(Vector2 const &x, double t, double dt) const
  {
    Vector2 const k1 = velocityAt(x, t);
    Vector2 const k2 = velocityAt(x + (0.5 * dt) * k1, t + 0.5 * dt);
    Vector2 const k3 = velocityAt(x + (0.5 * dt) * k2, t + 0.5 * dt);
    Vector2 const k4 = velocityAt(x + dt * k3, t + dt);
    return (dt / 6.0) * ((k1 + k4) + 2.0 * (k2 + k3));
  }

  /// Bound of |v| within a box, at all times.
  KOKKOS_INLINE_FUNCTION double largestSpeed(Vector2 const &low, Vector2 const &high) const
  {
    if (kind == FieldKind::Translation)
      return norm(velocity);
    if (kind == FieldKind::Vortex || kind == FieldKind::Deformation)
      return Math::fabs(speed);
    if (kind == FieldKind::None)
      return 0.0;
    Vector2 const arm{Math::max(Math::fabs(low[0] - centre[0]), Math::fabs(high[0] - centre[0])),
                      Math::max(Math::fabs(low[1] - centre[1]), Math::fabs(high[1] - centre[1]))};
    return Math::fabs(angular_velocity) * norm(arm);
  }
};

/// Where a rigid shape is that a translation or a rotation has carried from 0 to t; where all is back (a period has
/// passed), for the other fields too.
struct CarriedPose
{
  bool known;           // false: the field deforms shapes, and they are not back
  Vector2 displacement; // of the shape's centroid [m]
  double angle;         // about its centroid [rad]
};

KOKKOS_INLINE_FUNCTION CarriedPose carriedPose(PrescribedField const &field, Vector2 const &centroid, double t)
{
  double const elapsed = field.elapsed(t);
  if (field.kind == FieldKind::Translation)
    return {true, elapsed * field.velocity, 0.0};
  if (field.kind == FieldKind::Rotation)
  {
    double const angle = elapsed * field.angular_velocity;
    Vector2 const arm = centroid - field.centre;
    return {true, (Math::cos(angle) - 1.0) * arm + Math::sin(angle) * perpendicular(arm), angle};
  }
  return {field.period > 0.0 && Math::fabs(elapsed) < 1e-12 * field.period, {0.0, 0.0}, 0.0};
}

} // namespace Harmos

#endif
