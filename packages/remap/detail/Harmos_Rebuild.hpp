// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REBUILD_HPP
#define HARMOS_REBUILD_HPP

#include <detail/Harmos_Acceptors.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// The new pairs, and where they come from.
struct Rebuilt
{
  RemapResult result;
  View<int *> candidate;  // num_pairs: candidate of the pairs of interface cells
  View<double *> kinetic; // num_pairs: KineticField that the remap carried; extent 0: not asked for
};

/// Pairs, records and centroids of time n+1, and the dof nodes. Rows and dof nodes are kept where no cell changes its
/// set of materials.
Rebuilt rebuild(Input const &in, Kinematics kinematics, Classes const &classes, StageState const &stage,
                Acceptors const &acceptors);

/// New velocities of the dof nodes that are not final after stage 1: the mean of the corner velocities around, weighted
/// by mass (the corner's share of each pair's); as after stage 1 where nothing around changed in stage 2. Node
/// conditions are imposed on what changed. Final nodes are copied, unless the velocities are those of stage 1 in place.
///
/// \param sums The impulse of the node conditions at owned nodes, sum m (v_imposed - v), and the kinetic energy after
///             are added.
void nodalVelocities(Input const &in, Classes const &classes, StageState const &stage, Acceptors const &acceptors,
                     Rebuilt const &rebuilt, bool in_place, SweptSums &sums);

/// Kinetic energy of the deformable pairs of owned cells, with corner masses by Input::share.
double kineticEnergy(Input const &in, CellMaterialPairs const &pairs, View<double *[num_pair_fields]> const &record,
                     View<double *[2]> const &velocity);

/// Lump masses by the shares of the mesh that the remap has come to instead of those of the mesh where it began: pair
/// by pair (reshare), then the nodal means, with node conditions; sums as in nodalVelocities.
void moveShares(Input const &in, Rebuilt &rebuilt, SweptSums &sums);

/// Add what the remap carried of kinetic energy and the new velocities do not hold to the pairs' internal energy.
/// \return The energy returned in owned cells.
double returnKineticDefect(Input const &in, Rebuilt const &rebuilt);

} // namespace RemapDetail
} // namespace Harmos

#endif
