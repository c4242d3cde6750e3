// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DUAL_ROWS_HPP
#define HARMOS_DUAL_ROWS_HPP

#include <Harmos_ContactSystem.hpp>

#include <algorithm>
#include <type_traits>

namespace Harmos
{

/// A row without its couplings.
struct DualRow
{
  double directions, tied, friction;
  double predicted[2], diagonal[2], compliance[2], opening;
  double body[2];        // compact numbers
  double jacobian[2][6]; // by direction: of side a's body, of side b's
};

/// The coupling of a row to one that is not behind it in the order of keys.
struct DualBlock
{
  double value[2][2]; // by direction of the row, of the other row
};

/// Rows with their couplings, in the order of keys.
struct DualRows
{
  std::vector<long long> key;
  std::vector<DualRow> row;
  std::vector<int> count; // blocks of a row, each with another row
  std::vector<int> other; // number of the other row of a block
  std::vector<DualBlock> block;
};

template <class T>
std::vector<T> toHost(View<T *> const &view)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
  return std::vector<T>(host.data(), host.data() + host.extent(0));
}

/// The items of all ranks, in the order of ranks.
template <class T>
std::vector<T> gathered(std::vector<T> const &mine, Exchange const &exchange)
{
  static_assert(std::is_trivially_copyable<T>::value, "travels as bytes");
  auto const first = reinterpret_cast<char const *>(mine.data());
  std::vector<char> const bytes = exchange.gather({first, first + mine.size() * sizeof(T)});
  std::vector<T> all(bytes.size() / sizeof(T));
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char *>(all.data()));
  return all;
}

/// Keys of this rank's rows, the halo's included.
View<long long *> keysOf(ContactRows const &rows, WorkArrays const &work);

/// This rank's own rows; other rows by their numbers on this rank.
DualRows ownRows(ContactSystem const &system, View<long long *> const &key, WorkArrays const &work);

/// The rows of all ranks in the order of keys; other rows by their places in it. Collective.
/// \param key Of this rank's rows, the halo's included. \param place Out: where each of them is; -1: nowhere.
DualRows allRows(DualRows own, View<long long *> const &key, Exchange const &exchange, std::vector<int> &place);

} // namespace Harmos

#endif
