// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Acceptors.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// Ascending set of the materials of one cell.
struct MaterialSet
{
  static constexpr int capacity = 2 * max_components;
  int size = 0;
  int material[capacity];
  bool overflow = false;

  KOKKOS_INLINE_FUNCTION void insert(int m)
  {
    int place = 0;
    while (place < size && material[place] < m)
      ++place;
    if (place < size && material[place] == m)
      return;
    if (size == capacity)
    {
      overflow = true;
      return;
    }
    for (int i = size; i > place; --i)
      material[i] = material[i - 1];
    material[place] = m;
    ++size;
  }
};

KOKKOS_INLINE_FUNCTION void insertInflow(Input const &in, int cell, int acceptor, MaterialSet &set)
{
  for (int face = 0; face < 4; ++face)
  {
    Boundary boundary;
    Quadrilateral q;
    if (inflowQuadrilateral(in, cell, face, boundary, q) &&
        overlayMoments(in.mesh, acceptor, q).volume() > least_overlay * in.mesh.cell_area(acceptor))
      set.insert(boundary.material);
  }
}

KOKKOS_INLINE_FUNCTION void collect(Input const &in, Classes const &classes, Donors const &donors,
                                    Overlays const &overlays, int acceptor, MaterialSet &set, bool &verbatim)
{
  bool const inflow = (classes.openAround(in.mesh, acceptor) & InflowBit) != 0;
  verbatim = !inflow;
  forCellAndNeighbours(in.mesh, acceptor,
                       [&](int cell)
                       {
                         int const index = classes.interface_index(cell);
                         if (index < 0)
                           return;
                         for (int donor = donors.offset(index); donor < donors.offset(index + 1); ++donor)
                         {
                           int const kind = donors.kind(donor);
                           verbatim = verbatim && (kind == QuietDonor || (kind == RigidDonor && cell != acceptor));
                           if (kind == RigidDonor)
                             continue;
                           int const slot = overlays.find(in.mesh, donor, cell, acceptor);
                           if (slot >= 0 && overlays.moment(slot, 0) > 0.0)
                             set.insert(in.pairs.material(donors.pair(donor)));
                         }
                         if (inflow)
                           insertInflow(in, cell, acceptor, set);
                       });
  if (in.rigid.offset.extent(0) == 0)
    return;
  for (int r = in.rigid.offset(acceptor); r < in.rigid.offset(acceptor + 1); ++r)
  {
    set.insert(in.rigid.material(r));
    verbatim = false;
  }
}

KOKKOS_INLINE_FUNCTION double boundaryDistance(Input const &in, int cell, int face, Vector2 const &point)
{
  Vector2 const a = in.node(in.mesh.cell_node(cell, face));
  Vector2 const edge = normalised(in.node(in.mesh.cell_node(cell, (face + 1) % 4)) - a);
  return -cross(edge, point - a);
}

/// Whether a point that left the domain near `cell` did so through an outflow face and not a contact wall: the boundary
/// face that it is farthest beyond decides.
KOKKOS_INLINE_FUNCTION bool leftThroughOutflow(Input const &in, int cell, Vector2 const &point)
{
  double farthest = 0.0;
  bool outflow = false;
  forCellAndNeighbours(in.mesh, cell,
                       [&](int near)
                       {
                         for (int face = 0; face < 4; ++face)
                         {
                           int const number = in.mesh.face_boundary(near, face);
                           if (number < 0)
                             continue;
                           double const beyond = boundaryDistance(in, near, face, point);
                           if (beyond > farthest)
                           {
                             farthest = beyond;
                             outflow = in.conditions.boundary(number).kind == BoundaryKind::Outflow;
                           }
                         }
                       });
  return outflow;
}

struct ResidueFunctor
{
  Input in;
  Classes classes;
  StageState stage;
  Donors donors;
  Overlays overlays;
  Acceptors acceptors;
  Residues residues;
  Bookings bookings;

  /// Totals of the donor less those of its overlays; returns the volume outside, its centroid in `outside`.
  KOKKOS_INLINE_FUNCTION double subtractOverlays(int donor, int cell, int &largest_slot, Vector2 &outside) const
  {
    double rest[num_stage_fields];
    double const volume = donors.shape(donor, 0);
    double const mass = stage.record(donors.pair(donor), Mass);
    for (int f = 0; f < num_stage_fields; ++f)
      rest[f] = (byVolume(f) ? volume : mass) * donors.polynomial(donor, f, 0);
    rest[0] = mass;
    double rest_volume = volume;
    double first[2] = {0.0, 0.0}; // about the donor's centroid
    double largest = 0.0;
    largest_slot = overlays.offset(donor);
    int const row = in.mesh.cell_neighbour.offset(cell);
    for (int slot = overlays.offset(donor); slot < overlays.offset(donor + 1); ++slot)
    {
      Moments<2> const m = slotMoments(overlays, slot);
      if (!(m.volume() > 0.0))
        continue;
      int const s = slot - overlays.offset(donor);
      Vector2 const origin = acceptorOrigin(in.mesh, s == 0 ? cell : in.mesh.cell_neighbour.item(row + s - 1));
      double part[num_stage_fields];
      integrate(donors, donor, m, origin, part);
      for (int f = 0; f < num_stage_fields; ++f)
        rest[f] -= part[f];
      rest_volume -= m.volume();
      for (int d = 0; d < 2; ++d)
        first[d] -= m.first(d) + m.volume() * (origin[d] - donors.shape(donor, 1 + d));
      if (m.volume() > largest)
      {
        largest = m.volume();
        largest_slot = slot;
      }
    }
    for (int f = 0; f < num_stage_fields; ++f)
      residues.integral(donor, f) = rest[f];
    double const scale = rest_volume != 0.0 ? 1.0 / rest_volume : 0.0;
    outside = {donors.shape(donor, 1) + scale * first[0], donors.shape(donor, 2) + scale * first[1]};
    return rest_volume;
  }

