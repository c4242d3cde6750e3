// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_FIELD_HPP
#define HARMOS_REMAP_FIELD_HPP

#include <Harmos_Mesh.hpp>
#include <Harmos_RemapDeck.hpp>

namespace Harmos
{

/// Cell averages of the field of `harmos remap`, all local cells, axisymmetric weighted by the radius: by 2 x 2 Gauss
/// points for the sine, 16 x 16 for the shock.
View<double *> cellAverages(RemapField const &field, Mesh const &mesh);

} // namespace Harmos

#endif
