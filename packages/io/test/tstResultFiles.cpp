// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ResultFiles.hpp>

#include <gtest/gtest.h>

#include <fstream>

using namespace Harmos;

TEST(ResultFiles, NamesOfOutputs_areTakenForThemAndNoOthers)
{
  EXPECT_EQ(frameNumber("run/fields_000012.h5"), 12);
  EXPECT_EQ(frameNumber(frameStem(1234567) + ".vtu"), 1234567);
  EXPECT_EQ(frameNumber("fields_000012_3.vtu"), 12);
  EXPECT_EQ(frameNumber("fields_000012.pvtu"), 12);
  for (char const *other : {"fields_12.h5", "fields_2024_notes.txt", "fields_000012.txt", "fields_000012_3.h5",
                            "fields_20241121120000.h5", "fields_.h5", "myfields_000012.h5", "fields_000012x.h5"})
    EXPECT_EQ(frameNumber(other), -1) << other;
  EXPECT_EQ(checkpointCycle("run/" + checkpointFileName(120)), 120);
  EXPECT_EQ(checkpointCycle(checkpointFileName(12345678901)), 12345678901);
  for (char const *other :
       {"checkpoint_mine.h5", "checkpoint_12.h5", "checkpoint_000000120.csv", "checkpoint_99999999999999999999.h5"})
    EXPECT_EQ(checkpointCycle(other), -1) << other;
}

TEST(ResultFiles, OfAFolder_areItsTablesOutputsAndCheckpoints)
{
  std::filesystem::path const folder = std::filesystem::temp_directory_path() / "harmos_tstResultFiles";
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(resultFiles(folder).empty());
  std::filesystem::create_directory(folder);
  for (char const *name : {"notes.txt", "history.csv", "fields_000000.h5", "checkpoint_000000007.h5", "deck.yaml"})
    std::ofstream(folder / name) << "x";
  std::vector<std::string> names;
  for (auto const &file : resultFiles(folder))
    names.push_back(file.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"checkpoint_000000007.h5", "fields_000000.h5", "history.csv"}));
  std::filesystem::remove_all(folder);
}
