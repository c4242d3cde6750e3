// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_METALS_HPP
#define HARMOS_TEST_METALS_HPP

#include <Harmos_Material.hpp>

#include <cmath>

namespace Harmos
{
namespace Test
{

/// Copper: Mie-Gruneisen.
inline Material copper()
{
  Material m;
  m.eos = EosKind::MieGruneisen;
  m.density0 = 8930.0;
  m.sound_speed0 = 3940.0;
  m.slope = 1.489;
  m.gruneisen = 2.02;
  m.energy0 = 1.0e3;
  return m;
}

/// The same with the stiffened equation of state.
inline Material stiff()
{
  Material m = copper();
  m.eos = EosKind::Stiffened;
  return m;
}

/// Melosh, Impact Cratering (1989), appendix II.
inline Material tillotsonAluminium()
{
  Material m;
  m.eos = EosKind::Tillotson;
  m.density0 = 2700.0;
  m.tillotson = {0.5, 1.63, 75.2e9, 65.0e9, 5.0, 5.0, 5.0e6, 3.0e6, 13.9e6};
  m.sound_speed0 = std::sqrt(75.2e9 / 2700.0);
  m.gruneisen = 2.13;
  return m;
}

} // namespace Test
} // namespace Harmos

#endif
