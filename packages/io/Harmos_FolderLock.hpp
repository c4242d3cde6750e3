// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FOLDER_LOCK_HPP
#define HARMOS_FOLDER_LOCK_HPP

#include <string>

namespace Harmos
{

/// The right to write results into a folder, which one run has at a time: a lock on the folder's file `.lock`. The
/// system takes it back when the process ends, however it does; a file that a killed run has left locks nothing.
class FolderLock
{
public:
  /// Take it, or find out who has it. Where files cannot be locked, or none can be made, it has nobody.
  explicit FolderLock(std::string const &folder);

  /// Gives it back and takes the file away.
  ~FolderLock();
  FolderLock(FolderLock const &) = delete;
  FolderLock &operator=(FolderLock const &) = delete;

  /// Who else has it, "process 1234 on HOST"; empty: nobody.
  std::string const &holder() const { return holder_; }

  /// The file is some 64 kB long: a disk that is full gets them back for what has to be written yet.
  void giveRoom() const;

private:
  bool tryToLock();

  std::string path_;
  int file_ = -1;
  std::string holder_;
};

} // namespace Harmos

#endif
