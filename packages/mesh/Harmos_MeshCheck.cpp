// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshBuilder.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

namespace Harmos
{

namespace
{

template <class V>
auto hostCopy(V const &view)
{
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
}

[[noreturn]] void fail(char const *what, long long number, char const *wrong)
{
  throw std::runtime_error(std::string(what) + " " + std::to_string(number) + ": " + wrong);
}

void checkCells(Mesh const &mesh)
{
  auto const global = hostCopy(mesh.cell_global);
  auto const node = hostCopy(mesh.cell_node);
  auto const position = hostCopy(mesh.node_position);
  auto const cell_area = hostCopy(mesh.cell_area);
  auto const cell_volume = hostCopy(mesh.cell_volume);
  auto const neighbour = hostCopy(mesh.face_neighbour);
  auto const boundary = hostCopy(mesh.face_boundary);
  for (int c = 0; c < mesh.num_cells; ++c)
  {
    if (c > 0 && global(c) <= global(c - 1))
      fail("cell", global(c), "local numbers do not follow the global ones");
    Quadrilateral q;
    q.size = 4;
    for (int k = 0; k < 4; ++k)
    {
      if (node(c, k) < 0 || node(c, k) >= mesh.num_nodes)
        fail("cell", global(c), "a node number is out of range");
      q[k] = {position(node(c, k), 0), position(node(c, k), 1)};
    }
    for (int k = 0; k < 4; ++k)
      if (!(cross(q[k] - q[(k + 3) % 4], q[(k + 1) % 4] - q[k]) > 0.0))
        fail("cell", global(c), "a corner is not strictly convex");
    if (!(std::fabs(cell_area(c) - area(q)) <= 1e-14 * area(q)))
      fail("cell", global(c), "its area is not that of its nodes");
    double const own = volume(q, mesh.geometry);
    if (!(std::fabs(cell_volume(c) - own) <= 1e-14 * own))
      fail("cell", global(c), "its volume is not that of its nodes");
    for (int k = 0; k < 4; ++k)
    {
      int const other = neighbour(c, k);
      if (other >= 0 && neighbour(other / 4, other % 4) != 4 * c + k)
        fail("cell", global(c), "a face's neighbour does not lead back");
      if (other >= 0 &&
          (node(other / 4, other % 4) != node(c, (k + 1) % 4) || node(other / 4, (other % 4 + 1) % 4) != node(c, k)))
        fail("cell", global(c), "a face and its neighbour have different nodes");
      if (other >= 0 && boundary(c, k) >= 0)
        fail("cell", global(c), "an inner face lies on a boundary");
    }
  }
}

void checkRows(Mesh const &mesh)
{
  auto const global = hostCopy(mesh.node_global);
  auto const node = hostCopy(mesh.cell_node);
  auto const offset = hostCopy(mesh.node_cell.offset);
  auto const item = hostCopy(mesh.node_cell.item);
  if (offset(0) != 0 || offset(mesh.num_nodes) != 4 * mesh.num_cells)
    throw std::runtime_error("mesh: the rows of cells around nodes are not complete");
  for (int n = 0; n < mesh.num_nodes; ++n)
    for (int i = offset(n); i < offset(n + 1); ++i)
    {
      if (node(item(i) / 4, item(i) % 4) != n)
        fail("node", global(n), "a cell around it does not name it");
      if (i > offset(n) && item(i) <= item(i - 1))
        fail("node", global(n), "the cells around it are not ascending");
    }
  auto const around_offset = hostCopy(mesh.cell_neighbour.offset);
  auto const around = hostCopy(mesh.cell_neighbour.item);
  auto const cell_global = hostCopy(mesh.cell_global);
  for (int c = 0; c < mesh.num_cells; ++c)
    for (int i = around_offset(c); i < around_offset(c + 1); ++i)
      if (around(i) == c || (i > around_offset(c) && around(i) <= around(i - 1)))
        fail("cell", cell_global(c), "its neighbours are not ascending or hold itself");
}

} // namespace

void checkMesh(Mesh const &mesh)
{
  checkCells(mesh);
  checkRows(mesh);
}

} // namespace Harmos
