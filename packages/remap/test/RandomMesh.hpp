// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RANDOM_MESH_HPP
#define HARMOS_RANDOM_MESH_HPP

#include "RemapScene.hpp"

namespace Harmos
{
namespace Test
{

/// Average over a quadrilateral by 2 x 2 Gauss points of the bilinear map: exact for linear functions.
template <class Function>
double gaussAverage(Quadrilateral const &q, Function const &f)
{
  double const point[2] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
  double sum = 0.0, volume = 0.0;
  for (double s : point)
    for (double t : point)
    {
      double N[4];
      shapeFunctions({s, t}, N);
      Vector2 const a = (1.0 - t) * (q[1] - q[0]) + t * (q[2] - q[3]);
      Vector2 const b = (1.0 - s) * (q[3] - q[0]) + s * (q[2] - q[1]);
      double const w = cross(a, b);
      sum += w * f(N[0] * q[0] + N[1] * q[1] + N[2] * q[2] + N[3] * q[3]);
      volume += w;
    }
  return sum / volume;
}

/// In [-1, 1), by the node's global number: the same on any number of ranks.
inline double noise(long long global, int d)
{
  std::mt19937 random(static_cast<unsigned>(2 * global + d));
  return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
}

/// A mesh with inner nodes shifted at random, and those of walls along them.
inline MeshOnHost shiftedMesh(MeshOnHost const &mesh, double amount)
{
  Mesh copy = mesh.on_device;
  copy.node_position = View<double *[2]>("target", mesh.num_nodes);
  separateGeometry(copy);
  MeshOnHost target(copy);
  for (int node = 0; node < mesh.num_nodes; ++node)
    for (int d = 0; d < 2; ++d)
    {
      double const x = mesh.node_position(node, d);
      bool const wall = x == 0.0 || x == 1.0;
      target.node_position(node, d) = wall ? x : x + amount * noise(mesh.node_global(node), d);
    }
  updateGeometry(target);
  return target;
}

/// One material's moved mesh, at time step one.
inline Quadrilateral movedCell(Scene const &scene, int cell)
{
  Quadrilateral q = cellQuadrilateral(scene.mesh, cell);
  for (int k = 0; k < 4; ++k)
  {
    int const dof = scene.pairs.dof_node(cell, k);
    q[k] += Vector2{scene.half(dof, 0), scene.half(dof, 1)};
  }
  return q;
}

/// The cell averages of a density on the moved mesh. Pair numbers are cell numbers.
inline void setDensity(Scene &scene, std::function<double(Vector2 const &)> const &density)
{
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
  {
    Quadrilateral const q = movedCell(scene, cell);
    scene.state.record(cell, Mass) = area(q) * gaussAverage(q, density);
  }
}

/// The regular mesh of n x n cells of the unit square moved onto one whose inner nodes are moved at random by up to
/// `jitter` cells in each coordinate.
inline Scene regularToRandom(int n, double jitter, std::function<double(Vector2 const &)> const &density)
{
  Scene scene(n, n, jitter, twoLaws());
  auto const one = [](int, Vector2 const &) { return 1.0; };
  scene.paint({rest(0)}, one, one);
  scene.move(
      [&](int, Vector2 const &x) {
        return Vector2{std::round(x[0] * n) / n - x[0], std::round(x[1] * n) / n - x[1]};
      });
  setDensity(scene, density);
  return scene;
}

/// The other way round.
inline Scene randomToRegular(int n, double jitter, std::function<double(Vector2 const &)> const &density)
{
  Scene scene(n, n, 0.0, twoLaws());
  auto const one = [](int, Vector2 const &) { return 1.0; };
  scene.paint({rest(0)}, one, one);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-jitter / n, jitter / n);
  scene.move(
      [&](int, Vector2 const &x)
      {
        double const dx = shift(random), dy = shift(random);
        bool const inner = x[0] > 0.0 && x[0] < 1.0 && x[1] > 0.0 && x[1] < 1.0;
        return inner ? Vector2{dx, dy} : Vector2{0.0, 0.0};
      });
  setDensity(scene, density);
  return scene;
}

} // namespace Test
} // namespace Harmos

#endif
