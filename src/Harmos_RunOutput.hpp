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
#include <Harmos_PointLog.hpp>

#include <limits>
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

  /// Whether it was due at the last cycle by its cadence, not for being the end alone: then a run that goes on from
  /// here keeps what was written.
  bool regular() const { return regular_; }

private:
  Cadence cadence_;
  bool regular_ = true;
  double next_time_ = 0.0;
  double last_wall_ = -std::numeric_limits<double>::infinity(); // due at the start
};

/// Where the files of a run begin.
struct OutputStart
{
  bool restarted = false;     // from a checkpoint of cycle `cycle`
  bool append = false;        // restarted into the folder of that checkpoint: its tables are cut and continued
  long long cycle = 0;        // [of the checkpoint]
  double time = 0.0;          // [s]
  bool history_ended = false; // the run before ended there with a row that its cadence did not ask for
  bool fields_ended = false;  // the same of the fields
};

/// The files of a run.
class RunOutput
{
public:
  /// \param warnings Of the run, for checkpoints; read when one is written.
  RunOutput(Deck const &deck, RunOptions const &options, Teuchos::RCP<Teuchos::Comm<int> const> const &comm,
            OutputStart const &start, std::vector<std::string> const &warnings);

  /// What is due after a cycle (or before the first). Collective.
  void write(Scene const &scene, CycleState const &state, CycleReport const &report, Ledger &ledger, double wall,
             bool at_end);

  /// A checkpoint now. \return Its file name.
  std::string checkpoint(Scene const &scene, CycleState const &state, Ledger const &ledger);

  std::string const &lastCheckpoint() const { return last_checkpoint_; }

private:
  void writeHistory(Scene const &scene, CycleState const &state, CycleReport const &report, Ledger &ledger);
  void writeContacts(Scene const &scene, CycleState const &state, CycleReport const &report);
  void writeProbes(Scene const &scene, CycleState const &state);
  void writeTracers(Scene const &scene, CycleState const &state);
  std::string materialName(int material) const;

  Deck const &deck_;
  std::vector<std::string> const &warnings_;
  std::string directory_;
  MPI_Comm mpi_;
  std::vector<std::string> names_;     // fields of the deck
  std::vector<std::string> all_names_; // with the walls of kinematics lagrangian
  Schedule history_due_, fields_due_, checkpoint_due_;
  History history_;
  ContactLog contacts_;
  std::unique_ptr<PointLog> probes_, tracers_; // where the deck names some
  std::vector<long long> probe_cell_;          // of a mesh that stays
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
  double momentum = 0.0; // [N s/m]; axisymmetric: axial alone
  double energy = 0.0;   // [J/m]
};
LedgerErrors ledgerErrors(Geometry geometry, Ledger const &ledger, Totals const &totals);

/// The same, and the ledger keeps the largest.
LedgerErrors noteErrors(Geometry geometry, Totals const &totals, Ledger &ledger);

} // namespace Harmos

#endif
