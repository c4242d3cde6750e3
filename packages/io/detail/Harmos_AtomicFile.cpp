// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_AtomicFile.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
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

TemporaryFile::TemporaryFile(std::string const &path)
    : path_(path), name_(path + ".tmp"), exceptions_(std::uncaught_exceptions())
{
}

TemporaryFile::~TemporaryFile()
{
  if (std::uncaught_exceptions() > exceptions_)
    ::unlink(name_.c_str());
}

void TemporaryFile::publish() const
{
  int const file = ::open(name_.c_str(), O_RDONLY);
  if (file < 0)
    fail("cannot open", name_);
  int const flushed = ::fsync(file);
  ::close(file);
  if (flushed != 0)
    fail("cannot flush", name_);
  if (std::rename(name_.c_str(), path_.c_str()) != 0)
    fail("cannot rename " + name_ + " to", path_);
}

bool writeAll(int file, char const *data, std::size_t size)
{
  while (size > 0)
  {
    ssize_t const written = ::write(file, data, size);
    if (written < 0 && errno != EINTR)
      return false;
    std::size_t const done = written > 0 ? static_cast<std::size_t>(written) : 0;
    data += done;
    size -= done;
  }
  return true;
}

void writeFile(std::string const &path, char const *data, std::size_t size)
{
  int const file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0)
    fail("cannot create", path);
  bool const good = writeAll(file, data, size);
  int const reason = errno;
  if (::close(file) != 0 && good)
    fail("cannot close", path);
  errno = reason;
  if (!good)
    fail("cannot write", path);
}

void writeFileAtomically(std::string const &path, std::string const &content)
{
  TemporaryFile const temporary(path);
  writeFile(temporary.name(), content.data(), content.size());
  temporary.publish();
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
