// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RemapStudySteps.hpp"

#include "Harmos_RemapComparators.hpp"

#include <Harmos_StateExchange.hpp>

#include <ctime>
#include <stdexcept>

namespace Harmos
{
namespace
{

/// Add the times of a remap to the row.
template <class Remap>
void timed(Remap const &remap, StudyRow &row)
{
  Kokkos::Timer timer;
  std::clock_t const cpu = std::clock();
  remap();
  row.seconds += timer.seconds();
  row.cpu_seconds += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
}

/// The whole record and the momentum, as the cycle does.
void stepByRemap(Study &s, RemapDeck const &deck, Exchange const &exchange, StudyRow &row)
{
  RemapOptions options;
  options.order = deck.order;
  options.limiter = deck.limiter;
  options.swept_faces = deck.scheme == RemapScheme::Swept;
  RemapReport report;
  RemapResult result;
  auto const once = [&]
  {
    report = {};
    // The material rests: dt = 0. Its velocity is one more field.
    result = remap(s.next, Kinematics::Xfem, s.pairs, s.dof_nodes, s.state, s.regions, s.conditions, s.materials,
                   s.state.velocity, 0.0, {}, options, report, s.work, s.mesh.node_position, exchange);
    Kokkos::fence();
  };
  if (!s.work.kept)
    once(); // work arrays and classes, which belong to no step
  timed(once, row);
  require(report.failures == 0, exchange, "remap: a cell left its neighbourhood; expected: more steps");
  s.wall_impulse += report.wall_impulse;
  s.pairs = result.pairs;
  s.dof_nodes = result.dof_nodes;
  s.state = result.state;
  exchangeState(s.next, Kinematics::Xfem, exchange, s.next.halo, s.pairs, s.dof_nodes, s.state);
}

/// The field without its material.
void stepByFields(Study &s, RemapDeck const &deck, Exchange const &exchange, StudyRow &row)
{
  RemapOptions options;
  options.order = deck.order;
  options.limiter = deck.limiter;
  View<double *> const value = valuesOf(s, deck.field.density), next("Harmos::next", s.mesh.num_cells);
  CellFields const fields{View<double **>(value.data(), s.mesh.num_cells, 1)};
  CellFields const remapped{View<double **>(next.data(), s.mesh.num_cells, 1)};
  int failures = 0;
  auto const once = [&]
  {
    failures = remapFields(s.next, s.mesh.node_position, fields, remapped, options, s.field_work, exchange);
    Kokkos::fence();
  };
  if (!s.field_work.scratch)
    once(); // work arrays, which belong to no step
  timed(once, row);
  require(failures == 0, exchange, "remap: a cell left its neighbourhood; expected: more steps");
  setValues(s, deck.field.density, next);
  exchangeState(s.next, Kinematics::Xfem, exchange, s.next.halo, s.pairs, s.dof_nodes, s.state);
}

/// The field, one rank alone.
void stepByComparator(Study &s, RemapDeck const &deck, StudyRow &row)
{
  View<double *> const value = valuesOf(s, false);
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), value);
  std::vector<double> next;
  timed(
      [&] {
        next = remapByComparator(deck.scheme, deck.order, s.mesh, s.next, {host.data(), host.data() + host.extent(0)});
      },
      row);
  for (std::size_t cell = 0; cell < next.size(); ++cell)
    host(cell) = next[cell];
  Kokkos::deep_copy(value, host);
  setValues(s, false, value);
}

} // namespace

void require(bool holds, Exchange const &exchange, std::string const &what)
{
  if (exchange.max(holds ? 0.0 : 1.0) > 0.0)
    throw std::runtime_error(what);
}

void stepBy(Study &s, RemapDeck const &deck, Exchange const &exchange, StudyRow &row)
{
  if (deck.carriesRecords())
    stepByRemap(s, deck, exchange, row);
  else if (deck.scheme == RemapScheme::FieldIntersection)
    stepByFields(s, deck, exchange, row);
  else
    stepByComparator(s, deck, row);
}

} // namespace Harmos
