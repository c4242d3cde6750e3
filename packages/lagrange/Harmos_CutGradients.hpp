// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CUT_GRADIENTS_HPP
#define HARMOS_CUT_GRADIENTS_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_FilledRegions.hpp>
#include <Harmos_Material.hpp>

namespace Harmos
{

/// Where the stress of a pair of a cut cell acts (kinematics `xfem`).
enum class CutCellStress
{
  CellMean,     // along the mean gradients of its cell
  Fluids,       // of materials without strength over what they fill, of the others along their cell's means
  FullCells,    // of fluids over what they fill, of solids as far as the cell is full (fullness)
  FilledRegions // over what each material fills
};

/// Whether a material's stress acts over what it fills, somewhere at least; rigid ones have none.
KOKKOS_INLINE_FUNCTION bool actsOnFilledRegion(CutCellStress where, Material const &material)
{
  return material.rigid_body < 0 && (where == CutCellStress::FilledRegions || where == CutCellStress::FullCells ||
                                     (where == CutCellStress::Fluids && material.strength == StrengthKind::None));
}

/// Whether it does so in full cells alone.
KOKKOS_INLINE_FUNCTION bool actsInFullCells(CutCellStress where, Material const &material)
{
  return where == CutCellStress::FullCells && material.strength != StrengthKind::None;
}

/// Columns of CutGradients::gradient: three a corner I.
enum CutGradientColumn : int
{
  CutGradientX = 0, // d N_I / dx (axisymmetric: d N_I / dr) [1/length]
  CutGradientY = 1, // d N_I / dy (d N_I / dz)
  CutHoop = 2       // axisymmetric: N_I / r; planar: zero
};

/// Columns of CutGradients::lost_extent.
enum LostExtentColumn : int
{
  LostExtentXX = 0,
  LostExtentXY = 1,
  LostExtentYY = 2
};

/// What the means of the shape functions' gradients over a filled region have beyond those over its cell.
struct CutGradients
{
  View<int *> first_row;         // by cell: row of its first pair; -1: cells' means for all; extent 0: so everywhere
  View<double *[12]> gradient;   // by row, 3 I + CutGradientColumn; rows follow the pairs of a cell [1/length]
  View<double *[3]> lost_extent; // by row: what the square of the extent of the region lacks of its cell's [length^2]
  View<double *[7]> extent;      // scratch of computeCutGradients
};

/// Part of a cell below which the gradient of a solid that is worn, or beside void, goes back to the cell's mean, in
/// proportion: the nodes of a tip are held by hardly anything, and would stretch it without bound.
constexpr double least_whole_part = 0.02;

/// Strain (of volume, or equivalent plastic) up to which a tip is intact and keeps its own gradient whatever its size,
/// and from which it is worn; between them in proportion.
constexpr double intact_strain = 0.05, worn_strain = 0.15;

/// |V / (m s) - 1|, the volume V of a region against that of its mass m at its specific volume s, up to which an intact
/// solid beside void keeps the gradient of its cell's mean, and from which it has its own; between them in proportion.
constexpr double borne_drift = 0.003, most_drift = 0.01;

/// Void, of the cell, beside which an intact tip is as a worn one; in proportion below.
constexpr double most_void_beside_tip = 1e-3;

/// Gradients of the filled regions of materials whose stress acts over them (actsOnFilledRegion), less those of their
/// cells; the rows of the others are not written.
///
/// A material's stress acts on its part of a cut cell alone, and its strain is that of its part: the gradient is
///
///   B_I = (1 / V) dV / dx_I,
///
/// V the volume of the filled region as the remap moves it: vertices with the bilinear motion of the cell, edges inside
/// it bent in the middle as far as the cell is full (edgeWeights). The contact rows have the same weights, so that work
/// at the interface, stress and moved regions speak of one change of volume. With the cell's mean in its place a
/// uniform pressure p drives the nodes at an oblique interface by O(p h) against the tractions on the segments, which
/// knows nothing of h: gases at rest stream, and squeezed solids lose their pressure, since regions are squeezed where
/// the mean strain of their cells is none. About an axis B_I holds the hoop's part N_I / r, which is the integral of
/// N_I over the region. Sum over I: zero, and the hoop's the area over the ring's volume.
///
/// In full cells alone (actsInFullCells) what is stored is the fullness w of the cell times that: the gradient is
/// (1 - w) times the cell's mean and w times the region's, continuous where void opens. A region below
/// least_whole_part of its cell that is worn (worn_strain), or beside void (most_void_beside_tip), has less of it, in
/// proportion. Beside void, where w is none, the two volumes of a solid follow two gradients: V, which is moved, that
/// of the region, s that of the cell, and relative velocities of the hourglass kind stretch the region without a
/// stress (the toe of a block that sticks on an incline went to 0.75 of the density of its pressure, and slid on). So
/// in cells of several materials an intact solid whose volumes have drifted apart (borne_drift, most_drift) has its own
/// gradient beside void as well.
///
/// The two sides of a film may be moved in unequal pieces (one edge beside a block, two beside a rigid body's corner):
/// to its thin volume the difference is a gradient without bound, whose viscosity tears it. Means of gradients are at
/// most those of the shape functions: the difference from the cell's is scaled down to three times the longest side
/// over the area, where it is larger (hoop's part included).
///
/// `lost_extent` is E_cell - E_m, E = 12 / A times the second moments of an area A about its centroid: n . E n is the
/// square of the extent along n (of a rectangle along its sides). That of a region, E_m, is lengthened along its axes
/// by what continues it beyond the faces it lies on (its image at slip walls), up to that of its cell. Artificial
/// viscosity works over it: the velocities of a film's sides differ by its thickness times the gradient. Of solids it
/// counts as far as B_I does. A region without a volume has no extent.
///
/// \param record By pair (PairField): specific volume and plastic strain say what is worn, with the mass what drifted.
/// \param boundary Whose slip walls show a region its image; none given, none do.
/// \param shortest_bent_edge Of the cell size; that of bendOf.
/// \param cut Out. Regions below 1e-6 of their cell's volume have the cell's mean.
///
/// Moes, Dolbow & Belytschko, Int. J. Numer. Meth. Engng 46 (1999) 131: integrals over the parts of a cut element.
void computeCutGradients(Mesh const &mesh, CellMaterialPairs const &pairs,
                         View<double *[num_pair_fields]> const &record, FilledRegions const &regions,
                         View<Material *> const &materials, BoundaryConditions const &boundary, CutCellStress where,
                         double shortest_bent_edge, CutGradients &cut);

} // namespace Harmos

#endif
