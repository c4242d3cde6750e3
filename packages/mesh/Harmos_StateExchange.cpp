// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_StateExchange.hpp>

#include <Harmos_Prefetch.hpp>

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
  packet_width = PacketVelocity + 8, // without damage
  PacketDamage = packet_width
};

int packetWidth(PairState const &state)
{
  return packet_width + (state.tracks_damage ? 1 : 0);
}

template <class V>
V uninitialised(char const *label, int size)
{
  return V(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), size);
}

/// The pairs of listed cells, which lie far apart: where cells are numbered by rows each row holds a few of a halo.
/// A walk over them asks ahead for what it needs.
struct ScatteredPairs
{
  View<int *> cells;
  View<int *> offset;
  int num_pairs;
  RowPointer<int, 4> dof_node;
  RowPointer<double, 2> velocity;

  ScatteredPairs(View<int *> const &listed, CellMaterialPairs const &pairs, View<double *[2]> const &of_dof_nodes)
      : cells(listed), offset(pairs.offset), num_pairs(pairs.num_pairs), dof_node(pairs.dof_node),
        velocity(of_dof_nodes)
  {
  }

  /// The velocities of a pair's corners, to and from eight numbers.
  KOKKOS_FORCEINLINE_FUNCTION void readCorners(int pair, double *corner) const
  {
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < 2; ++d)
        corner[2 * k + d] = velocity(dof_node(pair, k), d);
  }
  KOKKOS_FORCEINLINE_FUNCTION void writeCorners(int pair, double const *corner) const
  {
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < 2; ++d)
        velocity(dof_node(pair, k), d) = corner[2 * k + d];
  }

  /// Where the corners are has to come before their velocities.
  KOKKOS_FORCEINLINE_FUNCTION void askForCorners(int i) const
  {
#ifdef HARMOS_VECTOR_TYPES
    prefetchToRead(dof_node.row(pairAhead(i, 2)));
    int const next = pairAhead(i, 1);
    for (int k = 0; k < 4 && next < num_pairs; ++k)
      prefetchToRead(velocity.row(dof_node(next, k)));
#else
    (void)i;
#endif
  }
  /// The first pair of the cell `steps` ahead of entry i; may be one that is not there.
  KOKKOS_FORCEINLINE_FUNCTION int pairAhead(int i, int steps) const
  {
    constexpr int step = 8;
    return offset(cells(Math::min(i + steps * step, static_cast<int>(cells.extent(0)) - 1)));
  }
};

/// The same with all that travels.
struct ScatteredStates : ScatteredPairs
{
  RowPointer<double, num_pair_fields> record;
  RowPointer<double, 2> centroid;
  double *damage;
  bool tracks_damage;

  ScatteredStates(View<int *> const &listed, CellMaterialPairs const &pairs, PairState const &state)
      : ScatteredPairs(listed, pairs, state.velocity), record(state.record), centroid(state.centroid),
        damage(state.damage.data()), tracks_damage(state.tracks_damage)
  {
  }

  KOKKOS_FORCEINLINE_FUNCTION void read(int pair, double *packet) const
  {
    for (int f = 0; f < num_pair_fields; ++f)
      packet[PacketRecord + f] = record(pair, f);
    for (int d = 0; d < 2; ++d)
      packet[PacketCentroid + d] = centroid(pair, d);
    readCorners(pair, packet + PacketVelocity);
    if (tracks_damage)
      packet[PacketDamage] = damage[pair];
  }
  KOKKOS_FORCEINLINE_FUNCTION void write(int pair, double const *packet) const
  {
    for (int f = 0; f < num_pair_fields; ++f)
      record(pair, f) = packet[PacketRecord + f];
    for (int d = 0; d < 2; ++d)
      centroid(pair, d) = packet[PacketCentroid + d];
    writeCorners(pair, packet + PacketVelocity);
    if (tracks_damage)
      damage[pair] = packet[PacketDamage];
  }
  KOKKOS_FORCEINLINE_FUNCTION void ask(int i) const
  {
    askForCorners(i);
    prefetchToRead(record.row(pairAhead(i, 1)));
    prefetchToRead(centroid.row(pairAhead(i, 1)));
  }
};

