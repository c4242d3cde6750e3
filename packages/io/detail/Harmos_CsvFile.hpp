// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CSV_FILE_HPP
#define HARMOS_CSV_FILE_HPP

#include <string>

namespace Harmos
{

/// How a table begins: anew, or as the continuation of the rows up to a restart's cycle.
struct CsvStart
{
  bool append = false;
  long long last_cycle = -1; // append: rows whose first column exceeds this are cut off

  static CsvStart fresh() { return {}; }
  static CsvStart after(long long cycle) { return {true, cycle}; }
};

/// A comma-separated table that only ever grows by whole lines: each append is one write(2) to a file opened for
/// appending, so that a run that is killed leaves no half row; what a full disk takes of a row is taken back. The first
/// column is the cycle.
class CsvFile
{
public:
  /// \param header First line, without the line end.
  /// \throws std::runtime_error when the file cannot be made, or when a continued table has another header.
  CsvFile(std::string path, std::string const &header, CsvStart start);
  ~CsvFile();
  CsvFile(CsvFile const &) = delete;
  CsvFile &operator=(CsvFile const &) = delete;

  /// Append whole lines (each ended by a line end); they have reached the system when this returns.
  /// \throws std::runtime_error with the file's name and the system's reason.
  void append(std::string const &lines);

private:
  std::string path_;
  int file_ = -1;
};

/// Append ",value" with the 17 digits that give the same bits when read back.
void appendValue(std::string &line, double value);
void appendValue(std::string &line, long long value);

} // namespace Harmos

#endif
