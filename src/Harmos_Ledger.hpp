// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LEDGER_HPP
#define HARMOS_LEDGER_HPP

#include <Harmos_Vector.hpp>

#include <vector>

namespace Harmos
{

/// Running sums of a run, each from its own source (doc/theory: energy ledger). Per unit depth.
///
/// E0 = kinetic + internal - external_work + contact_loss + remap_loss + outflow_energy;
/// P0 = momentum - external_impulse + outflow_momentum.
struct Ledger
{
  double energy0 = 0.0;
  double mass0 = 0.0;
  double first_step = 0.0; // stable time step at the start, or run/max_dt or run/end_time where that is less [s]
  double momentum0_x = 0.0, momentum0_y = 0.0;
  double angular_momentum0 = 0.0; // about the origin [N s]
  double external_work = 0.0;
  double contact_loss = 0.0;
  double remap_loss = 0.0;
  double overlap_volume = 0.0;
  double void_volume = 0.0;
  double external_impulse_x = 0.0, external_impulse_y = 0.0;
  double outflow_mass = 0.0;
  double outflow_momentum_x = 0.0, outflow_momentum_y = 0.0;
  double outflow_energy = 0.0;
  double largest_mass_error = 0.0;     // relative
  double largest_momentum_error = 0.0; // [N s/m]
  double largest_energy_error = 0.0;   // [J/m]
  double largest_energy = 0.0;         // kinetic + internal [J/m]
  double largest_speed_momentum = 0.0; // sum m |v| [N s/m]
  double pair_steps = 0.0;
  double cell_steps = 0.0;
  double unconverged_cycles = 0.0;
  double broken_bonds = 0.0;
  double light_nodes = 0.0;
  double repeats = 0.0;
  double merged = 0.0;
  double bounded = 0.0;               // pairs, summed over cycles, whose specific volume was bounded
  double closed_volume = 0.0;         // spurious void that was closed [m^2]
  double gas_work = 0.0;              // by gas on void that it filled, less overlap; part of contact_loss [J/m]
  double gas_heat = 0.0;              // that thin gas gave to what lies beside it [J/m]
  double greedy_cells = 0.0;          // more than five components, ordered one by one; summed over cycles
  double out_of_range = 0.0;          // pair steps outside of the equation of state's range
  double unfinished_interfaces = 0.0; // mixed cells, summed over cycles, whose line's angle met its bound of iterations
  double restored_volume = 0.0;       // prescribed field: sum of |volume given back| [m^2]
  double returned_heat = 0.0;         // kinetic energy that the remap turned into internal energy [J/m]
  double largest_angular_drift = 0.0; // |L - L0|, over largest_moment [1]
  double largest_moment = 0.0;        // sum m |x| |v| [N s]
  double polygon_overlap = 0.0;       // of moved regions of different materials, where it is measured [m^2]
  double largest_overlap = 0.0;       // in any cell and cycle since the last row of the history, over the cell's volume
  double largest_overlap_x = 0.0, largest_overlap_y = 0.0; // of that cell [m]
  double remapped_overlap = 0.0;                           // what parting leaves of polygon_overlap [m^2]
  double largest_remapped_overlap = 0.0;                   // as largest_overlap

  /// Keep the largest errors. \param momentum_error [N s/m] \param energy_error [J/m]
  /// \param energy Kinetic + internal now. \param speed_momentum sum m |v| now.
  void noteErrors(double mass_error, double momentum_error, double energy_error, double energy, double speed_momentum);

  /// The largest error of the momentum over the largest sum m |v| of the run so far (the method's definition).
  double momentumError() const;
  /// The largest error of the energy over the largest energy of the run so far.
  double energyError() const;

  /// Keep the largest drift of the angular momentum, relative to the largest sum m |x| |v| of the run so far.
  void noteAngularMomentum(double angular_momentum, double moment);

  /// What moved regions overlap in one cycle: in all, and the largest part of a cell with its place.
  void noteOverlap(double volume, double largest, Vector2 const &place);

  /// The same of the regions that are remapped.
  void noteRemappedOverlap(double volume, double largest);

  /// All values in the order of declaration, for checkpoints.
  std::vector<double> values() const;
  /// The inverse; throws std::runtime_error when the number of values differs.
  static Ledger fromValues(std::vector<double> const &values);
};

} // namespace Harmos

#endif
