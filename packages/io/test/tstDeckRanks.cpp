// SPDX-License-Identifier: BSD-3-Clause
#include "DeckExample.hpp"

#include <Harmos_DeckReader.hpp>

#include <Tpetra_Core.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

using namespace Harmos;

TEST(DeckRanks, FileOfRankZero_isReadByAll)
{
  auto const comm = Tpetra::getDefaultComm();
  std::string const file = "tstDeckRanks_" + std::to_string(comm->getSize()) + ".yaml";
  if (comm->getRank() == 0)
    std::ofstream(file) << exampleDeck();
  Deck const deck = readDeck(file, {"title=by all"}, *comm);
  EXPECT_EQ(deck.title, "by all");
  EXPECT_EQ(deck.yaml, readDeckText(exampleDeck(), file, {"title=by all"}).yaml);
  if (comm->getRank() == 0)
    std::remove(file.c_str());
}

TEST(DeckRanks, MissingAndEmptyFiles_areErrorsOnAllRanks)
{
  auto const comm = Tpetra::getDefaultComm();
  EXPECT_THROW(readDeck("no such deck.yaml", {}, *comm), DeckError);
  std::string const file = "tstDeckRanks_empty_" + std::to_string(comm->getSize()) + ".yaml";
  if (comm->getRank() == 0)
    std::ofstream(file).flush();
  EXPECT_THROW(readDeck(file, {}, *comm), DeckError);
  comm->barrier();
  if (comm->getRank() == 0)
    std::remove(file.c_str());
}
