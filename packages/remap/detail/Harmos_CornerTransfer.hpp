// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CORNER_TRANSFER_HPP
#define HARMOS_CORNER_TRANSFER_HPP

#include <Harmos_CornerShares.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Flows of mass along the edges of a cell, k -> k + 1, that bring its corners what they need (sum zero).
///
/// flow_{k-1} - flow_k = need_k leaves a circulation free; sum flow_k / (share_k + share_{k+1}) = 0 fixes it, least in
/// that measure: on a rectangle each pair of parallel edges then carries what goes across it in the measure of its
/// shares, and with quarters half of the faces' difference each. T: double or Pack.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void cornerFlows(T const share[4], T const need[4], T flow[4])
{
  T resistance[4];
  for (int k = 0; k < 4; ++k)
    resistance[k] = 1.0 / (share[k] + share[(k + 1) & 3]);
  T const two = need[1] + need[2];
  T const three = two + need[3];
  T const whole = (resistance[0] + resistance[1]) + (resistance[2] + resistance[3]);
  flow[0] = (need[1] * resistance[1] + two * resistance[2] + three * resistance[3]) / whole;
  flow[1] = flow[0] - need[1];
  flow[2] = flow[1] - need[2];
  flow[3] = flow[2] - need[3];
}

/// What lies at the corners of one cell in parts `from` of a mass goes to those of another in parts `to`: the mean
/// velocities there, times that mass (u, v of corner 0, 1, 2, 3).
///
/// The difference flows along the edges with the velocity upstream, so that sum to_k corner_k is what sum from_k
/// corner_k was, equal velocities stay equal, and no new extreme arises.
KOKKOS_INLINE_FUNCTION void reshare(double const from[4], double const to[4], double corner[8])
{
  double need[4], flow[4];
  for (int k = 0; k < 4; ++k)
    need[k] = to[k] - from[k];
  cornerFlows(from, need, flow);
  double moved[8];
  for (int k = 0; k < 4; ++k)
    for (int d = 0; d < 2; ++d)
      moved[2 * k + d] = from[k] * corner[2 * k + d];
  for (int k = 0; k < 4; ++k)
  {
    int const next = (k + 1) & 3;
    int const up = flow[k] > 0.0 ? k : next;
    for (int d = 0; d < 2; ++d)
    {
      moved[2 * k + d] -= flow[k] * corner[2 * up + d];
      moved[2 * next + d] += flow[k] * corner[2 * up + d];
    }
  }
  for (int k = 0; k < 4; ++k)
    for (int d = 0; d < 2; ++d)
      corner[2 * k + d] = moved[2 * k + d] / to[k];
}

/// The same between two cells, corner k of the second pointing as corner k + rotation of the first does; `corner` is
/// in the order of the second. Cells of equal shares leave it as it is.
KOKKOS_INLINE_FUNCTION void reshare(CornerShares const &shares, int from, int to, int rotation, double corner[8])
{
  if (shares.quarters() || from == to)
    return;
  double of_from[4], of_to[4];
  bool same = true;
  for (int k = 0; k < 4; ++k)
  {
    of_from[k] = shares(from, (k + rotation) & 3);
    of_to[k] = shares(to, k);
    same = same && of_from[k] == of_to[k];
  }
  if (!same)
    reshare(of_from, of_to, corner);
}

} // namespace RemapDetail
} // namespace Harmos

#endif
