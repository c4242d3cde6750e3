// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FRACTION_GRADIENT_HPP
#define HARMOS_FRACTION_GRADIENT_HPP

#include <Harmos_CellNeighbours.hpp>

namespace Harmos
{

/// A function on cells: the volume fraction of `inside` minus that of `outside`. Its negative gradient leaves the
/// inside. With an empty outside it is a plain volume fraction; where the two sets fill all cells around it is twice
/// that plus a constant.
struct FractionDifference
{
  ComponentSet inside, outside;

  KOKKOS_INLINE_FUNCTION double operator()(ReconstructionField const &field, CellComponents const &components,
                                           int cell) const
  {
    double const f = setFraction(field, components, inside, cell);
    return outside == 0u ? f : f - setFraction(field, components, outside, cell);
  }
};

/// A function's values at a cell and, in packs, at its vertex neighbours. Those of usual cells are stored.
struct NeighbourValues
{
  double own;
  Pack stored[CellNeighbours::stored_packs];

  template <class Function>
  KOKKOS_INLINE_FUNCTION NeighbourValues(ReconstructionField const &field, CellComponents const &components,
                                         CellNeighbours const &neighbours, Function const &f)
      : own(f(field, components, components.cell))
  {
    for (int p = 0; p < Math::min(neighbours.packs(), CellNeighbours::stored_packs); ++p)
      stored[p] = neighbours.values(f, p);
  }
};

/// Gradient at a cell by weighted least squares over its vertex neighbours: minimises
/// sum w (f_j - f_0 - g.(x_j - x_0))^2, w = 1 / |x_j - x_0|^2, x the centroids. In the cell's unit coordinates.
///
/// Exact for linear functions on any mesh. Where the neighbours lie on one line (a strip of cells) the gradient along
/// that line; zero without neighbours. \param values Of f.
HARMOS_LARGE_FUNCTION Vector2 leastSquaresGradient(ReconstructionField const &field, CellComponents const &components,
                                                   CellNeighbours const &neighbours, FractionDifference const &f,
                                                   NeighbourValues const &values)
{
  Vector2 const centre = quadrilateralCentroid(unitQuadrilateral(field.mesh, components, components.cell));
  Pack const f0 = values.own, third = 1.0 / 3.0;
  Pack xx = 0.0, xy = 0.0, yy = 0.0, x = 0.0, y = 0.0;
  NeighbourPack spare;
  for (int p = 0; p < neighbours.packs(); ++p)
  {
    NeighbourPack const &n = neighbours.pack(p, spare);
    // Centroid of the two triangles on either side of the diagonal.
    Pack const ax = n.x[1] - n.x[0], ay = n.y[1] - n.y[0], bx = n.x[2] - n.x[0], by = n.y[2] - n.y[0];
    Pack const cx = n.x[3] - n.x[0], cy = n.y[3] - n.y[0];
    Pack const lower = ax * by - ay * bx, upper = bx * cy - by * cx;
    Pack const scale = third / (lower + upper);
    Pack const dx = n.x[0] + scale * (lower * (ax + bx) + upper * (bx + cx)) - Pack(centre[0]);
    Pack const dy = n.y[0] + scale * (lower * (ay + by) + upper * (by + cy)) - Pack(centre[1]);
    Pack const w = n.present / (dx * dx + dy * dy);
    Pack const value = p < CellNeighbours::stored_packs ? values.stored[p] : neighbours.values(f, p);
    Pack const wx = w * dx, wy = w * dy, difference = value - f0;
    xx += wx * dx;
    xy += wx * dy;
    yy += wy * dy;
    x += wx * difference;
    y += wy * difference;
  }
  double const sxx = laneSum(xx), sxy = laneSum(xy), syy = laneSum(yy);
  Vector2 const b{laneSum(x), laneSum(y)};
  double const trace = sxx + syy, det = sxx * syy - sxy * sxy;
  if (trace == 0.0)
    return {0.0, 0.0};
  if (det > 1e-12 * trace * trace)
    return {(syy * b[0] - sxy * b[1]) / det, (sxx * b[1] - sxy * b[0]) / det};
  Vector2 const line = normalised(sxx > syy ? Vector2{sxx, sxy} : Vector2{sxy, syy});
  return (dot(line, b) / trace) * line;
}

HARMOS_LARGE_FUNCTION Vector2 leastSquaresGradient(ReconstructionField const &field, CellComponents const &components,
                                                   CellNeighbours const &neighbours, FractionDifference const &f)
{
  return leastSquaresGradient(field, components, neighbours, f, NeighbourValues(field, components, neighbours, f));
}

namespace Detail
{

/// Gradient at a node by the contour integral over its dual, (1/A) sum f n dl around the centroids of its cells,
/// walked counter-clockwise from cell to cell across faces. False where the ring is open (boundary, edge of the halo).
template <class Function>
HARMOS_LARGE_FUNCTION bool nodeGradient(ReconstructionField const &field, CellComponents const &components,
                                        Function const &f, int corner, Vector2 &gradient)
{
  constexpr int max_valence = 32;
  int const start = 4 * components.cell + corner;
  int at = start, valence = 0;
  double twice_area = 0.0;
  Vector2 sum{0.0, 0.0}, origin{0.0, 0.0}, a{0.0, 0.0};
  double fa = 0.0;
  for (; valence < max_valence; ++valence)
  {
    int const cell = at / 4;
    Vector2 const b = quadrilateralCentroid(unitQuadrilateral(field.mesh, components, cell));
    double const fb = f(field, components, cell);
    if (valence == 0)
      origin = b;
    else
    {
      sum += (0.5 * (fa + fb)) * Vector2{b[1] - a[1], a[0] - b[0]};
      twice_area += cross(a - origin, b - origin);
    }
    if (valence > 0 && at == start)
      break;
    a = b;
    fa = fb;
    // The face before this corner; seen from its other cell it begins at the node, so its code names the next corner.
    at = field.mesh.face_neighbour(cell, (at % 4 + 3) % 4);
    if (at < 0)
      return false;
  }
  if (valence < 3 || valence == max_valence || twice_area <= 0.0)
    return false;
  gradient = (2.0 / twice_area) * sum;
  return true;
}

} // namespace Detail

/// Youngs' gradient at a cell: the mean of its nodes' contour-integral gradients, in the cell's unit coordinates.
///
/// Nodes whose ring of cells is open are left out (one-sided at boundaries and at the edge of the halo); without any
/// closed one the least-squares gradient is taken. On a uniform grid these are Youngs' weights 1, 2, 1.
///
/// Youngs, in Numerical Methods for Fluid Dynamics (1982) 273-285; Dukowicz & Kodis, SIAM J. Sci. Stat. Comput. 8
/// (1987) 305-321.
HARMOS_LARGE_FUNCTION Vector2 youngsGradient(ReconstructionField const &field, CellComponents const &components,
                                             FractionDifference const &f)
{
  Vector2 sum{0.0, 0.0};
  int closed = 0;
  for (int corner = 0; corner < 4; ++corner)
  {
    Vector2 gradient;
    if (Detail::nodeGradient(field, components, f, corner, gradient))
    {
      sum += gradient;
      ++closed;
    }
  }
  return closed > 0 ? (1.0 / closed) * sum
                    : leastSquaresGradient(field, components, CellNeighbours(field, components), f);
}

} // namespace Harmos

#endif
