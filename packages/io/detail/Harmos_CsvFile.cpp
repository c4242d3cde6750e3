// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_AtomicFile.hpp>
#include <detail/Harmos_CsvFile.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace Harmos
{

namespace
{

/// The header and the whole rows of `content` whose cycle does not exceed the last one; a half row at the end (of a
/// machine that crashed) is dropped.
std::string rowsUpTo(std::string const &path, std::string const &content, std::string const &header,
                     long long last_cycle)
{
  std::string kept;
  bool first = true;
  for (std::size_t begin = 0, end; (end = content.find('\n', begin)) != std::string::npos; begin = end + 1)
  {
    std::string const line = content.substr(begin, end - begin);
    if (first)
    {
      if (line != header)
        throw std::runtime_error("cannot continue '" + path + "': its columns differ from this run's");
      first = false;
    }
    else if (std::strtoll(line.c_str(), nullptr, 10) > last_cycle)
      continue;
    kept += line + '\n';
  }
  if (first)
    throw std::runtime_error("cannot continue '" + path + "': it has no header line");
  return kept;
}

} // namespace

CsvFile::CsvFile(std::string path, std::string const &header, CsvStart start) : path_(std::move(path))
{
  // A restart into another folder finds no table there: it begins one.
  bool const exists = ::access(path_.c_str(), F_OK) == 0;
  if (start.append && exists)
    writeFileAtomically(path_, rowsUpTo(path_, readWholeFile(path_), header, start.last_cycle));
  else
    writeFileAtomically(path_, header + '\n');
  file_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file_ < 0)
    throw std::runtime_error("cannot open '" + path_ + "' for appending: " + std::strerror(errno));
}

CsvFile::~CsvFile()
{
  if (file_ >= 0)
    ::close(file_);
}

void CsvFile::append(std::string const &lines)
{
  off_t const before = ::lseek(file_, 0, SEEK_END);
  if (writeAll(file_, lines.data(), lines.size()))
    return;
  std::string const reason = std::strerror(errno);
  bool const whole = before >= 0 && ::ftruncate(file_, before) == 0;
  throw std::runtime_error("cannot append to '" + path_ + "': " + reason +
                           (whole ? "" : "; its last line may be cut short"));
}

void appendValue(std::string &line, double value)
{
  char text[40] = ",";
  char *const end = std::to_chars(text + 1, text + sizeof(text), value, std::chars_format::general, 17).ptr;
  line.append(text, end);
}

void appendValue(std::string &line, long long value)
{
  line += ',' + std::to_string(value);
}

} // namespace Harmos
