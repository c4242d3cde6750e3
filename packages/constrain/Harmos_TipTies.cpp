// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_LowerBound.hpp>
#include <Harmos_TipTies.hpp>

namespace Harmos
{
namespace
{

struct TipMarker
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  View<int *> cell_region; // of the filled regions: below zero in cells that nothing cuts
  View<InterfaceSegment *> segment;
  CornerContacts corners;
  BodyTable bodies;
  View<PairInteraction **> interaction;
  View<Boundary *> boundary;
  View<int *> of_tip;

  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    if (corners.carriedBy(i) < 0)
      return;
    CornerContact const &contact = corners.contact(corners.carriedBy(i));
    InterfaceSegment const &corner = segment(contact.segment);
    if (bodies.of(corner.material) != -1 || cornerRebounds(mesh, boundary, interaction, corner, segment(contact.face)))
      return;
    for (int which : {contact.segment, contact.tip, contact.edge[0], contact.edge[1]})
      for (int k = 0; which >= 0 && cell_region(segment(which).cell) >= 0 && k < 4; ++k)
      {
        int const dof = pairs.dof_node(segment(which).pair, k);
        if (dof_nodes.material(dof) >= 0)
          of_tip(dof) = 1; // whichever writes
      }
  }
};

} // namespace

TipTies findTipTies(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                    FilledRegions const &regions, InterfaceSegments const &segments, CornerContacts const &corners,
                    BodyTable const &bodies, ConstraintOptions const &options, BoundaryConditions const &conditions,
                    WorkArrays const &work)
{
  TipTies const ties{mesh,    pairs,  dof_nodes,
                     regions, bodies, work.zeros<int *>("Harmos::constrain::of_tip", dof_nodes.num_dof_nodes)};
  launchFor("Harmos::constrain::markTips", segments.count,
            TipMarker{mesh, pairs, dof_nodes, regions.cell_region, segments.segment, corners, bodies,
                      options.interaction, conditions.boundary, ties.of_tip});
  return ties;
}

void addTipTies(TipTies const &ties, ContactRows &rows, WorkArrays const &work)
{
  int const num_cells = ties.mesh.num_cells;
  View<int *> const first = work.unset<int *>("Harmos::constrain::first_tie", num_cells);
  int count = 0;
  launchScan(
      "Harmos::constrain::countTies", num_cells,
      KOKKOS_LAMBDA(int cell, int &sum, bool final) {
        if (final)
          first(cell) = sum;
        ties.forEach(cell, [&](ContactRow const &) { ++sum; });
      },
      count);
  if (count == 0)
    return;
  ContactRows const of_segments = rows;
  rows.count = rows.num_own = of_segments.count + count;
  rows.num_multipliers = of_segments.num_multipliers + 2 * count;
  rows.row = work.unset<ContactRow *>("Harmos::constrain::row", rows.count);
  rows.own = work.unset<int *>("Harmos::constrain::own_row", rows.count);
  View<ContactRow *> const row = rows.row, before = of_segments.row;
  View<int *> const own = rows.own;
  int const num_before = of_segments.count;
  launchFor(
      "Harmos::constrain::placeRows", num_before,
      KOKKOS_LAMBDA(int r) { row(r + first(before(r).cell_a)) = before(r); });
  launchFor(
      "Harmos::constrain::placeTies", num_cells, KOKKOS_LAMBDA(int cell) {
        int place = first(cell) + lowerBound(num_before, [&](int r) { return before(r).cell_a <= cell; });
        ties.forEach(cell, [&](ContactRow const &made) { row(place++) = made; });
      });
  launchFor(
      "Harmos::constrain::ownRows", rows.count, KOKKOS_LAMBDA(int r) { own(r) = r; });
}

} // namespace Harmos
