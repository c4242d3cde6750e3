// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Ledger.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace Harmos
{

static_assert(std::is_standard_layout<Ledger>::value && sizeof(Ledger) % sizeof(double) == 0,
              "a ledger is an array of doubles");

namespace
{

/// What is no number stays.
void raise(double &largest, double value)
{
  if (!std::isnan(largest) && !(value <= largest))
    largest = value;
}

} // namespace

void Ledger::noteErrors(double mass_error, double momentum_error, double energy_error, double energy,
                        double speed_momentum)
{
  raise(largest_energy, std::fabs(energy));
  raise(largest_speed_momentum, speed_momentum);
  raise(largest_mass_error, mass_error);
  raise(largest_momentum_error, momentum_error);
  raise(largest_energy_error, std::fabs(energy_error));
}

double Ledger::momentumError() const
{
  return largest_speed_momentum != 0.0 ? largest_momentum_error / largest_speed_momentum : 0.0;
}

double Ledger::energyError() const
{
  return largest_energy != 0.0 ? largest_energy_error / largest_energy : 0.0;
}

void Ledger::noteAngularMomentum(double angular_momentum, double moment)
{
  raise(largest_moment, moment);
  if (largest_moment != 0.0)
    raise(largest_angular_drift, std::fabs(angular_momentum - angular_momentum0) / largest_moment);
}

void Ledger::noteOverlap(double volume, double largest, Vector2 const &place)
{
  polygon_overlap += volume;
  if (!(largest > largest_overlap))
    return;
  largest_overlap = largest;
  largest_overlap_x = place[0];
  largest_overlap_y = place[1];
}

void Ledger::noteRemappedOverlap(double volume, double largest)
{
  remapped_overlap += volume;
  largest_remapped_overlap = std::max(largest_remapped_overlap, largest);
}

std::vector<double> Ledger::values() const
{
  std::vector<double> v(sizeof(Ledger) / sizeof(double));
  std::memcpy(v.data(), this, sizeof(Ledger));
  return v;
}

Ledger Ledger::fromValues(std::vector<double> const &values)
{
  if (values.size() != sizeof(Ledger) / sizeof(double))
    throw std::runtime_error("checkpoint: the ledger has " + std::to_string(values.size()) +
                             " values, this version writes " + std::to_string(sizeof(Ledger) / sizeof(double)));
  Ledger ledger;
  std::memcpy(static_cast<void *>(&ledger), values.data(), sizeof(Ledger));
  return ledger;
}

} // namespace Harmos
