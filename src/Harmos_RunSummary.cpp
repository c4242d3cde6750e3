// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Run.hpp"

#include "Harmos_ShapeErrors.hpp"
#include "Harmos_Version.hpp"

#include <Harmos_Summary.hpp>

#include <cmath>
#include <sys/resource.h>

namespace Harmos
{

void writeRunSummary(Run const &run, std::string const &status, bool together)
{
  Summary s;
  s.status = status;
  s.cycles = run.state.cycle;
  s.end_time = run.state.time;
  s.pair_steps = std::llround(run.ledger.pair_steps);
  s.cell_steps = std::llround(run.ledger.cell_steps);
  s.wall_seconds = run.timer.seconds();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  double sums[2] = {static_cast<double>(std::clock() - run.cpu_start) / CLOCKS_PER_SEC,
                    1024.0 * static_cast<double>(usage.ru_maxrss)};
  if (together)
    run.exchange->sum(sums, 2);
  s.cpu_seconds = sums[0];
  s.peak_memory_bytes = std::llround(sums[1]);
  s.phases = {{"reconstruct", run.times.reconstruct}, {"lagrange", run.times.lagrange},
              {"constrain", run.times.constrain},     {"remap", run.times.remap},
              {"exchange", run.times.exchange},       {"output", run.output_seconds}};
  s.pair_steps_per_second =
      s.wall_seconds > 0.0 ? (run.ledger.pair_steps - run.first_pair_steps) / s.wall_seconds : 0.0;
  s.ranks = run.comm->getSize();
  s.mass_error = run.ledger.largest_mass_error;
  s.momentum_error = run.ledger.momentumError();
  s.energy_error = run.ledger.energyError();
  s.angular_momentum_drift = run.ledger.largest_angular_drift;
  s.unconverged_cycles = std::llround(run.ledger.unconverged_cycles);
  s.bonds = static_cast<long long>(run.state.bonds.size());
  s.broken_bonds = std::llround(run.ledger.broken_bonds);
  s.merged_fragments = std::llround(run.ledger.merged);
  s.bounded_volumes = std::llround(run.ledger.bounded);
  s.slowed_light_nodes = std::llround(run.ledger.light_nodes);
  s.repeated_cycles = std::llround(run.ledger.repeats);
  s.closed_void_volume = run.ledger.closed_volume;
  s.gas_work = run.ledger.gas_work;
  s.gas_heat = run.ledger.gas_heat;
  s.greedy_cells = std::llround(run.ledger.greedy_cells);
  s.unfinished_interfaces = std::llround(run.ledger.unfinished_interfaces);
  if (together && run.scene.prescribed.kind != FieldKind::None)
  {
    s.shape_errors = shapeErrors(run.deck, run.scene, run.state);
    s.shape_errors.emplace_back("restored_volume", run.ledger.restored_volume);
  }
  s.warnings = run.warnings;
  s.versions = versions();
  s.deck_json = run.deck.json;
  if (run.comm->getRank() == 0)
    writeSummary(run.options.directory + "/summary.json", s);
}

void summariseByItself(Run &run, std::string const &cause)
{
  if (run.comm->getRank() != 0)
    return;
  run.progress.finish();
  run.warnings.push_back("failed: " + cause);
  run.lock->giveRoom();
  try
  {
    writeRunSummary(run, "failed", run.comm->getSize() == 1);
  }
  catch (std::exception const &)
  {
    // What main tells says why.
  }
}

} // namespace Harmos
