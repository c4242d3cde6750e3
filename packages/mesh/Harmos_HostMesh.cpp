// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_HostMesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <string>

namespace Harmos
{

namespace
{

[[noreturn]] void fail(std::string const &message)
{
  throw std::runtime_error(message);
}

/// For checks that are made a few times only: the message is made whether or not the condition holds.
void require(bool condition, std::string const &message)
{
  if (!condition)
    fail(message);
}

double turn(Corner const &a, Corner const &b, Corner const &c)
{
  return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
}

/// Corner of a quadrilateral that does not turn strictly left, or -1. Catches not-a-number as well.
int badCorner(std::array<Corner, 4> const &q)
{
  for (int k = 0; k < 4; ++k)
    if (!(turn(q[(k + 3) % 4], q[k], q[(k + 1) % 4]) > 0.0))
      return k;
  return -1;
}

std::string text(Corner const &point)
{
  return "(" + std::to_string(point[0]) + ", " + std::to_string(point[1]) + ")";
}

/// Largest signed distance, over the edges of a, of the nearest corner of b: positive where an edge of a separates.
double separation(std::array<Corner, 4> const &a, std::array<Corner, 4> const &b)
{
  double largest = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 4; ++k)
  {
    Corner const &from = a[k];
    Corner const &to = a[(k + 1) % 4];
    double const length = std::hypot(to[0] - from[0], to[1] - from[1]);
    double nearest = std::numeric_limits<double>::infinity();
    for (Corner const &point : b)
      nearest =
          std::min(nearest, ((to[1] - from[1]) * (point[0] - from[0]) - (to[0] - from[0]) * (point[1] - from[1])));
    largest = std::max(largest, nearest / length);
  }
  return largest;
}

/// Cells of an (nx + 1) x (ny + 1) row-wise grid of nodes that starts at `first_node`.
void appendGrid(HostMesh &mesh, int nx, int ny, int first_node, int first_boundary)
{
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
    {
      int const n = first_node + j * (nx + 1) + i;
      mesh.cell.push_back({n, n + 1, n + nx + 2, n + nx + 1});
      mesh.face_boundary.push_back({j == 0 ? first_boundary + 2 : -1, i == nx - 1 ? first_boundary + 1 : -1,
                                    j == ny - 1 ? first_boundary + 3 : -1, i == 0 ? first_boundary : -1});
    }
}

void requireAscending(std::vector<double> const &x, std::string const &name)
{
  require(x.size() >= 2,
          "rectilinear mesh: " + name + " needs at least two coordinates, has " + std::to_string(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    require(std::isfinite(x[i]), "rectilinear mesh: " + name + "[" + std::to_string(i) + "] is not finite");
    if (i > 0 && !(x[i] > x[i - 1]))
      fail("rectilinear mesh: " + name + "[" + std::to_string(i) + "] = " + std::to_string(x[i]) + " is not above " +
           std::to_string(x[i - 1]));
  }
}

bool hasArcs(MappedBlock const &block)
{
  return std::any_of(block.arc_radius.begin(), block.arc_radius.end(), [](double r) { return r != 0.0; });
}

/// The point at part s of the side from corner a to b of a block that lies on its left.
Corner onSide(Corner const &a, Corner const &b, double radius, double s)
{
  Corner const chord = {b[0] - a[0], b[1] - a[1]};
  if (radius == 0.0)
    return {a[0] + s * chord[0], a[1] + s * chord[1]};
  double const length = std::hypot(chord[0], chord[1]);
  double const half_angle = std::asin(0.5 * length / radius); // of the sign of the radius
  // height of the arc over its chord, outwards, and the part of the chord below
  double const angle = (2.0 * s - 1.0) * half_angle;
  double const height = radius * (std::cos(angle) - std::cos(half_angle)) / length;
  double const along = 0.5 + radius * std::sin(angle) / length;
  return {a[0] + along * chord[0] + height * chord[1], a[1] + along * chord[1] - height * chord[0]};
}

/// A point of a block with arcs (MappedBlock).
Corner transfinite(MappedBlock const &block, double xi, double eta)
{
  auto const &q = block.corner;
  auto const &r = block.arc_radius;
  // sides 2 and 3 are run through backwards
  Corner const side[4] = {onSide(q[0], q[1], r[0], xi), onSide(q[1], q[2], r[1], eta),
                          onSide(q[2], q[3], r[2], 1.0 - xi), onSide(q[3], q[0], r[3], 1.0 - eta)};
  double const N[4] = {(1 - xi) * (1 - eta), xi * (1 - eta), xi * eta, (1 - xi) * eta};
  Corner point;
  for (int d = 0; d < 2; ++d)
  {
    point[d] = (1.0 - eta) * side[0][d] + eta * side[2][d] + (1.0 - xi) * side[3][d] + xi * side[1][d];
    for (int k = 0; k < 4; ++k)
      point[d] -= N[k] * q[k][d];
  }
  return point;
}

void requireBlock(std::vector<MappedBlock> const &blocks, std::size_t b)
{
  std::string const name = "block " + std::to_string(b);
  MappedBlock const &block = blocks[b];
  require(block.cells[0] > 0 && block.cells[1] > 0, name + ": needs at least one cell in each direction");
  int const bad = badCorner(block.corner);
  require(bad < 0, name + ": corner " + std::to_string(bad) + " at " + text(block.corner[bad < 0 ? 0 : bad]) +
                       " is not strictly convex (corners run counter-clockwise)");
  double const size = std::hypot(block.corner[2][0] - block.corner[0][0], block.corner[2][1] - block.corner[0][1]);
  for (int k = 0; k < 4; ++k)
  {
    Corner const &from = block.corner[k], &to = block.corner[(k + 1) % 4];
    double const half = 0.5 * std::hypot(to[0] - from[0], to[1] - from[1]);
    double const radius = std::fabs(block.arc_radius[k]);
    require(radius == 0.0 || radius >= half, name + ": side " + std::to_string(k) + " cannot be an arc of radius " +
                                                 std::to_string(radius) + "; expected: at least half of its length, " +
                                                 std::to_string(half));
  }
  for (std::size_t other = 0; other < b; ++other)
    require(hasArcs(block) || hasArcs(blocks[other]) ||
                std::max(separation(block.corner, blocks[other].corner),
                         separation(blocks[other].corner, block.corner)) >= -1e-10 * size,
            name + " overlaps block " + std::to_string(other));
}

/// Of the other cells at a face a -> b, none may run along it a -> b and one at most b -> a; its boundary number.
void checkFace(HostMesh const &mesh, HostRows const &node_cell, int cell, int face)
{
  int const a = mesh.cell[cell][face];
  int const b = mesh.cell[cell][(face + 1) % 4];
  int same_way = 0;
  int other_way = 0;
  for (int i = node_cell.offset[a]; i < node_cell.offset[a + 1]; ++i)
  {
    std::array<int, 4> const &nodes = mesh.cell[node_cell.item[i] / 4];
    int const corner = node_cell.item[i] % 4;
    same_way += nodes[(corner + 1) % 4] == b ? 1 : 0;
    other_way += nodes[(corner + 3) % 4] == b ? 1 : 0;
  }
  if (same_way > 1 || other_way > 1)
    fail("cell " + std::to_string(cell) + ": face " + std::to_string(face) + " is shared wrongly");
  if (other_way == 1 && mesh.face_boundary[cell][face] >= 0)
    fail("cell " + std::to_string(cell) + ": inner face " + std::to_string(face) + " lies on boundary " +
         std::to_string(mesh.face_boundary[cell][face]));
  if (mesh.face_boundary[cell][face] < -1)
    fail("cell " + std::to_string(cell) + ": face " + std::to_string(face) + " lies on boundary " +
         std::to_string(mesh.face_boundary[cell][face]) + "; expected: 0 or more, or -1 for none");
}

} // namespace

void checkCells(HostMesh const &mesh)
{
  int const num_nodes = static_cast<int>(mesh.node.size());
  int const num_cells = static_cast<int>(mesh.cell.size());
  require(mesh.face_boundary.size() == mesh.cell.size(), "mesh: " + std::to_string(num_cells) +
                                                             " cells but boundary numbers of " +
                                                             std::to_string(mesh.face_boundary.size()));
  std::vector<char> touched(num_nodes, 0);
  for (int c = 0; c < num_cells; ++c)
  {
    std::array<Corner, 4> q;
    for (int k = 0; k < 4; ++k)
    {
      int const node = mesh.cell[c][k];
      if (node < 0 || node >= num_nodes)
        fail("cell " + std::to_string(c) + ": node " + std::to_string(node) + " is not in [0, " +
             std::to_string(num_nodes) + ")");
      touched[node] = 1;
      q[k] = mesh.node[node];
    }
    int const bad = badCorner(q);
    if (bad >= 0)
      fail("cell " + std::to_string(c) + ": corner " + std::to_string(bad) + " at " + text(q[bad]) +
           " is not strictly convex");
  }
  for (int n = 0; n < num_nodes; ++n)
    if (touched[n] == 0)
      fail("node " + std::to_string(n) + ": no cell touches it");
}

void checkFaces(HostMesh const &mesh, HostRows const &node_cell, int cell)
{
  for (int k = 0; k < 4; ++k)
    checkFace(mesh, node_cell, cell, k);
}

HostRows cellsAroundNodes(HostMesh const &mesh)
{
  HostRows rows;
  rows.offset.assign(mesh.node.size() + 1, 0);
  for (auto const &nodes : mesh.cell)
    for (int const node : nodes)
      ++rows.offset[node + 1];
  for (std::size_t i = 0; i < mesh.node.size(); ++i)
    rows.offset[i + 1] += rows.offset[i];
  rows.item.resize(rows.offset.back());
  std::vector<int> next(rows.offset.begin(), rows.offset.end() - 1);
  for (std::size_t c = 0; c < mesh.cell.size(); ++c)
    for (int k = 0; k < 4; ++k)
      rows.item[next[mesh.cell[c][k]]++] = static_cast<int>(4 * c) + k;
  return rows;
}

int oppositeFace(HostMesh const &mesh, HostRows const &node_cell, int cell, int face)
{
  int const a = mesh.cell[cell][face];
  int const b = mesh.cell[cell][(face + 1) % 4];
  for (int i = node_cell.offset[a]; i < node_cell.offset[a + 1]; ++i)
  {
    int const other = node_cell.item[i] / 4;
    int const corner = node_cell.item[i] % 4;
    int const before = (corner + 3) % 4;
    if (other != cell && mesh.cell[other][before] == b)
      return 4 * other + before;
  }
  return -1;
}

std::array<int, 2> overlappingCells(HostMesh const &mesh, std::vector<int> const &body, double part)
{
  int const count = static_cast<int>(mesh.cell.size());
  auto const cornersOf = [&](int c)
  {
    std::array<Corner, 4> x;
    for (int k = 0; k < 4; ++k)
      x[k] = mesh.node[mesh.cell[c][k]];
    return x;
  };
  std::vector<Corner> low(count), high(count);
  std::vector<double> shortest(count);
  double boxes = 0.0; // their areas in sum
  for (int c = 0; c < count; ++c)
  {
    std::array<Corner, 4> const x = cornersOf(c);
    low[c] = high[c] = x[0];
    shortest[c] = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k)
    {
      Corner const &next = x[(k + 1) % 4];
      shortest[c] = std::min(shortest[c], std::hypot(next[0] - x[k][0], next[1] - x[k][1]));
      for (int d = 0; d < 2; ++d)
      {
        low[c][d] = std::min(low[c][d], x[k][d]);
        high[c][d] = std::max(high[c][d], x[k][d]);
      }
    }
    boxes += (high[c][0] - low[c][0]) * (high[c][1] - low[c][1]);
  }
  // Of bins: a wide cell lies in many, so that few cells share one, however coarse a body is beside another.
  double const width = std::sqrt(boxes / count);
  std::map<std::array<long long, 2>, std::vector<int>> bin;
  auto const binOf = [&](double x) { return static_cast<long long>(std::floor(x / width)); };
  for (int c = 0; c < count; ++c)
    for (long long i = binOf(low[c][0]); i <= binOf(high[c][0]); ++i)
      for (long long j = binOf(low[c][1]); j <= binOf(high[c][1]); ++j)
      {
        std::vector<int> &here = bin[{i, j}];
        for (int const other : here)
          if (body[c] != body[other] &&
              std::max(separation(cornersOf(c), cornersOf(other)), separation(cornersOf(other), cornersOf(c))) <
                  -part * std::min(shortest[c], shortest[other]))
            return {other, c};
        here.push_back(c);
      }
  return {-1, -1};
}

