// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_READER_HPP
#define HARMOS_DECK_READER_HPP

#include <Harmos_Deck.hpp>
#include <Harmos_DeckSchema.hpp>

#include <Teuchos_Comm.hpp>

#include <string>
#include <vector>

namespace Harmos
{

/// Read, complete and check a deck. Collective: rank 0 reads the file, all ranks parse the same text.
///
/// \param overrides "path/to/key=value" (a value as YAML spells it), applied before any check. A map that is missing
///                  on the way is made; an unknown key is then an error as in the file.
/// A material's `from: FILE`, a path from the deck's own folder, is replaced by the keys under that file's outermost
/// key `material`; keys in the deck itself win. \throws DeckError (on all ranks alike): one line with the file, the
/// key's path, what is wrong and what is expected.
Deck readDeck(std::string const &file, std::vector<std::string> const &overrides, Teuchos::Comm<int> const &comm);

/// The same from text; `file` is for messages.
Deck readDeckText(std::string const &text, std::string const &file, std::vector<std::string> const &overrides = {});

/// The text of a deck's file on all ranks. Collective. \throws DeckError where it cannot be read.
std::string deckText(std::string const &file, Teuchos::Comm<int> const &comm);

/// The parts of readDeckText, for tools and tests.
/// YAML text with overrides as a list, below the outermost key `harmos`; not checked. \throws DeckError
Teuchos::ParameterList parseDeck(std::string const &text, std::string const &file,
                                 std::vector<std::string> const &overrides = {});
/// Plain values from a complete list (completeDeck), with the checks that need several keys. \throws DeckError
Deck convertDeck(Teuchos::ParameterList complete, std::string const &file);

} // namespace Harmos

#endif
