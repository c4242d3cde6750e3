// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RESTORE_VOLUMES_HPP
#define HARMOS_RESTORE_VOLUMES_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_Exchange.hpp>

#include <vector>

namespace Harmos
{

/// Volume of every material: sum over owned pairs of volume fraction times cell area, over all ranks. [length^2]
/// The same bits for any number of ranks and threads. Collective.
std::vector<double> materialVolumes(Mesh const &mesh, CellMaterialPairs const &pairs,
                                    View<double *[num_pair_fields]> const &record, int num_materials,
                                    Exchange const &exchange);

struct RestoredVolumes
{
  double moved = 0.0;  // sum over materials of |volume that was missing| [length^2]
  double defect = 0.0; // what is still missing after it, of the largest volume
  int iterations = 0;
};

/// Give every material the volume that it had before a step (doc/decisions/0005).
///
/// Volume fractions of the mixed cells become f_m w_m / (sum_k f_k w_k + void), one weight w_m a material: the change
/// is f (1 - f) (w - 1) to first order, sums stay one, what was empty stays empty and what was full full. The weights
/// are those for which all volumes are met (iterative proportional fitting), by Newton's method for their logarithms.
/// Halo cells get what their owners get.
///
/// \param target By material, from materialVolumes before the step.
/// Throws std::runtime_error where a material has no mixed cell that could take what it lacks.
/// Deming & Stephan, Ann. Math. Stat. 11 (1940) 427-444. Collective.
RestoredVolumes restoreVolumes(Mesh const &mesh, CellMaterialPairs const &pairs,
                               View<double *[num_pair_fields]> const &record, std::vector<double> const &target,
                               Exchange const &exchange);

} // namespace Harmos

#endif
