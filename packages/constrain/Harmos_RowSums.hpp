// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ROW_SUMS_HPP
#define HARMOS_ROW_SUMS_HPP

#include <Harmos_Exchange.hpp>
#include <Harmos_Launch.hpp>
#include <Harmos_ReducedValues.hpp>

#include <array>

namespace Harmos
{

/// The columns' sums in quanta: all in one reduction.
template <int Width>
struct ColumnQuanta
{
  using value_type = long long[];
  unsigned value_count = Width;
  View<double *[Width]> term;
  ReproducibleSum sum;

  KOKKOS_INLINE_FUNCTION void operator()(int i, long long *quanta) const
  {
    for (int c = 0; c < Width; ++c)
      quanta[c] += sum.quanta(term(i, c));
  }
};

/// Sums of the columns of an array over the rows of all ranks, the same bits for any distribution of the rows.
///
/// The columns are of like size: they share one quantum, 1e-18 of the largest entry times `items`.
/// \param items Number of rows over all ranks, or more. Collective.
template <int Width>
std::array<double, Width> reproducibleColumnSums(View<double *[Width]> const &term, long long items,
                                                 Exchange const &exchange)
{
  int const count = static_cast<int>(term.extent(0));
  double largest = 0.0;
  launchReduce(
      "Harmos::constrain::largestTerm", count,
      KOKKOS_LAMBDA(int i, double &l) {
        for (int c = 0; c < Width; ++c)
          l = Math::max(l, Math::fabs(term(i, c)));
      },
      Kokkos::Max<double>(largest));
  ReproducibleSum const sum = reproducibleSum(exchange.max(count > 0 ? largest : 0.0), items);
  std::array<long long, Width> quanta = {};
  Kokkos::parallel_reduce("Harmos::constrain::sumTerms", RangePolicy(0, count), ColumnQuanta<Width>{Width, term, sum},
                          ReducedValues<long long>(quanta.data(), Width));
  Kokkos::fence();
  exchange.sum(quanta.data(), Width);
  std::array<double, Width> result;
  for (int c = 0; c < Width; ++c)
    result[static_cast<std::size_t>(c)] = sum.value(quanta[static_cast<std::size_t>(c)]);
  return result;
}

} // namespace Harmos

#endif
