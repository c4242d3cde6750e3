// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_KOKKOS_HPP
#define HARMOS_KOKKOS_HPP

/// One place for what differs between Kokkos 3.4 (Debian's Trilinos) and Kokkos 4.x.

#include <Kokkos_Core.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#ifndef KOKKOS_VERSION
#error "Harmos needs Kokkos 3.4 or later"
#endif

/// Marks an inline function that device compilers keep out of line. They inline whatever a kernel calls, and a kernel
/// that reaches it from many places then takes tens of minutes to compile. On hosts: KOKKOS_INLINE_FUNCTION.
#if defined(__CUDACC__) || defined(__HIPCC__)
#define HARMOS_LARGE_FUNCTION KOKKOS_INLINE_FUNCTION __attribute__((noinline))
#else
#define HARMOS_LARGE_FUNCTION KOKKOS_INLINE_FUNCTION
#endif

namespace Harmos
{

using ExecutionSpace = Kokkos::DefaultExecutionSpace;
using MemorySpace = ExecutionSpace::memory_space;
using RangePolicy = Kokkos::RangePolicy<ExecutionSpace>;

/// Records are contiguous: one (pair, field) record is one cache line, on hosts. Layout hidden behind this alias.
template <class T>
using View = Kokkos::View<T, Kokkos::LayoutRight, MemorySpace>;

template <class T>
using HostView = decltype(Kokkos::create_mirror_view(std::declval<View<T> const &>()));

namespace Math
{
#if KOKKOS_VERSION >= 30700
using Kokkos::abs;
using Kokkos::acos;
using Kokkos::asin;
using Kokkos::atan2;
using Kokkos::cos;
using Kokkos::exp;
using Kokkos::fabs;
using Kokkos::floor;
using Kokkos::log;
using Kokkos::pow;
using Kokkos::sin;
using Kokkos::sqrt;
using Kokkos::tan;
#else
using std::abs;
using std::acos;
using std::asin;
using std::atan2;
using std::cos;
using std::exp;
using std::fabs;
using std::floor;
using std::log;
using std::pow;
using std::sin;
using std::sqrt;
using std::tan;
#endif

template <class T>
KOKKOS_INLINE_FUNCTION constexpr T min(T a, T b)
{
  return b < a ? b : a;
}

template <class T>
KOKKOS_INLINE_FUNCTION constexpr T max(T a, T b)
{
  return a < b ? b : a;
}

template <class T>
KOKKOS_INLINE_FUNCTION constexpr T clamp(T x, T low, T high)
{
  return x < low ? low : (high < x ? high : x);
}

constexpr double pi = 3.14159265358979323846;
} // namespace Math

/// A new View in the device's memory that holds the values, in their order.
template <class T>
View<T *> deviceCopy(std::string const &label, std::vector<T> const &values)
{
  View<T *> const view(label, values.size());
  auto const host = Kokkos::create_mirror_view(view);
  for (std::size_t i = 0; i < values.size(); ++i)
    host(i) = values[i];
  Kokkos::deep_copy(view, host);
  return view;
}

/// A profiling region for the lifetime of a scope (Kokkos has its own from 4.1 on).
class ScopedRegion
{
public:
  explicit ScopedRegion(std::string const &name) { Kokkos::Profiling::pushRegion(name); }
  ~ScopedRegion() { Kokkos::Profiling::popRegion(); }
  ScopedRegion(ScopedRegion const &) = delete;
  ScopedRegion &operator=(ScopedRegion const &) = delete;
};

} // namespace Harmos

#endif
