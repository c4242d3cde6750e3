// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_TpetraExchange.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Distributor.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace Harmos
{

namespace
{

using Map = Tpetra::Map<>;
using Import = Tpetra::Import<>;
using GlobalOrdinal = Map::global_ordinal_type;

/// A buffer that grows as needed, with its copy on the host that MPI reads and writes (the same memory on hosts).
template <class T>
struct Buffer
{
  View<T *> device;
  HostView<T *> host;

  void reserve(std::size_t size)
  {
    if (device.extent(0) >= size)
      return;
    std::size_t const capacity = size + size / 4;
    device =
        View<T *>(Kokkos::view_alloc(std::string("Harmos::parallel::buffer"), Kokkos::WithoutInitializing), capacity);
    host = Kokkos::create_mirror_view(device);
  }
  void toHost() const { Kokkos::deep_copy(host, device); }
  void toDevice() const { Kokkos::deep_copy(device, host); }
};

/// One end of the messages: local cells in the order of the Distributor, and their rows' places in a packed buffer.
struct CellList
{
  View<int *> cell;
  Buffer<int> begin;                // first packed row of each cell, and their total
  Buffer<double> values;            // packed rows
  std::vector<std::size_t> packets; // numbers that travel for each cell

  int size() const { return static_cast<int>(cell.extent(0)); }
};

struct Pattern
{
  Teuchos::RCP<Import const> import;
  CellList sent;
  CellList received;
};

Teuchos::RCP<Map const> mapOf(std::vector<GlobalOrdinal> const &cells,
                              Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  auto const unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return Teuchos::rcp(new Map(
      unknown, Teuchos::ArrayView<GlobalOrdinal const>(cells.data(), static_cast<Teuchos_Ordinal>(cells.size())), 0,
      comm));
}

/// Local cells behind the local numbers of a Map.
void setCells(CellList &list, Teuchos::ArrayView<Map::local_ordinal_type const> const &map_number,
              std::vector<int> const &cell_of)
{
  list.cell = View<int *>("Harmos::parallel::cell_list", map_number.size());
  auto const host = Kokkos::create_mirror_view(list.cell);
  for (Teuchos_Ordinal i = 0; i < map_number.size(); ++i)
    host(i) = cell_of[map_number[i]];
  Kokkos::deep_copy(list.cell, host);
  list.begin.reserve(map_number.size() + 1);
  list.packets.resize(map_number.size());
}

/// Source: owned cells; target: all cells of depth <= `depth`. Both in the mesh's own (ascending) order, interleaved.
std::unique_ptr<Pattern> makePattern(Teuchos::RCP<Teuchos::Comm<int> const> const &comm, Mesh const &mesh, int depth)
{
  auto const cell_depth = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_depth);
  auto const cell_global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_global);
  std::vector<GlobalOrdinal> owned_global, overlapping_global;
  std::vector<int> owned, overlapping;
  auto pattern = std::make_unique<Pattern>();
  for (int c = 0; c < mesh.num_cells; ++c)
  {
    if (cell_depth(c) > depth)
      continue;
    overlapping.push_back(c);
    overlapping_global.push_back(cell_global(c));
    if (cell_depth(c) == 0)
    {
      owned.push_back(c);
      owned_global.push_back(cell_global(c));
    }
  }
  pattern->import = Teuchos::rcp(new Import(mapOf(owned_global, comm), mapOf(overlapping_global, comm)));
  setCells(pattern->sent, pattern->import->getExportLIDs(), owned);
  setCells(pattern->received, pattern->import->getRemoteLIDs(), overlapping);
  return pattern;
}

/// Numbers of rows of the listed cells, from the offsets, into list.begin (not yet summed).
void readCounts(CellList const &list, View<int *> const &offset)
{
  auto const cell = list.cell;
  auto const count = list.begin.device;
  Kokkos::parallel_for(
      "Harmos::parallel::readCounts", RangePolicy(0, list.size()),
      KOKKOS_LAMBDA(int i) { count(i) = offset(cell(i) + 1) - offset(cell(i)); });
  list.begin.toHost();
}

