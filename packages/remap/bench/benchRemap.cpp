// SPDX-License-Identifier: BSD-3-Clause
#include "../test/RemapScene.hpp"

#include <benchmark/benchmark.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

double wave(int material, Vector2 const &x)
{
  return 2.0 + material + std::sin(6.0 * x[0]) * std::cos(5.0 * x[1]);
}

Vector2 swirl(int, Vector2 const &x)
{
  double const pi = Math::pi;
  return {std::sin(pi * x[0]) * std::cos(2.0 * pi * x[1]), -std::cos(pi * x[0]) * std::sin(pi * x[1])};
}

/// Time per cell (per interface pair where there are interfaces): both are counters of the run.
void run(benchmark::State &bench, Scene &scene)
{
  scene.dt = 0.2 / std::sqrt(static_cast<double>(scene.mesh.num_cells));
  scene.move(swirl);
  RemapWork work;
  double mixed = 0.0;
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
    if (scene.pairs.cell_kind(cell) == MixedCell)
      mixed += scene.pairs.offset(cell + 1) - scene.pairs.offset(cell);
  for (auto _ : bench)
  {
    RemapReport report;
    RemapResult const result =
        remap(scene.mesh, scene.kinematics, scene.pairs, scene.dof_nodes, scene.state, scene.regions, scene.conditions,
              scene.materials, scene.half, scene.dt, scene.rigid, scene.options, report, work);
    benchmark::DoNotOptimize(result.state.record.data());
  }
  using benchmark::Counter;
  bench.counters["s/cell"] = Counter(scene.mesh.num_cells, Counter::kIsIterationInvariantRate | Counter::kInvert);
  if (mixed > 0.0)
    bench.counters["s/mixed_pair"] = Counter(mixed, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void pureRegion(benchmark::State &bench)
{
  Scene scene(512, 512, 0.1, twoLaws());
  scene.options.order = static_cast<int>(bench.range(0));
  scene.options.return_kinetic_defect = bench.range(1) != 0;
  scene.paint({rest(0)}, wave, wave);
  run(bench, scene);
}

/// Stripes of two materials: almost every cell is an interface cell.
void stripes(benchmark::State &bench)
{
  int const n = 96;
  Scene scene(n, n, 0.1, twoLaws());
  std::vector<Layer> layers;
  for (int i = 0; i < 32; ++i)
    layers.push_back(halfPlane(i % 2, {(i + 0.5) / 32.0, 0.0}, 0.0));
  layers.push_back(rest(0));
  scene.paint(layers, wave, wave);
  run(bench, scene);
}

BENCHMARK(pureRegion)->Args({1, 0})->Args({2, 0})->Args({2, 1})->Unit(benchmark::kMillisecond);
BENCHMARK(stripes)->Unit(benchmark::kMillisecond);

} // namespace
