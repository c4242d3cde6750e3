// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_OUTLINE_ROWS_HPP
#define HARMOS_OUTLINE_ROWS_HPP

#include <Harmos_ContactRows.hpp>
#include <Harmos_Shape.hpp>

namespace Harmos
{

/// Rows that come from the outlines of rigid bodies.
struct OutlineRows
{
  View<ContactRow *> row;
  int count = 0;
  long long num_multipliers = 0; // of this rank
};

/// \brief The rows between rigid bodies, and between free ones and contact walls, at the points where their exact
///        outlines come near each other. Those between bodies belong to rank 0, those at a wall to its cell's rank.
///
/// Facets would not do: rows ahead of the lowest point of a round body, held at a hair of overlap, forbid its turning.
/// Each has `bend`, the part of the gap's change over the step that is of second order in v* (paths along curved
/// outlines, corners that turn), so that what rolls or slides along an arc stays on it.
/// Where bodies are bonded they keep the rows of their segments.
///
/// \param outline By rigid body, at its present pose. \param bodies With predicted velocities.
/// \param bonds   Where bodies that are bonded with a strength are held.
/// \param reach   Wider gaps carry no row [length].
OutlineRows findOutlineRows(Mesh const &mesh, InterfaceSegments const &segments, BoundaryConditions const &conditions,
                            std::vector<Shape> const &outline, std::vector<RigidBody> const &bodies,
                            std::vector<Bond> const &bonds, ConstraintOptions const &options, Exchange const &exchange,
                            double reach, double dt);

/// Behind all others, once those have been exchanged: they touch no dof node, so that no other rank needs them.
void appendRows(OutlineRows const &added, ContactRows &rows);

} // namespace Harmos

#endif
