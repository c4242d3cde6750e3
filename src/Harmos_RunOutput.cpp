// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RunOutput.hpp"

#include "Harmos_Version.hpp"
#include <Harmos_FieldSnapshot.hpp>

#include <Teuchos_DefaultMpiComm.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

bool Schedule::due(long long cycle, double time, double wall, bool at_end)
{
  bool due = at_end && cadence_.at_end;
  if (cadence_.every_cycles > 0 && cycle % cadence_.every_cycles == 0)
    due = true;
  if (cadence_.every_time > 0.0 && time >= next_time_ * (1.0 - 1e-12))
  {
    due = true;
    next_time_ = cadence_.every_time * (std::floor(time / cadence_.every_time * (1.0 + 1e-12)) + 1.0);
  }
  if (cadence_.every_wall_seconds > 0.0 && wall - last_wall_ >= cadence_.every_wall_seconds)
  {
    due = true;
    last_wall_ = wall;
  }
  return due;
}

void Schedule::skipTo(double time, double wall)
{
  last_wall_ = wall;
  if (cadence_.every_time > 0.0)
    next_time_ = cadence_.every_time * (std::floor(time / cadence_.every_time * (1.0 + 1e-12)) + 1.0);
}

std::vector<std::string> materialNames(Deck const &deck)
{
  static char const *const side_name[] = {"left", "right", "bottom", "top"};
  std::vector<std::string> names;
  for (FieldSpec const &field : deck.fields)
    names.push_back(field.name);
  if (deck.kinematics == Kinematics::Lagrangian)
    for (int side = 0; side < num_boundary_sides; ++side)
      if (deck.boundary[side].kind == BoundaryKind::ContactWall)
        names.push_back(std::string("wall_") + side_name[side]);
  return names;
}

LedgerErrors ledgerErrors(Ledger const &l, Totals const &t)
{
  LedgerErrors e;
  e.mass = std::fabs(t.mass + l.outflow_mass - l.mass0) / std::max(l.mass0, 1e-300);
  double const px = t.momentum_x - l.momentum0_x - l.external_impulse_x + l.outflow_momentum_x;
  double const py = t.momentum_y - l.momentum0_y - l.external_impulse_y + l.outflow_momentum_y;
  double const scale = std::max(t.speed_momentum, l.largest_speed_momentum);
  e.momentum = scale > 0.0 ? std::hypot(px, py) / scale : 0.0;
  e.energy = t.kinetic_energy + t.internal_energy - l.external_work + l.contact_loss + l.remap_loss + l.outflow_energy -
             l.energy0;
  return e;
}

namespace
{

CsvStart tableStart(long long restart_cycle)
{
  return restart_cycle < 0 ? CsvStart::fresh() : CsvStart::after(restart_cycle);
}

std::vector<std::string> fieldNames(Deck const &deck)
{
  std::vector<std::string> names;
  for (FieldSpec const &field : deck.fields)
    names.push_back(field.name);
  return names;
}

MPI_Comm rawComm(Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  auto const mpi = Teuchos::rcp_dynamic_cast<Teuchos::MpiComm<int> const>(comm);
  return mpi.is_null() ? MPI_COMM_SELF : static_cast<MPI_Comm>(*mpi->getRawMpiComm());
}

} // namespace

RunOutput::RunOutput(Deck const &deck, RunOptions const &options, Teuchos::RCP<Teuchos::Comm<int> const> const &comm,
                     long long restart_cycle, double restart_time)
    : deck_(deck), directory_(options.directory), mpi_(rawComm(comm)), names_(fieldNames(deck)),
      all_names_(materialNames(deck)), history_due_(deck.output.history), fields_due_(deck.output.fields),
      checkpoint_due_(deck.output.checkpoint),
      history_(directory_ + "/history.csv", names_, comm->getRank() == 0, tableStart(restart_cycle)),
      contacts_(directory_ + "/contact.csv", comm->getRank() == 0, tableStart(restart_cycle))
{
  Cadence const &f = deck.output.fields;
  if (f.every_cycles > 0 || f.every_time > 0.0 || f.every_wall_seconds > 0.0 || f.at_end)
  {
    FieldOutputOptions field_options;
    field_options.vtu = deck.output.vtu;
    fields_ = std::make_unique<FieldOutput>(mpi_, directory_, all_names_, field_options, restart_cycle);
  }
  if (restart_cycle >= 0)
  {
    history_due_.skipTo(restart_time, 0.0);
    fields_due_.skipTo(restart_time, 0.0);
  }
  // No checkpoint of the state that a run starts from: the deck, or the checkpoint that was read, is one.
  checkpoint_due_.skipTo(std::max(restart_time, 0.0), 0.0);
}