/// Numbers of pairs of the listed cells.
View<int *> countPairs(View<int *> const &cells, View<int *> const &pair_offset)
{
  auto const count = uninitialised<View<int *>>("Harmos::mesh::packet_count", static_cast<int>(cells.extent(0)));
  Kokkos::parallel_for(
      "Harmos::mesh::countPairs", RangePolicy(0, static_cast<int>(cells.extent(0))),
      KOKKOS_LAMBDA(int i) { count(i) = pair_offset(cells(i) + 1) - pair_offset(cells(i)); });
  return count;
}

/// Room for rows of the given numbers.
PackedRows makeRows(View<int *> const &count, int width)
{
  int const entries = static_cast<int>(count.extent(0));
  View<int *> const offset("Harmos::mesh::packet_offset", entries + 1);
  int total = 0;
  Kokkos::parallel_scan(
      "Harmos::mesh::packetOffsets", RangePolicy(0, entries),
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        sum += count(i);
        if (final)
          offset(i + 1) = sum;
      },
      total);
  auto const size = static_cast<std::size_t>(total) * width;
  return {offset,
          View<double *>(Kokkos::view_alloc(std::string("Harmos::mesh::packets"), Kokkos::WithoutInitializing), size),
          width};
}

void packPairs(View<int *> const &cells, CellMaterialPairs const &pairs, PairState const &state, PackedRows const &rows)
{
  auto const material = pairs.material;
  PackedRows const r = rows;
  ScatteredStates const states(cells, pairs, state);
  Kokkos::parallel_for(
      "Harmos::mesh::packPairs", RangePolicy(0, static_cast<int>(cells.extent(0))), KOKKOS_LAMBDA(int i) {
        states.ask(i);
        int const first = states.offset(cells(i)) - r.offset(i);
        for (int row = r.offset(i); row < r.offset(i + 1); ++row)
        {
          r(row, PacketMaterial) = material(first + row);
          states.read(first + row, &r(row, 0));
        }
      });
}

/// Whether the received cells hold the materials that came, so that the rows can stay where they are.
bool sameMaterials(View<int *> const &cells, PackedRows const &rows, CellMaterialPairs const &pairs)
{
  CellMaterialPairs const p = pairs;
  PackedRows const r = rows;
  int different = 0;
  Kokkos::parallel_reduce(
      "Harmos::mesh::sameMaterials", RangePolicy(0, static_cast<int>(cells.extent(0))),
      KOKKOS_LAMBDA(int i, int &sum) {
        int const first = p.offset(cells(i));
        int const count = r.offset(i + 1) - r.offset(i);
        bool same = p.offset(cells(i) + 1) - first == count;
        for (int k = 0; same && k < count; ++k)
          same = static_cast<int>(r(r.offset(i) + k, PacketMaterial)) == p.material(first + k);
        sum += same ? 0 : 1;
      },
      different);
  return different == 0;
}

