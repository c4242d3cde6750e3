// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LAGRANGE_DETAIL_PATCH_HPP
#define HARMOS_LAGRANGE_DETAIL_PATCH_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_Vector.hpp>
#include <detail/Harmos_CornerGradients.hpp>

namespace Harmos
{
namespace detail
{

/// A symmetric, positive semi-definite, tridiagonal matrix.
struct Tridiagonal
{
  static constexpr int most_rows = 8;

  int size = 0;
  double diagonal[most_rows], beside_squared[most_rows]; // the latter: of a row and the one before it

  KOKKOS_INLINE_FUNCTION void push(double value, double beside)
  {
    diagonal[size] = value;
    beside_squared[size++] = beside * beside;
  }

  /// Whether all eigenvalues are below x: the pivots of x - T are positive.
  KOKKOS_INLINE_FUNCTION bool isBelow(double x) const
  {
    double pivot = 1.0;
    for (int i = 0; i < size && pivot > 0.0; ++i)
      pivot = x - diagonal[i] - (i > 0 ? beside_squared[i] / pivot : 0.0);
    return pivot > 0.0;
  }

  /// Its largest eigenvalue, to 1e-7 of the trace; 0 if it is empty.
  KOKKOS_INLINE_FUNCTION double largest() const
  {
    double low = 0.0, high = 0.0;
    for (int i = 0; i < size; ++i)
      high += diagonal[i];
    for (int turn = 0; turn < 24; ++turn)
    {
      double const middle = 0.5 * (low + high);
      (isBelow(middle) ? high : low) = middle;
    }
    return high;
  }
};

/// A pair (the first of them), those around it that share its dof nodes, two layers of those around these, and the
/// nodes that move them.
struct Patch
{
  static constexpr int most_pairs = 64, most_nodes = 72;

  int num_pairs = 0, num_nodes = 0;
  double modulus[most_pairs]; // mass times c^2 over that of the first pair; stiffer ones count as that one [mass]
  double shear[most_pairs];   // G / (rho c^2)
  CornerGradients gradient[most_pairs];
  int node_of[most_pairs][4];
  int dof[most_nodes];
  double node_mass[most_nodes];
  NodeCondition condition[most_nodes]; // values play no part

  /// Of a dof node; most_nodes: no room.
  KOKKOS_INLINE_FUNCTION int local(int d)
  {
    for (int i = 0; i < num_nodes; ++i)
      if (dof[i] == d)
        return i;
    if (num_nodes == most_nodes)
      return most_nodes;
    dof[num_nodes] = d;
    return num_nodes++;
  }

  /// a = M^-1 K u for unit c of the first pair, node conditions held: stress over rho c^2 is 1, 1 - 2 g and g times
  /// axial, lateral and shear strain. [1/length^2]
  KOKKOS_INLINE_FUNCTION void apply(Vector2 const u[most_nodes], Vector2 a[most_nodes]) const
  {
    for (int i = 0; i < num_nodes; ++i)
      a[i] = {0.0, 0.0};
    for (int c = 0; c < num_pairs; ++c)
    {
      double xx = 0.0, yy = 0.0, xy = 0.0, around = 0.0;
      for (int k = 0; k < 4; ++k)
      {
        Vector2 const &b = gradient[c].of[k], &v = u[node_of[c][k]];
        xx += b[0] * v[0];
        yy += b[1] * v[1];
        xy += b[1] * v[0] + b[0] * v[1];
        around += gradient[c].hoop[k] * v[0];
      }
      double const twice = 2.0 * shear[c], mean = (1.0 - twice) * (xx + yy + around);
      double const sxx = modulus[c] * (mean + twice * xx), syy = modulus[c] * (mean + twice * yy),
                   sxy = modulus[c] * shear[c] * xy, hoop = modulus[c] * (mean + twice * around);
      for (int k = 0; k < 4; ++k)
      {
        Vector2 const &b = gradient[c].of[k];
        a[node_of[c][k]] += Vector2{sxx * b[0] + sxy * b[1] + hoop * gradient[c].hoop[k], sxy * b[0] + syy * b[1]};
      }
    }
    for (int i = 0; i < num_nodes; ++i)
      a[i] = (1.0 / node_mass[i]) * condition[i].project(a[i]);
  }

  /// Sum of m u . v. [mass]
  KOKKOS_INLINE_FUNCTION double product(Vector2 const u[most_nodes], Vector2 const v[most_nodes]) const
  {
    double sum = 0.0;
    for (int i = 0; i < num_nodes; ++i)
      sum += node_mass[i] * dot(u[i], v[i]);
    return sum;
  }

  /// omega^2 / (4 c^2) of its largest frequency, by a Lanczos iteration (Parlett, The Symmetric Eigenvalue Problem,
  /// chapter 13) from the strain that the first pair resists most: from below.
  KOKKOS_INLINE_FUNCTION double largestSquare() const
  {
    constexpr double negligible = 1e-12;
    Tridiagonal t;
    Vector2 last[most_nodes], u[most_nodes], a[most_nodes];
    for (int i = 0; i < num_nodes; ++i)
      last[i] = u[i] = {0.0, 0.0};
    for (int k = 0; k < 4; ++k)
    {
      int const i = node_of[0][k];
      u[i] = (1.0 / node_mass[i]) * condition[i].project(gradient[0].of[k] + Vector2{gradient[0].hoop[k], 0.0});
    }
    double norm = Math::sqrt(product(u, u)), beside = 0.0, scale = 0.0;
    while (t.size < Tridiagonal::most_rows && norm > negligible * scale)
    {
      for (int i = 0; i < num_nodes; ++i)
        u[i] = (1.0 / norm) * u[i];
      apply(u, a);
      double const diagonal = product(u, a);
      t.push(diagonal, beside);
      for (int i = 0; i < num_nodes; ++i)
      {
        Vector2 const next = a[i] - diagonal * u[i] - beside * last[i];
        last[i] = u[i];
        u[i] = next;
      }
      norm = beside = Math::sqrt(product(u, u));
      scale = Math::max(scale, diagonal + beside);
    }
    return 0.25 * t.largest();
  }
};

} // namespace detail
} // namespace Harmos

#endif
