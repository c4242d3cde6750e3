// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REQUIRE_HPP
#define HARMOS_REQUIRE_HPP

#include <Harmos_Kokkos.hpp>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace Harmos
{
namespace detail
{

/// \throw std::runtime_error
inline void require(bool right, std::string const &what)
{
  if (!right)
    throw std::runtime_error(what);
}

inline std::string text(double value)
{
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

/// An entry that must lie in a range, in which not-a-number and infinity never do.
inline void requireFinite(std::string const &entry, double value)
{
  require(std::isfinite(value), entry + " is " + text(value) + "; expected: a finite number");
}

inline void requirePositive(std::string const &entry, double value)
{
  require(std::isfinite(value) && value > 0.0, entry + " is " + text(value) + "; expected: above 0 and finite");
}

inline void requireNotNegative(std::string const &entry, double value)
{
  require(std::isfinite(value) && value >= 0.0, entry + " is " + text(value) + "; expected: 0 or more, and finite");
}

/// The first index below `count` for which `wrong`, a function on the device, is true; -1: none.
template <class Wrong>
int firstWrong(std::string const &label, int count, Wrong const &wrong)
{
  int first = count;
  Kokkos::parallel_reduce(
      label, RangePolicy(0, count),
      KOKKOS_LAMBDA(int i, int &least) {
        if (wrong(i))
          least = Math::min(least, i);
      },
      Kokkos::Min<int>(first));
  return first < count ? first : -1;
}

} // namespace detail
} // namespace Harmos

#endif
