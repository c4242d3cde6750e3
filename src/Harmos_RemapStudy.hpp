// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_STUDY_HPP
#define HARMOS_REMAP_STUDY_HPP

#include "Harmos_Simulation.hpp"

#include <Harmos_RemapDeck.hpp>

namespace Harmos
{

/// Remap a field over moving meshes, without mechanics: one run for every number of cells of the deck.
///
/// At every step the material rests and the mesh moves to its next place; remap() takes the field there. Prints a table
/// and writes it to remap.csv: errors of the cell averages at the end in the norms L1 = sum |f - f0| V, L2, Linf with
/// their orders; the largest relative change of the sum of f V; how far f went below and above the range that it had at
/// the start; the largest displacement of a node over the smallest altitude of a cell around; times in remap(), of
/// which the processor's is printed. \return Completed or FailedRun (cause printed). \throws DeckError
ExitStatus studyRemap(RemapDeck const &deck, RunOptions const &options,
                      Teuchos::RCP<Teuchos::Comm<int> const> const &comm);

} // namespace Harmos

#endif
