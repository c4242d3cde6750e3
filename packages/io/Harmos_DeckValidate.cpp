// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckSchema.hpp>

#include <algorithm>
#include <limits>

namespace Harmos
{

namespace
{

using Teuchos::ParameterEntry;
using Teuchos::ParameterList;

char const *const any_name = "NAME";

/// "shape = disc" -> {"shape", "disc"}
bool isCondition(std::string const &name, std::string &key, std::string &value)
{
  std::size_t const at = name.find(" = ");
  if (at == std::string::npos)
    return false;
  key = name.substr(0, at);
  value = name.substr(at + 3);
  return true;
}

ParameterList const &listOf(ParameterEntry const &entry)
{
  return Teuchos::getValue<ParameterList>(entry);
}

DeckKeyValidator const &validatorOf(ParameterEntry const &entry)
{
  return dynamic_cast<DeckKeyValidator const &>(*entry.validator());
}

/// The schema's entries that hold for one list of the deck.
struct Active
{
  std::vector<std::pair<std::string, ParameterEntry const *>> entries; // keys and fixed sublists
  ParameterList const *any = nullptr;                                  // schema of named sublists
  std::vector<std::pair<std::string, std::string>> elsewhere;          // key, condition that would allow it
  bool undecided = false; // a required key that decides on others is missing
};

class Walk
{
public:
  explicit Walk(std::string const &file) : file_(file) {}

  ParameterList complete(ParameterList const &schema, ParameterList const &input, std::string const &path) const
  {
    Active active;
    activate(schema, input, path, active);
    refuseUnknown(active, input, path);
    ParameterList result(path.empty() ? "harmos" : path);
    for (auto const &[name, entry] : active.entries)
    {
      ParameterEntry const *given = input.getEntryPtr(name);
      if (!entry->isList())
        completeKey(name, *entry, given, path, result);
      else if (given && !given->isList())
        refuseValue(keyPath(path, name), *given, listOf(*entry));
      else
        result.set(name, complete(listOf(*entry), given ? listOf(*given) : ParameterList(), keyPath(path, name)));
    }
    if (active.any)
      completeNamed(active, input, path, result);
    return result;
  }

private:
  [[noreturn]] void fail(std::string const &message) const { throw DeckError(file_ + ": " + message); }

  [[noreturn]] void refuseValue(std::string const &key, ParameterEntry const &given, ParameterList const &schema) const
  {
    fail(key + ": " + valueText(given) + " is no map; expected: a map with the keys " + joined(names(schema)));
  }

  static std::vector<std::string> names(ParameterList const &schema)
  {
    std::vector<std::string> result;
    std::string key, value;
    for (auto i = schema.begin(); i != schema.end(); ++i)
      if (!isCondition(schema.name(i), key, value))
        result.push_back(schema.name(i));
    return result;
  }

  ParameterEntry checked(std::string const &name, ParameterEntry const &rule, ParameterEntry const &given,
                         std::string const &path) const
  {
    ParameterEntry entry(given);
    try
    {
      validatorOf(rule).validateAndModify(name, path, &entry);
    }
    catch (Teuchos::Exceptions::InvalidParameter const &error)
    {
      fail(error.what());
    }
    return entry;
  }

  void activate(ParameterList const &schema, ParameterList const &input, std::string const &path, Active &active) const
  {
    for (auto i = schema.begin(); i != schema.end(); ++i)
    {
      std::string const &name = schema.name(i);
      ParameterEntry const &entry = schema.entry(i);
      std::string key, value;
      if (name == any_name)
        active.any = &listOf(entry);
      else if (!isCondition(name, key, value))
        active.entries.emplace_back(name, &entry);
      else
      {
        ParameterEntry const &rule = schema.getEntry(key);
        ParameterEntry const *given = input.getEntryPtr(key);
        bool const missing = !given && validatorOf(rule).rules().presence == Presence::Required;
        active.undecided = active.undecided || missing;
        std::string const actual =
            Teuchos::getValue<std::string>(given ? checked(key, rule, *given, path) : ParameterEntry(rule));
        if (!missing && actual == value)
          activate(listOf(entry), input, path, active);
        else
          listElsewhere(listOf(entry), name, active);
      }
    }
  }

  /// The keys that stand under a condition that does not hold, and under further conditions there.
  static void listElsewhere(ParameterList const &schema, std::string const &condition, Active &active)
  {
    for (auto i = schema.begin(); i != schema.end(); ++i)
    {
      std::string key, value;
      if (isCondition(schema.name(i), key, value))
        listElsewhere(listOf(schema.entry(i)), condition + ", " + schema.name(i), active);
      else
        active.elsewhere.emplace_back(schema.name(i), condition);
    }
  }