void checkHostMesh(HostMesh const &mesh)
{
  checkCells(mesh);
  HostRows const node_cell = cellsAroundNodes(mesh);
  for (int c = 0; c < static_cast<int>(mesh.cell.size()); ++c)
    checkFaces(mesh, node_cell, c);
}

HostMesh rectilinearMesh(std::vector<double> const &x, std::vector<double> const &y)
{
  requireAscending(x, "x");
  requireAscending(y, "y");
  HostMesh mesh;
  mesh.node.reserve(x.size() * y.size());
  for (double const yj : y)
    for (double const xi : x)
      mesh.node.push_back({xi, yj});
  appendGrid(mesh, static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1, 0, 0);
  return mesh;
}

HostMesh jitteredMesh(std::vector<double> const &x, std::vector<double> const &y, double jitter, unsigned seed)
{
  require(jitter >= 0.0 && jitter < 0.25, "jittered mesh: jitter = " + std::to_string(jitter) + " is not in [0, 0.25)");
  HostMesh mesh = rectilinearMesh(x, y);
  if (jitter == 0.0)
    return mesh;
  std::mt19937 random(seed);
  auto const shift = [&random, jitter](std::vector<double> const &at, std::size_t i)
  {
    // 2^32 equally likely values: the standard's distributions differ from library to library, its generators do not.
    double const uniform = std::ldexp(static_cast<double>(random()), -31) - 1.0;
    return jitter * uniform * std::min(at[i] - at[i - 1], at[i + 1] - at[i]);
  };
  for (std::size_t j = 1; j + 1 < y.size(); ++j)
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
    {
      Corner &node = mesh.node[j * x.size() + i];
      node[0] += shift(x, i);
      node[1] += shift(y, j);
    }
  return mesh;
}

