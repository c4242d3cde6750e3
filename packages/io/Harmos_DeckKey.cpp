// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckKey.hpp>

#include <Teuchos_Array.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace Harmos
{

namespace
{

using Teuchos::Array;
using Teuchos::ParameterEntry;

/// Blanks, hyphens and underscores are one.
std::string normalised(std::string word)
{
  for (char &c : word)
    if (c == '-' || c == '_')
      c = ' ';
  return word;
}

std::string rangeText(KeyRange const &range)
{
  bool const low = std::isfinite(range.min);
  bool const high = std::isfinite(range.max);
  auto shortText = [](double value)
  {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", value);
    return std::string(buffer);
  };
  if (low && high)
    return std::string(" in ") + (range.without_min ? "(" : "[") + shortText(range.min) + ", " + shortText(range.max) +
           (range.without_max ? ")" : "]");
  if (low)
    return (range.without_min ? " > " : " >= ") + shortText(range.min);
  if (high)
    return (range.without_max ? " < " : " <= ") + shortText(range.max);
  return "";
}

bool isOneLine(std::string const &text)
{
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~' && c != '#' && c != '\\'; });
}

/// The value as numbers; false when it is no array of numbers.
bool numbersOf(ParameterEntry const &entry, Array<double> &numbers)
{
  auto copy = [&](auto const &values)
  {
    for (auto const &value : values)
      numbers.push_back(static_cast<double>(value));
    return true;
  };
  if (entry.isType<Array<double>>())
    return copy(Teuchos::getValue<Array<double>>(entry));
  if (entry.isType<Array<int>>())
    return copy(Teuchos::getValue<Array<int>>(entry));
  if (entry.isType<Array<long long>>())
    return copy(Teuchos::getValue<Array<long long>>(entry));
  return false;
}

bool numberOf(ParameterEntry const &entry, double &number)
{
  if (entry.isType<double>())
    number = Teuchos::getValue<double>(entry);
  else if (entry.isType<int>())
    number = Teuchos::getValue<int>(entry);
  else if (entry.isType<long long>())
    number = static_cast<double>(Teuchos::getValue<long long>(entry));
  else
    return false;
  return true;
}

/// Whether a text, which no deck's reader took for a number, is one all the same: too large, or none that is finite.
bool isUnboundedNumber(std::string text)
{
  if (text.size() > 1 && text[0] == '.' && std::isalpha(static_cast<unsigned char>(text[1])))
    text.erase(0, 1); // YAML writes .inf and .nan
  char *end = nullptr;
  double const value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && !std::isfinite(value);
}

/// Whether an entry is no number, or an integer, only because of its size.
bool isUnbounded(ParameterEntry const &entry)
{
  if (entry.isType<std::string>())
    return isUnboundedNumber(Teuchos::getValue<std::string>(entry));
  if (entry.isType<Array<std::string>>())
  {
    Array<std::string> const &items = Teuchos::getValue<Array<std::string>>(entry);
    return std::any_of(items.begin(), items.end(), isUnboundedNumber);
  }
  return entry.isType<long long>();
}

template <class T>
std::string arrayText(Array<T> const &values)
{
  std::string text = "[";
  for (int i = 0; i < static_cast<int>(values.size()); ++i)
  {
    Teuchos::ParameterEntry const item(values[i]);
    text += (i > 0 ? ", " : "") + valueText(item);
  }
  return text + "]";
}

} // namespace

std::string keyPath(std::string const &path, std::string const &name)
{
  return path.empty() ? name : path + "/" + name;
}

std::string joined(std::vector<std::string> const &items, std::string const &separator)
{
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text += (i > 0 ? separator : "") + items[i];
  return text;
}

bool isName(std::string const &text)
{
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

std::string nearestWord(std::string const &word, std::vector<std::string> const &candidates)
{
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, word.size() / 2) + 1;
  for (std::string const &candidate : candidates)
  {
    std::vector<std::size_t> row(candidate.size() + 1);
    for (std::size_t j = 0; j <= candidate.size(); ++j)
      row[j] = j;
    for (std::size_t i = 1; i <= word.size(); ++i)
    {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= candidate.size(); ++j)
      {
        std::size_t const change = diagonal + (word[i - 1] == candidate[j - 1] ? 0 : 1);
        diagonal = row[j];
        row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
      }
    }
    if (row.back() < best_distance)
    {
      best_distance = row.back();
      best = candidate;
    }
  }
  return best;
}

std::string numberText(double value)
{
  char buffer[40];
  for (int digits = 15; digits <= 17; ++digits)
  {
    std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
    if (std::strtod(buffer, nullptr) == value)
      break;
  }
  std::string text = buffer;
  if (text.find_first_of(".e") == std::string::npos && std::isfinite(value))
    text += ".0";
  return text;
}

std::string valueText(ParameterEntry const &entry)
{
  if (entry.isList())
    return "a map";
  if (entry.isType<std::string>())
    return "\"" + Teuchos::getValue<std::string>(entry) + "\"";
  if (entry.isType<bool>())
    return Teuchos::getValue<bool>(entry) ? "true" : "false";
  if (entry.isType<double>())
    return numberText(Teuchos::getValue<double>(entry));
  if (entry.isType<int>())
    return std::to_string(Teuchos::getValue<int>(entry));
  if (entry.isType<long long>())
    return std::to_string(Teuchos::getValue<long long>(entry));
  if (entry.isType<Array<double>>())
    return arrayText(Teuchos::getValue<Array<double>>(entry));
  if (entry.isType<Array<int>>())
    return arrayText(Teuchos::getValue<Array<int>>(entry));
  if (entry.isType<Array<std::string>>())
    return arrayText(Teuchos::getValue<Array<std::string>>(entry));
  return "a value of type " + entry.getAny(false).typeName();
}

