// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PART_DONORS_HPP
#define HARMOS_PART_DONORS_HPP

#include <detail/Harmos_Donors.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Work arrays of partDonors.
struct PartWork
{
  View<int *> rough;      // donors: 1 where matter has flowed and is passed
  View<int *> parted;     // donors: 1 where `polygon` holds a parted region
  View<Region *> polygon; // donors
};

/// Part the moved regions of bodies that have flowed and pass each other (doc/decisions/0025).
///
/// Velocities follow the smooth interface, the facets of a reconstruction do not: moved along it they run into each
/// other by length times slip times the sine between the two. Where one of two bodies has an equivalent plastic strain
/// above 0.1 and materials at a node of its cell are moved apart by more than 0.005 cell sizes, what two moved regions
/// of deformable bodies have in common between two crossings of their outlines (Lens) is divided along the line through
/// the crossings, unless they come at each other across it, which is for rows to hold. A region keeps its volume and
/// its mass: what it lost is made up for by `measure`, the factor of all its moments.
///
/// \param donors After moveDonors: polygon, shape and measure are changed.
void partDonors(Input const &in, Classes const &classes, Donors const &donors, PartWork &work);

} // namespace RemapDetail
} // namespace Harmos

#endif
