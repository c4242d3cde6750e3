// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_METALS_HPP
#define HARMOS_TEST_METALS_HPP

#include <Harmos_Material.hpp>

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

} // namespace Test
} // namespace Harmos

#endif
