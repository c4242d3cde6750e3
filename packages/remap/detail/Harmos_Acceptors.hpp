// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ACCEPTORS_HPP
#define HARMOS_ACCEPTORS_HPP

#include <detail/Harmos_Overlays.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Sums that a candidate collects: the integrals of num_stage_fields, then volume and first moments (relative to the
/// cell's corner 0).
enum CandidateSum : int
{
  VolumeSum = num_stage_fields,
  FirstMomentX,
  FirstMomentY,
  num_candidate_sums
};

/// Candidates for the new pairs of the interface cells, materials ascending.
struct Acceptors
{
  int num = 0;
  View<int *> offset;                     // num_interface + 1
  View<int *> material;                   // num
  View<int *> verbatim;                   // num_interface: 1 where nothing around moves: the cell keeps its bits
  View<int *> merge_to;                   // num: candidate that takes this fragment, or -1
  View<double *[num_candidate_sums]> sum; // num
  View<double *[num_pair_fields]> record; // num: new records
  View<double *> kinetic;                 // num: kinetic energy per mass that the new pair should have
  View<double *[2]> centroid;             // num
  View<double *[8]> corner_velocity;      // num

  KOKKOS_INLINE_FUNCTION int find(int index, int of_material) const
  {
    for (int c = offset(index); c < offset(index + 1); ++c)
      if (material(c) == of_material)
        return c;
    return -1;
  }
};

/// What owned interface cells book, one column each.
enum Booking : int
{
  BookOverlap = 0,
  BookVoid,
  BookClosed,
  BookMerged,
  BookFailures,
  BookOutMass,
  BookOutKinetic,
  BookOutEnergy,
  BookOutMomentumX,
  BookOutMomentumY,
  num_bookings
};

using Bookings = View<double *[num_bookings]>;

/// Visits the cells around `cell` and itself in ascending order: a gather that adds in this order gives the same bits
/// on any number of ranks.
template <class Visitor>
KOKKOS_INLINE_FUNCTION void forCellAndNeighbours(Mesh const &mesh, int cell, Visitor const &visit)
{
  bool self = false;
  for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
  {
    int const neighbour = mesh.cell_neighbour.item(j);
    if (!self && neighbour > cell)
    {
      visit(cell);
      self = true;
    }
    visit(neighbour);
  }
  if (!self)
    visit(cell);
}

/// The material that enters through an inflow face in dt: the face a -> b swept inwards.
KOKKOS_INLINE_FUNCTION bool inflowQuadrilateral(Input const &in, int cell, int face, Boundary &boundary,
                                                Quadrilateral &q)
{
  int const number = in.mesh.face_boundary(cell, face);
  if (number < 0 || in.conditions.boundary(number).kind != BoundaryKind::Inflow)
    return false;
  boundary = in.conditions.boundary(number);
  Vector2 const a = in.node(in.mesh.cell_node(cell, face));
  Vector2 const b = in.node(in.mesh.cell_node(cell, (face + 1) % 4));
  Vector2 const u = in.dt * boundary.velocity;
  q.size = 4;
  q[0] = a;
  q[1] = b;
  q[2] = b + u;
  q[3] = a + u;
  return boundary.material >= 0 && cross(b - a, u) > 0.0;
}

/// Materials of every interface cell after the remap: those of its overlays, of what flows in, of rigid bodies.
Acceptors findCandidates(Input const &in, Classes const &classes, Donors const &donors, Overlays const &overlays,
                         Bookings const &bookings);

/// Where the donors' residues go, and what leaves through outflow boundaries (booked).
struct Residues
{
  View<int *> target;                        // donors.num: candidate, or -1
  View<double *[num_stage_fields]> integral; // donors.num
};

Residues findResidues(Input const &in, Classes const &classes, StageState const &stage, Donors const &donors,
                      Overlays const &overlays, Acceptors const &acceptors, Bookings const &bookings);

/// Sum the overlays, residues and inflows of every candidate, in ascending order of donors.
void accumulate(Input const &in, Classes const &classes, Donors const &donors, Overlays const &overlays,
                Residues const &residues, Acceptors const &acceptors, Bookings const &bookings);

/// Fragments below merge_below move to the same-material neighbour with the largest volume fraction.
void mergeFragments(Input const &in, Classes const &classes, Acceptors const &acceptors, Bookings const &bookings);

/// Volume fractions (overlap and void policies), centroids, records and corner velocities of the candidates.
void finish(Input const &in, Classes const &classes, StageState const &stage, Acceptors const &acceptors,
            Bookings const &bookings);

} // namespace RemapDetail
} // namespace Harmos

#endif
