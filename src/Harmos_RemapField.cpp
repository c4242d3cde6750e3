// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RemapField.hpp"

#include <cmath>
#include <vector>

namespace Harmos
{
namespace
{

double fieldAt(RemapField const &field, Vector2 const &x)
{
  if (field.shock)
    return x[1] > (x[0] - 0.4) / 0.3 ? 0.0 : 1.0;
  return field.base + std::sin(2.0 * Math::pi * x[0]) * std::sin(2.0 * Math::pi * x[1]);
}

/// Nodes and weights of Gauss' rule on [0, 1], by Newton's method for the zeros of the Legendre polynomial.
void gaussRule(int n, std::vector<double> &point, std::vector<double> &weight)
{
  for (int i = 0; i < n; ++i)
  {
    double x = std::cos(Math::pi * (i + 0.75) / (n + 0.5)), slope = 1.0;
    for (int iteration = 0; iteration < 50; ++iteration)
    {
      double p0 = 1.0, p1 = x;
      for (int k = 2; k <= n; ++k)
      {
        double const p2 = ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (x * p1 - p0) / (x * x - 1.0);
      x -= p1 / slope;
    }
    point.push_back(0.5 * (1.0 - x));
    weight.push_back(1.0 / ((1.0 - x * x) * slope * slope));
  }
}

} // namespace

View<double *> cellAverages(RemapField const &field, Mesh const &mesh)
{
  std::vector<double> point, weight;
  gaussRule(field.shock ? 16 : 2, point, weight);
  View<double *> const value("Harmos::averages", mesh.num_cells);
  auto const host = Kokkos::create_mirror_view(value);
  auto const position = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_position);
  auto const node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_node);
  for (int cell = 0; cell < mesh.num_cells; ++cell)
  {
    Vector2 q[4];
    for (int k = 0; k < 4; ++k)
      q[k] = {position(node(cell, k), 0), position(node(cell, k), 1)};
    double sum = 0.0, volume = 0.0;
    for (std::size_t i = 0; i < point.size(); ++i)
      for (std::size_t j = 0; j < point.size(); ++j)
      {
        double N[4];
        shapeFunctions({point[i], point[j]}, N);
        Vector2 const x = (N[0] * q[0] + N[1] * q[1]) + (N[2] * q[2] + N[3] * q[3]);
        Vector2 const along = (1.0 - point[j]) * (q[1] - q[0]) + point[j] * (q[2] - q[3]);
        Vector2 const up = (1.0 - point[i]) * (q[3] - q[0]) + point[i] * (q[2] - q[1]);
        double const r = mesh.geometry == Geometry::Planar ? 1.0 : x[0];
        double const w = r * weight[i] * weight[j] * cross(along, up);
        sum += w * fieldAt(field, x);
        volume += w;
      }
    host(cell) = sum / volume;
  }
  Kokkos::deep_copy(value, host);
  return value;
}

} // namespace Harmos
