// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ConstraintSums.hpp>

namespace Harmos
{

namespace
{

/// Impulse on side b and the work terms of one row.
struct RowWork
{
  Vector2 impulse;     // on side b; side a gets the opposite
  double power = 0.0;  // p . G v_mean (meanVelocity)
  double driven = 0.0; // its part by driven sides
};

struct RowWorker
{
  ContactSystem s;
  View<ContactRow *> row;
  View<double *[2]> impulse, velocity_n, half;
  BodyTable mean;

  /// Mean velocity of a contact dof over the step. What a node condition holds moves as it does at the step's end: a
  /// body may begin with another velocity beside a wall, and an impulse that the wall takes must do no work with that.
  KOKKOS_INLINE_FUNCTION Vector2 meanVelocity(int i) const
  {
    int const dof = s.dof_node(i);
    Vector2 const after{half(dof, 0), half(dof, 1)};
    Vector2 const change = Vector2{velocity_n(dof, 0), velocity_n(dof, 1)} - after;
    return after + 0.5 * s.condition(i).project(change);
  }

  KOKKOS_INLINE_FUNCTION RowWork operator()(int i) const
  {
    ContactRow const &r = row(i);
    RowWork work;
    work.impulse = impulse(i, 0) * r.normal + impulse(i, 1) * perpendicular(r.normal);
    for (int side = 0; side < 2; ++side)
    {
      double const sign = side == 0 ? -1.0 : 1.0;
      int const body = side == 0 ? r.body_a : r.body_b;
      Vector2 v{0.0, 0.0};
      if (body >= 0)
        v = mean.body(body).velocityAt(r.pointOn(side));
      for (int k = 0; k < 4; ++k)
      {
        int const dof = s.dof(i, 4 * side + k);
        if (dof >= 0)
          v += (side == 0 ? r.weight_a[k] : r.weight_b[k]) * meanVelocity(dof);
      }
      double const power = sign * dot(work.impulse, v);
      work.power += power;
      work.driven += mean.driven(body) ? power : 0.0;
    }
    return work;
  }
};

View<RowWork *> rowWork(RowWorker const &worker, WorkArrays const &arrays)
{
  View<RowWork *> const work = arrays.unset<RowWork *>("Harmos::constrain::row_work", worker.s.num_own);
  launchFor(
      "Harmos::constrain::rowWork", worker.s.num_own, KOKKOS_LAMBDA(int i) { work(i) = worker(worker.s.own(i)); });
  return work;
}

/// What the node conditions take from the rows' impulses at one dof, and its work with meanVelocity.
struct RemovedImpulse
{
  Vector2 impulse;
  double work;
};

View<RemovedImpulse *> removedImpulses(ContactSystem const &s, RowWorker const &worker, Mesh const &mesh,
                                       NodeMaterialPairs const &dof_nodes, WorkArrays const &arrays)
{
  View<RemovedImpulse *> const removed = arrays.unset<RemovedImpulse *>("Harmos::constrain::removed", s.num_dofs);
  View<double *[2]> const p = worker.impulse;
  launchFor(
      "Harmos::constrain::removedImpulses", s.num_dofs, KOKKOS_LAMBDA(int i) {
        removed(i) = {{0.0, 0.0}, 0.0};
        int const dof = s.dof_node(i);
        if (s.condition(i).count == 0 || !mesh.node_owned(dof_nodes.node(dof)))
          return;
        Vector2 f = impulseOn(s, p, i);
        f -= s.condition(i).project(f);
        removed(i) = {f, dot(f, worker.meanVelocity(i))};
      });
  return removed;
}

/// All sums as one array, so that ranks add them at once.
class Sums
{
public:
  Sums(int num_materials, std::size_t num_bodies)
      : width_(static_cast<std::size_t>(num_materials) + 1), num_bodies_(num_bodies),
        value_(4 + 3 * num_bodies + 5 * width_ * width_, 0.0)
  {
  }
  double &loss() { return value_[0]; }
  double &work() { return value_[1]; }
  double *external() { return &value_[2]; }
  double *body(std::size_t b) { return &value_[4 + 3 * b]; }
  double *pair(int a, int b) { return &value_[4 + 3 * num_bodies_ + 5 * (index(a) * width_ + index(b))]; }
  void over(Exchange const &exchange) { exchange.sum(value_.data(), static_cast<int>(value_.size())); }
  std::size_t width() const { return width_; }

private:
  std::size_t index(int material) const { return material < 0 ? width_ - 1 : static_cast<std::size_t>(material); }

