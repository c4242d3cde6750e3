// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactSystem.hpp>
#include <Harmos_RowSums.hpp>
#include <Harmos_SharedNodes.hpp>

namespace Harmos
{

namespace
{

/// Dof node of a row's slot: 0..3 of side a, 4..7 of side b. (GCC 12 miscompiles the plain conditional in these loops.)
KOKKOS_INLINE_FUNCTION int dofOf(ContactRow const &row, int slot)
{
  int const *const side = slot < 4 ? row.dof_a : row.dof_b;
  return side[slot & 3];
}

/// Number the dof nodes that rows touch and list the rows at each, in key order.
void numberDofs(ContactRows const &rows, int num_dof_nodes, ContactSystem &system, WorkArrays const &work)
{
  View<ContactRow *> const row = rows.row;
  constexpr int block = 16; // of dof nodes, most of which no row touches: passed over as a whole
  int const num_blocks = (num_dof_nodes + block - 1) / block;
  View<int *> const uses = work.zeros<int *>("Harmos::constrain::dof_uses", block * num_blocks);
  View<int *> const place = work.unset<int *>("Harmos::constrain::dof_place", num_dof_nodes); // of used ones alone
  launchFor(
      "Harmos::constrain::countUses", rows.count, KOKKOS_LAMBDA(int r) {
        for (int k = 0; k < 8; ++k)
        {
          int const dof = dofOf(row(r), k);
          if (dof >= 0)
            Kokkos::atomic_add(&uses(dof), 1);
        }
      });
  int const most = Math::min(num_dof_nodes, 8 * rows.count);
  View<int *> const dof_node = work.unset<int *>("Harmos::constrain::contact_dof_node", most);
  View<int *> const offset = work.zeros<int *>("Harmos::constrain::rows_of_offset", most + 1);
  launchScan(
      "Harmos::constrain::numberDofs", num_blocks,
      KOKKOS_LAMBDA(int b, int &sum, bool final) {
        int used = 0;
        for (int i = b * block; i < (b + 1) * block; ++i)
          used |= uses(i);
        for (int i = b * block; used != 0 && i < (b + 1) * block; ++i)
        {
          if (uses(i) == 0)
            continue;
          if (final)
          {
            place(i) = sum;
            dof_node(sum) = i;
            offset(sum + 1) = uses(i);
          }
          ++sum;
        }
      },
      system.num_dofs);
  View<int *> const filled = work.zeros<int *>("Harmos::constrain::rows_of_filled", system.num_dofs);
  int entries = 0;
  launchScan(
      "Harmos::constrain::scanUses", system.num_dofs + 1,
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        sum += offset(i);
        if (final)
          offset(i) = sum;
      },
      entries);
  View<int *> const item = work.unset<int *>("Harmos::constrain::rows_of", entries);
  View<SystemRow *> const compact = system.row;
  launchFor(
      "Harmos::constrain::fillUses", rows.count, KOKKOS_LAMBDA(int r) {
        for (int k = 0; k < 8; ++k)
        {
          int const dof = dofOf(row(r), k);
          compact(r).dof[k] = dof >= 0 ? place(dof) : -1;
          if (dof >= 0)
            item(offset(place(dof)) + Kokkos::atomic_fetch_add(&filled(place(dof)), 1)) = 8 * r + k;
        }
      });
  launchFor(
      "Harmos::constrain::sortUses", system.num_dofs, KOKKOS_LAMBDA(int i) {
        for (int e = offset(i) + 1; e < offset(i + 1); ++e)
          for (int j = e; j > offset(i) && item(j - 1) > item(j); --j)
          {
            int const swap = item(j);
            item(j) = item(j - 1);
            item(j - 1) = swap;
          }
      });
  system.dof_node = dof_node;
  system.rows_of = {offset, item};
}

/// Masses and node conditions of the contact dofs. A dof node that keeps the velocity of a rigid material is as one
/// that conditions hold.
void gatherDofs(Mesh const &mesh, CellMaterialPairs const &pairs, BodyTable const &bodies,
                NodeMaterialPairs const &dof_nodes, BoundaryConditions const &conditions,
                View<double *> const &dof_mass, ContactSystem &system, WorkArrays const &work)
{
  View<double *> const inverse_mass = work.unset<double *>("Harmos::constrain::inverse_mass", system.num_dofs);
  View<NodeCondition *> const condition = work.unset<NodeCondition *>("Harmos::constrain::condition", system.num_dofs);
  View<int *> const dof_node = system.dof_node, of_material = bodies.of_material;
  bool const any_rigid = of_material.extent(0) > 0;
  launchFor(
      "Harmos::constrain::gatherDofs", system.num_dofs, KOKKOS_LAMBDA(int i) {
        int const dof = dof_node(i);
        inverse_mass(i) = 1.0 / dof_mass(dof);
        int const index = conditions.node_index(dof_nodes.node(dof));
        NodeCondition const none;
        condition(i) = index >= 0 ? conditions.condition(index) : none;
        auto const is_rigid = [&](int material) { return of_material(material) >= 0; };
        if (any_rigid && movedByARigidOne(mesh, pairs, dof_nodes, dof, is_rigid))
          condition(i).count = 2;
      });
  system.inverse_mass = inverse_mass;
  system.condition = condition;
}

/// Compact numbers of the free bodies; -1 for others.
View<int *> numberFreeBodies(std::vector<RigidBody> const &bodies, ContactSystem &system, WorkArrays const &work)
{
  View<int *> const number = work.unset<int *>("Harmos::constrain::free_number", bodies.size());
  auto const host = Kokkos::create_mirror_view(number);
  system.free_number = HostView<int *>("Harmos::constrain::free_body", bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
  {
    host(b) = bodies[b].motion == RigidMotion::Free ? system.num_free++ : -1;
    if (host(b) >= 0)
      system.free_number(host(b)) = static_cast<int>(b);
  }
  launchCopy(number, host);
  system.body_inverse_mass = work.unset<double *[3]>("Harmos::constrain::body_inverse_mass", system.num_free);
  system.body_scale = work.unset<double *[3]>("Harmos::constrain::body_scale", system.num_free);
  auto const inverse = Kokkos::create_mirror_view(system.body_inverse_mass);
  auto const scale = Kokkos::create_mirror_view(system.body_scale);
  for (int f = 0; f < system.num_free; ++f)
  {
    RigidBody const &body = bodies[static_cast<std::size_t>(system.free_number(f))];
    inverse(f, 0) = body.axial ? 0.0 : body.inverseMass();
    inverse(f, 1) = body.inverseMass();
    inverse(f, 2) = body.inverseInertia();
    scale(f, 0) = scale(f, 1) = 1.0;
    scale(f, 2) = std::sqrt(body.inertia / body.mass);
  }
  launchCopy(system.body_inverse_mass, inverse);
  launchCopy(system.body_scale, scale);
  return number;
}

/// b along n by the law of impact (Harmos_Constrain.hpp). \param relative G v*
KOKKOS_INLINE_FUNCTION double rebound(ContactRow const &row, double relative, Motion const &before, double dt)
{
  double const start = dot(row.normal, relativeVelocity(row, before.velocity, before.bodies));
  double const back = start < 0.0 ? 0.0 : Math::max(start, row.opening() / dt);
  return relative + row.restitution * start + (1.0 - row.restitution) * back;
}

/// Rows of which less can move along n ask for nothing (bonded ones have no impulse along n, or across it): a splinter
/// between a driven body and a wall of the mesh a thousandth of a cell behind would have to move nodes at a thousand
/// times the body's speed, and further than their cells reach.
constexpr double least_movable_part = 1e-3;

/// How much of a row's velocity along direction k its own nodes and bodies can change: for each side one, less what
/// node conditions hold; none for driven bodies and walls, and of a free one about an axis what moves it along that.
KOKKOS_INLINE_FUNCTION double movablePart(ContactSystem const &s, ContactRow const &row, int i, int k)
{
  Vector2 const d = s.axis(i, k);
  double part = 0.0;
  for (int side = 0; side < 2; ++side)
  {
    if ((side == 0 ? row.body_a : row.body_b) != -1)
    {
      int const body = s.freeBody(i, side);
      part += body < 0 ? 0.0 : s.body_inverse_mass(body, 0) > 0.0 ? 1.0 : Math::fabs(d[1]);
    }
    else
      for (int c = 4 * side; c < 4 * side + 4; ++c)
        if (s.dof(i, c) >= 0)
        {
          NodeCondition const &condition = s.condition(s.dof(i, c));
          part += Math::fabs(s.weight(i, c)) * (condition.count == 0 ? 1.0 : norm(condition.project(d)));
        }
  }
  return part;
}

/// What the rows know: weights, directions, bodies and the predicted relative velocities.
void fillRows(ContactRows const &rows, Motion const &before, Motion const &predicted, View<int *> const &free_number,
              double dt, ContactSystem &system)
{
  ContactSystem const s = system;
  View<ContactRow *> const row = rows.row;
  launchFor(
      "Harmos::constrain::fillRows", rows.count, KOKKOS_LAMBDA(int i) {
        ContactRow const &r = row(i);
        SystemRow &out = s.row(i);
        out.tied = r.tied;
        out.friction = r.friction;
        out.normal = r.normal;
        out.idle[0] = out.idle[1] = false;
        out.diagonal[0] = out.diagonal[1] = out.compliance[0] = out.compliance[1] = 0.0;
        for (int side = 0; side < 2; ++side)
        {
          int const body = side == 0 ? r.body_a : r.body_b;
          for (int k = 0; k < 4; ++k)
          {
            int const dof = side == 0 ? r.dof_a[k] : r.dof_b[k];
            out.weight[4 * side + k] = dof < 0 ? 0.0 : side == 0 ? -r.weight_a[k] : r.weight_b[k];
          }
          out.free_body[side] = body >= 0 ? free_number(body) : -1;
          out.arm[side] = {0.0, 0.0};
          if (body >= 0)
            out.arm[side] = r.pointOn(side) - predicted.bodies.body(body).centre;
        }
        Vector2 const relative = relativeVelocity(r, predicted.velocity, predicted.bodies);
        double const along = dot(r.normal, relative);
        double const closing = along + r.opening() / dt;
        out.struck = !r.tied && r.restitution > 0.0 && closing < 0.0;
        out.predicted[0] = r.tied ? along : out.struck ? rebound(r, along, before, dt) : closing;
        out.opening = r.tied || out.struck ? 0.0 : closing - along;
        out.predicted[1] = s.directions(i) == 2 ? dot(perpendicular(r.normal), relative) : 0.0;
        for (int k = 0; k < (r.tied ? 2 : 1); ++k) // what slides across n is rubbed on, whether it gives way or not
          if (movablePart(s, r, i, k) < least_movable_part)
          {
            out.idle[k] = r.tied;
            out.predicted[k] = r.tied ? 0.0 : Math::max(0.0, out.predicted[k]);
            out.opening = k == 0 ? 0.0 : out.opening;
          }
      });
}

/// Sum of |weight u . d| over the directions d of all rows at a dof.
KOKKOS_INLINE_FUNCTION double reachOf(ContactSystem const &s, int dof, Vector2 const &u)
{
  double sum = 0.0;
  for (int e = s.rows_of.offset(dof); e < s.rows_of.offset(dof + 1); ++e)
  {
    unsigned const item = static_cast<unsigned>(s.rows_of.item(e));
    SystemRow const &other = s.row(static_cast<int>(item / 8u));
    double const w = Math::fabs(other.weight[item % 8u]);
    sum += w * Math::fabs(dot(u, other.normal));
    if (other.tied || other.friction > 0.0)
      sum += w * Math::fabs(dot(u, perpendicular(other.normal)));
  }
  return sum;
}

/// Row sums of |G M^-1 P G^T| over the deformable dofs: they bound its spectrum in the metric of the diagonal
/// (Gershgorin). Where node conditions leave nothing free to move, the sum without them: the impulse stays bounded. A
/// row between rigid bodies has no deformable dofs: its own diagonal entry serves, or where a body about an axis cannot
/// move so what it would be if it could.
/// \param if_alike Out: the sum if both sides moved as little as the heavier one; where one of them moves, its own.
KOKKOS_INLINE_FUNCTION double rowSum(ContactSystem const &s, int row, int k, double &if_alike)
{
  Vector2 const d = s.axis(row, k);
  bool const idle = s.row(row).idle[k];
  double sum = 0.0, unconditioned = 0.0, of_side[2] = {0.0, 0.0};
  for (int c = 0; c < 8; ++c)
  {
    int const dof = s.dof(row, c);
    if (dof < 0)
      continue;
    NodeCondition const &condition = s.condition(dof);
    double const part = Math::fabs(s.weight(row, c)) * s.inverse_mass(dof), at_free_dof = reachOf(s, dof, d);
    double const at_dof = idle ? 0.0 : condition.count == 0 ? at_free_dof : reachOf(s, dof, condition.project(d));
    sum += part * at_dof;
    of_side[c / 4] += part * at_dof;
    unconditioned += part * at_free_dof;
  }
  double const most = Math::max(of_side[0], of_side[1]), least = Math::min(of_side[0], of_side[1]);
  if_alike = least > 0.0 ? 2.0 * least : most;
  if (unconditioned > 0.0)
    return sum > 1e-12 * unconditioned ? sum : unconditioned;
  double if_it_could = 0.0;
  for (int side = 0; side < 2; ++side)
  {
    int const body = s.freeBody(row, side);
    for (int c = 0; body >= 0 && c < 3; ++c)
    {
      double const j = s.bodyJacobian(row, side, k, c);
      sum += j * j * s.body_inverse_mass(body, c);
    }
    if_it_could += body >= 0 ? s.body_inverse_mass(body, 1) : 0.0;
  }
  return sum > 1e-12 * if_it_could ? sum : if_it_could;
}

} // namespace

ContactSystem buildContactSystem(Mesh const &mesh, CellMaterialPairs const &pairs, ContactRows const &rows,
                                 NodeMaterialPairs const &dof_nodes, BoundaryConditions const &conditions,
                                 View<double *> const &dof_mass, Motion const &before, Motion const &predicted,
                                 std::vector<RigidBody> const &bodies, double dt, RowScale scale,
                                 WorkArrays const &work)
{
  ContactSystem system;
  system.num_rows = rows.count;
  system.num_own = rows.num_own;
  system.own = rows.own;
  system.row = work.unset<SystemRow *>("Harmos::constrain::system_row", rows.count);
  numberDofs(rows, dof_nodes.num_dof_nodes, system, work);
  gatherDofs(mesh, pairs, predicted.bodies, dof_nodes, conditions, dof_mass, system, work);
  View<int *> const free_number = numberFreeBodies(bodies, system, work);
  fillRows(rows, before, predicted, free_number, dt, system);
  system.num_multipliers = rows.num_multipliers;
  if (scale == RowScale::None)
    return system;
  ContactSystem const s = system;
  bool const gives_way = scale == RowScale::Compliant;
  double const bonded = gives_way ? bonded_compliance : 0.0, rubbing = gives_way ? rubbing_compliance : 0.0;
  launchFor(
      "Harmos::constrain::rowSums", rows.num_own, KOKKOS_LAMBDA(int i) {
        int const row = s.own(i);
        for (int k = 0; k < s.directions(row); ++k)
        {
          double if_alike;
          SystemRow &own = s.row(row);
          own.diagonal[k] = rowSum(s, row, k, if_alike);
          if (own.tied)
            own.compliance[k] = bonded * own.diagonal[k];
          else if (own.friction > 0.0)
            own.compliance[k] = rubbing * if_alike;
        }
      });
  return system;
}

bool reboundWhereStruck(ContactRows const &rows, Motion const &before, Motion const &predicted, double dt,
                        View<double *[2]> const &impulse, Exchange const &exchange, ContactSystem const &system)
{
  ContactSystem const s = system;
  View<ContactRow *> const row = rows.row;
  double found = 0.0;
  launchReduce(
      "Harmos::constrain::reboundWhereStruck", rows.count,
      KOKKOS_LAMBDA(int i, double &any) {
        ContactRow const &r = row(i);
        SystemRow &out = s.row(i);
        if (r.tied || r.restitution == 0.0 || out.struck || !(impulse(i, 0) > 0.0))
          return;
        double const along = dot(r.normal, relativeVelocity(r, predicted.velocity, predicted.bodies));
        double const asked = rebound(r, along, before, dt);
        out.struck = true;
        out.opening = 0.0;
        out.predicted[0] = movablePart(s, r, i, 0) < least_movable_part ? Math::max(0.0, asked) : asked;
        any = 1.0;
      },
      Kokkos::Max<double>(found));
  return exchange.max(found) > 0.0;
}

void velocityChange(ContactSystem const &system, View<double *[2]> const &impulse, View<double *[2]> const &change)
{
  ContactSystem const s = system;
  launchFor(
      "Harmos::constrain::velocityChange", s.num_dofs, KOKKOS_LAMBDA(int i) {
        Vector2 const f = s.condition(i).project(impulseOn(s, impulse, i));
        change(i, 0) = s.inverse_mass(i) * f[0];
        change(i, 1) = s.inverse_mass(i) * f[1];
      });
}

void dropIdleImpulses(ContactSystem const &system, View<double *[2]> const &impulse)
{
  ContactSystem const s = system;
  launchFor(
      "Harmos::constrain::dropIdleImpulses", s.num_rows, KOKKOS_LAMBDA(int i) {
        for (int k = 0; k < 2; ++k)
          if (s.row(i).idle[k])
            impulse(i, k) = 0.0;
      });
}

namespace
{

/// Impulse of one row on component c of a free body.
KOKKOS_INLINE_FUNCTION double bodyImpulse(ContactSystem const &s, View<double *[2]> const &impulse, int row, int body,
                                          int c)
{
  double sum = 0.0;
  for (int side = 0; side < 2; ++side)
    if (s.freeBody(row, side) == body)
      for (int k = 0; k < s.directions(row); ++k)
        sum += impulse(row, k) * s.bodyJacobian(row, side, k, c);
  return sum;
}

} // namespace

void bodyVelocityChange(ContactSystem const &system, View<double *[2]> const &impulse, Exchange const &exchange,
                        View<double *[3]> const &change, WorkArrays const &work)
{
  if (system.num_free == 0)
    return;
  ContactSystem const s = system;
  auto const host = Kokkos::create_mirror_view(change);
  auto const inverse = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.body_inverse_mass);
  auto const scale = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.body_scale);
  View<double *[3]> const term = work.unset<double *[3]>("Harmos::constrain::body_term", s.num_own);
  for (int body = 0; body < s.num_free; ++body)
  {
    launchFor(
        "Harmos::constrain::bodyImpulses", s.num_own, KOKKOS_LAMBDA(int i) {
          for (int c = 0; c < 3; ++c)
            term(i, c) = bodyImpulse(s, impulse, s.own(i), body, c) / s.body_scale(body, c);
        });
    auto const sum = reproducibleColumnSums(term, s.num_multipliers, exchange);
    for (int c = 0; c < 3; ++c)
      host(body, c) = inverse(body, c) * scale(body, c) * sum[static_cast<std::size_t>(c)];
  }
  launchCopy(change, host);
}

} // namespace Harmos
