// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Overlays.hpp>

#include <detail/Harmos_DonorPolynomial.hpp>
#include <detail/Harmos_OverlayMoments.hpp>
#include <detail/Harmos_QuadraticPolynomial.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

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
  forCellAndNeighbours(in.mesh, in.links, cell,
                       [&](int near, int, int)
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

/// Whether a slip wall near `cell` bends: its nodes move along mean tangents, and so a little across its faces.
KOKKOS_INLINE_FUNCTION bool curvedWallAround(Input const &in, int cell)
{
  bool curved = false;
  forCellAndNeighbours(in.mesh, in.links, cell,
                       [&](int near, int, int)
                       {
                         for (int i = 0; i < 8; ++i)
                         {
                           int const face = i / 2;
                           int const number = in.mesh.face_boundary(near, face);
                           if (number < 0 || in.conditions.boundary(number).kind != BoundaryKind::SlipWall)
                             continue;
                           int const node = in.mesh.cell_node(near, (face + i % 2) % 4);
                           NodeCondition const &condition = in.conditions.condition(in.conditions.node_index(node));
                           Vector2 const edge = in.node(in.mesh.cell_node(near, (face + 1) % 4)) -
                                                in.node(in.mesh.cell_node(near, face));
                           curved = curved || (condition.count == 1 &&
                                               Math::fabs(dot(condition.normal[0], normalised(edge))) > 1e-12);
                         }
                       });
  return curved;
}

/// Of the cell: what overlays leave of a donor beside an outflow boundary has left through it where there is more.
constexpr double least_rest = 1e-13;

/// A donor at work.
template <class Polynomial>
struct DonorAtWork
{
  int number, cell;
  double volume, mass;
  double measure; // DonorHead
  Vector2 centroid;
  Polynomial polynomial;
  unsigned long long overlaps;
  // what is left of it, and the heaviest overlay
  StageFields rest;
  double rest_volume;
  Vector2 rest_first; // about the centroid
  double heaviest;
  int heaviest_slot;
};

/// Cells whose overlays with a donor are found at once.
struct SlotPack
{
  int count = 0;
  int slot[pack_width], acceptor[pack_width];

  KOKKOS_INLINE_FUNCTION void add(int its_slot, int its_acceptor)
  {
    slot[count] = its_slot;
    acceptor[count++] = its_acceptor;
  }
};

/// Finder: PolynomialFinder, QuadraticFinder, or those for rings.
template <class Finder>
struct IntersectFunctor : Finder
{
  using OverlayMoments = typename Finder::OverlayMoments;
  using Donor = DonorAtWork<typename Finder::Polynomial>;
  using List = OverlayList<OverlayMoments>;
  using Finder::classes;
  using Finder::donors;
  using Finder::in;
  using Finder::stage;
  Overlays overlays;
  Bookings bookings;

  IntersectFunctor(Finder const &finder, Overlays const &o, Bookings const &b)
      : Finder(finder), overlays(o), bookings(b)
  {
  }

  /// Book an overlay in the acceptor's slot.
  /// \param fields The moments that the fields are integrated with.
  /// \param largest Whether it is the donor's largest.
  KOKKOS_INLINE_FUNCTION void take(Donor &d, int slot, int acceptor, OverlayMoments const &m,
                                   OverlayMoments const &fields, bool largest) const
  {
    StageFields const part = Finder::integrate(d.polynomial, fields, largest);
    d.rest -= part;
    d.rest_volume -= m.volume();
    d.rest_first -= Vector2{m.first(0), m.first(1)};
    bool const first = d.overlaps == 0;
    d.overlaps |= 1ull << slot;
    if (first || part.record[DensityField] > d.heaviest)
    {
      d.heaviest = part.record[DensityField];
      d.heaviest_slot = slot;
    }
    Vector2 const shift = d.centroid - acceptorOrigin(in.mesh, acceptor);
    double *row = overlays.row(d.number, slot);
    part.store(row);
    row[VolumeSum] = m.volume();
    row[FirstMomentX] = m.first(0) + m.volume() * shift[0];
    row[FirstMomentY] = m.first(1) + m.volume() * shift[1];
    for (int i = FirstMomentY + 1; i < num_overlay_sums; ++i)
      row[i] = 0.0;
  }

  /// A donor before any overlay is taken from it.
  KOKKOS_INLINE_FUNCTION void begin(Donor &d) const
  {
    d.overlaps = 0;
    d.rest.record = d.polynomial.mean.record * fieldWeights(d.volume, d.mass);
    d.rest.record.template set<DensityField>(d.mass);
    d.rest.corner = d.polynomial.mean.corner * FieldPack(d.mass);
    d.rest_volume = d.volume;
    d.rest_first = {0.0, 0.0};
    d.heaviest = 0.0;
    d.heaviest_slot = 0;
  }

  /// A whole donor lies in its own cell.
  KOKKOS_INLINE_FUNCTION void takeWhole(Donor &d) const
  {
    OverlayMoments m;
    m.value[0] = d.volume;
    take(d, 0, d.cell, m, m, true);
  }

  KOKKOS_INLINE_FUNCTION void addIfAny(List &list, int slot, int acceptor, OverlayMoments const &m) const
  {
    if (m.volume() > least_overlay * in.mesh.cell_volume(acceptor))
      list.add(slot, acceptor, m);
  }

  /// The overlay with one cell.
  KOKKOS_INLINE_FUNCTION void cutSlot(List &list, Donor const &d, MovedVertices const &v, int slot, int acceptor) const
  {
    bool whole = false;
    Window const w = windowAbout(in.mesh, acceptor, d.centroid);
    OverlayMoments const m = measuredBy(
        d.measure,
        Finder::measured(momentsInside<typename Finder::PlaneMoments, max_region_vertices>(v.size, v.x, v.y, w, whole),
                         d.centroid[0]));
    addIfAny(list, slot, acceptor, whole ? list.whole : m);
  }

  /// The overlays with the cells of a pack, which is emptied.
  KOKKOS_INLINE_FUNCTION void cutPack(List &list, Donor const &d, MovedVertices const &v, SlotPack &pack) const
  {
    for (int lane = pack.count; lane < pack_width; ++lane)
      pack.acceptor[lane] = pack.acceptor[0];
    OverlayPack const m = momentsInWindows(v.size, v.x, v.y, windowsAbout(in.mesh, pack.acceptor, d.centroid));
    double value[Moments<2>::count][pack_width];
    for (int i = 0; i < Moments<2>::count; ++i)
      storePack(value[i], m.value[i]);
    for (int lane = 0; lane < pack.count; ++lane)
    {
      if (laneOf(m.pieces, lane) > 1.0)
      {
        cutSlot(list, d, v, pack.slot[lane], pack.acceptor[lane]);
        continue;
      }
      OverlayMoments one;
      for (int i = 0; i < Moments<2>::count; ++i)
        one.value[i] = d.measure * value[i][lane];
      addIfAny(list, pack.slot[lane], pack.acceptor[lane], one);
    }
    pack.count = 0;
  }

  /// All overlays of a moving donor.
  KOKKOS_INLINE_FUNCTION void cutDonor(Donor const &d, List &list) const
  {
    MovedVertices const v = verticesAbout(donors.polygon(d.number), d.centroid);
    list.whole = Finder::wholeMoments(d.number, v);
    Region const &region = donors.polygon(d.number);
    double low_x = region[0][0], high_x = low_x, low_y = region[0][1], high_y = low_y;
    for (int i = 1; i < region.size; ++i)
    {
      low_x = Math::min(low_x, region[i][0]);
      high_x = Math::max(high_x, region[i][0]);
      low_y = Math::min(low_y, region[i][1]);
      high_y = Math::max(high_y, region[i][1]);
    }
    auto const candidate = [&](int acceptor)
    {
      return classes.interface_index(acceptor) >= 0 && high_x > in.links.box(acceptor, 0) &&
             low_x < in.links.box(acceptor, 2) && high_y > in.links.box(acceptor, 1) &&
             low_y < in.links.box(acceptor, 3);
    };
    int const row = in.mesh.cell_neighbour.offset(d.cell);
    int const slots = 1 + in.mesh.cell_neighbour.offset(d.cell + 1) - row;
    SlotPack pack;
    for (int s = 0; s < slots; ++s)
    {
      int const acceptor = s == 0 ? d.cell : in.mesh.cell_neighbour.item(row + s - 1);
      if (!candidate(acceptor))
        continue;
      if (!Finder::overlaysInPacks() || v.size > most_pack_vertices)
      {
        cutSlot(list, d, v, s, acceptor);
        continue;
      }
      pack.add(s, acceptor);
      if (pack.count == pack_width)
        cutPack(list, d, v, pack);
    }
    if (pack.count > 0)
      cutPack(list, d, v, pack);
    list.setRest();
  }

  /// Whether a donor without overlays lies beyond an outflow face: fragments there leave in one step.
  KOKKOS_INLINE_FUNCTION bool isGone(Donor const &d, int open) const
  {
    return (open & OutflowBit) != 0 && d.volume > least_rest * in.mesh.cell_volume(d.cell) &&
           leftThroughOutflow(in, d.cell, d.centroid);
  }

  /// A donor of which nothing is left above the threshold stays whole: its volume fraction at its old centroid.
  KOKKOS_INLINE_FUNCTION void makeWhole(Donor &d, int pair) const
  {
    double const volume = in.state.record(pair, VolumeFraction) * in.mesh.cell_volume(d.cell);
    StageFields mean = loadStageFields(&donors.value(d.number, 0));
    mean.record.template set<DensityField>(mean.record[DensityField] * (d.volume / volume));
    d.polynomial = Finder::constant(mean);
    d.volume = volume;
    if (in.pairs.cell_kind(d.cell) != PureCell)
      d.centroid = in.carried(d.cell, {in.state.centroid(pair, 0), in.state.centroid(pair, 1)});
    begin(d);
    takeWhole(d);
  }

  KOKKOS_INLINE_FUNCTION void bookOutflow(int index, int cell, StageFields const &rest) const
  {
    bookings(index, BookOutMass) += rest.record[DensityField];
    bookings(index, BookOutKinetic) +=
        in.carriesDamage() ? momentumKineticEnergy(in.share, cell, rest.record[DensityField], rest.corner)
                           : rest.record[KineticField];
    bookings(index, BookOutEnergy) += rest.record[InternalEnergy];
    for (int k = 0; k < 4; ++k)
    {
      bookings(index, BookOutMomentumX) += in.share(cell, k) * rest.corner[2 * k];
      bookings(index, BookOutMomentumY) += in.share(cell, k) * rest.corner[2 * k + 1];
    }
  }

  /// The rest goes through an outflow boundary, or with the heaviest overlay.
  KOKKOS_INLINE_FUNCTION void placeRest(int index, Donor &d, int open) const
  {
    double const whole = in.mesh.cell_volume(d.cell);
    double const scale = d.rest_volume != 0.0 ? 1.0 / d.rest_volume : 0.0;
    Vector2 const outside = d.centroid + scale * d.rest_first;
    bool const owned = in.mesh.cell_depth(d.cell) == 0;
    bool const left = (open & OutflowBit) != 0 && d.rest_volume > least_rest * whole;
    if (left && ((open & ContactBit) == 0 || leftThroughOutflow(in, d.cell, outside)))
    {
      if (owned)
        bookOutflow(index, d.cell, d.rest);
      return;
    }
    double const tolerance = 1e-10 * d.volume + 1e-14 * whole;
    if (owned && Math::fabs(d.rest_volume) > tolerance && (open & (OutflowBit | ContactBit)) == 0 &&
        !curvedWallAround(in, d.cell))
    {
      if (bookings(index, BookFailures) == 0.0)
        bookings(index, BookFailedMaterial) = donors.head(d.number).material + 1.0;
      bookings(index, BookFailures) += 1.0;
    }
    d.rest.record.template set<DeviatorXX>(0.0);
    d.rest.record.template set<DeviatorYY>(0.0);
    d.rest.record.template set<DeviatorXY>(0.0);
    double *const row = overlays.row(d.number, d.heaviest_slot);
    StageFields heaviest = loadStageFields(row);
    heaviest += d.rest;
    heaviest.store(row);
  }

  KOKKOS_INLINE_FUNCTION void remapDonor(int index, int cell, int number, int open) const
  {
    DonorHead &head = donors.head(number);
    if (head.kind == RigidDonor)
      return;
    Donor d;
    d.number = number;
    d.cell = cell;
    d.volume = donors.shape(number, 0);
    d.mass = stage.record(head.pair, Mass);
    d.measure = head.measure;
    d.centroid = {donors.shape(number, 1), donors.shape(number, 2)};
    if (head.kind == MovingDonor)
    {
      List list;
      cutDonor(d, list);
      for (int o = 0; o < list.size; ++o)
        overlays.fetch<true>(number, list.slot[o]);
      if (list.size == 0 && isGone(d, open))
      {
        d.polynomial = Finder::constant(loadStageFields(&donors.value(number, 0)));
        begin(d);
      }
      else if (list.size == 0)
        makeWhole(d, head.pair);
      else
      {
        d.polynomial = Finder::polynomial(number, cell, list);
        begin(d);
        int const largest = list.largest();
        for (int o = 0; o < list.size; ++o)
          take(d, list.slot[o], list.acceptor[o], list.moments(o), list.fieldMoments(o), o == largest);
      }
    }
    else
    {
      d.polynomial = Finder::constant(loadStageFields(&donors.value(number, 0)));
      begin(d);
      takeWhole(d);
    }
    head.overlaps = d.overlaps;
    placeRest(index, d, open);
  }

  KOKKOS_INLINE_FUNCTION void operator()(int index) const
  {
    int const cell = classes.interface_cell(index);
    for (int c = 0; c < num_bookings; ++c)
      bookings(index, c) = 0.0;
    int const open = classes.openAround(cell);
    for (int donor = donors.offset(index); donor < donors.offset(index + 1); ++donor)
      remapDonor(index, cell, donor, open);
  }
};

} // namespace

