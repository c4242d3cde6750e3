// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_GLOBAL_ORDER_HPP
#define HARMOS_GLOBAL_ORDER_HPP

#include <mpi.h>

#include <vector>

namespace Harmos
{

/// Rows of values: row i holds value[offset[i]] .. value[offset[i + 1] - 1].
template <class T>
struct RowsOf
{
  std::vector<long long> offset;
  std::vector<T> value;
};

/// Brings items that the ranks hold by cell (or node) into the order of global numbers, so that a file does not depend
/// on the number of ranks.
///
/// Rank r of P receives the items of the numbers [N r / P, N (r + 1) / P), ascending; items of one number keep their
/// order. One all-to-all an array; with one rank nothing moves.
class GlobalOrder
{
public:
  /// \param key    Global number of each item here, ascending; all items of one number live on one rank.
  /// \param length N: one more than the largest number on any rank; -1: found by a reduction.
  GlobalOrder(MPI_Comm comm, std::vector<long long> key, long long length = -1);

  /// Items of `width` values each.
  template <class T>
  std::vector<T> arrange(std::vector<T> const &value, int width = 1) const;

  /// Items of different lengths.
  template <class T>
  RowsOf<T> arrange(RowsOf<T> const &rows) const;

  long long length() const { return length_; }               // N
  long long count() const { return count_; }                 // items here after the arrangement
  long long first() const { return first_; }                 // items before them, on lower ranks
  long long total() const { return total_; }                 // items on all ranks
  std::vector<long long> const &key() const { return key_; } // after the arrangement
  MPI_Comm comm() const { return comm_; }

private:
  MPI_Comm comm_;
  int size_ = 1;
  long long length_ = 0, count_ = 0, first_ = 0, total_ = 0;
  std::vector<long long> key_;
  std::vector<int> sent_, received_; // items to and from each rank
  std::vector<int> order_;           // position in the received items of each arranged one
};

/// Sum over ranks and the sum over lower ranks.
struct Placement
{
  long long first, total;
};
Placement place(MPI_Comm comm, long long count);

} // namespace Harmos

#endif
