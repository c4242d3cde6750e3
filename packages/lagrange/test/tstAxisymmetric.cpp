// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_LagrangeScene.hpp"

#include <detail/Harmos_RingQuadrature.hpp>

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

Scene ringScene(int n, double distort, Material const &material)
{
  return makeScene(n, n, distort, {material}, full, Kinematics::Xfem,
                   std::vector<BoundaryKind>(4, BoundaryKind::Outflow), Geometry::Axisymmetric);
}

/// Forces of the stress alone.
void withoutDamping(LagrangeOptions &options)
{
  options.linear_viscosity = options.quadratic_viscosity = options.hourglass_viscosity = 0.0;
}

detail::Corners<double> randomCell(std::mt19937 &random, double left)
{
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  detail::Corners<double> c{{left, left + 1.0, left + 1.0, left}, {0.0, 0.0, 1.0, 1.0}};
  for (int k = 0; k < 4; ++k)
  {
    c.x[k] = std::max(0.0, c.x[k] + shift(random));
    c.y[k] += shift(random);
  }
  return c;
}

double volumeOf(detail::Corners<double> const &c)
{
  Quadrilateral q;
  for (int k = 0; k < 4; ++k)
    q.push({c.x[k], c.y[k]});
  return volume(q, Geometry::Axisymmetric);
}

} // namespace

TEST(RingGradient, OfRandomCells_isTheDerivativeOfTheVolume)
{
  std::mt19937 random(1);
  double const step = 1e-6;
  for (int trial = 0; trial < 100; ++trial)
  {
    auto const c = randomCell(random, trial % 2 == 0 ? 0.0 : 3.0);
    auto const b = detail::ringGradient(c);
    EXPECT_NEAR(b.volume, volumeOf(c), 1e-14 * volumeOf(c));
    double sum_x = 0.0, sum_y = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      auto low = c, high = c;
      low.x[k] -= step;
      high.x[k] += step;
      EXPECT_NEAR(b.x[k] + b.hoop[k], 0.5 * (volumeOf(high) - volumeOf(low)) / step, 1e-8);
      low = high = c;
      low.y[k] -= step;
      high.y[k] += step;
      EXPECT_NEAR(b.y[k], 0.5 * (volumeOf(high) - volumeOf(low)) / step, 1e-8);
      sum_x += b.x[k];
      sum_y += b.y[k];
    }
    EXPECT_NEAR(sum_x, 0.0, 1e-14);
    EXPECT_NEAR(sum_y, 0.0, 1e-14);
  }
}

TEST(Axisymmetric, UniformPressureOnADistortedMesh_leavesInnerNodesInBalance)
{
  Scene s = ringScene(6, 0.25, fluid());
  auto const r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    r(pair, Mass) *= 0.5 / 0.45; // the force volume fills the cell
    r(pair, SpecificVolume) = 0.45;
  }
  Kokkos::deep_copy(s.state.record, r);
  s.predict(1.0);
  auto const x = onHost(s.mesh.node_position);
  auto const node = onHost(s.dof_nodes.node);
  auto const v = onHost(s.work.predicted);
  auto const mass = onHost(s.work.dof_mass);
  double outside = 0.0;
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
  {
    int const n = node(dof);
    bool const inner = x(n, 0) > 0.0 && x(n, 0) < 6.0 && x(n, 1) > 0.0 && x(n, 1) < 6.0;
    for (int d = 0; d < 2; ++d)
      if (inner)
        EXPECT_NEAR(mass(dof) * v(dof, d), 0.0, 1e-12);
      else
        outside = std::max(outside, std::fabs(mass(dof) * v(dof, d)));
  }
  EXPECT_GT(outside, 1.0);
}

