// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_StateExchange.hpp>

#include <string>

namespace Harmos
{

namespace
{

/// Columns of a travelling pair.
enum PairPacket : int
{
  PacketMaterial = 0,
  PacketRecord = 1,
  PacketCentroid = PacketRecord + num_pair_fields,
  PacketVelocity = PacketCentroid + 2,
  packet_width = PacketVelocity + 8
};

template <class V>
V uninitialised(char const *label, int size)
{
  return V(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), size);
}

View<double **> packPairs(CellMaterialPairs const &pairs, PairState const &state)
{
  CellMaterialPairs const p = pairs;
  PairState const s = state;
  View<double **> packet(Kokkos::view_alloc(std::string("Harmos::mesh::pair_packet"), Kokkos::WithoutInitializing),
                         p.num_pairs, static_cast<int>(packet_width));
  Kokkos::parallel_for(
      "Harmos::mesh::packPairs", RangePolicy(0, p.num_pairs), KOKKOS_LAMBDA(int pair) {
        packet(pair, PacketMaterial) = p.material(pair);
        for (int f = 0; f < num_pair_fields; ++f)
          packet(pair, PacketRecord + f) = s.record(pair, f);
        for (int d = 0; d < 2; ++d)
          packet(pair, PacketCentroid + d) = s.centroid(pair, d);
        for (int k = 0; k < 4; ++k)
          for (int d = 0; d < 2; ++d)
            packet(pair, PacketVelocity + 2 * k + d) = s.velocity(p.dof_node(pair, k), d);
      });
  return packet;
}

void unpackPairs(Mesh const &mesh, View<int *> const &offset, View<double **> const &packet, CellMaterialPairs &pairs,
                 PairState &state)
{
  int const num_pairs = static_cast<int>(packet.extent(0));
  CellMaterialPairs p;
  p.num_pairs = num_pairs;
  p.offset = offset;
  p.material = uninitialised<View<int *>>("Harmos::mesh::pair_material", num_pairs);
  p.cell = uninitialised<View<int *>>("Harmos::mesh::pair_cell", num_pairs);
  PairState s;
  s.record = uninitialised<View<double *[num_pair_fields]>>("Harmos::mesh::record", num_pairs);
  s.centroid = uninitialised<View<double *[2]>>("Harmos::mesh::centroid", num_pairs);
  Kokkos::parallel_for(
      "Harmos::mesh::unpackPairs", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        for (int pair = offset(cell); pair < offset(cell + 1); ++pair)
        {
          p.cell(pair) = cell;
          p.material(pair) = static_cast<int>(packet(pair, PacketMaterial));
          for (int f = 0; f < num_pair_fields; ++f)
            s.record(pair, f) = packet(pair, PacketRecord + f);
          for (int d = 0; d < 2; ++d)
            s.centroid(pair, d) = packet(pair, PacketCentroid + d);
        }
      });
  pairs = p;
  state = s;
}

/// Each dof node takes the corner velocity of the first pair around it that it moves.
View<double *[2]> velocityFromCorners(Mesh const &mesh, View<double **> const &packet, CellMaterialPairs const &pairs,
                                      NodeMaterialPairs const &dof_nodes)
{
  Rows const node_cell = mesh.node_cell;
  CellMaterialPairs const p = pairs;
  NodeMaterialPairs const n = dof_nodes;
  auto const velocity = uninitialised<View<double *[2]>>("Harmos::mesh::velocity", n.num_dof_nodes);
  Kokkos::parallel_for(
      "Harmos::mesh::velocityFromCorners", RangePolicy(0, n.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        int const node = n.node(dof);
        for (int i = node_cell.offset(node); i < node_cell.offset(node + 1); ++i)
        {
          int const cell = node_cell.item(i) / 4;
          int const corner = node_cell.item(i) % 4;
          for (int pair = p.offset(cell); pair < p.offset(cell + 1); ++pair)
            if (p.dof_node(pair, corner) == dof)
            {
              velocity(dof, 0) = packet(pair, PacketVelocity + 2 * corner);
              velocity(dof, 1) = packet(pair, PacketVelocity + 2 * corner + 1);
              return;
            }
        }
      });
  return velocity;
}

} // namespace

void exchangeState(Mesh const &mesh, Kinematics kinematics, Exchange const &exchange, int depth,
                   CellMaterialPairs &pairs, NodeMaterialPairs &dof_nodes, PairState &state)
{
  if (exchange.size() == 1)
    return;
  ScopedRegion const region("Harmos::mesh::exchangeState");
  View<int *> offset = pairs.offset;
  View<double **> packet = packPairs(pairs, state);
  exchange.exchangeRows(offset, packet, depth);
  unpackPairs(mesh, offset, packet, pairs, state);
  dof_nodes = buildDofNodes(mesh, kinematics, state.record, pairs);
  state.velocity = velocityFromCorners(mesh, packet, pairs, dof_nodes);
}

void exchangeDofVelocities(Mesh const &mesh, Exchange const &exchange, CellMaterialPairs const &pairs,
                           View<double *[2]> const &velocity)
{
  if (exchange.size() == 1)
    return;
  ScopedRegion const region("Harmos::mesh::exchangeDofVelocities");
  CellMaterialPairs const p = pairs;
  View<double **> const item("Harmos::mesh::corner_velocity", p.num_pairs, 8);
  Kokkos::parallel_for(
      "Harmos::mesh::packCorners", RangePolicy(0, p.num_pairs), KOKKOS_LAMBDA(int pair) {
        for (int i = 0; i < 8; ++i)
          item(pair, i) = velocity(p.dof_node(pair, i / 2), i % 2);
      });
  exchange.updateRows(p.offset, item, mesh.halo);
  // Pairs that share a dof node write the same bits. Owned cells keep what they have.
  Kokkos::parallel_for(
      "Harmos::mesh::unpackCorners", RangePolicy(0, p.num_pairs), KOKKOS_LAMBDA(int pair) {
        if (mesh.cell_depth(p.cell(pair)) == 0)
          return;
        for (int i = 0; i < 8; ++i)
          velocity(p.dof_node(pair, i / 2), i % 2) = item(pair, i);
      });
}

} // namespace Harmos
