// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactRows.hpp>
#include <Harmos_LocalCell.hpp>
#include <Harmos_LowerBound.hpp>

#include <stdexcept>

namespace Harmos
{

PackedRows packedRows(View<int *> const &offset, int total, int width, WorkArrays const &work)
{
  return {offset, work.unset<double *>("Harmos::constrain::packed_rows", static_cast<std::size_t>(total) * width),
          width};
}

namespace
{

/// What travels of a row. Dof nodes and bodies follow from cells and materials.
enum RowItem : int
{
  ItemKey = 0,
  ItemCellB,
  ItemMaterialA,
  ItemMaterialB,
  ItemTied,
  ItemFriction,
  ItemRestitution,
  ItemWeightA,
  ItemWeightB = ItemWeightA + 4,
  ItemPoint = ItemWeightB + 4,
  ItemNormal = ItemPoint + 2,
  ItemGap = ItemNormal + 2,
  ItemLength,
  row_item_width
};

KOKKOS_INLINE_FUNCTION void packRow(Mesh const &mesh, ContactRow const &row, PackedRows const &item, int i)
{
  item(i, ItemKey) = static_cast<double>(row.key);
  item(i, ItemCellB) = static_cast<double>(mesh.cell_global(row.cell_b));
  item(i, ItemMaterialA) = row.material_a;
  item(i, ItemMaterialB) = row.material_b;
  item(i, ItemTied) = row.tied;
  item(i, ItemFriction) = row.friction;
  item(i, ItemRestitution) = row.restitution;
  for (int k = 0; k < 4; ++k)
  {
    item(i, ItemWeightA + k) = row.weight_a[k];
    item(i, ItemWeightB + k) = row.weight_b[k];
  }
  for (int d = 0; d < 2; ++d)
  {
    item(i, ItemPoint + d) = row.point[d];
    item(i, ItemNormal + d) = row.normal[d];
  }
  item(i, ItemGap) = row.gap;
  item(i, ItemLength) = row.length;
}

/// Dof nodes of a deformable side; false where this rank does not hold its pair.
KOKKOS_INLINE_FUNCTION bool findSide(CellMaterialPairs const &pairs, int cell, int material, int body, int dof[4])
{
  int const pair = body == -1 && cell >= 0 ? pairs.find(cell, material) : -1;
  for (int k = 0; k < 4; ++k)
    dof[k] = pair >= 0 ? pairs.dof_node(pair, k) : -1;
  return body != -1 || pair >= 0;
}

/// \return False where the row's cells or pairs are not on this rank.
KOKKOS_INLINE_FUNCTION bool unpackRow(Mesh const &mesh, CellMaterialPairs const &pairs, BodyTable const &bodies,
                                      PackedRows const &item, int i, ContactRow &row)
{
  row = {};
  row.key = static_cast<long long>(item(i, ItemKey));
  row.cell_a = localCell(mesh, row.key / max_cell_rows);
  row.cell_b = localCell(mesh, static_cast<long long>(item(i, ItemCellB)));
  row.material_a = static_cast<int>(item(i, ItemMaterialA));
  row.material_b = static_cast<int>(item(i, ItemMaterialB));
  row.tied = static_cast<int>(item(i, ItemTied));
  row.friction = item(i, ItemFriction);
  row.restitution = item(i, ItemRestitution);
  row.bond = -1; // its owner sums the load
  row.body_a = bodies.of_material(row.material_a);
  row.body_b = row.material_b < 0 ? -2 : bodies.of_material(row.material_b);
  for (int k = 0; k < 4; ++k)
  {
    row.weight_a[k] = item(i, ItemWeightA + k);
    row.weight_b[k] = item(i, ItemWeightB + k);
  }
  row.point = {item(i, ItemPoint), item(i, ItemPoint + 1)};
  row.normal = {item(i, ItemNormal), item(i, ItemNormal + 1)};
  row.gap = item(i, ItemGap);
  row.length = item(i, ItemLength);
  bool const a = findSide(pairs, row.cell_a, row.material_a, row.body_a, row.dof_a);
  bool const b = findSide(pairs, row.cell_b, row.material_b, row.body_b, row.dof_b);
  return a && b;
}

/// The first row whose slave cell is not below a cell.
KOKKOS_INLINE_FUNCTION int firstRowOf(View<ContactRow *> const &row, int count, int cell)
{
  return lowerBound(count, [&](int i) { return row(i).cell_a < cell; });
}

/// Sums of counts: entries + 1.
View<int *> offsetsOf(View<int *> const &count, int &total, WorkArrays const &work)
{
  int const entries = static_cast<int>(count.extent(0));
  View<int *> const offset = work.zeros<int *>("Harmos::constrain::travelling_offset", entries + 1);
  Kokkos::parallel_scan(
      "Harmos::constrain::offsetsOf", RangePolicy(0, entries),
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        sum += count(i);
        if (final)
          offset(i + 1) = sum;
      },
      total);
  return offset;
}

/// Where the rows of each cell begin among those of the rank and its halo: num_cells + 1.
View<int *> rowsByCell(Mesh const &mesh, ContactRows const &own, HaloCells const &halo, View<int *> const &received,
                       WorkArrays const &work)
{
  View<int *> const offset = work.zeros<int *>("Harmos::constrain::row_offset", mesh.num_cells + 1);
  View<ContactRow *> const row = own.row;
  View<int *> const cell = halo.received;
  Kokkos::parallel_for(
      "Harmos::constrain::countOwnRows", RangePolicy(0, own.count),
      KOKKOS_LAMBDA(int i) { Kokkos::atomic_add(&offset(row(i).cell_a + 1), 1); });
  Kokkos::parallel_for(
      "Harmos::constrain::countHaloRows", RangePolicy(0, received.extent(0)),
      KOKKOS_LAMBDA(int i) { offset(cell(i) + 1) = received(i); });
  Kokkos::parallel_scan(
      "Harmos::constrain::scanRowsByCell", RangePolicy(0, mesh.num_cells + 1),
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        sum += offset(i);
        if (final)
          offset(i) = sum;
      });
  return offset;
}

