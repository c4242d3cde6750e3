// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RUN_HPP
#define HARMOS_RUN_HPP

#include "Harmos_Progress.hpp"
#include "Harmos_RunOutput.hpp"
#include "Harmos_Setup.hpp"

#include <Harmos_FolderLock.hpp>

#include <array>
#include <ctime>
#include <memory>
#include <stdexcept>

namespace Harmos
{

/// What a failed run tells.
class RunFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Two rigid bodies that are looked at from time to time, and where they were when they were last.
struct WatchedBodies
{
  std::array<int, 2> pair;
  std::array<Vector2, 2> centre;
  std::array<double, 2> angle;
};

/// A run between its set-up and its summary.
struct Run
{
  Run(Deck const &d, RunOptions const &o, Teuchos::RCP<Teuchos::Comm<int> const> const &c)
      : deck(d), options(o), comm(c), progress(c->getRank() != 0)
  {
  }

  Deck const &deck;
  RunOptions const &options;
  Teuchos::RCP<Teuchos::Comm<int> const> comm;
  Progress progress;
  DeckMesh whole;
  std::unique_ptr<Exchange> exchange;
  Scene scene;
  CycleState state;
  Ledger ledger;
  PhaseTimes times;
  double output_seconds = 0.0;
  std::vector<std::string> warnings;
  std::vector<WatchedBodies> watched;            // that nothing would keep from running into one another
  std::vector<std::array<int, 2>> watched_walls; // free rigid bodies, and sides of the mesh that would not hold them
  Kokkos::Timer timer;
  std::clock_t cpu_start = std::clock();
  long long first_cycle = 0;
  double first_time = 0.0;
  double first_pair_steps = 0.0;
  OutputStart start;
  std::unique_ptr<FolderLock> lock; // of the folder, on rank 0
};

/// The words of the lowest rank that has any, on all ranks; empty where none has. Collective.
std::string firstCause(Teuchos::Comm<int> const &comm, std::string cause);

/// Where a cell and a material are: "cell 12 on rank 0, material copper"; what is negative is left out.
std::string placeOf(Run const &run, int cell, int material);

/// The cell in which an interface could not be placed, and why where it holds too many materials.
std::string failedCell(Run const &run, ReconstructionReport const &report);

/// What two shapes fill together of the cell that they fill most, over its volume.
double mostFilled(Mesh const &mesh, Shape const (&shape)[2]);

/// Note the pairs of fixed and prescribed rigid bodies, one of them prescribed, that do not overlap.
void watchRigidBodies(Run &run);

/// A warning for each watched pair that has run into one another; it is watched no longer. Collective.
void reportRigidOverlap(Run &run);

/// Note the free rigid bodies and the slip walls and fixed sides before them; a warning for each that reaches beyond
/// one already.
void watchWalls(Run &run);

/// A warning for each that has gone through; it is watched no longer.
void reportPassedWalls(Run &run);

/// Part of Ledger::first_step below which a run would crawl for ever.
constexpr double smallest_step = 1e-10;

/// A line on the terminal and in the summary; of the latter there are at most a hundred.
void warn(Run &run, std::string const &text);

/// Mesh, scene, state and ledger from the deck or from a checkpoint. \throw DeckError, on all ranks alike, before any
/// file is touched.
void setUp(Run &run);

/// The state from the checkpoint run.options.restart, before startCycle: the same bits that the interrupted run had.
/// \throw std::runtime_error if the file cannot be read, or does not belong to the deck.
void restoreState(Run &run);

/// Keep other runs off the folder of the results, where there is one, before a checkpoint in it is read.
/// \throw DeckError on all ranks alike.
void lockDirectory(Run &run);

/// Make the folder of the results this run's own, which has it to itself until the Run goes. Results of an earlier run
/// are never overwritten unawares. \throw DeckError on all ranks alike.
void claimDirectory(Run &run);

/// Write summary.json, on rank 0.
/// \param together All ranks are here; else this one writes what it knows by itself.
void writeRunSummary(Run const &run, std::string const &status, bool together);

/// The summary of a run that ended by an exception, of its output as a rule, as far as the disk takes one. On several
/// ranks the others may be anywhere: the first does it, if it was there.
void summariseByItself(Run &run, std::string const &cause);

} // namespace Harmos

#endif
