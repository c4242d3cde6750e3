// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_CONTACT_HPP
#define HARMOS_DECK_CONTACT_HPP

#include <Harmos_DeckBodies.hpp>

/// Parts of convertDeck: contact.

namespace Harmos
{

/// `interactions` -> deck.interaction. \throws DeckError
void convertInteractions(DeckChecker const &check, Teuchos::ParameterList const &list, Deck &deck);

/// `numerics/constraint` -> deck.constraint, with what method, bodies, boundaries and interactions mean together.
/// \throws DeckError
void convertConstraint(DeckChecker const &check, Teuchos::ParameterList const &list, Deck &deck);

} // namespace Harmos

#endif
