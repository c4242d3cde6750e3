// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_EDGE_MOMENTUM_HPP
#define HARMOS_EDGE_MOMENTUM_HPP

#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_LoadPoints.hpp>
#include <Harmos_Select.hpp>
#include <detail/Harmos_CornerTransfer.hpp>

namespace Harmos
{
namespace RemapDetail
{

using LaneMask = decltype(Pack(0.0) > Pack(0.0)); // of packs; a bool where they are doubles

/// Velocities at the corners of a pack's cells.
struct PackedCorners
{
  Pack x[4], y[4];
};

/// Monotonised central difference of two neighbouring differences: at most `most` times the lesser. Where a part up to
/// one half of it is taken, 2 keeps what comes of it between the neighbours.
KOKKOS_FORCEINLINE_FUNCTION Pack limitedDifference(Pack const &upstream, Pack const &downstream, Pack const &most)
{
  Pack const central = 0.5 * Math::fabs(upstream + downstream);
  Pack const bound = most * Math::min(Math::fabs(upstream), Math::fabs(downstream));
  Pack const size = select(upstream * downstream > Pack(0.0), Math::min(central, bound), Pack(0.0));
  return select(upstream > Pack(0.0), size, Pack(-size));
}

/// Two parallel edges of a cell, edge[0] -> edge[1] and edge[2] -> edge[3]. The nodes where they begin share the face
/// `behind`, those where they end share `ahead`.
struct EdgePair
{
  int edge[4];
  int behind, ahead;
};

/// What the neighbours of a block's cells give: their faces' swept volumes and outgoing fluxes, column by column as in
/// the window; zero where they do not count. Velocities one edge beyond the two nodes of each face, in a mixed
/// neighbour too: its dof nodes go on beyond the rim of the body; mirrored ones beyond a wall along which it slips;
/// those nodes' own where else the material ends at the face: then the limited difference is zero.
struct Neighbours
{
  double const *face[4];
  Pack velocity_x[4][2], velocity_y[4][2];

