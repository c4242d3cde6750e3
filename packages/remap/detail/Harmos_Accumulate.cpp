// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Acceptors.hpp>
#include <detail/Harmos_CornerTransfer.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

KOKKOS_INLINE_FUNCTION bool isFragment(Input const &in, Acceptors const &acceptors, int candidate, double cell_volume)
{
  return !in.isRigid(acceptors.material(candidate)) &&
         acceptors.sum(candidate, VolumeSum) < in.options.merge_below * cell_volume;
}

struct AccumulateFunctor
{
  Input in;
  Classes classes;
  Donors donors;
  Overlays overlays;
  Acceptors acceptors;
  Bookings bookings;

  /// The candidates of a cell at work.
  struct Row
  {
    int index, first, count;
    bool full; // and one more wanted
  };

  KOKKOS_INLINE_FUNCTION void copyCandidate(int from, int to) const
  {
    acceptors.material(to) = acceptors.material(from);
    for (int f = 0; f < num_overlay_sums; ++f)
      acceptors.sum(to, f) = acceptors.sum(from, f);
  }

  /// The candidate of a material, which is made where there is none; -1: no room.
  KOKKOS_INLINE_FUNCTION int candidateOf(Row &row, int material) const
  {
    int place = row.first;
    int const end = row.first + row.count;
    while (place < end && acceptors.material(place) < material)
      ++place;
    if (place < end && acceptors.material(place) == material)
      return place;
    if (row.count == acceptors.room)
    {
      row.full = true;
      return -1;
    }
    for (int c = end; c > place; --c)
      copyCandidate(c - 1, c);
    ++row.count;
    acceptors.material(place) = material;
    for (int f = 0; f < num_overlay_sums; ++f)
      acceptors.sum(place, f) = 0.0;
    return place;
  }

  /// Corner sums of a part of `cell` in the order of the acceptor's corners, which lag by `rotation`, and for its
  /// shares.
  KOKKOS_INLINE_FUNCTION FieldPack cornersOf(double const *part, int cell, int acceptor, int rotation) const
  {
    FieldPack const turned = rotatedCorners(part + first_corner_field, rotation);
    if (in.share.quarters())
      return turned;
    double corner[8];
    turned.store(corner);
    reshare(in.share, cell, acceptor, rotation, corner);
    return FieldPack(corner);
  }

  /// Add integrals of a donor of `cell`, whose corners are `rotation` ahead of the acceptor's.
  KOKKOS_INLINE_FUNCTION void addOverlay(int candidate, double const *part, int cell, int acceptor, int rotation) const
  {
    double *sum = &acceptors.sum(candidate, 0);
    StageFields total = loadStageFields(sum);
    total += {FieldPack(part), cornersOf(part, cell, acceptor, rotation)};
    total.store(sum);
    (FieldPack(sum + VolumeSum) + FieldPack(part + VolumeSum)).store(sum + VolumeSum);
  }

  KOKKOS_INLINE_FUNCTION bool flowsIn(int cell, int acceptor, int face, Boundary &boundary, Moments<1> &m) const
  {
    Quadrilateral q;
    if (!inflowQuadrilateral(in, cell, face, boundary, q))
      return false;
    m = inflowMoments(in.mesh, acceptor, q);
    return m.volume() > least_overlay * in.mesh.cell_volume(acceptor);
  }

  /// What a donor of `cell`, in which the acceptor has the slot, gives the acceptor.
  struct Part
  {
    int donor, cell, slot, rotation;
  };

  /// Parts that wait to be added, in their order.
  struct Parts
  {
    static constexpr int room = 24;
    int count = 0;
    Part part[room];
  };

  KOKKOS_INLINE_FUNCTION void addParts(Row &row, Parts &parts) const
  {
    int const acceptor = classes.interface_cell(row.index);
    for (int i = 0; i < parts.count; ++i)
    {
      Part const &p = parts.part[i];
      int const candidate = candidateOf(row, donors.head(p.donor).material);
      if (candidate < 0)
        continue;
      addOverlay(candidate, overlays.row(p.donor, p.slot), p.cell, acceptor, p.rotation);
    }
    parts.count = 0;
  }