  std::size_t width_, num_bodies_;
  std::vector<double> value_;
};

void addPair(double *sum, Vector2 const &impulse, double normal_impulse, double length)
{
  sum[0] += impulse[0];
  sum[1] += impulse[1];
  sum[2] += normal_impulse;
  sum[3] += length;
  sum[4] += length > 0.0 ? normal_impulse * normal_impulse / length : 0.0;
}

void addRow(ContactRow const &row, RowWork const &work, double normal_impulse, bool loaded,
            std::vector<RigidBody> const &bodies, Sums &sums)
{
  sums.loss() -= work.power;
  sums.work() -= work.driven;
  for (int side = 0; side < 2; ++side)
  {
    int const body = side == 0 ? row.body_a : row.body_b;
    Vector2 const impulse = side == 0 ? -work.impulse : work.impulse;
    Vector2 const point = row.pointOn(side);
    if (body >= 0)
    {
      RigidBody const &b = bodies[static_cast<std::size_t>(body)];
      double *const sum = sums.body(static_cast<std::size_t>(body));
      sum[0] += impulse[0];
      sum[1] += impulse[1];
      sum[2] += cross(point - b.centre, impulse);
    }
    if (body == -2 || (body >= 0 && bodies[static_cast<std::size_t>(body)].motion != RigidMotion::Free))
    {
      sums.external()[0] -= impulse[0]; // the other side gets the opposite
      sums.external()[1] -= impulse[1];
    }
  }
  if (row.isWithinBody())
    return;
  double const length = loaded ? row.length : 0.0;
  addPair(sums.pair(row.material_a, row.material_b), -work.impulse, normal_impulse, length);
  addPair(sums.pair(row.material_b, row.material_a), work.impulse, normal_impulse, length);
}

} // namespace

void sumConstraint(ContactSystem const &system, ContactRows const &rows, MultiplierSolution const &solution,
                   Mesh const &mesh, NodeMaterialPairs const &dof_nodes, View<double *[2]> const &velocity_n,
                   View<double *[2]> const &half, BodyTable const &mean_bodies, int num_materials,
                   Exchange const &exchange, bool tell_pressure, ConstraintReport &report, WorkArrays const &arrays)
{
  RowWorker const worker{system, rows.row, solution.impulse, velocity_n, half, mean_bodies};
  auto const row = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.row);
  auto const own = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.own);
  auto const p = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), solution.impulse);
  auto const work = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rowWork(worker, arrays));
  auto const removed = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(),
                                                           removedImpulses(system, worker, mesh, dof_nodes, arrays));
  auto const body = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mean_bodies.body);
  std::vector<RigidBody> const bodies(body.data(), body.data() + body.extent(0));

  Sums sums(num_materials, bodies.size());
  for (int i = 0; i < system.num_own; ++i)
  {
    int const r = own(i);
    bool const loaded = tell_pressure && (p(r, 0) != 0.0 || p(r, 1) != 0.0);
    addRow(row(r), work(i), tell_pressure ? p(r, 0) : 0.0, loaded, bodies, sums);
  }
  for (int i = 0; i < system.num_dofs; ++i)
  {
    sums.work() -= removed(i).work;
    sums.external()[0] -= removed(i).impulse[0];
    sums.external()[1] -= removed(i).impulse[1];
  }
  sums.over(exchange);

  report.contact_loss += sums.loss();
  report.driven_work += sums.work();
  report.external_impulse += Vector2{sums.external()[0], sums.external()[1]};
  for (std::size_t b = 0; b < bodies.size(); ++b)
  {
    report.body_impulse[b] += Vector2{sums.body(b)[0], sums.body(b)[1]};
    report.body_torque[b] += sums.body(b)[2];
  }
  for (int a = -1; a < num_materials; ++a)
    for (int b = -1; b < num_materials; ++b)
    {
      double const *const sum = sums.pair(a, b);
      std::size_t const w = sums.width();
      std::size_t const i = a < 0 ? w - 1 : static_cast<std::size_t>(a),
                        j = b < 0 ? w - 1 : static_cast<std::size_t>(b);
      PairForce &force = report.pair_force[i * w + j];
      force.impulse += Vector2{sum[0], sum[1]};
      force.normal_impulse += sum[2];
      force.area += sum[3];
      force.squares += sum[4];
    }
}

} // namespace Harmos
