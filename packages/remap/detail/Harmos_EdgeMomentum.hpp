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

/// Two parallel edges of a cell, edge[0] -> edge[1] and edge[2] -> edge[3]. The nodes where they begin share the face
/// `behind`, those where they end share `ahead`.
struct EdgePair
{
  int edge[4];
  int behind, ahead;
};

/// What the neighbours of a block's cells give: what their faces sweep out of them, and the outgoing fluxes, column by
/// column as in the window; zero where they do not count. Velocities one edge beyond the two nodes of each face, in a
/// mixed neighbour too: its dof nodes go on beyond the rim of the body; mirrored ones beyond a wall along which it
/// slips; those nodes' own where else the material ends at the face: then the limited difference is zero.
struct Neighbours
{
  double const *swept[4];
  double const *flux[4];        // of the first field
  double const *velocity[4][2]; // columns of x and y

  KOKKOS_FORCEINLINE_FUNCTION Pack velocityBeyond(int k, int i, int axis) const
  {
    return loadPack(velocity[k][i] + axis * column_stride);
  }
};

/// What an edge a -> b carries.
struct EdgeFlow
{
  Pack mass; // from a to b, of either sign
  LaneMask forward;
  Pack weight; // of the two differences in their mean, and what of the limited one is taken (edgeFlow)
  Pack part;
};

/// \param reach From the node upstream to where the velocity goes with the mass, as a part of the edge; not negative.
/// The monotonised central difference of two neighbouring ones, their mean but at most `most` times the lesser, is
/// taken `reach` times: between the nodes it stays with most = min(2, 1 / reach). Here both are divided by `most`.
KOKKOS_FORCEINLINE_FUNCTION EdgeFlow edgeFlow(Pack const &mass, Pack const &reach)
{
  return {mass, mass > Pack(0.0), 0.5 * Math::max(reach, Pack(0.5)), Math::min(Pack(2.0 * reach), Pack(1.0))};
}

/// Momentum along an edge: the mass G leaves a and reaches b with the upwind velocity v_f, so that they gain
/// -G (v_f - v_a) and G (v_f - v_b). \param behind, ahead Velocities one edge beyond a and b.
/// \param heat_a, heat_b Where not null: the kinetic energy that comes with it, as seen from the node, is added:
/// -G (v_f - v_a)^2 / 2 and G (v_f - v_b)^2 / 2, less than nothing where it leaves.
KOKKOS_FORCEINLINE_FUNCTION void transfer(EdgeFlow const &flow, Pack const &va, Pack const &vb, Pack const &behind,
                                          Pack const &ahead, Pack &gain_a, Pack &gain_b, Pack *heat_a = nullptr,
                                          Pack *heat_b = nullptr)
{
  Pack const difference = vb - va;
  Pack const upstream = select(flow.forward, va - behind, ahead - vb);
  Pack const mean = flow.weight * (upstream + difference);
  Pack const most = Math::max(Math::min(upstream, difference), Pack(0.0)); // both zero where the signs differ
  Pack const least = Math::min(Math::max(upstream, difference), Pack(0.0));
  Pack const limited = flow.part * Math::max(least, Math::min(mean, most));
  Pack const from_a = select(flow.forward, limited, Pack(difference - limited)), from_b = from_a - difference;
  gain_a -= flow.mass * from_a;
  gain_b += flow.mass * from_b;
  if (heat_a == nullptr)
    return;
  *heat_a -= 0.5 * flow.mass * (from_a * from_a);
  *heat_b += 0.5 * flow.mass * (from_b * from_b);
}

/// \param heat Of the corners (transfer), or null.
KOKKOS_FORCEINLINE_FUNCTION void advect(Pack const &G, Pack const &per_mass, EdgePair const &edges,
                                        Neighbours const &beyond, PackedCorners const &v, PackedCorners &gain,
                                        Pack *heat = nullptr)
{
  // edgeFlow(G, (1 - min(1, 2 |G| / mass)) / 2), which is at most half-way
  EdgeFlow const flow = {G, G > Pack(0.0), 0.25, 1.0 - Math::min(Pack(1.0), Pack(2.0 * Math::fabs(G) * per_mass))};
  HARMOS_UNROLL
  for (int e = 0; e < 2; ++e)
  {
    int const a = edges.edge[2 * e], b = edges.edge[2 * e + 1];
    int const i = a == edges.behind ? 0 : 1, j = b == edges.ahead ? 0 : 1;
    Pack *const heat_a = heat == nullptr ? nullptr : heat + a;
    Pack *const heat_b = heat == nullptr ? nullptr : heat + b;
    transfer(flow, v.x[a], v.x[b], beyond.velocityBeyond(edges.behind, i, 0), beyond.velocityBeyond(edges.ahead, j, 0),
             gain.x[a], gain.x[b], heat_a, heat_b);
    transfer(flow, v.y[a], v.y[b], beyond.velocityBeyond(edges.behind, i, 1), beyond.velocityBeyond(edges.ahead, j, 1),
             gain.y[a], gain.y[b], heat_a, heat_b);
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
    Pack const crossed = Math::fabs(flow[a]) * per_mass / (share[a] + share[b]);
    Pack const balance = balancePoint(radius[a], radius[b]);
    Pack const upstream = select(flow[a] > Pack(0.0), balance, Pack(1.0 - balance));
    EdgeFlow const along = edgeFlow(flow[a], Math::max(upstream - 0.5 * Math::min(Pack(1.0), crossed), Pack(0.0)));
    transfer(along, v.x[a], v.x[b], beyond.velocityBeyond(behind, 1, 0), beyond.velocityBeyond(b, 0, 0), gain.x[a],
             gain.x[b], heat + a, heat + b);
    transfer(along, v.y[a], v.y[b], beyond.velocityBeyond(behind, 1, 1), beyond.velocityBeyond(b, 0, 1), gain.y[a],
             gain.y[b], heat + a, heat + b);
  }
}

} // namespace RemapDetail
} // namespace Harmos

#endif
