// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ShiftedSystem.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

namespace
{

/// The deformable part with those free bodies that few unknowns move: their share is a dense block of those. Empty
/// where there are none.
LowerTriangle withSmallBodies(DualProblem const &problem)
{
  std::vector<std::vector<BodyEntry>> by_component(problem.body_weight.size());
  for (BodyEntry const &e : problem.body)
    by_component[e.component].push_back(e);
  std::vector<MatrixEntry> entry;
  for (std::size_t c = 0; c < by_component.size(); ++c)
    for (std::size_t k = 0; isSmallBody(static_cast<int>(by_component[c].size())) && k < by_component[c].size(); ++k)
      for (BodyEntry const &other : by_component[c])
      {
        BodyEntry const &e = by_component[c][k];
        if (other.unknown <= e.unknown)
          entry.push_back({e.unknown, other.unknown, e.jacobian * other.jacobian * problem.body_weight[c]});
      }
  if (entry.empty())
    return {};
  LowerTriangle const &m = problem.matrix;
  for (int i = 0; i < m.size(); ++i)
    for (int e = m.offset[i]; e < m.offset[i + 1]; ++e)
      entry.push_back({i, m.column[e], m.value[e]});
  return byRows(entry, problem.b.size());
}

} // namespace

ShiftedSystem::ShiftedSystem(DualProblem const &problem) : problem_(problem), with_bodies_(withSmallBodies(problem)) {}

double ShiftedSystem::largest(std::vector<double> const &v) const
{
  double most = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i)
    most = std::max(most, problem_.root[i] * std::fabs(v[i]));
  return most;
}

void ShiftedSystem::factor(std::vector<char> const &free, std::vector<double> const &shift)
{
  constexpr double least = 1e-10; // a diagonal entry of the scaled matrix, whose deformable row sums are at most one
  free_ = free;
  shift_ = shift;
  factor_.factor(factored(), free_, shift_, least);
}

void ShiftedSystem::factorSliding(std::vector<char> const &free, std::vector<double> const &shift,
                                  std::vector<double> const &slides)
{
  free_ = free;
  shift_ = shift;
  slides_ = slides;
  LowerTriangle const &a = factored();
  number_.assign(a.size(), 0);
  int count = 0;
  for (int i = 0; i < a.size(); ++i)
    number_[i] = free_[i] ? count++ : 0;
  of_free_.resize(count);
  std::vector<MatrixEntry> entry;
  auto const add = [&](int i, int j, double value)
  {
    if (free_[i] && free_[j])
      entry.push_back({number_[i], number_[j], value});
    else if (free_[i] && slides_[j] != 0.0)
      entry.push_back({number_[i], number_[problem_.normal_of[j]], slides_[j] * value});
  };
  for (int i = 0; i < a.size(); ++i)
  {
    add(i, i, shift_[i]);
    for (int e = a.offset[i]; e < a.offset[i + 1]; ++e)
    {
      add(i, a.column[e], a.value[e]);
      if (a.column[e] != i)
        add(a.column[e], i, a.value[e]);
    }
  }
  sliding_factor_.factor(entry, of_free_.size());
}

void ShiftedSystem::precondition(std::vector<double> &v)
{
  for (std::size_t i = 0; i < v.size(); ++i)
    if (free_[i])
      of_free_[number_[i]] = v[i];
  sliding_factor_.solve(of_free_);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = free_[i] ? of_free_[number_[i]] : 0.0;
}

int ShiftedSystem::solve(std::vector<double> &residual, double good, int most, std::vector<double> &step,
                         std::vector<double> &image)
{
  std::size_t const n = residual.size();
  step.assign(n, 0.0);
  image.assign(n, 0.0);
  direction_.assign(n, 0.0);
  double before = 0.0;
  int iterations = 0;
  while (iterations < most && largest(residual) > good)
  {
    z_ = residual;
    factor_.solve(z_);
    double const now = dot(residual, z_), share = iterations > 0 ? now / before : 0.0;
    ++iterations;
    for (std::size_t i = 0; i < n; ++i)
      direction_[i] = z_[i] + share * direction_[i];
    problem_.multiply(direction_, product_);
    for (std::size_t i = 0; i < n; ++i)
      product_[i] += shift_[i] * direction_[i];
    double const curvature = dot(direction_, product_);
    if (!(curvature > 0.0))
      break;
    double const length = now / curvature;
    for (std::size_t i = 0; i < n; ++i)
    {
      step[i] += length * direction_[i];
      image[i] += length * (product_[i] - shift_[i] * direction_[i]);
      residual[i] -= free_[i] ? length * product_[i] : 0.0;
    }
    before = now;
  }
  return iterations;
}

void ShiftedSystem::applySliding(std::vector<double> &v, std::vector<double> &image, std::vector<double> &out) const
{
  for (std::size_t i = 0; i < v.size(); ++i)
    if (slides_[i] != 0.0)
      v[i] = slides_[i] * v[problem_.normal_of[i]];
  problem_.multiply(v, image);
  out.resize(v.size());
  for (std::size_t i = 0; i < v.size(); ++i)
    out[i] = free_[i] ? image[i] + shift_[i] * v[i] : 0.0;
}

int ShiftedSystem::solveSliding(std::vector<double> &residual, double good, int most, std::vector<double> &step,
                                std::vector<double> &image)
{
  std::size_t const n = residual.size();
  step.assign(n, 0.0);
  image.assign(n, 0.0);
  // Of each iteration: a direction, A of it, a unit vector q; (A + S) directions = Q R in the free unknowns.
  std::vector<std::vector<double>> direction, its_image, q, column;
  std::vector<double> share; // Q^T right
  int iterations = 0;
  while (iterations < most && largest(residual) > good)
  {
    direction.push_back(residual);
    its_image.emplace_back();
    precondition(direction.back());
    ++iterations;
    applySliding(direction.back(), its_image.back(), product_);
    double const before = std::sqrt(dot(product_, product_));
    column.emplace_back();
    for (std::vector<double> const &other : q)
    {
      column.back().push_back(dot(product_, other));
      for (std::size_t i = 0; i < n; ++i)
        product_[i] -= column.back().back() * other[i];
    }
    double const length = std::sqrt(dot(product_, product_));
    if (!(length > 1e-14 * before))
    {
      column.pop_back();
      break;
    }
    column.back().push_back(length);
    for (double &x : product_)
      x /= length;
    q.push_back(product_);
    share.push_back(dot(residual, product_));
    for (std::size_t i = 0; i < n; ++i)
      residual[i] -= share.back() * product_[i];
  }
  std::vector<double> y = share;
  for (int k = static_cast<int>(column.size()) - 1; k >= 0; --k)
  {
    for (std::size_t j = k + 1; j < column.size(); ++j)
      y[k] -= column[j][k] * y[j];
    y[k] /= column[k][k];
    for (std::size_t i = 0; i < n; ++i)
    {
      step[i] += y[k] * direction[k][i];
      image[i] += y[k] * its_image[k][i];
    }
  }
  return iterations;
}

} // namespace Harmos
