// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactOperator.hpp>
#include <Harmos_PressureAround.hpp>
#include <Harmos_PressureTractions.hpp>
#include <Harmos_RowBuilder.hpp>

namespace Harmos
{

namespace
{

/// A traction along the normal of a row and across it [Pa], and sqrt(p / density) [m/s].
struct PlannedTraction
{
  double along = 0.0, across = 0.0, speed = 0.0;

  KOKKOS_INLINE_FUNCTION bool any() const { return along != 0.0 || across != 0.0; }
};

/// What bears the pressure of segment i, which touches nothing along its ray: what the nearest segment of its body
/// touches, where that is as near as sides that touch. Thin void has short sides along which rays leave it: they are in
/// balance with its other sides, which touch what lies across. Else, as across a crack in the body, what the ray meets.
KOKKOS_INLINE_FUNCTION RayHit hitBeside(RowBuilder const &builder, int i)
{
  InterfaceSegment const &a = builder.segment(i);
  double nearest = touching_gap * a.cell_size;
  RayHit found = builder.hit(i);
  auto const lookAt = [&](int cell)
  {
    for (int j = builder.segments.firstOf(cell); j < builder.segments.count && builder.segment(j).cell == cell; ++j)
    {
      InterfaceSegment const &b = builder.segment(j);
      if (b.material != a.material || !touches(b, builder.hit(j)) || dot(a.normal, b.normal) < -facing_cosine)
        continue;
      Vector2 const tangent = perpendicular(b.normal), apart = a.midpoint - b.midpoint;
      double const along = Math::clamp(dot(apart, tangent), -0.5 * b.length, 0.5 * b.length);
      double const distance = norm(apart - along * tangent);
      if (distance < nearest)
      {
        nearest = distance;
        found = builder.hit(j);
      }
    }
  };
  lookAt(a.cell);
  int const across = a.face >= 0 ? builder.mesh.face_neighbour(a.cell, a.face) : -1;
  if (across >= 0)
    lookAt(across / 4);
  return found;
}

/// What the facets press with.
struct FacetPressure
{
  Mesh mesh;
  View<Boundary *> boundary;
  CellMaterialPairs pairs;
  View<double *[3]> pressure; // PairStress::pressure

  /// What the cells around bear of a fluid's pressure.
  KOKKOS_INLINE_FUNCTION double around(int cell, int material) const
  {
    int const own = pairs.find(cell, material);
    return pressureAround(
        mesh, boundary, pairs, cell, material, Math::max(pressure(own, 0), 0.0), pressure(own, 1),
        [this](int pair) { return pressure(pair, 0); }, [this](int pair) { return pressure(pair, 1); });
  }

  KOKKOS_INLINE_FUNCTION double densityOf(int cell, int material) const
  {
    int const pair = pairs.find(cell, material);
    return pressure(pair, 2) / pressure(pair, 1);
  }
};

struct TractionFinder
{
  static constexpr int most = 3; // of a segment: its own, and those of its rows

  RowBuilder builder;
  View<PlannedRows *> planned;
  View<RayHit *> hit; // what bears the pressure of each segment
  FacetPressure pressure;

  /// Whether segment i is a facet whose pressure counts, on what it faces.
  KOKKOS_INLINE_FUNCTION bool isPressed(int i) const
  {
    InterfaceSegment const &a = builder.segment(i);
    int const facing = hit(i).segment;
    if (!builder.bearing.isPressed(a) || facing < 0)
      return false;
    InterfaceSegment const &b = builder.segment(facing);
    if (b.material < 0)
      return true;
    bool const two_fluids = builder.bearing.isPressed(b);
    if (two_fluids && !builder.isSlave(a, b))
      return false;
    return !builder.areBonded(a, b) && builder.haveOwnNodes(a);
  }

  /// Whether two segments are the two sides of one line.
  KOKKOS_INLINE_FUNCTION bool areOne(int i, int facing) const
  {
    constexpr double round_off = 1e-12;
    InterfaceSegment const &a = builder.segment(i), &b = builder.segment(facing);
    double const least = round_off * a.cell_size;
    return hit(facing).segment == i && b.cell == a.cell && norm(a.midpoint - b.midpoint) <= least &&
           Math::fabs(a.length - b.length) <= least;
  }

  /// The segment whose one row acts over just a pressed facet: the facet itself, or what faces it along the same line;
  /// -1 without one.
  KOKKOS_INLINE_FUNCTION int carrierOf(int facet) const
  {
    int const facing = hit(facet).segment;
    if (planned(facet).count == 1)
      return facet;
    return planned(facet).count == 0 && planned(facing).count == 1 && areOne(facet, facing) ? facing : -1;
  }

