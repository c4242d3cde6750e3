// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructScene.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

/// Up to five materials, and void in every other cell, with fractions down to 1e-12 and any centroids.
CellFills randomFills(std::mt19937 &random)
{
  return [&random](int cell, Quadrilateral const &quad)
  {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int const count = cell % 16 < 13 ? 1 + cell % 16 % 3 : 3 + cell % 16 % 3; // 13, 14, 15: 4, 5, 3 materials
    double part[6], sum = 0.0;
    int const parts = count + (cell % 2 == 0 || count == 1 ? 1 : 0);
    for (int k = 0; k < parts; ++k)
      sum += part[k] = uniform(random) < 0.4 ? std::pow(10.0, -12.0 * uniform(random)) : uniform(random);
    std::vector<Fill> fills;
    for (int k = 0; k < count; ++k)
    {
      Vector2 x{0.0, 0.0};
      double weight = 0.0;
      for (int c = 0; c < 4; ++c)
      {
        double const w = uniform(random);
        weight += w;
        x += w * quad[c];
      }
      fills.push_back({k, part[k] / sum * area(quad), (1.0 / weight) * x});
    }
    return fills;
  };
}

/// Cells of any convex form: shaken as far as they stay convex, stretched up to ten times, sheared and turned.
Mesh randomMesh(unsigned seed, int rows)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Mesh const mesh = makeMesh(400, rows, 0.01, 0.2499 * uniform(random), seed);
  double const stretch = std::pow(10.0, 0.5 * uniform(random)), angle = 2.0 * Math::pi * uniform(random);
  double const shear = 2.0 * uniform(random) - 1.0, c = std::cos(angle), s = std::sin(angle);
  auto const x = onHost(mesh.node_position);
  for (int node = 0; node < mesh.num_nodes; ++node)
  {
    double const a = stretch * (x(node, 0) + shear * x(node, 1)), b = x(node, 1) / stretch;
    x(node, 0) = c * a - s * b;
    x(node, 1) = s * a + c * b;
  }
  Kokkos::deep_copy(mesh.node_position, x);
  auto const cell_node = onHost(mesh.cell_node);
  auto const cell_area = Kokkos::create_mirror_view(mesh.cell_area);
  for (int cell = 0; cell < mesh.num_cells; ++cell)
    cell_area(cell) = area(hostQuadrilateral(x, cell_node, cell));
  Kokkos::deep_copy(mesh.cell_area, cell_area);
  return mesh;
}

/// Every method on `batches` meshes of 400 x `rows` random cells: exact volumes, and every search for an angle ends by
/// itself.
void checkRandomCells(int batches, int rows)
{
  struct Method
  {
    char const *name;
    ReconstructionOptions options;
    ReconstructionReport report;
    double seconds = 0.0;
  };
  Method methods[4] = {
      {"Youngs", {}, {}}, {"least squares", {}, {}}, {"moment of fluid", {}, {}}, {"no slivers", {}, {}}};
  methods[0].options.method = ReconstructionMethod::Youngs;
  methods[1].options.sliver = 1.0;
  methods[3].options.sliver = 0.0;
  long long mixed = 0;
  for (int batch = 0; batch < batches; ++batch)
  {
    std::mt19937 random(17 + batch);
    Scene const scene = paint(randomMesh(1 + batch, rows), randomFills(random));
    for (Method &method : methods)
    {
      auto const begin = std::chrono::steady_clock::now();
      FilledRegions const regions = reconstruct(scene.mesh, scene.pairs, scene.state, method.options, method.report);
      method.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      mixed += &method == methods ? regions.num_mixed_cells : 0;
    }
  }
  EXPECT_GT(mixed, 380LL * rows * batches);
  for (Method const &method : methods)
  {
    ReconstructionReport const &report = method.report;
    std::printf("%-16s %lld cells, largest volume error %.1e, %lld failures, %lld unfinished, %.2f us a cell\n",
                method.name, mixed, report.largest_volume_error, report.failures, report.unfinished_cells,
                1e6 * method.seconds / static_cast<double>(mixed));
    EXPECT_EQ(report.failures, 0) << method.name << ": first in cell " << report.first_failed_cell;
    EXPECT_EQ(report.unfinished_cells, 0) << method.name;
    EXPECT_LT(report.largest_volume_error, 1e-13) << method.name;
  }
}

} // namespace

TEST(ReconstructRandom, anyFractionsInAnyConvexCells_volumesAreExactAndSearchesEnd)
{
  char const *const meshes = std::getenv("HARMOS_RANDOM_MESHES");
  checkRandomCells(meshes != nullptr ? std::atoi(meshes) : 1, 63); // 25 200 cells a mesh, by each of four methods
}
