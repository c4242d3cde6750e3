// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckSchema.hpp>

#include <Teuchos_Array.hpp>

#include <algorithm>
#include <array>
#include <cctype>

namespace Harmos
{

namespace
{

using Teuchos::Array;
using Teuchos::getValue;
using Teuchos::ParameterEntry;
using Teuchos::ParameterList;

/// Words stand alone; anything that could be read as something else is quoted.
std::string yamlText(std::string const &text)
{
  static std::array<char const *, 8> const reserved = {"true", "false", "yes", "no", "on", "off", "y", "n"};
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  bool const word = isName(text) && std::find(reserved.begin(), reserved.end(), lower) == reserved.end();
  if (word)
    return text;
  std::string quoted = "'";
  for (char c : text)
    quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

std::string jsonText(std::string const &text)
{
  std::string quoted = "\"";
  for (char c : text)
  {
    if (c == '"' || c == '\\')
      quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

using TextWriter = std::string (*)(std::string const &);

template <class T, class Write>
std::string arrayOf(Array<T> const &values, Write const &write)
{
  std::vector<std::string> items;
  for (T const &value : values)
    items.push_back(write(value));
  return "[" + joined(items) + "]";
}

std::string entryText(ParameterEntry const &entry, TextWriter text)
{
  if (entry.isType<std::string>())
    return text(getValue<std::string>(entry));
  if (entry.isType<Array<std::string>>())
    return arrayOf(getValue<Array<std::string>>(entry), text);
  if (entry.isType<Array<double>>())
    return arrayOf(getValue<Array<double>>(entry), numberText);
  return valueText(entry);
}

bool isEmptyArray(ParameterEntry const &entry)
{
  return entry.isType<Array<std::string>>() && getValue<Array<std::string>>(entry).empty();
}

void writeYaml(ParameterList const &list, std::string const &indent, std::string &out)
{
  for (auto i = list.begin(); i != list.end(); ++i)
  {
    ParameterEntry const &entry = list.entry(i);
    if (isEmptyArray(entry))
      continue;
    out += indent + list.name(i) + ":";
    if (!entry.isList())
      out += " " + entryText(entry, yamlText) + "\n";
    else if (getValue<ParameterList>(entry).numParams() == 0)
      out += " {}\n";
    else
    {
      out += "\n";
      writeYaml(getValue<ParameterList>(entry), indent + "  ", out);
    }
  }
}

void writeJson(ParameterList const &list, std::string const &indent, std::string &out)
{
  std::string const inner = indent + "  ";
  std::string separator = "{\n";
  for (auto i = list.begin(); i != list.end(); ++i)
  {
    ParameterEntry const &entry = list.entry(i);
    out += separator + inner + jsonText(list.name(i)) + ": ";
    if (entry.isList())
      writeJson(getValue<ParameterList>(entry), inner, out);
    else
      out += entryText(entry, jsonText);
    separator = ",\n";
  }
  out += list.numParams() == 0 ? "{}" : "\n" + indent + "}";
}

} // namespace

std::string deckAsYaml(ParameterList const &deck)
{
  std::string out = "harmos:\n";
  writeYaml(deck, "  ", out);
  return out;
}

std::string deckAsJson(ParameterList const &deck)
{
  std::string out;
  writeJson(deck, "", out);
  return out;
}

} // namespace Harmos
