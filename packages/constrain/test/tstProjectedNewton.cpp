// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <Harmos_InteriorPoint.hpp>
#include <Harmos_ProjectedNewton.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numeric>
#include <random>

using namespace HarmosTest;

namespace
{

using Dense = std::vector<std::vector<double>>;

LowerTriangle lowerOf(Dense const &a)
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

/// B B^T of random numbers within a band, and a little of the unit matrix.
Dense randomMatrix(int n, int band, std::mt19937 &engine)
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
std::vector<double> gauss(Dense a, std::vector<double> b)
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

DualProblem problemOf(Dense const &a, std::vector<double> const &b, std::vector<char> const &tied)
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
DualProblem stripOfRows(int rows, double friction, std::mt19937 &engine)
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
double violationOf(DualProblem const &problem, std::vector<double> const &x)
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
std::vector<double> byEnumeration(Dense const &a, std::vector<double> const &b, std::vector<char> const &tied)
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

} // namespace

TEST(SkylineCholesky, anyPartOfABandedMatrix_isSolvedAsByGauss)
{
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int const n = 30;
  Dense const a = randomMatrix(n, 4, engine);
  std::vector<char> kept(n);
  std::vector<double> b(n);
  for (int i = 0; i < n; ++i)
  {
    kept[i] = i % 7 != 3 && i != 12 ? 1 : 0;
    b[i] = uniform(engine);
  }
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

TEST(ProjectedNewton, randomProblems_haveTheSolutionOfEnumeration)
{
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 40; ++trial)
  {
    int const n = 9;
    Dense const a = randomMatrix(n, 3, engine);
    std::vector<double> b(n);
    std::vector<char> tied(n);
    for (int i = 0; i < n; ++i)
    {
      b[i] = uniform(engine);
      tied[i] = trial % 2 == 1 && i % 4 == 0 ? 1 : 0;
    }
    DualSolution const found = projectedNewton(problemOf(a, b, tied), 1e-12, 200);
    std::vector<double> const exact = byEnumeration(a, b, tied);
    ASSERT_EQ(exact.size(), b.size());
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(found.x[i], exact[i], 1e-7 * (1.0 + std::fabs(exact[i])));
    EXPECT_LE(found.iterations, 30);
  }
}

TEST(InteriorPoint, randomProblems_haveTheSolutionOfEnumeration)
{
  std::mt19937 engine(12);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 40; ++trial)
  {
    int const n = 9;
    Dense const a = randomMatrix(n, 3, engine);
    std::vector<double> b(n);
    std::vector<char> tied(n);
    for (int i = 0; i < n; ++i)
    {
      b[i] = uniform(engine);
      tied[i] = trial % 2 == 1 && i % 4 == 0 ? 1 : 0;
    }
    DualProblem const problem = problemOf(a, b, tied);
    ShiftedSystem system(problem);
    InteriorPoint interior(problem, system);
    EXPECT_LE(interior.solve(1e-10, 100), 30);
    std::vector<double> const exact = byEnumeration(a, b, tied), &found = interior.impulses();
    ASSERT_EQ(exact.size(), b.size());
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(found[i], exact[i], 1e-7 * (1.0 + std::fabs(exact[i])));
  }
}

