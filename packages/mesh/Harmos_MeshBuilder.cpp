// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshBuilder.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace Harmos
{

namespace
{

/// Which cells and nodes of the whole mesh a rank holds: ascending global numbers, and the way back (-1: not here).
struct Selection
{
  std::vector<int> cell;
  std::vector<int> node;
  std::vector<int> local_cell;
  std::vector<int> local_node;
  std::vector<int> cell_depth; // of the whole mesh; -1: beyond the halo
};

using Harmos::deviceCopy;

template <class T, std::size_t N>
View<T *[N]> deviceCopy(std::string const &label, std::vector<std::array<T, N>> const &values)
{
  View<T *[N]> result(label, values.size());
  auto host = Kokkos::create_mirror_view(result);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t k = 0; k < N; ++k)
      host(i, k) = values[i][k];
  Kokkos::deep_copy(result, host);
  return result;
}

Rows deviceCopy(std::string const &label, HostRows const &rows)
{
  return {deviceCopy(label + " offset", rows.offset), deviceCopy(label + " item", rows.item)};
}

/// Breadth-first layers of vertex neighbours around the cells that `rank` owns.
std::vector<int> haloDepths(HostMesh const &whole, HostRows const &node_cell, std::vector<int> const &owner, int rank,
                            int halo)
{
  std::vector<int> depth(whole.cell.size(), -1);
  std::vector<int> front;
  for (std::size_t c = 0; c < owner.size(); ++c)
    if (owner[c] == rank)
    {
      depth[c] = 0;
      front.push_back(static_cast<int>(c));
    }
  for (int layer = 1; layer <= halo && !front.empty(); ++layer)
  {
    std::vector<int> next;
    for (int const c : front)
      for (int const node : whole.cell[c])
        for (int i = node_cell.offset[node]; i < node_cell.offset[node + 1]; ++i)
        {
          int const other = node_cell.item[i] / 4;
          if (depth[other] < 0)
          {
            depth[other] = layer;
            next.push_back(other);
          }
        }
    front.swap(next);
  }
  return depth;
}

Selection select(HostMesh const &whole, std::vector<int> depth)
{
  Selection s;
  s.cell_depth = std::move(depth);
  s.local_cell.assign(whole.cell.size(), -1);
  s.local_node.assign(whole.node.size(), -1);
  for (std::size_t c = 0; c < whole.cell.size(); ++c)
    if (s.cell_depth[c] >= 0)
    {
      s.local_cell[c] = static_cast<int>(s.cell.size());
      s.cell.push_back(static_cast<int>(c));
      for (int const node : whole.cell[c])
        s.local_node[node] = 0;
    }
  for (std::size_t n = 0; n < whole.node.size(); ++n)
    if (s.local_node[n] == 0)
    {
      s.local_node[n] = static_cast<int>(s.node.size());
      s.node.push_back(static_cast<int>(n));
    }
  return s;
}

/// Put a number into an ascending row, once.
void insertOnce(std::vector<int> &row, int number)
{
  std::size_t at = row.size();
  while (at > 0 && row[at - 1] > number)
    --at;
  if (at > 0 && row[at - 1] == number)
    return;
  row.push_back(number);
  for (std::size_t i = row.size() - 1; i > at; --i)
    row[i] = row[i - 1];
  row[at] = number;
}

void setCells(Mesh &mesh, HostMesh const &whole, HostRows const &node_cell, Selection const &s)
{
  std::size_t const num_cells = s.cell.size();
  std::vector<std::array<int, 4>> nodes(num_cells), neighbour(num_cells), boundary(num_cells);
  std::vector<int> depth(num_cells);
  std::vector<long long> global(num_cells);
  HostRows around;
  around.offset.reserve(num_cells + 1);
  around.offset.push_back(0);
  around.item.reserve(8 * num_cells);
  std::vector<int> row;
  for (std::size_t i = 0; i < num_cells; ++i)
  {
    int const c = s.cell[i];
    depth[i] = s.cell_depth[c];
    global[i] = c;
    boundary[i] = whole.face_boundary[c];
    row.clear();
    for (int k = 0; k < 4; ++k)
    {
      int const node = whole.cell[c][k];
      nodes[i][k] = s.local_node[node];
      int const opposite = oppositeFace(whole, node_cell, c, k);
      int const other = opposite < 0 ? -1 : s.local_cell[opposite / 4];
      neighbour[i][k] = other < 0 ? -1 : 4 * other + opposite % 4;
      for (int j = node_cell.offset[node]; j < node_cell.offset[node + 1]; ++j)
      {
        int const near = s.local_cell[node_cell.item[j] / 4];
        if (near >= 0 && near != static_cast<int>(i))
          insertOnce(row, near);
      }
    }
    around.item.insert(around.item.end(), row.begin(), row.end());
    around.offset.push_back(static_cast<int>(around.item.size()));
  }
  mesh.num_cells = static_cast<int>(num_cells);
  mesh.num_owned_cells = static_cast<int>(std::count(depth.begin(), depth.end(), 0));
  mesh.cell_node = deviceCopy("Harmos::mesh::cell_node", nodes);
  mesh.face_neighbour = deviceCopy("Harmos::mesh::face_neighbour", neighbour);
  mesh.face_boundary = deviceCopy("Harmos::mesh::face_boundary", boundary);
  mesh.cell_neighbour = deviceCopy("Harmos::mesh::cell_neighbour", around);
  mesh.cell_depth = deviceCopy("Harmos::mesh::cell_depth", depth);
  mesh.cell_global = deviceCopy("Harmos::mesh::cell_global", global);
}

void setNodes(Mesh &mesh, HostMesh const &whole, HostRows const &node_cell, Selection const &s,
              std::vector<int> const &owner, int rank)
{
  std::size_t const num_nodes = s.node.size();
  std::vector<std::array<double, 2>> position(num_nodes);
  std::vector<int> depth(num_nodes), owned(num_nodes);
  std::vector<long long> global(num_nodes);
  HostRows around;
  around.offset.assign(1, 0);
  for (std::size_t i = 0; i < num_nodes; ++i)
  {
    int const n = s.node[i];
    position[i] = whole.node[n];
    global[i] = n;
    owned[i] = owner[node_cell.item[node_cell.offset[n]] / 4] == rank ? 1 : 0;
    int least = -1;
    for (int j = node_cell.offset[n]; j < node_cell.offset[n + 1]; ++j)
    {
      int const cell = node_cell.item[j] / 4;
      if (s.local_cell[cell] < 0)
        continue;
      around.item.push_back(4 * s.local_cell[cell] + node_cell.item[j] % 4);
      least = least < 0 ? s.cell_depth[cell] : std::min(least, s.cell_depth[cell]);
    }
    depth[i] = least;
    around.offset.push_back(static_cast<int>(around.item.size()));
  }
  mesh.num_nodes = static_cast<int>(num_nodes);
  mesh.node_position = deviceCopy("Harmos::mesh::node_position", position);
  mesh.node_cell = deviceCopy("Harmos::mesh::node_cell", around);
  mesh.node_depth = deviceCopy("Harmos::mesh::node_depth", depth);
  mesh.node_owned = deviceCopy("Harmos::mesh::node_owned", owned);
  mesh.node_global = deviceCopy("Harmos::mesh::node_global", global);
}

} // namespace

