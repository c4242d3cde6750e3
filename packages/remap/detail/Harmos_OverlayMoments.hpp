// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_OVERLAY_MOMENTS_HPP
#define HARMOS_OVERLAY_MOMENTS_HPP

#include <Harmos_ClipPacks.hpp>
#include <Harmos_Mesh.hpp>
#include <Harmos_Moments.hpp>

namespace Harmos
{
namespace RemapDetail
{

KOKKOS_INLINE_FUNCTION Vector2 acceptorOrigin(Mesh const &mesh, int cell)
{
  int const node = mesh.cell_node(cell, 0);
  return {mesh.node_position(node, 0), mesh.node_position(node, 1)};
}

/// Integrals of the monomials up to degree 4 or 5: degree n, power k of y at n (n + 1) / 2 + k.
template <int Degree>
struct HighMoments
{
  static_assert(Degree == 4 || Degree == 5, "more than Moments have, no more than momentsOfVertices finds");
  static constexpr int count = (Degree + 1) * (Degree + 2) / 2;
  double value[count] = {};

  KOKKOS_INLINE_FUNCTION double volume() const { return value[0]; }
  KOKKOS_INLINE_FUNCTION double first(int d) const { return value[1 + d]; }
};

using QuarticMoments = HighMoments<4>;
using QuinticMoments = HighMoments<5>;

/// Moments of what has `measure` times the area.
template <class M>
KOKKOS_INLINE_FUNCTION M measuredBy(double measure, M m)
{
  for (double &value : m.value)
    value *= measure;
  return m;
}

/// Moments weighted by the radius, about an origin at `radius`, from plane ones about it: the weight is linear.
KOKKOS_INLINE_FUNCTION QuarticMoments ringMoments(QuinticMoments const &plane, double radius)
{
  QuarticMoments m;
  for (int n = 0; n < 5; ++n)
    for (int k = 0; k <= n; ++k)
      m.value[n * (n + 1) / 2 + k] = radius * plane.value[n * (n + 1) / 2 + k] + plane.value[(n + 1) * (n + 2) / 2 + k];
  return m;
}

/// An edge a -> b and the origin span a triangle, over which a monomial of degree n has the integral
/// (a x b) / (n + 2) times its mean along the edge: three Gauss points are exact up to degree 5.
template <int Degree>
KOKKOS_INLINE_FUNCTION HighMoments<Degree> highMoments(int size, double const *x, double const *y)
{
  double const point[3] = {0.5 - 0.5 * 0.7745966692414834, 0.5, 0.5 + 0.5 * 0.7745966692414834};
  double const weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  HighMoments<Degree> m;
  double ax = x[size - 1], ay = y[size - 1];
  for (int i = 0; i < size; ++i)
  {
    double const bx = x[i], by = y[i];
    double const c = ax * by - ay * bx;
    for (int g = 0; g < 3; ++g)
    {
      double const px = ax + point[g] * (bx - ax), py = ay + point[g] * (by - ay);
      double const w = c * weight[g];
      double const px2 = px * px;
      double const power_x[6] = {1.0, px, px2, px2 * px, px2 * px2, px2 * px2 * px};
      double power_y = w;
      for (int k = 0; k <= Degree; ++k)
      {
        for (int n = k; n <= Degree; ++n)
          m.value[n * (n + 1) / 2 + k] += power_x[n - k] * power_y;
        power_y *= py;
      }
    }
    ax = bx;
    ay = by;
  }
  for (int n = 0; n <= Degree; ++n)
    for (int k = 0; k <= n; ++k)
      m.value[n * (n + 1) / 2 + k] *= 1.0 / (n + 2);
  return m;
}

/// Moments of a simple polygon about the origin, vertices in two arrays.
template <class M>
KOKKOS_INLINE_FUNCTION M momentsOfVertices(int size, double const *x, double const *y);

template <>
KOKKOS_INLINE_FUNCTION QuarticMoments momentsOfVertices<QuarticMoments>(int size, double const *x, double const *y)
{
  return highMoments<4>(size, x, y);
}

template <>
KOKKOS_INLINE_FUNCTION QuinticMoments momentsOfVertices<QuinticMoments>(int size, double const *x, double const *y)
{
  return highMoments<5>(size, x, y);
}

/// Harmos::moments for vertices in two arrays.
template <>
KOKKOS_INLINE_FUNCTION Moments<2> momentsOfVertices<Moments<2>>(int size, double const *x, double const *y)
{
  Moments<2> m;
  double ax = x[size - 1], ay = y[size - 1];
  for (int i = 0; i < size; ++i)
  {
    double const bx = x[i], by = y[i];
    double const c = ax * by - ay * bx;
    m.value[0] += c;
    m.value[1] += c * (ax + bx);
    m.value[2] += c * (ay + by);
    m.value[3] += c * (ax * ax + bx * bx + ax * bx);
    m.value[4] += c * (ax * ay + bx * by + 0.5 * (ax * by + bx * ay));
    m.value[5] += c * (ay * ay + by * by + ay * by);
    ax = bx;
    ay = by;
  }
  m.value[0] *= 0.5;
  for (int i = 1; i < Moments<2>::count; ++i)
    m.value[i] *= i < 3 ? 1.0 / 6.0 : 1.0 / 12.0;
  return m;
}

template <>
KOKKOS_INLINE_FUNCTION Moments<3> momentsOfVertices<Moments<3>>(int size, double const *x, double const *y)
{
  Moments<2> const lower = momentsOfVertices<Moments<2>>(size, x, y);
  Moments<3> m;
  for (int i = 0; i < Moments<2>::count; ++i)
    m.value[i] = lower.value[i];
  Vector2 a{x[size - 1], y[size - 1]};
  for (int i = 0; i < size; ++i)
  {
    Vector2 const b{x[i], y[i]}, middle = 0.5 * (a + b);
    double const c = cross(a, b) * (1.0 / 30.0);
    for (int k = 0; k < 4; ++k)
      m.value[6 + k] += c * (cubic(a, k) + 4.0 * cubic(middle, k) + cubic(b, k));
    a = b;
  }
  return m;
}

/// A cell's corners relative to a point. Coordinates one by one: pairs of them, written singly and read together, would
/// stall the processor.
struct Window
{
  double x[4], y[4];
};

KOKKOS_INLINE_FUNCTION Window windowAbout(Mesh const &mesh, int cell, Vector2 const &centre)
{
  Window w;
  for (int k = 0; k < 4; ++k)
  {
    int const node = mesh.cell_node(cell, k);
    w.x[k] = mesh.node_position(node, 0) - centre[0];
    w.y[k] = mesh.node_position(node, 1) - centre[1];
  }
  return w;
}

/// The corners of pack_width cells relative to a point.
KOKKOS_FORCEINLINE_FUNCTION WindowPack windowsAbout(Mesh const &mesh, int const *cell, Vector2 const &centre)
{
  WindowPack w;
  Pack const x = centre[0], y = centre[1];
  for (int k = 0; k < 4; ++k)
  {
    int node[pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
      node[lane] = mesh.cell_node(cell[lane], k);
    w.x[k] = packOf([&](int lane) { return mesh.node_position(node[lane], 0); }) - x;
    w.y[k] = packOf([&](int lane) { return mesh.node_position(node[lane], 1); }) - y;
  }
  return w;
}

/// Moments about the origin of the part of a polygon of at most Capacity vertices in a convex window, by clipping
/// (Harmos_Clip.hpp) between two buffers; `whole` tells that nothing was cut off: then they are not computed.
template <class M, int Capacity>
KOKKOS_INLINE_FUNCTION M momentsInside(int size, double const *x, double const *y, Window const &window, bool &whole)
{
  constexpr int capacity = 6 * Capacity; // a cut makes at most 3 n / 2 vertices of n, where motion has bent the region
  double buffer_x[2][capacity], buffer_y[2][capacity], distance[capacity];
  int turn = 0;
  whole = false;
  bool cut = false;
  for (int k = 0; k < 4; ++k)
  {
    double const corner_x = window.x[k], corner_y = window.y[k];
    double const nx = window.y[(k + 1) & 3] - corner_y, ny = corner_x - window.x[(k + 1) & 3];
    bool inside = true, outside = true;
    for (int i = 0; i < size; ++i)
    {
      double const d = nx * (x[i] - corner_x) + ny * (y[i] - corner_y);
      distance[i] = d;
      inside = inside && d <= 0.0;
      outside = outside && d >= 0.0;
    }
    if (inside)
      continue;
    if (outside)
      return {};
    cut = true;
    double *const next_x = buffer_x[turn], *const next_y = buffer_y[turn];
    turn ^= 1;
    // Without branches, which would be mispredicted every other time: what does not count is overwritten.
    int count = 0;
    double da = distance[size - 1], ax = x[size - 1], ay = y[size - 1];
    for (int i = 0; i < size; ++i)
    {
      double const db = distance[i], bx = x[i], by = y[i];
      bool const crosses = ((da < 0.0) & (db > 0.0)) | ((da > 0.0) & (db < 0.0));
      double const s = da / (crosses ? da - db : 1.0);
      next_x[count] = ax + s * (bx - ax);
      next_y[count] = ay + s * (by - ay);
      count += crosses ? 1 : 0;
      next_x[count] = bx;
      next_y[count] = by;
      count += db <= 0.0 ? 1 : 0;
      da = db;
      ax = bx;
      ay = by;
    }
    if (count < 3)
      return {};
    size = count;
    x = next_x;
    y = next_y;
  }
  whole = !cut;
  return cut ? momentsOfVertices<M>(size, x, y) : M{};
}

} // namespace RemapDetail
} // namespace Harmos

#endif
