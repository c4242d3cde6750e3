// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckIdle.hpp>

#include <Harmos_DeckSchema.hpp>

#include <algorithm>

namespace Harmos
{

namespace
{

using Teuchos::ParameterEntry;
using Teuchos::ParameterList;

bool hasContactWall(Deck const &deck)
{
  return std::any_of(std::begin(deck.boundary), std::end(deck.boundary),
                     [](Boundary const &side) { return side.kind == BoundaryKind::ContactWall; });
}

/// Keys and folders of keys that mean nothing to this deck's kinematics and bodies.
std::vector<std::string> idlePaths(Deck const &deck)
{
  bool const lagrangian = deck.kinematics == Kinematics::Lagrangian;
  std::vector<std::string> paths;
  if (lagrangian)
    paths = {"numerics/reconstruction", "numerics/remap", "numerics/constraint/exposed_face"};
  else
    paths = {"numerics/subzonal_pressure"};
  if (deck.kinematics == Kinematics::Single || deck.prescribed.kind != FieldKind::None)
    paths.push_back("numerics/remap/part_overlaps"); // all materials move alike
  bool const one_body = deck.fields.size() < 2;
  if (!hasContactWall(deck) && (deck.kinematics == Kinematics::Single || one_body))
    for (char const *key : {"method", "penalty", "placement", "solver", "warm_start", "tolerance", "max_iterations",
                            "exposed_face"}) // nothing touches
      paths.push_back(std::string("numerics/constraint/") + key);
  if (one_body)
    paths.push_back("interactions"); // of bodies; walls have their own friction
  if (deck.prescribed.kind != FieldKind::None)
    paths.insert(paths.end(),
                 {"numerics/linear_viscosity", "numerics/quadratic_viscosity", "numerics/hourglass_viscosity",
                  "numerics/cut_cell_stress", "numerics/closure", "numerics/constraint"});
  return paths;
}

/// The entry at a path of lists, nullptr: none.
ParameterEntry const *entryAt(ParameterList const &list, std::string const &path)
{
  std::size_t const slash = path.find('/');
  if (slash == std::string::npos)
    return list.getEntryPtr(path);
  std::string const name = path.substr(0, slash);
  return list.isSublist(name) ? entryAt(list.sublist(name), path.substr(slash + 1)) : nullptr;
}

/// As SchemaKey::default_text.
std::string plainText(ParameterEntry const &entry)
{
  return entry.isType<std::string>() ? Teuchos::getValue<std::string>(entry) : valueText(entry);
}

} // namespace

std::vector<std::string> idleKeys(ParameterList const &complete, Deck const &deck)
{
  std::vector<std::string> const paths = idlePaths(deck);
  auto const idle = [&](std::string const &key)
  {
    return std::any_of(paths.begin(), paths.end(),
                       [&](std::string const &path) { return key == path || key.rfind(path + '/', 0) == 0; });
  };
  std::vector<std::string> keys;
  for (SchemaKey const &key : schemaKeys(deckSchema()))
  {
    ParameterEntry const *const entry = idle(key.path) ? entryAt(complete, key.path) : nullptr;
    if (entry && plainText(*entry) != key.default_text && std::count(keys.begin(), keys.end(), key.path) == 0)
      keys.push_back(key.path);
  }
  return keys;
}

} // namespace Harmos
