// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CLOSURE_HPP
#define HARMOS_CLOSURE_HPP

#include <Harmos_Polygon.hpp>

namespace Harmos
{
namespace detail
{

/// Largest strain of a component in one step where it differs from the cell's: what a soft one next to a stiff one does
/// not take the others share. The work -p dV then stays well below the energy of a gas.
constexpr double most_closure_strain = 0.2;

/// Void below this part of the cell is none.
constexpr double least_closure_void = 1e-12;

/// A deformable component of a mixed cell whose volume is one.
struct ClosureComponent
{
  double fraction; // geometric, > 0
  double pressure; // [Pa]
  double modulus;  // rho c^2 > 0 [Pa]
  double strain;   // out: dV / V of the step
};

struct ClosureComponents
{
  int count = 0;
  ClosureComponent item[max_components];
};

/// Share `change` in proportion to fraction / modulus; who would pass its bound stops there. The bounds have the sign
/// of the change. \return What nobody took.
template <class Bound>
KOKKOS_INLINE_FUNCTION double shareByCompressibility(ClosureComponents &c, double change, Bound const &bound)
{
  bool stopped[max_components] = {};
  double const sign = change < 0.0 ? -1.0 : 1.0;
  for (int pass = 0; pass <= c.count; ++pass)
  {
    double compressibility = 0.0;
    for (int i = 0; i < c.count; ++i)
      compressibility += stopped[i] ? 0.0 : c.item[i].fraction / c.item[i].modulus;
    if (!(compressibility > 0.0))
      return change;
    double const pressure = change / compressibility; // rise of pressure that all feel, sign reversed
    bool all_free = true;
    for (int i = 0; i < c.count; ++i)
    {
      double const limit = bound(c.item[i]);
      if (stopped[i] || sign * (c.item[i].strain + pressure / c.item[i].modulus - limit) <= 0.0)
        continue;
      change -= c.item[i].fraction * (limit - c.item[i].strain);
      c.item[i].strain = limit;
      stopped[i] = true;
      all_free = false;
    }
    if (!all_free)
      continue;
    for (int i = 0; i < c.count; ++i)
      c.item[i].strain += stopped[i] ? 0.0 : pressure / c.item[i].modulus;
    return 0.0;
  }
  return change;
}

/// Strains of the components of a cell in which deformable materials and void change their volume by `change`.
///
/// With void the pressures go to zero first (strain p / (K - p): density falls by p / c^2), then the void changes;
/// what is left when it has gone, and all of it in a cell without void, is shared in proportion to V / K. Sum of
/// fraction * strain plus the void's change is `change`.
/// \param void_fraction Of the cell; below least_closure_void there is none.
/// \return The void's fraction afterwards (of the unmoved cell), >= 0.
KOKKOS_INLINE_FUNCTION double distributeVolume(ClosureComponents &c, double void_fraction, double change)
{
  double filled = 0.0;
  for (int i = 0; i < c.count; ++i)
  {
    c.item[i].strain = 0.0;
    filled += c.item[i].fraction;
  }
  double const most = change < 0.0 ? -most_closure_strain : most_closure_strain;
  double left = change;
  if (void_fraction > least_closure_void)
  {
    auto const release = [=](ClosureComponent const &m)
    {
      if (m.pressure * change <= 0.0)
        return 0.0;
      double const strain = m.pressure < m.modulus ? m.pressure / (m.modulus - m.pressure) : most_closure_strain;
      return Math::clamp(strain, -most_closure_strain, most_closure_strain);
    };
    left = shareByCompressibility(c, left, release);
    double const remains = void_fraction + left;
    if (remains > least_closure_void)
      return remains;
    left = remains;
  }
  left = shareByCompressibility(c, left, [=](ClosureComponent const &) { return most; });
  for (int i = 0; i < c.count; ++i)
    c.item[i].strain += left / filled;
  return 0.0;
}

} // namespace detail
} // namespace Harmos

#endif