  KOKKOS_INLINE_FUNCTION void bookOutflow(int index, int donor) const
  {
    bookings(index, BookOutMass) += residues.integral(donor, 0);
    bookings(index, BookOutKinetic) += residues.integral(donor, KineticField);
    bookings(index, BookOutEnergy) += residues.integral(donor, InternalEnergy);
    for (int k = 0; k < 4; ++k)
    {
      bookings(index, BookOutMomentumX) += 0.25 * residues.integral(donor, first_corner_field + 2 * k);
      bookings(index, BookOutMomentumY) += 0.25 * residues.integral(donor, first_corner_field + 2 * k + 1);
    }
  }

  KOKKOS_INLINE_FUNCTION int residueTarget(int index, int donor, int cell, int largest_slot) const
  {
    int const material = in.pairs.material(donors.pair(donor));
    int const own = acceptors.find(index, material);
    if (own >= 0)
      return own;
    int const s = largest_slot - overlays.offset(donor);
    int const acceptor = in.mesh.cell_neighbour.item(in.mesh.cell_neighbour.offset(cell) + s - 1);
    return acceptors.find(classes.interface_index(acceptor), material);
  }

  KOKKOS_INLINE_FUNCTION void operator()(int index) const
  {
    int const cell = classes.interface_cell(index);
    bool const owned = in.mesh.cell_depth(cell) == 0;
    int const open = classes.openAround(in.mesh, cell);
    for (int donor = donors.offset(index); donor < donors.offset(index + 1); ++donor)
    {
      residues.target(donor) = -1;
      if (donors.kind(donor) == RigidDonor)
        continue;
      int largest_slot;
      Vector2 outside;
      double const lost = subtractOverlays(donor, cell, largest_slot, outside);
      double const tolerance = 1e-10 * donors.shape(donor, 0) + 1e-14 * in.mesh.cell_area(cell);
      bool const left = (open & OutflowBit) != 0 && lost > 1e-13 * in.mesh.cell_area(cell);
      if (left && ((open & ContactBit) == 0 || leftThroughOutflow(in, cell, outside)))
      {
        if (owned)
          bookOutflow(index, donor);
        continue;
      }
      if (owned && Math::fabs(lost) > tolerance && (open & (OutflowBit | ContactBit)) == 0)
        bookings(index, BookFailures) += 1.0;
      residues.target(donor) = residueTarget(index, donor, cell, largest_slot);
    }
  }
};

} // namespace

Acceptors findCandidates(Input const &in, Classes const &classes, Donors const &donors, Overlays const &overlays,
                         Bookings const &bookings)
{
  Acceptors acceptors;
  View<int *> const offset = scratch<int *>("candidateOffset", classes.num_interface + 1);
  View<int *> const verbatim = scratch<int *>("verbatim", classes.num_interface);
  Kokkos::parallel_for(
      "Harmos::remap::countCandidates", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int i) {
        MaterialSet set;
        bool same;
        int const cell = classes.interface_cell(i);
        collect(in, classes, donors, overlays, cell, set, same);
        offset(i) = set.size;
        verbatim(i) = same ? 1 : 0;
        if (set.overflow && in.mesh.cell_depth(cell) == 0)
          bookings(i, BookFailures) += 1.0;
      });
  acceptors.num = exclusiveScan(offset);
  acceptors.offset = offset;
  acceptors.verbatim = verbatim;
  View<int *> const material = scratch<int *>("candidateMaterial", acceptors.num);
  acceptors.material = material;
  Kokkos::parallel_for(
      "Harmos::remap::fillCandidates", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int i) {
        MaterialSet set;
        bool same;
        collect(in, classes, donors, overlays, classes.interface_cell(i), set, same);
        for (int m = 0; m < set.size; ++m)
          material(offset(i) + m) = set.material[m];
      });
  acceptors.merge_to = scratch<int *>("mergeTo", acceptors.num);
  acceptors.sum = scratch<double *[num_candidate_sums]>("candidateSum", acceptors.num);
  acceptors.record = scratch<double *[num_pair_fields]>("candidateRecord", acceptors.num);
  acceptors.kinetic = scratch<double *>("candidateKinetic", acceptors.num);
  acceptors.centroid = scratch<double *[2]>("candidateCentroid", acceptors.num);
  acceptors.corner_velocity = scratch<double *[8]>("candidateVelocity", acceptors.num);
  return acceptors;
}

Residues findResidues(Input const &in, Classes const &classes, StageState const &stage, Donors const &donors,
                      Overlays const &overlays, Acceptors const &acceptors, Bookings const &bookings)
{
  Residues const residues{scratch<int *>("residueTarget", donors.num),
                          scratch<double *[num_stage_fields]>("residue", donors.num)};
  Kokkos::parallel_for("Harmos::remap::findResidues", RangePolicy(0, classes.num_interface),
                       ResidueFunctor{in, classes, stage, donors, overlays, acceptors, residues, bookings});
  return residues;
}

} // namespace RemapDetail
} // namespace Harmos
