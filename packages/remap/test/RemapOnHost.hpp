// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_ON_HOST_HPP
#define HARMOS_REMAP_ON_HOST_HPP

#include <Harmos_MeshBuilder.hpp>
#include <Harmos_OnHost.hpp>
#include <Harmos_Remap.hpp>

/// What goes into a remap and comes out of it, where the host can index it. Members are named as on the device; they
/// may share its memory.

namespace Harmos
{
namespace Test
{

struct RowsOnHost
{
  HostView<int *> offset, item;

  RowsOnHost() = default;
  explicit RowsOnHost(Rows const &rows) : offset(onHost(rows.offset)), item(onHost(rows.item)) {}
};

struct CornerSharesOnHost
{
  HostView<double *[4]> part; // empty: a quarter each

  CornerSharesOnHost() = default;
  explicit CornerSharesOnHost(CornerShares const &shares) : part(onHost(shares.part)) {}

  double operator()(int cell, int corner) const { return part.extent(0) == 0 ? 0.25 : part(cell, corner); }
};

struct MeshOnHost
{
  Mesh on_device;
  int num_cells = 0, num_nodes = 0;
  HostView<double *[2]> node_position; // moved here, it moves on the device by updateGeometry
  HostView<int *[4]> cell_node, face_neighbour;
  HostView<double *> cell_area, cell_volume;
  CornerSharesOnHost corner_share;
  RowsOnHost cell_neighbour;
  HostView<int *> cell_depth;
  HostView<long long *> cell_global, node_global;

  MeshOnHost() = default;
  explicit MeshOnHost(Mesh const &mesh)
      : on_device(mesh), num_cells(mesh.num_cells), num_nodes(mesh.num_nodes),
        node_position(onHost(mesh.node_position)), cell_node(onHost(mesh.cell_node)),
        face_neighbour(onHost(mesh.face_neighbour)), cell_area(onHost(mesh.cell_area)),
        cell_volume(onHost(mesh.cell_volume)), corner_share(mesh.corner_share), cell_neighbour(mesh.cell_neighbour),
        cell_depth(onHost(mesh.cell_depth)), cell_global(onHost(mesh.cell_global)),
        node_global(onHost(mesh.node_global))
  {
  }
};

inline Quadrilateral cellQuadrilateral(MeshOnHost const &mesh, int cell)
{
  Quadrilateral q;
  q.size = 4;
  for (int k = 0; k < 4; ++k)
  {
    int const node = mesh.cell_node(cell, k);
    q[k] = {mesh.node_position(node, 0), mesh.node_position(node, 1)};
  }
  return q;
}

/// After its nodes have been moved.
inline void updateGeometry(MeshOnHost &mesh)
{
  Kokkos::deep_copy(mesh.on_device.node_position, mesh.node_position);
  Harmos::updateGeometry(mesh.on_device);
  mesh = MeshOnHost(mesh.on_device);
}

struct PairsOnHost
{
  int num_pairs = 0;
  HostView<int *> offset, material, cell, cell_kind;
  HostView<int *[4]> dof_node;

  PairsOnHost() = default;
  explicit PairsOnHost(CellMaterialPairs const &pairs)
      : num_pairs(pairs.num_pairs), offset(onHost(pairs.offset)), material(onHost(pairs.material)),
        cell(onHost(pairs.cell)), cell_kind(onHost(pairs.cell_kind)), dof_node(onHost(pairs.dof_node))
  {
  }

  /// The pair of a material in a cell, or -1.
  int find(int in_cell, int of_material) const
  {
    for (int pair = offset(in_cell); pair < offset(in_cell + 1); ++pair)
      if (material(pair) == of_material)
        return pair;
    return -1;
  }
};

struct DofNodesOnHost
{
  int num_dof_nodes = 0;
  HostView<int *> offset, material, node;

  DofNodesOnHost() = default;
  explicit DofNodesOnHost(NodeMaterialPairs const &dof_nodes)
      : num_dof_nodes(dof_nodes.num_dof_nodes), offset(onHost(dof_nodes.offset)), material(onHost(dof_nodes.material)),
        node(onHost(dof_nodes.node))
  {
  }
};

struct StateOnHost
{
  HostView<double *[num_pair_fields]> record;
  HostView<double *[2]> centroid, velocity;
  bool tracks_damage = false;
  HostView<double *> damage;

  StateOnHost() = default;
  explicit StateOnHost(PairState const &state)
      : record(onHost(state.record)), centroid(onHost(state.centroid)), velocity(onHost(state.velocity)),
        tracks_damage(state.tracks_damage), damage(onHost(state.damage))
  {
  }
};

struct RegionsOnHost
{
  HostView<int *> cell_region;
  HostView<Region *> polygon;

  RegionsOnHost() = default;
  explicit RegionsOnHost(FilledRegions const &regions)
      : cell_region(onHost(regions.cell_region)), polygon(onHost(regions.polygon))
  {
  }

  /// The filled region of a pair, whatever the kind of its cell.
  Region region(MeshOnHost const &mesh, PairsOnHost const &pairs, int pair) const
  {
    int const cell = pairs.cell(pair), first = cell_region(cell);
    if (first >= 0)
      return polygon(first + pair - pairs.offset(cell));
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    Region r;
    for (int k = 0; k < 4; ++k)
      r.push(q[k]);
    return r;
  }
};

struct ResultOnHost
{
  PairsOnHost pairs;
  DofNodesOnHost dof_nodes;
  StateOnHost state;

  ResultOnHost() = default;
  explicit ResultOnHost(RemapResult const &result)
      : pairs(result.pairs), dof_nodes(result.dof_nodes), state(result.state)
  {
  }
};

} // namespace Test
} // namespace Harmos

#endif
