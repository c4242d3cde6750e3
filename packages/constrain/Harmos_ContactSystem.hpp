// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONTACT_SYSTEM_HPP
#define HARMOS_CONTACT_SYSTEM_HPP

#include <Harmos_ContactRows.hpp>

namespace Harmos
{

/// What an impulse may be.
struct ImpulseBounds
{
  double low, high;

  /// Those of Coulomb's friction, across n. \param reach Largest |impulse|.
  KOKKOS_INLINE_FUNCTION static ImpulseBounds ofFriction(double reach) { return {-reach, reach}; }

  KOKKOS_INLINE_FUNCTION double clip(double p) const { return Math::min(Math::max(p, low), high); }
  KOKKOS_INLINE_FUNCTION bool inside(double p) const { return p > low && p < high; }

  /// The part of the gradient r of an impulse at a bound that leads away from it.
  KOKKOS_INLINE_FUNCTION double inward(double p, double r) const
  {
    return low < high && ((r < 0.0 && p <= low) || (r > 0.0 && p >= high)) ? r : 0.0;
  }

  /// The part of a step's direction -g that the bounds leave to a step of this length.
  KOKKOS_INLINE_FUNCTION double reduced(double p, double g, double step) const
  {
    return g > 0.0 ? Math::min(g, (p - low) / step) : Math::max(g, (p - high) / step);
  }

  /// Where p goes as the bounds `before` become these: it stays at the bound on which its gradient r presses it, else
  /// is clipped.
  KOKKOS_INLINE_FUNCTION double follow(ImpulseBounds before, double p, double r) const
  {
    return p >= before.high && r < 0.0 ? high : p <= before.low && r > 0.0 ? low : clip(p);
  }

  /// How far p and r are from complementarity: |r| between the bounds, its inward part at them.
  KOKKOS_INLINE_FUNCTION double violation(double p, double r) const { return Math::fabs(inside(p) ? r : inward(p, r)); }
};

/// What the problem knows of a row.
struct SystemRow
{
  bool tied;
  bool struck;     // b by the law of impact
  bool idle[2];    // a tied direction that asks for nothing: no impulse along it acts
  double friction; // coefficient
  Vector2 normal;
  int dof[8];           // compact dof of side a's corners (0..3) and b's (4..7), -1: none
  double weight[8];     // signed shape functions, - for a, + for b
  double predicted[2];  // b
  double opening;       // what the gap adds to b along n [m/s]
  double diagonal[2];   // row sums of |G M^-1 P G^T|, deformable part; own rows
  double compliance[2]; // velocity by which the row gives way, per impulse; own rows
  int free_body[2];     // free body of side a, b: its compact number, -1: none
  Vector2 arm[2];       // point - centre of the body of side a, of side b
};

/// What the impulses of a system's rows are found with.
enum class RowScale
{
  None,     // impulses are known: neither row sums nor compliances
  Sums,     // row sums
  Compliant // row sums, and compliances of rows that rub and bonded ones
};

/// The complementarity problem of the contact rows, without a matrix.
///
/// A row has two directions, d(row, 0) = n and, where tied or rubbing, d(row, 1) = perpendicular(n), and an impulse p
/// for each. Velocities are v = v* + M^-1 P G^T p; residuals r = b + G (v - v*) + C p, b = G v* + max(gap, 0)/dt
/// (tied: no gap), C the compliances of the rows; where node conditions, driven bodies and walls leave less than a
/// thousandth of the row's velocity along n to move, b is at least zero there. A tied row does without such a
/// direction, n or the other: an impulse along it that only kept what others do there at nothing would work with the
/// velocity that is left, and may give energy. Dof nodes that rows touch are numbered compactly; rows_of gathers in key
/// order.
struct ContactSystem
{
  int num_rows = 0; // with the halo's
  int num_own = 0;
  int num_dofs = 0;              // dof nodes that rows touch
  int num_free = 0;              // free rigid bodies
  long long num_multipliers = 0; // over all ranks

  View<int *> own;       // num_own: rows
  View<SystemRow *> row; // num_rows

  View<int *> dof_node;            // num_dofs
  View<double *> inverse_mass;     // num_dofs
  View<NodeCondition *> condition; // num_dofs
  Rows rows_of;                    // compact dof -> 8 * row + corner, ascending

  View<double *[3]> body_inverse_mass; // num_free: 1/m, 1/m, 1/I
  View<double *[3]> body_scale;        // num_free: 1, 1, radius of gyration: makes the components alike
  HostView<int *> free_number;         // num_free: number of the body

  KOKKOS_INLINE_FUNCTION bool tied(int r) const { return row(r).tied; }
  KOKKOS_INLINE_FUNCTION double friction(int r) const { return row(r).friction; }
  KOKKOS_INLINE_FUNCTION int dof(int r, int slot) const { return row(r).dof[slot]; }
  KOKKOS_INLINE_FUNCTION double weight(int r, int slot) const { return row(r).weight[slot]; }
  KOKKOS_INLINE_FUNCTION double predicted(int r, int k) const { return row(r).predicted[k]; }
  KOKKOS_INLINE_FUNCTION double diagonal(int r, int k) const { return row(r).diagonal[k]; }
  KOKKOS_INLINE_FUNCTION int freeBody(int r, int side) const { return row(r).free_body[side]; }
  KOKKOS_INLINE_FUNCTION int directions(int r) const { return tied(r) || friction(r) > 0.0 ? 2 : 1; }

  /// Unit vector: n, or across it.
  KOKKOS_INLINE_FUNCTION Vector2 axis(int r, int k) const
  {
    return k == 0 ? row(r).normal : perpendicular(row(r).normal);
  }

