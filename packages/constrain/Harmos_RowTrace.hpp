// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ROW_TRACE_HPP
#define HARMOS_ROW_TRACE_HPP

#include <Harmos_ContactRows.hpp>

namespace Harmos
{

/// Where the line of a row's segment leaves the slave cell: two cell edges, by their nodes (twice the same: through the
/// node), the points where it crosses them, and the shares of both in the row's point (linear between them).
struct RowTrace
{
  long long node[2][2]; // global numbers of the nodes of each crossed edge, ascending
  double point[2][2];   // [m] where the segment ends
  double share[2];      // of the row's impulse, by end
  double length;        // [m] of the segment
  int material[2];      // on the segment's sides
};

/// The trace of a row; the normal is the row's.
KOKKOS_INLINE_FUNCTION RowTrace rowTrace(Mesh const &mesh, ContactRow const &row)
{
  constexpr double at_node = 1e-8; // distance of the line, in cells
  if (row.cell_a < 0)              // between outlines of rigid bodies: stands in no cell, and shares with none
  {
    RowTrace alone = {};
    alone.length = 1.0;
    alone.material[0] = row.material_a;
    alone.material[1] = row.material_b;
    for (int e = 0; e < 2; ++e)
      alone.node[e][0] = alone.node[e][1] = row.key;
    alone.share[0] = 1.0;
    return alone;
  }
  int const cell = row.cell_a;
  Quadrilateral const corner = cellQuadrilateral(mesh, cell);
  double const tolerance = at_node * Math::sqrt(mesh.cell_area(cell));
  double side[4];
  int nearest = 0;
  for (int k = 0; k < 4; ++k)
  {
    Vector2 const from = corner[k] - row.point, least = corner[nearest] - row.point;
    side[k] = dot(from, row.normal);
    nearest = dot(from, from) < dot(least, least) ? k : nearest;
  }
  RowTrace trace = {};
  trace.length = row.length;
  trace.material[0] = row.material_a;
  trace.material[1] = row.material_b;
  double along[2] = {0.0, 0.0};
  int count = 0;
  for (int k = 0; k < 4 && count < 2; ++k)
  {
    int const next = (k + 1) % 4;
    bool const through = Math::fabs(side[k]) <= tolerance;
    if (!through && (Math::fabs(side[next]) <= tolerance || side[k] * side[next] > 0.0))
      continue;
    double const part = through ? 0.0 : side[k] / (side[k] - side[next]);
    Vector2 const x = corner[k] + part * (corner[next] - corner[k]);
    long long const a = mesh.node_global(mesh.cell_node(cell, k));
    long long const b = through ? a : mesh.node_global(mesh.cell_node(cell, next));
    trace.node[count][0] = a < b ? a : b;
    trace.node[count][1] = a < b ? b : a;
    trace.point[count][0] = x[0];
    trace.point[count][1] = x[1];
    along[count++] = dot(x - row.point, perpendicular(row.normal));
  }
  // A line that grazes a corner: the corner takes it all.
  for (; count < 2; ++count)
  {
    trace.node[count][0] = trace.node[count][1] = mesh.node_global(mesh.cell_node(cell, nearest));
    trace.point[count][0] = corner[nearest][0];
    trace.point[count][1] = corner[nearest][1];
  }
  double const span = along[1] - along[0];
  double const share = Math::fabs(span) > tolerance ? along[1] / span : 0.5;
  trace.share[0] = Math::min(Math::max(share, 0.0), 1.0);
  trace.share[1] = 1.0 - trace.share[0];
  return trace;
}

} // namespace Harmos

#endif
