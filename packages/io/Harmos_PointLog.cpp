// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_PointLog.hpp>

namespace Harmos
{

char const *const PointLog::probe_header =
    "cycle,time,name,material,density,pressure,velocity_x,velocity_y,internal_energy,plastic_strain,von_mises,"
    "damage";
char const *const PointLog::tracer_header =
    "cycle,time,name,x,y,velocity_x,velocity_y,material,density,pressure,internal_energy,plastic_strain,von_mises,"
    "damage";

PointLog::PointLog(std::string const &path, std::string const &header, bool writes, CsvStart start)
{
  if (writes)
    file_ = std::make_unique<CsvFile>(path, header, start);
}

void PointLog::write(long long cycle, double time, std::vector<PointEntry> const &entries)
{
  if (!file_ || entries.empty())
    return;
  std::string lines;
  for (PointEntry const &entry : entries)
  {
    lines += std::to_string(cycle);
    appendValue(lines, time);
    lines += ',' + entry.name;
    for (double value : entry.place)
      appendValue(lines, value);
    lines += ',' + entry.material;
    for (double value : entry.state)
      appendValue(lines, value);
    lines += '\n';
  }
  file_->append(lines);
}

} // namespace Harmos
