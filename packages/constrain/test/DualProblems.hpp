// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_DUAL_PROBLEMS_HPP
#define HARMOS_TEST_DUAL_PROBLEMS_HPP

#include <Harmos_DualProblem.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace HarmosTest
{

using namespace Harmos;

using Dense = std::vector<std::vector<double>>;

inline LowerTriangle lowerOf(Dense const &a)
{
  LowerTriangle lower;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t j = 0; j <= i; ++j)
      if (a[i][j] != 0.0)
      {
        lower.column.push_back(static_cast<int>(j));
        lower.value.push_back(a[i][j]);
      }
    lower.offset.push_back(static_cast<int>(lower.column.size()));
  }
  return lower;
}

/// Between -1 and 1.
inline std::vector<double> randomNumbers(int n, std::mt19937 &engine)
{
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> numbers(n);
  for (double &x : numbers)
    x = uniform(engine);
  return numbers;
}

/// B B^T of random numbers within a band, and a little of the unit matrix.
inline Dense randomMatrix(int n, int band, std::mt19937 &engine)
{
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Dense b(n, std::vector<double>(n, 0.0)), a = b;
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - band); j <= i; ++j)
      b[i][j] = uniform(engine);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
    {
      a[i][j] = i == j ? 0.02 : 0.0;
      for (int k = 0; k < n; ++k)
        a[i][j] += b[i][k] * b[j][k] / (band + 1.0);
    }
  return a;
}

/// Gaussian elimination with row exchanges.
inline std::vector<double> gauss(Dense a, std::vector<double> b)
{
  int const n = static_cast<int>(b.size());
  for (int k = 0; k < n; ++k)
  {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      pivot = std::fabs(a[i][k]) > std::fabs(a[pivot][k]) ? i : pivot;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (int i = k + 1; i < n; ++i)
    {
      double const f = a[i][k] / a[k][k];
      for (int j = k; j < n; ++j)
        a[i][j] -= f * a[k][j];
      b[i] -= f * b[k];
    }
  }
  for (int k = n - 1; k >= 0; --k)
  {
    for (int j = k + 1; j < n; ++j)
      b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

inline DualProblem problemOf(Dense const &a, std::vector<double> const &b, std::vector<char> const &tied)
{
  std::size_t const n = b.size();
  DualProblem problem;
  problem.matrix = lowerOf(a);
  problem.b = b;
  problem.root.assign(n, 1.0);
  problem.tied = tied;
  problem.normal_of.assign(n, -1);
  problem.friction.assign(n, 0.0);
  return problem;
}

/// Rows of a long interface: each closes a gap between four of fewer velocities than there are rows, so that rows
/// depend on each other; with friction every second unknown is along the interface, and feels a little of its
/// neighbours.
inline DualProblem stripOfRows(int rows, double friction, std::mt19937 &engine)
{
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int const directions = friction > 0.0 ? 2 : 1, n = directions * rows, velocities = 4 * rows / 5 + 4;
  Dense rows_of(n, std::vector<double>(4));
  std::vector<double> v(directions * velocities);
  for (double &x : v)
    x = uniform(engine) - 0.3;
  std::vector<int> first(n);
  DualProblem problem;
  for (int i = 0; i < n; ++i)
  {
    int const row = i / directions, k = i % directions;
    first[i] = 4 * row / 5;
    double const along = row / 1.25 - first[i], normal = 0.5; // sqrt of the largest row sum
    rows_of[i] = {normal * (1.0 - along) / 2.0, normal / 2.0, normal * along / 2.0, 0.05 * normal};
    problem.b.push_back(0.0);
    for (int c = 0; c < 4; ++c)
      problem.b[i] += rows_of[i][c] * v[k * velocities + first[i] + c];
    for (int j = 0; j <= i; ++j)
    {
      if (first[j] + 3 < first[i])
        continue;
      double sum = 0.0;
      for (int c = 0; c < 4; ++c)
        if (first[i] + c >= first[j] && first[i] + c < first[j] + 4)
          sum += rows_of[i][c] * rows_of[j][first[i] + c - first[j]];
      problem.matrix.column.push_back(j);
      problem.matrix.value.push_back(k == j % directions ? sum : 0.02 * sum);
    }
    problem.matrix.offset.push_back(static_cast<int>(problem.matrix.column.size()));
    problem.normal_of.push_back(k == 1 ? i - 1 : -1);
    problem.friction.push_back(k == 1 ? friction : 0.0);
  }
  problem.root.assign(n, 1.0);
  problem.tied.assign(n, 0);
  return problem;
}

/// Largest violation of the conditions of contact and Coulomb's friction, worked out apart from the solver.
inline double violationOf(DualProblem const &problem, std::vector<double> const &x)
{
  std::vector<double> r;
  problem.multiply(x, r);
  double most = 0.0;
  for (int i = 0; i < problem.size(); ++i)
  {
    double const g = r[i] + problem.b[i],
                 reach = problem.normal_of[i] < 0 ? 1e300 : problem.friction[i] * x[problem.normal_of[i]];
    double const low = problem.normal_of[i] < 0 ? 0.0 : -reach;
    if (x[i] < low || x[i] > reach)
      return 1e300;
    bool const held = (x[i] <= low && g >= 0.0) || (x[i] >= reach && g <= 0.0) || reach == 0.0;
    most = std::max(most, held ? 0.0 : std::fabs(g));
  }
  return most;
}

/// The solution among all choices of which sliding unknowns are zero: the one that satisfies every condition.
inline std::vector<double> byEnumeration(Dense const &a, std::vector<double> const &b, std::vector<char> const &tied)
{
  int const n = static_cast<int>(b.size());
  for (int choice = 0; choice < 1 << n; ++choice)
  {
    Dense m = a;
    std::vector<double> right(n);
    bool wanted = true;
    for (int i = 0; i < n; ++i)
    {
      bool const zero = (choice >> i & 1) == 1;
      wanted = wanted && !(zero && tied[i]);
      right[i] = zero ? 0.0 : -b[i];
      for (int j = 0; zero && j < n; ++j)
        m[i][j] = i == j ? 1.0 : 0.0;
    }
    if (!wanted)
      continue;
    std::vector<double> const x = gauss(m, right);
    for (int i = 0; i < n; ++i)
    {
      double r = b[i];
      for (int j = 0; j < n; ++j)
        r += a[i][j] * x[j];
      wanted = wanted && (tied[i] || (x[i] >= -1e-12 && r >= -1e-12));
    }
    if (wanted)
      return x;
  }
  return {};
}

/// Random problems, every second one with tied unknowns, against byEnumeration.
/// \param solve Impulses of a problem.
template <class Solve>
void expectSolutionsOfEnumeration(Solve const &solve)
{
  std::mt19937 engine(11);
  for (int trial = 0; trial < 40; ++trial)
  {
    int const n = 9;
    Dense const a = randomMatrix(n, 3, engine);
    std::vector<double> const b = randomNumbers(n, engine);
    std::vector<char> tied(n);
    for (int i = 0; i < n; ++i)
      tied[i] = trial % 2 == 1 && i % 4 == 0 ? 1 : 0;
    std::vector<double> const exact = byEnumeration(a, b, tied), found = solve(problemOf(a, b, tied));
    ASSERT_EQ(exact.size(), b.size());
    ASSERT_EQ(found.size(), b.size());
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(found[i], exact[i], 1e-7 * (1.0 + std::fabs(exact[i]))) << "trial " << trial;
  }
}

} // namespace HarmosTest

#endif