// Friction's bounds move with the impulses along n; the path alone ends at the solution.
TEST(InteriorPoint, frictionSlidesAtItsBounds)
{
  std::mt19937 engine(14);
  DualProblem const problem = stripOfRows(200, 0.3, engine);
  ShiftedSystem system(problem);
  InteriorPoint interior(problem, system);
  EXPECT_LE(interior.solve(1e-9, 100), 50);
  std::vector<double> const &x = interior.impulses();
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

// Rows that depend on each other, thousands of which change between open and pressed, stuck and sliding.
TEST(ProjectedNewton, longStrips_needAtMostFiftyIterations)
{
  std::mt19937 engine(21);
  for (int const rows : {20, 200, 2000})
    for (double const friction : {0.0, 0.3})
    {
      DualProblem const problem = stripOfRows(rows, friction, engine);
      DualSolution const found = projectedNewton(problem, 1e-9, 200);
      EXPECT_LE(violationOf(problem, found.x), 1e-9) << rows << " " << friction;
      EXPECT_LE(found.iterations, 50) << rows << " " << friction;
      std::cout << rows << " rows, friction " << friction << ": " << found.iterations << " iterations\n";
    }
}

// A free body that three rows touch: its share of the matrix is in the factor, which alone would know nothing of it.
TEST(ShiftedSystem, aSmallBodyIsInTheFactor)
{
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int const n = 12;
  DualProblem problem = problemOf(randomMatrix(n, 2, engine), std::vector<double>(n, 0.0), std::vector<char>(n, 0));
  problem.body_weight = {5.0, 4.0, 30.0};
  for (int const unknown : {1, 6, 11})
    for (int c = 0; c < 3; ++c)
      problem.body.push_back({unknown, c, uniform(engine)});
  ShiftedSystem system(problem);
  system.factor(std::vector<char>(n, 1), std::vector<double>(n, 1e-12));
  std::vector<double> right(n), step, image;
  for (double &x : right)
    x = uniform(engine);
  std::vector<double> residual = right;
  EXPECT_EQ(system.solve(residual, 1e-9, 30, step, image), 1);
  problem.multiply(step, image);
  for (int i = 0; i < n; ++i)
    EXPECT_NEAR(image[i], right[i], 1e-8);
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
  system.factor(free, std::vector<double>(n, 1e-12));
  std::vector<double> residual = right;
  EXPECT_LE(system.solveSliding(residual, slides, 1e-11, 30, step, image), n);
  std::vector<double> const exact = gauss(coupled, right);
  for (int i = 0; i < n; ++i)
    EXPECT_NEAR(step[i], exact[i], 1e-8 * (1.0 + std::fabs(exact[i])));
}

// Every unknown twice, and one that nothing depends on: the impulses are not unique, the residual is.
TEST(ProjectedNewton, dependentRows_meetTheTolerance)
{
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int const n = 8;
  Dense const a = randomMatrix(n, 2, engine);
  Dense twice(2 * n + 1, std::vector<double>(2 * n + 1, 0.0));
  std::vector<double> b(2 * n + 1, 0.0);
  for (int i = 0; i < 2 * n; ++i)
  {
    for (int j = 0; j < 2 * n; ++j)
      twice[i][j] = 0.5 * a[i / 2][j / 2];
    b[i] = i % 2 == 0 ? uniform(engine) : b[i - 1];
  }
  DualProblem const problem = problemOf(twice, b, std::vector<char>(2 * n + 1, 0));
  DualSolution const found = projectedNewton(problem, 1e-10, 200);
  std::vector<double> r;
  problem.multiply(found.x, r);
  for (int i = 0; i < 2 * n + 1; ++i)
  {
    EXPECT_GE(found.x[i], 0.0);
    EXPECT_GE(r[i] + b[i], -1e-10);
    EXPECT_LE(std::min(found.x[i], std::fabs(r[i] + b[i])), 1e-10);
  }
  EXPECT_LE(found.iterations, 60);
}

// The velocities are unique, whoever finds them: bodies that slide, are tied or rub, one of them rigid and free.
TEST(ProjectedNewton, conjugateGradients_findTheSameVelocities)
{
  for (Interaction const kind : {Interaction::Sliding, Interaction::Bonded, Interaction::Friction})
  {
    std::vector<View<double *[2]>> half;
    std::vector<double> spin;
    for (MultiplierMethod const solver : {MultiplierMethod::ProjectedNewton, MultiplierMethod::ConjugateGradients})
    {
      TinyScene scene(rectilinearMesh(uniform(12, 12), uniform(6, 6)),
                      {polygonBody(0, {{0, 0}, {5.3, 0}, {4.6, 6}, {0, 6}}),
                       polygonBody(1, {{5.3, 0}, {8.2, 0}, {8.2, 6}, {4.6, 6}}), boxBody(2, 8.2, 1.1, 10.7, 4.9)},
                      3, std::vector<BoundaryKind>(4, BoundaryKind::Outflow), Kinematics::Xfem, {2.0, 3.0, 1.0});
      RigidBody block;
      block.material = 2;
      block.motion = RigidMotion::Free;
      block.mass = 9.5;
      block.inertia = 16.0;
      block.centre = {9.45, 3.0};
      block.velocity = {-20.0, 3.0};
      scene.bodies_n = {block};
      scene.setVelocity(
          [](int material, Vector2 const &x) {
            return Vector2{(material == 0 ? 60.0 : -40.0) * std::cos(0.4 * x[1]),
                           10.0 * std::sin(x[0]) - 5.0 * material};
          });
      PairInteraction law;
      law.kind = kind;
      law.friction = kind == Interaction::Friction ? 0.3 : 0.0;
      scene.setInteraction(0, 1, law);
      scene.setInteraction(1, 2, law);
      scene.options.solver = solver;
      scene.options.tolerance = 1e-10;
      ConstraintReport const report = scene.constrain();
      EXPECT_TRUE(report.converged) << report.residual;
      EXPECT_LE(report.iterations, solver == MultiplierMethod::ProjectedNewton ? 40 : scene.options.max_iterations);
      half.push_back(View<double *[2]>("half", scene.half.extent(0)));
      Kokkos::deep_copy(half.back(), scene.half);
      spin.push_back(scene.bodies[0].angular_velocity);
    }
    auto const a = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), half[0]);
    auto const b = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), half[1]);
    double largest = 0.0;
    for (std::size_t i = 0; i < a.extent(0); ++i)
      for (int d = 0; d < 2; ++d)
        largest = std::max(largest, std::fabs(a(i, d) - b(i, d)));
    EXPECT_LT(largest, 1e-5) << "interaction " << static_cast<int>(kind); // of 60
    EXPECT_NEAR(spin[1], spin[0], 1e-6);
  }
}

