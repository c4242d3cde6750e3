// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_POINT_LOG_HPP
#define HARMOS_POINT_LOG_HPP

#include <detail/Harmos_CsvFile.hpp>

#include <memory>
#include <string>
#include <vector>

namespace Harmos
{

/// What a named point meets; the values in the order of the table's columns.
struct PointEntry
{
  std::string name;
  std::vector<double> place; // tracers: x, y, velocity_x, velocity_y; probes: nothing
  std::string material;      // "void", "outside" (of the mesh), or a name
  std::vector<double> state; // probes: density, pressure, velocity_x, velocity_y, internal_energy, plastic_strain,
                             // von_mises, damage; tracers: the same without the velocity
};

/// probes.csv and tracers.csv, long form: a line for each point: cycle,time,name,...
class PointLog
{
public:
  static char const *const probe_header;
  static char const *const tracer_header;

  /// \param writes True on the one rank that writes. \throws std::runtime_error as History.
  PointLog(std::string const &path, std::string const &header, bool writes, CsvStart start);

  /// All points of one cycle, appended in one piece.
  void write(long long cycle, double time, std::vector<PointEntry> const &entries);

private:
  std::unique_ptr<CsvFile> file_;
};

} // namespace Harmos

#endif
