// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_OVERLAY_LIST_HPP
#define HARMOS_OVERLAY_LIST_HPP

#include <detail/Harmos_NeighbourLinks.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Overlays below this part of their donor get its mean: their centroids are round-off.
constexpr double least_part = 1e-12;

/// The overlays of a donor, with moments M about its centroid.
template <class M>
struct OverlayList
{
  M whole; // of the donor
  int size = 0;
  int slot[most_slots], acceptor[most_slots];
  double value[most_slots + 1][M::count]; // of the moments; at `size`: what the overlays leave. Never cleared: long
  bool has_rest = false;                  // that is more than round-off

  KOKKOS_INLINE_FUNCTION void add(int its_slot, int its_acceptor, M const &m)
  {
    slot[size] = its_slot;
    acceptor[size] = its_acceptor;
    for (int i = 0; i < M::count; ++i)
      value[size][i] = m.value[i];
    ++size;
  }

  KOKKOS_INLINE_FUNCTION void setRest()
  {
    for (int i = 0; i < M::count; ++i)
    {
      double rest = whole.value[i];
      for (int o = 0; o < size; ++o)
        rest -= value[o][i];
      value[size][i] = rest;
    }
    has_rest = value[size][0] > least_part * whole.volume();
  }

  /// Parts of the donor whose means are bounded: the overlays, and the rest where there is one.
  KOKKOS_INLINE_FUNCTION int parts() const { return has_rest ? size + 1 : size; }

  KOKKOS_INLINE_FUNCTION int largest() const
  {
    int most = 0;
    for (int o = 1; o < size; ++o)
      most = value[o][0] > value[most][0] ? o : most;
    return most;
  }

  KOKKOS_INLINE_FUNCTION M moments(int part) const
  {
    M m;
    for (int i = 0; i < M::count; ++i)
      m.value[i] = value[part][i];
    return m;
  }

  /// The moments that the donor's polynomials are integrated with over a part.
  KOKKOS_INLINE_FUNCTION M fieldMoments(int part) const
  {
    M m = moments(part);
    if (m.volume() > least_part * whole.volume())
      return m;
    double const scale = m.volume() / whole.volume();
    for (int i = 0; i < M::count; ++i)
      m.value[i] = scale * whole.value[i];
    return m;
  }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
