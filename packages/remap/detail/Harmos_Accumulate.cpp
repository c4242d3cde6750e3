// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Acceptors.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

struct AccumulateFunctor
{
  Input in;
  Classes classes;
  Donors donors;
  Overlays overlays;
  Residues residues;
  Acceptors acceptors;
  Bookings bookings;

  /// Add mass-weighted integrals of a donor whose corners are `rotation` ahead of the acceptor's.
  KOKKOS_INLINE_FUNCTION void add(int candidate, double const part[num_stage_fields], int rotation) const
  {
    for (int f = 0; f < first_corner_field; ++f)
      acceptors.sum(candidate, f) += part[f];
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < 2; ++d)
        acceptors.sum(candidate, first_corner_field + 2 * k + d) +=
            part[first_corner_field + 2 * ((k + rotation) % 4) + d];
  }

  KOKKOS_INLINE_FUNCTION void addVolume(int candidate, Moments<2> const &m) const
  {
    acceptors.sum(candidate, VolumeSum) += m.volume();
    acceptors.sum(candidate, FirstMomentX) += m.first(0);
    acceptors.sum(candidate, FirstMomentY) += m.first(1);
  }

  KOKKOS_INLINE_FUNCTION void addDonor(int index, int acceptor, int cell, int donor, int rotation) const
  {
    int const slot = overlays.find(in.mesh, donor, cell, acceptor);
    if (slot >= 0 && overlays.moment(slot, 0) > 0.0)
    {
      Moments<2> const m = slotMoments(overlays, slot);
      int const candidate = acceptors.find(index, in.pairs.material(donors.pair(donor)));
      if (candidate >= 0)
      {
        double part[num_stage_fields];
        integrate(donors, donor, m, acceptorOrigin(in.mesh, acceptor), part);
        add(candidate, part, rotation);
        addVolume(candidate, m);
      }
    }
    int const target = residues.target(donor);
    if (target >= acceptors.offset(index) && target < acceptors.offset(index + 1))
    {
      double rest[num_stage_fields];
      for (int f = 0; f < num_stage_fields; ++f)
        rest[f] = f >= DeviatorXX && f <= DeviatorXY ? 0.0 : residues.integral(donor, f);
      add(target, rest, rotation);
    }
  }

  KOKKOS_INLINE_FUNCTION void addInflow(int index, int acceptor, int cell) const
  {
    for (int face = 0; face < 4; ++face)
    {
      Boundary boundary;
      Quadrilateral q;
      if (!inflowQuadrilateral(in, cell, face, boundary, q))
        continue;
      Moments<2> const m = overlayMoments(in.mesh, acceptor, q);
      int const candidate = acceptors.find(index, boundary.material);
      if (candidate < 0 || !(m.volume() > least_overlay * in.mesh.cell_area(acceptor)))
        continue;
      double const mass = m.volume() / boundary.specific_volume;
      double part[num_stage_fields] = {};
      part[DensityField] = mass;
      part[KineticField] = 0.5 * mass * dot(boundary.velocity, boundary.velocity);
      part[SpecificVolume] = m.volume();
      part[InternalEnergy] = mass * boundary.internal_energy;
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < 2; ++d)
          part[first_corner_field + 2 * k + d] = mass * boundary.velocity[d];
      add(candidate, part, 0);
      addVolume(candidate, m);
      if (in.mesh.cell_depth(acceptor) != 0)
        continue;
      bookings(index, BookOutMass) -= mass;
      bookings(index, BookOutKinetic) -= part[KineticField];
      bookings(index, BookOutEnergy) -= part[InternalEnergy];
      bookings(index, BookOutMomentumX) -= mass * boundary.velocity[0];
      bookings(index, BookOutMomentumY) -= mass * boundary.velocity[1];
    }
  }

  KOKKOS_INLINE_FUNCTION void operator()(int index) const
  {
    int const acceptor = classes.interface_cell(index);
    for (int c = acceptors.offset(index); c < acceptors.offset(index + 1); ++c)
      for (int f = 0; f < num_candidate_sums; ++f)
        acceptors.sum(c, f) = 0.0;
    bool const inflow = (classes.openAround(in.mesh, acceptor) & InflowBit) != 0;
    forCellAndNeighbours(in.mesh, acceptor,
                         [&](int cell)
                         {
                           int const other = classes.interface_index(cell);
                           if (other < 0)
                             return;
                           int const rotation = cornerRotation(in.mesh, acceptor, cell);
                           for (int donor = donors.offset(other); donor < donors.offset(other + 1); ++donor)
                             if (donors.kind(donor) != RigidDonor)
                               addDonor(index, acceptor, cell, donor, rotation);
                           if (inflow)
                             addInflow(index, acceptor, cell);
                         });
  }
};

