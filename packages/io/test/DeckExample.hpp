// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_EXAMPLE_HPP
#define HARMOS_DECK_EXAMPLE_HPP

#include <string>

namespace Harmos
{

/// A block between a platen and an open top; uses most kinds of entry.
inline std::string exampleDeck()
{
  return R"(# A block on a platen
harmos:
  title: sliding block
  kinematics: xfem
  mesh: {x: {from: -2.0, to: 4, cells: 48}, y: {from: -1.0, to: 1.0, cells: 16}}
  boundaries: {left: {type: outflow}, right: {type: outflow}, top: {type: contact wall}}
  materials:
    block: {eos: stiffened, density: 1000, sound_speed: 100.0, strength: elastic, shear_modulus: 3.0e6}
    copper: {eos: mie_gruneisen, density: 8930, sound_speed: 3940, slope: 1.489, gruneisen: 2.0, strength: plastic, shear_modulus: 43.33e9, yield_stress: 400.0e6, hardening_modulus: 100.0e6}
    air: {eos: ideal gas, density: 1.2, gamma: 1.4}
    platen: {eos: rigid, density: 1000.0}
  bodies:
    lower: {material: platen, shape: half-plane, point: [0.0, -0.5], normal: [0, 2]}
    gas: {material: air, shape: rectangle, center: [1.0, 0.25], size: [5.9, 1.5], pressure: 1.0e5}
    slider: {material: block, shape: rectangle, center: [0, 0.0], size: [1, 1], angle: 90, velocity: [1, 0], cut: true}
    ring: {material: copper, shape: annulus, center: [2.5, 0.0], inner_radius: 0.1, outer_radius: 0.3, cut: true, angular_velocity: 5}
    patch: {material: block, shape: polygon, points: [-1, 0, -1, 0.5, -0.5, 0], join: slider, cut: true}
  interactions:
    default: sliding
    glue: {between: ring, and: patch, type: bonded, shear_strength: 5.0e6}
  probes:
    middle: {position: [0, 0]}
  run: {end_time: 1}
  output:
    fields: {every_time: 0.1}
)";
}

} // namespace Harmos

#endif