/// Write records, centroids, kinds and the velocities of the corners. Pairs that share a dof node carry the same bits.
/// The kinds come in a view of their own where some change: others go by it.
void overwritePairs(View<int *> const &cells, PackedRows const &rows, CellMaterialPairs &pairs, PairState const &state)
{
  CellMaterialPairs const p = pairs;
  auto const record = state.record;
  PackedRows const r = rows;
  ScatteredStates const states(cells, pairs, state);
  int changed = 0;
  Kokkos::parallel_reduce(
      "Harmos::mesh::overwritePairs", RangePolicy(0, static_cast<int>(cells.extent(0))),
      KOKKOS_LAMBDA(int i, int &sum) {
        states.ask(i);
        int const cell = cells(i);
        int const first = p.offset(cell) - r.offset(i);
        for (int row = r.offset(i); row < r.offset(i + 1); ++row)
          states.write(first + row, &r(row, 0));
        sum += p.cell_kind(cell) != cellKind(p, record, cell) ? 1 : 0;
      },
      changed);
  if (changed == 0)
    return;
  View<int *> const kind = uninitialised<View<int *>>("Harmos::mesh::cell_kind", p.cell_kind.extent_int(0));
  Kokkos::deep_copy(kind, p.cell_kind);
  Kokkos::parallel_for(
      "Harmos::mesh::receivedKinds", RangePolicy(0, static_cast<int>(cells.extent(0))),
      KOKKOS_LAMBDA(int i) { kind(cells(i)) = cellKind(p, record, cells(i)); });
  pairs.cell_kind = kind;
}

/// Rows over all local cells: owned cells keep their pairs, received ones have what came, deeper ones nothing.
View<int *> joinOffsets(Mesh const &mesh, View<int *> const &old_offset, View<int *> const &cells,
                        PackedRows const &rows)
{
  View<int *> const count("Harmos::mesh::pair_count", mesh.num_cells);
  View<int *> const offset("Harmos::mesh::pair_offset", mesh.num_cells + 1);
  auto const depth = mesh.cell_depth;
  auto const received = rows.offset;
  Kokkos::parallel_for(
      "Harmos::mesh::receivedCounts", RangePolicy(0, static_cast<int>(cells.extent(0))),
      KOKKOS_LAMBDA(int i) { count(cells(i)) = received(i + 1) - received(i); });
  Kokkos::parallel_scan(
      "Harmos::mesh::joinOffsets", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int c, int &sum, bool final) {
        sum += depth(c) == 0 ? old_offset(c + 1) - old_offset(c) : count(c);
        if (final)
          offset(c + 1) = sum;
      });
  return offset;
}

/// Where new pairs come from: the old pair of an owned cell, or -1 - the received row.
View<int *> listSources(Mesh const &mesh, View<int *> const &old_offset, View<int *> const &cells,
                        PackedRows const &rows, CellMaterialPairs const &pairs)
{
  CellMaterialPairs const p = pairs;
  auto const depth = mesh.cell_depth;
  auto const received = rows.offset;
  auto const source = uninitialised<View<int *>>("Harmos::mesh::pair_source", p.num_pairs);
  Kokkos::parallel_for(
      "Harmos::mesh::ownedSources", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int c) {
        for (int pair = p.offset(c); pair < p.offset(c + 1); ++pair)
        {
          p.cell(pair) = c;
          if (depth(c) == 0)
            source(pair) = old_offset(c) + pair - p.offset(c);
        }
      });
  Kokkos::parallel_for(
      "Harmos::mesh::receivedSources", RangePolicy(0, static_cast<int>(cells.extent(0))), KOKKOS_LAMBDA(int i) {
        for (int k = 0; k < received(i + 1) - received(i); ++k)
          source(p.offset(cells(i)) + k) = -1 - (received(i) + k);
      });
  return source;
}

void gatherPairs(CellMaterialPairs const &old_pairs, PairState const &old_state, PackedRows const &rows,
                 View<int *> const &source, CellMaterialPairs const &pairs, PairState const &state)
{
  CellMaterialPairs const p = pairs, q = old_pairs;
  PairState const s = state, t = old_state;
  PackedRows const value = rows;
  Kokkos::parallel_for(
      "Harmos::mesh::gatherPairs", RangePolicy(0, p.num_pairs), KOKKOS_LAMBDA(int pair) {
        int const from = source(pair);
        int const row = -1 - from;
        p.material(pair) = from >= 0 ? q.material(from) : static_cast<int>(value(row, PacketMaterial));
        for (int f = 0; f < num_pair_fields; ++f)
          s.record(pair, f) = from >= 0 ? t.record(from, f) : value(row, PacketRecord + f);
        for (int d = 0; d < 2; ++d)
          s.centroid(pair, d) = from >= 0 ? t.centroid(from, d) : value(row, PacketCentroid + d);
        if (s.tracks_damage)
          s.damage(pair) = from >= 0 ? t.damage(from) : value(row, PacketDamage);
      });
}

