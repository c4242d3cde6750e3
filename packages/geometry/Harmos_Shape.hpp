// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SHAPE_HPP
#define HARMOS_SHAPE_HPP

#include <Harmos_AreaWeight.hpp>
#include <Harmos_Bilinear.hpp>
#include <Harmos_DiscMoments.hpp>

#include <vector>

namespace Harmos
{

/// An axis-aligned box, possibly infinite.
struct Box
{
  Vector2 low;
  Vector2 high;

  KOKKOS_INLINE_FUNCTION bool meets(Box const &b) const
  {
    return low[0] <= b.high[0] && b.low[0] <= high[0] && low[1] <= b.high[1] && b.low[1] <= high[1];
  }
};

template <int Capacity>
KOKKOS_INLINE_FUNCTION Box boundingBox(Polygon<Capacity> const &p)
{
  Box box{p[0], p[0]};
  for (int i = 1; i < p.size; ++i)
    for (int d = 0; d < 2; ++d)
    {
      box.low[d] = Math::min(box.low[d], p[i][d]);
      box.high[d] = Math::max(box.high[d], p[i][d]);
    }
  return box;
}

/// How a cell lies to a shape. `Cut` may also be said of a cell that only comes near the boundary.
enum class CellPosition
{
  Outside,
  Inside,
  Cut
};

/// A body's outline. Host values, lengths in metres; made by the factories below and moved as a rigid body.
///
/// Rectangles and polygons are disjoint convex pieces, discs and annuli one or two circles, a half-plane one line: all
/// set operations (Harmos_ShapeRegion.hpp) need no more than these.
struct Shape
{
  enum class Kind
  {
    Rectangle,
    Disc,
    Annulus,
    Polygon,
    HalfPlane
  };

  Kind kind = Kind::Rectangle;
  std::vector<Vector2> points;          // rectangle, polygon: corners, counter-clockwise
  std::vector<std::vector<int>> pieces; // disjoint convex pieces that make up the polygon: indices into `points`
  Vector2 centre = {0.0, 0.0};          // centroid; half-plane: a point on its edge
  double inner_radius = 0.0;            // annulus
  double outer_radius = 0.0;            // disc, annulus
  Vector2 normal = {0.0, 0.0};          // half-plane: unit vector that leaves it

  /// \param size Width and height, > 0. \param angle About the centre, counter-clockwise. [rad]
  /// Throws std::invalid_argument, as all factories do where a size is not positive or a number is not finite.
  static Shape rectangle(Vector2 const &centre, Vector2 const &size, double angle = 0.0);
  static Shape disc(Vector2 const &centre, double radius);
  /// 0 < inner < outer.
  static Shape annulus(Vector2 const &centre, double inner_radius, double outer_radius);
  /// Any simple polygon, either orientation; throws where it meets itself or its area vanishes.
  static Shape polygon(std::vector<Vector2> const &points);
  /// The points x with dot(normal, x - point) <= 0; `normal` of any length but zero.
  static Shape halfPlane(Vector2 const &point, Vector2 const &normal);

  /// The shape turned by `angle` about its centroid (half-plane: its point), which moves by `displacement`.
  Shape moved(Vector2 const &displacement, double angle) const;

  /// Boundary points count as inside.
  bool contains(Vector2 const &x) const;
  /// Infinite in the directions in which a half-plane is.
  Box boundingBox() const;
  /// [m^2]; infinite for a half-plane.
  double area() const;
  /// The area, or per radian the volume of the ring that the part at r > 0 sweeps [m^3]; infinite for a half-plane.
  double volume(Geometry geometry) const;
  Vector2 centroid() const { return centre; }
  /// Polar second moment of area about the centroid, integral of |x - centroid|^2. [m^4]; infinite for a half-plane.
  double inertia() const;
  /// A polygon of the same area, counter-clockwise: the corners, or for a disc the regular polygon with `sides` sides;
  /// for an annulus the outer one, then the inner one clockwise, joined by a slit. Throws std::invalid_argument for a
  /// half-plane or fewer than 3 sides.
  std::vector<Vector2> outline(int sides = 256) const;

  /// A quick answer for most cells: Inside and Outside are sure (to round-off).
  CellPosition position(Quadrilateral const &cell) const;

  /// Moments of the convex cell ∩ this shape about the cell's corner 0, with the geometry's weight, in closed form
  /// (round-off alone). The centroid in space is cell[0] + moments.centroid().
  Moments<1> intersectionMoments(Quadrilateral const &cell, Geometry geometry = Geometry::Planar) const;
};

} // namespace Harmos

#endif
