// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_OnHost.hpp>
#include <Harmos_Partition.hpp>
#include <Harmos_StateExchange.hpp>
#include <Harmos_TpetraExchange.hpp>

#include <Tpetra_Core.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace
{

using namespace Harmos;

constexpr int nx = 17, ny = 15;

/// The truth, by global numbers: materials of a cell, a pair's record, a dof node's velocity.
bool present(long long cell, int material)
{
  return (cell * (material + 3)) % 7 < 3 && cell % 11 != 0;
}
double recordOf(long long cell, int material, int field)
{
  return std::cos(cell + 0.1 * material + 31.0 * field);
}
double velocityOf(long long node, int material, int d)
{
  return std::sin(node + 0.7 * material + 13.0 * d);
}

constexpr int num_materials = 5;

struct Fields
{
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
};

/// The truth on a local mesh; `spoil` turns the halo into something else.
Fields makeFields(Mesh const &mesh, Kinematics kinematics, bool spoil)
{
  auto const depth = onHost(mesh.cell_depth);
  auto const global = onHost(mesh.cell_global);
  Fields f;
  std::vector<int> cell, material;
  f.pairs.offset = View<int *>("offset", mesh.num_cells + 1);
  auto const offset = Kokkos::create_mirror_view(f.pairs.offset);
  for (int c = 0; c < mesh.num_cells; ++c)
  {
    for (int m = 0; m < num_materials; ++m)
      if (spoil && depth(c) > 0 ? m == 3 : present(global(c), m))
      {
        cell.push_back(c);
        material.push_back(m);
      }
    offset(c + 1) = static_cast<int>(cell.size());
  }
  Kokkos::deep_copy(f.pairs.offset, offset);
  int const n = f.pairs.num_pairs = static_cast<int>(cell.size());
  f.pairs.cell = View<int *>("cell", n);
  f.pairs.material = View<int *>("material", n);
  f.state.record = View<double *[num_pair_fields]>("record", n);
  f.state.centroid = View<double *[2]>("centroid", n);
  auto const pair_cell = Kokkos::create_mirror_view(f.pairs.cell);
  auto const pair_material = Kokkos::create_mirror_view(f.pairs.material);
  auto const record = Kokkos::create_mirror_view(f.state.record);
  auto const centroid = Kokkos::create_mirror_view(f.state.centroid);
  for (int p = 0; p < n; ++p)
  {
    pair_cell(p) = cell[p];
    pair_material(p) = material[p];
    bool const rubbish = spoil && depth(cell[p]) > 0;
    for (int k = 0; k < num_pair_fields; ++k)
      record(p, k) = rubbish ? -9.0 : recordOf(global(cell[p]), material[p], k);
    for (int d = 0; d < 2; ++d)
      centroid(p, d) = rubbish ? -9.0 : recordOf(global(cell[p]), material[p], 8 + d);
  }
  Kokkos::deep_copy(f.pairs.cell, pair_cell);
  Kokkos::deep_copy(f.pairs.material, pair_material);
  Kokkos::deep_copy(f.state.record, record);
  Kokkos::deep_copy(f.state.centroid, centroid);
  f.dof_nodes = buildDofNodes(mesh, kinematics, f.state.record, f.pairs);
  f.state.velocity = View<double *[2]>("velocity", f.dof_nodes.num_dof_nodes);
  auto const velocity = Kokkos::create_mirror_view(f.state.velocity);
  auto const node_depth = onHost(mesh.node_depth);
  auto const node_global = onHost(mesh.node_global);
  auto const dof_node = onHost(f.dof_nodes.node);
  auto const dof_material = onHost(f.dof_nodes.material);
  for (int dof = 0; dof < f.dof_nodes.num_dof_nodes; ++dof)
    for (int d = 0; d < 2; ++d)
      velocity(dof, d) =
          spoil && node_depth(dof_node(dof)) > 0 ? -9.0 : velocityOf(node_global(dof_node(dof)), dof_material(dof), d);
  Kokkos::deep_copy(f.state.velocity, velocity);
  return f;
}

template <class V>
void expectSame(V const &a, V const &b, char const *what)
{
  auto const x = onHost(a);
  auto const y = onHost(b);
  ASSERT_EQ(x.size(), y.size()) << what;
  for (std::size_t i = 0; i < x.size(); ++i)
    ASSERT_EQ(x.data()[i], y.data()[i]) << what << " " << i;
}

void spoilHaloVelocities(Mesh const &mesh, NodeMaterialPairs const &dof_nodes, View<double *[2]> const &velocity)
{
  Kokkos::parallel_for(
      "spoilHaloVelocities", RangePolicy(0, dof_nodes.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        if (mesh.node_depth(dof_nodes.node(dof)) > 0)
          velocity(dof, 0) = velocity(dof, 1) = -9.0;
      });
}

/// A local mesh of this rank with a halo of three layers, and its exchange.
struct Setting
{
  Teuchos::RCP<Teuchos::Comm<int> const> comm = Tpetra::getDefaultComm();
  HostMesh whole = rectilinearMesh(gradedCoordinates(0.0, 1.0, nx, 1.0), gradedCoordinates(0.0, 1.0, ny, 1.0));
  Mesh mesh = buildLocalMesh(whole, partitionCells(whole, comm->getSize()), comm->getRank(), 3);
  TpetraExchange exchange = {comm, mesh};
};

class ExchangeState : public ::testing::TestWithParam<Kinematics>
{
};

/// The halo is as deep as the exchange, so that the local mesh holds the truth everywhere afterwards.
TEST_P(ExchangeState, spoiltHalo_isTheTruthAgainBitForBit)
{
  Setting const setting;
  Mesh const &mesh = setting.mesh;
  TpetraExchange const &exchange = setting.exchange;
  Fields f = makeFields(mesh, GetParam(), true);
  Fields const truth = makeFields(mesh, GetParam(), false);
  exchangeState(mesh, GetParam(), exchange, 3, f.pairs, f.dof_nodes, f.state);
  ASSERT_EQ(f.pairs.num_pairs, truth.pairs.num_pairs);
  ASSERT_EQ(f.dof_nodes.num_dof_nodes, truth.dof_nodes.num_dof_nodes);
  expectSame(f.pairs.offset, truth.pairs.offset, "offset");
  expectSame(f.pairs.material, truth.pairs.material, "material");
  expectSame(f.pairs.cell, truth.pairs.cell, "cell");
  expectSame(f.pairs.dof_node, truth.pairs.dof_node, "dof_node");
  expectSame(f.pairs.cell_kind, truth.pairs.cell_kind, "cell_kind");
  expectSame(f.dof_nodes.offset, truth.dof_nodes.offset, "dof offset");
  expectSame(f.dof_nodes.material, truth.dof_nodes.material, "dof material");
  expectSame(f.state.record, truth.state.record, "record");
  expectSame(f.state.centroid, truth.state.centroid, "centroid");
  expectSame(f.state.velocity, truth.state.velocity, "velocity");
}

/// Where the halo's materials are right its values are overwritten in place: views stay.
TEST_P(ExchangeState, haloOfWrongValues_isOverwrittenInPlaceBitForBit)
{
  Setting const setting;
  Mesh const &mesh = setting.mesh;
  TpetraExchange const &exchange = setting.exchange;
  Fields f = makeFields(mesh, GetParam(), false);
  Fields const truth = makeFields(mesh, GetParam(), false);
  Fields const before = f;
  Kokkos::parallel_for(
      "spoilPairs", RangePolicy(0, f.pairs.num_pairs), KOKKOS_LAMBDA(int pair) {
        if (mesh.cell_depth(f.pairs.cell(pair)) == 0)
          return;
        for (int k = 0; k < num_pair_fields; ++k)
          f.state.record(pair, k) = -9.0;
        f.state.centroid(pair, 0) = f.state.centroid(pair, 1) = -9.0;
        f.pairs.cell_kind(f.pairs.cell(pair)) = VoidCell;
      });
  spoilHaloVelocities(mesh, f.dof_nodes, f.state.velocity);
  exchangeState(mesh, GetParam(), exchange, 3, f.pairs, f.dof_nodes, f.state);
  EXPECT_EQ(f.state.record.data(), before.state.record.data());
  // Kinds that change come in a new view.
  EXPECT_EQ(f.pairs.cell_kind.data() != before.pairs.cell_kind.data(), exchange.size() > 1);
  expectSame(f.pairs.cell_kind, truth.pairs.cell_kind, "cell_kind");
  expectSame(f.state.record, truth.state.record, "record");
  expectSame(f.state.centroid, truth.state.centroid, "centroid");
  expectSame(f.state.velocity, truth.state.velocity, "velocity");
}

/// What the rim of a halo computes lacks neighbours; owners know better.
TEST_P(ExchangeState, spoiltHaloVelocities_areTheOwnersAgainBitForBit)
{
  Setting const setting;
  Mesh const &mesh = setting.mesh;
  TpetraExchange const &exchange = setting.exchange;
  Fields const truth = makeFields(mesh, GetParam(), false);
  View<double *[2]> const velocity("velocity", truth.dof_nodes.num_dof_nodes);
  Kokkos::deep_copy(velocity, truth.state.velocity);
  spoilHaloVelocities(mesh, truth.dof_nodes, velocity);
  exchangeDofVelocities(exchange, mesh.halo, truth.pairs, velocity);
  expectSame(velocity, truth.state.velocity, "velocity");
}

INSTANTIATE_TEST_SUITE_P(Kinematics, ExchangeState, ::testing::Values(Kinematics::Xfem, Kinematics::Single));

TEST(ExchangeStateDepth, exchangeShallowerThanTheHalo_deeperCellsAreEmpty)
{
  Setting const setting;
  Mesh const &mesh = setting.mesh;
  TpetraExchange const &exchange = setting.exchange;
  Fields f = makeFields(mesh, Kinematics::Xfem, true);
  exchangeState(mesh, Kinematics::Xfem, exchange, 1, f.pairs, f.dof_nodes, f.state);
  auto const offset = onHost(f.pairs.offset);
  auto const kind = onHost(f.pairs.cell_kind);
  auto const depth = onHost(mesh.cell_depth);
  auto const global = onHost(mesh.cell_global);
  for (int c = 0; c < mesh.num_cells; ++c)
  {
    int expected = 0;
    for (int m = 0; m < num_materials; ++m)
      expected += depth(c) <= 1 && present(global(c), m) ? 1 : 0;
    EXPECT_EQ(offset(c + 1) - offset(c), expected);
    EXPECT_TRUE(depth(c) <= 1 || kind(c) == VoidCell);
  }
}

} // namespace
