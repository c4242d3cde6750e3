// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REDUCED_VALUES_HPP
#define HARMOS_REDUCED_VALUES_HPP

#include <Harmos_Kokkos.hpp>

namespace Harmos
{

/// Where a reduction of several values at once (a functor with `value_type = T[]`) leaves them: the host's array that it
/// is made from. Kokkos 4 refuses the raw pointer that Kokkos 3 took. The caller fences before it reads the array.
template <class T>
using ReducedValues = Kokkos::View<T *, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

} // namespace Harmos

#endif
