// SPDX-License-Identifier: BSD-3-Clause
#include "TinyScene.hpp"

#include <Harmos_TpetraExchange.hpp>

#include <Tpetra_Core.hpp>

#include <gtest/gtest.h>

#include <map>

using namespace HarmosTest;

namespace
{

constexpr int n = 24;
using Velocities = std::map<std::pair<long long, int>, Vector2>; // by global node and material

/// A disc of PLIC-like chords (0) in a medium (1), and a rigid slab (2) that presses on the medium's top across a gap.
std::vector<Body> bodies()
{
  Vector2 const centre{11.3, 9.2};
  auto const line = [centre](Quadrilateral const &q)
  {
    Vector2 const c = 0.25 * ((q[0] + q[1]) + (q[2] + q[3]));
    double const wobble = 0.02 * std::sin(7.0 * c[0] + 3.0 * c[1]);
    Vector2 const radial = normalised(c - centre);
    return Plane2{radial, dot(radial, centre) + 6.1 + wobble};
  };
  return {{0,
           [line](Quadrilateral const &q)
           {
             Region r;
             clip(q, line(q), r);
             return r;
           }},
          {1,
           [line](Quadrilateral const &q)
           {
             Region below, r;
             clip(q, Plane2{{0.05, 1.0}, 18.4}, below);
             Plane2 const l = line(q);
             clip(below, Plane2{-l.normal, -l.offset}, r);
             return r;
           }},
          {2, [](Quadrilateral const &q)
           {
             Region r;
             clip(q, Plane2{{-0.05, -1.0}, -18.7}, r);
             return r;
           }}};
}

struct Result
{
  Velocities half;
  ConstraintReport report;
  std::vector<RigidBody> bodies;
};

/// A way to constrain, and the least iterations that make the comparison worth while.
struct Case
{
  MultiplierMethod solver;
  Placement placement;
  int least;
  ConstraintMethod method = ConstraintMethod::Multipliers;

  bool isExplicit() const { return method == ConstraintMethod::Penalty || method == ConstraintMethod::Nitsche; }
};

Result solve(Mesh const &mesh, Exchange const &exchange, int depth, RigidMotion motion, Case const &c)
{
  TinyScene scene(mesh, bodies(), 3, open_box);
  scene.exchange = &exchange;
  scene.options.tolerance = 1e-9;
  scene.options.solver = c.solver;
  scene.options.placement = c.placement;
  scene.options.method = c.method;
  if (c.solver == MultiplierMethod::RowSums)
    scene.options.max_iterations = 40;
  scene.options.impedance = deviceCopy("impedance", std::vector<double>{2.0e3, 3.0e3, 0.0});
  scene.stress.cauchy = View<double *[3]>("stress", static_cast<std::size_t>(scene.pairs.num_pairs));
  PairInteraction bouncing;
  bouncing.restitution = c.isExplicit() ? 0.0 : 0.7;
  scene.setInteraction(1, 2, bouncing);
  scene.dt = 2e-3;
  RigidBody slab;
  slab.material = 2;
  slab.motion = motion;
  slab.mass = 77.0;
  slab.inertia = 300.0;
  slab.centre = {11.0, 21.0};
  slab.velocity = {1.0, -300.0};
  slab.angular_velocity = 0.3;
  scene.bodies_n = {slab};
  scene.setVelocity(
      [](int material, Vector2 const &x) {
        return Vector2{(material == 0 ? 40.0 : -30.0) * std::cos(0.3 * x[0]), 50.0 * std::sin(0.2 * x[1] + material)};
      });
  Result result;
  result.report = scene.constrain();
  result.bodies = scene.bodies;
  auto const half = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.half);
  auto const node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.dof_nodes.node);
  auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_global);
  auto const cell_depth = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_depth);
  auto const cell = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.pairs.cell);
  auto const material = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.pairs.material);
  auto const dofs = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.pairs.dof_node);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
    for (int k = 0; k < 4 && cell_depth(cell(pair)) <= depth; ++k)
    {
      int const dof = dofs(pair, k);
      result.half[{global(node(dof)), material(pair)}] = {half(dof, 0), half(dof, 1)};
    }
  return result;
}

