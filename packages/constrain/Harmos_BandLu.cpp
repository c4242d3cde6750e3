// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BandLu.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

void BandLu::factor(std::vector<MatrixEntry> const &entry, std::size_t size)
{
  size_ = static_cast<int>(size);
  below_ = above_ = 0;
  for (MatrixEntry const &e : entry)
  {
    below_ = std::max(below_, e.row - e.column);
    above_ = std::max(above_, e.column - e.row);
  }
  above_ += below_;
  width_ = below_ + above_ + 1;
  value_.assign(size * width_, 0.0);
  pivot_.resize(size);
  for (MatrixEntry const &e : entry)
    at(e.row, e.column) += e.value;
  for (int k = 0; k < size_; ++k)
  {
    int const last_row = std::min(k + below_, size_ - 1), last_column = std::min(k + above_, size_ - 1);
    int pivot = k;
    for (int i = k + 1; i <= last_row; ++i)
      if (std::fabs(at(i, k)) > std::fabs(at(pivot, k)))
        pivot = i;
    pivot_[k] = pivot;
    if (pivot != k)
      for (int j = k; j <= last_column; ++j)
        std::swap(at(pivot, j), at(k, j));
    if (at(k, k) == 0.0)
      continue;
    for (int i = k + 1; i <= last_row; ++i)
    {
      double const part = at(i, k) / at(k, k);
      at(i, k) = part;
      if (part == 0.0)
        continue;
      double const *const from = &at(k, k);
      double *const to = &at(i, k);
      for (int j = 1; j <= last_column - k; ++j)
        to[j] -= part * from[j];
    }
  }
}

void BandLu::solve(std::vector<double> &x) const
{
  for (int k = 0; k < size_; ++k)
  {
    std::swap(x[k], x[pivot_[k]]);
    for (int i = k + 1; i <= std::min(k + below_, size_ - 1); ++i)
      x[i] -= at(i, k) * x[k];
  }
  for (int k = size_ - 1; k >= 0; --k)
  {
    for (int j = k + 1; j <= std::min(k + above_, size_ - 1); ++j)
      x[k] -= at(k, j) * x[j];
    x[k] = at(k, k) != 0.0 ? x[k] / at(k, k) : 0.0;
  }
}

} // namespace Harmos
