// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ON_HOST_HPP
#define HARMOS_ON_HOST_HPP

#include <Harmos_Kokkos.hpp>

namespace Harmos
{

/// What a View holds, where the host can read it: the View itself if it lies there already, else a copy.
template <class V>
auto onHost(V const &view)
{
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
}

} // namespace Harmos

#endif
