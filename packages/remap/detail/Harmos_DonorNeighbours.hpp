// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DONOR_NEIGHBOURS_HPP
#define HARMOS_DONOR_NEIGHBOURS_HPP

#include <detail/Harmos_Donors.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// What lies around a donor: the same material's pairs in the vertex neighbours of its cell, and what the mirrors of
/// slip walls show of them.
struct DonorNeighbours
{
  Input in;
  Classes classes;
  StageState stage;
  Donors donors;

  /// A same-material pair of a neighbour between the stages.
  struct Neighbour
  {
    StageFields value; // corner velocities before stage 1, in the order of the donor's corners
    double filled;     // part of its cell before the move: that of the target cell would make the weights lopsided
    Vector2 centroid;
    Vector2 centre; // of its cell
  };

  KOKKOS_INLINE_FUNCTION Vector2 cellCentre(int donor) const
  {
    return {donors.shape(donor, 6), donors.shape(donor, 7)};
  }

  KOKKOS_INLINE_FUNCTION bool fromDonor(int index, int material, int rotation, Neighbour &n) const
  {
    int const other = donors.find(index, material);
    if (other < 0)
      return false;
    n.filled = in.state.record(donors.head(other).pair, VolumeFraction);
    n.centroid = {donors.shape(other, 1), donors.shape(other, 2)};
    n.centre = cellCentre(other);
    n.value = {FieldPack(&donors.value(other, 0)), rotatedCorners(&donors.half(other, 0), rotation)};
    return true;
  }

  /// A pure cell that is at home.
  KOKKOS_INLINE_FUNCTION bool fromCell(int cell, int material, int rotation, Neighbour &n) const
  {
    if (classes.pure_material(cell) != material)
      return false;
    int const pair = in.pairs.offset(cell);
    n.filled = 1.0;
    n.centroid = n.centre = cellCentroid(in.mesh, cell);
    FieldPack record(&stage.record(pair, 0));
    record.set<DensityField>(stage.record(pair, Mass) / in.mesh.cell_volume(cell));
    record.set<KineticField>(stage.kineticEnergy(in, pair));
    double corner[8];
    cornerVelocities(in.pairs, in.half, pair, corner);
    n.value = {record, rotatedCorners(corner, rotation)};
    return true;
  }

  KOKKOS_INLINE_FUNCTION bool isBeyondFace(int cell, int neighbour) const
  {
    bool any = false;
    for (int k = 0; k < 4; ++k)
      any = any || (in.mesh.face_neighbour(cell, k) >= 0 && in.mesh.face_neighbour(cell, k) / 4 == neighbour);
    return any;
  }

  /// What the same material holds in item j of the cells' neighbours; false where that is nothing.
  KOKKOS_INLINE_FUNCTION bool findNeighbour(int j, int material, Neighbour &n) const
  {
    int const cell = in.mesh.cell_neighbour.item(j);
    int const index = classes.interface_index(cell);
    int const rotation = in.links.rotation(j);
    return index >= 0 ? fromDonor(index, material, rotation, n) : fromCell(cell, material, rotation, n);
  }

  /// visit(what is there, item of mesh.cell_neighbour or -1 for the donor itself, mirror) for the images of the
  /// material in a donor's cell and around it beyond slip walls. \param q Of the donor, with its corner velocities
  /// before stage 1.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forImages(int cell, int donor, StageFields const &q, Visitor const &visit) const
  {
    forMirroredNeighbours(in.mesh, in.mirrors(), cell,
                          [&](int j, MirrorImage const &image)
                          {
                            Neighbour n;
                            if (j < 0)
                              n = {q,
                                   in.state.record(donors.head(donor).pair, VolumeFraction),
                                   {donors.shape(donor, 1), donors.shape(donor, 2)},
                                   cellCentre(donor)};
                            else if (!findNeighbour(j, donors.head(donor).material, n))
                              return;
                            for (int i = 0; i < image.count; ++i)
                              mirrorFields(n.value, image.normal[i], image.face[i]);
                            n.centroid = image.point(n.centroid);
                            n.centre = image.point(n.centre);
                            visit(n, j, image);
                          });
  }

  /// Whether the mesh ends at a face of a cell, and the fields with it.
  KOKKOS_INLINE_FUNCTION bool fieldsEndAt(int cell, int k) const
  {
    return in.mesh.face_neighbour(cell, k) < 0 &&
           !(in.options.mirrored_walls && SlipMirrors::isSlip(in.mesh, in.conditions.boundary, cell, k));
  }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
