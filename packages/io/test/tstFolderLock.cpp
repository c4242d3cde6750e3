// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_FolderLock.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace Harmos;

namespace
{

std::string emptyFolder(std::string const &name)
{
  std::filesystem::path const folder = std::filesystem::temp_directory_path() / ("harmos_tstFolderLock_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  return folder.string();
}

} // namespace

TEST(FolderLock, whoComesSecond_isToldWhoHasTheFolder)
{
  std::string const folder = emptyFolder("taken");
  {
    FolderLock const first(folder);
    EXPECT_EQ(first.holder(), "");
    for (int i = 0; i < 2; ++i)
      EXPECT_EQ(FolderLock(folder).holder().rfind("process ", 0), 0u);
  }
  EXPECT_EQ(FolderLock(folder).holder(), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove(folder);
}

TEST(FolderLock, fileOfAProcessThatWasKilled_locksNothing)
{
  std::string const folder = emptyFolder("left");
  std::ofstream(folder + "/.lock") << "process 1 on moon\n";
  EXPECT_EQ(FolderLock(folder).holder(), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove(folder);
}

TEST(FolderLock, roomThatIsGiven_isFreeWhileTheLockStays)
{
  std::string const folder = emptyFolder("room");
  FolderLock const lock(folder);
  EXPECT_EQ(std::filesystem::file_size(folder + "/.lock"), 65536u);
  lock.giveRoom();
  EXPECT_EQ(std::filesystem::file_size(folder + "/.lock"), 0u);
  EXPECT_NE(FolderLock(folder).holder(), "");
  std::filesystem::remove_all(folder);
}

TEST(FolderLock, folderThatIsNot_hasNobody)
{
  FolderLock const lock("folder/that/is/not");
  EXPECT_EQ(lock.holder(), "");
  lock.giveRoom();
}