void expectBits(Result const &one, HostMesh const &whole, int pattern, RigidMotion motion, Case const &c,
                Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  std::vector<int> owner;
  for (int c = 0; c < n * n; ++c)
  {
    int const column = c % n, row = c / n, ranks = comm->getSize();
    owner.push_back(pattern == 0   ? column * ranks / n
                    : pattern == 1 ? row * ranks / n
                                   : (column / 5 + row / 5) % ranks);
  }
  Mesh const mesh = buildLocalMesh(whole, owner, comm->getRank(), 6);
  TpetraExchange const exchange(comm, mesh);
  Result const some = solve(mesh, exchange, 3, motion, c);
  EXPECT_EQ(some.report.iterations, one.report.iterations);
  EXPECT_EQ(some.report.residual, one.report.residual);
  EXPECT_EQ(some.report.rows, one.report.rows);
  EXPECT_NEAR(some.report.contact_loss, one.report.contact_loss, 1e-13 * std::fabs(one.report.contact_loss));
  EXPECT_NEAR(norm(some.report.external_impulse - one.report.external_impulse), 0.0, 1e-10);
  EXPECT_EQ(some.bodies[0].velocity[0], one.bodies[0].velocity[0]);
  EXPECT_EQ(some.bodies[0].velocity[1], one.bodies[0].velocity[1]);
  EXPECT_EQ(some.bodies[0].angular_velocity, one.bodies[0].angular_velocity);
  EXPECT_FALSE(some.half.empty());
  int different = 0;
  for (auto const &[key, v] : some.half)
  {
    Vector2 const &w = one.half.at(key);
    different += v[0] != w[0] || v[1] != w[1];
  }
  EXPECT_EQ(different, 0);
}

} // namespace

TEST(ConstrainRanks, anyPartition_givesTheBitsOfOneRank)
{
  auto const comm = Tpetra::getDefaultComm();
  HostMesh const whole = rectilinearMesh(uniform(n, n), uniform(n, n));
  for (Case const &c : {Case{MultiplierMethod::ProjectedNewton, Placement::Midpoint, 3},
                        Case{MultiplierMethod::ProjectedNewton, Placement::VitalVertices, 3},
                        Case{MultiplierMethod::ProjectedNewton, Placement::Mortar, 3},
                        Case{MultiplierMethod::ProjectedNewton, Placement::GaussPoints, 3},
                        Case{MultiplierMethod::ProjectedNewton, Placement::SegmentEnds, 3},
                        Case{MultiplierMethod::ConjugateGradients, Placement::Midpoint, 11},
                        Case{MultiplierMethod::RowSums, Placement::Midpoint, 40},
                        Case{MultiplierMethod::ProjectedNewton, Placement::Midpoint, 1, ConstraintMethod::Nodal},
                        Case{MultiplierMethod::ProjectedNewton, Placement::Midpoint, 1, ConstraintMethod::Merged},
                        Case{MultiplierMethod::ProjectedNewton, Placement::Midpoint, 1, ConstraintMethod::Penalty},
                        Case{MultiplierMethod::ProjectedNewton, Placement::Midpoint, 1, ConstraintMethod::Nitsche}})
    for (RigidMotion const motion : {RigidMotion::Free, RigidMotion::Prescribed})
    {
      if (c.isExplicit() && motion == RigidMotion::Free) // decks refuse it
        continue;
      SCOPED_TRACE(testing::Message() << static_cast<int>(c.method) << " " << static_cast<int>(c.placement) << " "
                                      << static_cast<int>(c.solver));
      Result const one = solve(buildMesh(whole), serialExchange(), 0, motion, c);
      ASSERT_TRUE(one.report.converged || c.solver == MultiplierMethod::RowSums) << one.report.residual;
      EXPECT_GE(one.report.iterations, c.least);
      for (int const pattern : {0, 1, 2})
        expectBits(one, whole, pattern, motion, c, comm);
    }
}