Mesh buildMesh(HostMesh const &whole)
{
  return buildLocalMesh(whole, std::vector<int>(whole.cell.size(), 0), 0, 0);
}

Mesh buildLocalMesh(HostMesh const &whole, std::vector<int> const &owner, int rank, int halo)
{
  checkCells(whole);
  if (owner.size() != whole.cell.size())
    throw std::runtime_error("local mesh: " + std::to_string(whole.cell.size()) + " cells but owners of " +
                             std::to_string(owner.size()));
  auto const stray = std::find_if(owner.begin(), owner.end(), [](int of_cell) { return of_cell < 0; });
  if (stray != owner.end())
    throw std::runtime_error("local mesh: the owner of cell " + std::to_string(stray - owner.begin()) + " is " +
                             std::to_string(*stray) + "; expected: a rank, 0 or more");
  if (halo < 0)
    throw std::runtime_error("local mesh: halo = " + std::to_string(halo) + " < 0");
  HostRows const node_cell = cellsAroundNodes(whole);
  Selection const s = select(whole, haloDepths(whole, node_cell, owner, rank, halo));
  for (int const cell : s.cell)
    checkFaces(whole, node_cell, cell);
  Mesh mesh;
  mesh.halo = halo;
  setCells(mesh, whole, node_cell, s);
  setNodes(mesh, whole, node_cell, s, owner, rank);
  separateGeometry(mesh);
  updateGeometry(mesh);
  return mesh;
}

