// SPDX-License-Identifier: BSD-3-Clause
#include "DeckExample.hpp"

#include <Harmos_DeckReader.hpp>

#include <gtest/gtest.h>

#include <set>
#include <sstream>

using namespace Harmos;
using Teuchos::ParameterList;

namespace
{

/// "bodies/slider/radius" -> "bodies/NAME/radius"
void collectPaths(ParameterList const &list, std::string const &path, std::set<std::string> &paths)
{
  static std::set<std::string> const named = {"materials", "bodies", "interactions", "probes", "tracers"};
  for (auto i = list.begin(); i != list.end(); ++i)
  {
    if (!list.entry(i).isList())
      paths.insert(keyPath(path, list.name(i)));
    else
      collectPaths(list.sublist(list.name(i)), keyPath(path, named.count(path) ? "NAME" : list.name(i)), paths);
  }
}

std::set<std::string> schemaPaths()
{
  std::set<std::string> paths;
  for (SchemaKey const &key : schemaKeys(deckSchema()))
    paths.insert(key.path);
  return paths;
}

} // namespace

TEST(DeckSchema, EveryKey_hasTypeDefaultAndDoc)
{
  std::vector<SchemaKey> const keys = schemaKeys(deckSchema());
  EXPECT_GT(keys.size(), 80u);
  for (SchemaKey const &key : keys)
  {
    EXPECT_FALSE(key.expected.empty()) << key.path;
    EXPECT_FALSE(key.default_text.empty()) << key.path;
    EXPECT_FALSE(key.doc.empty()) << key.path;
  }
}

TEST(DeckSchema, EveryKeyOfACompleteDeck_isListed)
{
  std::set<std::string> const listed = schemaPaths();
  std::set<std::string> used;
  collectPaths(completeDeck(deckSchema(), parseDeck(exampleDeck(), "deck.yaml"), "deck.yaml"), "", used);
  EXPECT_GT(used.size(), 60u);
  for (std::string const &path : used)
    EXPECT_TRUE(listed.count(path)) << path;
}

TEST(DeckSchema, EveryListedKey_isKnownToTheReader)
{
  // A map is no value of any key: the reader must complain about the value, or about where the key stands, but never
  // that it does not know the key.
  for (SchemaKey const &key : schemaKeys(deckSchema()))
  {
    std::string path = key.path;
    std::size_t const at = path.find("NAME");
    if (at != std::string::npos)
    {
      std::string const kind = path.substr(0, at - 1);
      path.replace(at, 4,
                   kind == "bodies"      ? "slider"
                   : kind == "materials" ? "block"
                   : kind == "probes"    ? "middle"
                                         : "glue");
    }
    try
    {
      readDeckText(exampleDeck(), "deck.yaml", {path + "={wrong: 1}"});
      ADD_FAILURE() << key.path << " took a map";
    }
    catch (DeckError const &error)
    {
      std::string const message = error.what();
      EXPECT_EQ(message.find("unknown key"), std::string::npos) << message;
      EXPECT_NE(message.find(path), std::string::npos) << message;
    }
  }
}

TEST(DeckSchema, Default_passesItsOwnValidator)
{
  ParameterList const complete = completeDeck(deckSchema(), parseDeck(exampleDeck(), "deck.yaml"), "deck.yaml");
  EXPECT_EQ(deckAsYaml(completeDeck(deckSchema(), complete, "again")), deckAsYaml(complete));
}

TEST(DeckSchema, Print_showsPathTypeUnitDefaultAndWords)
{
  std::ostringstream out;
  printSchema(out);
  std::string const text = out.str();
  EXPECT_NE(text.find("bodies/NAME/radius   (where shape = disc)\n    type: number > 0 [m]\n    default: required"),
            std::string::npos);
  EXPECT_NE(text.find("kinematics\n    type: xfem | single | lagrangian\n    default: xfem"), std::string::npos);
  for (std::string const &path : schemaPaths())
    EXPECT_NE(text.find("\n" + path), std::string::npos) << path;
  EXPECT_NE(text.find("geometry\n    type: planar | axisymmetric\n    default: planar"), std::string::npos);
}

TEST(DeckSchema, NearestWord_findsSlipsOnly)
{
  std::vector<std::string> const words = {"density", "sound_speed", "slope"};
  EXPECT_EQ(nearestWord("densty", words), "density");
  EXPECT_EQ(nearestWord("soundspeed", words), "sound_speed");
  EXPECT_EQ(nearestWord("colour", words), "");
}

TEST(DeckSchema, NumberText_readsBackToTheSameBitsAndStaysADouble)
{
  for (double const value : {1.0, -0.0, 0.1, 1.0 / 3.0, 1e20, 6.02e23, -2.5e-300, 123456789.0})
  {
    std::string const text = numberText(value);
    EXPECT_EQ(std::stod(text), value);
    ParameterList const list = parseDeck("harmos:\n  v: " + text, "text");
    ASSERT_TRUE(list.isType<double>("v")) << text;
    EXPECT_EQ(list.get<double>("v"), value) << text;
  }
}