// Begun with the forces of the cycle before, the solver needs hardly an iteration where nothing has changed, and
// elsewhere finds the same velocities; forces that lead astray are left out.
TEST(ProjectedNewton, warmStart_findsTheSameVelocitiesInFewerIterations)
{
  for (Interaction const kind : {Interaction::Sliding, Interaction::Bonded, Interaction::Friction})
  {
    TinyScene scene(
        rectilinearMesh(uniform(12, 12), uniform(6, 6)),
        {polygonBody(0, {{0, 0}, {5.3, 0}, {4.6, 6}, {0, 6}}), polygonBody(1, {{5.3, 0}, {12, 0}, {12, 6}, {4.6, 6}})},
        2, open_box, Kinematics::Xfem, {2.0, 3.0});
    PairInteraction law;
    law.kind = kind;
    law.friction = kind == Interaction::Friction ? 0.3 : 0.0;
    scene.setInteraction(0, 1, law);
    scene.options.tolerance = 1e-10;
    scene.setVelocity(
        [](int material, Vector2 const &x) {
          return Vector2{(material == 0 ? 60.0 : -40.0) * std::cos(0.4 * x[1]), 10.0 * std::sin(x[0])};
        });
    ConstraintReport const cold = scene.constrain();
    EXPECT_TRUE(cold.force.empty());
    auto const expected = scene.sums(scene.half, 0);
    scene.options.warm_start = true;
    ConstraintReport const first = scene.constrain(); // nothing to begin with
    EXPECT_EQ(first.iterations, cold.iterations);
    EXPECT_FALSE(first.force.empty());
    for (double const factor : {1.0, 0.9, -50.0})
    {
      scene.last = first.force;
      for (ContactForce &force : scene.last)
      {
        force.normal *= factor;
        force.tangential *= factor;
      }
      ConstraintReport const warm = scene.constrain();
      EXPECT_TRUE(warm.converged) << warm.residual;
      // The bounds of friction follow the normal forces, which are known to the tolerance.
      int const unchanged = kind == Interaction::Friction ? cold.iterations / 2 : 1;
      EXPECT_LE(warm.iterations, factor == 1.0 ? unchanged : cold.iterations) << factor;
      auto const found = scene.sums(scene.half, 0);
      EXPECT_NEAR(found.kinetic, expected.kinetic, 1e-8 * expected.kinetic);
      EXPECT_NEAR(norm(found.momentum - expected.momentum), 0.0, 1e-7 * norm(expected.momentum));
    }
  }
}
