// SPDX-License-Identifier: BSD-3-Clause
#include "../test/ReconstructScene.hpp"

#include <benchmark/benchmark.h>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

/// Many parallel stripes of two materials, 4.3 cells wide, at 25 degrees on slightly shaken quads: nearly half of the
/// cells are mixed. With void, material 1 is left out; with three components, every fourth stripe ends at a corner.
Scene stripes(bool with_void, bool corners)
{
  Mesh const mesh = makeMesh(128, 128, 1.0, 0.05);
  return paint(
      mesh,
      [with_void, corners](int, Quadrilateral const &quad)
      {
        double volume[2] = {0.0, 0.0};
        Vector2 first[2] = {{0.0, 0.0}, {0.0, 0.0}};
        for (int stripe = -20; stripe < 60; ++stripe)
        {
          Plane2 upper = halfPlane(25.0, {4.3 * (stripe + 1), 0.0}), lower = halfPlane(205.0, {4.3 * stripe, 0.0});
          Body body{upper, lower};
          if (corners && stripe % 2 == 0)
            body.push_back(halfPlane(115.0, {0.0, 60.0 + 5.3 * (stripe % 7)}));
          Region const part = intersection(quad, body);
          Moments<1> const m = moments<1>(part, quad[0]);
          int const which = stripe & 1;
          volume[which] += m.volume();
          for (int d = 0; d < 2; ++d)
            first[which][d] += m.first(d);
        }
        std::vector<Fill> fills;
        for (int k = 0; k < (with_void ? 1 : 2); ++k)
          if (volume[k] > 0.0)
            fills.push_back({k, volume[k], quad[0] + (1.0 / volume[k]) * first[k]});
        return fills;
      });
}

/// Three materials in every cell: two parallel lines through it, at angles that differ from cell to cell.
Scene threeInEveryCell()
{
  Mesh const mesh = makeMesh(64, 64, 1.0, 0.05);
  return paint(mesh,
               [](int cell, Quadrilateral const &quad)
               {
                 double const angle = 137.5 * cell;
                 Vector2 const middle = 0.25 * (quad[0] + quad[1] + quad[2] + quad[3]);
                 Vector2 const n = halfPlane(angle, middle).normal;
                 Body const all[3] = {{halfPlane(angle, middle - 0.2 * n)},
                                      {halfPlane(angle, middle + 0.1 * n), halfPlane(angle + 180.0, middle - 0.2 * n)},
                                      {halfPlane(angle + 180.0, middle + 0.1 * n)}};
                 std::vector<Fill> fills;
                 for (int k = 0; k < 3; ++k)
                 {
                   Region const part = intersection(quad, all[(k + cell) % 3]);
                   Moments<1> const m = moments<1>(part, quad[0]);
                   fills.push_back({k, m.volume(), quad[0] + m.centroid()});
                 }
                 return fills;
               });
}

void measure(benchmark::State &state, Scene const &scene, ReconstructionMethod method, double sliver)
{
  ReconstructionOptions options;
  options.method = method;
  options.sliver = sliver;
  ReconstructionReport report;
  long long mixed = 0;
  for (auto _ : state)
    mixed += reconstruct(scene.mesh, scene.pairs, scene.state, options, report).num_mixed_cells;
  state.counters["mixed_cells"] = static_cast<double>(mixed) / static_cast<double>(state.iterations());
  state.counters["time_per_mixed_cell"] =
      benchmark::Counter(static_cast<double>(mixed), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void youngs(benchmark::State &state)
{
  measure(state, stripes(false, false), ReconstructionMethod::Youngs, 1e-3);
}
void momentOfFluidTwoMaterials(benchmark::State &state)
{
  measure(state, stripes(false, false), ReconstructionMethod::MomentOfFluid, 1e-3);
}
void momentOfFluidAndVoid(benchmark::State &state)
{
  measure(state, stripes(true, false), ReconstructionMethod::MomentOfFluid, 1e-3);
}
void momentOfFluidWithCorners(benchmark::State &state)
{
  measure(state, stripes(false, true), ReconstructionMethod::MomentOfFluid, 1e-3);
}
void leastSquares(benchmark::State &state)
{
  measure(state, stripes(false, false), ReconstructionMethod::MomentOfFluid, 1.0);
}

void momentOfFluidThreeMaterials(benchmark::State &state)
{
  measure(state, threeInEveryCell(), ReconstructionMethod::MomentOfFluid, 1e-3);
}

BENCHMARK(youngs);
BENCHMARK(momentOfFluidTwoMaterials);
BENCHMARK(momentOfFluidAndVoid);
BENCHMARK(momentOfFluidWithCorners);
BENCHMARK(momentOfFluidThreeMaterials);
BENCHMARK(leastSquares);

} // namespace
