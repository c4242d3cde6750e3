// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Deck.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

double AxisSpec::position(int i) const
{
  if (i <= 0)
    return from;
  if (i >= cells)
    return to;
  double part = static_cast<double>(i) / cells;
  if (grading != 1.0 && cells > 1)
  {
    // Sizes h r^k with r^(cells - 1) = grading: the first i of them over all, (r^i - 1) / (r^cells - 1).
    double const log_ratio = std::log(grading) / (cells - 1);
    part = std::expm1(i * log_ratio) / std::expm1(cells * log_ratio);
  }
  return from + part * (to - from);
}

double AxisSpec::smallestCell() const
{
  return std::min(position(1) - position(0), position(cells) - position(cells - 1));
}

Material Deck::fieldMaterial(int field) const
{
  FieldSpec const &spec = fields[field];
  Material law = laws[spec.law].law;
  law.rigid_body = spec.rigid_body;
  return law;
}

std::vector<Vector2> outlinePoints(ShapeSpec const &shape)
{
  std::vector<Vector2> points = shape.points;
  if (shape.kind == ShapeKind::Rectangle)
  {
    Vector2 const half = 0.5 * shape.size;
    points = {shape.center + Vector2{-half[0], -half[1]}, shape.center + Vector2{half[0], -half[1]},
              shape.center + half, shape.center + Vector2{-half[0], half[1]}};
  }
  if (shape.angle != 0.0)
  {
    double const c = std::cos(shape.angle), s = std::sin(shape.angle);
    for (Vector2 &p : points)
    {
      Vector2 const d = p - shape.center;
      p = shape.center + Vector2{c * d[0] - s * d[1], s * d[0] + c * d[1]};
    }
  }
  for (Vector2 &p : points)
    p += shape.shift;
  return points;
}

} // namespace Harmos