/// From counts to places: packets for each cell, an exclusive sum in begin, room for the values.
void placeRows(CellList &list, int width)
{
  int total = 0;
  for (int i = 0; i < list.size(); ++i)
  {
    int const count = list.begin.host(i);
    list.packets[i] = static_cast<std::size_t>(count) * width;
    list.begin.host(i) = total;
    total += count;
  }
  list.begin.host(list.size()) = total;
  list.begin.toDevice();
  list.values.reserve(static_cast<std::size_t>(total) * width);
}

void pack(CellList const &list, View<int *> const &offset, View<double **> const &item)
{
  int const width = static_cast<int>(item.extent(1));
  auto const cell = list.cell;
  auto const begin = list.begin.device;
  auto const values = list.values.device;
  Kokkos::parallel_for(
      "Harmos::parallel::pack", RangePolicy(0, list.size()), KOKKOS_LAMBDA(int i) {
        int const from = offset(cell(i));
        for (int row = 0; row < begin(i + 1) - begin(i); ++row)
          for (int f = 0; f < width; ++f)
            values((begin(i) + row) * width + f) = item(from + row, f);
      });
  list.values.toHost();
}

void unpack(CellList const &list, View<int *> const &offset, View<double **> const &item)
{
  list.values.toDevice();
  int const width = static_cast<int>(item.extent(1));
  auto const cell = list.cell;
  auto const begin = list.begin.device;
  auto const values = list.values.device;
  Kokkos::parallel_for(
      "Harmos::parallel::unpack", RangePolicy(0, list.size()), KOKKOS_LAMBDA(int i) {
        int const to = offset(cell(i));
        for (int row = 0; row < begin(i + 1) - begin(i); ++row)
          for (int f = 0; f < width; ++f)
            item(to + row, f) = values((begin(i) + row) * width + f);
      });
}

template <class V>
V firstOf(V const &view, std::size_t size)
{
  return Kokkos::subview(view, std::make_pair(std::size_t(0), size));
}

/// The message round: packed values of `sent` become those of `received`.
void sendValues(Pattern &pattern, int width)
{
  std::size_t const num_sent = static_cast<std::size_t>(pattern.sent.begin.host(pattern.sent.size())) * width;
  std::size_t const num_received =
      static_cast<std::size_t>(pattern.received.begin.host(pattern.received.size())) * width;
  using Counts = Teuchos::ArrayView<std::size_t const>;
  pattern.import->getDistributor().doPostsAndWaits(firstOf(pattern.sent.values.host, num_sent),
                                                   Counts(pattern.sent.packets.data(), pattern.sent.size()),
                                                   firstOf(pattern.received.values.host, num_received),
                                                   Counts(pattern.received.packets.data(), pattern.received.size()));
}

/// Offsets over all local cells: own counts of owned cells, what came for halo cells, nothing for deeper ones.
View<int *> joinCounts(Pattern const &pattern, Mesh const &mesh, View<int *> const &old_offset)
{
  View<int *> const count("Harmos::parallel::row_count", mesh.num_cells);
  View<int *> const offset("Harmos::parallel::row_offset", mesh.num_cells + 1);
  auto const depth = mesh.cell_depth;
  Kokkos::parallel_for(
      "Harmos::parallel::ownCounts", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int c) { count(c) = depth(c) == 0 ? old_offset(c + 1) - old_offset(c) : 0; });
  auto const cell = pattern.received.cell;
  auto const received = pattern.received.begin.device;
  Kokkos::parallel_for(
      "Harmos::parallel::receivedCounts", RangePolicy(0, pattern.received.size()),
      KOKKOS_LAMBDA(int i) { count(cell(i)) = received(i); });
  Kokkos::parallel_scan(
      "Harmos::parallel::joinCounts", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int c, int &sum, bool final) {
        sum += count(c);
        if (final)
          offset(c + 1) = sum;
      });
  return offset;
}

