// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_AtomicFile.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace Harmos
{

namespace
{
[[noreturn]] void fail(std::string const &what, std::string const &path)
{
  throw std::runtime_error(what + " '" + path + "': " + std::strerror(errno));
}
} // namespace

void publishFile(std::string const &temporary, std::string const &path)
{
  int const file = ::open(temporary.c_str(), O_RDONLY);
  if (file < 0)
    fail("cannot open", temporary);
  int const flushed = ::fsync(file);
  ::close(file);
  if (flushed != 0)
    fail("cannot flush", temporary);
  if (std::rename(temporary.c_str(), path.c_str()) != 0)
    fail("cannot rename " + temporary + " to", path);
}

void writeFileAtomically(std::string const &path, std::string const &content)
{
  std::string const temporary = path + ".tmp";
  {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    if (!file)
      fail("cannot create", temporary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file)
      fail("cannot write", temporary);
  }
  publishFile(temporary, path);
}

std::string readWholeFile(std::string const &path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
    fail("cannot open", path);
  std::ostringstream content;
  content << file.rdbuf();
  return content.str();
}

} // namespace Harmos