std::vector<double> gradedCoordinates(double from, double to, int cells, double ratio)
{
  require(cells >= 1, "graded coordinates: cells = " + std::to_string(cells) + " < 1");
  require(std::isfinite(from) && std::isfinite(to) && to > from,
          "graded coordinates: " + std::to_string(to) + " is not above " + std::to_string(from));
  require(std::isfinite(ratio) && ratio > 0.0, "graded coordinates: ratio = " + std::to_string(ratio) + " <= 0");
  std::vector<double> x(cells + 1);
  double const q = cells > 1 ? std::pow(ratio, 1.0 / (cells - 1)) : 1.0;
  std::vector<double> sum(cells + 1, 0.0);
  double size = 1.0;
  for (int i = 0; i < cells; ++i, size *= q)
    sum[i + 1] = ratio == 1.0 ? i + 1.0 : sum[i] + size;
  for (int i = 0; i < cells; ++i)
    x[i] = from + (to - from) * (sum[i] / sum[cells]);
  x[cells] = to;
  return x;
}

BlockMesh mappedBlocks(std::vector<MappedBlock> const &blocks)
{
  require(!blocks.empty(), "mapped blocks: there are none");
  BlockMesh result;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    requireBlock(blocks, b);
    std::array<Corner, 4> const &corner = blocks[b].corner;
    int const nx = blocks[b].cells[0];
    int const ny = blocks[b].cells[1];
    int const first_node = static_cast<int>(result.mesh.node.size());
    std::vector<double> const at_xi = gradedCoordinates(0.0, 1.0, nx, blocks[b].grading[0]);
    std::vector<double> const at_eta = gradedCoordinates(0.0, 1.0, ny, blocks[b].grading[1]);
    bool const arcs = hasArcs(blocks[b]);
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
      {
        double const xi = at_xi[i];
        double const eta = at_eta[j];
        if (arcs)
        {
          result.mesh.node.push_back(transfinite(blocks[b], xi, eta));
          continue;
        }
        double const N[4] = {(1 - xi) * (1 - eta), xi * (1 - eta), xi * eta, (1 - xi) * eta};
        Corner point{0.0, 0.0};
        for (int d = 0; d < 2; ++d)
          for (int k = 0; k < 4; ++k)
            point[d] += N[k] * corner[k][d];
        result.mesh.node.push_back(point);
      }
    appendGrid(result.mesh, nx, ny, first_node, static_cast<int>(4 * b));
    result.cell_block.resize(result.mesh.cell.size(), static_cast<int>(b));
  }
  checkHostMesh(result.mesh);
  return result;
}

} // namespace Harmos
