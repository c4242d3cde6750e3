// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DONORS_HPP
#define HARMOS_DONORS_HPP

#include <detail/Harmos_RemapClasses.hpp>
#include <detail/Harmos_StageFields.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// State of the pairs between the stages.
struct StageState
{
  View<double *[num_pair_fields]> record; // num_pairs
  View<double *> kinetic;                 // num_pairs: KineticField; extent 0: not carried through stage 1
  View<double *[2]> velocity;             // num_dof_nodes
  View<double *[8]> corner;               // num_cells; extent 0: only one stage. Velocities as the pure cells have them
  View<double *[2]> own_part;             // num_dof_nodes: part of v^{n+1/2} less the node's that mixed cells have

  KOKKOS_INLINE_FUNCTION double kineticEnergy(Input const &in, int pair) const
  {
    return kinetic.extent(0) > 0 ? kinetic(pair) : cornerKineticEnergy(in.share, in.pairs, velocity, pair);
  }

  /// Velocity at corner k of a pair after stage 1. At a node that stage 1 touches and stage 2 finishes each cell around
  /// has its own, which `corner` and `own_part` are set for (SweptNodes).
  KOKKOS_INLINE_FUNCTION Vector2 cornerVelocity(Input const &in, Classes const &classes, int pair, int k) const
  {
    int const cell = in.pairs.cell(pair), node = in.mesh.cell_node(cell, k), dof = in.pairs.dof_node(pair, k);
    Vector2 const mean{velocity(dof, 0), velocity(dof, 1)};
    if (corner.extent(0) == 0 || classes.node_final(node) != 0 || classes.node_sweep(node) != SpecialNode)
      return mean;
    if (classes.pure_material(cell) >= 0)
      return {corner(cell, 2 * k), corner(cell, 2 * k + 1)};
    return {mean[0] + own_part(dof, 0) * (in.half(dof, 0) - mean[0]),
            mean[1] + own_part(dof, 1) * (in.half(dof, 1) - mean[1])};
  }

  KOKKOS_INLINE_FUNCTION void cornerVelocities(Input const &in, Classes const &classes, int pair, double *out) const
  {
    for (int k = 0; k < 4; ++k)
    {
      Vector2 const v = cornerVelocity(in, classes, pair, k);
      out[2 * k] = v[0];
      out[2 * k + 1] = v[1];
    }
  }
};

enum DonorKind : int
{
  MovingDonor = 0,
  QuietDonor = 1,      // nothing around its cell moves: it stays where it is, whole
  DegenerateDonor = 2, // its moved region has no area to speak of: it stays where it is, whole
  RigidDonor = 3       // no donor
};

/// What the acceptors around read of a donor.
struct DonorHead
{
  int pair;
  int material;
  int kind;                    // DonorKind
  double measure;              // factor of the polygon's moments that gives the donor's (partDonors)
  unsigned long long overlaps; // bit s: an overlay with the cell of slot s (NeighbourLinks)
};

/// The pairs of the interface cells after their move: donor = offset(interface index) + place of the pair in its cell.
struct Donors
{
  int num = 0;
  View<int *> offset; // num_interface + 1
  View<DonorHead *> head;
  View<Region *> polygon;  // moved; moving donors
  View<double *[8]> shape; // volume, centroid, second moments xx, xy, yy about it, centre of the moved cell
  View<double *[num_stage_fields]> value;                      // density and primitives, corner velocities
  View<double * [num_stage_fields - first_corner_field]> half; // corner velocities before stage 1

  /// The donor of a material in an interface cell, or -1.
  KOKKOS_INLINE_FUNCTION int find(int index, int material) const
  {
    for (int donor = offset(index); donor < offset(index + 1); ++donor)
      if (head(donor).material == material)
        return donor;
    return -1;
  }
};

/// Velocities at the corners of a pair, as stage fields are ordered.
KOKKOS_INLINE_FUNCTION void cornerVelocities(CellMaterialPairs const &pairs, View<double *[2]> const &velocity,
                                             int pair, double *out)
{
  for (int k = 0; k < 4; ++k)
  {
    int const dof = pairs.dof_node(pair, k);
    out[2 * k] = velocity(dof, 0);
    out[2 * k + 1] = velocity(dof, 1);
  }
}

/// Whether c and d lie on different sides of the line from a to b, by more than `least` [length^2]: twice an area.
KOKKOS_INLINE_FUNCTION bool apartOn(Vector2 const &a, Vector2 const &b, Vector2 const &c, Vector2 const &d,
                                    double least)
{
  double const of_c = cross(b - a, c - a), of_d = cross(b - a, d - a);
  return (of_c > least && of_d < -least) || (of_c < -least && of_d > least);
}

/// Whether two edges of a closed polygon cross. \param least Crossings of less do not count (apartOn).
KOKKOS_INLINE_FUNCTION bool isFolded(Region const &region, double least = 0.0)
{
  bool concave = false;
  for (int i = 0; i < region.size && !concave; ++i)
  {
    Vector2 const b = region[region.next(i)];
    concave = cross(b - region[i], region[region.next(region.next(i))] - b) < 0.0;
  }
  if (!concave)
    return false;
  for (int i = 0; i < region.size; ++i)
    for (int j = i + 2; j < region.size; ++j)
    {
      if (i == 0 && j == region.size - 1)
        continue;
      Vector2 const a = region[i], b = region[region.next(i)], c = region[j], d = region[region.next(j)];
      if (apartOn(c, d, a, b, least) && apartOn(a, b, c, d, least))
        return true;
    }
  return false;
}

/// Moved polygons: vertices of the filled region displaced bilinearly by the pair's own dof nodes; swept nodes stay.
/// The donors' values.
void moveDonors(Input const &in, Classes const &classes, StageState const &stage, Donors &donors);

/// The polygons that moveDonors leaves out, after it: quiet donors where they are, rigid bodies' filled regions moved
/// with their dof nodes, degenerate donors without vertices.
void moveOtherRegions(Input const &in, Classes const &classes, Donors const &donors);

} // namespace RemapDetail
} // namespace Harmos

#endif
