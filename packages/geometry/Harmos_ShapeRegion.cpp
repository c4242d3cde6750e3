// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ShapeRegion.hpp>

#include <stdexcept>
#include <string>
#include <utility>

namespace Harmos
{

namespace
{

using Convex = Polygon<ShapeRegion::capacity>;

Plane2 reversed(Plane2 const &line)
{
  return {-line.normal, -line.offset};
}

Convex clipped(Convex const &polygon, Plane2 const &line)
{
  Convex result;
  if (!clip(polygon, line, result))
    throw std::runtime_error("ShapeRegion: a convex piece has more than " + std::to_string(ShapeRegion::capacity) +
                             " vertices");
  // Touching along an edge may leave a polygon without area.
  if (!(area(result) > 0.0))
    result.size = 0;
  return result;
}

} // namespace

ShapeRegion::ShapeRegion(Quadrilateral const &cell) : origin_(cell[0]), box_(boundingBox(cell))
{
  Term term;
  term.sign = 1.0;
  term.has_disc = false;
  term.disc = {{0.0, 0.0}, 0.0};
  for (int k = 0; k < cell.size; ++k)
    term.polygon.push(cell[k] - origin_);
  terms_.push_back(term);
}

std::vector<Plane2> ShapeRegion::lines(Shape const &shape, std::vector<int> const &piece) const
{
  if (shape.kind == Shape::Kind::HalfPlane)
    return {Plane2{shape.normal, dot(shape.normal, shape.centre - origin_)}};
  std::vector<Plane2> result;
  for (std::size_t i = 0; i < piece.size(); ++i)
    result.push_back(
        edgeLine(shape.points[piece[i]] - origin_, shape.points[piece[i + 1 == piece.size() ? 0 : i + 1]] - origin_));
  return result;
}

bool ShapeRegion::mayMeet(Shape const &shape, std::vector<int> const &piece) const
{
  if (piece.empty())
    return true;
  Box box{shape.points[piece[0]], shape.points[piece[0]]};
  for (int const i : piece)
    for (int d = 0; d < 2; ++d)
    {
      box.low[d] = Math::min(box.low[d], shape.points[i][d]);
      box.high[d] = Math::max(box.high[d], shape.points[i][d]);
    }
  return box.meets(box_);
}

void ShapeRegion::appendIntersection(Term const &term, Disc const &disc, double factor, std::vector<Term> &result)
{
  if (isOutside(term.polygon, disc))
    return;
  Term piece = term;
  piece.sign *= factor;
  if (isInside(term.polygon, disc))
  {
    result.push_back(piece);
    return;
  }
  double const distance = term.has_disc ? norm(disc.centre - term.disc.centre) : 0.0;
  if (!term.has_disc || distance + disc.radius <= term.disc.radius)
  {
    piece.has_disc = true;
    piece.disc = disc;
    result.push_back(piece);
    return;
  }
  if (distance + term.disc.radius <= disc.radius)
  {
    result.push_back(piece);
    return;
  }
  if (distance >= disc.radius + term.disc.radius)
    return;
  // { x : power of term.disc >= power of disc }, where term.disc is the intersection.
  Vector2 const apart = term.disc.centre - disc.centre;
  Plane2 const axis{2.0 * apart, dot(apart, term.disc.centre + disc.centre) +
                                     (disc.radius - term.disc.radius) * (disc.radius + term.disc.radius)};
  piece.polygon = clipped(term.polygon, axis);
  if (!piece.polygon.empty())
    result.push_back(piece);
  piece.polygon = clipped(term.polygon, reversed(axis));
  piece.disc = disc;
  if (!piece.polygon.empty())
    result.push_back(piece);
}

void ShapeRegion::intersect(Shape const &shape)
{
  std::vector<Term> result;
  if (shape.kind == Shape::Kind::Disc || shape.kind == Shape::Kind::Annulus)
  {
    for (Term const &term : terms_)
    {
      appendIntersection(term, relative(shape.centre, shape.outer_radius), 1.0, result);
      if (shape.kind == Shape::Kind::Annulus)
        appendIntersection(term, relative(shape.centre, shape.inner_radius), -1.0, result);
    }
  }
  else
  {
    for (std::vector<int> const &piece : shape.pieces)
    {
      if (!mayMeet(shape, piece))
        continue;
      std::vector<Plane2> const sides = lines(shape, piece);
      for (Term term : terms_)
      {
        for (Plane2 const &side : sides)
          term.polygon = clipped(term.polygon, side);
        if (!term.polygon.empty())
          result.push_back(term);
      }
    }
  }
  terms_ = std::move(result);
}

void ShapeRegion::subtract(Shape const &shape)
{
  if (shape.kind == Shape::Kind::Disc || shape.kind == Shape::Kind::Annulus)
  {
    std::vector<Term> result;
    Disc const outer = relative(shape.centre, shape.outer_radius);
    for (Term const &term : terms_)
    {
      if (!isInside(term.polygon, outer))
      {
        result.push_back(term);
        appendIntersection(term, outer, -1.0, result);
      }
      if (shape.kind == Shape::Kind::Annulus)
        appendIntersection(term, relative(shape.centre, shape.inner_radius), 1.0, result);
    }
    terms_ = std::move(result);
    return;
  }
  for (std::vector<int> const &piece : shape.pieces)
  {
    if (!mayMeet(shape, piece))
      continue;
    std::vector<Plane2> const sides = lines(shape, piece);
    std::vector<Term> result;
    for (Term const &term : terms_)
    {
      Term rest = term;
      for (Plane2 const &side : sides)
      {
        Term beyond = rest;
        beyond.polygon = clipped(rest.polygon, reversed(side));
        if (!beyond.polygon.empty())
          result.push_back(beyond);
        rest.polygon = clipped(rest.polygon, side);
      }
    }
    terms_ = std::move(result);
  }
}

template <int Order>
Moments<Order> ShapeRegion::planeMoments() const
{
  Moments<Order> sum;
  for (Term const &term : terms_)
  {
    Vector2 const first = term.polygon[0];
    Moments<Order> const m = term.has_disc ? discMoments<Order>(term.polygon, term.disc)
                                           : shifted(Harmos::moments<Order>(term.polygon, first), first);
    for (int i = 0; i < Moments<Order>::count; ++i)
      sum.value[i] += term.sign * m.value[i];
  }
  return sum;
}

Moments<1> ShapeRegion::moments(Geometry geometry) const
{
  return geometry == Geometry::Planar ? planeMoments<1>()
                                      : weighted<1>(planeMoments<2>(), areaWeight(geometry, origin_));
}

} // namespace Harmos
