// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Partition.hpp>
#include <Harmos_TpetraExchange.hpp>

#include <Tpetra_Core.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

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

template <class V>
auto onHost(V const &view)
{
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
}

/// Rows of the local cells: right in owned ones, one row of rubbish in halo ones.
void makeRows(Mesh const &mesh, int width, View<int *> &offset, View<double **> &item)
{
  auto const depth = onHost(mesh.cell_depth);
  auto const global = onHost(mesh.cell_global);
  offset = View<int *>("offset", mesh.num_cells + 1);
  auto const host_offset = Kokkos::create_mirror_view(offset);
  for (int c = 0; c < mesh.num_cells; ++c)
    host_offset(c + 1) = host_offset(c) + (depth(c) == 0 ? rowsOf(global(c)) : 1);
  Kokkos::deep_copy(offset, host_offset);
  item = View<double **>("item", host_offset(mesh.num_cells), width);
  auto const host_item = Kokkos::create_mirror_view(item);
  Kokkos::deep_copy(host_item, -1.0);
  for (int c = 0; c < mesh.num_cells; ++c)
    for (int row = 0; depth(c) == 0 && row < rowsOf(global(c)); ++row)
      for (int f = 0; f < width; ++f)
        host_item(host_offset(c) + row, f) = valueOf(global(c), row, f, 0);
  Kokkos::deep_copy(item, host_item);
}

void expectRows(Mesh const &mesh, View<int *> const &offset, View<double **> const &item, int reach, int round)
{
  auto const depth = onHost(mesh.cell_depth);
  auto const global = onHost(mesh.cell_global);
  auto const o = onHost(offset);
  auto const v = onHost(item);
  ASSERT_EQ(static_cast<int>(v.extent(0)), o(mesh.num_cells));
  for (int c = 0; c < mesh.num_cells; ++c)
  {
    ASSERT_EQ(o(c + 1) - o(c), depth(c) <= reach ? rowsOf(global(c)) : 0) << "cell " << global(c);
    for (int row = 0; row < o(c + 1) - o(c); ++row)
      for (std::size_t f = 0; f < v.extent(1); ++f)
        ASSERT_EQ(v(o(c) + row, f), valueOf(global(c), row, static_cast<int>(f), round)) << "cell " << global(c);
  }
}

class Rows : public ::testing::TestWithParam<bool>
{
};

TEST_P(Rows, exchangeRows_everyHaloCellHasItsOwnersRowsBitForBit)
{
  Setting const s(GetParam());
  TpetraExchange const exchange(s.comm, s.mesh);
  for (int const reach : {3, 1, 2, 3})
    for (int const width : {1, 19})
    {
      View<int *> offset;
      View<double **> item;
      makeRows(s.mesh, width, offset, item);
      exchange.exchangeRows(offset, item, s.comm->getSize() > 1 ? reach : 0);
      expectRows(s.mesh, offset, item, reach, 0);
    }
}

TEST_P(Rows, updateRows_newValuesArriveWithTheKnownOffsets)
{
  Setting const s(GetParam());
  TpetraExchange const exchange(s.comm, s.mesh);
  int const reach = s.comm->getSize() > 1 ? 2 : 0;
  View<int *> offset;
  View<double **> item;
  makeRows(s.mesh, 3, offset, item);
  exchange.exchangeRows(offset, item, reach);
  auto const depth = onHost(s.mesh.cell_depth);
  auto const global = onHost(s.mesh.cell_global);
  auto const o = onHost(offset);
  for (int round = 1; round < 4; ++round)
  {
    auto const host = Kokkos::create_mirror_view(item);
    Kokkos::deep_copy(host, -1.0);
    for (int c = 0; c < s.mesh.num_cells; ++c)
      for (int row = 0; depth(c) == 0 && row < rowsOf(global(c)); ++row)
        for (int f = 0; f < 3; ++f)
          host(o(c) + row, f) = valueOf(global(c), row, f, round);
    Kokkos::deep_copy(item, host);
    exchange.updateRows(offset, item, reach);
    expectRows(s.mesh, offset, item, reach, round);
  }
}

INSTANTIATE_TEST_SUITE_P(MetisAndChequer, Rows, ::testing::Bool());

TEST(TpetraExchange, rowsOnOneRankOnly_othersReceiveWithoutSending)
{
  Setting const s(false);
  TpetraExchange const exchange(s.comm, s.mesh);
  auto const depth = onHost(s.mesh.cell_depth);
  auto const global = onHost(s.mesh.cell_global);
  View<int *> offset("offset", s.mesh.num_cells + 1);
  View<double **> item("item", s.comm->getRank() == 0 ? s.mesh.num_owned_cells : 0, 2);
  auto const host_offset = Kokkos::create_mirror_view(offset);
  auto const host_item = Kokkos::create_mirror_view(item);
  for (int c = 0; c < s.mesh.num_cells; ++c)
  {
    bool const mine = s.comm->getRank() == 0 && depth(c) == 0;
    host_offset(c + 1) = host_offset(c) + (mine ? 1 : 0);
    if (mine)
      host_item(host_offset(c), 0) = host_item(host_offset(c), 1) = static_cast<double>(global(c));
  }
  Kokkos::deep_copy(offset, host_offset);
  Kokkos::deep_copy(item, host_item);
  exchange.exchangeRows(offset, item, s.mesh.halo);
  auto const o = onHost(offset);
  auto const v = onHost(item);
  for (int c = 0; c < s.mesh.num_cells; ++c)
    for (int i = o(c); i < o(c + 1); ++i)
      EXPECT_EQ(v(i, 1), static_cast<double>(global(c)));
  double received = o(s.mesh.num_cells);
  exchange.sum(&received, 1);
  EXPECT_GE(received, s.comm->getSize() > 1 ? 1.0 : nx * ny);
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

TEST(TpetraExchange, oneRank_keepsTheViews)
{
  Setting const s(false);
  if (s.comm->getSize() != 1)
    GTEST_SKIP() << "for one rank: only there nothing is exchanged and the views stay the same";
  TpetraExchange const exchange(s.comm, s.mesh);
  View<int *> offset;
  View<double **> item;
  makeRows(s.mesh, 2, offset, item);
  View<int *> const before_offset = offset;
  View<double **> const before = item;
  exchange.exchangeRows(offset, item, 0);
  exchange.updateRows(offset, item, 0);
  EXPECT_EQ(offset.data(), before_offset.data());
  EXPECT_EQ(item.data(), before.data());
}

TEST(TpetraExchange, depthBeyondTheHalo_isRefused)
{
  Setting const s(false);
  if (s.comm->getSize() == 1)
    GTEST_SKIP() << "for two ranks or more: one rank exchanges nothing and refuses no depth";
  TpetraExchange const exchange(s.comm, s.mesh);
  View<int *> offset("offset", s.mesh.num_cells + 1);
  View<double **> item("item", 0, 1);
  EXPECT_THROW(exchange.exchangeRows(offset, item, halo + 1), std::runtime_error);
  View<int *> wrong("offset", s.mesh.num_cells);
  EXPECT_THROW(exchange.exchangeRows(wrong, item, 1), std::runtime_error);
}

} // namespace
