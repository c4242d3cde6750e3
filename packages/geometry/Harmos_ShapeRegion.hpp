// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SHAPE_REGION_HPP
#define HARMOS_SHAPE_REGION_HPP

#include <Harmos_Shape.hpp>

#include <vector>

namespace Harmos
{

/// The part of a convex cell that a chain of intersections with shapes and cuts by shapes leaves.
///
/// Its indicator function is kept as a signed sum of indicators of (convex polygon ∩ at most one disc), a form that is
/// closed under both operations, exactly:
///   - a polygon is intersected or split along the lines of convex pieces;
///   - two discs: on the side of their radical axis where the power of disc 1 is the larger, disc 1 ∩ disc 2 = disc 1;
///   on the
///     other side it is disc 2;
///   - a disc D is cut out as 1 - 1_D, an annulus as 1 - 1_outer + 1_inner.
/// So every moment is a sum of closed forms: exact to round-off for any number of shapes of any kind.
/// Aurenhammer, SIAM J. Comput. 16 (1987) 78-96 (power diagrams).
class ShapeRegion
{
public:
  /// The whole cell: convex, counter-clockwise.
  explicit ShapeRegion(Quadrilateral const &cell);

  /// Keep what lies inside `shape`.
  void intersect(Shape const &shape);
  /// Keep what lies outside `shape`.
  void subtract(Shape const &shape);

  /// About the cell's corner 0, with the geometry's weight.
  Moments<1> moments(Geometry geometry = Geometry::Planar) const;
  bool empty() const { return terms_.empty(); }

  static constexpr int capacity = 32; // vertices of a convex piece; more throw std::runtime_error

private:
  struct Term
  {
    Polygon<capacity> polygon; // relative to origin_
    double sign;
    bool has_disc;
    Disc disc; // relative to origin_
  };

  template <int Order>
  Moments<Order> planeMoments() const;
  static void appendIntersection(Term const &term, Disc const &disc, double factor, std::vector<Term> &result);
  std::vector<Plane2> lines(Shape const &shape, std::vector<int> const &piece) const;
  bool mayMeet(Shape const &shape, std::vector<int> const &piece) const;
  Disc relative(Vector2 const &centre, double radius) const { return {centre - origin_, radius}; }

  Vector2 origin_;
  Box box_; // of the cell
  std::vector<Term> terms_;
};

} // namespace Harmos

#endif
