// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SWEPT_FLUXES_HPP
#define HARMOS_SWEPT_FLUXES_HPP

#include <detail/Harmos_RemapClasses.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Layout of RemapWork::geometry.
enum SweptGeometry : int
{
  MovedVolume = 0, // of the cell with all its nodes at x'
  CentroidX = 1,
  CentroidY = 2,
  FirstFace = 4 // face k: [FirstFace + 3 k] swept volume, positive out of the cell; then its centroid - the cell's
};

/// Fluxes and stage records hold the fields of a record, with these two in place of mass and volume fraction.
enum StageField : int
{
  DensityField = 0, // fluxes: mass
  KineticField = 1  // kinetic energy per mass, where it is carried
};

/// Moved volume, centroid and record (density, kinetic energy, the rest as it is) of the pure cells, and the volumes
/// that their faces sweep on the way back.
///
/// Only swept nodes go back, by u = dt v; face k with ends a, b sweeps (u_a + u_b)/2 x E out of the cell, E the edge
/// at mid-step: both cells see the same number with opposite signs, and the four add up to the change of area exactly.
/// \param kinetic Kinetic energy per mass of the pairs; extent 0: not carried.
void sweptGeometry(Input const &in, Classes const &classes, View<double *> const &kinetic, RemapWork const &work);

/// Fluxes of the faces through which the cells of stage 1 lose material: a limited linear polynomial per cell at the
/// swept centroids. Density and deviator are weighted by volume; the primitives by mass, with the face's mass flux.
///
/// One scalar limiter a field and cell keeps the values at all outgoing faces, and the mean of what stays in the cell,
/// within the range of the cell and its face neighbours: so the new values are means of values within range.
void sweptFluxes(Input const &in, Classes const &classes, RemapWork const &work);

/// Records after stage 1 (all pairs; a copy where nothing flows), and the momentum that corners gain from the others of
/// their cell by dual mass fluxes.
///
/// With F_k the mass that leaves through face k: (F1 - F3)/4 flows along 0->1 and 3->2, (F2 - F0)/4 along 0->3 and
/// 1->2. The upwind velocity is limited (monotonised central). Cells outside stage 1 leave their increments unset.
/// \param kinetic, kinetic1 Kinetic energy per mass, before and after; extent 0: not carried.
void sweptGather(Input const &in, Classes const &classes, View<double *> const &kinetic, RemapWork const &work,
                 View<double *[num_pair_fields]> const &record1, View<double *> const &kinetic1);

/// Velocities of all dof nodes after stage 1: v + sum of increments / new nodal mass, summed over the cells around.
void sweptMomentum(Input const &in, Classes const &classes, RemapWork const &work,
                   View<double *[num_pair_fields]> const &record1, View<double *[2]> const &velocity1);

} // namespace RemapDetail
} // namespace Harmos

#endif
