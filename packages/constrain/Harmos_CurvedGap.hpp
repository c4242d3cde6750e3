// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CURVED_GAP_HPP
#define HARMOS_CURVED_GAP_HPP

#include <Harmos_NormalFit.hpp>
#include <Harmos_SegmentBins.hpp>
#include <Harmos_SlipMirrors.hpp>

namespace Harmos
{

/// The facets of one side in one cell, as sums by length in the frame (t, n) of a point; lengths in cells.
struct CellFacets
{
  int cell, image; // image: -1, or of the cell's mirror images
  double length, t, y, tt, ty;
};

/// One side's facets around a point, cell by cell.
struct SideFacets
{
  static constexpr int most_cells = 16;
  int count = 0;
  bool overflown = false;
  CellFacets of_cell[most_cells];

  KOKKOS_INLINE_FUNCTION void add(int cell, int image, double length, double t, double y, double slope)
  {
    int k = 0;
    while (k < count && (of_cell[k].cell != cell || of_cell[k].image != image))
      ++k;
    if (k == most_cells)
    {
      overflown = true;
      return;
    }
    if (k == count)
      of_cell[count++] = {cell, image, 0.0, 0.0, 0.0, 0.0, 0.0};
    CellFacets &c = of_cell[k];
    double const spread = length * length / 12.0;
    c.length += length;
    c.t += length * t;
    c.y += length * y;
    c.tt += length * (t * t + spread);
    c.ty += length * (t * y + slope * spread);
  }
};

/// An arc through one side's facets: y = alpha + beta t + gamma t^2 / 2 + gamma^3 t^4 / 8.
struct SideArc
{
  double height, curvature; // alpha, gamma
  bool smooth;              // the facets lie on it
  bool even;                // and turn as it does

