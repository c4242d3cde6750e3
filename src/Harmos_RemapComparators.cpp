// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RemapComparators.hpp"

#include <Harmos_Clip.hpp>
#include <Harmos_Moments.hpp>

#include <array>
#include <cmath>
#include <stdexcept>

namespace Harmos
{
namespace
{

using Overlap = Polygon<12>;

/// A mesh and a function on it, on the host: f(x) = value + slope . (x - centroid) in each cell.
struct HostCells
{
  std::vector<Quadrilateral> cell;
  std::vector<std::array<int, 4>> node;
  std::vector<double> area;
  std::vector<Vector2> centroid;
  std::vector<std::vector<int>> around; // the cell and its vertex neighbours
  int num_nodes = 0;
};

HostCells hostCells(Mesh const &mesh)
{
  auto const position = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_position);
  auto const node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_node);
  auto const offset = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_neighbour.offset);
  auto const item = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_neighbour.item);
  HostCells cells;
  cells.num_nodes = mesh.num_nodes;
  for (int c = 0; c < mesh.num_cells; ++c)
  {
    Quadrilateral q;
    std::array<int, 4> corner;
    q.size = 4;
    for (int k = 0; k < 4; ++k)
    {
      corner[k] = node(c, k);
      q[k] = {position(corner[k], 0), position(corner[k], 1)};
    }
    Moments<1> const m = moments<1>(q, q[0]);
    cells.cell.push_back(q);
    cells.node.push_back(corner);
    cells.area.push_back(m.volume());
    cells.centroid.push_back(q[0] + m.centroid());
    cells.around.emplace_back(1, c);
    for (int j = offset(c); j < offset(c + 1); ++j)
      cells.around.back().push_back(item(j));
  }
  return cells;
}

/// Least-squares slopes; zero at first order.
std::vector<Vector2> slopesOf(HostCells const &cells, std::vector<double> const &value, int order)
{
  std::vector<Vector2> slope(value.size(), Vector2{0.0, 0.0});
  for (std::size_t c = 0; order > 1 && c < value.size(); ++c)
  {
    double xx = 0.0, xy = 0.0, yy = 0.0, bx = 0.0, by = 0.0;
    for (int n : cells.around[c])
    {
      Vector2 const d = cells.centroid[n] - cells.centroid[c];
      double const w = dot(d, d) > 0.0 ? 1.0 / dot(d, d) : 0.0;
      xx += w * d[0] * d[0];
      xy += w * d[0] * d[1];
      yy += w * d[1] * d[1];
      bx += w * d[0] * (value[n] - value[c]);
      by += w * d[1] * (value[n] - value[c]);
    }
    double const det = xx * yy - xy * xy;
    slope[c] = {(yy * bx - xy * by) / det, (xx * by - xy * bx) / det};
  }
  return slope;
}

bool holds(Quadrilateral const &q, Vector2 const &x)
{
  bool inside = true;
  for (int k = 0; k < 4; ++k)
    inside = inside && cross(q[(k + 1) % 4] - q[k], x - q[k]) >= 0.0;
  return inside;
}

std::vector<double> interpolate(HostCells const &from, HostCells const &to, std::vector<double> const &value,
                                std::vector<Vector2> const &slope)
{
  std::vector<double> result;
  for (std::size_t c = 0; c < value.size(); ++c)
  {
    int donor = static_cast<int>(c);
    for (int n : from.around[c])
      if (holds(from.cell[n], to.centroid[c]))
      {
        donor = n;
        break;
      }
    result.push_back(value[donor] + dot(slope[donor], to.centroid[c] - from.centroid[donor]));
  }
  return result;
}

/// Adds the integrals of N_i f over the part of a donor in an acceptor: a fan of triangles, three points each (exact
/// for linear f in the sum over i, since the N_i sum to one).
void addLoads(HostCells const &from, int donor, double value, Vector2 const &slope, HostCells const &to, int acceptor,
              std::vector<double> &load)
{
  Overlap part;
  clipConvex(from.cell[donor], to.cell[acceptor], part);
  for (int i = 1; i + 1 < part.size; ++i)
  {
    Vector2 const a = part[0], b = part[i], c = part[i + 1];
    double const weight = cross(b - a, c - a) / 6.0;
    Vector2 const middle[3] = {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)};
    for (Vector2 const &x : middle)
    {
      double N[4];
      shapeFunctionsAt(to.cell[acceptor], x, N);
      double const f = value + dot(slope, x - from.centroid[donor]);
      for (int k = 0; k < 4; ++k)
        load[to.node[acceptor][k]] += weight * f * N[k];
    }
  }
}

