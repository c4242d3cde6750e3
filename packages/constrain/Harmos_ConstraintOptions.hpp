// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONSTRAINT_OPTIONS_HPP
#define HARMOS_CONSTRAINT_OPTIONS_HPP

#include <Harmos_Bonds.hpp>
#include <Harmos_Kokkos.hpp>

namespace Harmos
{

enum class Interaction : int
{
  Sliding, // frictionless, free to separate
  Bonded,  // no relative velocity at all, until the bond breaks
  Friction // Coulomb, free to separate
};

/// How two materials act on each other.
struct PairInteraction
{
  Interaction kind = Interaction::Sliding;
  double friction = 0.0;    // Friction: coefficient
  double restitution = 0.0; // Sliding, Friction: part of the closing speed that bodies part with, in [0, 1]
  BondStrength strength;    // Bonded
};

/// How the multipliers are found.
enum class MultiplierMethod : int
{
  ProjectedNewton,    // with a factor of the assembled matrix (doc/decisions/0010)
  ConjugateGradients, // with projections, without a matrix (doc/decisions/0004)
  RowSums             // p <- bounds(p - r / D)
};

/// What acts at the interfaces.
enum class ConstraintMethod : int
{
  Multipliers, // forward-increment Lagrange multipliers, one for each interface segment
  Penalty,     // traction in proportion to the closing velocity of v*
  Nitsche,     // mean stress of both sides, and a penalty on the closing velocity of v^{n-1/2}
  Nodal,       // contact at nodes that several materials move, along the gradient of their volumes (as in MPM)
  Merged       // all materials at a node stick
};

/// Where on the interface segments the multipliers stand.
enum class Placement : int
{
  Midpoint,
  GaussPoints,   // two
  SegmentEnds,   // two
  VitalVertices, // one for each vital cell edge that the interface crosses, shared by the segments around it
  Mortar         // of the same, with the approach integrated over the segments
};

/// Whether rows share multipliers, which only MultiplierMethod::ProjectedNewton solves for.
KOKKOS_INLINE_FUNCTION bool sharesMultipliers(Placement placement)
{
  return placement == Placement::VitalVertices || placement == Placement::Mortar;
}

/// What becomes of a material's segments inside cells that are shorter than ConstraintOptions::shortest_segment, and
/// over what the tractions on its segments act.
enum class ShortSegments
{
  Dropped, // no row; rows act at their points
  Kept,    // rows of their own; rows act over their segments, in balance with stress that acts over what it fills
  Shared   // in full cells half of the traction goes to the row at either end, and rows act over their segments
};

struct ConstraintOptions
{
  ConstraintMethod method = ConstraintMethod::Multipliers;
  Placement placement = Placement::Midpoint;
  double penalty = 1.0;     // Penalty, Nitsche: traction over impedance times velocity
  View<double *> impedance; // materials: density times longitudinal wave speed [kg/(m^2 s)], 0: rigid
  MultiplierMethod solver = MultiplierMethod::ProjectedNewton;
  bool warm_start = false;              // rows with multipliers of their own: begin with the last cycle's forces
  View<PairInteraction **> interaction; // (materials, materials), symmetric
  double tolerance = 1e-8;              // of max(largest predicted |G v|, 1e-6 speed_scale)
  int max_iterations = 1000;
  double speed_scale = 0.0;             // of the scene [m/s]
  double shortest_segment = 0.1;        // of the cell size; shorter segments carry no row but as short_segments says
  View<ShortSegments *> short_segments; // materials; extent 0: all Dropped
  View<int *> fluid;         // materials: 1 where its pressure acts on all of its outline (no strength, Kept);
                             // extent 0: none
  double exposed_face = 0.5; // least exposed part of a cell face that carries a row
  bool outline_rows = true;  // Multipliers: contact of rigid bodies with each other and with walls by their outlines,
                             // where those are known; false: by segments (set by startCycle: lagrangian)
};

} // namespace Harmos

#endif
