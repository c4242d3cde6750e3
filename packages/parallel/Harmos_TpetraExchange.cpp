// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_TpetraExchange.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Distributor.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>

#include <algorithm>
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

/// One end of the messages: local cells in the order of the Distributor.
struct CellList
{
  View<int *> cell;
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
  list.packets.resize(map_number.size());
}

/// Which owned cells lie within `depth` layers of vertex neighbours of a halo cell: no other rank holds the rest.
std::vector<char> cellsNearHalo(Mesh const &mesh, HostView<int *> const &cell_depth, int depth)
{
  auto const offset = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_neighbour.offset);
  auto const item = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_neighbour.item);
  std::vector<char> near(mesh.num_cells, 0);
  std::vector<int> front, next;
  for (int c = 0; c < mesh.num_cells; ++c)
    if (cell_depth(c) == 1)
      front.push_back(c);
  for (int layer = 0; layer < depth; ++layer)
  {
    next.clear();
    for (int const c : front)
      for (int i = offset(c); i < offset(c + 1); ++i)
        if (cell_depth(item(i)) == 0 && near[item(i)] == 0)
        {
          near[item(i)] = 1;
          next.push_back(item(i));
        }
    front.swap(next);
  }
  return near;
}

/// Source: owned cells that others hold; target: halo cells of depth <= `depth`. Both ascending.
std::unique_ptr<Pattern> makePattern(Teuchos::RCP<Teuchos::Comm<int> const> const &comm, Mesh const &mesh, int depth)
{
  auto const cell_depth = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_depth);
  auto const cell_global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_global);
  std::vector<char> const near = cellsNearHalo(mesh, cell_depth, depth);
  std::vector<GlobalOrdinal> owned_global, halo_global;
  std::vector<int> owned, halo;
  for (int c = 0; c < mesh.num_cells; ++c)
    if (near[c] == 1)
    {
      owned.push_back(c);
      owned_global.push_back(cell_global(c));
    }
    else if (cell_depth(c) > 0 && cell_depth(c) <= depth)
    {
      halo.push_back(c);
      halo_global.push_back(cell_global(c));
    }
  auto pattern = std::make_unique<Pattern>();
  pattern->import = Teuchos::rcp(new Import(mapOf(owned_global, comm), mapOf(halo_global, comm)));
  setCells(pattern->sent, pattern->import->getExportLIDs(), owned);
  setCells(pattern->received, pattern->import->getRemoteLIDs(), halo);
  return pattern;
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

std::vector<char> TpetraExchange::gather(std::vector<char> const &mine) const
{
  int const ranks = size();
  if (ranks == 1)
    return mine;
  Teuchos::Comm<int> const &comm = *implementation_->comm;
  std::vector<int> length(ranks);
  Teuchos::gatherAll(comm, 1, std::vector<int>{static_cast<int>(mine.size())}.data(), ranks, length.data());
  // Messages of one length: the longest.
  int const longest = *std::max_element(length.begin(), length.end());
  std::vector<char> sent(mine);
  sent.resize(longest);
  std::vector<char> received(static_cast<std::size_t>(ranks) * longest);
  Teuchos::gatherAll(comm, longest, sent.data(), ranks * longest, received.data());
  std::vector<char> all;
  for (int r = 0; r < ranks; ++r)
  {
    auto const first = received.begin() + static_cast<std::ptrdiff_t>(r) * longest;
    all.insert(all.end(), first, first + length[r]);
  }
  return all;
}

HaloCells TpetraExchange::haloCells(int depth) const
{
  Pattern const &pattern = implementation_->pattern(depth);
  return {pattern.sent.cell, pattern.received.cell};
}

void TpetraExchange::exchangeCounts(View<int *> const &sent, View<int *> const &received, int depth) const
{
  Pattern &pattern = implementation_->pattern(depth);
  checkEntries(pattern.sent, sent.extent(0));
  checkEntries(pattern.received, received.extent(0));
  if (size() == 1)
    return;
  auto const sent_host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sent);
  auto const received_host = Kokkos::create_mirror_view(received);
  pattern.import->getDistributor().doPostsAndWaits(sent_host, 1, received_host);
  Kokkos::deep_copy(received, received_host);
}

void TpetraExchange::exchangePacked(PackedRows const &sent, PackedRows const &received, int depth) const
{
  ScopedRegion const region("Harmos::parallel::exchangePacked");
  Pattern &pattern = implementation_->pattern(depth);
  setPackets(pattern.sent, sent);
  setPackets(pattern.received, received);
  if (size() == 1)
    return;
  auto const sent_host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sent.value);
  auto const received_host = Kokkos::create_mirror_view(received.value);
  using Counts = Teuchos::ArrayView<std::size_t const>;
  pattern.import->getDistributor().doPostsAndWaits(sent_host, Counts(pattern.sent.packets.data(), pattern.sent.size()),
                                                   received_host,
                                                   Counts(pattern.received.packets.data(), pattern.received.size()));
  Kokkos::deep_copy(received.value, received_host);
}

} // namespace Harmos
