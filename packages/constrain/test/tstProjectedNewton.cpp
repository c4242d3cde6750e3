// SPDX-License-Identifier: BSD-3-Clause
#include "DualProblems.hpp"
#include "TinyScene.hpp"

#include <Harmos_ProjectedNewton.hpp>

#include <gtest/gtest.h>

using namespace HarmosTest;

TEST(ProjectedNewton, randomProblems_haveTheSolutionOfEnumeration)
{
  expectSolutionsOfEnumeration(
      [](DualProblem const &problem)
      {
        DualSolution const found = projectedNewton(problem, 1e-12, 200);
        EXPECT_LE(found.iterations, 30);
        return found.x;
      });
}

// Rows that depend on each other, thousands of which change between open and pressed, stuck and sliding. Forty such
// sets of strips took 39 iterations at most; without the path inside the bounds three strips of these take 52 to 55.
TEST(ProjectedNewton, longStrips_needThePathInsideTheBounds)
{
  std::mt19937 engine(21);
  for (int const rows : {20, 200, 2000})
    for (double const friction : {0.0, 0.3, 0.8})
    {
      DualProblem const problem = stripOfRows(rows, friction, engine);
      DualSolution const found = projectedNewton(problem, 1e-9, 200);
      EXPECT_LE(violationOf(problem, found.x), 1e-9) << rows << " " << friction;
      EXPECT_LE(found.iterations, 45) << rows << " " << friction;
    }
}

// An impulse that slides a digit inside of its bounds counts with all of its velocity, so that sets that are right seem
// wrong: the mean was 17.9.
TEST(ProjectedNewton, slidingRows_areAtTheirBoundsToTheLastDigit)
{
  int iterations = 0, problems = 0;
  for (int seed = 0; seed < 6; ++seed)
    for (int const rows : {30, 300, 3000})
      for (double const friction : {0.1, 0.3, 0.8})
      {
        std::mt19937 engine(seed);
        DualProblem const problem = stripOfRows(rows, friction, engine);
        DualSolution const found = projectedNewton(problem, 1e-9, 200);
        EXPECT_LE(violationOf(problem, found.x), 1e-9) << seed << " " << rows << " " << friction;
        iterations += found.iterations;
        ++problems;
      }
  EXPECT_LE(iterations, 13 * problems);
}

// Heaps of rigid bodies, of which normal and tangential impulses couple as strongly as the normal ones: Coulomb's law
// need not have a solution there, but nearly all have.
TEST(ProjectedNewton, rowsThatShareVelocitiesAtRandom_areNearlyAllSolved)
{
  int missed = 0;
  for (int const light : {0, 1})
    for (int trial = 0; trial < 100; ++trial)
    {
      std::mt19937 engine(1000 * light + trial);
      std::uniform_real_distribution<double> uniform(-1.0, 1.0);
      int const n = 24, velocities = light == 1 ? n : n / 2;
      Dense g(n, std::vector<double>(velocities, 0.0)), a(n, std::vector<double>(n, 0.0));
      for (auto &row : g)
        for (int k = 0; k < 4; ++k)
        {
          int const at = std::min(velocities - 1, static_cast<int>(0.5 * (uniform(engine) + 1.0) * velocities));
          row[at] += uniform(engine);
        }
      std::vector<double> v(velocities), b(n, 0.0), root(n, 0.0);
      for (double &x : v)
        x = uniform(engine);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          for (int k = 0; k < velocities; ++k)
            a[i][j] += g[i][k] * g[j][k] * (light == 1 && k % 3 != 0 ? 1e-4 : 1.0);
      for (int i = 0; i < n; ++i)
      {
        for (int j = 0; j < n; ++j)
          root[i] += std::fabs(a[i][j]);
        root[i] = std::sqrt(root[i]);
      }
      for (int i = 0; i < n; ++i)
      {
        for (int k = 0; k < velocities; ++k)
          b[i] += g[i][k] * v[k] / root[i];
        for (int j = 0; j < n; ++j)
          a[i][j] /= root[i] * root[j];
      }
      DualProblem problem = problemOf(a, b, std::vector<char>(n, 0));
      problem.root = root;
      for (int i = 1; i < n; i += 2)
      {
        problem.normal_of[i] = i - 1;
        problem.friction[i] = (0.2 + 0.3 * (trial % 3)) * root[i] / root[i - 1];
      }
      DualSolution const found = projectedNewton(problem, 1e-8, 1000);
      EXPECT_LE(found.iterations, 1000);
      missed += found.violation > 1e-8 ? 1 : 0;
    }
  RecordProperty("missed", missed);
  EXPECT_LE(missed, 4) << "of 200";
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
