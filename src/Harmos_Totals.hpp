// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TOTALS_HPP
#define HARMOS_TOTALS_HPP

#include "Harmos_TimeStep.hpp"

#include <Harmos_History.hpp>

#include <vector>

namespace Harmos
{

/// Sums of a state over all ranks; per unit depth. Driven rigid bodies (fixed, prescribed) are no part of the totals:
/// they are the outside world. Free ones count with their whole mass, wherever their outline reaches.
struct Totals
{
  double mass = 0.0;
  double momentum_x = 0.0, momentum_y = 0.0;
  double angular_momentum = 0.0; // about the origin
  double kinetic_energy = 0.0, internal_energy = 0.0;
  double speed_momentum = 0.0; // sum m |v|: what momentum errors are measured against
  double moment = 0.0;         // sum m |x| |v|: the same for the angular momentum
  long long pairs = 0, pairs_mixed = 0;
  std::vector<HistoryMaterial> material; // the first `num_materials`, extents zero unless asked for
};

/// \param num_materials Rows of `material`: the deck's fields, without the walls that stand for boundaries.
Totals computeTotals(Scene const &scene, CycleState const &state, int num_materials, bool with_extents);

/// Pairs of this rank's own cells.
long long countOwnedPairs(Exchange const &exchange, Mesh const &mesh, CellMaterialPairs const &pairs);

} // namespace Harmos

#endif
