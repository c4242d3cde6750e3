// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_History.hpp>

#include <stdexcept>

namespace Harmos
{

std::string historyHeader(std::vector<std::string> const &material_names, bool polygon_overlap)
{
  std::string header =
      "cycle,time,dt,mass,momentum_x,momentum_y,angular_momentum,kinetic_energy,internal_energy,external_work,"
      "contact_loss,remap_loss,energy_error,overlap_volume,void_volume,external_impulse_x,external_impulse_y,"
      "outflow_mass,outflow_momentum_x,outflow_momentum_y,outflow_energy,pairs,pairs_mixed,multipliers,iterations,"
      "residual";
  for (auto const &name : material_names)
    for (char const *column : {"mass", "volume", "momentum_x", "momentum_y", "kinetic_energy", "internal_energy",
                               "x_min", "x_max", "y_min", "y_max", "plastic_strain_max"})
      header += ',' + name + '.' + column;
  for (auto const &name : material_names)
    header += ',' + name + ".failed_mass";
  header += ",returned_heat";
  if (polygon_overlap)
    header += ",polygon_overlap,polygon_overlap_largest,polygon_overlap_x,polygon_overlap_y,remapped_overlap,"
              "remapped_overlap_largest";
  return header;
}

History::History(std::string const &path, std::vector<std::string> const &material_names, bool writes, CsvStart start,
                 bool polygon_overlap)
    : num_materials_(material_names.size()), polygon_overlap_(polygon_overlap)
{
  if (writes)
    file_ = std::make_unique<CsvFile>(path, historyHeader(material_names, polygon_overlap), start);
}

void History::write(HistoryRow const &row)
{
  if (!file_)
    return;
  if (row.material.size() != num_materials_)
    throw std::invalid_argument("history row of cycle " + std::to_string(row.cycle) + " has " +
                                std::to_string(row.material.size()) + " materials, its header " +
                                std::to_string(num_materials_));
  std::string line = std::to_string(row.cycle);
  for (double value : {row.time,
                       row.dt,
                       row.mass,
                       row.momentum_x,
                       row.momentum_y,
                       row.angular_momentum,
                       row.kinetic_energy,
                       row.internal_energy,
                       row.external_work,
                       row.contact_loss,
                       row.remap_loss,
                       row.energy_error,
                       row.overlap_volume,
                       row.void_volume,
                       row.external_impulse_x,
                       row.external_impulse_y,
                       row.outflow_mass,
                       row.outflow_momentum_x,
                       row.outflow_momentum_y,
                       row.outflow_energy})
    appendValue(line, value);
  for (long long count : {row.pairs, row.pairs_mixed, row.multipliers, row.iterations})
    appendValue(line, count);
  appendValue(line, row.residual);
  for (auto const &m : row.material)
    for (double value : {m.mass, m.volume, m.momentum_x, m.momentum_y, m.kinetic_energy, m.internal_energy, m.x_min,
                         m.x_max, m.y_min, m.y_max, m.plastic_strain_max})
      appendValue(line, value);
  for (auto const &m : row.material)
    appendValue(line, m.failed_mass);
  appendValue(line, row.returned_heat);
  if (polygon_overlap_)
    for (double value : {row.polygon_overlap, row.polygon_overlap_largest, row.polygon_overlap_place[0],
                         row.polygon_overlap_place[1], row.remapped_overlap, row.remapped_overlap_largest})
      appendValue(line, value);
  file_->append(line + '\n');
}

} // namespace Harmos
