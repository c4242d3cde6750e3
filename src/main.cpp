// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Interrupt.hpp"
#include "Harmos_RemapStudy.hpp"
#include "Harmos_Simulation.hpp"
#include "Harmos_Version.hpp"

#include <Harmos_Checkpoint.hpp>
#include <Harmos_DeckReader.hpp>
#include <Harmos_DeckSchema.hpp>

#include <Tpetra_Core.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace
{

char const usage[] =
    "usage: harmos run DECK.yaml [--output DIR] [--set 'path/to/key=value' ...] [--restart FILE|DIR] [--force]\n"
    "       harmos remap DECK.yaml [--output DIR] [--set 'key=value' ...] [--force]\n"
    "       harmos check DECK.yaml [--set 'path/to/key=value' ...]\n"
    "       harmos schema [remap]\n"
    "       harmos --version | --help\n"
    "\n"
    "run      runs a deck; results go to DIR (default: results-DECK). SI units.\n"
    "check    reads and checks a deck and places its bodies; runs and writes nothing\n"
    "remap    remaps a field over moving meshes, without mechanics; errors and times go to DIR\n"
    "schema   lists every key of a deck: type, default, unit, allowed values; of a deck of `remap`\n"
    "--set    overrides a key of the deck; may be given many times\n"
    "--force  overwrites results that are in DIR\n"
    "--restart continues from a checkpoint, or from the newest in DIR, to the same history\n"
    "\n"
    "exit status: 0 done, 2 bad input, 3 failed run, 4 interrupted (a checkpoint was written)\n";

struct Arguments
{
  std::string command;
  std::string deck;
  std::vector<std::string> overrides;
  std::vector<std::string> options; // those given
  Harmos::RunOptions run;
};

/// The checkpoint that --restart names: a file, or the newest in a folder.
std::string checkpointOf(std::string const &path)
{
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw Harmos::DeckError("--restart " + path + ": there is no such file or folder");
  if (!std::filesystem::is_directory(path))
    return path;
  std::string const newest = Harmos::newestCheckpoint(path);
  if (newest.empty())
    throw Harmos::DeckError("--restart " + path + ": no checkpoint_NNNNNNNNN.h5 in this folder");
  return newest;
}

/// An option that a command would ignore is refused.
void checkOptions(Arguments const &arguments)
{
  std::vector<std::string> allowed;
  if (arguments.command == "run")
    allowed = {"--output", "--set", "--restart", "--force"};
  else if (arguments.command == "remap")
    allowed = {"--output", "--set", "--force"};
  else if (arguments.command == "check")
    allowed = {"--set"};
  else if (arguments.command != "schema")
    return; // no command at all
  for (std::string const &option : arguments.options)
    if (std::find(allowed.begin(), allowed.end(), option) == allowed.end())
      throw Harmos::DeckError("'harmos " + arguments.command + "' takes no " + option +
                              "; allowed: " + (allowed.empty() ? "no option" : Harmos::joined(allowed)));
}

Arguments parseArguments(int argc, char **argv)
{
  Arguments arguments;
  auto const value = [&](int &i)
  {
    if (i + 1 >= argc)
      throw Harmos::DeckError(std::string(argv[i]) + " needs a value");
    std::string const text = argv[++i];
    if (text.empty())
      throw Harmos::DeckError(std::string(argv[i - 1]) + " needs a value; expected: not an empty one");
    return text;
  };
  for (int i = 1; i < argc; ++i)
  {
    std::string const word = argv[i];
    if (word == "--output" || word == "--set" || word == "--restart" || word == "--force")
    {
      bool const again = std::find(arguments.options.begin(), arguments.options.end(), word) != arguments.options.end();
      if (again && (word == "--output" || word == "--restart"))
        throw Harmos::DeckError(word + " is given twice; expected: once");
      arguments.options.push_back(word);
    }
    if (word == "--output")
      arguments.run.directory = value(i);
    else if (word == "--set")
      arguments.overrides.push_back(value(i));
    else if (word == "--restart")
      arguments.run.restart = value(i);
    else if (word == "--force")
      arguments.run.force = true;
    else if (word == "--version" || word == "--help" || word == "-h")
      arguments.command = word;
    else if (word.size() > 1 && word[0] == '-')
      throw Harmos::DeckError("unknown option '" + word +
                              "'; allowed: --output, --set, --restart, --force, --version, --help");
    else if (arguments.command.empty())
      arguments.command = word;
    else if (arguments.deck.empty())
      arguments.deck = word;
    else
      throw Harmos::DeckError("one deck at a time: '" + word + "' is too many");
  }
  checkOptions(arguments);
  if (!arguments.run.restart.empty())
    arguments.run.restart = checkpointOf(arguments.run.restart);
  bool const takes_deck = arguments.command == "run" || arguments.command == "check" || arguments.command == "remap";
  if (takes_deck && arguments.deck.empty())
    throw Harmos::DeckError("'harmos " + arguments.command + "' needs a deck");
  if (arguments.run.directory.empty())
    arguments.run.directory = "results-" + std::filesystem::path(arguments.deck).stem().string();
  return arguments;
}

int dispatch(Arguments const &arguments, Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  bool const speaks = comm->getRank() == 0;
  if (arguments.command == "--version")
  {
    if (speaks)
      for (auto const &item : Harmos::versions())
        std::printf("%s %s\n", item.first.c_str(), item.second.c_str());
    return Harmos::Completed;
  }
  if (arguments.command == "--help" || arguments.command == "-h")
  {
    if (speaks)
      std::fputs(usage, stdout);
    return Harmos::Completed;
  }
  if (arguments.command == "schema")
  {
    if (!arguments.deck.empty() && arguments.deck != "remap")
      throw Harmos::DeckError("no schema '" + arguments.deck + "'; allowed: none, remap");
    if (speaks && arguments.deck.empty())
      Harmos::printSchema(std::cout);
    else if (speaks)
      Harmos::printSchema(std::cout, Harmos::remapSchema());
    return Harmos::Completed;
  }
  if (arguments.command == "remap")
    return Harmos::studyRemap(Harmos::readRemapDeck(arguments.deck, arguments.overrides, *comm), arguments.run, comm);
  if (arguments.command != "run" && arguments.command != "check")
  {
    if (speaks)
    {
      if (!arguments.command.empty())
        std::fprintf(stderr, "harmos: unknown command '%s'; allowed: run, check, remap, schema\n",
                     arguments.command.c_str());
      std::fputs(usage, stderr);
    }
    return Harmos::BadInput;
  }
  Harmos::Deck const deck = Harmos::readDeck(arguments.deck, arguments.overrides, *comm);
  if (arguments.command == "check")
  {
    Harmos::checkScene(deck, comm);
    if (speaks)
      std::printf("%s: good (%zu bodies, %d x %d cells)\n", arguments.deck.c_str(), deck.bodies.size(), deck.x.cells,
                  deck.y.cells);
    return Harmos::Completed;
  }
  Harmos::catchInterrupts();
  return Harmos::simulate(deck, arguments.run, comm);
}

} // namespace

int main(int argc, char **argv)
{
  // Kokkos would answer --help with its own.
  int none = 1;
  bool const asks =
      std::any_of(argv, argv + argc, [](std::string const &word) { return word == "--help" || word == "-h"; });
  Tpetra::ScopeGuard scope(asks ? &none : &argc, &argv);
  auto const comm = Tpetra::getDefaultComm();
  try
  {
    return dispatch(parseArguments(argc, argv), comm);
  }
  catch (Harmos::DeckError const &error)
  {
    // Every rank throws alike; one speaks.
    if (comm->getRank() == 0)
      std::fprintf(stderr, "harmos: %s\n", error.what());
    return Harmos::BadInput;
  }
  catch (std::exception const &error)
  {
    if (comm->getSize() == 1)
    {
      std::fprintf(stderr, "harmos: %s\n", error.what());
      return Harmos::FailedRun;
    }
    // The other ranks may wait for this one: all must end. Where all met the same, rank 0 speaks first and ends them.
    if (comm->getRank() > 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    std::fprintf(stderr, "harmos: rank %d: %s\n", comm->getRank(), error.what());
    MPI_Abort(MPI_COMM_WORLD, Harmos::FailedRun);
    return Harmos::FailedRun;
  }
}