  KOKKOS_INLINE_FUNCTION void addInflow(Row &row, int acceptor, int cell) const
  {
    for (int face = 0; face < 4; ++face)
    {
      Boundary boundary;
      Moments<1> m;
      int const candidate = flowsIn(cell, acceptor, face, boundary, m) ? candidateOf(row, boundary.material) : -1;
      if (candidate < 0)
        continue;
      double const mass = m.volume() / boundary.specific_volume;
      double part[num_overlay_sums] = {};
      part[DensityField] = mass;
      double const kinetic = 0.5 * mass * dot(boundary.velocity, boundary.velocity);
      part[KineticField] = in.carriesDamage() ? 0.0 : kinetic; // what flows in is sound
      part[SpecificVolume] = m.volume();
      part[InternalEnergy] = mass * boundary.internal_energy;
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < 2; ++d)
          part[first_corner_field + 2 * k + d] = mass * boundary.velocity[d];
      part[VolumeSum] = m.volume();
      part[FirstMomentX] = m.first(0);
      part[FirstMomentY] = m.first(1);
      addOverlay(candidate, part, acceptor, acceptor, 0);
      if (in.mesh.cell_depth(acceptor) != 0)
        continue;
      bookings(row.index, BookInMass) += mass;
      bookings(row.index, BookInKinetic) += kinetic;
      bookings(row.index, BookInEnergy) += part[InternalEnergy];
      bookings(row.index, BookInMomentumX) += mass * boundary.velocity[0];
      bookings(row.index, BookInMomentumY) += mass * boundary.velocity[1];
    }
  }

  /// \return Whether nothing around moves: the cell keeps its bits.
  KOKKOS_INLINE_FUNCTION bool gather(Row &row, int acceptor) const
  {
    bool const inflow = (classes.openAround(acceptor) & InflowBit) != 0;
    bool verbatim = !inflow;
    Parts parts; // rows lie scattered in the outer cache: all are asked for before the first is added
    forCellAndNeighbours(in.mesh, in.links, acceptor,
                         [&](int cell, int slot, int rotation)
                         {
                           int const other = classes.interface_index(cell);
                           if (other < 0)
                             return;
                           for (int donor = donors.offset(other); donor < donors.offset(other + 1); ++donor)
                           {
                             DonorHead const &head = donors.head(donor);
                             verbatim =
                                 verbatim && (head.kind == QuietDonor || (head.kind == RigidDonor && cell != acceptor));
                             if ((head.overlaps >> slot & 1ull) == 0)
                               continue;
                             overlays.fetch<false>(donor, slot);
                             parts.part[parts.count++] = {donor, cell, slot, rotation};
                             if (parts.count == Parts::room)
                               addParts(row, parts);
                           }
                           if (inflow)
                           {
                             addParts(row, parts);
                             addInflow(row, acceptor, cell);
                           }
                         });
    addParts(row, parts);
    if (in.rigid.offset.extent(0) == 0)
      return verbatim;
    for (int r = in.rigid.offset(acceptor); r < in.rigid.offset(acceptor + 1); ++r)
    {
      candidateOf(row, in.rigid.material(r));
      verbatim = false;
    }
    return verbatim;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int index, int &fragments, int &full) const
  {
    int const acceptor = classes.interface_cell(index);
    for (int c = BookInMass; c <= BookInMomentumY; ++c)
      bookings(index, c) = 0.0;
    Row row{index, acceptors.begin(index), 0, false};
    bool const verbatim = gather(row, acceptor);
    acceptors.verbatim(index) = verbatim ? 1 : 0;
    acceptors.count(index) = row.count;
    if (row.full && acceptors.room == most_candidates && in.mesh.cell_depth(acceptor) == 0)
      bookings(index, BookFailures) += 1.0;
    full += row.full ? 1 : 0;
    double const cell_volume = in.mesh.cell_volume(acceptor);
    for (int c = row.first; c < row.first + row.count; ++c)
    {
      acceptors.merge_to(c) = -1;
      fragments += !verbatim && isFragment(in, acceptors, c, cell_volume) ? 1 : 0;
    }
  }
};

/// The candidate of the same material with the largest volume fraction among the vertex neighbours, no fragment itself;
/// the lowest cell where equal; -1: none.
KOKKOS_INLINE_FUNCTION int mergeTarget(Input const &in, Classes const &classes, Acceptors const &acceptors, int cell,
                                       int material)
{
  int target = -1;
  double largest = 0.0;
  for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
  {
    int const neighbour = in.mesh.cell_neighbour.item(j);
    int const index = classes.interface_index(neighbour);
    int const candidate = index < 0 ? -1 : acceptors.find(index, material);
    if (candidate < 0 || isFragment(in, acceptors, candidate, in.mesh.cell_volume(neighbour)))
      continue;
    double const fraction = acceptors.sum(candidate, VolumeSum) / in.mesh.cell_volume(neighbour);
    if (fraction > largest)
    {
      largest = fraction;
      target = candidate;
    }
  }
  return target;
}