void copyOwnedRows(Mesh const &mesh, View<int *> const &from_offset, View<double **> const &from,
                   View<int *> const &to_offset, View<double **> const &to)
{
  int const width = static_cast<int>(from.extent(1));
  auto const depth = mesh.cell_depth;
  Kokkos::parallel_for(
      "Harmos::parallel::copyOwnedRows", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int c) {
        if (depth(c) != 0)
          return;
        for (int row = 0; row < to_offset(c + 1) - to_offset(c); ++row)
          for (int f = 0; f < width; ++f)
            to(to_offset(c) + row, f) = from(from_offset(c) + row, f);
      });
}

void checkEntries(CellList const &list, std::size_t entries)
{
  if (entries != static_cast<std::size_t>(list.size()))
    throw std::runtime_error("exchange: " + std::to_string(entries) + " entries for a list of " +
                             std::to_string(list.size()) + " cells");
}

/// Numbers that travel for each entry of a list.
void setPackets(CellList &list, PackedRows const &rows)
{
  checkEntries(list, rows.offset.extent(0) - 1);
  auto const offset = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.offset);
  for (int i = 0; i < list.size(); ++i)
    list.packets[i] = static_cast<std::size_t>(offset(i + 1) - offset(i)) * rows.width;
}

int lastOffset(View<int *> const &offset)
{
  int last = 0;
  Kokkos::deep_copy(last, Kokkos::subview(offset, offset.extent(0) - 1));
  return last;
}

} // namespace

struct TpetraExchange::Implementation
{
  Teuchos::RCP<Teuchos::Comm<int> const> comm;
  Mesh mesh;
  std::map<int, std::unique_ptr<Pattern>> patterns; // by depth
  std::vector<double> gathered;

  Pattern &pattern(int depth)
  {
    if (depth < 0 || depth > mesh.halo)
      throw std::runtime_error("exchange: depth " + std::to_string(depth) + " is not in [0, " +
                               std::to_string(mesh.halo) + "], the mesh's halo");
    std::unique_ptr<Pattern> &found = patterns[depth];
    if (!found)
      found = makePattern(comm, mesh, depth);
    return *found;
  }

  Pattern &pattern(View<int *> const &offset, int depth)
  {
    if (offset.extent(0) != static_cast<std::size_t>(mesh.num_cells) + 1)
      throw std::runtime_error("exchange: " + std::to_string(offset.extent(0)) + " offsets for " +
                               std::to_string(mesh.num_cells) + " local cells");
    return pattern(depth);
  }
};

TpetraExchange::TpetraExchange(Teuchos::RCP<Teuchos::Comm<int> const> const &comm, Mesh const &mesh)
    : implementation_(std::make_unique<Implementation>())
{
  implementation_->comm = comm;
  implementation_->mesh = mesh;
}

TpetraExchange::~TpetraExchange() = default;

int TpetraExchange::rank() const
{
  return implementation_->comm->getRank();
}

int TpetraExchange::size() const
{
  return implementation_->comm->getSize();
}

double TpetraExchange::min(double value) const
{
  double result = value;
  Teuchos::reduceAll(*implementation_->comm, Teuchos::REDUCE_MIN, value, Teuchos::outArg(result));
  return result;
}

double TpetraExchange::max(double value) const
{
  double result = value;
  Teuchos::reduceAll(*implementation_->comm, Teuchos::REDUCE_MAX, value, Teuchos::outArg(result));
  return result;
}

void TpetraExchange::sum(double *values, int count) const
{
  int const ranks = size();
  if (ranks == 1 || count == 0)
    return;
  std::vector<double> &all = implementation_->gathered;
  all.resize(static_cast<std::size_t>(ranks) * count);
  Teuchos::gatherAll(*implementation_->comm, count, values, ranks * count, all.data());
  for (int i = 0; i < count; ++i)
  {
    values[i] = all[i];
    for (int r = 1; r < ranks; ++r)
      values[i] += all[static_cast<std::size_t>(r) * count + i];
  }
}

