// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SCHEMA_RULES_HPP
#define HARMOS_SCHEMA_RULES_HPP

#include <Harmos_DeckSchema.hpp>

#include <Teuchos_Array.hpp>

#include <limits>

namespace Harmos
{
namespace SchemaRules
{

/// How a schema is written: add(list, key, default, rules, doc), rules made by the functions below.
using Teuchos::ParameterList;

constexpr double infinity = std::numeric_limits<double>::infinity();

KeyRange const any{};
KeyRange const positive{0.0, infinity, true, false};
KeyRange const not_negative{0.0, infinity, false, false};
KeyRange const plausible_density{1e-30, 1e30, false, false}; // products of masses and their inverses keep their digits

inline KeyRange between(double min, double max)
{
  return {min, max, false, false};
}

template <class T>
void add(ParameterList &list, std::string const &name, T const &value, KeyRules const &rules, std::string const &doc)
{
  Teuchos::RCP<Teuchos::ParameterEntryValidator const> const validator = Teuchos::rcp(new DeckKeyValidator(rules));
  // set() also validates the default; the value of a key without one only fixes its type.
  if (rules.presence == Presence::Default)
    list.set(name, value, doc, validator);
  else
    list.setEntry(name, Teuchos::ParameterEntry(value, true, false, doc, validator));
}

inline KeyRules rulesOf(KeyType type, KeyRange const &range = any, std::string const &unit = "")
{
  KeyRules rules;
  rules.type = type;
  rules.range = range;
  rules.unit = unit;
  return rules;
}

inline KeyRules required(KeyRules rules)
{
  rules.presence = Presence::Required;
  return rules;
}

inline KeyRules optional(KeyRules rules, std::string const &note)
{
  rules.presence = Presence::Optional;
  rules.default_note = note;
  return rules;
}

inline KeyRules number(KeyRange const &range, std::string const &unit = "")
{
  return rulesOf(KeyType::Number, range, unit);
}

inline KeyRules integer(KeyRange const &range)
{
  return rulesOf(KeyType::Integer, range);
}

inline KeyRules numbers(int least, int most, std::string const &unit, KeyRange const &range = any)
{
  KeyRules rules = rulesOf(KeyType::Numbers, range, unit);
  rules.least_length = least;
  rules.most_length = most;
  return rules;
}

inline KeyRules choice(std::vector<std::string> const &words)
{
  KeyRules rules = rulesOf(KeyType::Choice);
  rules.choices = words;
  return rules;
}

inline Teuchos::Array<double> pair(double x, double y)
{
  return Teuchos::tuple(x, y);
}

} // namespace SchemaRules

/// The key `materials` of a deck.
void addMaterials(Teuchos::ParameterList &materials);

} // namespace Harmos

#endif
