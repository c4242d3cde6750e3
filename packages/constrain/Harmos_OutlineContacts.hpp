// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_OUTLINE_CONTACTS_HPP
#define HARMOS_OUTLINE_CONTACTS_HPP

#include <Harmos_Shape.hpp>

#include <vector>

namespace Harmos
{

/// What comes near something: the outer circle of a round shape, or a corner (a circle of radius zero).
struct OutlineFeature
{
  int number; // of the corner; outer_circle
  Vector2 centre;
  double radius;
  Vector2 side[2]; // corner: unit vectors along the sides that meet there, away from it
};

constexpr int outer_circle = -1;

/// A corner lies on a surface where neither of its sides dips below it by more than this (the sine of the angle).
constexpr double corner_dip = 0.7;

/// Whether a corner may lie on a surface of outward normal n; circles may on any.
KOKKOS_INLINE_FUNCTION bool mayLieOn(OutlineFeature const &f, Vector2 const &n)
{
  return f.number == outer_circle || (dot(f.side[0], n) >= -corner_dip && dot(f.side[1], n) >= -corner_dip);
}

/// The outer circle, or the convex corners; a half-plane has none.
std::vector<OutlineFeature> outlineFeatures(Shape const &shape);

/// Which parts of two outlines face each other: stays valid when both move.
struct OutlinePlace
{
  int feature; // of shape a: outer_circle or a corner
  int surface; // of shape b: half-plane 0; polygon of n corners: edge, n + corner; disc, annulus: 0 outer circle, 1
               // hole, 2.. fixed directions in the hole
};

/// The distance at such a place.
struct OutlineGap
{
  Vector2 point;  // of a
  Vector2 normal; // unit, from a to b
  double gap;     // along it; negative: overlap [length]
};

/// Signed distance from the feature of a, its point nearest to b, to the surface of b at their present poses: for
/// circles of radii r, R at a distance d of their centres d - r - R, within a hole R - r - d, for edges n.(x - x_edge)
/// - r. [length]
OutlineGap outlineGap(Shape const &a, Shape const &b, OutlinePlace const &place);

/// How far the feature's centre can leave the middle of what holds it all around: R - r for a circle in a hole, no
/// limit elsewhere. [length]
double clearance(Shape const &a, Shape const &b, OutlinePlace const &place);

/// \brief Where features of shape a lie within `reach` of surfaces of shape b: all places at which the two may touch,
///        together with those of b on a.
///
/// Exact for discs, annuli, polygons and half-planes: a circle on a straight edge has one, at its foot; on a convex
/// corner one; two circles one, on the line of centres; a circle in a hole that one and six in fixed directions (a pin
/// that fills its hole touches all around); a corner one for each edge before it. Deeper overlaps than `reach` count
/// for nothing; a corner within a thin body belongs to the nearer side.
///
/// \param circles Whether a's circle on b's circle counts (else it is found with the shapes swapped).
std::vector<OutlinePlace> outlinePlaces(Shape const &a, Shape const &b, double reach, bool circles);

} // namespace Harmos

#endif
