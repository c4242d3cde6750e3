// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONTACT_ROWS_HPP
#define HARMOS_CONTACT_ROWS_HPP

#include <Harmos_BodyTable.hpp>
#include <Harmos_Constrain.hpp>
#include <Harmos_RayCast.hpp>

namespace Harmos
{

/// Layers of halo cells whose rows this rank holds: those that meet a dof node of an own row, rays reaching two cells.
constexpr int row_halo = 5;

/// Which rows travel: entries of the lists of Exchange::haloCells(row_halo), and the row behind each packed one.
struct TravellingRows
{
  View<int *> sent_offset, received_offset; // entries + 1
  View<int *> sent, received;               // packed rows: number of the row
};

/// Contact rows of this rank, by key: its own (slave cell of depth 0), and after exchangeContactRows those of its halo.
struct ContactRows
{
  int count = 0;
  int num_own = 0;
  long long num_multipliers = 0; // of the own rows; summed over all ranks by constrainVelocities
  View<ContactRow *> row;
  View<int *> own;           // num_own: the rows whose slave cell is owned, ascending
  TravellingRows travelling; // only with more than one rank
};

/// Velocities and rigid bodies at one time.
struct Motion
{
  View<double *[2]> velocity; // dof nodes [m/s]
  BodyTable bodies;
};

struct PressureTractions; // Harmos_PressureTractions.hpp

/// Numbers of the rows of one cell are below this; key = global cell * max_cell_rows + number.
constexpr int max_cell_rows = 4 * max_cell_segments;

/// Room for packed rows of `width` numbers; `total` = the last of the offsets.
PackedRows packedRows(View<int *> const &offset, int total, int width, WorkArrays const &work);

/// One row for every owned slave segment that carries one, or two: a facet that comes up tilted is through with one end
/// while its middle is still apart, and leaves an overlap of length^2 tan(tilt) / 8. So where an end comes by more than
/// 0.02 cells in the step, at v^{n-1/2}, and is or gets 1e-3 cells ahead of the middle, two rows stand at the Gauss
/// points in the place of the one in the middle (Placement::Midpoint, no bond, both halves face the same material).
/// What comes slower keeps one, which is best conditioned: with two before any void the loaded length of Hertz's
/// contact was off by half.
///
/// Pieces of one line through a cell between two solids, which a wedge of void of less than 1e-3 cells parts, carry one
/// row together (JoinedSegments).
///
/// Of short pieces of facets that meet where both sides are smooth arcs the gap is that of the arcs (curvedGap).
///
/// A corner of a deformable solid above a face of another has one row, with the face as slave, in the place of those of
/// that segment and of its edges (CornerContacts), and its light nodes are tied to the body behind them (TipTies).
///
/// Slave is the side with the smaller cells (by a fifth or more), else the one with the lower material number. No row:
/// on segments shorter than shortest_segment (but where short_segments keeps them), on cell faces exposed by less than
/// exposed_face (but along walls, straight rigid edges and fluids), between driven bodies, between sides that share
/// their dof nodes, and where the segment's own normal is over 45 degrees off the fitted one.
///
/// Where the stress of one side acts over what it fills (ConstraintOptions::short_segments), and both sides end in one
/// cell, the weights of the row are those of the volume that the segment sweeps (edgeWeights), over the part w of the
/// segment by which the cell is full: traction and stress act on the nodes alike. Of a segment too short for a row half
/// the traction goes to the row at either of its ends (ShortSegments::Shared); it has a row of its own where its sides
/// pass each other by more than 0.02 cells in the step.
///
/// \param before v^{n-1/2} \param dt Of the step; 0: no motion is known.
/// \param tractions Where given, in: the pressures; out: what the rows leave of them (Harmos_PressureTractions.hpp).
ContactRows buildContactRows(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                             FilledRegions const &regions, InterfaceSegments const &segments, View<RayHit *> const &hit,
                             SegmentBins const &bins, BoundaryConditions const &conditions, BodyTable const &bodies,
                             std::vector<Bond> const &bonds, ConstraintOptions const &options,
                             Motion const &before = {}, double dt = 0.0, WorkArrays const &work = {},
                             PressureTractions *tractions = nullptr);

/// One row for every two materials that move a node (Merged: for every two that follow each other in its list, tied),
/// where they move it: G v = n . (v_b - v_a) of the node's own dofs, n the direction from the volume of a to that of b
/// in the cells around the node. The slave cell is the first around the node that holds material a.
/// Throws std::runtime_error where more than six materials (merged: 17) meet at a node.
ContactRows buildNodalRows(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                           FilledRegions const &regions, BoundaryConditions const &conditions, BodyTable const &bodies,
                           ConstraintOptions const &options, WorkArrays const &work = {});

/// The rows of this rank, with those of its halo where there are several ranks: segments, rays, normals, rows. Without
/// interface on any rank one reduction tells that there are none. Collective.
/// \param kept Room for the arrays, those of the result included; without it they own their memory.
/// \param outline, predicted Of the rigid bodies, where their contact comes from outlines (bodies.outlined).
/// \param tractions As of buildContactRows; with those of the halo as well. Of segments' rows alone: methods nodal and
///                  merged have none.
ContactRows findContactRows(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                            FilledRegions const &regions, BoundaryConditions const &conditions, BodyTable const &bodies,
                            std::vector<Bond> const &bonds, ConstraintOptions const &options, Exchange const &exchange,
                            Motion const &before = {}, double dt = 0.0, ConstraintWork *kept = nullptr,
                            std::vector<Shape> const &outline = {}, std::vector<RigidBody> const &predicted = {},
                            PressureTractions *tractions = nullptr);

/// Give every rank the rows of its halo to depth row_halo. With one rank: nothing.
void exchangeContactRows(Mesh const &mesh, CellMaterialPairs const &pairs, BodyTable const &bodies,
                         Exchange const &exchange, ContactRows &rows, WorkArrays const &work = {});

} // namespace Harmos

#endif
