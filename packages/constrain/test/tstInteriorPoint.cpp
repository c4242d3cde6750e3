// SPDX-License-Identifier: BSD-3-Clause
#include "DualProblems.hpp"

#include <Harmos_InteriorPoint.hpp>

#include <gtest/gtest.h>

#include <numeric>

using namespace HarmosTest;

TEST(SkylineCholesky, anyPartOfABandedMatrix_isSolvedAsByGauss)
{
  std::mt19937 engine(3);
  int const n = 30;
  Dense const a = randomMatrix(n, 4, engine);
  std::vector<double> const b = randomNumbers(n, engine);
  std::vector<char> kept(n);
  for (int i = 0; i < n; ++i)
    kept[i] = i % 7 != 3 && i != 12 ? 1 : 0;
  Dense part = a;
  std::vector<double> right = b;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (!kept[i] || !kept[j])
      {
        part[i][j] = i == j ? 1.0 : 0.0;
        right[i] = kept[i] ? right[i] : 0.0;
      }
  SkylineCholesky factor;
  factor.factor(lowerOf(a), kept, std::vector<double>(n, 1e-300), 0.0);
  std::vector<double> x = b;
  factor.solve(x);
  std::vector<double> const exact = gauss(part, right);
  for (int i = 0; i < n; ++i)
    EXPECT_NEAR(x[i], exact[i], 1e-8 * std::fabs(exact[i]) + 1e-10);
}

// A chain whose links are numbered at random comes back as a chain.
// Pivots vanish without exchanges of rows; three diagonals below, one above.
TEST(BandLu, anUnsymmetricBandMatrixWithZeroPivots_isSolvedAsByGauss)
{
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int const n = 23;
  Dense a(n, std::vector<double>(n, 0.0));
  std::vector<MatrixEntry> entry;
  std::vector<double> right(n);
  for (int i = 0; i < n; ++i)
  {
    right[i] = uniform(engine);
    for (int j = std::max(i - 3, 0); j <= std::min(i + 1, n - 1); ++j)
    {
      a[i][j] = i == j && i % 4 == 0 ? 0.0 : uniform(engine);
      entry.push_back({i, j, 0.25 * a[i][j]});
      entry.push_back({i, j, 0.75 * a[i][j]}); // added up
    }
  }
  BandLu factor;
  factor.factor(entry, n);
  std::vector<double> x = right;
  factor.solve(x);
  std::vector<double> const exact = gauss(a, right);
  for (int i = 0; i < n; ++i)
    EXPECT_NEAR(x[i], exact[i], 1e-11 * (1.0 + std::fabs(exact[i])));
}

TEST(SkylineCholesky, cuthillMcKee_ofAShuffledChain_isTheChain)
{
  int const n = 50;
  std::vector<int> name(n);
  std::iota(name.begin(), name.end(), 0);
  std::shuffle(name.begin(), name.end(), std::mt19937(7));
  std::vector<std::vector<int>> neighbours(n);
  for (int i = 0; i + 1 < n; ++i)
  {
    neighbours[name[i]].push_back(name[i + 1]);
    neighbours[name[i + 1]].push_back(name[i]);
  }
  std::vector<int> offset = {0}, item;
  for (auto const &list : neighbours)
  {
    item.insert(item.end(), list.begin(), list.end());
    offset.push_back(static_cast<int>(item.size()));
  }
  std::vector<int> order = reverseCuthillMcKee(offset, item);
  if (order.front() != name.front())
    std::reverse(order.begin(), order.end());
  EXPECT_EQ(order, name);
}

TEST(InteriorPoint, randomProblems_haveTheSolutionOfEnumeration)
{
  expectSolutionsOfEnumeration(
      [](DualProblem const &problem)
      {
        ShiftedSystem system(problem);
        InteriorPoint interior(problem, system);
        EXPECT_LE(interior.solve(1e-10, 100), 30);
        return interior.impulses();
      });
}

// Friction's bounds move with the impulses along n; the path alone ends at the solution.
TEST(InteriorPoint, frictionSlidesAtItsBounds)
{
  std::mt19937 engine(14);
  DualProblem const problem = stripOfRows(200, 0.3, engine);
  ShiftedSystem system(problem);
  InteriorPoint interior(problem, system);
  EXPECT_LE(interior.solve(1e-9, 100), 50);
  std::vector<double> const x = interior.impulses();
  EXPECT_LE(violationOf(problem, x), 1e-8);
  int sliding = 0, sticking = 0;
  for (int i = 1; i < problem.size(); i += 2)
  {
    sliding += x[i - 1] > 0.0 && std::fabs(x[i]) >= 0.3 * x[i - 1] ? 1 : 0;
    sticking += x[i - 1] > 0.0 && std::fabs(x[i]) < 0.3 * x[i - 1] ? 1 : 0;
  }
  EXPECT_GT(sliding, 10);
  EXPECT_GT(sticking, 10);
}