/// Each dof node takes the corner velocity of the first pair around it that it moves.
View<double *[2]> gatherVelocities(Mesh const &mesh, CellMaterialPairs const &old_pairs,
                                   View<double *[2]> const &old_velocity, PackedRows const &rows,
                                   View<int *> const &source, CellMaterialPairs const &pairs,
                                   NodeMaterialPairs const &dof_nodes)
{
  Rows const node_cell = mesh.node_cell;
  CellMaterialPairs const p = pairs, q = old_pairs;
  NodeMaterialPairs const n = dof_nodes;
  PackedRows const value = rows;
  auto const velocity = uninitialised<View<double *[2]>>("Harmos::mesh::velocity", n.num_dof_nodes);
  Kokkos::parallel_for(
      "Harmos::mesh::gatherVelocities", RangePolicy(0, n.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        int const node = n.node(dof);
        for (int i = node_cell.offset(node); i < node_cell.offset(node + 1); ++i)
        {
          int const cell = node_cell.item(i) / 4;
          int const corner = node_cell.item(i) % 4;
          for (int pair = p.offset(cell); pair < p.offset(cell + 1); ++pair)
            if (p.dof_node(pair, corner) == dof)
            {
              int const from = source(pair);
              for (int d = 0; d < 2; ++d)
                velocity(dof, d) = from >= 0 ? old_velocity(q.dof_node(from, corner), d)
                                             : value(-1 - from, PacketVelocity + 2 * corner + d);
              return;
            }
        }
      });
  return velocity;
}

/// Pairs, dof nodes and state in new views, numbered anew.
void rebuildPairs(Mesh const &mesh, Kinematics kinematics, View<int *> const &cells, PackedRows const &rows,
                  CellMaterialPairs &pairs, NodeMaterialPairs &dof_nodes, PairState &state)
{
  CellMaterialPairs p;
  p.offset = joinOffsets(mesh, pairs.offset, cells, rows);
  Kokkos::deep_copy(p.num_pairs, Kokkos::subview(p.offset, mesh.num_cells));
  p.material = uninitialised<View<int *>>("Harmos::mesh::pair_material", p.num_pairs);
  p.cell = uninitialised<View<int *>>("Harmos::mesh::pair_cell", p.num_pairs);
  PairState s;
  s.record = uninitialised<View<double *[num_pair_fields]>>("Harmos::mesh::record", p.num_pairs);
  s.centroid = uninitialised<View<double *[2]>>("Harmos::mesh::centroid", p.num_pairs);
  s.tracks_damage = state.tracks_damage;
  if (s.tracks_damage)
    s.damage = uninitialised<View<double *>>("Harmos::mesh::damage", p.num_pairs);
  View<int *> const source = listSources(mesh, pairs.offset, cells, rows, p);
  gatherPairs(pairs, state, rows, source, p, s);
  dof_nodes = buildDofNodes(mesh, kinematics, s.record, p);
  s.velocity = gatherVelocities(mesh, pairs, state.velocity, rows, source, p, dof_nodes);
  pairs = p;
  state = s;
}

} // namespace

