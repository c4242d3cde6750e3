// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_HISTORY_HPP
#define HARMOS_HISTORY_HPP

#include <detail/Harmos_CsvFile.hpp>

#include <memory>
#include <string>
#include <vector>

namespace Harmos
{

/// One material's columns of history.csv, per unit depth.
struct HistoryMaterial
{
  double mass = 0.0;                         // [kg/m]
  double volume = 0.0;                       // geometric, of the filled regions [m^2]
  double momentum_x = 0.0, momentum_y = 0.0; // [N s/m]
  double kinetic_energy = 0.0;               // at t^{n+1/2} [J/m]
  double internal_energy = 0.0;              // [J/m]
  double x_min = 0.0, x_max = 0.0;           // extent of the filled regions [m]
  double y_min = 0.0, y_max = 0.0;
  double plastic_strain_max = 0.0;
  double failed_mass = 0.0; // of its pairs that have failed [kg/m]
};

/// One row of history.csv. Losses, created volumes, work, impulses and outflows are sums since the start of the run.
///
/// E0 = kinetic_energy + internal_energy - external_work + contact_loss + remap_loss + outflow_energy + energy_error.
struct HistoryRow
{
  long long cycle = 0;
  double time = 0.0;                                         // t^{n+1} [s]
  double dt = 0.0;                                           // [s]
  double mass = 0.0;                                         // [kg/m]
  double momentum_x = 0.0, momentum_y = 0.0;                 // [N s/m]
  double angular_momentum = 0.0;                             // about the origin [N s]
  double kinetic_energy = 0.0;                               // at t^{n+1/2} [J/m]
  double internal_energy = 0.0;                              // [J/m]
  double external_work = 0.0;                                // walls, driven bodies, gravity [J/m]
  double contact_loss = 0.0, remap_loss = 0.0;               // [J/m], >= 0 where dissipative
  double energy_error = 0.0;                                 // what the ledger leaves over [J/m]
  double overlap_volume = 0.0, void_volume = 0.0;            // removed overlap, spurious void [m^2]
  double external_impulse_x = 0.0, external_impulse_y = 0.0; // [N s/m]
  double outflow_mass = 0.0;                                 // net of inflow [kg/m]
  double outflow_momentum_x = 0.0, outflow_momentum_y = 0.0; // [N s/m]
  double outflow_energy = 0.0;                               // kinetic + internal [J/m]
  long long pairs = 0, pairs_mixed = 0;
  long long multipliers = 0, iterations = 0;
  double residual = 0.0;                 // of the constraint loop, relative
  std::vector<HistoryMaterial> material; // in the order of the names
  double returned_heat = 0.0;            // kinetic energy that the remap turned into internal energy [J/m]
  double polygon_overlap = 0.0;          // of moved regions [m^2]; this and the next two where they are asked for
  double polygon_overlap_largest = 0.0;  // in any cell and cycle since the last row, over the cell's volume
  double polygon_overlap_place[2] = {0.0, 0.0}; // of that cell [m]
  double remapped_overlap = 0.0;                // the same of the regions that are remapped: what parting leaves [m^2]
  double remapped_overlap_largest = 0.0;        // as polygon_overlap_largest
};

/// history.csv: a header line, then a row per call, whole lines only, doubles with 17 digits.
class History
{
public:
  /// \param writes True on the one rank that writes; elsewhere every call does nothing.
  /// \param start  Fresh, or cut after a restart's cycle and continued.
  /// \param polygon_overlap With the columns of the polygon overlap.
  /// \throws std::runtime_error when the file cannot be made or its columns differ from this run's.
  History(std::string const &path, std::vector<std::string> const &material_names, bool writes,
          CsvStart start = CsvStart::fresh(), bool polygon_overlap = false);

  /// \throws std::invalid_argument when the row has another number of materials than the header.
  void write(HistoryRow const &row);

private:
  std::size_t num_materials_;
  bool polygon_overlap_;
  std::unique_ptr<CsvFile> file_;
};

/// The header line of history.csv, without the line end.
std::string historyHeader(std::vector<std::string> const &material_names, bool polygon_overlap = false);

} // namespace Harmos

#endif
