// SPDX-License-Identifier: BSD-3-Clause
#include <Kokkos_Core.hpp>

#include <benchmark/benchmark.h>

int main(int argc, char **argv)
{
  Kokkos::initialize(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  Kokkos::finalize();
  return 0;
}
