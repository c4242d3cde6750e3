// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ATOMIC_FILE_HPP
#define HARMOS_ATOMIC_FILE_HPP

#include <string>

namespace Harmos
{

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

/// Flush a file that is closed already to the device and give it its final name.
/// \throws std::runtime_error with both names and the system's reason.
void publishFile(std::string const &temporary, std::string const &path);

/// The whole content of a text file. \throws std::runtime_error with the file's name and the system's reason.
std::string readWholeFile(std::string const &path);

} // namespace Harmos

#endif