void exchangeState(Mesh const &mesh, Kinematics kinematics, Exchange const &exchange, int depth,
                   CellMaterialPairs &pairs, NodeMaterialPairs &dof_nodes, PairState &state)
{
  if (exchange.size() == 1)
    return;
  ScopedRegion const region("Harmos::mesh::exchangeState");
  HaloCells const halo = exchange.haloCells(depth);
  View<int *> const sent_count = countPairs(halo.sent, pairs.offset);
  auto const received_count =
      uninitialised<View<int *>>("Harmos::mesh::received_count", static_cast<int>(halo.received.extent(0)));
  exchange.exchangeCounts(sent_count, received_count, depth);
  PackedRows const sent = makeRows(sent_count, packetWidth(state));
  PackedRows const received = makeRows(received_count, packetWidth(state));
  packPairs(halo.sent, pairs, state, sent);
  exchange.exchangePacked(sent, received, depth);
  if (depth == mesh.halo && sameMaterials(halo.received, received, pairs))
    overwritePairs(halo.received, received, pairs, state);
  else
    rebuildPairs(mesh, kinematics, halo.received, received, pairs, dof_nodes, state);
}

void exchangeDofVelocities(Exchange const &exchange, int depth, CellMaterialPairs const &pairs,
                           View<double *[2]> const &velocity)
{
  if (exchange.size() == 1)
    return;
  ScopedRegion const region("Harmos::mesh::exchangeDofVelocities");
  HaloCells const halo = exchange.haloCells(depth);
  PackedRows const sent = makeRows(countPairs(halo.sent, pairs.offset), 8);
  PackedRows const received = makeRows(countPairs(halo.received, pairs.offset), 8);
  ScatteredPairs const from(halo.sent, pairs, velocity), to(halo.received, pairs, velocity);
  Kokkos::parallel_for(
      "Harmos::mesh::packCorners", RangePolicy(0, static_cast<int>(halo.sent.extent(0))), KOKKOS_LAMBDA(int i) {
        from.askForCorners(i);
        int const first = from.offset(from.cells(i)) - sent.offset(i);
        for (int row = sent.offset(i); row < sent.offset(i + 1); ++row)
          from.readCorners(first + row, &sent(row, 0));
      });
  exchange.exchangePacked(sent, received, depth);
  // Pairs that share a dof node write the same bits.
  Kokkos::parallel_for(
      "Harmos::mesh::unpackCorners", RangePolicy(0, static_cast<int>(halo.received.extent(0))), KOKKOS_LAMBDA(int i) {
        to.askForCorners(i);
        int const first = to.offset(to.cells(i)) - received.offset(i);
        for (int row = received.offset(i); row < received.offset(i + 1); ++row)
          to.writeCorners(first + row, &received(row, 0));
      });
}

void exchangeNodePositions(Mesh const &mesh, Exchange const &exchange, int depth, View<double *[2]> const &position)
{
  if (exchange.size() == 1)
    return;
  HaloCells const halo = exchange.haloCells(depth);
  View<int *> const sent_count("Harmos::mesh::sent_count", halo.sent.extent(0));
  View<int *> const received_count("Harmos::mesh::received_count", halo.received.extent(0));
  Kokkos::deep_copy(sent_count, 1);
  Kokkos::deep_copy(received_count, 1);
  PackedRows const sent = makeRows(sent_count, 8);
  PackedRows const received = makeRows(received_count, 8);
  auto const cell_node = mesh.cell_node;
  Kokkos::parallel_for(
      "Harmos::mesh::packPositions", RangePolicy(0, static_cast<int>(halo.sent.extent(0))), KOKKOS_LAMBDA(int i) {
        for (int k = 0; k < 8; ++k)
          sent(i, k) = position(cell_node(halo.sent(i), k / 2), k % 2);
      });
  exchange.exchangePacked(sent, received, depth);
  // Cells that share a node write the same bits.
  Kokkos::parallel_for(
      "Harmos::mesh::unpackPositions", RangePolicy(0, static_cast<int>(halo.received.extent(0))), KOKKOS_LAMBDA(int i) {
        for (int k = 0; k < 8; ++k)
          position(cell_node(halo.received(i), k / 2), k % 2) = received(i, k);
      });
}

} // namespace Harmos