void updateGeometry(Mesh &mesh)
{
  updateVolumes(mesh);
  updateCornerShares(mesh);
}

void updateVolumes(Mesh &mesh)
{
  Mesh const m = mesh;
  Kokkos::parallel_for(
      "Harmos::mesh::cellArea", RangePolicy(0, m.num_cells),
      KOKKOS_LAMBDA(int cell) { m.cell_area(cell) = area(cellQuadrilateral(m, cell)); });
  if (m.geometry == Geometry::Planar)
    return;
  Kokkos::parallel_for(
      "Harmos::mesh::cellVolume", RangePolicy(0, m.num_cells),
      KOKKOS_LAMBDA(int cell) { m.cell_volume(cell) = volume(cellQuadrilateral(m, cell), m.geometry); });
}

void updateCornerShares(Mesh &mesh)
{
  if (mesh.corner_share.quarters())
    return;
  Mesh const m = mesh;
  Kokkos::parallel_for(
      "Harmos::mesh::cornerShares", RangePolicy(0, m.num_cells),
      KOKKOS_LAMBDA(int cell) { ringShares(cellQuadrilateral(m, cell), &m.corner_share.part(cell, 0)); });
}

void separateGeometry(Mesh &mesh)
{
  mesh.cell_area = View<double *>("Harmos::mesh::cell_area", mesh.num_cells);
  bool const planar = mesh.geometry == Geometry::Planar;
  mesh.cell_volume = planar ? mesh.cell_area : View<double *>("Harmos::mesh::cell_volume", mesh.num_cells);
  mesh.corner_share.part = {};
  if (!planar)
    mesh.corner_share.part = View<double *[4]>("Harmos::mesh::corner_share", mesh.num_cells);
}

void setGeometry(Mesh &mesh, Geometry geometry)
{
  auto const position = mesh.node_position;
  int left_of_axis = mesh.num_nodes;
  if (geometry == Geometry::Axisymmetric)
    Kokkos::parallel_reduce(
        "Harmos::mesh::leftOfAxis", RangePolicy(0, mesh.num_nodes),
        KOKKOS_LAMBDA(int node, int &least) {
          if (!(position(node, 0) >= 0.0))
            least = Math::min(least, node);
        },
        Kokkos::Min<int>(left_of_axis));
  if (mesh.num_nodes > 0 && left_of_axis < mesh.num_nodes)
  {
    double r = 0.0;
    Kokkos::deep_copy(r, Kokkos::subview(position, left_of_axis, 0));
    throw std::runtime_error("axisymmetric mesh: local node " + std::to_string(left_of_axis) +
                             " has r = " + std::to_string(r) + " < 0");
  }
  mesh.geometry = geometry;
  separateGeometry(mesh);
  updateGeometry(mesh);
}

int countInvertedCells(Mesh const &mesh)
{
  Mesh const m = mesh;
  int count = 0;
  Kokkos::parallel_reduce(
      "Harmos::mesh::countInvertedCells", RangePolicy(0, m.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum) {
        Quadrilateral const q = cellQuadrilateral(m, cell);
        bool convex = true;
        for (int k = 0; k < 4; ++k)
          convex = convex && cross(q[k] - q[(k + 3) % 4], q[(k + 1) % 4] - q[k]) > 0.0;
        sum += convex || m.cell_depth(cell) != 0 ? 0 : 1;
      },
      count);
  return count;
}

} // namespace Harmos
