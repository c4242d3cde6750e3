// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_FolderLock.hpp>

#include <detail/Harmos_AtomicFile.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace Harmos
{

namespace
{

constexpr std::size_t room = 1 << 16;

/// To be locked, a file on NFS must be open for writing; one of somebody else's may not be.
int openFile(std::string const &path)
{
  int const file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  return file >= 0 || errno != EACCES ? file : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

int lock(int file)
{
  int failed;
  do // a signal to the run may come
    failed = ::flock(file, LOCK_EX | LOCK_NB);
  while (failed != 0 && errno == EINTR);
  return failed;
}

/// Whether an open file still has its name: who gave the lock back has taken that away.
bool isNamed(int file, std::string const &path)
{
  struct stat opened, named;
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

/// What the holder wrote of itself, if it has yet.
std::string firstLine(int file)
{
  char text[200];
  ssize_t const size = ::pread(file, text, sizeof text, 0);
  std::string const line(text, size > 0 ? static_cast<std::size_t>(size) : 0);
  return line.empty() ? "a process" : line.substr(0, line.find('\n'));
}

std::string ownLine()
{
  char host[200] = "";
  ::gethostname(host, sizeof host - 1);
  return "process " + std::to_string(::getpid()) + " on " + host + '\n';
}

} // namespace

bool FolderLock::tryToLock()
{
  file_ = openFile(path_);
  if (file_ < 0)
    return true;
  if (lock(file_) == 0)
  {
    if (isNamed(file_, path_))
      return true;
    ::close(file_);
    file_ = -1;
    return false;
  }
  if (errno != EWOULDBLOCK)
    ::unlink(path_.c_str()); // no locks here
  else
    holder_ = firstLine(file_);
  ::close(file_);
  file_ = -1;
  return true;
}

FolderLock::FolderLock(std::string const &folder) : path_(folder + "/.lock")
{
  constexpr int most_tries = 100;
  for (int i = 0; i < most_tries && !tryToLock(); ++i)
  {
  }
  if (file_ < 0 || ::ftruncate(file_, 0) != 0)
    return;
  std::string text = ownLine();
  text.resize(room, ' ');
  writeAll(file_, text.data(), text.size()); // a full disk has room for a part
}

FolderLock::~FolderLock()
{
  if (file_ < 0)
    return;
  ::unlink(path_.c_str());
  ::close(file_);
}

void FolderLock::giveRoom() const
{
  if (file_ >= 0 && ::ftruncate(file_, 0) != 0)
    return; // then there is none to give
}

} // namespace Harmos
