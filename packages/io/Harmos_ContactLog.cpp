// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactLog.hpp>

namespace Harmos
{

ContactLog::ContactLog(std::string const &path, bool writes, CsvStart start)
{
  if (writes)
    file_ = std::make_unique<CsvFile>(path, "cycle,time,a,b,force_x,force_y,normal_impulse,area,deviation", start);
}

void ContactLog::write(long long cycle, double time, std::vector<ContactEntry> const &entries)
{
  if (!file_ || entries.empty())
    return;
  std::string lines;
  for (auto const &entry : entries)
  {
    lines += std::to_string(cycle);
    appendValue(lines, time);
    lines += ',' + entry.a + ',' + entry.b;
    for (double value : {entry.force_x, entry.force_y, entry.normal_impulse, entry.area, entry.deviation})
      appendValue(lines, value);
    lines += '\n';
  }
  file_->append(lines);
}

} // namespace Harmos
