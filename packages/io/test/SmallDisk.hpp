// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_SMALL_DISK_HPP
#define HARMOS_TEST_SMALL_DISK_HPP

#include <sys/resource.h>

#include <csignal>
#include <stdexcept>
#include <string>

namespace Harmos
{

/// The message of the error that a call throws while this process's files may not grow beyond a size, as on a full disk
/// (errno is EFBIG); empty where it throws none.
template <class Call>
std::string errorOnSmallDisk(std::size_t bytes, Call const &call)
{
  auto const handler = std::signal(SIGXFSZ, SIG_IGN); // the write fails instead
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit const small{static_cast<rlim_t>(bytes), before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try
  {
    call();
  }
  catch (std::runtime_error const &error)
  {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  return message;
}

} // namespace Harmos

#endif