void TpetraExchange::sum(long long *values, int count) const
{
  if (size() == 1 || count == 0)
    return;
  std::vector<long long> const mine(values, values + count);
  Teuchos::reduceAll(*implementation_->comm, Teuchos::REDUCE_SUM, count, mine.data(), values);
}

HaloCells TpetraExchange::haloCells(int depth) const
{
  if (size() == 1)
    return {};
  Pattern const &pattern = implementation_->pattern(depth);
  return {pattern.sent.cell, pattern.received.cell};
}

void TpetraExchange::exchangeCounts(View<int *> const &sent, View<int *> const &received, int depth) const
{
  if (size() == 1)
    return;
  Pattern &pattern = implementation_->pattern(depth);
  checkEntries(pattern.sent, sent.extent(0));
  checkEntries(pattern.received, received.extent(0));
  auto const sent_host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sent);
  auto const received_host = Kokkos::create_mirror_view(received);
  pattern.import->getDistributor().doPostsAndWaits(sent_host, 1, received_host);
  Kokkos::deep_copy(received, received_host);
}

void TpetraExchange::exchangePacked(PackedRows const &sent, PackedRows const &received, int depth) const
{
  if (size() == 1)
    return;
  ScopedRegion const region("Harmos::parallel::exchangePacked");
  Pattern &pattern = implementation_->pattern(depth);
  setPackets(pattern.sent, sent);
  setPackets(pattern.received, received);
  auto const sent_host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sent.value);
  auto const received_host = Kokkos::create_mirror_view(received.value);
  using Counts = Teuchos::ArrayView<std::size_t const>;
  pattern.import->getDistributor().doPostsAndWaits(sent_host, Counts(pattern.sent.packets.data(), pattern.sent.size()),
                                                   received_host,
                                                   Counts(pattern.received.packets.data(), pattern.received.size()));
  Kokkos::deep_copy(received.value, received_host);
}

void TpetraExchange::exchangeRows(View<int *> &offset, View<double **> &item, int depth) const
{
  if (size() == 1)
    return;
  ScopedRegion const region("Harmos::parallel::exchangeRows");
  Pattern &pattern = implementation_->pattern(offset, depth);
  Mesh const &mesh = implementation_->mesh;
  int const width = static_cast<int>(item.extent(1));

  readCounts(pattern.sent, offset);
  pattern.import->getDistributor().doPostsAndWaits(firstOf(pattern.sent.begin.host, pattern.sent.size()), 1,
                                                   firstOf(pattern.received.begin.host, pattern.received.size()));
  pattern.received.begin.toDevice();
  View<int *> const new_offset = joinCounts(pattern, mesh, offset);
  View<double **> const new_item(Kokkos::view_alloc(std::string("Harmos::parallel::rows"), Kokkos::WithoutInitializing),
                                 lastOffset(new_offset), width);
  placeRows(pattern.sent, width);
  placeRows(pattern.received, width);
  pack(pattern.sent, offset, item);
  sendValues(pattern, width);
  copyOwnedRows(mesh, offset, item, new_offset, new_item);
  unpack(pattern.received, new_offset, new_item);
  offset = new_offset;
  item = new_item;
}

void TpetraExchange::updateRows(View<int *> const &offset, View<double **> const &item, int depth) const
{
  if (size() == 1)
    return;
  ScopedRegion const region("Harmos::parallel::updateRows");
  Pattern &pattern = implementation_->pattern(offset, depth);
  int const width = static_cast<int>(item.extent(1));
  readCounts(pattern.sent, offset);
  readCounts(pattern.received, offset);
  placeRows(pattern.sent, width);
  placeRows(pattern.received, width);
  pack(pattern.sent, offset, item);
  sendValues(pattern, width);
  unpack(pattern.received, offset, item);
}

} // namespace Harmos
