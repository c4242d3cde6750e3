// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckDifference.hpp>

#include <Harmos_DeckReader.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <sstream>
#include <utility>

namespace Harmos
{

namespace
{

using Teuchos::ParameterList;
using Values = std::vector<std::pair<std::string, std::string>>;

void flatten(ParameterList const &list, std::string const &path, Values &values)
{
  for (auto i = list.begin(); i != list.end(); ++i)
  {
    std::string const here = path.empty() ? list.name(i) : path + '/' + list.name(i);
    if (list.entry(i).isList())
    {
      flatten(list.sublist(list.name(i)), here, values);
      continue;
    }
    std::ostringstream text;
    list.entry(i).leftshift(text, false);
    values.emplace_back(here, text.str());
  }
}

std::string valueAt(Values const &values, std::string const &path)
{
  auto const found = std::find_if(values.begin(), values.end(), [&](auto const &item) { return item.first == path; });
  return found == values.end() ? "" : found->second;
}

} // namespace

std::vector<std::string> changedKeys(std::string const &before, std::string const &now)
{
  Values old_values, values;
  flatten(parseDeck(before, "the earlier deck"), "", old_values);
  flatten(parseDeck(now, "the deck"), "", values);
  std::vector<std::string> changed;
  for (auto const &[path, value] : values)
    if (valueAt(old_values, path) != value)
      changed.push_back(path);
  for (auto const &[path, value] : old_values)
    if (valueAt(values, path).empty())
      changed.push_back(path);
  return changed;
}

} // namespace Harmos
