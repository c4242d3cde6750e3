// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RestoreVolumes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace Harmos
{
namespace
{

constexpr double full_tolerance = 1e-12; // of a cell: less void than this is none
constexpr int most_iterations = 20;

/// Volume fractions as the weights of the materials make them.
struct WeightedFractions
{
  CellMaterialPairs pairs;
  View<double *[num_pair_fields]> record;
  View<double *> weight;

  KOKKOS_INLINE_FUNCTION double at(int pair) const
  {
    int const cell = pairs.cell(pair);
    if (pairs.cell_kind(cell) != MixedCell)
      return record(pair, VolumeFraction);
    double filled = 0.0, weighted = 0.0;
    for (int other = pairs.offset(cell); other < pairs.offset(cell + 1); ++other)
    {
      filled += record(other, VolumeFraction);
      weighted += weight(pairs.material(other)) * record(other, VolumeFraction);
    }
    double const empty = 1.0 - filled > full_tolerance ? 1.0 - filled : 0.0;
    return weight(pairs.material(pair)) * record(pair, VolumeFraction) / (weighted + empty);
  }
};

/// Sum over the owned cells of one material's volume. Integer sums of multiples of one quantum: no order, no ranks in
/// the result.
double volumeOf(Mesh const &mesh, WeightedFractions const &fractions, int material, ReproducibleSum const &sum,
                Exchange const &exchange)
{
  auto const pairs = fractions.pairs;
  long long quanta = 0;
  Kokkos::parallel_reduce(
      "Harmos::volumeOf", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, long long &part) {
        int const cell = pairs.cell(pair);
        if (pairs.material(pair) == material && mesh.cell_depth(cell) == 0)
          part += sum.quanta(fractions.at(pair) * mesh.cell_area(cell));
      },
      quanta);
  exchange.sum(&quanta, 1);
  return sum.value(quanta);
}

/// Change of a material's volume with the logarithm of another's weight: sum of A f_m (delta_mk - f_k), mixed cells.
double volumeRate(Mesh const &mesh, WeightedFractions const &fractions, int material, int of_weight,
                  ReproducibleSum const &sum, Exchange const &exchange)
{
  auto const pairs = fractions.pairs;
  long long quanta = 0;
  Kokkos::parallel_reduce(
      "Harmos::volumeRate", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, long long &part) {
        int const cell = pairs.cell(pair);
        if (pairs.material(pair) != material || mesh.cell_depth(cell) != 0 || pairs.cell_kind(cell) != MixedCell)
          return;
        int const other = pairs.find(cell, of_weight);
        double const f = other < 0 ? 0.0 : fractions.at(other);
        part += sum.quanta(fractions.at(pair) * ((of_weight == material ? 1.0 : 0.0) - f) * mesh.cell_area(cell));
      },
      quanta);
  exchange.sum(&quanta, 1);
  return sum.value(quanta);
}

/// Solve a symmetric, positive semi-definite system (row-major) by elimination. An unknown whose pivot vanishes is
/// zero: its equation follows from the others.
std::vector<double> solveSemiDefinite(std::vector<double> a, std::vector<double> b)
{
  int const n = static_cast<int>(b.size());
  std::vector<double> diagonal(n), x(n, 0.0);
  for (int i = 0; i < n; ++i)
    diagonal[i] = a[i * n + i];
  for (int i = 0; i < n; ++i)
  {
    if (!(a[i * n + i] > 1e-10 * diagonal[i]))
      continue;
    for (int k = i + 1; k < n; ++k)
    {
      double const factor = a[k * n + i] / a[i * n + i];
      for (int j = i; j < n; ++j)
        a[k * n + j] -= factor * a[i * n + j];
      b[k] -= factor * b[i];
    }
  }
  for (int i = n - 1; i >= 0; --i)
  {
    if (!(a[i * n + i] > 1e-10 * diagonal[i]))
      continue;
    x[i] = b[i];
    for (int j = i + 1; j < n; ++j)
      x[i] -= a[i * n + j] * x[j];
    x[i] /= a[i * n + i];
  }
  return x;
}

