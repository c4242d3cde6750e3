// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_SCHEMA_HPP
#define HARMOS_DECK_SCHEMA_HPP

#include <Harmos_DeckKey.hpp>

#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

namespace Harmos
{

/// A deck that cannot be run. what() is one line: "file: path/to/key: what is wrong; what is expected".
class DeckError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Every key that a deck may hold: one list with the default, doc string and DeckKeyValidator of each key.
///
/// Two kinds of sublist have a meaning of their own:
/// - "NAME" stands for any number of sublists that the deck names (bodies, materials, ...);
/// - "key = value" holds the keys that exist beside `key` only where it has this value (shape = disc: radius).
/// It serves validation, defaults and `harmos schema`, so that they cannot disagree.
Teuchos::ParameterList deckSchema();

/// Check a deck against a schema.
///
/// \param input The deck as read.
/// \param file  For messages.
/// \return The deck with all defaults, keys in the order of the schema, named sublists in the order of the deck.
/// \throws DeckError at the first unknown, missing, wrongly typed or impossible entry.
Teuchos::ParameterList completeDeck(Teuchos::ParameterList const &schema, Teuchos::ParameterList const &input,
                                    std::string const &file);

/// A key of the schema, for people and tests.
struct SchemaKey
{
  std::string path;      // "bodies/NAME/radius"
  std::string condition; // "shape = disc"; empty: always
  std::string expected;  // type, range, unit, allowed words
  std::string default_text;
  std::string doc;
};

std::vector<SchemaKey> schemaKeys(Teuchos::ParameterList const &schema);

/// The text of `harmos schema`, or of another schema.
void printSchema(std::ostream &out);
void printSchema(std::ostream &out, Teuchos::ParameterList const &schema);

/// A complete deck as YAML and as JSON. Doubles keep their bits and stay doubles, words stay words. Empty arrays,
/// which Teuchos' parser refuses, are left out of the YAML (they are defaults).
std::string deckAsYaml(Teuchos::ParameterList const &deck);
std::string deckAsJson(Teuchos::ParameterList const &deck);

} // namespace Harmos

#endif
