// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LAUNCH_HPP
#define HARMOS_LAUNCH_HPP

#include <Harmos_Kokkos.hpp>

#include <algorithm>
#include <type_traits>

namespace Harmos
{

// Launches of kernels over a few hundred items, as contact has them by the dozen. Through Kokkos a launch costs some
// hundred instructions before its first item: copies of what the kernel captures, a label, questions whether tools
// listen. On hosts with one thread it is the loop itself, unless a tool listens. Order and sums are those of
// Kokkos::Serial.

/// Whether the loop itself does what a launch would do.
inline bool launchesAsLoop()
{
#ifdef KOKKOS_ENABLE_SERIAL
  return std::is_same<ExecutionSpace, Kokkos::Serial>::value && !Kokkos::Profiling::profileLibraryLoaded();
#else
  return false;
#endif
}

/// kernel(i) for i in 0..count - 1.
template <class Kernel>
void launchFor(char const *label, int count, Kernel const &kernel)
{
  if (!launchesAsLoop())
  {
    Kokkos::parallel_for(label, RangePolicy(0, count), kernel);
    return;
  }
  for (int i = 0; i < count; ++i)
    kernel(i);
}

/// kernel(i, part) for i in 0..count - 1; \param result The sum of all parts.
template <class Kernel, class Value>
std::enable_if_t<std::is_arithmetic<Value>::value> launchReduce(char const *label, int count, Kernel const &kernel,
                                                                Value &result)
{
  Value sum = 0;
  if (!launchesAsLoop())
    Kokkos::parallel_reduce(label, RangePolicy(0, count), kernel, sum);
  else
    for (int i = 0; i < count; ++i)
      kernel(i, sum);
  result = sum;
}

/// kernel(i, part) for i in 0..count - 1; \param reducer A Kokkos reducer: where the parts are joined.
template <class Kernel, class Reducer>
std::enable_if_t<!std::is_arithmetic<Reducer>::value> launchReduce(char const *label, int count, Kernel const &kernel,
                                                                   Reducer const &reducer)
{
  if (!launchesAsLoop())
  {
    Kokkos::parallel_reduce(label, RangePolicy(0, count), kernel, reducer);
    return;
  }
  typename Reducer::value_type value;
  reducer.init(value);
  for (int i = 0; i < count; ++i)
    kernel(i, value);
  reducer.reference() = value;
}

/// kernel(i, sum, final) for i in 0..count - 1, where the sum of what the kernels before add has been reached when
/// `final` is true. \param result The sum of all.
template <class Kernel, class Value>
void launchScan(char const *label, int count, Kernel const &kernel, Value &result)
{
  Value sum = 0;
  if (!launchesAsLoop())
    Kokkos::parallel_scan(label, RangePolicy(0, count), kernel, sum);
  else
    for (int i = 0; i < count; ++i)
      kernel(i, sum, true);
  result = sum;
}

/// Copy an array to one of the same shape; both contiguous. Nothing where they are the same.
template <class To, class From>
void launchCopy(To const &to, From const &from)
{
  if (!launchesAsLoop())
    Kokkos::deep_copy(to, from);
  else if (to.data() != from.data())
    std::copy(from.data(), from.data() + from.span(), to.data());
}

} // namespace Harmos

#endif
