// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DualRows.hpp>
#include <Harmos_WarmStart.hpp>

namespace Harmos
{

namespace
{

bool comesBefore(ContactForce const &a, ContactForce const &b)
{
  return a.key < b.key;
}

} // namespace

void beginAtForces(ContactSystem const &system, ContactRows const &rows, std::vector<ContactForce> const &last,
                   double dt, View<double *[2]> const &p, View<double *> const &reach, WorkArrays const &work)
{
  std::vector<long long> const key = toHost(keysOf(rows, work));
  auto const known = Kokkos::create_mirror_view(p);
  for (std::size_t row = 0; row < key.size(); ++row)
  {
    auto const at = std::lower_bound(last.begin(), last.end(), ContactForce{key[row], 0.0, 0.0}, comesBefore);
    bool const found = at != last.end() && at->key == key[row];
    known(row, 0) = found ? dt * at->normal : 0.0;
    known(row, 1) = found ? dt * at->tangential : 0.0;
  }
  launchCopy(p, known);
  constexpr double at_bound = 1e-12;
  ContactSystem const s = system;
  View<double *[2]> const impulse = p;
  View<double *> const bound = reach;
  launchFor(
      "Harmos::constrain::beginAtForces", s.num_rows, KOKKOS_LAMBDA(int row) {
        impulse(row, 0) = s.bounds(row, 0, 0.0).clip(impulse(row, 0));
        bound(row) = s.tied(row) ? 0.0 : s.friction(row) * impulse(row, 0);
        ImpulseBounds const across = s.bounds(row, 1, bound(row));
        double const before = impulse(row, 1);
        impulse(row, 1) = s.directions(row) == 2 ? across.clip(before) : 0.0;
        // What slid is at its bound: one digit inside of it, all of its velocity would count as violation.
        if (s.directions(row) == 2 && !s.tied(row) && Math::fabs(before) > (1.0 - at_bound) * bound(row))
          impulse(row, 1) = before > 0.0 ? across.high : across.low;
      });
}

std::vector<ContactForce> forcesOf(ContactSystem const &system, ContactRows const &rows, View<double *[2]> const &p,
                                   double dt, Exchange const &exchange, WorkArrays const &work)
{
  std::vector<long long> const key = toHost(keysOf(rows, work));
  auto const own = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), system.own);
  auto const impulse = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), p);
  std::vector<ContactForce> mine;
  for (int i = 0; i < system.num_own; ++i)
  {
    int const row = own(i);
    if (impulse(row, 0) != 0.0 || impulse(row, 1) != 0.0)
      mine.push_back({key[static_cast<std::size_t>(row)], impulse(row, 0) / dt, impulse(row, 1) / dt});
  }
  std::vector<ContactForce> all = gathered(mine, exchange);
  std::sort(all.begin(), all.end(), comesBefore);
  return all;
}

} // namespace Harmos
