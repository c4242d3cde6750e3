// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_GEOMETRY_TEST_TOOLS_HPP
#define HARMOS_GEOMETRY_TEST_TOOLS_HPP

#include <Harmos_Bilinear.hpp>
#include <Harmos_Clip.hpp>
#include <Harmos_Moments.hpp>

#include <random>

namespace Harmos
{

using Random = std::mt19937;

inline double uniform(Random &random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Quadrilateral box(double x0, double y0, double x1, double y1)
{
  return Quadrilateral{4, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

/// The unit square moved by a rigid shift and a shift of each corner, all uniform in +-size.
inline Quadrilateral movedSquare(Random &random, double size)
{
  Vector2 const rigid{uniform(random, -size, size), uniform(random, -size, size)};
  Quadrilateral q = box(0.0, 0.0, 1.0, 1.0);
  for (int k = 0; k < 4; ++k)
    q[k] += rigid + Vector2{uniform(random, -size, size), uniform(random, -size, size)};
  return q;
}

/// A convex counter-clockwise quadrilateral inscribed in a random ellipse.
inline Quadrilateral randomConvex(Random &random)
{
  Vector2 const centre{uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5)};
  double const a = uniform(random, 0.1, 1.0);
  double const b = uniform(random, 0.1, 1.0);
  Quadrilateral q;
  for (int k = 0; k < 4; ++k)
  {
    double const angle = 0.5 * Math::pi * (k + uniform(random, 0.0, 0.9));
    q.push(centre + Vector2{a * Math::cos(angle), b * Math::sin(angle)});
  }
  return q;
}

/// Overlay of a donor with an acceptor whose corner (i, j) is subtracted before clipping.
inline Region overlayWithUnitCell(Quadrilateral donor, int i, int j)
{
  for (int k = 0; k < 4; ++k)
    donor[k] -= Vector2{1.0 * i, 1.0 * j};
  Region overlay;
  clipConvex(donor, box(0.0, 0.0, 1.0, 1.0), overlay);
  return overlay;
}

/// Sum over the 3 x 3 unit cells around the unit square of the overlays with the donor, moments about (0, 0).
inline Moments<1> sumOfOverlays(Quadrilateral const &donor)
{
  Moments<1> sum;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i)
      sum += moments<1>(overlayWithUnitCell(donor, i, j), Vector2{-1.0 * i, -1.0 * j});
  return sum;
}

} // namespace Harmos

#endif
