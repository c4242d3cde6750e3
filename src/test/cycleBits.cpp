// SPDX-License-Identifier: BSD-3-Clause
// Prints the bits of the state after some cycles of a disc that hits a block, in one number: the same for any number of
// threads (see test same_bits_on_any_number_of_threads). Then sums to compare by eye where the bits may differ: other
// compilers, another Kokkos, a GPU.
#include "Impact.hpp"

#include <cstdint>
#include <cstdio>

using namespace Harmos;

namespace
{

/// Fowler-Noll-Vo hash, 64 bits.
template <class V>
void hash(V const &view, std::uint64_t &bits)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
  auto const *const bytes = reinterpret_cast<unsigned char const *>(host.data());
  for (std::size_t i = 0; i < host.size() * sizeof(typename V::value_type); ++i)
    bits = (bits ^ bytes[i]) * 1099511628211ull;
}

void run()
{
  Test::Impact impact;
  long long rows = 0;
  for (int cycle = 0; cycle < 120; ++cycle)
    rows += advance(impact.scene, impact.state, impact.times).constraint.rows;
  CycleState const &state = impact.state;
  std::uint64_t bits = 14695981039346656037ull;
  hash(state.state.record, bits);
  hash(state.state.centroid, bits);
  hash(state.state.velocity, bits);
  std::printf("%d pairs, %lld contact rows, bits %016llx\n", state.pairs.num_pairs, rows,
              static_cast<unsigned long long>(bits));
  auto const sum = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), impact.sums());
  std::printf("%s: t = %.12e s\n", ExecutionSpace::name(), state.time);
  for (std::size_t material = 0; material < sum.extent(0); ++material)
    std::printf("material %d: momentum %.9e %.9e N s/m, energy %.9e kinetic, %.9e internal J/m\n",
                static_cast<int>(material), sum(material, SumMomentumX), sum(material, SumMomentumY),
                sum(material, SumKineticEnergy), sum(material, SumInternalEnergy));
}

} // namespace

int main(int argc, char **argv)
{
  Kokkos::ScopeGuard const kokkos(argc, argv);
  run();
}