namespace
{

/// A random matrix and a free body of these inverse masses that some unknowns touch.
DualProblem problemWithBody(int n, std::vector<int> const &touching, std::vector<double> const &inverse_mass,
                            std::mt19937 &engine)
{
  DualProblem problem = problemOf(randomMatrix(n, 2, engine), std::vector<double>(n, 0.0), std::vector<char>(n, 0));
  problem.body_weight = inverse_mass;
  for (int const unknown : touching)
  {
    std::vector<double> const jacobian = randomNumbers(3, engine);
    for (int c = 0; c < 3; ++c)
      problem.body.push_back({unknown, c, jacobian[c]});
  }
  return problem;
}

/// Solves for the free unknowns with random right sides, and compares with the matrix. \return Iterations.
int expectSolution(DualProblem const &problem, std::vector<char> const &free, std::mt19937 &engine)
{
  int const n = problem.size();
  ShiftedSystem system(problem);
  system.factor(free, std::vector<double>(n, 1e-12));
  std::vector<double> right = randomNumbers(n, engine), step, image, product;
  for (int i = 0; i < n; ++i)
    right[i] = free[i] ? right[i] : 0.0;
  std::vector<double> residual = right;
  int const iterations = system.solve(residual, 1e-10, 30, step, image);
  problem.multiply(step, product);
  for (int i = 0; i < n; ++i)
  {
    EXPECT_NEAR(image[i], product[i], 1e-11);
    EXPECT_NEAR(free[i] ? image[i] : 0.0, right[i], 1e-9);
    EXPECT_EQ(free[i] ? 0.0 : step[i], 0.0);
  }
  return iterations;
}

} // namespace

// A free body that three rows touch: its share of the matrix is in the factor, which alone would know nothing of it.
TEST(ShiftedSystem, aSmallBodyIsInTheFactor)
{
  std::mt19937 engine(8);
  int const n = 12;
  DualProblem const problem = problemWithBody(n, {1, 6, 11}, {5.0, 4.0, 30.0}, engine);
  EXPECT_EQ(expectSolution(problem, std::vector<char>(n, 1), engine), 1);
}

// A body that more rows touch than are factored: conjugate gradients find what the factor does not know.
TEST(ShiftedSystem, aLargeBodyTakesAFewIterations)
{
  std::mt19937 engine(18);
  int const n = 150;
  std::vector<int> every(n);
  std::iota(every.begin(), every.end(), 0);
  std::vector<char> free(n, 1);
  free[70] = 0;
  int const iterations = expectSolution(problemWithBody(n, every, {0.5, 0.4, 0.3}, engine), free, engine);
  EXPECT_GT(iterations, 1);
  EXPECT_LE(iterations, 8);
}

// Two impulses slide: they go with the two along n, in the direction that they have.
TEST(ShiftedSystem, slidingImpulsesGoWithThoseAlongTheNormal)
{
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int const n = 10;
  Dense const a = randomMatrix(n, 3, engine);
  DualProblem problem = problemOf(a, std::vector<double>(n, 0.0), std::vector<char>(n, 0));
  std::vector<char> free(n, 1);
  std::vector<double> slides(n, 0.0), right(n), step, image;
  for (int const i : {3, 7})
  {
    problem.normal_of[i] = i - 1;
    slides[i] = i == 3 ? 0.6 : -0.6;
    free[i] = 0;
  }
  free[9] = 0; // at its bound
  Dense coupled = a;
  for (int i = 0; i < n; ++i)
  {
    right[i] = free[i] ? uniform(engine) : 0.0;
    for (int j = 0; j < n; ++j)
      coupled[i][j] = free[i] ? a[i][j] : i == j ? 1.0 : slides[i] != 0.0 && j == i - 1 ? -slides[i] : 0.0;
  }
  ShiftedSystem system(problem);
  system.factorSliding(free, std::vector<double>(n, 1e-12), slides);
  std::vector<double> residual = right;
  EXPECT_EQ(system.solveSliding(residual, 1e-11, 30, step, image), 1);
  std::vector<double> const exact = gauss(coupled, right);
  for (int i = 0; i < n; ++i)
    EXPECT_NEAR(step[i], exact[i], 1e-8 * (1.0 + std::fabs(exact[i])));
}
