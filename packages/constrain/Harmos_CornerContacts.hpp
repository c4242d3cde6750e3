// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CORNER_CONTACTS_HPP
#define HARMOS_CORNER_CONTACTS_HPP

#include <Harmos_BondedPlaces.hpp>
#include <Harmos_ContactRows.hpp>
#include <Harmos_MirroredSamples.hpp>
#include <Harmos_NormalFit.hpp>
#include <Harmos_SegmentBearing.hpp>

namespace Harmos
{

/// A convex corner of one body and the segment of another one, or of a contact wall, below it.
struct CornerContact
{
  int face;       // segment; -1: none
  int edge[2];    // the segments before and after the corner along its outline
  int tip;        // that of the short ones between them, which touch the face, at which the corner is; -1: none
  int carrier;    // the segment whose row it is: the face, at a wall the corner's own
  int segment;    // whose pair moves the corner: the tip, or the longer edge
  Vector2 foot;   // of the corner on the face
  Vector2 normal; // unit; of the face at the foot
  double gap;     // from the foot to the corner along the face's normal, >= 0
};

/// \brief Corners of solids that stand above faces of others, or of contact walls; one of the two deforms.
///
/// Where both edges of a corner rise from a face the corner alone touches it: one row stands at its foot, with the
/// normal of the face (that of a rigid body's outline, or of the wall; else sideNormal), in the place of the rows of
/// the face's segment, of both edges and of what is pressed between them. Their rays start in the middle of facets, a
/// quarter of a cell beside the corner, and their normals are the means of face and edge, or the edge of a rigid body.
struct CornerContacts
{
  int count = 0;
  View<CornerContact *> contact;
  View<int *> of_carrier; // segments: the contact whose row each carries, `count`: none; extent 0: there is no corner
  View<int *[2]> of_edge; // segments: the contacts of the corners at their ends

  /// The contact whose row segment i carries; -1: none.
  KOKKOS_INLINE_FUNCTION int carriedBy(int i) const { return count > 0 && of_carrier(i) < count ? of_carrier(i) : -1; }

  /// Whether segment i ends in a corner that a face of the material bears.
  KOKKOS_INLINE_FUNCTION bool isBorne(View<InterfaceSegment *> const &segment, int i, int material) const
  {
    for (int end = 0; count > 0 && end < 2; ++end)
      if (of_edge(i, end) >= 0 && segment(contact(of_edge(i, end)).face).material == material)
        return true;
    return false;
  }
};

/// The corners above faces, within one cell: between two solids that are not bonded, one of them deformable, or a
/// deformable one and a contact wall, which pass each other by at most 0.02 cells in the step. Edges and face are 0.3
/// cells long at least, edges touch nothing, the outline turns by 37 to 150 degrees (from 53 on where the edges are in
/// two cells), what touches between them is at most 0.5 cells long: of a deformable corner the tip that is pressed
/// flat, of a rigid one the sides of the dent that it makes, and pieces too short for an edge beside these.
///
/// \param bonded Where bodies are bonded. \param before v^{n-1/2} \param dt Of the step [s]; 0: no motion is known.
/// \param hit Of the segments' rays: a face whose ray meets a third body bears no corner.
CornerContacts findCornerContacts(Mesh const &mesh, CellMaterialPairs const &pairs, InterfaceSegments const &segments,
                                  View<RayHit *> const &hit, SegmentBins const &bins, BodyTable const &bodies,
                                  SegmentBearing const &bearing, ConstraintOptions const &options,
                                  BondedPlaces const &bonded, Motion const &before, double dt,
                                  View<Boundary *> const &boundary, WorkArrays const &work = {});

/// Whether a corner rebounds from the face, of a body or a contact wall, that it touches.
KOKKOS_INLINE_FUNCTION bool cornerRebounds(Mesh const &mesh, View<Boundary *> const &boundary,
                                           View<PairInteraction **> const &interaction, InterfaceSegment const &corner,
                                           InterfaceSegment const &face)
{
  return (face.material < 0 ? boundary(mesh.face_boundary(face.cell, face.face)).restitution
                            : interaction(corner.material, face.material).restitution) > 0.0;
}

/// The normal of a body at a point of a segment of its outline: of the parabola through its segments around that, and
/// their images beyond slip walls (fitNormal).
KOKKOS_INLINE_FUNCTION Vector2 sideNormal(SegmentBins const &bins, SlipMirrors const &mirrors,
                                          InterfaceSegment const &s, Vector2 const &point)
{
  FitSamples samples;
  double const inverse_h = 1.0 / s.cell_size;
  double part[SlipMirrors::most];
  bool known = false;
  forEachWithImages(bins, mirrors, point, fit_reach * s.cell_size,
                    [&](BinnedSegment const &other, int image)
                    {
                      if (image >= 0 && !known) // the segments themselves come first
                        smoothParts(mirrors, samples, point, s.cell_size, s.normal, part);
                      known = image >= 0;
                      double const counts = image < 0 ? 1.0 : part[image];
                      Vector2 const offset = inverse_h * (other.midpoint - point);
                      double const kernel = 1.0 - dot(offset, offset) / (fit_reach * fit_reach);
                      if (other.material != s.material || !(kernel > 0.0) || !(counts > 0.0) ||
                          dot(other.normal, s.normal) < fit_least_cosine)
                        return;
                      double const length = inverse_h * other.length;
                      samples.push({offset, other.normal, length, counts * length * kernel * kernel, 0.0, 0});
                    });
  return fitNormal(samples, s.normal, true);
}

} // namespace Harmos

#endif