  /// Normal, away from a pressed facet, of the row that carries it; zero without one.
  KOKKOS_INLINE_FUNCTION Vector2 rowNormal(int facet) const
  {
    int const carrier = carrierOf(facet);
    if (carrier < 0)
      return {0.0, 0.0};
    return carrier == facet ? planned(facet).normal[0] : -planned(carrier).normal[0];
  }

  /// Number k of segment i: 0 of its own pressure, 1 and 2 of its rows. None in tension and through void.
  KOKKOS_INLINE_FUNCTION PlannedTraction traction(int i, int k) const
  {
    Vector2 const part = partOfPressure(i, k);
    if (part[0] == 0.0 && part[1] == 0.0)
      return {};
    RayHit const &on = k == 0 ? hit(i) : planned(i).hit[k - 1];
    if (on.gap > touching_gap * builder.segment(i).cell_size)
      return {};
    return loaded(part, builder.segment(i), builder.segment(on.segment));
  }

  KOKKOS_INLINE_FUNCTION ContactRow rowOf(int i, int k) const
  {
    PlannedRows own = {};
    if (k == 0)
    {
      own.count = 1;
      own.normal[0] = builder.segment(i).normal;
      own.hit[0] = hit(i);
    }
    ContactRow row = k == 0 ? builder.makeRow(i, own, 0) : builder.makeRow(i, planned(i), k - 1);
    row.tied = 0;
    row.friction = 1.0; // so that it has two directions
    row.restitution = 0.0;
    row.bond = -1;
    return row;
  }

private:
  /// Traction number k of segment i per pressure, along the normal of its row and across it.
  KOKKOS_INLINE_FUNCTION Vector2 partOfPressure(int i, int k) const
  {
    constexpr double round_off = 1e-9; // of normals
    if (builder.mesh.cell_depth(builder.segment(i).cell) != 0)
      return {0.0, 0.0};
    if (k > 0)
      return {k <= planned(i).count && isUnmatched(i, k - 1) ? -1.0 : 0.0, 0.0};
    if (!isPressed(i))
      return {0.0, 0.0};
    Vector2 const n = builder.segment(i).normal, rest = n - rowNormal(i);
    return norm(rest) < round_off ? Vector2{0.0, 0.0} : Vector2{dot(n, rest), dot(perpendicular(n), rest)};
  }

  KOKKOS_INLINE_FUNCTION bool presses(InterfaceSegment const &side) const
  {
    return builder.bearing.isPressed(side) && builder.bodyOf(side.material) == -1;
  }

  /// The pressure between two sides, times `part`; nothing in tension.
  KOKKOS_INLINE_FUNCTION PlannedTraction loaded(Vector2 const &part, InterfaceSegment const &a,
                                                InterfaceSegment const &b) const
  {
    bool const of_a = presses(a), of_b = presses(b);
    double p = of_a ? pressure.around(a.cell, a.material) : pressure.around(b.cell, b.material);
    if (of_a && of_b)
      p = Math::min(p, pressure.around(b.cell, b.material));
    if (!(p > 0.0))
      return {};
    double density = of_a ? pressure.densityOf(a.cell, a.material) : pressure.densityOf(b.cell, b.material);
    if (of_a && of_b)
      density = Math::min(density, pressure.densityOf(b.cell, b.material));
    return {p * part[0], p * part[1], Math::sqrt(p / density)};
  }

