// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_OnHost.hpp>
#include <Harmos_Partition.hpp>
#include <Harmos_TpetraExchange.hpp>

#include <Tpetra_Core.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace
{

using namespace Harmos;

constexpr int nx = 23, ny = 19, halo = 3;

int rowsOf(long long cell)
{
  return static_cast<int>((cell * 7) % 5 == 0 ? 0 : cell % 4);
}

/// Full mantissas, so that every bit counts.
double valueOf(long long cell, int row, int column, int round)
{
  return std::sin(1.0 + cell + 0.37 * row + 91.0 * column + 7.0 * round);
}

struct Setting
{
  Teuchos::RCP<Teuchos::Comm<int> const> comm = Tpetra::getDefaultComm();
  Mesh mesh;

  explicit Setting(bool chequer)
  {
    HostMesh const whole = rectilinearMesh(gradedCoordinates(0.0, 1.0, nx, 1.0), gradedCoordinates(0.0, 1.0, ny, 1.0));
    std::vector<int> owner = partitionCells(whole, comm->getSize());
    for (int c = 0; chequer && c < nx * ny; ++c)
      owner[c] = (c % nx / 2 + c / nx / 3) % comm->getSize();
    mesh = buildLocalMesh(whole, owner, comm->getRank(), comm->getSize() > 1 ? halo : 0);
  }
};

/// Room for the rows of a list of cells, of which a cell has count(its global number).
template <class Count>
PackedRows makeRows(Mesh const &mesh, View<int *> const &cells, int width, Count count)
{
  auto const global = onHost(mesh.cell_global);
  auto const cell = onHost(cells);
  std::vector<int> offset(1, 0);
  for (std::size_t i = 0; i < cell.size(); ++i)
    offset.push_back(offset.back() + count(global(cell(i))));
  View<double *> const value("packed", static_cast<std::size_t>(offset.back()) * width);
  Kokkos::deep_copy(value, -1.0);
  return {deviceCopy("values", offset), value, width};
}

/// Calls visit(packed value, cell's global number, row, column) for all values of packed rows, on the host.
template <class Visit>
void forAll(Mesh const &mesh, View<int *> const &cells, PackedRows const &rows, Visit visit)
{
  auto const global = onHost(mesh.cell_global);
  auto const cell = onHost(cells);
  auto const offset = onHost(rows.offset);
  auto const value = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.value);
  for (std::size_t i = 0; i < cell.size(); ++i)
    for (int row = offset(i); row < offset(i + 1); ++row)
      for (int f = 0; f < rows.width; ++f)
        visit(value(static_cast<std::size_t>(row) * rows.width + f), global(cell(i)), row - offset(i), f);
  Kokkos::deep_copy(rows.value, value);
}

TEST(TpetraExchange, gathersTheItemsOfAllRanksInTheirOrder_whateverTheirNumbers)
{
  Setting const s(false);
  TpetraExchange const exchange(s.comm, s.mesh);
  std::vector<char> mine, expected;
  for (int r = 0; r < s.comm->getSize(); ++r)
  {
    std::vector<char> const of_rank((5 * r + 3) % 7, static_cast<char>('a' + r));
    expected.insert(expected.end(), of_rank.begin(), of_rank.end());
    if (r == s.comm->getRank())
      mine = of_rank;
  }
  EXPECT_EQ(exchange.gather(mine), expected);
}

class Rows : public ::testing::TestWithParam<bool>
{
};

TEST_P(Rows, haloCells_areOwnedOnesToSendAndEachHaloCellOnceToReceive)
{
  Setting const s(GetParam());
  TpetraExchange const exchange(s.comm, s.mesh);
  auto const depth = onHost(s.mesh.cell_depth);
  for (int reach = s.comm->getSize() > 1 ? 1 : 0; reach <= s.mesh.halo; ++reach)
  {
    HaloCells const halo = exchange.haloCells(reach);
    auto const sent = onHost(halo.sent);
    for (std::size_t i = 0; i < sent.size(); ++i)
      EXPECT_EQ(depth(sent(i)), 0);
    std::vector<int> times(s.mesh.num_cells, 0);
    auto const received = onHost(halo.received);
    for (std::size_t i = 0; i < received.size(); ++i)
      ++times[received(i)];
    for (int c = 0; c < s.mesh.num_cells; ++c)
      EXPECT_EQ(times[c], depth(c) > 0 && depth(c) <= reach ? 1 : 0);
  }
}

