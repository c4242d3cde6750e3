// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DONORS_HPP
#define HARMOS_DONORS_HPP

#include <detail/Harmos_CornerRotation.hpp>
#include <detail/Harmos_RemapClasses.hpp>
#include <detail/Harmos_SweptStage.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// State of the pairs between the stages.
struct StageState
{
  View<double *[num_pair_fields]> record; // num_pairs
  View<double *> kinetic;                 // num_pairs: kinetic energy per mass; extent 0: not carried through stage 1
  View<double *[2]> velocity;             // num_dof_nodes

  KOKKOS_INLINE_FUNCTION double kineticEnergy(CellMaterialPairs const &pairs, int pair) const
  {
    return kinetic.extent(0) > 0 ? kinetic(pair) : cornerKineticEnergy(pairs, velocity, pair);
  }
};

/// Fields of stage 2: StageField and PairField in one numbering, then the velocities of the four corners.
constexpr int num_stage_fields = 16;
constexpr int first_corner_field = 8; // u, v of corner 0, 1, 2, 3

KOKKOS_INLINE_FUNCTION bool byVolume(int field)
{
  return field == DensityField || (field >= DeviatorXX && field <= DeviatorXY);
}

enum DonorKind : int
{
  MovingDonor = 0,
  QuietDonor = 1,      // nothing around its cell moves: it stays where it is, whole
  DegenerateDonor = 2, // its moved region has no area to speak of: it stays where it is, whole
  RigidDonor = 3       // no donor
};

/// The pairs of the interface cells after their move: donor = offset(interface index) + place of the pair in its cell.
struct Donors
{
  int num = 0;
  View<int *> offset; // num_interface + 1
  View<int *> pair;
  View<int *> kind;                               // DonorKind
  View<Region *> polygon;                         // moved; moving donors
  View<double *[6]> shape;                        // volume, centroid, second moments xx, xy, yy about the centroid
  View<double *[num_stage_fields][3]> polynomial; // mean, gradient
  View<double *[2]> mass_offset;                  // mass centroid - centroid

  KOKKOS_INLINE_FUNCTION int index(Input const &in, Classes const &classes, int of_pair) const
  {
    int const cell = in.pairs.cell(of_pair);
    return offset(classes.interface_index(cell)) + of_pair - in.pairs.offset(cell);
  }
};

/// Moved polygons: vertices of the filled region displaced bilinearly by the pair's own dof nodes; swept nodes stay.
Donors moveDonors(Input const &in, Classes const &classes);

/// Linear polynomials of the donors: density and deviator about the centroid, primitives about the mass centroid, from
/// least squares over the same-material pairs of the vertex neighbours, limited (Barth & Jespersen, AIAA 89-0366) at
/// all vertices of the donor's polygon to their range.
///
/// Gradients of the corner velocities come from velocities before stage 1, so that they need no wider halo.
void donorPolynomials(Input const &in, Classes const &classes, StageState const &stage, Donors const &donors);

} // namespace RemapDetail
} // namespace Harmos

#endif
