// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_VECTOR_HPP
#define HARMOS_VECTOR_HPP

#include <Harmos_Kokkos.hpp>

namespace Harmos
{

/// A point or a vector in Dim dimensions.
template <int Dim>
struct Vector
{
  double x[Dim];

  KOKKOS_INLINE_FUNCTION double &operator[](int d) { return x[d]; }
  KOKKOS_INLINE_FUNCTION double const &operator[](int d) const { return x[d]; }

  KOKKOS_INLINE_FUNCTION Vector &operator+=(Vector const &b)
  {
    for (int d = 0; d < Dim; ++d)
      x[d] += b.x[d];
    return *this;
  }
  KOKKOS_INLINE_FUNCTION Vector &operator-=(Vector const &b)
  {
    for (int d = 0; d < Dim; ++d)
      x[d] -= b.x[d];
    return *this;
  }
  KOKKOS_INLINE_FUNCTION Vector &operator*=(double s)
  {
    for (int d = 0; d < Dim; ++d)
      x[d] *= s;
    return *this;
  }
};

using Vector2 = Vector<2>;

template <int Dim>
KOKKOS_INLINE_FUNCTION Vector<Dim> operator+(Vector<Dim> a, Vector<Dim> const &b)
{
  return a += b;
}
template <int Dim>
KOKKOS_INLINE_FUNCTION Vector<Dim> operator-(Vector<Dim> a, Vector<Dim> const &b)
{
  return a -= b;
}
template <int Dim>
KOKKOS_INLINE_FUNCTION Vector<Dim> operator-(Vector<Dim> a)
{
  return a *= -1.0;
}
template <int Dim>
KOKKOS_INLINE_FUNCTION Vector<Dim> operator*(double s, Vector<Dim> a)
{
  return a *= s;
}

template <int Dim>
KOKKOS_INLINE_FUNCTION double dot(Vector<Dim> const &a, Vector<Dim> const &b)
{
  double s = a[0] * b[0];
  for (int d = 1; d < Dim; ++d)
    s += a[d] * b[d];
  return s;
}

/// z component of a x b.
KOKKOS_INLINE_FUNCTION double cross(Vector2 const &a, Vector2 const &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/// a turned by +90 degrees.
KOKKOS_INLINE_FUNCTION Vector2 perpendicular(Vector2 const &a)
{
  return {-a[1], a[0]};
}

template <int Dim>
KOKKOS_INLINE_FUNCTION double norm(Vector<Dim> const &a)
{
  return Math::sqrt(dot(a, a));
}

/// a / |a|, or zero where |a| = 0.
template <int Dim>
KOKKOS_INLINE_FUNCTION Vector<Dim> normalised(Vector<Dim> const &a)
{
  double const length = norm(a);
  return length > 0.0 ? (1.0 / length) * a : a;
}

/// A line (plane in 3-D): inside is dot(normal, x) <= offset, and the normal leaves the material.
template <int Dim>
struct Plane
{
  Vector<Dim> normal;
  double offset;

  /// Signed distance of x, negative inside (for a unit normal).
  KOKKOS_INLINE_FUNCTION double distance(Vector<Dim> const &point) const { return dot(normal, point) - offset; }
};

using Plane2 = Plane<2>;

} // namespace Harmos

#endif
