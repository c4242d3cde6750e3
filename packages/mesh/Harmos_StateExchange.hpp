// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_STATE_EXCHANGE_HPP
#define HARMOS_STATE_EXCHANGE_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_Exchange.hpp>

namespace Harmos
{

/// Replace the pairs of all halo cells of depth <= `depth` by their owner's, bit for bit; once a cycle.
///
/// A pair travels as one row of 19 doubles: material, record (8), centroid (2), velocities of its corners (8), and
/// its damage where that is tracked. Pairs of deeper cells vanish. Pairs that share a dof node carry the same bits.
/// Where the halo holds the materials that come, as it mostly does, values are overwritten in place; else pairs, dof
/// nodes and state come back in new views, numbered anew. Only cells within `depth` of another rank are packed. On one
/// rank it returns at once.
void exchangeState(Mesh const &mesh, Kinematics kinematics, Exchange const &exchange, int depth,
                   CellMaterialPairs &pairs, NodeMaterialPairs &dof_nodes, PairState &state);

/// Give the dof nodes of all halo cells of depth <= `depth` the velocities that the cells' owners have; pairs and dof
/// nodes stay.
///
/// The corners of pairs travel: every owner knows its cells' nodes completely, where the rim of a halo lacks
/// neighbours. On one rank it returns at once.
void exchangeDofVelocities(Exchange const &exchange, int depth, CellMaterialPairs const &pairs,
                           View<double *[2]> const &velocity);

/// Give the nodes of all halo cells of depth <= `depth` the positions that the cells' owners have. The corners of cells
/// travel. On one rank it returns at once.
void exchangeNodePositions(Mesh const &mesh, Exchange const &exchange, int depth, View<double *[2]> const &position);

} // namespace Harmos

#endif