TEST(Axisymmetric, UniformAxialGradientOfThePressure_acceleratesAllInnerNodesAlike)
{
  Scene s = ringScene(6, 0.0, fluid());
  auto const r = onHost(s.state.record);
  auto const cell = onHost(s.pairs.cell);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    double const sv = 0.5 * (1.0 + 1e-3 * (cell(pair) / 6)); // the pressure at gruneisen 0 is not linear in it
    r(pair, Mass) *= 0.5 / sv;
    r(pair, SpecificVolume) = sv;
  }
  Kokkos::deep_copy(s.state.record, r);
  s.predict(1.0);
  auto const x = onHost(s.mesh.node_position);
  auto const node = onHost(s.dof_nodes.node);
  auto const v = onHost(s.work.predicted);
  std::vector<double> row(7, 0.0);
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof) // ascending: the axis is the first of its row
  {
    int const z = static_cast<int>(x(node(dof), 1) + 0.5);
    if (z == 0 || z == 6)
      continue;
    if (x(node(dof), 0) == 0.0)
      row[z] = v(dof, 1);
    EXPECT_GT(row[z], 1e-4);
    EXPECT_NEAR(v(dof, 1) / row[z], 1.0, 1e-12);
  }
}

TEST(Axisymmetric, AnyState_hasNoAxialForce)
{
  Scene s = ringScene(5, 0.25, elastic());
  disturb(s, 3);
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  auto const f = onHost(s.work.corner_force);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    double sum = 0.0, size = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      sum += f(pair, 2 * k + 1);
      size += std::fabs(f(pair, 2 * k + 1));
    }
    EXPECT_NEAR(sum, 0.0, 1e-14 * size);
  }
}

TEST(Axisymmetric, UniformExpansion_isExact)
{
  double const a = 0.3, b = -0.2, dt = 0.1;
  Scene s = ringScene(5, 0.25, elastic());
  withoutDamping(s.options);
  s.setVelocity([&](int, Vector2 x) { return Vector2{a * x[0], b * x[1]}; });
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  Kokkos::deep_copy(s.work.half, s.state.velocity);
  TimeStepLimit next;
  EXPECT_EQ(s.update(dt, next).inverted, 0);
  double const drr = a * dt / (1.0 + 0.5 * a * dt), dzz = b * dt / (1.0 + 0.5 * b * dt);
  double const two_g = 2.0 * elastic().shear_modulus, mean = (2.0 * drr + dzz) / 3.0;
  double const sv = (1.0 + a * dt) * (1.0 + a * dt) * (1.0 + b * dt) / elastic().density0;
  auto const r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    EXPECT_NEAR(r(pair, SpecificVolume), sv, 1e-14);
    EXPECT_NEAR(r(pair, DeviatorXX), two_g * (drr - mean), 1e-14);
    EXPECT_NEAR(r(pair, DeviatorYY), two_g * (dzz - mean), 1e-14);
    EXPECT_NEAR(r(pair, DeviatorXY), 0.0, 1e-14);
    EXPECT_NEAR(-r(pair, DeviatorXX) - r(pair, DeviatorYY), two_g * (drr - mean), 1e-14); // hoop
  }
}

TEST(Axisymmetric, FreeRing_keepsEnergyAndAxialMomentum)
{
  Scene s = ringScene(4, 0.2, elastic());
  disturb(s, 5);
  computeDofMass(s.mesh, s.pairs, s.dof_nodes, s.state, s.materials, s.work);
  KineticSums const before = kineticSums(s.mesh, s.dof_nodes, s.work.dof_mass, s.state.velocity);
  double const internal = s.internalEnergy();
  double const dt = 1e-3;
  s.predict(dt);
  TimeStepLimit next;
  s.update(dt, next);
  KineticSums const after = kineticSums(s.mesh, s.dof_nodes, s.work.dof_mass, s.work.half);
  EXPECT_NEAR(after.kinetic_energy + s.internalEnergy(), before.kinetic_energy + internal,
              1e-14 * before.kinetic_energy);
  EXPECT_NEAR(after.momentum[1], before.momentum[1], 1e-14 * before.mass);
  EXPECT_GT(std::fabs(after.kinetic_energy - before.kinetic_energy), 1e-6);
}

