// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_STUDY_STEPS_HPP
#define HARMOS_REMAP_STUDY_STEPS_HPP

#include "Harmos_RemapStudyMeasures.hpp"

namespace Harmos
{

/// What goes wrong on any rank goes wrong on all. Collective. \throw std::runtime_error of this text
void require(bool holds, Exchange const &exchange, std::string const &what);

/// Take the field from `mesh` to `next` by the deck's scheme; adds the time of the remap alone to the row. Collective.
/// \throw std::runtime_error where a cell leaves its neighbourhood
void stepBy(Study &s, RemapDeck const &deck, Exchange const &exchange, StudyRow &row);

} // namespace Harmos

#endif
