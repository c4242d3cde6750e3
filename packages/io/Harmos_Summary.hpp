// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SUMMARY_HPP
#define HARMOS_SUMMARY_HPP

#include <string>
#include <utility>
#include <vector>

namespace Harmos
{

/// What summary.json says about a run. A double that is not finite is written as null.
struct Summary
{
  std::string status; // "completed", "failed", "interrupted"
  long long cycles = 0;
  double end_time = 0.0;    // [s]
  long long pair_steps = 0; // sum of pairs over cycles, all ranks
  long long cell_steps = 0; // cells times cycles
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0; // over all ranks
  std::vector<std::pair<std::string, double>>
      phases; // seconds: reconstruct, lagrange, constrain, remap, exchange, output
  double pair_steps_per_second = 0.0;
  long long peak_memory_bytes = 0; // over all ranks
  int ranks = 1;
  double mass_error = 0.0;             // largest |m - m0 + outflow| / m0
  double momentum_error = 0.0;         // |P - P0 - external impulse + outflow| / sum m |v|
  double energy_error = 0.0;           // of the total
  double angular_momentum_drift = 0.0; // largest |L - L0| over the largest sum m |x| |v|: walls turn too
  long long unconverged_cycles = 0;
  long long bonds = 0; // points, of pairs whose bonds have a strength
  long long broken_bonds = 0;
  long long slowed_light_nodes = 0; // over all cycles, moved with their pair
  long long repeated_cycles = 0;    // times a cycle began anew with half the step
  long long bounded_volumes = 0;    // pairs, over all cycles, whose specific volume the remap bounded
  long long merged_fragments = 0;
  double closed_void_volume = 0.0;     // spurious void that was closed, over all cycles [m^2]
  double gas_work = 0.0;               // by gas on void that it filled, less overlap that it gave way [J/m]
  double gas_heat = 0.0;               // that thin gas gave to what lies beside it [J/m]
  long long greedy_cells = 0;          // mixed cells, over all cycles, of more than five components
  long long unfinished_interfaces = 0; // mixed cells, over all cycles, whose line's angle met its bound of iterations
  std::vector<std::pair<std::string, double>> shape_errors; // prescribed field: errors against the exact shapes [m^2]
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, std::string>> versions; // program and libraries
  std::string deck_json;                                     // whole deck with defaults, as JSON text; empty: null
};

/// summary.json as text: one object, keys in the order of the struct, indented by two.
std::string summaryText(Summary const &summary);

/// Write it atomically (temporary and rename). One rank calls this. \throws std::runtime_error with the file's name.
void writeSummary(std::string const &path, Summary const &summary);

/// A JSON string with its quotes: quotes, backslashes and control characters escaped, UTF-8 kept as it is.
std::string jsonString(std::string const &text);

/// A JSON number with 17 digits; null where the value is not finite (JSON has neither NaN nor infinity).
std::string jsonNumber(double value);

} // namespace Harmos

#endif
