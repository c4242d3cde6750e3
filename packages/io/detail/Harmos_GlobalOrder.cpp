// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_GlobalOrder.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace Harmos
{

namespace
{

std::vector<int> displacements(std::vector<int> const &count)
{
  std::vector<int> start(count.size(), 0);
  std::partial_sum(count.begin(), count.end() - 1, start.begin() + 1);
  return start;
}

template <class T>
std::vector<T> exchange(MPI_Comm comm, std::vector<T> const &value, int width, std::vector<int> const &sent,
                        std::vector<int> const &received)
{
  std::vector<T> result(static_cast<std::size_t>(std::accumulate(received.begin(), received.end(), 0LL)) *
                        static_cast<std::size_t>(width));
  MPI_Datatype item;
  MPI_Type_contiguous(width * static_cast<int>(sizeof(T)), MPI_BYTE, &item);
  MPI_Type_commit(&item);
  MPI_Alltoallv(value.data(), sent.data(), displacements(sent).data(), item, result.data(), received.data(),
                displacements(received).data(), item, comm);
  MPI_Type_free(&item);
  return result;
}

} // namespace

Placement place(MPI_Comm comm, long long count)
{
  Placement p{0, 0};
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  MPI_Exscan(&count, &p.first, 1, MPI_LONG_LONG, MPI_SUM, comm);
  if (rank == 0)
    p.first = 0;
  MPI_Allreduce(&count, &p.total, 1, MPI_LONG_LONG, MPI_SUM, comm);
  return p;
}

GlobalOrder::GlobalOrder(MPI_Comm comm, std::vector<long long> key, long long length)
    : comm_(comm), length_(length), key_(std::move(key))
{
  if (!std::is_sorted(key_.begin(), key_.end()))
    throw std::invalid_argument("GlobalOrder: local items are not in the order of their global numbers");
  MPI_Comm_size(comm_, &size_);
  if (length_ < 0)
  {
    long long const here = key_.empty() ? 0 : key_.back() + 1;
    MPI_Allreduce(&here, &length_, 1, MPI_LONG_LONG, MPI_MAX, comm_);
  }
  if (size_ > 1)
  {
    sent_.assign(static_cast<std::size_t>(size_), 0);
    received_ = sent_;
    for (long long k : key_)
      ++sent_[static_cast<std::size_t>(k * size_ / length_)];
    MPI_Alltoall(sent_.data(), 1, MPI_INT, received_.data(), 1, MPI_INT, comm_);
    auto const arrived = exchange(comm_, key_, 1, sent_, received_);
    order_.resize(arrived.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return arrived[a] < arrived[b]; });
    key_.resize(arrived.size());
    for (std::size_t i = 0; i < order_.size(); ++i)
      key_[i] = arrived[order_[i]];
  }
  count_ = static_cast<long long>(key_.size());
  auto const placed = place(comm_, count_);
  first_ = placed.first;
  total_ = placed.total;
}

template <class T>
std::vector<T> GlobalOrder::arrange(std::vector<T> const &value, int width) const
{
  if (size_ == 1)
    return value;
  auto const arrived = exchange(comm_, value, width, sent_, received_);
  std::vector<T> result(arrived.size());
  for (std::size_t i = 0; i < order_.size(); ++i)
    std::copy_n(arrived.begin() + static_cast<std::ptrdiff_t>(order_[i]) * width, width,
                result.begin() + static_cast<std::ptrdiff_t>(i) * width);
  return result;
}

template <class T>
RowsOf<T> GlobalOrder::arrange(RowsOf<T> const &rows) const
{
  if (size_ == 1)
    return rows;
  std::size_t const num_rows = rows.offset.size() - 1;
  std::vector<int> row_length(num_rows);
  for (std::size_t i = 0; i < num_rows; ++i)
    row_length[i] = static_cast<int>(rows.offset[i + 1] - rows.offset[i]);

  auto const arrived_length = exchange(comm_, row_length, 1, sent_, received_);
  auto valuesPerRank = [&](std::vector<int> const &items, std::vector<int> const &lengths)
  {
    std::vector<int> sum(items.size(), 0);
    std::size_t row = 0;
    for (std::size_t rank = 0; rank < items.size(); ++rank)
      for (int i = 0; i < items[rank]; ++i)
        sum[rank] += lengths[row++];
    return sum;
  };
  auto const arrived =
      exchange(comm_, rows.value, 1, valuesPerRank(sent_, row_length), valuesPerRank(received_, arrived_length));
  std::vector<long long> arrived_offset(arrived_length.size() + 1, 0);
  std::partial_sum(arrived_length.begin(), arrived_length.end(), arrived_offset.begin() + 1);

  RowsOf<T> result;
  result.offset.assign(1, 0);
  result.value.reserve(arrived.size());
  for (int i : order_)
  {
    result.value.insert(result.value.end(), arrived.begin() + arrived_offset[i],
                        arrived.begin() + arrived_offset[i + 1]);
    result.offset.push_back(static_cast<long long>(result.value.size()));
  }
  return result;
}

template std::vector<double> GlobalOrder::arrange(std::vector<double> const &, int) const;
template std::vector<int> GlobalOrder::arrange(std::vector<int> const &, int) const;
template std::vector<long long> GlobalOrder::arrange(std::vector<long long> const &, int) const;
template RowsOf<double> GlobalOrder::arrange(RowsOf<double> const &) const;

} // namespace Harmos
