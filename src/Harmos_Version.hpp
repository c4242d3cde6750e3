// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_VERSION_HPP
#define HARMOS_VERSION_HPP

#include <string>
#include <utility>
#include <vector>

namespace Harmos
{

/// The program's version, "0.1.0".
std::string version();

/// The program, Kokkos with its back end, Trilinos, HDF5, MPI, the compiler: name and version.
std::vector<std::pair<std::string, std::string>> versions();

} // namespace Harmos

#endif
