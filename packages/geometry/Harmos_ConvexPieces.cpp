// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ConvexPieces.hpp>

#include <stdexcept>
#include <string>

namespace Harmos
{

namespace
{

constexpr int largest_convex_piece = 16;

double turn(Vector2 const &a, Vector2 const &b, Vector2 const &c)
{
  return cross(b - a, c - b);
}

bool onSegment(Vector2 const &a, Vector2 const &b, Vector2 const &x)
{
  return turn(a, b, x) == 0.0 && dot(x - a, x - b) <= 0.0;
}

bool segmentsMeet(Vector2 const &a, Vector2 const &b, Vector2 const &c, Vector2 const &d)
{
  double const abc = turn(a, b, c);
  double const abd = turn(a, b, d);
  double const cda = turn(c, d, a);
  double const cdb = turn(c, d, b);
  if (((abc > 0.0 && abd < 0.0) || (abc < 0.0 && abd > 0.0)) && ((cda > 0.0 && cdb < 0.0) || (cda < 0.0 && cdb > 0.0)))
    return true;
  return onSegment(a, b, c) || onSegment(a, b, d) || onSegment(c, d, a) || onSegment(c, d, b);
}

bool isConvex(std::vector<Vector2> const &points)
{
  // A simple polygon that never turns right is convex.
  int const n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i)
    if (turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0.0)
      return false;
  return true;
}

/// Sine of the turn at b below which a, b and c lie on one line: products are rounded, fused ones otherwise than
/// others.
constexpr double round_off = 1e-14;

bool onLine(Vector2 const &a, Vector2 const &b, Vector2 const &c)
{
  return Math::fabs(turn(a, b, c)) <= round_off * norm(b - a) * norm(c - b);
}

bool turnsRight(Vector2 const &a, Vector2 const &b, Vector2 const &c)
{
  return turn(a, b, c) < -round_off * norm(b - a) * norm(c - b);
}

/// Corner k of the remaining polygon can be cut off: it turns left and no other corner lies in its triangle.
bool isEar(std::vector<Vector2> const &points, std::vector<int> const &rest, int k)
{
  int const n = static_cast<int>(rest.size());
  int const before = (k + n - 1) % n;
  int const after = (k + 1) % n;
  Vector2 const a = points[rest[before]];
  Vector2 const b = points[rest[k]];
  Vector2 const c = points[rest[after]];
  if (turn(a, b, c) <= 0.0)
    return false;
  for (int i = 0; i < n; ++i)
  {
    if (i == before || i == k || i == after)
      continue;
    Vector2 const x = points[rest[i]];
    if (!turnsRight(a, b, x) && !turnsRight(b, c, x) && !turnsRight(c, a, x))
      return false;
  }
  return true;
}

} // namespace

double polygonArea(std::vector<Vector2> const &points)
{
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    twice += cross(points[i] - points[0], points[i + 1] - points[0]);
  return 0.5 * twice;
}

void requireSimple(std::vector<Vector2> const &points)
{
  int const n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i)
  {
    Vector2 const a = points[i];
    Vector2 const b = points[(i + 1) % n];
    Vector2 const c = points[(i + 2) % n];
    bool const spike = turn(a, b, c) == 0.0 && dot(b - a, c - b) < 0.0;
    int meets = spike ? (i + 1) % n : -1;
    for (int j = i + 2; j < n && meets < 0; ++j)
      if ((j + 1) % n != i && segmentsMeet(a, b, points[j], points[(j + 1) % n]))
        meets = j;
    if (meets >= 0)
      throw std::invalid_argument("polygon: edge " + std::to_string(i) + " meets edge " + std::to_string(meets) +
                                  ": a simple polygon is needed");
  }
}

std::vector<std::vector<int>> convexPieces(std::vector<Vector2> const &points)
{
  std::vector<int> rest;
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    rest.push_back(i);
  if (rest.size() <= largest_convex_piece && isConvex(points))
    return {rest};

  std::vector<std::vector<int>> pieces;
  while (rest.size() > 2)
  {
    int const n = static_cast<int>(rest.size());
    int cut = -1;
    for (int k = 0; k < n && cut < 0; ++k)
    {
      bool const straight = onLine(points[rest[(k + n - 1) % n]], points[rest[k]], points[rest[(k + 1) % n]]);
      if (straight || isEar(points, rest, k))
        cut = k;
      if (cut == k && !straight)
        pieces.push_back({rest[(k + n - 1) % n], rest[k], rest[(k + 1) % n]});
    }
    if (cut < 0)
      throw std::invalid_argument("polygon: " + std::to_string(n) +
                                  " corners cannot be cut into triangles: a simple polygon is needed");
    rest.erase(rest.begin() + cut);
  }
  return pieces;
}

} // namespace Harmos
