// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_FOLDER_HPP
#define HARMOS_TEST_FOLDER_HPP

#include <mpi.h>

#include <filesystem>
#include <string>

namespace Harmos
{

inline int rankOf(MPI_Comm comm = MPI_COMM_WORLD)
{
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

/// Its own for each number of ranks.
inline std::string folderOf(std::string const &name)
{
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return name + '_' + std::to_string(size);
}

/// The same, empty.
inline std::string freshFolder(std::string const &name)
{
  std::string const folder = folderOf(name);
  if (rankOf() == 0)
  {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  return folder;
}

} // namespace Harmos

#endif
