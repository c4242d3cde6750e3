// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Bilinear.hpp>
#include <Harmos_Clip.hpp>
#include <Harmos_ClipPacks.hpp>
#include <Harmos_Moments.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace Harmos;

namespace
{

struct OverlayPair
{
  Quadrilateral donor; // relative to the acceptor's corner
  int i, j;
};

/// Unit squares moved by a rigid shift plus a shift of each corner, uniform in +-1/4, with each of the 3 x 3 unit cells
/// that their bounding box overlaps.
std::vector<OverlayPair> overlayPairs(int donors)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.25, 0.25);
  std::vector<OverlayPair> pairs;
  for (int n = 0; n < donors; ++n)
  {
    Quadrilateral q{4, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    Vector2 const rigid{shift(random), shift(random)};
    Vector2 low{9, 9}, high{-9, -9};
    for (int k = 0; k < 4; ++k)
    {
      q[k] += rigid + Vector2{shift(random), shift(random)};
      for (int d = 0; d < 2; ++d)
      {
        low[d] = Math::min(low[d], q[k][d]);
        high[d] = Math::max(high[d], q[k][d]);
      }
    }
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (low[0] < i + 1 && high[0] > i && low[1] < j + 1 && high[1] > j)
          pairs.push_back({q, i, j});
  }
  return pairs;
}

// Seconds per item: shown as nanoseconds per pair.
void report(benchmark::State &state, std::size_t pairs)
{
  state.SetItemsProcessed(state.iterations() * static_cast<long>(pairs));
  state.counters["per_pair"] = benchmark::Counter(static_cast<double>(state.iterations() * pairs),
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["pairs_per_donor"] = static_cast<double>(pairs) / 1000.0;
}

void clipAndSecondMoments(benchmark::State &state)
{
  std::vector<OverlayPair> const pairs = overlayPairs(1000);
  Quadrilateral const cell{4, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (auto _ : state)
  {
    double sum = 0.0;
    for (OverlayPair const &pair : pairs)
    {
      Quadrilateral donor = pair.donor;
      for (int k = 0; k < 4; ++k)
        donor[k] -= Vector2{1.0 * pair.i, 1.0 * pair.j};
      Polygon<8> overlay;
      clipConvex(donor, cell, overlay);
      Moments<2> const m = moments<2>(overlay, Vector2{0.0, 0.0});
      sum += m.value[0] + m.value[5];
    }
    benchmark::DoNotOptimize(sum);
  }
  report(state, pairs.size());
}

/// The same pairs; those of one donor fill packs, the last of them in part.
void secondMomentsInPacks(benchmark::State &state)
{
  std::vector<OverlayPair> const pairs = overlayPairs(1000);
  for (auto _ : state)
  {
    Pack sum = 0.0;
    for (std::size_t begin = 0, end; begin < pairs.size(); begin = end)
    {
      Quadrilateral const &donor = pairs[begin].donor;
      end = begin + 1;
      while (end < pairs.size() && end - begin < pack_width && pairs[end].donor[0][0] == donor[0][0])
        ++end;
      double x[4], y[4];
      WindowPack w;
      for (int k = 0; k < 4; ++k)
      {
        x[k] = donor[k][0];
        y[k] = donor[k][1];
        double const dx = k == 1 || k == 2 ? 1.0 : 0.0, dy = k >= 2 ? 1.0 : 0.0;
        w.x[k] = packOf([&](int lane) { return pairs[std::min(begin + lane, end - 1)].i + dx; });
        w.y[k] = packOf([&](int lane) { return pairs[std::min(begin + lane, end - 1)].j + dy; });
      }
      OverlayPack const m = momentsInWindows(4, x, y, w);
      sum += m.value[0] + m.value[5];
    }
    benchmark::DoNotOptimize(sum);
  }
  report(state, pairs.size());
}

} // namespace

BENCHMARK(clipAndSecondMoments);
BENCHMARK(secondMomentsInPacks);