KOKKOS_INLINE_FUNCTION void takeFragment(Input const &in, Acceptors const &acceptors, int to, int from, int rotation,
                                         int to_cell, int from_cell)
{
  Vector2 const shift = acceptorOrigin(in.mesh, from_cell) - acceptorOrigin(in.mesh, to_cell);
  for (int f = 0; f < first_corner_field; ++f)
    acceptors.sum(to, f) += acceptors.sum(from, f);
  double corner[8];
  rotatedCorners(&acceptors.sum(from, first_corner_field), rotation).store(corner);
  reshare(in.share, from_cell, to_cell, rotation, corner);
  for (int i = 0; i < 8; ++i)
    acceptors.sum(to, first_corner_field + i) += corner[i];
  double const volume = acceptors.sum(from, VolumeSum);
  acceptors.sum(to, VolumeSum) += volume;
  acceptors.sum(to, FirstMomentX) += acceptors.sum(from, FirstMomentX) + shift[0] * volume;
  acceptors.sum(to, FirstMomentY) += acceptors.sum(from, FirstMomentY) + shift[1] * volume;
}

} // namespace

int accumulate(Input const &in, Classes const &classes, Donors const &donors, Overlays const &overlays,
               Acceptors &acceptors, Bookings const &bookings)
{
  int const cells = classes.num_interface;
  grow(acceptors.count, "candidateCount", cells);
  grow(acceptors.verbatim, "verbatim", cells);
  for (;; acceptors.room = Math::min(2 * acceptors.room, most_candidates))
  {
    std::size_t const candidates = static_cast<std::size_t>(cells) * acceptors.room;
    grow(acceptors.material, "candidateMaterial", candidates);
    grow(acceptors.merge_to, "mergeTo", candidates);
    grow(acceptors.sum, "candidateSum", candidates);
    grow(acceptors.record, "candidateRecord", candidates);
    grow(acceptors.kinetic, "candidateKinetic", candidates);
    grow(acceptors.centroid, "candidateCentroid", candidates);
    grow(acceptors.corner_velocity, "candidateVelocity", candidates);
    int fragments = 0, full = 0;
    Kokkos::parallel_reduce("Harmos::remap::accumulate", RangePolicy(0, cells),
                            AccumulateFunctor{in, classes, donors, overlays, acceptors, bookings}, fragments, full);
    if (full == 0 || acceptors.room == most_candidates)
      return fragments;
  }
}

void mergeFragments(Input const &in, Classes const &classes, Acceptors const &acceptors, Bookings const &bookings)
{
  Kokkos::parallel_for(
      "Harmos::remap::chooseMerges", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int i) {
        if (acceptors.verbatim(i) != 0)
          return;
        int const cell = classes.interface_cell(i);
        for (int c = acceptors.begin(i); c < acceptors.end(i); ++c)
        {
          bool const fragment = isFragment(in, acceptors, c, in.mesh.cell_volume(cell));
          int const target = fragment ? mergeTarget(in, classes, acceptors, cell, acceptors.material(c)) : -1;
          acceptors.merge_to(c) = target;
          if (target >= 0 && in.mesh.cell_depth(cell) == 0)
            bookings(i, BookMerged) += 1.0;
        }
      });
  // Targets are no fragments: nobody reads what another writes.
  Kokkos::parallel_for(
      "Harmos::remap::gatherMerges", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int i) {
        int const cell = classes.interface_cell(i);
        int const first = acceptors.begin(i), end = acceptors.end(i);
        for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
        {
          int const neighbour = in.mesh.cell_neighbour.item(j);
          int const other = classes.interface_index(neighbour);
          if (other < 0)
            continue;
          for (int from = acceptors.begin(other); from < acceptors.end(other); ++from)
          {
            int const to = acceptors.merge_to(from);
            if (to < first || to >= end)
              continue;
            takeFragment(in, acceptors, to, from, in.links.rotation(j), cell, neighbour);
            acceptors.verbatim(i) = 0;
          }
        }
      });
}

} // namespace RemapDetail
} // namespace Harmos
