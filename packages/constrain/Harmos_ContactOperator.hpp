// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONTACT_OPERATOR_HPP
#define HARMOS_CONTACT_OPERATOR_HPP

#include <Harmos_ContactSystem.hpp>

namespace Harmos
{

/// The operator A = G M^-1 P G^T + C of a contact system (C: compliances of its rows), applied without a matrix, with
/// the exchange of multipliers.
class ContactOperator
{
public:
  ContactOperator(ContactSystem const &system, ContactRows const &rows, Exchange const &exchange,
                  WorkArrays const &work);

  /// The changes of velocity by impulses. \param x The halo rows' are replaced by their owners'. Collective.
  void push(View<double *[2]> const &x) const;

  /// push, and what A makes of it. \param out Own rows: A x. Collective.
  void product(View<double *[2]> const &x, View<double *[2]> const &out) const;

  /// Own rows: b + A x. Collective.
  void residual(View<double *[2]> const &x, View<double *[2]> const &out) const;

  /// Velocity changes of the last push, of dofs.
  View<double *[2]> const &change() const { return change_; }

  /// And of free bodies.
  View<double *[3]> const &bodyChange() const { return body_change_; }

  /// Largest ImpulseBounds::violation of all ranks' rows. \param reach Bounds across n. Collective.
  double violation(View<double *[2]> const &p, View<double *[2]> const &r, View<double *> const &reach) const;

  /// Largest predicted |G v*| of all ranks' rows. Collective.
  double largestPredicted(double dt) const;

private:
  ContactSystem const &system_;
  ContactRows const &rows_;
  Exchange const &exchange_;
  WorkArrays const work_;
  PackedRows sent_, received_; // impulses of the rows that travel
  View<double *[2]> change_;
  View<double *[3]> body_change_;
};

} // namespace Harmos

#endif