  /// Along which the row's impulse k acts; zero where that is idle.
  KOKKOS_INLINE_FUNCTION Vector2 direction(int r, int k) const
  {
    return row(r).idle[k] ? Vector2{0.0, 0.0} : axis(r, k);
  }

  /// \param reach Largest |impulse| across n by friction.
  KOKKOS_INLINE_FUNCTION ImpulseBounds bounds(int r, int k, double reach) const
  {
    constexpr double none = 1.0e300;
    if (tied(r))
      return {-none, none};
    return k == 0 ? ImpulseBounds{0.0, none} : ImpulseBounds::ofFriction(reach);
  }

  /// Derivative of the row's velocity along direction k with respect to component c (Vx, Vy, omega) of a side's body.
  KOKKOS_INLINE_FUNCTION double bodyJacobian(int r, int side, int k, int c) const
  {
    Vector2 const d = direction(r, k);
    double const sign = side == 0 ? -1.0 : 1.0;
    return sign * (c < 2 ? d[c] : cross(row(r).arm[side], d));
  }
};

/// Impulse of all rows on compact dof i, before its node condition.
KOKKOS_INLINE_FUNCTION Vector2 impulseOn(ContactSystem const &s, View<double *[2]> const &impulse, int i)
{
  Vector2 sum{0.0, 0.0};
  for (int e = s.rows_of.offset(i); e < s.rows_of.offset(i + 1); ++e)
  {
    int const row = s.rows_of.item(e) / 8;
    Vector2 const along = impulse(row, 0) * s.direction(row, 0), across = impulse(row, 1) * s.direction(row, 1);
    sum += s.weight(row, s.rows_of.item(e) % 8) * (along + across);
  }
  return sum;
}

/// v_b - v_a at a row's point.
KOKKOS_INLINE_FUNCTION Vector2 relativeVelocity(ContactRow const &row, View<double *[2]> const &velocity,
                                                BodyTable const &bodies)
{
  Vector2 relative{0.0, 0.0};
  for (int side = 0; side < 2; ++side)
  {
    double const sign = side == 0 ? -1.0 : 1.0;
    int const body = side == 0 ? row.body_a : row.body_b;
    if (body >= 0)
      relative += sign * bodies.body(body).velocityAt(row.pointOn(side));
    for (int k = 0; k < 4; ++k)
    {
      int const dof = side == 0 ? row.dof_a[k] : row.dof_b[k];
      double const w = sign * (side == 0 ? row.weight_a[k] : row.weight_b[k]);
      if (dof >= 0)
        relative += w * Vector2{velocity(dof, 0), velocity(dof, 1)};
    }
  }
  return relative;
}

/// Compliance C of rows that rub, over the row sum that they would have if both sides were as the heavier one. Impulses
/// along n and across it that alternate from row to row move next to nothing (eigenvalues of A down to 1e-8 of the row
/// sums), and friction's bounds follow them: steps along such patterns are large and settle nowhere. With this a row
/// moves by a millionth of what its p alone would change. Of a film's own row sums that would be the film's thickness
/// in some hundred cycles (doc/decisions/0010).
constexpr double rubbing_compliance = 1e-6;

/// Compliance of bonded rows, over their row sums. Two rows of a bond may ask for the same: at the ends of neighbouring
/// segments, which lie on one point, and n and across it at a wall that leaves one of them free. What such rows have
/// between them moves nothing, and the impulses of round-off in it were 1e6 times those of the bond, or kept the
/// tolerance from being met in a thousand iterations.
constexpr double bonded_compliance = 1e-9;

/// The rows' weights, masses, predictions and row sums for the multiplier loop (ContactSystem has the equations).
/// \param before v^{n-1/2}; \param predicted v*; \param bodies Rigid bodies with predicted velocities.
/// \param dof_mass [kg, per metre of depth or per radian]; \param dt [s]
/// \param mesh, pairs They tell which dof nodes that all materials share a rigid one moves: no impulse does.
/// \param scale What the rows' impulses are found with.
ContactSystem buildContactSystem(Mesh const &mesh, CellMaterialPairs const &pairs, ContactRows const &rows,
                                 NodeMaterialPairs const &dof_nodes, BoundaryConditions const &conditions,
                                 View<double *> const &dof_mass, Motion const &before, Motion const &predicted,
                                 std::vector<RigidBody> const &bodies, double dt, RowScale scale = RowScale::Sums,
                                 WorkArrays const &work = {});

/// Rows with restitution that bear though they were not about to touch, since what others' impulses move strikes there,
/// obey the law of impact from here on.
/// \param impulse num_rows (halo rows included)
/// \return Whether there is one on any rank.
bool reboundWhereStruck(ContactRows const &rows, Motion const &before, Motion const &predicted, double dt,
                        View<double *[2]> const &impulse, Exchange const &exchange, ContactSystem const &system);

/// Change of the dof velocities by impulses: M^-1 P G^T p. [m/s]
/// \param impulse num_rows (halo rows included); \param change num_dofs
void velocityChange(ContactSystem const &system, View<double *[2]> const &impulse, View<double *[2]> const &change);

/// What the sums of the rows' impulses are not to count: impulses along idle directions are zero afterwards.
/// \param impulse num_rows
void dropIdleImpulses(ContactSystem const &system, View<double *[2]> const &impulse);

/// Change of the free bodies' velocities (Vx, Vy, omega) by impulses of all ranks' rows; the same bits on every rank.
/// \param change num_free. Collective when num_free > 0.
void bodyVelocityChange(ContactSystem const &system, View<double *[2]> const &impulse, Exchange const &exchange,
                        View<double *[3]> const &change, WorkArrays const &work);

} // namespace Harmos

#endif
