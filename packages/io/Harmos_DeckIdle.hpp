// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_IDLE_HPP
#define HARMOS_DECK_IDLE_HPP

#include <Harmos_Deck.hpp>

#include <Teuchos_ParameterList.hpp>

namespace Harmos
{

/// One deck serves the three kinematics: keys of `numerics` that the one chosen has no use for are accepted.
///
/// \param complete The whole deck with defaults (completeDeck).
/// \param deck     The same, converted: its kinematics and prescribed velocity decide.
/// \return Paths of such keys that differ from their default: without effect on this run, in the schema's order.
std::vector<std::string> idleKeys(Teuchos::ParameterList const &complete, Deck const &deck);

} // namespace Harmos

#endif