void RunOutput::write(Scene const &scene, CycleState const &state, CycleReport const &report, Ledger &ledger,
                      double wall, bool at_end)
{
  if (history_due_.due(state.cycle, state.time, wall, at_end))
  {
    writeHistory(scene, state, report, ledger);
    writeContacts(scene, state, report);
  }
  if (fields_due_.due(state.cycle, state.time, wall, at_end) && fields_)
    fields_->write(state.cycle, state.time,
                   takeSnapshot(scene.mesh, state.pairs, state.dof_nodes, state.state, state.regions, scene.materials));
  if (state.cycle > 0 && checkpoint_due_.due(state.cycle, state.time, wall, at_end))
    checkpoint(scene, state, ledger);
}

void RunOutput::writeHistory(Scene const &scene, CycleState const &state, CycleReport const &report, Ledger &ledger)
{
  Totals const totals = computeTotals(scene, state, static_cast<int>(names_.size()), true);
  LedgerErrors const errors = ledgerErrors(ledger, totals);
  ledger.noteErrors(errors.mass, errors.momentum, errors.energy, totals.kinetic_energy + totals.internal_energy,
                    totals.speed_momentum);

  HistoryRow row;
  row.cycle = state.cycle;
  row.time = state.time;
  row.dt = report.dt;
  row.mass = totals.mass;
  row.momentum_x = totals.momentum_x;
  row.momentum_y = totals.momentum_y;
  row.angular_momentum = totals.angular_momentum;
  row.kinetic_energy = totals.kinetic_energy;
  row.internal_energy = totals.internal_energy;
  row.external_work = ledger.external_work;
  row.contact_loss = ledger.contact_loss;
  row.remap_loss = ledger.remap_loss;
  row.energy_error = errors.energy;
  row.overlap_volume = ledger.overlap_volume;
  row.void_volume = ledger.void_volume;
  row.external_impulse_x = ledger.external_impulse_x;
  row.external_impulse_y = ledger.external_impulse_y;
  row.outflow_mass = ledger.outflow_mass;
  row.outflow_momentum_x = ledger.outflow_momentum_x;
  row.outflow_momentum_y = ledger.outflow_momentum_y;
  row.outflow_energy = ledger.outflow_energy;
  row.pairs = totals.pairs;
  row.pairs_mixed = totals.pairs_mixed;
  row.multipliers = report.constraint.rows;
  row.iterations = report.constraint.iterations;
  row.residual = report.constraint.residual;
  row.material = totals.material;
  history_.write(row);
}

void RunOutput::writeContacts(Scene const &scene, CycleState const &state, CycleReport const &report)
{
  int const m = static_cast<int>(scene.materials.extent(0));
  auto const name = [&](int i) { return i == m ? std::string("contact_wall") : all_names_[i]; };
  std::vector<ContactEntry> entries;
  for (int a = 0; a < m; ++a)
    for (int b = a + 1; b <= m; ++b)
    {
      std::size_t const at = static_cast<std::size_t>(a) * (m + 1) + b;
      if (at >= report.constraint.pair_force.size())
        continue;
      PairForce const &force = report.constraint.pair_force[at];
      if (force.area == 0.0 && force.normal_impulse == 0.0)
        continue;
      entries.push_back({name(a), name(b), force.impulse[0] / report.dt, force.impulse[1] / report.dt,
                         force.normal_impulse, force.area});
    }
  contacts_.write(state.cycle, state.time, entries);
}

std::string RunOutput::checkpoint(Scene const &scene, CycleState const &state, Ledger const &ledger)
{
  CheckpointScalars scalars;
  scalars.cycle = state.cycle;
  scalars.time = state.time;
  scalars.dt = state.dt;
  scalars.kinematics = scene.kinematics;
  scalars.material_names = all_names_;
  scalars.bodies = state.bodies;
  scalars.arrays["ledger"] = ledger.values();
  scalars.deck = deck_.yaml;
  scalars.version = version();
  last_checkpoint_ = writeCheckpoint(mpi_, directory_, scene.mesh, state.pairs, state.state, scalars);
  return last_checkpoint_;
}

} // namespace Harmos