KOKKOS_INLINE_FUNCTION bool isFragment(Input const &in, Acceptors const &acceptors, int candidate, double cell_area)
{
  return !in.isRigid(acceptors.material(candidate)) &&
         acceptors.sum(candidate, VolumeSum) < in.options.merge_below * cell_area;
}

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
    if (candidate < 0 || isFragment(in, acceptors, candidate, in.mesh.cell_area(neighbour)))
      continue;
    double const fraction = acceptors.sum(candidate, VolumeSum) / in.mesh.cell_area(neighbour);
    if (fraction > largest)
    {
      largest = fraction;
      target = candidate;
    }
  }
  return target;
}

KOKKOS_INLINE_FUNCTION void takeFragment(Input const &in, Acceptors const &acceptors, int to, int from, int to_cell,
                                         int from_cell)
{
  int const rotation = cornerRotation(in.mesh, to_cell, from_cell);
  Vector2 const shift = acceptorOrigin(in.mesh, from_cell) - acceptorOrigin(in.mesh, to_cell);
  for (int f = 0; f < first_corner_field; ++f)
    acceptors.sum(to, f) += acceptors.sum(from, f);
  for (int k = 0; k < 4; ++k)
    for (int d = 0; d < 2; ++d)
      acceptors.sum(to, first_corner_field + 2 * k + d) +=
          acceptors.sum(from, first_corner_field + 2 * ((k + rotation) % 4) + d);
  double const volume = acceptors.sum(from, VolumeSum);
  acceptors.sum(to, VolumeSum) += volume;
  acceptors.sum(to, FirstMomentX) += acceptors.sum(from, FirstMomentX) + shift[0] * volume;
  acceptors.sum(to, FirstMomentY) += acceptors.sum(from, FirstMomentY) + shift[1] * volume;
}

} // namespace

void accumulate(Input const &in, Classes const &classes, Donors const &donors, Overlays const &overlays,
                Residues const &residues, Acceptors const &acceptors, Bookings const &bookings)
{
  Kokkos::parallel_for("Harmos::remap::accumulate", RangePolicy(0, classes.num_interface),
                       AccumulateFunctor{in, classes, donors, overlays, residues, acceptors, bookings});
}

void mergeFragments(Input const &in, Classes const &classes, Acceptors const &acceptors, Bookings const &bookings)
{
  Kokkos::parallel_for(
      "Harmos::remap::chooseMerges", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int i) {
        int const cell = classes.interface_cell(i);
        for (int c = acceptors.offset(i); c < acceptors.offset(i + 1); ++c)
        {
          bool const fragment = acceptors.verbatim(i) == 0 && isFragment(in, acceptors, c, in.mesh.cell_area(cell));
          int const target = fragment ? mergeTarget(in, classes, acceptors, cell, acceptors.material(c)) : -1;
          acceptors.merge_to(c) = target;
          if (target >= 0 && in.mesh.cell_depth(cell) == 0)
            bookings(i, BookMerged) += 1.0;
        }
      });
  if (in.options.merge_below <= 0.0)
    return;
  // Targets are no fragments: nobody reads what another writes.
  Kokkos::parallel_for(
      "Harmos::remap::gatherMerges", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int i) {
        int const cell = classes.interface_cell(i);
        for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
        {
          int const neighbour = in.mesh.cell_neighbour.item(j);
          int const other = classes.interface_index(neighbour);
          if (other < 0)
            continue;
          for (int from = acceptors.offset(other); from < acceptors.offset(other + 1); ++from)
          {
            int const to = acceptors.merge_to(from);
            if (to < acceptors.offset(i) || to >= acceptors.offset(i + 1))
              continue;
            takeFragment(in, acceptors, to, from, cell, neighbour);
            acceptors.verbatim(i) = 0;
          }
        }
      });
}

} // namespace RemapDetail
} // namespace Harmos
