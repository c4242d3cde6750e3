// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactOperator.hpp>

namespace Harmos
{

namespace
{

/// Velocity of a row along its direction k by the changes of dof and body velocities.
KOKKOS_INLINE_FUNCTION double rowVelocity(ContactSystem const &s, View<double *[2]> const &change,
                                          View<double *[3]> const &body_change, int row, int k)
{
  Vector2 v{0.0, 0.0};
  for (int c = 0; c < 8; ++c)
  {
    int const dof = s.dof(row, c);
    if (dof >= 0)
      v += s.weight(row, c) * Vector2{change(dof, 0), change(dof, 1)};
  }
  double r = dot(s.direction(row, k), v);
  for (int side = 0; side < 2; ++side)
    for (int c = 0; s.freeBody(row, side) >= 0 && c < 3; ++c)
      r += s.bodyJacobian(row, side, k, c) * body_change(s.freeBody(row, side), c);
  return r;
}

/// Give the halo's rows their owners' impulses.
void shareImpulses(TravellingRows const &rows, Exchange const &exchange, PackedRows const &sent,
                   PackedRows const &received, View<double *[2]> const &impulse)
{
  if (exchange.size() == 1)
    return;
  View<int *> const sent_row = rows.sent, received_row = rows.received;
  PackedRows const out = sent, in = received;
  launchFor(
      "Harmos::constrain::packImpulses", sent_row.extent(0), KOKKOS_LAMBDA(int i) {
        out(i, 0) = impulse(sent_row(i), 0);
        out(i, 1) = impulse(sent_row(i), 1);
      });
  exchange.exchangePacked(sent, received, row_halo);
  launchFor(
      "Harmos::constrain::unpackImpulses", received_row.extent(0), KOKKOS_LAMBDA(int i) {
        impulse(received_row(i), 0) = in(i, 0);
        impulse(received_row(i), 1) = in(i, 1);
      });
}

} // namespace

ContactOperator::ContactOperator(ContactSystem const &system, ContactRows const &rows, Exchange const &exchange,
                                 WorkArrays const &work)
    : system_(system), rows_(rows), exchange_(exchange), work_(work),
      sent_(packedRows(rows.travelling.sent_offset, static_cast<int>(rows.travelling.sent.extent(0)), 2, work)),
      received_(
          packedRows(rows.travelling.received_offset, static_cast<int>(rows.travelling.received.extent(0)), 2, work)),
      change_(work.zeros<double *[2]>("Harmos::constrain::change", system.num_dofs)),
      body_change_(work.zeros<double *[3]>("Harmos::constrain::body_change", system.num_free))
{
}

void ContactOperator::push(View<double *[2]> const &x) const
{
  shareImpulses(rows_.travelling, exchange_, sent_, received_, x);
  velocityChange(system_, x, change_);
  bodyVelocityChange(system_, x, exchange_, body_change_, work_);
}

void ContactOperator::product(View<double *[2]> const &x, View<double *[2]> const &out) const
{
  push(x);
  ContactSystem const s = system_;
  View<double *[2]> const change = change_, impulse = x, result = out;
  View<double *[3]> const body_change = body_change_;
  launchFor(
      "Harmos::constrain::product", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
          result(row, k) = rowVelocity(s, change, body_change, row, k) + s.row(row).compliance[k] * impulse(row, k);
      });
}

void ContactOperator::residual(View<double *[2]> const &x, View<double *[2]> const &out) const
{
  product(x, out);
  ContactSystem const s = system_;
  View<double *[2]> const result = out;
  launchFor(
      "Harmos::constrain::addPredicted", s.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
          result(row, k) += s.predicted(row, k);
      });
}

double ContactOperator::violation(View<double *[2]> const &p, View<double *[2]> const &r,
                                  View<double *> const &reach) const
{
  ContactSystem const s = system_;
  View<double *[2]> const impulse = p, residual = r;
  View<double *> const bound = reach;
  double violation = 0.0;
  launchReduce(
      "Harmos::constrain::violation", s.num_own,
      KOKKOS_LAMBDA(int i, double &largest) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
          largest = Math::max(largest, s.bounds(row, k, bound(row)).violation(impulse(row, k), residual(row, k)));
      },
      Kokkos::Max<double>(violation));
  return exchange_.max(s.num_own > 0 ? Math::max(violation, 0.0) : 0.0);
}

double ContactOperator::largestPredicted(double dt) const
{
  ContactSystem const s = system_;
  View<ContactRow *> const row_of = rows_.row;
  double largest = 0.0;
  launchReduce(
      "Harmos::constrain::largestPredicted", s.num_own,
      KOKKOS_LAMBDA(int i, double &l) {
        int const row = s.own(i);
        double const closing = s.tied(row) ? 0.0 : row_of(row).opening() / dt;
        l = Math::max(l, Math::max(Math::fabs(s.predicted(row, 0) - closing), Math::fabs(s.predicted(row, 1))));
      },
      Kokkos::Max<double>(largest));
  return exchange_.max(s.num_own > 0 ? largest : 0.0);
}

} // namespace Harmos
