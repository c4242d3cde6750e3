// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FIELD_RANGES_HPP
#define HARMOS_FIELD_RANGES_HPP

#include <Harmos_Exchange.hpp>
#include <detail/Harmos_RemapClasses.hpp>
#include <detail/Harmos_StageFields.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// The owned cells at the boundary of the mesh and their vertex neighbours, ascending.
View<int *> rimCells(Mesh const &mesh);

/// By material, the least (columns 0 .. 15) and the largest (16 .. 31) values of the stage fields in the moved pure
/// cells at the rim of the mesh, of all ranks: how far RemapLimiter::RangeInside goes beyond the range of the donors
/// around. Kinetic energy has no such range, nor has a material without pure cells there: 1e300, -1e300. Extent 0 with
/// other limiters and at first order. Collective.
View<double * [2 * num_stage_fields]> fieldRanges(Input const &in, Classes const &classes, View<int *> const &rim,
                                                  Exchange const &exchange);

/// The least and the largest of all ranks.
/// \param bounds Least values, and largest ones with the sign changed. Collective.
void joinBounds(Exchange const &exchange, double *bounds, int count);

} // namespace RemapDetail
} // namespace Harmos

#endif
