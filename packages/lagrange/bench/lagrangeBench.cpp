// SPDX-License-Identifier: BSD-3-Clause
#include "../test/Harmos_LagrangeScene.hpp"

#include <benchmark/benchmark.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

/// A pure region of elastic-plastic Mie-Gruneisen material, some of it yielding.
Scene pureRegion(int n, Kinematics kinematics)
{
  Material m = elastic();
  m.eos = EosKind::MieGruneisen;
  m.strength = StrengthKind::Plastic;
  m.slope = 1.5;
  m.gruneisen = 2.0;
  m.yield = 0.05;
  m.hardening = 0.1;
  Scene s = makeScene(n, n, 0.1, {m}, full, kinematics, std::vector<BoundaryKind>(4, BoundaryKind::SlipWall));
  s.setVelocity([](int, Vector2 x) { return Vector2{0.05 * std::sin(0.1 * x[0]), 0.05 * std::cos(0.07 * x[1])}; });
  s.predict(1e-3);
  return s;
}

template <class Step>
void measure(benchmark::State &bench, Step const &step)
{
  Scene s = pureRegion(static_cast<int>(bench.range(0)), Kinematics::Xfem);
  for (auto _ : bench)
    step(s);
  bench.counters["ns/pair"] = benchmark::Counter(
      s.pairs.num_pairs * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void cornerForces(benchmark::State &bench)
{
  measure(bench, [](Scene &s) { computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work); });
}

void predict(benchmark::State &bench)
{
  measure(bench,
          [](Scene &s) {
            predictVelocities(s.mesh, s.pairs, s.dof_nodes, s.state, s.boundary, s.materials, s.options, 1e-3, s.work);
          });
}

void update(benchmark::State &bench)
{
  TimeStepLimit next;
  measure(bench, [&next](Scene &s) { s.update(1e-7, next); });
}

void travel(benchmark::State &bench)
{
  measure(bench, [](Scene &s)
          { limitTravel(s.mesh, s.pairs, s.dof_nodes, s.state, s.boundary, s.materials, s.options, 1e-3, s.work); });
}

void sumsByMaterial(benchmark::State &bench)
{
  measure(bench, [](Scene &s)
          { benchmark::DoNotOptimize(materialSums(s.mesh, s.pairs, s.state.record, s.state.velocity, 1)); });
}

} // namespace

BENCHMARK(cornerForces)->Arg(64)->Arg(256)->Arg(512);
BENCHMARK(predict)->Arg(64)->Arg(256)->Arg(512);
BENCHMARK(update)->Arg(64)->Arg(256)->Arg(512);
BENCHMARK(travel)->Arg(256);
BENCHMARK(sumsByMaterial)->Arg(256);
