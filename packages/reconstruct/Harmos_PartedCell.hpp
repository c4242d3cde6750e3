// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PARTED_CELL_HPP
#define HARMOS_PARTED_CELL_HPP

#include <Harmos_LeastSquaresLine.hpp>
#include <Harmos_MomentOfFluid.hpp>

namespace Harmos
{

/// Two bodies and void: one line parts the cell, and each body shares its part with some of the void, behind a line of
/// its own. Their corners may pass each other, where no sequence of cuts leaves the bodies what they have.
struct PartedCell
{
  double angle = 0.0;     // of the parting line's normal, which leaves body 0's part
  double void_part = 0.0; // of the cell: void in body 0's part
  Vector2 normal;         // (cos, sin) of the angle
  Vector2 own[2];         // normals of the lines between each body and the void of its part, which leave the body
  bool lined[2];          // false: a part without void, or without a line yet
  Vector2 miss[2];        // first moment found, less the given one; zero without own lines
  Pack misfit[CellNeighbours::stored_packs]; // r_j of PartingProblem
  double error = 1e300;                      // see PartingProblem
  bool converged = true;                     // of the searches for the own lines
};

/// Which parted cell suits the bodies' centroids c_k and the neighbours best: least
///
///   sum_k |V_k x_k - V_k c_k|^2 + (weight / N) sum_j r_j^2
///
/// over the parting line's angle and the void on its first side. r_j: by how much the part g_j of neighbour j behind
/// the line falls short of the fraction of body 0 there, or 1 - g_j of that of body 1: what fills the rest may lie on
/// either side. Four lines' parameters meet four coordinates of centroids, but where the bodies' corners stand opposite
/// each other a tilt of all three lines changes none of them; the line's continuation decides there.
struct PartingProblem
{
  ReconstructionField const &field;
  CellComponents const &components; // body 0, body 1, void
  CellNeighbours neighbours;
  Pack first[CellNeighbours::stored_packs], second[CellNeighbours::stored_packs]; // the bodies' fractions
  double weight;                                                                  // over N
  bool line_alone = false; // the error is the neighbours' misfit alone; no own lines

  /// \param of_misfit Weight of the mean squared misfit, of the smaller body's volume.
  HARMOS_LARGE_FUNCTION PartingProblem(ReconstructionField const &f, CellComponents const &c, double of_misfit)
      : field(f), components(c), neighbours(f, c),
        weight(of_misfit * Math::min(c.volume[0], c.volume[1]) / Math::max(1, neighbours.count()))
  {
    for (int p = 0; p < packs(); ++p)
    {
      first[p] = neighbours.values(FractionDifference{1u, 0u}, p);
      second[p] = neighbours.values(FractionDifference{2u, 0u}, p);
    }
  }

  /// Neighbours beyond the usual eight are not looked at.
  KOKKOS_INLINE_FUNCTION int packs() const { return Math::min(neighbours.packs(), CellNeighbours::stored_packs); }

  /// A body's part: place the line between it and its void, by the centroid of the smaller of both; from that of a near
  /// cell where it has one.
  KOKKOS_INLINE_FUNCTION void place(Region const &part, int k, double void_volume, PartedCell const *near,
                                    PartedCell &cell) const
  {
    double const volume = components.volume[k];
    Vector2 const &given = components.centroid[k];
    Moments<1> const m = components.momentsOf(part);
    Vector2 const whole = Vector2{m.first(0), m.first(1)} + m.volume() * part[0];
    cell.own[k] = {1.0, 0.0};
    cell.miss[k] = whole - volume * given;
    cell.lined[k] = void_volume > least_void;
    if (!cell.lined[k])
      return;
    bool const body_is_smaller = volume <= void_volume;
    Vector2 const centroid = body_is_smaller ? given : (1.0 / void_volume) * cell.miss[k];
    double const side = body_is_smaller ? 1.0 : -1.0, smaller = Math::min(volume, void_volume);
    MomentOfFluidLine const line =
        near != nullptr && near->lined[k]
            ? Detail::localMinimum(part, side * near->own[k], smaller, centroid, components.weight)
            : momentOfFluidLine(part, smaller, centroid, components.weight);
    cell.own[k] = side * line.normal;
    cell.miss[k] = (side * smaller) * (line.centroid - centroid);
    cell.converged = cell.converged && line.converged;
  }

