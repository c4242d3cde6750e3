// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_RemapDeck.hpp>

#include <Harmos_DeckReader.hpp>

#include <Teuchos_Array.hpp>

#include <cmath>

namespace Harmos
{

namespace
{

using Teuchos::ParameterList;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
void add(ParameterList &list, std::string const &name, T const &value, KeyType type, std::string const &doc,
         KeyRange const &range = {}, std::vector<std::string> const &choices = {})
{
  KeyRules rules;
  rules.type = type;
  rules.range = range;
  rules.choices = choices;
  rules.least_length = type == KeyType::Numbers ? 1 : 0;
  list.set(name, value, doc,
           Teuchos::RCP<Teuchos::ParameterEntryValidator const>(Teuchos::rcp(new DeckKeyValidator(rules))));
}

RemapScheme schemeOf(std::string const &word)
{
  return word == "swept"                ? RemapScheme::Swept
         : word == "intersection"       ? RemapScheme::Intersection
         : word == "field intersection" ? RemapScheme::FieldIntersection
         : word == "interpolation"      ? RemapScheme::Interpolation
         : word == "lumped projection"  ? RemapScheme::LumpedProjection
                                        : RemapScheme::ConsistentProjection;
}

void require(bool holds, std::string const &file, std::string const &key, std::string const &what)
{
  if (!holds)
    throw DeckError(file + ": " + key + ": " + what);
}

} // namespace

int RemapDeck::stepsOf(int cells_along_a_side) const
{
  if (steps > 0)
    return steps;
  return motion.kind == MotionKind::Random ? 1 : static_cast<int>(std::lround(steps_per_cell * cells_along_a_side));
}

ParameterList remapSchema()
{
  ParameterList schema("harmos");
  add(schema, "title", std::string(), KeyType::Text, "what the run is about");
  add(schema, "motion", std::string("tensor"), KeyType::Choice,
      "of the mesh of the unit square. tensor, smooth: there and back (Margolin & Shashkov 2003); random: inner nodes "
      "shifted at random, anew each step",
      {}, {"tensor", "smooth", "random"});
  add(schema, "geometry", std::string("planar"), KeyType::Choice,
      "axisymmetric: x is the radius, averages are weighted by it; schemes swept and intersection", {},
      {"planar", "axisymmetric"});
  add(schema, "amplitude", 0.25, KeyType::Number, "random: largest shift of a coordinate, part of a cell",
      {0.0, 0.3, false, false});
  add(schema, "seed", 1, KeyType::Integer, "random: of the shifts", {0.0, 65535.0, false, false});
  add(schema, "field", std::string("sine"), KeyType::Choice,
      "sine: base + sin(2 pi x) sin(2 pi y); shock: 0 where y > (x - 0.4)/0.3, else 1", {}, {"sine", "shock"});
  add(schema, "base", 1.0, KeyType::Number, "sine: its mean", {-infinity, infinity, false, false});
  add(schema, "carrier", std::string("energy"), KeyType::Choice,
      "energy: specific internal energy of a material of density one; density: the density, positive everywhere", {},
      {"energy", "density"});
  add(schema, "scheme", std::string("swept"), KeyType::Choice,
      "swept, intersection: the remap of the cycle, with all that it carries; field intersection: the field alone. "
      "Comparators, on one rank: interpolation at the new centroids; "
      "lumped "
      "or consistent projection: least squares on bilinear elements",
      {},
      {"swept", "intersection", "field intersection", "interpolation", "lumped projection", "consistent projection"});
  add(schema, "order", 2, KeyType::Integer,
      "1: constant in a cell; 2: linear; 3: quadratic, schemes swept and intersection. Limited in the remap of the "
      "cycle",
      {1.0, 3.0, false, false});
  add(schema, "limiter", std::string("range inside"), KeyType::Choice,
      "swept and intersection of second order: as numerics/remap/limiter of a run; comparators have none", {},
      {"range", "range inside", "van leer", "none"});
  add(schema, "cells", Teuchos::Array<double>(Teuchos::tuple(32.0, 64.0)), KeyType::Numbers,
      "along a side: one run each, ascending", {4.0, 4096.0, false, false});
  add(schema, "steps", 0, KeyType::Integer, "remaps in all; 0: one if random, else by steps_per_cell",
      {0.0, infinity, false, false});
  add(schema, "steps_per_cell", 5.0, KeyType::Number, "remaps over the cells along a side",
      {0.0, infinity, true, false});
  return schema;
}

RemapDeck readRemapDeckText(std::string const &text, std::string const &file, std::vector<std::string> const &overrides)
{
  ParameterList const list = completeDeck(remapSchema(), parseDeck(text, file, overrides), file);
  RemapDeck deck;
  deck.title = list.get<std::string>("title");
  std::string const motion = list.get<std::string>("motion");
  deck.motion.kind = motion == "tensor"   ? MotionKind::Tensor
                     : motion == "smooth" ? MotionKind::Smooth
                                          : MotionKind::Random;
  deck.motion.amplitude = list.get<double>("amplitude");
  deck.motion.seed = list.get<int>("seed");
  deck.geometry = list.get<std::string>("geometry") == "axisymmetric" ? Geometry::Axisymmetric : Geometry::Planar;
  deck.field.shock = list.get<std::string>("field") == "shock";
  deck.field.base = list.get<double>("base");
  deck.field.density = list.get<std::string>("carrier") == "density";
  deck.scheme = schemeOf(list.get<std::string>("scheme"));
  deck.order = list.get<int>("order");
  std::string const limiter = list.get<std::string>("limiter");
  deck.limiter = limiter == "range"          ? RemapLimiter::Range
                 : limiter == "range inside" ? RemapLimiter::RangeInside
                 : limiter == "van leer"     ? RemapLimiter::VanLeer
                                             : RemapLimiter::None;
  deck.steps = list.get<int>("steps");
  deck.steps_per_cell = list.get<double>("steps_per_cell");
  for (double n : list.get<Teuchos::Array<double>>("cells"))
  {
    require(n == std::floor(n), file, "cells", numberText(n) + " is no whole number");
    require(deck.cells.empty() || n > deck.cells.back(), file, "cells", "not ascending");
    deck.cells.push_back(static_cast<int>(n));
  }
  bool const compares = deck.compares();
  require(!deck.field.density || (!deck.field.shock && deck.field.base > 1.0), file, "carrier",
          "the field is not positive everywhere; expected: energy, or field sine with base above 1");
  require(deck.order < 3 || deck.scheme == RemapScheme::Intersection || deck.scheme == RemapScheme::Swept, file,
          "order", "3 is for schemes swept and intersection");
  require(deck.geometry == Geometry::Planar || deck.scheme == RemapScheme::Swept ||
              deck.scheme == RemapScheme::Intersection,
          file, "scheme", "it is planar with geometry axisymmetric; expected: swept or intersection");
  require(!compares || deck.limiter == RemapLimiter::RangeInside, file, "limiter",
          "a comparator has none; expected: scheme swept or intersection");
  require(deck.scheme != RemapScheme::FieldIntersection || deck.limiter != RemapLimiter::VanLeer, file, "limiter",
          "'van leer' is not for scheme field intersection; expected: range, range inside or none");
  require(!(compares && deck.field.density), file, "carrier",
          "density means nothing to a comparator, which knows one "
          "field alone; expected: energy");
  deck.json = deckAsJson(list);
  return deck;
}

RemapDeck readRemapDeck(std::string const &file, std::vector<std::string> const &overrides,
                        Teuchos::Comm<int> const &comm)
{
  return readRemapDeckText(deckText(file, comm), file, overrides);
}

} // namespace Harmos
