// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MESH_MOTION_HPP
#define HARMOS_MESH_MOTION_HPP

#include <Harmos_Vector.hpp>

#include <cstdint>

namespace Harmos
{

enum class MotionKind : int
{
  Tensor,
  Smooth,
  Random
};

/// Meshes of the unit square: where the node at (xi, eta) of a regular mesh is at time t, 0 <= t <= 1. Boundary nodes
/// slide along the sides.
///
///   tensor: a = sin(4 pi t)/2, x = (1 - a) xi + a xi^3, y = (1 - a) eta + a eta^2
///   smooth: a = min(t, 1 - t)/5, x - xi = y - eta = a sin(2 pi xi) sin(2 pi eta)
///   random: inner nodes shifted by independent uniform numbers in +-amplitude h for each coordinate, anew each step
/// Tensor and smooth motion end where they began.
///
/// Margolin & Shashkov, J. Comput. Phys. 184 (2003) 266-298.
struct MeshMotion
{
  MotionKind kind = MotionKind::Tensor;
  double amplitude = 0.25; // random: part of a cell
  int seed = 1;            // random

  KOKKOS_INLINE_FUNCTION Vector2 position(Vector2 const &reference, double t) const
  {
    double const xi = reference[0], eta = reference[1];
    if (kind == MotionKind::Tensor)
    {
      double const a = 0.5 * Math::sin(4.0 * Math::pi * t);
      return {(1.0 - a) * xi + a * xi * xi * xi, (1.0 - a) * eta + a * eta * eta};
    }
    double const a = 0.2 * Math::min(t, 1.0 - t);
    bool const side = xi == 0.0 || xi == 1.0 || eta == 0.0 || eta == 1.0;
    double const shift = side ? 0.0 : a * Math::sin(2.0 * Math::pi * xi) * Math::sin(2.0 * Math::pi * eta);
    return {xi + shift, eta + shift};
  }

  /// Random: a node's place after a step, by its global number, so that every partition has the same mesh.
  KOKKOS_INLINE_FUNCTION Vector2 randomPosition(Vector2 const &reference, long long node, int step, double h) const
  {
    Vector2 x = reference;
    bool const inner = x[0] > 0.0 && x[0] < 1.0 && x[1] > 0.0 && x[1] < 1.0;
    for (int d = 0; d < 2 && inner; ++d)
      x[d] += amplitude * h * noise(static_cast<std::uint64_t>(node) * 2u + static_cast<std::uint64_t>(d), step);
    return x;
  }

private:
  /// Uniform in [-1, 1): splitmix64 (Steele, Lea & Flood, OOPSLA 2014).
  KOKKOS_INLINE_FUNCTION double noise(std::uint64_t item, int step) const
  {
    std::uint64_t z = item + (static_cast<std::uint64_t>(step) << 36) + (static_cast<std::uint64_t>(seed) << 48);
    for (int round = 0; round < 2; ++round)
    {
      z += 0x9e3779b97f4a7c15ull;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
      z ^= z >> 31;
    }
    return static_cast<double>(z >> 11) * 0x1.0p-52 - 1.0;
  }
};

} // namespace Harmos

#endif
