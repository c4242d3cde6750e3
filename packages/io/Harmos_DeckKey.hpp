// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_KEY_HPP
#define HARMOS_DECK_KEY_HPP

#include <Teuchos_ParameterEntryValidator.hpp>
#include <Teuchos_ParameterList.hpp>

#include <limits>
#include <string>
#include <vector>

namespace Harmos
{

enum class KeyType
{
  Text,   // one line
  Name,   // of a body, a material law, ...: letters, digits, _ and -, a letter first
  Choice, // one of a few words; blanks, - and _ are the same
  Bool,
  Integer,
  Number,  // integers are accepted
  Numbers, // array of numbers; integers are accepted
  Names
};

enum class Presence
{
  Required,
  Optional, // absent means what `default_note` says
  Default
};

struct KeyRange
{
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool without_min = false; // min itself is refused
  bool without_max = false;
};

/// What a key of the deck may be.
struct KeyRules
{
  KeyType type = KeyType::Text;
  Presence presence = Presence::Default;
  KeyRange range;                   // of numbers, and of each number of an array
  std::string unit;                 // empty: dimensionless, or no number
  std::vector<std::string> choices; // Choice
  int least_length = 0;             // Numbers
  int most_length = 0;              // Numbers; 0: any
  std::string default_note;         // Optional
};

/// The validator of one key: type, range, unit and allowed words. It turns integers into numbers where numbers are
/// expected, and spellings of a word into the canonical one.
class DeckKeyValidator : public Teuchos::ParameterEntryValidator
{
public:
  explicit DeckKeyValidator(KeyRules rules) : rules_(std::move(rules)) {}

  KeyRules const &rules() const { return rules_; }

  /// What is expected, in words: "number > 0 [m]", "xfem | single | lagrangian".
  std::string expected() const;

  const std::string getXMLTypeName() const override { return "HarmosDeckKey"; }
  void printDoc(std::string const &doc, std::ostream &out) const override;
  ValidStringsList validStringValues() const override;

  /// \throws Teuchos::Exceptions::InvalidParameterType, InvalidParameterValue with one line:
  ///         "path/key: value ...; expected: ...".
  void validate(Teuchos::ParameterEntry const &entry, std::string const &name, std::string const &path) const override;
  void validateAndModify(std::string const &name, std::string const &path,
                         Teuchos::ParameterEntry *entry) const override;

private:
  Teuchos::any converted(Teuchos::ParameterEntry const &entry, std::string const &where) const;
  void checkRange(double value, std::string const &where) const;

  KeyRules rules_;
};

/// "path/name", or "name" at the root.
std::string keyPath(std::string const &path, std::string const &name);

/// The candidate nearest to a misspelt word (Levenshtein distance at most a third of its length, at least one); empty:
/// none.
std::string nearestWord(std::string const &word, std::vector<std::string> const &candidates);

/// Items separated by ", ".
std::string joined(std::vector<std::string> const &items, std::string const &separator = ", ");

bool isName(std::string const &text);

/// An entry's value as the deck would spell it; doubles keep all digits and always look like doubles.
std::string valueText(Teuchos::ParameterEntry const &entry);

/// Shortest decimal text that reads back to the same double and not to an integer.
std::string numberText(double value);

} // namespace Harmos

#endif