void intersect(Input const &in, Classes const &classes, StageState const &stage, Donors const &donors,
               Overlays &overlays, Bookings const &bookings)
{
  overlays.slots = in.links.slots;
  grow(overlays.sum, "overlaySum", static_cast<std::size_t>(overlays.slots) * donors.num);
  PolynomialFinder const finder{{in, classes, stage, donors}};
  RangePolicy const range(0, classes.num_interface);
  bool const rings = in.mesh.geometry == Geometry::Axisymmetric;
  if (in.options.order == 3 && rings)
    Kokkos::parallel_for("Harmos::remap::intersect", range,
                         IntersectFunctor<RingQuadraticFinder>(RingQuadraticFinder(finder), overlays, bookings));
  else if (in.options.order == 3)
    Kokkos::parallel_for("Harmos::remap::intersect", range,
                         IntersectFunctor<QuadraticFinder>(QuadraticFinder(finder), overlays, bookings));
  else if (rings)
    Kokkos::parallel_for("Harmos::remap::intersect", range,
                         IntersectFunctor<RingPolynomialFinder>(RingPolynomialFinder(finder), overlays, bookings));
  else
    Kokkos::parallel_for("Harmos::remap::intersect", range,
                         IntersectFunctor<PolynomialFinder>(finder, overlays, bookings));
}

} // namespace RemapDetail
} // namespace Harmos
