// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_OVERLAYS_HPP
#define HARMOS_OVERLAYS_HPP

#include <detail/Harmos_Donors.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Overlays below this part of the acceptor are dropped; their mass is in the donor's rest.
constexpr double least_overlay = 1e-15;

/// What an overlay brings, and a candidate collects: integrals of the stage fields (the density's: mass; primitives and
/// corner velocities weighted by mass, deviator by volume), then volume and first moments about the acceptor's corner
/// 0.
enum OverlaySum : int
{
  VolumeSum = num_stage_fields,
  FirstMomentX,
  FirstMomentY,
  num_overlay_sums = num_stage_fields + 8 // the rest is zero: rows of whole packs
};

/// Integrals of the overlays of the donors' acceptors.
struct Overlays
{
  int slots = 1;                        // per donor
  View<double *[num_overlay_sums]> sum; // slots * donor + slot, where the donor has the overlay

  KOKKOS_INLINE_FUNCTION double *row(int donor, int slot) const
  {
    return &sum(static_cast<std::ptrdiff_t>(slots) * donor + slot, 0);
  }

  /// Ask for a row that will be read, or written, soon.
  template <bool write>
  KOKKOS_FORCEINLINE_FUNCTION void fetch([[maybe_unused]] int donor, [[maybe_unused]] int slot) const
  {
#ifdef HARMOS_VECTOR_TYPES
    constexpr int line = 8; // doubles
    for (int i = 0; i < num_overlay_sums; i += line)
      __builtin_prefetch(row(donor, slot) + i, write ? 1 : 0);
#endif
  }
};

/// What owned interface cells book, one column each.
enum Booking : int
{
  BookOverlap = 0,
  BookVoid,
  BookClosed,
  BookMerged,
  BookBounded,
  BookGasWork,
  BookGasHeat,
  BookFailures,
  BookFailedMaterial, // of the first failed donor, plus one
  BookOutMass,
  BookOutKinetic,
  BookOutEnergy,
  BookOutMomentumX,
  BookOutMomentumY,
  BookInMass, // inflow
  BookInKinetic,
  BookInEnergy,
  BookInMomentumX,
  BookInMomentumY,
  num_bookings
};

using Bookings = View<double *[num_bookings]>;

/// Visits the cells around `cell` and itself in ascending order: a gather that adds in this order gives the same bits
/// on any number of ranks.
/// \param visit (cell, slot of `cell` in the visited cell, cornerRotation(cell, visited cell))
template <class Visitor>
KOKKOS_INLINE_FUNCTION void forCellAndNeighbours(Mesh const &mesh, NeighbourLinks const &links, int cell,
                                                 Visitor const &visit)
{
  bool self = false;
  for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
  {
    int const neighbour = mesh.cell_neighbour.item(j);
    if (!self && neighbour > cell)
    {
      visit(cell, 0, 0);
      self = true;
    }
    visit(neighbour, links.slotBack(j), links.rotation(j));
  }
  if (!self)
    visit(cell, 0, 0);
}

/// Visits the donors that begin in `cell` and in the cells around it, in ascending order.
/// \param visit (cell of the donor, donor)
template <class Visitor>
KOKKOS_INLINE_FUNCTION void forDonorsAround(Input const &in, Classes const &classes, Donors const &donors, int cell,
                                            Visitor const &visit)
{
  forCellAndNeighbours(in.mesh, in.links, cell,
                       [&](int near, int, int)
                       {
                         int const index = classes.interface_index(near);
                         if (index < 0)
                           return;
                         for (int donor = donors.offset(index); donor < donors.offset(index + 1); ++donor)
                           visit(near, donor);
                       });
}

/// Intersect every moving donor with its own cell and the vertex neighbours, and integrate its polynomial there. Whole
/// donors overlap their own cell alone.
///
/// What the overlays do not hold of a donor, round-off or what a contact wall pushes back, goes with its heaviest one:
/// it is little beside that alone. Another may hold next to no mass, whatever its volume (where the range of the
/// density goes down to that of dust), and the acceptor would get round-off of either sign for its mass.
///
/// What leaves through outflow boundaries, and donors whose overlays do not add up, are booked: bookings of all
/// interface cells are set.
void intersect(Input const &in, Classes const &classes, StageState const &stage, Donors const &donors,
               Overlays &overlays, Bookings const &bookings);

} // namespace RemapDetail
} // namespace Harmos

#endif
