// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_DIFFERENCE_HPP
#define HARMOS_DECK_DIFFERENCE_HPP

#include <string>
#include <vector>

namespace Harmos
{

/// Paths of the keys whose values differ between two whole decks with their defaults (Deck::yaml): those of `now` in
/// its order, then those that only `before` has. \throws DeckError where one is no deck
std::vector<std::string> changedKeys(std::string const &before, std::string const &now);

} // namespace Harmos

#endif