  static constexpr double reach = 2.0; // along the side; cells beyond have no weight [cells]
};

/// How far the ends of a chord L stand out of an arc that bounds the same volume: curvature L^2 / 12, for the longest
/// chord of a cell, L^2 = 2. [cells]
KOKKOS_INLINE_FUNCTION double standOut(double curvature)
{
  constexpr double longest_chord_squared = 2.0;
  return curvature * longest_chord_squared / 12.0;
}

/// Weighted least squares over the cells c of a side, with the means t_c, y_c, s_c = mean t^2 - t_c^2 of their facets
/// and the slope of the line through them,
///
///   sum_c w_c (r_c^2 + 0.1 s_c (slope_c - beta - gamma t_c)^2),
///   r_c = y_c - alpha - beta t_c - gamma/2 (t_c^2 + s_c),
///
/// once, and again less what the fourth order of the first fit's arc adds. r_c = 0 is the same volume below the arc as
/// below the cell's facets. Where two bodies meet in a cell a piece of facet does not hold its body's volume, all
/// pieces of the cell together do: so cells are fitted. At least three of them, with 1.2 cells of weighted length.
/// The side is smooth where the root mean square of r_c is below 0.005 cells. What has moved through the mesh as chords
/// has lost more of its arc: 3/8 of standOut where the side is even, the root mean square of slope_c - beta - gamma t_c
/// below 0.02 or 0.3 gamma (of a corner, which four cells' means cannot tell from an arc, 0.5 gamma).
KOKKOS_INLINE_FUNCTION SideArc fitSide(SideFacets const &side)
{
  constexpr double least_length = 1.2, most_miss = 5e-3, miss_over_stand_out = 0.375; // [cells]
  constexpr double most_turn = 0.02, turn_over_curvature = 0.3;
  constexpr int least_cells = 3;
  double alpha = 0.0, beta = 0.0, gamma = 0.0; // of the fit
  double length = 0.0, miss = 0.0, turn = 0.0, turning = 0.0;
  int taken = 0;
  auto const forEachCell = [&](auto const &visit)
  {
    for (int k = 0; k < side.count; ++k)
    {
      CellFacets const &c = side.of_cell[k];
      double const t = c.t / c.length, y = c.y / c.length, spread = c.tt / c.length - t * t;
      double const near = 1.0 - t * t / (SideArc::reach * SideArc::reach), cube = gamma * gamma * gamma;
      if (near > 0.0 && spread > 0.0)
        visit(c.length * near * near, t, spread, y - 0.125 * cube * t * t * (t * t + 6.0 * spread),
              (c.ty / c.length - t * y) / spread - 0.5 * cube * t * (t * t + 3.0 * spread));
    }
  };
  for (int pass = 0; pass < 2; ++pass)
  {
    FitMoments m = {};
    SideMoments &of = m.side[0];
    taken = 0;
    forEachCell(
        [&](double w, double t, double spread, double y, double slope)
        {
          double const q = 0.5 * (t * t + spread), u = 0.1 * spread;
          of.w += w;
          of.t += w * t;
          of.q += w * q;
          of.y += w * y;
          of.tt += w * (t * t + u);
          of.tq += w * (t * q + u * t);
          of.qq += w * (q * q + u * t * t);
          of.ty += w * (t * y + u * slope);
          of.qy += w * (q * y + u * t * slope);
          ++taken;
        });
    length = of.w;
    if (side.overflown || taken < least_cells || length < least_length)
      return {0.0, 0.0, false, false};
    ParabolaFit const fit = fitParabola(m, 0.0);
    alpha = fit.alpha[0];
    beta = fit.beta;
    gamma = fit.gamma[0];
  }
  forEachCell(
      [&](double w, double t, double spread, double y, double slope)
      {
        double const r = y - alpha - beta * t - 0.5 * gamma * (t * t + spread);
        double const off = slope - beta - gamma * t;
        miss += w * r * r;
        turn += w * spread * off * off;
        turning += w * spread;
      });
  double const most_off = Math::max(most_turn, turn_over_curvature * Math::fabs(gamma));
  bool const even = turn <= most_off * most_off * turning;
  double const most = even ? Math::max(most_miss, miss_over_stand_out * standOut(Math::fabs(gamma))) : most_miss;
  return {alpha, gamma, miss <= most * most * length, even};
}

/// \brief Void between two smooth sides that curve away from each other, at a point where their facets meet. [cells]
///
/// The facet of a curved side is a chord, whose ends lie outside of the arc by L^2 / (12 R): two bodies share pieces of
/// them while there is still void between their arcs. The arcs of both sides (fitSide) tell how much: to 1e-3
/// cells for discs of four and five cells' radius.
///
/// A chord that the other side's facet cuts off at one end holds its volume by standing out more: up to twice standOut,
/// where both sides are even.
///
/// \param mirrors Of the segment's cell: what lies beyond slip walls counts too.
/// \param at Segment whose point it is, of the side that n leaves.
/// \param other Material of the other side.
/// \param n Unit normal of contact there.
/// \return Zero where a side is not smooth, and where the ends of chords cannot explain that they meet.
KOKKOS_INLINE_FUNCTION double curvedGap(SegmentBins const &bins, SlipMirrors const &mirrors, InterfaceSegment const &at,
                                        int other, Vector2 const &n)
{
  constexpr double apart = 1.0;                                    // most height of a facet [cells]
  double const h = at.cell_size, box = (SideArc::reach + 1.0) * h; // of midpoints
  SideFacets side[2];
  forEachWithImages(bins, mirrors, at.point, box,
                    [&](BinnedSegment const &s, int image)
                    {
                      if (s.material != at.material && s.material != other)
                        return;
                      bool const own = s.material == at.material;
                      Vector2 const outward = own ? s.normal : -s.normal, d = (1.0 / h) * (s.midpoint - at.point);
                      double const along = dot(outward, n), height = dot(d, n), t = cross(d, n);
                      if (along < fit_least_cosine || Math::fabs(height) > apart ||
                          Math::fabs(t) > SideArc::reach + 1.0)
                        return;
                      side[own ? 0 : 1].add(s.cell, image, along * s.length / h, t, height, cross(n, outward) / along);
                    });
  SideArc const a = fitSide(side[0]), b = fitSide(side[1]);
  double const gap = b.height - a.height, opening = b.curvature - a.curvature;
  double const most = (a.even && b.even ? 2.0 : 1.0) * standOut(opening);
  return a.smooth && b.smooth && gap > 0.0 && gap <= most ? gap : 0.0;
}

/// \brief Void between a corner and a smooth convex side, which its facets leave too little of: the gap to the facet at
/// its foot, and what lies between the ends of a chord and the arc (fitSide). [length]
///
/// With the arc's height alpha below the corner and its curvature gamma, in cells h: -alpha h, where the side is smooth
/// and that is more than the gap by at most -gamma h / 6, what the end of a chord stands out; else the gap as it is.
///
/// \param mirrors Of the face's cell.
/// \param face Segment at the foot. \param n Unit normal of its side there. \param gap To the facet. [length]
KOKKOS_INLINE_FUNCTION double gapAboveArc(SegmentBins const &bins, SlipMirrors const &mirrors,
                                          InterfaceSegment const &face, Vector2 const &corner, Vector2 const &n,
                                          double gap)
{
  double const h = face.cell_size, box = (SideArc::reach + 1.0) * h;
  SideFacets side;
  forEachWithImages(bins, mirrors, corner, box,
                    [&](BinnedSegment const &s, int image)
                    {
                      Vector2 const d = (1.0 / h) * (s.midpoint - corner);
                      double const along = dot(s.normal, n), t = cross(d, n);
                      if (s.material == face.material && along >= fit_least_cosine &&
                          Math::fabs(t) <= SideArc::reach + 1.0)
                        side.add(s.cell, image, along * s.length / h, t, dot(d, n), cross(n, s.normal) / along);
                    });
  SideArc const arc = fitSide(side);
  double const beyond = -arc.height * h - gap;
  return arc.smooth && beyond > 0.0 && beyond <= standOut(-arc.curvature) * h ? gap + beyond : gap;
}

} // namespace Harmos

#endif
