// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RUN_OUTPUT_HPP
#define HARMOS_RUN_OUTPUT_HPP

#include "Harmos_Ledger.hpp"
#include "Harmos_Simulation.hpp"
#include "Harmos_TimeStep.hpp"
#include "Harmos_Totals.hpp"

#include <Harmos_Checkpoint.hpp>
#include <Harmos_ContactLog.hpp>
#include <Harmos_FieldOutput.hpp>
#include <Harmos_History.hpp>

#include <memory>
#include <string>
#include <vector>

namespace Harmos
{

/// Whether something is due: by cycles, by simulated time, by the wall clock.
class Schedule
{
public:
  explicit Schedule(Cadence cadence) : cadence_(cadence) {}

  /// True when due at this cycle; then the next dates are set. `wall` is the same on all ranks.
  bool due(long long cycle, double time, double wall, bool at_end);

  /// As if everything up to this time had been written.
  void skipTo(double time, double wall);

private:
  Cadence cadence_;
  double next_time_ = 0.0;
  double last_wall_ = 0.0;
};

/// The files of a run.
class RunOutput
{
public:
  /// \param restart_cycle -1: fresh; else files are cut after this cycle and continued.
  RunOutput(Deck const &deck, RunOptions const &options, Teuchos::RCP<Teuchos::Comm<int> const> const &comm,
            long long restart_cycle, double restart_time);

  /// What is due after a cycle (or before the first). Collective.
  void write(Scene const &scene, CycleState const &state, CycleReport const &report, Ledger &ledger, double wall,
             bool at_end);

  /// A checkpoint now. \return Its file name.
  std::string checkpoint(Scene const &scene, CycleState const &state, Ledger const &ledger);

  std::string const &lastCheckpoint() const { return last_checkpoint_; }

private:
  void writeHistory(Scene const &scene, CycleState const &state, CycleReport const &report, Ledger &ledger);
  void writeContacts(Scene const &scene, CycleState const &state, CycleReport const &report);

  Deck const &deck_;
  std::string directory_;
  MPI_Comm mpi_;
  std::vector<std::string> names_;     // fields of the deck
  std::vector<std::string> all_names_; // with the walls of kinematics lagrangian
  Schedule history_due_, fields_due_, checkpoint_due_;
  History history_;
  ContactLog contacts_;
  std::unique_ptr<FieldOutput> fields_;
  std::string last_checkpoint_;
};

/// Names of all materials of a scene: the deck's fields, then `wall_SIDE` for the contact walls of kinematics
/// lagrangian.
std::vector<std::string> materialNames(Deck const &deck);

/// Errors of a ledger against its start, by the method's definitions.
struct LedgerErrors
{
  double mass = 0.0;     // relative
  double momentum = 0.0; // over sum m |v|
  double energy = 0.0;   // [J/m]
};
LedgerErrors ledgerErrors(Ledger const &ledger, Totals const &totals);

} // namespace Harmos

#endif
