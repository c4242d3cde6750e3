// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactOperator.hpp>
#include <Harmos_ExplicitImpulses.hpp>

namespace Harmos
{

namespace
{

struct RowForce
{
  StateBefore before;
  ContactSystem system;
  View<ContactRow *> row;
  View<double *> impedance;
  bool nitsche;
  double penalty, dt, kick;

  /// Cauchy traction on the plane of normal n of one side's pair.
  KOKKOS_INLINE_FUNCTION Vector2 traction(int cell, int material, Vector2 const &n) const
  {
    int const pair = before.pairs.find(cell, material);
    auto const &s = before.pair_stress;
    return {s(pair, 0) * n[0] + s(pair, 2) * n[1], s(pair, 2) * n[0] + s(pair, 1) * n[1]};
  }

  /// Impulses along n and across it of one row.
  KOKKOS_INLINE_FUNCTION Vector2 operator()(int i) const
  {
    ContactRow const &r = row(i);
    double const z_a = r.body_a == -1 ? impedance(r.material_a) : 0.0;
    double const z_b = r.body_b == -1 ? impedance(r.material_b) : 0.0;
    bool const both = z_a > 0.0 && z_b > 0.0;
    double const z = both ? 2.0 * z_a * z_b / (z_a + z_b) : Math::max(z_a, z_b);
    Vector2 const n = r.normal, t = perpendicular(n);
    double const closing = r.tied ? 0.0 : Math::max(r.gap, 0.0) / dt;
    Vector2 velocity{system.predicted(i, 0), system.predicted(i, 1)};
    Vector2 stress{0.0, 0.0};
    if (nitsche)
    {
      Vector2 const v = relativeVelocity(r, before.motion_n.velocity, before.motion_n.bodies);
      velocity = {dot(n, v) + closing, dot(t, v)};
      double const part_a = both ? z_b / (z_a + z_b) : (z_a > 0.0 ? 1.0 : 0.0);
      Vector2 mean{0.0, 0.0};
      if (z_a > 0.0)
        mean += part_a * traction(r.cell_a, r.material_a, n);
      if (z_b > 0.0)
        mean += (1.0 - part_a) * traction(r.cell_b, r.material_b, n);
      stress = {dot(n, mean), dot(t, mean)};
    }
    double const scale = kick * r.length;
    Vector2 p{scale * (-stress[0] - penalty * z * velocity[0]), scale * (-stress[1] - penalty * z * velocity[1])};
    p[0] = system.bounds(i, 0, 0.0).clip(p[0]);
    p[1] = system.directions(i) == 2 ? system.bounds(i, 1, system.friction(i) * p[0]).clip(p[1]) : 0.0;
    return p;
  }
};

} // namespace

MultiplierSolution explicitImpulses(StateBefore const &before, ContactSystem const &system, ContactRows const &rows,
                                    double dt, double kick, ConstraintOptions const &options, Exchange const &exchange,
                                    WorkArrays const &work)
{
  ContactOperator const contact(system, rows, exchange, work);
  View<double *[2]> const impulse = work.zeros<double *[2]>("Harmos::constrain::impulse", system.num_rows);
  View<double *[2]> const residual = work.unset<double *[2]>("Harmos::constrain::residual", system.num_rows);
  View<double *> const reach = work.zeros<double *>("Harmos::constrain::reach", system.num_rows);
  RowForce const force{
      before,          system, rows.row, options.impedance, options.method == ConstraintMethod::Nitsche,
      options.penalty, dt,     kick};
  View<int *> const own = system.own;
  Kokkos::parallel_for(
      "Harmos::constrain::explicitImpulses", RangePolicy(0, system.num_own), KOKKOS_LAMBDA(int i) {
        Vector2 const p = force(own(i));
        impulse(own(i), 0) = p[0];
        impulse(own(i), 1) = p[1];
        reach(own(i)) = system.friction(own(i)) * p[0];
      });
  contact.residual(impulse, residual);
  MultiplierSolution solution{impulse, contact.change(), contact.bodyChange()};
  solution.iterations = 1;
  double const violation = contact.violation(impulse, residual, reach);
  if (violation > 0.0)
    solution.residual = violation / Math::max(contact.largestPredicted(dt), 1e-6 * options.speed_scale);
  return solution;
}

} // namespace Harmos