std::string DeckKeyValidator::expected() const
{
  std::string const unit = rules_.unit.empty() ? "" : " [" + rules_.unit + "]";
  switch (rules_.type)
  {
  case KeyType::Text:
    return "text of one line, ASCII, without # and backslash";
  case KeyType::Name:
    return "name";
  case KeyType::Names:
    return "array of names";
  case KeyType::Choice:
    return joined(rules_.choices, " | ");
  case KeyType::Bool:
    return "true | false";
  case KeyType::Integer:
    return "integer" + rangeText(rules_.range) + unit;
  case KeyType::Number:
    return "number" + rangeText(rules_.range) + unit;
  case KeyType::Numbers:
    break;
  }
  std::string const bound = rangeText(rules_.range);
  std::string const each = bound.empty() ? "" : ", each" + bound;
  if (rules_.least_length == rules_.most_length)
    return "array of " + std::to_string(rules_.least_length) + " numbers" + each + unit;
  return "array of at least " + std::to_string(rules_.least_length) + " numbers" + each + unit;
}

void DeckKeyValidator::printDoc(std::string const &doc, std::ostream &out) const
{
  out << "# " << doc << "\n# expected: " << expected() << "\n";
}

DeckKeyValidator::ValidStringsList DeckKeyValidator::validStringValues() const
{
  if (rules_.type != KeyType::Choice)
    return Teuchos::null;
  return Teuchos::rcp(new Array<std::string>(rules_.choices));
}

void DeckKeyValidator::checkRange(double value, std::string const &where) const
{
  KeyRange const &r = rules_.range;
  bool const low = r.without_min ? !(value > r.min) : !(value >= r.min);
  bool const high = r.without_max ? !(value < r.max) : !(value <= r.max);
  if (low || high || !std::isfinite(value))
    throw Teuchos::Exceptions::InvalidParameterValue(where + " is out of range; expected: " + expected());
}

Teuchos::any DeckKeyValidator::converted(ParameterEntry const &entry, std::string const &where) const
{
  Teuchos::Exceptions::InvalidParameterType const wrong_type(where + " is of the wrong type; expected: " + expected());
  auto const refuseNumber = [&]
  {
    if (isUnbounded(entry))
      throw Teuchos::Exceptions::InvalidParameterValue(where +
                                                       " is no finite number or too large; expected: " + expected());
    throw wrong_type;
  };
  switch (rules_.type)
  {
  case KeyType::Bool:
    if (!entry.isType<bool>())
      throw wrong_type;
    return Teuchos::any(Teuchos::getValue<bool>(entry));
  case KeyType::Integer:
    if (!entry.isType<int>())
      refuseNumber();
    checkRange(Teuchos::getValue<int>(entry), where);
    return Teuchos::any(Teuchos::getValue<int>(entry));
  case KeyType::Number:
  {
    double value = 0.0;
    if (!numberOf(entry, value))
      refuseNumber();
    checkRange(value, where);
    return Teuchos::any(value);
  }
  case KeyType::Numbers:
  {
    Array<double> values;
    if (!numbersOf(entry, values))
      refuseNumber();
    int const size = static_cast<int>(values.size());
    if (size < rules_.least_length || (rules_.most_length > 0 && size > rules_.most_length))
      throw Teuchos::Exceptions::InvalidParameterValue(where + " has the wrong length; expected: " + expected());
    for (double value : values)
      checkRange(value, where);
    return Teuchos::any(values);
  }
  case KeyType::Names:
    if (!entry.isType<Array<std::string>>())
      throw wrong_type;
    return Teuchos::any(Teuchos::getValue<Array<std::string>>(entry));
  default:
    break;
  }
  if (!entry.isType<std::string>())
    throw wrong_type;
  std::string const text = Teuchos::getValue<std::string>(entry);
  Teuchos::Exceptions::InvalidParameterValue const refused(where + " is not allowed; expected: " + expected());
  if (rules_.type == KeyType::Text && !isOneLine(text))
    throw refused;
  if (rules_.type == KeyType::Name && !isName(text))
    throw refused;
  if (rules_.type != KeyType::Choice)
    return Teuchos::any(text);
  for (std::string const &choice : rules_.choices)
    if (normalised(text) == normalised(choice))
      return Teuchos::any(choice);
  std::string const near = nearestWord(text, rules_.choices);
  throw Teuchos::Exceptions::InvalidParameterValue(where + " is not allowed" +
                                                   (near.empty() ? "" : "; did you mean \"" + near + "\"?") +
                                                   "; expected: " + expected());
}

void DeckKeyValidator::validate(ParameterEntry const &entry, std::string const &name, std::string const &path) const
{
  bool const empty_map = entry.isList() && Teuchos::getValue<Teuchos::ParameterList>(entry).numParams() == 0;
  std::string const value = empty_map ? "no value" : valueText(entry);
  converted(entry, keyPath(path, name) + ": " + value);
}

void DeckKeyValidator::validateAndModify(std::string const &name, std::string const &path, ParameterEntry *entry) const
{
  validate(*entry, name, path);
  entry->setAnyValue(converted(*entry, name), entry->isDefault());
}

} // namespace Harmos