  /// Whether a row bears a pressed facet, but not over just that.
  KOKKOS_INLINE_FUNCTION bool isUnmatched(int i, int half) const
  {
    if (isPressed(i))
      return carrierOf(i) != i;
    int const facing = planned(i).hit[half].segment;
    return isPressed(facing) && builder.segment(hit(facing).segment).material == builder.segment(i).material &&
           carrierOf(facing) != i;
  }
};

/// Reduce impulses that change a node's velocity by more than 20 sqrt(p / density), together with all others there.
/// \return 1 where there were any, else 0.
double limitPushes(ContactSystem const &s, View<double *> const &speed, View<double *[2]> const &change,
                   View<double *[2]> const &impulse)
{
  constexpr double most = 20.0;
  double any = 0.0;
  launchReduce(
      "Harmos::constrain::limitPushes", s.num_own,
      KOKKOS_LAMBDA(int i, double &found) {
        int const r = s.own(i);
        double pushed = most * speed(i);
        for (int c = 0; c < 8; ++c)
          if (s.dof(r, c) >= 0)
            pushed = Math::max(pushed, norm(Vector2{change(s.dof(r, c), 0), change(s.dof(r, c), 1)}));
        if (!(pushed > most * speed(i)))
          return;
        for (int k = 0; k < 2; ++k)
          impulse(r, k) *= most * speed(i) / pushed;
        found = 1.0;
      },
      Kokkos::Max<double>(any));
  return s.num_own > 0 ? Math::max(any, 0.0) : 0.0;
}

} // namespace

PressureTractions findPressureTractions(RowBuilder const &builder, View<PlannedRows *> const &planned,
                                        View<double *[3]> const &pressure, WorkArrays const &work)
{
  constexpr int most = TractionFinder::most;
  int const count = builder.segments.count;
  View<RayHit *> const hit = work.unset<RayHit *>("Harmos::constrain::pressed_on", count);
  launchFor(
      "Harmos::constrain::findPressedOn", count, KOKKOS_LAMBDA(int i) {
        bool const alone = builder.bearing.isPressed(builder.segment(i)) && planned(i).count == 0 &&
                           !touches(builder.segment(i), builder.hit(i));
        hit(i) = alone ? hitBeside(builder, i) : builder.hit(i);
      });
  TractionFinder const finder{builder, planned, hit, {builder.mesh, builder.boundary, builder.pairs, pressure}};
  View<PlannedTraction *[most]> const traction =
      work.unset<PlannedTraction *[most]>("Harmos::constrain::traction", count);
  View<int *> const place = work.unset<int *>("Harmos::constrain::traction_place", count);
  PressureTractions found;
  found.pressure = pressure;
  launchFor(
      "Harmos::constrain::planTractions", count, KOKKOS_LAMBDA(int i) {
        for (int k = 0; k < most; ++k)
          traction(i, k) = finder.traction(i, k);
      });
  launchScan(
      "Harmos::constrain::countTractions", count,
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        if (final)
          place(i) = sum;
        for (int k = 0; k < most; ++k)
          sum += traction(i, k).any() ? 1 : 0;
      },
      found.rows.count);
  found.rows.num_own = found.rows.count;
  found.rows.num_multipliers = 2 * static_cast<long long>(found.rows.count);
  found.rows.row = work.unset<ContactRow *>("Harmos::constrain::traction_row", found.rows.count);
  found.rows.own = work.unset<int *>("Harmos::constrain::own_traction", found.rows.count);
  found.load = work.unset<double *[2]>("Harmos::constrain::traction_load", found.rows.count);
  found.speed = work.unset<double *>("Harmos::constrain::traction_speed", found.rows.count);
  View<ContactRow *> const row = found.rows.row;
  View<int *> const own = found.rows.own;
  View<double *[2]> const load = found.load;
  View<double *> const speed = found.speed;
  launchFor(
      "Harmos::constrain::makeTractions", count, KOKKOS_LAMBDA(int i) {
        int r = place(i);
        for (int k = 0; k < most; ++k)
        {
          if (!traction(i, k).any())
            continue;
          row(r) = finder.rowOf(i, k);
          own(r) = r;
          load(r, 0) = traction(i, k).along;
          load(r, 1) = traction(i, k).across;
          speed(r) = traction(i, k).speed;
          ++r;
        }
      });
  return found;
}

PressureImpulses pressureImpulses(PressureTractions const &tractions, ContactSystem const &system, Motion const &before,
                                  double kick, Exchange const &exchange, WorkArrays const &work)
{
  constexpr double most_slip = 0.1; // over sqrt(p / density)
  PressureImpulses found;
  found.system = system;
  View<double *[2]> const impulse = work.zeros<double *[2]>("Harmos::constrain::pressure_impulse", system.num_rows);
  View<ContactRow *> const row = tractions.rows.row;
  View<double *[2]> const load = tractions.load;
  View<double *> const speed = tractions.speed;
  ContactSystem const s = system;
  launchFor(
      "Harmos::constrain::pressureImpulses", s.num_own, KOKKOS_LAMBDA(int i) {
        int const r = s.own(i);
        ContactRow const &facet = row(r);
        double const slip = norm(relativeVelocity(facet, before.velocity, before.bodies));
        double const scale = kick * facet.length * Math::clamp(2.0 - slip / (most_slip * speed(i)), 0.0, 1.0);
        impulse(r, 0) = scale * load(i, 0);
        impulse(r, 1) = scale * load(i, 1);
      });
  ContactOperator const contact(found.system, tractions.rows, exchange, work);
  contact.push(impulse);
  if (exchange.max(limitPushes(s, speed, contact.change(), impulse)) > 0.0)
    contact.push(impulse);
  found.solution.impulse = impulse;
  found.solution.change = contact.change();
  found.solution.body_change = contact.bodyChange();
  return found;
}

} // namespace Harmos