  /// \param near Where the searches for the own lines begin; none: everywhere.
  HARMOS_LARGE_FUNCTION PartedCell at(double angle, double void_part, PartedCell const *near = nullptr) const
  {
    PartedCell cell = {};
    cell.angle = angle;
    cell.void_part = Math::clamp(void_part, 0.0, components.volume[2]);
    cell.normal = {Math::cos(angle), Math::sin(angle)};
    double const beyond = components.volume[2] - cell.void_part;
    Division const parts = divide(components.polygon, cell.normal, components.volume[0] + cell.void_part,
                                  components.volume[1] + beyond, components.weight);
    if (!line_alone)
    {
      place(parts.inside, 0, cell.void_part, near, cell);
      place(parts.outside, 1, beyond, near, cell);
    }
    Pack sum = 0.0;
    NeighbourPack spare;
    for (int p = 0; p < packs(); ++p)
    {
      NeighbourPack const &quad = neighbours.pack(p, spare);
      Pack const behind = Detail::insidePart(quad, cell.normal, parts.chord_begin, components.weight).volume;
      Pack const part = quad.present * behind / quad.volume, zero = 0.0;
      Pack const short_of_first = first[p] - part, over_second = part - (quad.present - second[p]);
      cell.misfit[p] = select(short_of_first > zero, -short_of_first, select(over_second > zero, over_second, zero));
      sum += cell.misfit[p] * cell.misfit[p];
    }
    cell.error = dot(cell.miss[0], cell.miss[0]) + dot(cell.miss[1], cell.miss[1]) + weight * laneSum(sum);
    return cell;
  }

  /// Inner product of two parted cells' differences from a third, in the measure of the error.
  KOKKOS_INLINE_FUNCTION double product(PartedCell const &a, PartedCell const &b, PartedCell const &from) const
  {
    Pack sum = 0.0;
    for (int p = 0; p < packs(); ++p)
      sum += (a.misfit[p] - from.misfit[p]) * (b.misfit[p] - from.misfit[p]);
    return dot(a.miss[0] - from.miss[0], b.miss[0] - from.miss[0]) +
           dot(a.miss[1] - from.miss[1], b.miss[1] - from.miss[1]) + weight * laneSum(sum);
  }
};

/// Least squares from a given start by Levenberg and Marquardt's steps, with differences for derivatives; the void of
/// body 0's part stays between none and all.
/// \param max_steps Of accepted turns and moves.
///
/// Marquardt, J. Soc. Indust. Appl. Math. 11 (1963) 431-441.
HARMOS_LARGE_FUNCTION PartedCell bestPartedCell(PartingProblem const &problem, PartedCell const &start, int max_steps)
{
  constexpr int max_tries = 8;
  constexpr double difference = 1e-7, longest_turn = 0.3;
  constexpr double exact = 1e-22;     // a first moment to 1e-11
  constexpr double least_gain = 1e-3; // of the error
  double const all_void = problem.components.volume[2];
  PartedCell const nothing = {}; // its residuals are zero
  PartedCell best = start;
  double damping = 1e-3;
  bool gains = true;
  for (int i = 0; i < max_steps && gains && best.error > exact; ++i)
  {
    // Unknowns: the angle, and the part of the void. J^T J and -J^T r.
    double const inward = best.void_part + difference * all_void < all_void ? difference : -difference;
    PartedCell const turned = problem.at(best.angle + difference, best.void_part, &best);
    PartedCell const moved = problem.at(best.angle, best.void_part + inward * all_void, &best);
    double const tt = problem.product(turned, turned, best) / (difference * difference);
    double const tm = problem.product(turned, moved, best) / (difference * inward);
    double const mm = problem.product(moved, moved, best) / (inward * inward);
    double const t = problem.product(turned, nothing, best) / difference;
    double const m = problem.product(moved, nothing, best) / inward;
    gains = false;
    for (int tries = 0; tries < max_tries && !gains; ++tries)
    {
      double const shift = damping * (tt + mm) + 1e-300, stt = tt + shift, smm = mm + shift;
      double const det = stt * smm - tm * tm;
      double const now = best.void_part / all_void;
      double const part = Math::clamp(now + (stt * m - tm * t) / det, 0.0, 1.0);
      double const turn = Math::clamp((t - tm * (part - now)) / stt, -longest_turn, longest_turn);
      PartedCell const next = problem.at(best.angle + turn, part * all_void, &best);
      bool const better = next.error < best.error;
      gains = next.error < (1.0 - least_gain) * best.error;
      if (better)
        best = next;
      damping = better ? 0.1 * damping : Math::max(10.0 * damping, 1e-8);
      if (better)
        break;
    }
  }
  return best;
}

} // namespace Harmos

#endif
