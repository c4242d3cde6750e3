// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_BODIES_HPP
#define HARMOS_DECK_BODIES_HPP

#include <Harmos_Deck.hpp>
#include <Harmos_DeckSchema.hpp>

#include <limits>
#include <string>

/// Parts of convertDeck: from a complete list to plain values, with the checks that need several keys.

namespace Harmos
{

constexpr char const *side_name[num_boundary_sides] = {"left", "right", "bottom", "top"};

/// Faces are numbered 4 * cell + k in 32 bits.
constexpr long long most_cells = std::numeric_limits<int>::max() / 4;

/// Throws DeckError "file: path: message".
class DeckChecker
{
public:
  explicit DeckChecker(std::string file) : file_(std::move(file)) {}
  [[noreturn]] void fail(std::string const &path, std::string const &message) const
  {
    throw DeckError(file_ + ": " + path + ": " + message);
  }
  void require(bool condition, std::string const &path, std::string const &message) const
  {
    if (!condition)
      fail(path, message);
  }

private:
  std::string file_;
};

Vector2 vectorOf(Teuchos::ParameterList const &list, std::string const &key);

/// Number of the named thing, or -1.
template <class Named>
int indexOf(std::vector<Named> const &items, std::string const &name)
{
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name)
      return static_cast<int>(i);
  return -1;
}

template <class Named>
std::vector<std::string> namesOf(std::vector<Named> const &items)
{
  std::vector<std::string> names;
  for (Named const &item : items)
    names.push_back(item.name);
  return names;
}

/// Number of the named thing; fails with the names that exist.
template <class Named>
int requireIndex(DeckChecker const &check, std::vector<Named> const &items, std::string const &name,
                 std::string const &path, std::string const &kind)
{
  int const index = indexOf(items, name);
  check.require(index >= 0, path, "\"" + name + "\" is no " + kind + "; expected one of: " + joined(namesOf(items)));
  return index;
}

/// Density and internal energy from `density`, `internal_energy` and `pressure`, the law's own where absent.
struct InitialState
{
  double density;
  double internal_energy;
};
InitialState initialState(DeckChecker const &check, Teuchos::ParameterList const &list, LawSpec const &law,
                          std::string const &path);

ShapeSpec shapeOf(DeckChecker const &check, Teuchos::ParameterList const &list, std::string const &path);

/// Fills deck.bodies, deck.fields and deck.num_rigid_bodies; needs kinematics, mesh and laws.
void convertBodies(DeckChecker const &check, Teuchos::ParameterList const &bodies, Deck &deck);

} // namespace Harmos

#endif