TEST_P(Rows, exchangedCountsAndPackedRows_areTheOwnersBitForBit)
{
  Setting const s(GetParam());
  TpetraExchange const exchange(s.comm, s.mesh);
  auto const global = onHost(s.mesh.cell_global);
  for (int const depth : {3, 1, 2, 3})
    for (int const width : {1, 19})
    {
      int const reach = s.comm->getSize() > 1 ? depth : 0;
      HaloCells const halo = exchange.haloCells(reach);
      std::vector<int> count;
      auto const sent_cell = onHost(halo.sent);
      for (std::size_t i = 0; i < sent_cell.size(); ++i)
        count.push_back(rowsOf(global(sent_cell(i))));
      View<int *> const received_count("received_count", halo.received.extent(0));
      exchange.exchangeCounts(deviceCopy("values", count), received_count, reach);
      auto const received = onHost(received_count);
      auto const received_cell = onHost(halo.received);
      for (std::size_t i = 0; i < received.size(); ++i)
        ASSERT_EQ(received(i), rowsOf(global(received_cell(i))));

      PackedRows const from = makeRows(s.mesh, halo.sent, width, rowsOf);
      PackedRows const to = makeRows(s.mesh, halo.received, width, rowsOf);
      for (int round = 0; round < 3; ++round)
      {
        forAll(s.mesh, halo.sent, from,
               [&](double &value, long long cell, int row, int f) { value = valueOf(cell, row, f, round); });
        exchange.exchangePacked(from, to, reach);
        forAll(s.mesh, halo.received, to,
               [&](double &value, long long cell, int row, int f)
               { ASSERT_EQ(value, valueOf(cell, row, f, round)) << "cell " << cell; });
      }
    }
}

INSTANTIATE_TEST_SUITE_P(MetisAndChequer, Rows, ::testing::Bool());

TEST(TpetraExchange, rowsFromTheLowHalfOfTheCells_othersReceiveWithoutSending)
{
  Setting const s(false);
  TpetraExchange const exchange(s.comm, s.mesh);
  auto const low = [](long long cell) { return cell < nx * ny / 2 ? 1 : 0; };
  HaloCells const halo = exchange.haloCells(s.mesh.halo);
  PackedRows const from = makeRows(s.mesh, halo.sent, 2, low);
  PackedRows const to = makeRows(s.mesh, halo.received, 2, low);
  forAll(s.mesh, halo.sent, from, [](double &value, long long cell, int, int) { value = static_cast<double>(cell); });
  exchange.exchangePacked(from, to, s.mesh.halo);
  forAll(s.mesh, halo.received, to,
         [](double &value, long long cell, int, int) { EXPECT_EQ(value, static_cast<double>(cell)); });
}

TEST(TpetraExchange, reductions_areThoseOfAllRanksInRankOrder)
{
  Setting const s(false);
  TpetraExchange const exchange(s.comm, s.mesh);
  int const ranks = s.comm->getSize(), rank = s.comm->getRank();
  EXPECT_EQ(exchange.rank(), rank);
  EXPECT_EQ(exchange.size(), ranks);
  EXPECT_EQ(exchange.min(1.5 + rank), 1.5);
  EXPECT_EQ(exchange.max(1.5 + rank), 0.5 + ranks);
  auto const term = [](int r, int i) { return (i == 0 ? 0.1 : 1e16 * (r % 2 == 0 ? 1 : -1)) * (r + 1) + 1.0 / 3.0; };
  double values[2] = {term(rank, 0), term(rank, 1)};
  double expected[2] = {term(0, 0), term(0, 1)};
  for (int r = 1; r < ranks; ++r)
    for (int i = 0; i < 2; ++i)
      expected[i] += term(r, i);
  exchange.sum(values, 2);
  EXPECT_EQ(values[0], expected[0]);
  EXPECT_EQ(values[1], expected[1]);
  long long counts[2] = {1ll << 61, rank + 1};
  counts[0] /= ranks;
  exchange.sum(counts, 2);
  EXPECT_EQ(counts[0], 1ll << 61);
  EXPECT_EQ(counts[1], ranks * (ranks + 1) / 2);
}

TEST(TpetraExchange, depthBeyondTheHaloOrWrongNumberOfEntries_isRefused)
{
  Setting const s(false);
  TpetraExchange const exchange(s.comm, s.mesh);
  EXPECT_THROW(exchange.haloCells(halo + 1), std::runtime_error);
  int const reach = s.comm->getSize() > 1 ? 1 : 0;
  HaloCells const cells = exchange.haloCells(reach);
  View<int *> const few("few", cells.sent.extent(0) + 1), right("right", cells.received.extent(0));
  EXPECT_THROW(exchange.exchangeCounts(few, right, reach), std::runtime_error);
}

} // namespace
