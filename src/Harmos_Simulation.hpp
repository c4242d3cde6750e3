// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SIMULATION_HPP
#define HARMOS_SIMULATION_HPP

#include <Harmos_Deck.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <string>

namespace Harmos
{

struct RunOptions
{
  std::string directory; // where the results go
  std::string restart;   // checkpoint to continue from; empty: from the start
  bool force = false;    // overwrite results that are there
};

/// How a program ends.
enum ExitStatus : int
{
  Completed = 0,
  BadInput = 2,
  FailedRun = 3,
  Interrupted = 4
};

/// Everything that a run does before its first cycle: mesh, bodies painted into it, points placed. Writes nothing.
/// \throw DeckError for what is wrong with the input.
void checkScene(Deck const &deck, Teuchos::RCP<Teuchos::Comm<int> const> const &comm);

/// Run a deck to its end: state, cycles, output, checkpoints, summary.
///
/// \return Completed, FailedRun (cause printed, last good checkpoint kept) or Interrupted (checkpoint written).
/// \throws DeckError for what is wrong with the input before anything is written.
ExitStatus simulate(Deck const &deck, RunOptions const &options, Teuchos::RCP<Teuchos::Comm<int> const> const &comm);

} // namespace Harmos

#endif
