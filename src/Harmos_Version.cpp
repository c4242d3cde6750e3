// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Version.hpp"

#include <Harmos_Kokkos.hpp>

#include <Tpetra_Version.hpp>
#include <hdf5.h>
#include <mpi.h>

namespace Harmos
{

std::string version()
{
  return HARMOS_VERSION;
}

std::vector<std::pair<std::string, std::string>> versions()
{
  auto const dotted = [](int major, int minor, int patch)
  { return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch); };
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  char mpi[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(mpi, &length);
  std::string mpi_name(mpi, length);
  mpi_name = mpi_name.substr(0, mpi_name.find(','));
  return {{"harmos", version()},
          {"kokkos", dotted(KOKKOS_VERSION / 10000, KOKKOS_VERSION / 100 % 100, KOKKOS_VERSION % 100) + " " +
                         ExecutionSpace::name()},
          {"tpetra", Tpetra::version()},
          {"hdf5", dotted(static_cast<int>(major), static_cast<int>(minor), static_cast<int>(release))},
          {"mpi", mpi_name},
          {"compiler", __VERSION__}};
}

} // namespace Harmos