/// The own rows, packed as they travel.
void packRows(Mesh const &mesh, ContactRows const &own, HaloCells const &halo, PackedRows const &item)
{
  View<ContactRow *> const row = own.row;
  View<int *> const cell = halo.sent;
  int const count = own.count;
  PackedRows const packed = item;
  Kokkos::parallel_for(
      "Harmos::constrain::packRows", RangePolicy(0, cell.extent(0)), KOKKOS_LAMBDA(int i) {
        int const begin = packed.offset(i), end = packed.offset(i + 1);
        int const first = begin < end ? firstRowOf(row, count, cell(i)) : 0;
        for (int k = 0; k < end - begin; ++k)
          packRow(mesh, row(first + k), packed, begin + k);
      });
}

/// Numbers of the rows of listed cells.
View<int *> numbersOf(View<int *> const &cell, View<int *> const &offset, View<int *> const &by_cell, int total,
                      WorkArrays const &work)
{
  View<int *> const number = work.unset<int *>("Harmos::constrain::travelling_row", total);
  Kokkos::parallel_for(
      "Harmos::constrain::numbersOf", RangePolicy(0, cell.extent(0)), KOKKOS_LAMBDA(int i) {
        for (int k = 0; k < offset(i + 1) - offset(i); ++k)
          number(offset(i) + k) = by_cell(cell(i)) + k;
      });
  return number;
}

} // namespace

void exchangeContactRows(Mesh const &mesh, CellMaterialPairs const &pairs, BodyTable const &bodies,
                         Exchange const &exchange, ContactRows &rows, WorkArrays const &work)
{
  if (exchange.size() == 1)
    return;
  HaloCells const halo = exchange.haloCells(row_halo);
  View<int *> const sent_count = work.unset<int *>("Harmos::constrain::sent_count", halo.sent.extent(0));
  View<int *> const received_count = work.zeros<int *>("Harmos::constrain::received_count", halo.received.extent(0));
  ContactRows const own = rows;
  Kokkos::parallel_for(
      "Harmos::constrain::countSentRows", RangePolicy(0, halo.sent.extent(0)), KOKKOS_LAMBDA(int i) {
        int const cell = halo.sent(i);
        sent_count(i) = firstRowOf(own.row, own.count, cell + 1) - firstRowOf(own.row, own.count, cell);
      });
  exchange.exchangeCounts(sent_count, received_count, row_halo);
  TravellingRows &travelling = rows.travelling;
  int num_sent = 0, num_received = 0;
  travelling.sent_offset = offsetsOf(sent_count, num_sent, work);
  travelling.received_offset = offsetsOf(received_count, num_received, work);
  PackedRows const sent = packedRows(travelling.sent_offset, num_sent, row_item_width, work);
  PackedRows const received = packedRows(travelling.received_offset, num_received, row_item_width, work);
  packRows(mesh, own, halo, sent);
  exchange.exchangePacked(sent, received, row_halo);

  View<int *> const by_cell = rowsByCell(mesh, own, halo, received_count, work);
  travelling.sent = numbersOf(halo.sent, travelling.sent_offset, by_cell, num_sent, work);
  travelling.received = numbersOf(halo.received, travelling.received_offset, by_cell, num_received, work);
  rows.count = own.count + num_received;
  rows.row = work.unset<ContactRow *>("Harmos::constrain::row", rows.count);
  View<ContactRow *> const row = rows.row;
  View<int *> const own_number = rows.own, received_number = travelling.received;
  Kokkos::parallel_for(
      "Harmos::constrain::placeOwnRows", RangePolicy(0, own.count), KOKKOS_LAMBDA(int i) {
        int const cell = own.row(i).cell_a;
        own_number(i) = by_cell(cell) + i - firstRowOf(own.row, own.count, cell);
        row(own_number(i)) = own.row(i);
      });
  int missing = 0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::unpackRows", RangePolicy(0, num_received),
      KOKKOS_LAMBDA(int i, int &count) {
        if (!unpackRow(mesh, pairs, bodies, received, i, row(received_number(i))))
          ++count;
      },
      missing);
  if (missing > 0)
    throw std::runtime_error("contact rows: " + std::to_string(missing) + " touch pairs that rank " +
                             std::to_string(exchange.rank()) + " does not hold; the halo is too thin");
}

} // namespace Harmos
