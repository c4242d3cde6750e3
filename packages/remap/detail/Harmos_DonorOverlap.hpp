// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DONOR_OVERLAP_HPP
#define HARMOS_DONOR_OVERLAP_HPP

#include <detail/Harmos_Overlays.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// What the moved regions of different materials have in common, polygon by polygon (MovedOverlap).
///
/// A donor reaches its cell's vertex neighbours only. So in each acceptor all that meets there are regions of the cell
/// itself and of those around it; every two of different materials are intersected with one another and with the
/// acceptor, in ascending order of cells. Acceptors do not overlap: what two regions share is counted once, wherever it
/// lies in the mesh. Collective; the same bits on any number of ranks.
///
/// \param donors After moveDonors, or partDonors; the polygons of those that it leaves out are filled in.
MovedOverlap measureOverlap(Input const &in, Classes const &classes, Donors const &donors, Exchange const &exchange);

} // namespace RemapDetail
} // namespace Harmos

#endif
