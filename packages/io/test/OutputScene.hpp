// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_OUTPUT_SCENE_HPP
#define HARMOS_TEST_OUTPUT_SCENE_HPP

#include <Harmos_FilledRegions.hpp>
#include <Harmos_Material.hpp>
#include <Harmos_MeshBuilder.hpp>

#include <mpi.h>

namespace Harmos
{

/// Two materials and void on 4 x 3 unit cells, the same on any partition:
///
///   +---+---+---+---+    top row empty
///   |   |   |   |   |
///   +---+---+---+---+    0 fills columns 0 and 1 and a quarter of column 2,
///   | 0 | 0 |01 | 1 |    1 fills a half of column 2 and all of column 3:
///   +---+---+---+---+    a gap of a quarter lies between x = 2.75 and 3
///   | 0 | 0 |01 | 1 |
///   +---+---+---+---+
struct OutputScene
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
  FilledRegions regions;
  View<Material *> materials;
};

enum class Partition
{
  Blocks,
  RoundRobin
};

inline Mesh sceneMesh(MPI_Comm comm, Partition partition)
{
  int rank = 0, size = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  HostMesh const whole = rectilinearMesh({0, 1, 2, 3, 4}, {0, 1, 2, 3});
  std::vector<int> owner(whole.cell.size());
  for (std::size_t i = 0; i < owner.size(); ++i)
    owner[i] = static_cast<int>(partition == Partition::Blocks ? i * size / owner.size() : i % size);
  return buildLocalMesh(whole, owner, rank, 1);
}

inline double fieldValue(long long cell, int material, int field)
{
  return 1.0 / 3.0 + 0.1 * static_cast<double>(cell) + 7.0 * material + field / 11.0;
}

inline double velocityValue(long long node, int material, int d)
{
  return 1.0 / (node + 1.5) + 3.0 * material - d;
}

inline OutputScene outputScene(MPI_Comm comm, Partition partition, Kinematics kinematics = Kinematics::Xfem)
{
  OutputScene s;
  s.mesh = sceneMesh(comm, partition);
  auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.mesh.cell_global);
  std::vector<std::array<double, 3>> list; // cell, material, volume fraction
  for (int c = 0; c < s.mesh.num_cells; ++c)
  {
    long long const column = global(c) % 4, row = global(c) / 4;
    if (row == 2)
      continue;
    double const fraction[2] = {column < 2    ? 1.0
                                : column == 2 ? 0.25
                                              : 0.0,
                                column == 3   ? 1.0
                                : column == 2 ? 0.5
                                              : 0.0};
    for (int m = 0; m < 2; ++m)
      if (fraction[m] > 0.0)
        list.push_back({double(c), double(m), fraction[m]});
  }
  int const n = static_cast<int>(list.size());
  s.pairs.num_pairs = n;
  s.pairs.offset = View<int *>("offset", s.mesh.num_cells + 1);
  s.pairs.material = View<int *>("material", n);
  s.pairs.cell = View<int *>("cell", n);
  s.state.record = View<double *[num_pair_fields]>("record", n);
  s.state.centroid = View<double *[2]>("centroid", n);
  s.regions.cell_region = View<int *>("cell_region", s.mesh.num_cells);
  s.regions.polygon = View<Region *>("polygon", n);
  auto const offset = Kokkos::create_mirror_view(s.pairs.offset);
  auto const material = Kokkos::create_mirror_view(s.pairs.material);
  auto const cell = Kokkos::create_mirror_view(s.pairs.cell);
  auto const record = Kokkos::create_mirror_view(s.state.record);
  auto const centroid = Kokkos::create_mirror_view(s.state.centroid);
  auto const first = Kokkos::create_mirror_view(s.regions.cell_region);
  auto const polygon = Kokkos::create_mirror_view(s.regions.polygon);
  Kokkos::deep_copy(first, -1);
  for (int i = 0; i < n; ++i)
  {
    int const c = static_cast<int>(list[i][0]), m = static_cast<int>(list[i][1]);
    ++offset(c + 1);
    cell(i) = c;
    material(i) = m;
    for (int f = 0; f < num_pair_fields; ++f)
      record(i, f) = fieldValue(global(c), m, f);
    record(i, VolumeFraction) = list[i][2];
    record(i, SpecificVolume) = 1e-3;
    for (int d = 0; d < 2; ++d)
      centroid(i, d) = fieldValue(global(c), m, 20 + d);
    if (list[i][2] < 1.0)
    {
      if (first(c) < 0)
        first(c) = i; // one polygon a pair: room for all
      double const x = 2.0 + 0.25 * m, y = static_cast<double>(global(c) / 4), w = list[i][2];
      Region r;
      r.push({x, y});
      r.push({x + w, y});
      r.push({x + w, y + 1.0});
      r.push({x, y + 1.0});
      polygon(i) = r;
    }
  }
  for (int c = 0; c < s.mesh.num_cells; ++c)
    offset(c + 1) += offset(c);
  Kokkos::deep_copy(s.pairs.offset, offset);
  Kokkos::deep_copy(s.pairs.material, material);
  Kokkos::deep_copy(s.pairs.cell, cell);
  Kokkos::deep_copy(s.state.record, record);
  Kokkos::deep_copy(s.state.centroid, centroid);
  Kokkos::deep_copy(s.regions.cell_region, first);
  Kokkos::deep_copy(s.regions.polygon, polygon);
  s.dof_nodes = buildDofNodes(s.mesh, kinematics, s.state.record, s.pairs);

  auto const node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.mesh.node_global);
  auto const dof_node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.dof_nodes.node);
  auto const dof_material = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.dof_nodes.material);
  s.state.velocity = View<double *[2]>("velocity", s.dof_nodes.num_dof_nodes);
  auto const velocity = Kokkos::create_mirror_view(s.state.velocity);
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
    for (int d = 0; d < 2; ++d)
      velocity(dof, d) = velocityValue(node(dof_node(dof)), dof_material(dof), d);
  Kokkos::deep_copy(s.state.velocity, velocity);

  s.materials = View<Material *>("materials", 2);
  auto const law = Kokkos::create_mirror_view(s.materials);
  for (int m = 0; m < 2; ++m)
  {
    law(m).density0 = 900.0;
    law(m).sound_speed0 = 2000.0 * (m + 1);
  }
  Kokkos::deep_copy(s.materials, law);
  return s;
}

} // namespace Harmos

#endif
