// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_MeshBuilder.hpp>

#include <benchmark/benchmark.h>

namespace
{

using namespace Harmos;

/// One material everywhere; a vertical band of `mixed` columns holds two.
void benchDofNodes(benchmark::State &state)
{
  int const n = static_cast<int>(state.range(0));
  int const mixed = static_cast<int>(state.range(1));
  Mesh const mesh = buildMesh(rectilinearMesh(gradedCoordinates(0, 1, n, 1.0), gradedCoordinates(0, 1, n, 1.0)));
  CellMaterialPairs pairs;
  pairs.num_pairs = n * (n + mixed);
  pairs.offset = View<int *>("offset", mesh.num_cells + 1);
  pairs.material = View<int *>("material", pairs.num_pairs);
  pairs.cell = View<int *>("cell", pairs.num_pairs);
  View<double *[num_pair_fields]> const record("record", pairs.num_pairs);
  CellMaterialPairs const p = pairs;
  Kokkos::parallel_for(
      "fill", RangePolicy(0, mesh.num_cells + 1), KOKKOS_LAMBDA(int c) {
        int const i = c % n;
        int const first = (c / n) * (n + mixed) + i + Math::min(i, mixed);
        p.offset(c) = first;
        for (int k = 0; c < n * n && k < (i < mixed ? 2 : 1); ++k)
        {
          p.material(first + k) = k;
          p.cell(first + k) = c;
          record(first + k, VolumeFraction) = i < mixed ? 0.5 : 1.0;
        }
      });
  for (auto _ : state)
  {
    NodeMaterialPairs const dof_nodes = buildDofNodes(mesh, Kinematics::Xfem, record, pairs);
    benchmark::DoNotOptimize(dof_nodes.num_dof_nodes);
  }
  state.SetItemsProcessed(state.iterations() * mesh.num_cells);
}

BENCHMARK(benchDofNodes)->Args({512, 0})->Args({512, 32})->Args({512, 512})->Unit(benchmark::kMicrosecond);

} // namespace
