// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_OnHost.hpp>
#include <Harmos_StateExchange.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace
{

using namespace Harmos;

struct Scene
{
  Mesh mesh;
  CellMaterialPairs pairs;
  View<double *[num_pair_fields]> record;
};

/// Pairs of the given materials (ascending) in each cell; equal volume fractions, times `fill`.
Scene makeScene(HostMesh const &whole, std::vector<std::vector<int>> const &materials, double fill = 1.0)
{
  Scene scene;
  scene.mesh = buildMesh(whole);
  int total = 0;
  for (auto const &list : materials)
    total += static_cast<int>(list.size());
  scene.pairs.num_pairs = total;
  scene.pairs.offset = View<int *>("offset", materials.size() + 1);
  scene.pairs.material = View<int *>("material", total);
  scene.pairs.cell = View<int *>("cell", total);
  scene.record = View<double *[num_pair_fields]>("record", total);
  auto offset = Kokkos::create_mirror_view(scene.pairs.offset);
  auto material = Kokkos::create_mirror_view(scene.pairs.material);
  auto cell = Kokkos::create_mirror_view(scene.pairs.cell);
  auto record = Kokkos::create_mirror_view(scene.record);
  int pair = 0;
  offset(0) = 0;
  for (std::size_t c = 0; c < materials.size(); ++c)
  {
    for (int const m : materials[c])
    {
      material(pair) = m;
      cell(pair) = static_cast<int>(c);
      record(pair, VolumeFraction) = fill / static_cast<double>(materials[c].size());
      ++pair;
    }
    offset(c + 1) = pair;
  }
  Kokkos::deep_copy(scene.pairs.offset, offset);
  Kokkos::deep_copy(scene.pairs.material, material);
  Kokkos::deep_copy(scene.pairs.cell, cell);
  Kokkos::deep_copy(scene.record, record);
  return scene;
}

/// Compare with sets of materials gathered the slow way.
void expectUnionOfMaterials(Scene &scene, std::vector<std::vector<int>> const &materials)
{
  NodeMaterialPairs const dof_nodes = buildDofNodes(scene.mesh, Kinematics::Xfem, scene.record, scene.pairs);
  auto const cell_node = onHost(scene.mesh.cell_node);
  std::vector<std::set<int>> expected(scene.mesh.num_nodes);
  for (int c = 0; c < scene.mesh.num_cells; ++c)
    for (int k = 0; k < 4; ++k)
      expected[cell_node(c, k)].insert(materials[c].begin(), materials[c].end());
  auto const offset = onHost(dof_nodes.offset);
  auto const material = onHost(dof_nodes.material);
  auto const node = onHost(dof_nodes.node);
  for (int n = 0; n < scene.mesh.num_nodes; ++n)
  {
    ASSERT_EQ(offset(n + 1) - offset(n), static_cast<int>(expected[n].size()));
    int dof = offset(n);
    for (int const m : expected[n])
    {
      EXPECT_EQ(material(dof), m);
      EXPECT_EQ(node(dof), n);
      ++dof;
    }
  }
  EXPECT_EQ(offset(scene.mesh.num_nodes), dof_nodes.num_dof_nodes);
  auto const dof_node = onHost(scene.pairs.dof_node);
  auto const pair_cell = onHost(scene.pairs.cell);
  auto const pair_material = onHost(scene.pairs.material);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_EQ(node(dof_node(pair, k)), cell_node(pair_cell(pair), k));
      EXPECT_EQ(material(dof_node(pair, k)), pair_material(pair));
    }
}

std::vector<std::vector<int>> randomMaterials(int cells, int num_materials, double presence, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<std::vector<int>> materials(cells);
  for (auto &list : materials)
    for (int m = 0; m < num_materials; ++m)
      if (random() < presence * static_cast<double>(std::mt19937::max()))
        list.push_back(m);
  return materials;
}

//  +---+---+---+     a: material 0, b: material 1
//  | a | ab| b |     xfem: 2 + 4 + 4 + 2 dof nodes, middle nodes enriched
//  +---+---+---+
TEST(BuildDofNodes, oneMixedCellBetweenPureCells_middleNodesAreEnriched)
{
  std::vector<std::vector<int>> const materials = {{0}, {0, 1}, {1}};
  Scene scene = makeScene(rectilinearMesh({0, 1, 2, 3}, {0, 1}), materials);
  NodeMaterialPairs const dof_nodes = buildDofNodes(scene.mesh, Kinematics::Xfem, scene.record, scene.pairs);
  EXPECT_EQ(dof_nodes.num_dof_nodes, 12);
  auto const kind = onHost(scene.pairs.cell_kind);
  EXPECT_EQ(kind(0), PureCell);
  EXPECT_EQ(kind(1), MixedCell);
  EXPECT_EQ(kind(2), PureCell);
  auto const offset = onHost(dof_nodes.offset);
  EXPECT_EQ(offset(1) - offset(0), 1);
  EXPECT_EQ(offset(2) - offset(1), 2);
  expectUnionOfMaterials(scene, materials);
}