  KOKKOS_FORCEINLINE_FUNCTION Pack load(int k, int column) const { return loadPack(face[k] + column * column_stride); }
};

/// Momentum along one edge a -> b: the upwind velocity v_f at the face between them goes with the mass G.
/// \param heat_a, heat_b Where not null: the kinetic energy that comes with it, as seen from the node, is added,
/// G (v_f - v)^2 / 2 where it arrives, less than nothing where it leaves.
KOKKOS_FORCEINLINE_FUNCTION void transfer(LaneMask const &forward, Pack const &flow, Pack const &part, Pack const &most,
                                          Pack const &va, Pack const &vb, Pack const &beyond, Pack &gain_a,
                                          Pack &gain_b, Pack *heat_a = nullptr, Pack *heat_b = nullptr)
{
  Pack const up = select(forward, va, vb);
  Pack const down = select(forward, vb, va);
  Pack const face = up + part * limitedDifference(up - beyond, down - up, most);
  Pack const to_down = flow * (face - down);
  Pack const to_up = flow * (up - face);
  gain_a += select(forward, to_up, to_down);
  gain_b += select(forward, to_down, to_up);
  if (heat_a == nullptr)
    return;
  Pack const arrives = 0.5 * to_down * (face - down);
  Pack const leaves = 0.5 * to_up * (face - up);
  *heat_a += select(forward, leaves, arrives);
  *heat_b += select(forward, arrives, leaves);
}

/// \param heat Of the corners (transfer), or null.
KOKKOS_FORCEINLINE_FUNCTION void advect(Pack const &G, Pack const &per_mass, EdgePair const &edges,
                                        Neighbours const &beyond, PackedCorners const &v, PackedCorners &gain,
                                        Pack *heat = nullptr)
{
  auto const forward = G > Pack(0.0);
  Pack const flow = Math::fabs(G);
  Pack const part = 0.5 * (1.0 - Math::min(Pack(1.0), Pack(2.0 * flow * per_mass)));
  for (int e = 0; e < 2; ++e)
  {
    int const a = edges.edge[2 * e], b = edges.edge[2 * e + 1];
    int const i = a == edges.behind ? 0 : 1, j = b == edges.ahead ? 0 : 1;
    Pack const beyond_x = select(forward, beyond.velocity_x[edges.behind][i], beyond.velocity_x[edges.ahead][j]);
    Pack const beyond_y = select(forward, beyond.velocity_y[edges.behind][i], beyond.velocity_y[edges.ahead][j]);
    Pack *const heat_a = heat == nullptr ? nullptr : heat + a;
    Pack *const heat_b = heat == nullptr ? nullptr : heat + b;
    transfer(forward, flow, part, 2.0, v.x[a], v.x[b], beyond_x, gain.x[a], gain.x[b], heat_a, heat_b);
    transfer(forward, flow, part, 2.0, v.y[a], v.y[b], beyond_y, gain.y[a], gain.y[b], heat_a, heat_b);
  }
}

/// Part of what passes through the ring that a face from radius a to radius b sweeps which is the corner's at a: the
/// integral of r N_a along it over that of r, (2 a + b) / (3 (a + b)). Nothing passes where both are zero.
KOKKOS_FORCEINLINE_FUNCTION Pack faceShare(Pack const &a, Pack const &b)
{
  auto const off_axis = a + b > Pack(0.0);
  return select(off_axis, (2.0 * a + b) / select(off_axis, Pack(3.0 * (a + b)), Pack(1.0)), Pack(0.5));
}

/// Where along an edge from radius a to radius b the velocity goes with the mass that flows between its corners, as a
/// part of the edge from a: half-way but near the axis. So u = c r keeps its form, whatever the cells' widths: with
/// b^3 that leaves the cell at b and a^3 that enters at a (times density and c^2) both corners lose three times their
/// mass times their radius where a b (a + b) / 2 flows with the mass (a^2 + a b + b^2) / 3.
KOKKOS_FORCEINLINE_FUNCTION Pack balancePoint(Pack const &a, Pack const &b)
{
  Pack const square = a * a + a * b + b * b;
  auto const off_axis = square > Pack(0.0);
  return select(off_axis, a * (b + 2.0 * a) / select(off_axis, Pack(2.0 * square), Pack(1.0)), Pack(0.5));
}

/// Along the edges about an axis. What leaves through a face leaves its corners by faceShare; a corner loses its
/// share of what the cell loses. The rest of that balance flows along the edges (cornerFlows).
/// \param heat Of the corners (transfer).
HARMOS_RARE_FUNCTION inline void advectShares(Pack const radius[4], Pack const share[4], Pack const out[4],
                                              Pack const &per_mass, Neighbours const &beyond, PackedCorners const &v,
                                              PackedCorners &gain, Pack heat[4])
{
  Pack const loss = (out[0] + out[1]) + (out[2] + out[3]);
  Pack need[4], flow[4];
  for (int k = 0; k < 4; ++k)
    need[k] = -(share[k] * loss);
  for (int k = 0; k < 4; ++k)
  {
    Pack const part = faceShare(radius[k], radius[(k + 1) & 3]);
    need[k] += part * out[k];
    need[(k + 1) & 3] += (1.0 - part) * out[k];
  }
  cornerFlows(share, need, flow);
  for (int a = 0; a < 4; ++a)
  {
    int const b = (a + 1) & 3, behind = (a + 3) & 3; // beyond b lies face b
    auto const forward = flow[a] > Pack(0.0);
    Pack const amount = Math::fabs(flow[a]);
    Pack const crossed = amount * per_mass / (share[a] + share[b]);
    Pack const balance = balancePoint(radius[a], radius[b]);
    Pack const upstream = select(forward, balance, Pack(1.0 - balance));
    Pack const part = Math::max(upstream - 0.5 * Math::min(Pack(1.0), crossed), Pack(0.0));
    Pack const most =
        1.0 / Math::max(part, Pack(0.5)); // beyond half-way: so that the velocity stays between the nodes'
    Pack const beyond_x = select(forward, beyond.velocity_x[behind][1], beyond.velocity_x[b][0]);
    Pack const beyond_y = select(forward, beyond.velocity_y[behind][1], beyond.velocity_y[b][0]);
    transfer(forward, amount, part, most, v.x[a], v.x[b], beyond_x, gain.x[a], gain.x[b], heat + a, heat + b);
    transfer(forward, amount, part, most, v.y[a], v.y[b], beyond_y, gain.y[a], gain.y[b], heat + a, heat + b);
  }
}

} // namespace RemapDetail
} // namespace Harmos

#endif
