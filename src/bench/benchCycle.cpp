// SPDX-License-Identifier: BSD-3-Clause
// Whole cycles without Trilinos, on any Kokkos backend: a disc that hits a block. (`harmos run` times those of decks.)
#include "../test/Impact.hpp"

#include <benchmark/benchmark.h>

using namespace Harmos;

namespace
{

/// One iteration is a cycle; the counters are its parts in seconds, and cells and pairs a second.
void impact(benchmark::State &bench)
{
  int const n = static_cast<int>(bench.range(0));
  Test::Impact impact(n);
  for (int cycle = 0; cycle < 5; ++cycle) // arrays get their sizes
    advance(impact.scene, impact.state, impact.times);
  impact.times = PhaseTimes();
  for (auto _ : bench)
  {
    advance(impact.scene, impact.state, impact.times);
    Kokkos::fence();
  }
  using benchmark::Counter;
  double const cells = static_cast<double>(n) * n, pairs = impact.state.pairs.num_pairs;
  bench.counters["cells/s"] = Counter(cells, Counter::kIsIterationInvariantRate);
  bench.counters["pairs/s"] = Counter(pairs, Counter::kIsIterationInvariantRate);
  bench.counters["reconstruct"] = Counter(impact.times.reconstruct, Counter::kAvgIterations);
  bench.counters["lagrange"] = Counter(impact.times.lagrange, Counter::kAvgIterations);
  bench.counters["constrain"] = Counter(impact.times.constrain, Counter::kAvgIterations);
  bench.counters["remap"] = Counter(impact.times.remap, Counter::kAvgIterations);
}

} // namespace

BENCHMARK(impact)->Arg(40)->Arg(160)->Arg(640)->Arg(2560)->Unit(benchmark::kMillisecond)->Iterations(40)->UseRealTime();