/// Element mass matrices, by 2 x 2 Gauss points: exact.
std::vector<std::array<double, 16>> massMatrices(HostCells const &cells)
{
  double const point[2] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
  std::vector<std::array<double, 16>> mass;
  for (Quadrilateral const &q : cells.cell)
  {
    std::array<double, 16> m{};
    for (double xi : point)
      for (double eta : point)
      {
        double N[4];
        shapeFunctions({xi, eta}, N);
        Vector2 const along = (1.0 - eta) * (q[1] - q[0]) + eta * (q[2] - q[3]);
        Vector2 const up = (1.0 - xi) * (q[3] - q[0]) + xi * (q[2] - q[1]);
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j)
            m[4 * i + j] += 0.25 * cross(along, up) * N[i] * N[j];
      }
    mass.push_back(m);
  }
  return mass;
}

using Vector = std::vector<double>;

Vector product(HostCells const &cells, std::vector<std::array<double, 16>> const &mass, Vector const &x)
{
  Vector y(x.size(), 0.0);
  for (std::size_t c = 0; c < mass.size(); ++c)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        y[cells.node[c][i]] += mass[c][4 * i + j] * x[cells.node[c][j]];
  return y;
}

double inner(Vector const &a, Vector const &b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

/// Conjugate gradients with the diagonal. The matrix is as well conditioned as its elements: some tens of iterations.
Vector solve(HostCells const &cells, std::vector<std::array<double, 16>> const &mass, Vector const &load, Vector x)
{
  Vector diagonal(load.size(), 0.0);
  for (std::size_t c = 0; c < mass.size(); ++c)
    for (int i = 0; i < 4; ++i)
      diagonal[cells.node[c][i]] += mass[c][5 * i];
  Vector r = product(cells, mass, x);
  Vector z(r.size());
  for (std::size_t i = 0; i < r.size(); ++i)
    r[i] = load[i] - r[i];
  auto const precondition = [&]
  {
    for (std::size_t i = 0; i < r.size(); ++i)
      z[i] = r[i] / diagonal[i];
  };
  precondition();
  Vector p = z;
  double rz = inner(r, z);
  double const stop = 1e-30 * std::fabs(inner(x, load));
  for (int iteration = 0; iteration < 500 && rz > stop; ++iteration)
  {
    Vector const q = product(cells, mass, p);
    double const alpha = rz / inner(p, q);
    for (std::size_t i = 0; i < r.size(); ++i)
    {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
    precondition();
    double const next = inner(r, z);
    for (std::size_t i = 0; i < r.size(); ++i)
      p[i] = z[i] + next / rz * p[i];
    rz = next;
  }
  return x;
}

std::vector<double> project(bool consistent, HostCells const &from, HostCells const &to,
                            std::vector<double> const &value, std::vector<Vector2> const &slope)
{
  Vector load(to.num_nodes, 0.0), node_area(to.num_nodes, 0.0);
  auto const mass = massMatrices(to);
  for (std::size_t c = 0; c < value.size(); ++c)
  {
    for (int n : from.around[c])
      addLoads(from, n, value[n], slope[n], to, static_cast<int>(c), load);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        node_area[to.node[c][i]] += mass[c][4 * i + j];
  }
  Vector nodal(load.size());
  for (std::size_t i = 0; i < load.size(); ++i)
    nodal[i] = load[i] / node_area[i];
  if (consistent)
    nodal = solve(to, mass, load, nodal);
  std::vector<double> result(value.size(), 0.0);
  for (std::size_t c = 0; c < value.size(); ++c)
  {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        result[c] += mass[c][4 * i + j] * nodal[to.node[c][j]];
    result[c] /= to.area[c];
  }
  return result;
}

} // namespace

std::vector<double> remapByComparator(RemapScheme scheme, int order, Mesh const &from, Mesh const &to,
                                      std::vector<double> const &value)
{
  if (scheme == RemapScheme::Swept || scheme == RemapScheme::Intersection || scheme == RemapScheme::FieldIntersection)
    throw std::runtime_error("remapByComparator: the scheme is none of the comparators");
  HostCells const donors = hostCells(from), acceptors = hostCells(to);
  std::vector<Vector2> const slope = slopesOf(donors, value, order);
  if (scheme == RemapScheme::Interpolation)
    return interpolate(donors, acceptors, value, slope);
  return project(scheme == RemapScheme::ConsistentProjection, donors, acceptors, value, slope);
}

} // namespace Harmos