  /// Of the conditions under which a key would belong here, those that ask for the fewest changes.
  static void keepNearest(std::vector<std::string> &conditions)
  {
    auto const changes = [](std::string const &text) { return std::count(text.begin(), text.end(), ','); };
    long fewest = std::numeric_limits<long>::max();
    for (std::string const &condition : conditions)
      fewest = std::min<long>(fewest, changes(condition));
    conditions.erase(std::remove_if(conditions.begin(), conditions.end(),
                                    [&](std::string const &condition) { return changes(condition) > fewest; }),
                     conditions.end());
  }

  void refuseUnknown(Active const &active, ParameterList const &input, std::string const &path) const
  {
    for (auto i = input.begin(); i != input.end(); ++i)
    {
      std::string const &name = input.name(i);
      auto const same = [&](auto const &item) { return item.first == name; };
      if (std::any_of(active.entries.begin(), active.entries.end(), same))
        continue;
      std::vector<std::string> conditions;
      for (auto const &[other, condition] : active.elsewhere)
        if (other == name)
          conditions.push_back(condition);
      keepNearest(conditions);
      if (active.undecided && !conditions.empty())
        continue;
      if (active.any && conditions.empty() && input.entry(i).isList())
        continue;
      std::vector<std::string> allowed;
      for (auto const &item : active.entries)
        allowed.push_back(item.first);
      std::string message = keyPath(path, name) + ": unknown key";
      std::string const near = nearestWord(name, allowed);
      if (!conditions.empty())
        message = keyPath(path, name) + ": does not belong here, only where " + joined(conditions, " or ");
      else if (!near.empty())
        message += "; did you mean " + near + "?";
      else if (active.any)
        refuseValue(keyPath(path, name), input.entry(i), *active.any);
      if (active.any)
        allowed.push_back(allowed.empty() ? "a name with a map" : "or a name with a map");
      fail(message + "; allowed: " + joined(allowed));
    }
  }

  void completeKey(std::string const &name, ParameterEntry const &rule, ParameterEntry const *given,
                   std::string const &path, ParameterList &result) const
  {
    DeckKeyValidator const &validator = validatorOf(rule);
    if (given)
      result.setEntry(name, checked(name, rule, *given, path));
    else if (validator.rules().presence == Presence::Required)
      fail(keyPath(path, name) + ": missing; expected: " + validator.expected());
    else if (validator.rules().presence == Presence::Default)
    {
      ParameterEntry entry;
      entry.setAnyValue(rule.getAny(false), true);
      result.setEntry(name, entry);
    }
  }

  void completeNamed(Active const &active, ParameterList const &input, std::string const &path,
                     ParameterList &result) const
  {
    for (auto i = input.begin(); i != input.end(); ++i)
    {
      std::string const &name = input.name(i);
      if (result.isParameter(name))
        continue;
      if (!isName(name))
        fail(keyPath(path, name) + ": not a name; expected: letters, digits, _ and -, a letter first");
      result.set(name, complete(*active.any, listOf(input.entry(i)), keyPath(path, name)));
    }
  }

  std::string const &file_;
};

std::string defaultText(ParameterEntry const &entry)
{
  KeyRules const &rules = validatorOf(entry).rules();
  if (rules.presence == Presence::Required)
    return "required";
  if (rules.presence == Presence::Optional)
    return rules.default_note;
  if (entry.isType<std::string>())
  {
    std::string const text = Teuchos::getValue<std::string>(entry);
    return text.empty() ? "(empty)" : text;
  }
  return valueText(entry);
}

void collect(ParameterList const &schema, std::string const &path, std::string const &condition,
             std::vector<SchemaKey> &keys)
{
  for (auto i = schema.begin(); i != schema.end(); ++i)
  {
    std::string const &name = schema.name(i);
    ParameterEntry const &entry = schema.entry(i);
    std::string key, value;
    if (isCondition(name, key, value))
      collect(listOf(entry), path, condition.empty() ? name : condition + ", " + name, keys);
    else if (entry.isList())
      collect(listOf(entry), keyPath(path, name), "", keys);
    else
      keys.push_back(
          {keyPath(path, name), condition, validatorOf(entry).expected(), defaultText(entry), entry.docString()});
  }
}

} // namespace

Teuchos::ParameterList completeDeck(ParameterList const &schema, ParameterList const &input, std::string const &file)
{
  return Walk(file).complete(schema, input, "");
}

std::vector<SchemaKey> schemaKeys(ParameterList const &schema)
{
  std::vector<SchemaKey> keys;
  collect(schema, "", "", keys);
  return keys;
}

} // namespace Harmos
