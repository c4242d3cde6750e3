// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_SkylineCholesky.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Harmos
{

void LowerTriangle::multiply(std::vector<double> const &x, std::vector<double> &out) const
{
  out.assign(x.size(), 0.0);
  for (int i = 0; i < size(); ++i)
  {
    double sum = 0.0;
    for (int e = offset[i]; e < offset[i + 1]; ++e)
    {
      int const j = column[e];
      sum += value[e] * x[j];
      if (j != i)
        out[j] += value[e] * x[i];
    }
    out[i] += sum;
  }
}

double dot(std::vector<double> const &a, std::vector<double> const &b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

LowerTriangle byRows(std::vector<MatrixEntry> const &entry, std::size_t size)
{
  LowerTriangle matrix;
  matrix.offset.assign(size + 1, 0);
  for (MatrixEntry const &x : entry)
    ++matrix.offset[x.row + 1];
  std::partial_sum(matrix.offset.begin(), matrix.offset.end(), matrix.offset.begin());
  std::vector<int> next(matrix.offset.begin(), matrix.offset.end() - 1);
  matrix.column.resize(entry.size());
  matrix.value.resize(entry.size());
  for (MatrixEntry const &x : entry)
  {
    matrix.column[next[x.row]] = x.column;
    matrix.value[next[x.row]++] = x.value;
  }
  return matrix;
}

namespace
{

/// Unknowns by the number of their neighbours, those of equal number in their own order.
std::vector<int> byNeighbours(std::vector<int> const &offset)
{
  int const n = static_cast<int>(offset.size()) - 1;
  std::vector<int> place(1, 0);
  for (int i = 0; i < n; ++i)
  {
    std::size_t const behind = static_cast<std::size_t>(offset[i + 1] - offset[i]) + 1;
    if (behind >= place.size())
      place.resize(behind + 1, 0);
    ++place[behind];
  }
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<int> start(n);
  for (int i = 0; i < n; ++i)
    start[place[offset[i + 1] - offset[i]]++] = i;
  return start;
}

} // namespace

std::vector<int> reverseCuthillMcKee(std::vector<int> const &offset, std::vector<int> const &item)
{
  int const n = static_cast<int>(offset.size()) - 1;
  auto const fewerNeighbours = [&](int a, int b)
  {
    int const degree_a = offset[a + 1] - offset[a], degree_b = offset[b + 1] - offset[b];
    return degree_a != degree_b ? degree_a < degree_b : a < b;
  };
  std::vector<int> const start = byNeighbours(offset);
  std::vector<int> order;
  order.reserve(n);
  std::vector<char> seen(n, 0);
  auto const append = [&](int i)
  {
    if (!seen[i])
      order.push_back(i);
    seen[i] = 1;
  };
  std::size_t next = 0;
  for (int const first : start)
    for (append(first); next < order.size(); ++next)
    {
      int const here = order[next];
      std::ptrdiff_t const begin = static_cast<std::ptrdiff_t>(order.size());
      for (int e = offset[here]; e < offset[here + 1]; ++e)
        append(item[e]);
      std::sort(order.begin() + begin, order.end(), fewerNeighbours);
    }
  std::reverse(order.begin(), order.end());
  return order;
}

void SkylineCholesky::factor(LowerTriangle const &a, std::vector<char> const &kept, std::vector<double> const &shift,
                             double least)
{
  kept_.clear();
  place_.assign(kept.size(), -1);
  for (int i = 0; i < a.size(); ++i)
    if (kept[i])
    {
      place_[i] = static_cast<int>(kept_.size());
      kept_.push_back(i);
    }
  int const n = static_cast<int>(kept_.size());
  first_.resize(n);
  base_.resize(n);
  std::ptrdiff_t total = 0;
  for (int i = 0; i < n; ++i)
  {
    first_[i] = i;
    for (int e = a.offset[kept_[i]]; e < a.offset[kept_[i] + 1]; ++e)
      if (kept[a.column[e]])
        first_[i] = std::min(first_[i], place_[a.column[e]]);
    base_[i] = total - first_[i];
    total += i - first_[i] + 1;
  }
  value_.assign(total, 0.0);
  for (int i = 0; i < n; ++i)
  {
    double *const row = value_.data();
    std::ptrdiff_t const base = base_[i];
    for (int e = a.offset[kept_[i]]; e < a.offset[kept_[i] + 1]; ++e)
      if (kept[a.column[e]])
        row[base + place_[a.column[e]]] += a.value[e];
    double const diagonal = row[base + i] + shift[kept_[i]];
    double pivot = diagonal < least ? 1.0 : diagonal;
    for (int j = first_[i]; j < i; ++j)
    {
      std::ptrdiff_t const other = base_[j];
      double sum = row[base + j];
      for (int k = std::max(first_[i], first_[j]); k < j; ++k)
        sum -= row[base + k] * row[other + k];
      row[base + j] = sum / row[other + j];
      pivot -= row[base + j] * row[base + j];
    }
    row[base + i] = std::sqrt(std::max(pivot, shift[kept_[i]]));
  }
}

void SkylineCholesky::solve(std::vector<double> &x) const
{
  int const n = static_cast<int>(kept_.size());
  work_.resize(n);
  for (int i = 0; i < n; ++i)
  {
    double sum = x[kept_[i]];
    for (int k = first_[i]; k < i; ++k)
      sum -= value_[base_[i] + k] * work_[k];
    work_[i] = sum / value_[base_[i] + i];
  }
  std::fill(x.begin(), x.end(), 0.0);
  for (int i = n - 1; i >= 0; --i)
  {
    double const solved = work_[i] / value_[base_[i] + i];
    x[kept_[i]] = solved;
    for (int k = first_[i]; k < i; ++k)
      work_[k] -= solved * value_[base_[i] + k];
  }
}

} // namespace Harmos
