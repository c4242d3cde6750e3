// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONTACT_LOG_HPP
#define HARMOS_CONTACT_LOG_HPP

#include <detail/Harmos_CsvFile.hpp>

#include <memory>
#include <string>
#include <vector>

namespace Harmos
{

/// What material (or wall) b does to a in one cycle, per unit depth.
struct ContactEntry
{
  std::string a, b;     // names
  double force_x = 0.0; // force on a by b, the impulse over the time for which forces act in the cycle [N/m]
  double force_y = 0.0;
  double normal_impulse = 0.0; // sum of the normal multipliers of the cycle, >= 0 [N s/m]
  double area = 0.0;           // length of the loaded segments [m]
  double deviation = 0.0;      // of the segments' normal tractions from their mean, root mean square by length [Pa]
};

/// contact.csv, long form: a line for each pair of materials that touched: cycle,time,a,b,force_x,...
class ContactLog
{
public:
  /// Arguments as History's.
  ContactLog(std::string const &path, bool writes, CsvStart start = CsvStart::fresh());

  /// All entries of one cycle, appended in one piece.
  void write(long long cycle, double time, std::vector<ContactEntry> const &entries);

private:
  std::unique_ptr<CsvFile> file_;
};

} // namespace Harmos

#endif
