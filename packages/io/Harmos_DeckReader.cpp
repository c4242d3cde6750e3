// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckIdle.hpp>
#include <Harmos_DeckReader.hpp>
#include <Harmos_DeckSchema.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_YamlParameterListCoreHelpers.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

namespace Harmos
{

namespace
{

using Teuchos::ParameterList;

char const *const root_name = "harmos";

/// The text of a file. \throws DeckError
using TextReader = std::function<std::string(std::string const &)>;

/// Teuchos' parser refuses other than ASCII even in comments, the mark that begins some UTF-8 files, and a last line
/// without its end. Outside of comments such bytes are refused here: its message would hold them as they are.
std::string forParser(std::string const &text, std::string const &file)
{
  std::string result = text.rfind("\xEF\xBB\xBF", 0) == 0 ? text.substr(3) : text;
  bool comment = false;
  int line = 1;
  for (char &c : result)
  {
    comment = c != '\n' && (comment || c == '#');
    line += c == '\n' ? 1 : 0;
    int const code = static_cast<unsigned char>(c);
    if ((code >= 32 && code <= 126) || c == '\n' || c == '\r' || c == '\t')
      continue;
    if (!comment)
      throw DeckError(file + ": line " + std::to_string(line) + " holds the byte " + std::to_string(code) +
                      "; expected: ASCII text, but in comments");
    c = '?';
  }
  if (result.empty() || result.back() != '\n')
    result += '\n';
  return result;
}

/// The lines of a Teuchos message that say what is wrong, as one line.
std::string oneLine(std::string const &message)
{
  std::istringstream lines(message);
  std::string line, result;
  while (std::getline(lines, line))
  {
    std::size_t const first = line.find_first_not_of(" \t");
    bool const noise = first == std::string::npos || line[first] == '^' || line.find("Throw number") == 0 ||
                       line.find("Throw test") == 0 || line.find("Parser was in state") == 0 ||
                       line.find("Lexer text") == 0 || line.find(".cpp:") != std::string::npos || line[first] == '"';
    // Of the excerpt that Teuchos shows, the place is said already.
    bool const excerpt = first != std::string::npos && first > 0;
    if (noise || excerpt)
      continue;
    result += (result.empty() ? "" : "; ") + line.substr(first);
  }
  for (std::string const &drop : {std::string("error: "), std::string(" of parseYamlStream")})
    for (std::size_t at = result.find(drop); at != std::string::npos; at = result.find(drop))
      result.erase(at, drop.size());
  return result;
}

/// A flow map or array must end on its line (Teuchos' grammar): say so where a deck breaks it.
std::string openBracketHint(std::string const &text)
{
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number)
  {
    int depth = 0;
    for (char c : line.substr(0, line.find('#')))
      depth += c == '{' || c == '[' ? 1 : (c == '}' || c == ']' ? -1 : 0);
    if (depth != 0)
      return "; line " + std::to_string(number) + ": { } and [ ] must open and close on one line";
  }
  return "";
}

/// Teuchos' parser drops a scalar beside the outermost map without a word.
void refuseOutermostKeys(std::string const &text, std::string const &file)
{
  std::istringstream lines(text);
  std::string line, first;
  for (int number = 1; std::getline(lines, line); ++number)
  {
    std::size_t const colon = line.find(':');
    if (line.empty() || std::string(" \t\r#%").find(line[0]) != std::string::npos || line.rfind("---", 0) == 0 ||
        line.rfind("...", 0) == 0 || colon == std::string::npos)
      continue;
    if (!first.empty())
      throw DeckError(file + ": " + line.substr(0, colon) + ": line " + std::to_string(number) +
                      " stands beside the outermost key " + first + "; expected: below it, with an indent");
    first = line.substr(0, colon);
  }
}

ParameterList parseYaml(std::string const &text, std::string const &file)
{
  std::string const input = forParser(text, file);
  refuseOutermostKeys(input, file);
  if (input.find_first_not_of(" \t\r\n") == std::string::npos)
    throw DeckError(file + ": empty; expected: a map under the outermost key " + root_name);
  try
  {
    ParameterList list = *Teuchos::getParametersFromYamlString(input);
    return list;
  }
  catch (std::exception const &error)
  {
    std::string const message = error.what();
    std::string const hint = openBracketHint(input);
    if (message.find("multiple top-level") != std::string::npos ||
        (message.find("rhs.at(offset)") != std::string::npos && hint.empty()))
      throw DeckError(file + ": the deck must be one map under the outermost key " + root_name);
    throw DeckError(file + ": not readable as YAML: " + oneLine(message) + hint);
  }
}

void applyOverride(ParameterList &deck, std::string const &text)
{
  std::size_t const equals = text.find('=');
  std::string const prefix = "--set " + text;
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw DeckError(prefix + ": expected: path/to/key=value");
  if (text.find('#') != std::string::npos)
    throw DeckError(prefix + ": a # would begin a comment; expected: none");
  std::string const key = '/' + text.substr(0, equals) + '/';
  if (key.find("//") != std::string::npos)
    throw DeckError(prefix + ": a part of the path is empty; expected: path/to/key=value");
  ParameterList value = parseYaml(std::string(root_name) + ":\n  value: " + text.substr(equals + 1) + "\n", prefix);
  ParameterList *list = &deck;
  std::istringstream path(text.substr(0, equals));
  std::string name;
  std::getline(path, name, '/');
  for (std::string next; std::getline(path, next, '/'); name = next)
  {
    if (list->isParameter(name) && !list->isSublist(name))
      throw DeckError(prefix + ": " + name + " is no map");
    list = &list->sublist(name);
  }
  if (value.isSublist("value") && list->isSublist(name))
  {
    // Where it stood: bodies are placed, and joined, in the order of the deck.
    ParameterList &there = list->sublist(name);
    std::string const called = there.name();
    there = value.sublist("value");
    there.setName(called);
    return;
  }
  list->remove(name, false);
  if (value.isSublist("value"))
    list->set(name, value.sublist("value"));
  else
    list->setEntry(name, value.getEntry("value"));
}

/// A word as the deck may spell it, with hyphens.
std::string hyphened(std::string text)
{
  for (char &c : text)
    c = c == ' ' || c == '_' ? '-' : c;
  return text;
}

/// Whether a condition of the schema, "eos = stiffened, strength = plastic", holds in a list.
bool holds(std::string const &condition, ParameterList const &list)
{
  std::size_t at = 0;
  while (at < condition.size())
  {
    std::size_t const end = std::min(condition.find(", ", at), condition.size());
    std::string const part = condition.substr(at, end - at);
    std::size_t const equals = part.find(" = ");
    std::string const key = part.substr(0, equals);
    if (!list.isType<std::string>(key) || hyphened(list.get<std::string>(key)) != hyphened(part.substr(equals + 3)))
      return false;
    at = end + 2;
  }
  return true;
}

/// Whether some law has a material's key, but none that the list chooses.
bool belongsElsewhere(std::vector<SchemaKey> const &keys, std::string const &name, ParameterList const &list)
{
  bool known = false;
  for (SchemaKey const &key : keys)
    if (key.path == "materials/NAME/" + name)
    {
      known = true;
      if (holds(key.condition, list))
        return false;
    }
  return known;
}

/// Replace `from: FILE` in the deck's materials by the keys of that file. The deck's own keys win; where it chooses
/// another eos, strength or damage than the file, the file's keys for the old one are left out.
void includeMaterials(ParameterList &deck, std::string const &file, TextReader const &read)
{
  if (!deck.isSublist("materials"))
    return;
  ParameterList &materials = deck.sublist("materials");
  std::size_t const slash = file.find_last_of('/');
  std::string const folder = slash == std::string::npos ? "" : file.substr(0, slash + 1);
  std::vector<SchemaKey> keys;
  for (auto i = materials.begin(); i != materials.end(); ++i)
  {
    if (!i->second.isList() || !materials.sublist(i->first).isParameter("from"))
      continue;
    ParameterList &own = materials.sublist(i->first);
    std::string const where = file + ": " + keyPath("materials/" + i->first, "from");
    if (!own.isType<std::string>("from"))
      throw DeckError(where + ": expected: the name of a file");
    std::string const name = own.get<std::string>("from");
    std::string const path = name[0] == '/' ? name : folder + name;
    ParameterList merged;
    try
    {
      merged = parseYaml(read(path), path);
    }
    catch (DeckError const &error)
    {
      throw DeckError(where + ": " + error.what());
    }
    if (merged.name() != "material")
      throw DeckError(where + ": " + path + ": outermost key is " + merged.name() + "; expected: material");
    bool const chooses = own.isParameter("eos") || own.isParameter("strength") || own.isParameter("damage");
    merged.setParameters(own);
    merged.remove("from");
    if (keys.empty())
      keys = schemaKeys(deckSchema());
    std::vector<std::string> elsewhere;
    for (auto j = merged.begin(); chooses && j != merged.end(); ++j)
      if (!own.isParameter(j->first) && belongsElsewhere(keys, j->first, merged))
        elsewhere.push_back(j->first);
    for (std::string const &key : elsewhere)
      merged.remove(key);
    own = merged;
    own.setName(i->first);
  }
}

/// The text of a file, empty files too. \return Whether it could be read: a folder opens as a file does.
bool readText(std::string const &file, std::string &text)
{
  std::ifstream stream(file);
  std::ostringstream content;
  if (stream && stream.peek() != std::ifstream::traits_type::eof())
    content << stream.rdbuf();
  text = content.str();
  return stream.is_open() && !stream.bad() && content;
}

/// What keeps a file from being read.
std::string whyUnread(std::string const &file)
{
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    return file + ": cannot be read: there is no such file";
  if (std::filesystem::is_directory(file, ignored))
    return file + ": cannot be read: it is a folder";
  return file + ": cannot be read";
}

/// The text of a file that this rank alone reads.
std::string readWhole(std::string const &file)
{
  std::string text;
  if (!readText(file, text))
    throw DeckError(whyUnread(file));
  return text;
}

ParameterList parseWith(std::string const &text, std::string const &file, std::vector<std::string> const &overrides,
                        TextReader const &read)
{
  ParameterList deck = parseYaml(text, file);
  if (deck.name() != root_name)
    throw DeckError(file + ": outermost key is " + deck.name() + "; expected: " + root_name);
  for (std::string const &item : overrides)
    applyOverride(deck, item);
  includeMaterials(deck, file, read);
  return deck;
}

Deck deckOf(ParameterList const &input, std::string const &file)
{
  ParameterList const complete = completeDeck(deckSchema(), input, file);
  Deck deck = convertDeck(complete, file);
  deck.file = file;
  deck.idle_keys = idleKeys(complete, deck);
  return deck;
}

} // namespace

ParameterList parseDeck(std::string const &text, std::string const &file, std::vector<std::string> const &overrides)
{
  return parseWith(text, file, overrides, readWhole);
}

Deck readDeckText(std::string const &text, std::string const &file, std::vector<std::string> const &overrides)
{
  return deckOf(parseDeck(text, file, overrides), file);
}

std::string deckText(std::string const &file, Teuchos::Comm<int> const &comm)
{
  std::string text;
  int size = -1;
  if (comm.getRank() == 0 && readText(file, text))
    size = static_cast<int>(text.size());
  Teuchos::broadcast(comm, 0, &size);
  if (size < 0)
    throw DeckError(whyUnread(file));
  text.resize(static_cast<std::size_t>(size));
  if (size > 0)
    Teuchos::broadcast(comm, 0, size, text.data());
  return text;
}

Deck readDeck(std::string const &file, std::vector<std::string> const &overrides, Teuchos::Comm<int> const &comm)
{
  TextReader const read = [&comm](std::string const &path) { return deckText(path, comm); };
  return deckOf(parseWith(read(file), file, overrides, read), file);
}

} // namespace Harmos
