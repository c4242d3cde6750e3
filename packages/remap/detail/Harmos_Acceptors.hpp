// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ACCEPTORS_HPP
#define HARMOS_ACCEPTORS_HPP

#include <detail/Harmos_OverlayMoments.hpp>
#include <detail/Harmos_Overlays.hpp>

namespace Harmos
{
namespace RemapDetail
{

constexpr int most_candidates = 2 * max_components; // of a cell

/// Candidates for the new pairs of the interface cells, materials ascending: begin(i) .. end(i) - 1 of cell i.
struct Acceptors
{
  int room = 3;         // of every cell; grows where it is not enough
  View<int *> count;    // num_interface
  View<int *> material; // candidates
  View<int *> verbatim; // num_interface: 1 where nothing around moves: the cell keeps its bits
  View<int *> merge_to; // candidate that takes this fragment, or -1
  View<double *[num_overlay_sums]> sum;
  View<double *[num_pair_fields]> record; // new records
  View<double *> kinetic;                 // KineticField: kinetic energy per mass that the new pair should have
  View<double *[2]> centroid;
  View<double *[8]> corner_velocity;

  KOKKOS_INLINE_FUNCTION int begin(int index) const { return index * room; }
  KOKKOS_INLINE_FUNCTION int end(int index) const { return index * room + count(index); }

  KOKKOS_INLINE_FUNCTION int find(int index, int of_material) const
  {
    for (int c = begin(index); c < end(index); ++c)
      if (material(c) == of_material)
        return c;
    return -1;
  }
};

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

/// Volume and first moments, weighted with the radius about an axis, about the acceptor's corner 0, of what comes in.
KOKKOS_INLINE_FUNCTION Moments<1> inflowMoments(Mesh const &mesh, int acceptor, Quadrilateral const &q)
{
  Vector2 const origin = acceptorOrigin(mesh, acceptor);
  double x[4], y[4];
  for (int k = 0; k < 4; ++k)
  {
    x[k] = q[k][0] - origin[0];
    y[k] = q[k][1] - origin[1];
  }
  bool whole;
  Moments<2> const m = momentsInside<Moments<2>, 4>(4, x, y, windowAbout(mesh, acceptor, origin), whole);
  Moments<2> const plane = whole ? momentsOfVertices<Moments<2>>(4, x, y) : m;
  return weighted<1>(plane, areaWeight(mesh.geometry, origin));
}

/// Find the materials of every interface cell after the remap, those of its overlays, of what flows in, of rigid
/// bodies, and sum the overlays, residues and inflows of each, in ascending order of donors. \return The number of
/// fragments (below merge_below).
int accumulate(Input const &in, Classes const &classes, Donors const &donors, Overlays const &overlays,
               Acceptors &acceptors, Bookings const &bookings);

/// Fragments move to the same-material neighbour with the largest volume fraction.
void mergeFragments(Input const &in, Classes const &classes, Acceptors const &acceptors, Bookings const &bookings);

/// Volume fractions (overlap and void policies), centroids, records and corner velocities of the candidates.
void finish(Input const &in, Classes const &classes, StageState const &stage, Acceptors const &acceptors,
            Bookings const &bookings);

} // namespace RemapDetail
} // namespace Harmos

#endif
