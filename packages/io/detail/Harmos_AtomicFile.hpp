// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ATOMIC_FILE_HPP
#define HARMOS_ATOMIC_FILE_HPP

#include <string>

namespace Harmos
{

/// The file `path`.tmp that becomes `path` when it is complete. An exception that leaves its scope takes it away, on
/// any of the ranks that write it.
class TemporaryFile
{
public:
  explicit TemporaryFile(std::string const &path);
  ~TemporaryFile();
  TemporaryFile(TemporaryFile const &) = delete;
  TemporaryFile &operator=(TemporaryFile const &) = delete;

  std::string const &name() const { return name_; }

  /// Flush the file, closed already, to the device and give it its final name. By one rank, when all have written.
  /// \throws std::runtime_error with the files' names and the system's reason.
  void publish() const;

private:
  std::string path_, name_;
  int exceptions_; // under way when it was made
};

/// Write a whole file so that a reader sees the old content or the new, never a part: to `path`.tmp, flushed to the
/// device, then renamed.
///
/// \throws std::runtime_error with the file's name and the system's reason.
void writeFileAtomically(std::string const &path, std::string const &content);

/// All bytes to an open file, in one write(2) where the system takes them so. \return False, with errno, where it
/// refuses.
bool writeAll(int file, char const *data, std::size_t size);

/// A file of these bytes, made or overwritten. \throws std::runtime_error with the file's name and the system's reason.
void writeFile(std::string const &path, char const *data, std::size_t size);

/// The whole content of a text file. \throws std::runtime_error with the file's name and the system's reason.
std::string readWholeFile(std::string const &path);

} // namespace Harmos

#endif
