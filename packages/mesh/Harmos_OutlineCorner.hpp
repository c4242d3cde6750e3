// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_OUTLINE_CORNER_HPP
#define HARMOS_OUTLINE_CORNER_HPP

#include <Harmos_AreaWeight.hpp>
#include <Harmos_Bilinear.hpp>
#include <Harmos_Kokkos.hpp>

namespace Harmos
{

struct Shape;

/// What two straight edges of a body's outline bound in a cell.
enum class CornerKind
{
  None,   // no edge, one, or more than two, or round ones
  Convex, // the body lies behind both edges
  Notch   // all that lies behind neither
};

/// Two edges of an outline in a cell. They need not meet there: a plate thinner than the cell is behind both of its
/// faces, what is in a slot behind neither.
struct OutlineCorner
{
  CornerKind kind = CornerKind::None;
  Vector2 normal[2] = {}; // unit, leave what is convex: the body, or what lies in the notch
  double beyond = 0.0;    // part of the cell's volume that the first edge's line cuts off what is convex
};

/// Corners of rigid bodies' outlines at their poses: compressed rows over cells (rigidVolumes).
struct RigidCorners
{
  View<int *> offset = {}; // num_cells + 1; extent 0: none
  View<int *> material = {};
  View<double *> volume_fraction = {};
  View<OutlineCorner *> corner = {};
};

/// The corner of a polygon's or rectangle's outline in a convex cell.
/// \param fraction Part of the cell's volume that the shape fills, which the corner must leave to 1e-12.
OutlineCorner outlineCorner(Quadrilateral const &cell, Geometry geometry, Shape const &shape, double fraction);

} // namespace Harmos

#endif
