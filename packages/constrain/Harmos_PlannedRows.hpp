// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PLANNED_ROWS_HPP
#define HARMOS_PLANNED_ROWS_HPP

#include <Harmos_RayCast.hpp>

namespace Harmos
{

/// The rows of a segment, before they are written.
struct PlannedRows
{
  int count;       // 0, 1 or 2
  bool joined;     // with other pieces of its line (JoinedSegments)
  int corner = -1; // the contact that the segment bears (CornerContacts), -1: none
  Vector2 normal[2];
  RayHit hit[2];
};

/// An end of a segment with one row may come by this in a step: half of the segment then overlaps by sqrt(2)/8 of it,
/// 0.004 of a cell. What lies on each other, or rolls, keeps one row. [cells]
constexpr double most_approach = 0.02;

/// An end that is, or gets, ahead of the middle by less goes through with the middle. [cells]
constexpr double least_lead = 1e-3;

} // namespace Harmos

#endif
