// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SHAPE_ERRORS_HPP
#define HARMOS_SHAPE_ERRORS_HPP

#include "Harmos_TimeStep.hpp"

#include <Harmos_Deck.hpp>

#include <string>
#include <utility>
#include <vector>

namespace Harmos
{

/// What a prescribed field has made of the bodies, against their exact outlines where those are known: carried by a
/// translation or a rotation, or back at t = period. By material, all areas in m^2:
///   NAME.area                  of the exact shape within the mesh
///   NAME.volume_error          sum of volume fraction times cell area, less that
///   NAME.l1                    sum over cells of |volume fraction - exact| times cell area
///   NAME.symmetric_difference  sum over cells of |filled region Δ exact shape|, exact by clipping
/// \return Empty where the exact outlines are not known. Collective.
std::vector<std::pair<std::string, double>> shapeErrors(Deck const &deck, Scene const &scene, CycleState const &state);

} // namespace Harmos

#endif