namespace
{

/// Errors of Lame's solution u = c1 r + c2 / r, plane strain, on a mesh of n x n cells over r in [1, 2].
struct LameErrors
{
  double hoop, balance; // largest, of the hoop stress at the inner wall; largest acceleration times density over it
};

LameErrors lameErrors(int n)
{
  Material const law = elastic();
  double const c1 = 2e-7, c2 = 5e-7;
  Scene s = makeScene(n, n, 0.0, {law}, full, Kinematics::Xfem, std::vector<BoundaryKind>(4, BoundaryKind::Outflow),
                      Geometry::Axisymmetric);
  auto const x = onHost(s.mesh.node_position);
  for (int node = 0; node < s.mesh.num_nodes; ++node)
  {
    x(node, 0) = 1.0 + x(node, 0) / n;
    x(node, 1) /= n;
  }
  Kokkos::deep_copy(s.mesh.node_position, x);
  updateGeometry(s.mesh);
  auto const volume = onHost(s.mesh.cell_volume);
  auto const r = onHost(s.state.record);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
    r(pair, Mass) = law.density0 * volume(pair);
  Kokkos::deep_copy(s.state.record, r);
  withoutDamping(s.options);
  s.setVelocity([&](int, Vector2 p) { return Vector2{c1 * p[0] + c2 / p[0], 0.0}; });
  computeCornerForces(s.mesh, s.pairs, s.state, s.materials, s.options, s.work);
  Kokkos::deep_copy(s.work.half, s.state.velocity);
  TimeStepLimit next;
  s.update(1.0, next);
  // isentropic bulk modulus rho c^2 in the pressure: stress = K theta + s
  double const bulk = law.density0 * law.sound_speed0 * law.sound_speed0, g = law.shear_modulus;
  auto const now = onHost(s.state.record);
  LameErrors errors{0.0, 0.0};
  auto const cell_node = onHost(s.mesh.cell_node);
  double const largest = bulk * 2.0 * c1 + 2.0 * g * c2;
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
  {
    double const radius = 0.5 * (x(cell_node(pair, 0), 0) + x(cell_node(pair, 1), 0));
    double const theta = now(pair, SpecificVolume) * law.density0 - 1.0;
    double const hoop = bulk * theta - now(pair, DeviatorXX) - now(pair, DeviatorYY);
    double const exact = bulk * 2.0 * c1 + 2.0 * g * (c1 / 3.0 + c2 / (radius * radius));
    errors.hoop = std::max(errors.hoop, std::fabs(hoop - exact) / largest);
  }
  s.setVelocity([](int, Vector2) { return Vector2{0.0, 0.0}; });
  s.predict(1.0);
  auto const v = onHost(s.work.predicted);
  auto const node = onHost(s.dof_nodes.node);
  for (int dof = 0; dof < s.dof_nodes.num_dof_nodes; ++dof)
    if (x(node(dof), 0) > 1.001 && x(node(dof), 0) < 1.999 && x(node(dof), 1) > 0.001 && x(node(dof), 1) < 0.999)
      errors.balance = std::max(errors.balance, std::fabs(v(dof, 0)) * law.density0 / largest);
  return errors;
}

} // namespace

// On a mesh that is uniform in r the discrete balance of u = c1 r + c2 / r is exact, whatever the cell size: with
// D_rr, D_tt = c1 -+ c2 / (r_L r_R) both sides of r_R s_rr|R - r_L s_rr|L = h (s_tt|L + s_tt|R) / 2 are equal. What is
// left is of the order of the strain, 5e-7.
TEST(Axisymmetric, PressurisedTube_hasLamesHoopStressToSecondOrderInExactBalance)
{
  LameErrors const coarse = lameErrors(8), fine = lameErrors(16);
  EXPECT_LT(fine.hoop, 1e-3);
  EXPECT_GT(std::log2(coarse.hoop / fine.hoop), 1.8);
  EXPECT_LT(coarse.balance, 5e-6);
  EXPECT_LT(fine.balance, 5e-6);
}