TEST(BuildDofNodes, partlyFilledAndVoidCells_kindsFollowTheVolumeFraction)
{
  Scene scene = makeScene(rectilinearMesh({0, 1, 2, 3}, {0, 1}), {{0}, {}, {}}, 0.999999);
  NodeMaterialPairs const dof_nodes = buildDofNodes(scene.mesh, Kinematics::Xfem, scene.record, scene.pairs);
  auto const kind = onHost(scene.pairs.cell_kind);
  EXPECT_EQ(kind(0), MixedCell);
  EXPECT_EQ(kind(1), VoidCell);
  EXPECT_EQ(kind(2), VoidCell);
  EXPECT_EQ(dof_nodes.num_dof_nodes, 4);
}

TEST(BuildDofNodes, fewMaterialsAtRandom_rowsAreTheUnionOfTheCellsAround)
{
  auto const materials = randomMaterials(15 * 12, 3, 0.4, 1);
  Scene scene =
      makeScene(rectilinearMesh(gradedCoordinates(0, 1, 15, 1.0), gradedCoordinates(0, 1, 12, 1.0)), materials);
  expectUnionOfMaterials(scene, materials);
}

TEST(BuildDofNodes, ninetyMaterialsAtRandom_rowsAreTheUnionOfTheCellsAround)
{
  auto const materials = randomMaterials(8 * 8, 90, 0.08, 2);
  Scene scene = makeScene(rectilinearMesh(gradedCoordinates(0, 1, 8, 1.0), gradedCoordinates(0, 1, 8, 1.0)), materials);
  expectUnionOfMaterials(scene, materials);
}

TEST(BuildDofNodes, fiveCellsAroundANode_anyValenceIsServed)
{
  HostMesh star;
  star.node.push_back({0.0, 0.0});
  for (int i = 0; i < 10; ++i)
  {
    double const angle = 2.0 * Math::pi * i / 10.0;
    double const radius = i % 2 == 0 ? 1.0 : 1.2;
    star.node.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  for (int i = 0; i < 5; ++i)
    star.cell.push_back({0, 1 + 2 * i, 2 + 2 * i, 1 + (2 * i + 2) % 10});
  star.face_boundary.assign(5, {-1, -1, -1, -1});
  std::vector<std::vector<int>> const materials = {{4}, {3}, {0, 7}, {2}, {1, 4}};
  Scene scene = makeScene(star, materials);
  expectUnionOfMaterials(scene, materials);
  NodeMaterialPairs const dof_nodes = buildDofNodes(scene.mesh, Kinematics::Xfem, scene.record, scene.pairs);
  EXPECT_EQ(onHost(dof_nodes.offset)(1), 6);
}

TEST(BuildDofNodes, single_oneDofNodePerTouchedNodeWhateverTheMaterial)
{
  auto const materials = randomMaterials(10 * 10, 5, 0.1, 3);
  Scene scene =
      makeScene(rectilinearMesh(gradedCoordinates(0, 1, 10, 1.0), gradedCoordinates(0, 1, 10, 1.0)), materials);
  NodeMaterialPairs const dof_nodes = buildDofNodes(scene.mesh, Kinematics::Single, scene.record, scene.pairs);
  auto const cell_node = onHost(scene.mesh.cell_node);
  std::set<int> touched;
  for (std::size_t c = 0; c < materials.size(); ++c)
    for (int k = 0; k < 4 && !materials[c].empty(); ++k)
      touched.insert(cell_node(c, k));
  ASSERT_EQ(dof_nodes.num_dof_nodes, static_cast<int>(touched.size()));
  auto const node = onHost(dof_nodes.node);
  auto const material = onHost(dof_nodes.material);
  int dof = 0;
  for (int const n : touched)
  {
    EXPECT_EQ(node(dof), n);
    EXPECT_EQ(material(dof), -1);
    ++dof;
  }
  auto const dof_node = onHost(scene.pairs.dof_node);
  auto const pair_cell = onHost(scene.pairs.cell);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
    for (int k = 0; k < 4; ++k)
      EXPECT_EQ(node(dof_node(pair, k)), cell_node(pair_cell(pair), k));
}

TEST(BuildDofNodes, noMaterialAtAll_thereAreNoDofNodes)
{
  Scene scene = makeScene(rectilinearMesh({0, 1, 2}, {0, 1}), {{}, {}});
  EXPECT_EQ(buildDofNodes(scene.mesh, Kinematics::Xfem, scene.record, scene.pairs).num_dof_nodes, 0);
}

TEST(ExchangeState, oneRank_nothingIsTouched)
{
  Scene scene = makeScene(rectilinearMesh({0, 1, 2, 3}, {0, 1}), {{0}, {0, 1}, {1}});
  NodeMaterialPairs dof_nodes = buildDofNodes(scene.mesh, Kinematics::Xfem, scene.record, scene.pairs);
  PairState state{scene.record, View<double *[2]>("centroid", 4), View<double *[2]>("velocity", 12)};
  double const *const velocity = state.velocity.data();
  int const *const dof_node = scene.pairs.dof_node.data();
  exchangeState(scene.mesh, Kinematics::Xfem, Exchange(), 3, scene.pairs, dof_nodes, state);
  EXPECT_EQ(state.velocity.data(), velocity);
  EXPECT_EQ(scene.pairs.dof_node.data(), dof_node);
}

} // namespace