/// A quantum that any sum over the cells of all ranks can be counted in.
ReproducibleSum volumeSum(Mesh const &mesh, Exchange const &exchange)
{
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::largestCell", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, double &l) { l = Math::max(l, mesh.cell_area(cell)); }, Kokkos::Max<double>(largest));
  long long cells[1] = {mesh.num_owned_cells};
  exchange.sum(cells, 1);
  return reproducibleSum(exchange.max(largest), cells[0]);
}

/// The largest pair of a full cell takes the round-off: fractions sum to one.
void applyWeights(Mesh const &mesh, WeightedFractions const &fractions)
{
  auto const pairs = fractions.pairs;
  auto const record = fractions.record;
  View<double *> const made("Harmos::restoredFraction", pairs.num_pairs);
  Kokkos::parallel_for(
      "Harmos::restoredFraction", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair) { made(pair) = fractions.at(pair); });
  Kokkos::parallel_for(
      "Harmos::storeFraction", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        if (pairs.cell_kind(cell) != MixedCell)
          return;
        double filled = 0.0, others = 0.0;
        int largest = pairs.offset(cell);
        for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
        {
          filled += record(pair, VolumeFraction);
          largest = made(pair) > made(largest) ? pair : largest;
        }
        for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
        {
          record(pair, VolumeFraction) = made(pair);
          others += pair == largest ? 0.0 : made(pair);
        }
        if (!(1.0 - filled > full_tolerance))
          record(largest, VolumeFraction) = 1.0 - others;
      });
}

} // namespace

std::vector<double> materialVolumes(Mesh const &mesh, CellMaterialPairs const &pairs,
                                    View<double *[num_pair_fields]> const &record, int num_materials,
                                    Exchange const &exchange)
{
  View<double *> const weight("Harmos::weight", num_materials);
  Kokkos::deep_copy(weight, 1.0);
  ReproducibleSum const sum = volumeSum(mesh, exchange);
  std::vector<double> volumes;
  for (int m = 0; m < num_materials; ++m)
    volumes.push_back(volumeOf(mesh, {pairs, record, weight}, m, sum, exchange));
  return volumes;
}

RestoredVolumes restoreVolumes(Mesh const &mesh, CellMaterialPairs const &pairs,
                               View<double *[num_pair_fields]> const &record, std::vector<double> const &target,
                               Exchange const &exchange)
{
  int const materials = static_cast<int>(target.size());
  double const scale = *std::max_element(target.begin(), target.end());
  double const tolerance = 2e-16 * scale, refused = 1e-13 * scale;
  ReproducibleSum const sum = volumeSum(mesh, exchange);
  View<double *> const weight("Harmos::weight", materials);
  WeightedFractions const fractions{pairs, record, weight};
  auto const host_weight = Kokkos::create_mirror_view(weight);
  Kokkos::deep_copy(host_weight, 1.0);

  RestoredVolumes result;
  double last = 1e300;
  for (;; ++result.iterations)
  {
    Kokkos::deep_copy(weight, host_weight);
    std::vector<double> missing(target), rate;
    double largest = 0.0, all = 0.0;
    for (int m = 0; m < materials; ++m)
    {
      missing[m] -= volumeOf(mesh, fractions, m, sum, exchange);
      largest = std::max(largest, std::fabs(missing[m]));
      all += std::fabs(missing[m]);
    }
    if (result.iterations == 0)
      result.moved = all;
    result.defect = largest / scale;
    bool const round_off = largest <= refused && largest >= last;
    if (largest <= tolerance || round_off || result.iterations == most_iterations)
      break;
    last = largest;
    for (int m = 0; m < materials; ++m)
      for (int k = 0; k < materials; ++k)
        rate.push_back(volumeRate(mesh, fractions, m, k, sum, exchange));
    std::vector<double> const change = solveSemiDefinite(rate, missing);
    for (int m = 0; m < materials; ++m)
      host_weight(m) *= std::exp(std::clamp(change[m], -0.5, 0.5));
  }
  if (!(result.defect * scale <= refused))
    throw std::runtime_error("the volumes of the materials could not be restored: " + std::to_string(result.defect) +
                             " of the largest is missing (no mixed cell can take it)");
  applyWeights(mesh, fractions);
  return result;
}

} // namespace Harmos
