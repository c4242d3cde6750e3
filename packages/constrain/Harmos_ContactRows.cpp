// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactRows.hpp>
#include <Harmos_PressureTractions.hpp>
#include <Harmos_RowBuilder.hpp>
#include <Harmos_TipTies.hpp>

namespace Harmos
{

ContactRows buildContactRows(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                             FilledRegions const &regions, InterfaceSegments const &segments, View<RayHit *> const &hit,
                             SegmentBins const &bins, BoundaryConditions const &conditions, BodyTable const &bodies,
                             std::vector<Bond> const &bonds, ConstraintOptions const &options, Motion const &before,
                             double dt, WorkArrays const &work, PressureTractions *tractions)
{
  SegmentBearing const bearing{options.short_segments, options.shortest_segment, options.placement, options.fluid};
  BondedPlaces const bonded{options.interaction, binBonds(bonds, work)};
  RowBuilder const builder{
      mesh,
      pairs,
      dof_nodes,
      regions,
      bearing,
      segments,
      segments.segment,
      hit,
      facingSegments(segments.segment, hit, bins, work),
      bodies,
      conditions.boundary,
      bonded,
      options,
      bins,
      before,
      dt,
      findCornerContacts(mesh, pairs, segments, hit, bins, bodies, bearing, options, bonded, before, dt,
                         conditions.boundary, work)};
  View<PlannedRows *> const planned = work.unset<PlannedRows *>("Harmos::constrain::planned", segments.count);
  launchFor(
      "Harmos::constrain::planRows", segments.count, KOKKOS_LAMBDA(int i) { builder.plan(i, planned(i)); });
  if (tractions != nullptr)
    *tractions = findPressureTractions(builder, planned, tractions->pressure, work);
  View<int *> const place = work.unset<int *>("Harmos::constrain::row_place", segments.count);
  ContactRows rows;
  launchScan(
      "Harmos::constrain::countRows", segments.count,
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        if (final)
          place(i) = sum;
        sum += planned(i).count;
      },
      rows.count);
  rows.num_own = rows.count;
  rows.row = work.unset<ContactRow *>("Harmos::constrain::row", rows.count);
  rows.own = work.unset<int *>("Harmos::constrain::own_row", rows.count);
  View<ContactRow *> const row = rows.row;
  View<int *> const own = rows.own;
  launchReduce(
      "Harmos::constrain::makeRows", segments.count,
      KOKKOS_LAMBDA(int i, long long &multipliers) {
        for (int half = 0; half < planned(i).count; ++half)
        {
          int const r = place(i) + half;
          row(r) = builder.makeRow(i, planned(i), half);
          own(r) = r;
          multipliers += row(r).tied || row(r).friction > 0.0 ? 2 : 1;
        }
      },
      rows.num_multipliers);
  if (builder.corners.count > 0 && options.method == ConstraintMethod::Multipliers &&
      !sharesMultipliers(options.placement))
    addTipTies(
        findTipTies(mesh, pairs, dof_nodes, regions, segments, builder.corners, bodies, options, conditions, work),
        rows, work);
  return rows;
}

} // namespace Harmos
