// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_LAWS_HPP
#define HARMOS_DECK_LAWS_HPP

#include <Harmos_DeckBodies.hpp>

/// Parts of convertDeck: laws of materials.

namespace Harmos
{

/// `materials` -> deck.laws, in the deck's order. \throws DeckError
void convertLaws(DeckChecker const &check, Teuchos::ParameterList const &materials, Deck &deck);

} // namespace Harmos

#endif
