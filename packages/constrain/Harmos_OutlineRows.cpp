// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_InterfaceSegments.hpp>
#include <Harmos_OutlineContacts.hpp>
#include <Harmos_OutlineRows.hpp>

#include <algorithm>

namespace Harmos
{

namespace
{

// Keys of these rows are above those of all cells.
constexpr long long body_keys = 1LL << 60, wall_keys = 1LL << 61;

constexpr long long most_features = 1LL << 16; // of a body

/// A feature of a free body, with where its centre will be if nothing acts.
struct MovingFeature
{
  OutlineFeature shape;
  Vector2 next;
  int body, material;
};

KOKKOS_INLINE_FUNCTION ContactRow blankRow()
{
  ContactRow row = {};
  row.material_b = row.cell_a = row.cell_b = row.bond = -1;
  row.body_b = -2;
  for (int k = 0; k < 4; ++k)
    row.dof_a[k] = row.dof_b[k] = -1;
  return row;
}

KOKKOS_INLINE_FUNCTION int directions(ContactRow const &row)
{
  return row.friction > 0.0 ? 2 : 1;
}

/// After the step, if nothing acts.
Shape ahead(Shape const &shape, RigidBody const &body, double dt)
{
  return shape.moved(dt * body.velocity, dt * body.angular_velocity);
}

/// Whether a place turns too far in the step for one row to follow it: on the line of centres of a pin that stands in
/// the middle of its hole, which has no direction of its own; those fixed around the hole stay.
bool turnsAway(OutlineGap const &now, OutlineGap const &next)
{
  return dot(now.normal, next.normal) < 0.5;
}

/// Rows of the features of body i on body j.
void addBodyRows(std::vector<Shape> const &outline, std::vector<RigidBody> const &bodies, int i, int j,
                 PairInteraction const &law, double reach, double dt, std::vector<ContactRow> &rows)
{
  Shape const &a = outline[i], &b = outline[j];
  Shape const a_next = ahead(a, bodies[i], dt), b_next = ahead(b, bodies[j], dt);
  for (OutlinePlace const &place : outlinePlaces(a, b, reach, i < j))
  {
    OutlineGap const here = outlineGap(a, b, place), next = outlineGap(a_next, b_next, place);
    if (turnsAway(here, next))
      continue;
    ContactRow row = blankRow();
    long long const pair = static_cast<long long>(i) * static_cast<long long>(bodies.size()) + j;
    row.key = body_keys + (pair * most_features + place.feature + 1) * most_features + place.surface;
    row.material_a = bodies[i].material;
    row.material_b = bodies[j].material;
    row.body_a = i;
    row.body_b = j;
    row.point = here.point;
    row.normal = here.normal;
    row.gap = here.gap;
    Vector2 const apart = bodies[j].velocityAt(here.point + here.gap * here.normal) - bodies[i].velocityAt(here.point);
    // Of a pin as wide as its hole opposite rows would ask for what cannot be: nothing is left for the path to bend.
    double const bend = (next.gap - here.gap) - dt * dot(here.normal, apart);
    row.bend = Math::max(bend, -clearance(a, b, place));
    row.friction = law.kind == Interaction::Friction ? law.friction : 0.0;
    row.restitution = law.restitution;
    rows.push_back(row);
  }
}

bool axisymmetric(Mesh const &mesh)
{
  return mesh.geometry == Geometry::Axisymmetric;
}

/// Whether the nearest bond of the row's bodies within reach is whole.
bool isBonded(ContactRow const &row, std::vector<Bond> const &bonds)
{
  int const low = std::min(row.material_a, row.material_b), high = std::max(row.material_a, row.material_b);
  Bond const *nearest = nullptr;
  double least = 0.0;
  for (Bond const &bond : bonds)
  {
    double const apart = norm(bond.point - row.point);
    if (bond.material_a != low || bond.material_b != high || apart >= bond_reach * bond.cell_size ||
        (nearest != nullptr && apart >= least))
      continue;
    nearest = &bond;
    least = apart;
  }
  return nearest != nullptr && !nearest->broken;
}

/// Rows between bodies, in the order of their keys; the same on all ranks.
std::vector<ContactRow> bodyRows(Mesh const &mesh, std::vector<Shape> const &outline,
                                 std::vector<RigidBody> const &bodies, std::vector<Bond> const &bonds,
                                 ConstraintOptions const &options, double reach, double dt)
{
  auto const interaction = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), options.interaction);
  std::vector<Box> box;
  for (Shape const &shape : outline)
  {
    box.push_back(shape.boundingBox());
    box.back().low -= Vector2{reach, reach};
  }
  std::vector<ContactRow> rows;
  int const count = static_cast<int>(outline.size());
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
    {
      PairInteraction const &law = interaction(bodies[i].material, bodies[j].material);
      bool const driven = bodies[i].motion != RigidMotion::Free && bodies[j].motion != RigidMotion::Free;
      bool const bonded = law.kind == Interaction::Bonded;
      if (i == j || driven || (bonded && !law.strength.limited()) || !box[i].meets(box[j]))
        continue;
      std::size_t const first = rows.size();
      addBodyRows(outline, bodies, i, j, law, reach, dt, rows);
      if (bonded)
        rows.erase(std::remove_if(rows.begin() + static_cast<std::ptrdiff_t>(first), rows.end(),
                                  [&](ContactRow const &row) { return isBonded(row, bonds); }),
                   rows.end());
    }
  if (axisymmetric(mesh)) // what lies beyond the axis is no part of the bodies
    rows.erase(
        std::remove_if(rows.begin(), rows.end(), [&](ContactRow const &row) { return row.point[0] < -1e-9 * reach; }),
        rows.end());
  std::sort(rows.begin(), rows.end(), [](ContactRow const &x, ContactRow const &y) { return x.key < y.key; });
  return rows;
}

std::vector<MovingFeature> freeFeatures(std::vector<Shape> const &outline, std::vector<RigidBody> const &bodies,
                                        double dt)
{
  std::vector<MovingFeature> features;
  for (std::size_t b = 0; b < outline.size(); ++b)
    if (bodies[b].motion == RigidMotion::Free)
    {
      std::vector<OutlineFeature> const now = outlineFeatures(outline[b]);
      std::vector<OutlineFeature> const next = outlineFeatures(ahead(outline[b], bodies[b], dt));
      for (std::size_t k = 0; k < now.size(); ++k)
        features.push_back({now[k], next[k].centre, static_cast<int>(b), bodies[b].material});
    }
  return features;
}

/// Rows of features on faces of contact walls.
struct WallRows
{
  Mesh mesh;
  View<InterfaceSegment *> segment;
  View<Boundary *> boundary;
  View<MovingFeature *> feature;
  View<RigidBody *> body;
  double dt;

  KOKKOS_INLINE_FUNCTION bool touches(InterfaceSegment const &wall, MovingFeature const &f) const
  {
    if (wall.material >= 0 || mesh.cell_depth(wall.cell) != 0 || !mayLieOn(f.shape, wall.normal))
      return false;
    Vector2 const from = f.shape.centre - wall.midpoint;
    double const height = dot(from, wall.normal);
    bool const before = f.shape.number != outer_circle || height >= 0.0;
    return before && Math::fabs(height - f.shape.radius) < wall.cell_size &&
           Math::fabs(dot(from, perpendicular(wall.normal))) <= (0.5 + 1e-9) * wall.length;
  }

  KOKKOS_INLINE_FUNCTION ContactRow makeRow(InterfaceSegment const &wall, int number) const
  {
    MovingFeature const &f = feature(number);
    ContactRow row = blankRow();
    row.key = wall_keys + (mesh.cell_global(wall.cell) * 4 + wall.face) * most_features + number;
    row.material_a = f.material;
    row.body_a = f.body;
    row.point = f.shape.centre - f.shape.radius * wall.normal;
    row.normal = -wall.normal;
    row.gap = dot(f.shape.centre - wall.midpoint, wall.normal) - f.shape.radius;
    row.bend = dot(wall.normal, f.next - f.shape.centre - dt * body(f.body).velocityAt(row.point));
    Boundary const &side = boundary(mesh.face_boundary(wall.cell, wall.face));
    row.friction = side.friction;
    row.restitution = side.restitution;
    return row;
  }
};

bool hasContactWall(BoundaryConditions const &conditions)
{
  auto const boundary = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), conditions.boundary);
  bool any = false;
  for (std::size_t i = 0; i < boundary.extent(0); ++i)
    any = any || boundary(i).kind == BoundaryKind::ContactWall;
  return any;
}

/// Put the rows at this rank's walls behind the first `first` ones of `row`, which grows.
int addWallRows(WallRows const &walls, int num_segments, View<ContactRow *> &row, int first)
{
  int const features = static_cast<int>(walls.feature.extent(0));
  int count = 0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::countWallRows", RangePolicy(0, num_segments),
      KOKKOS_LAMBDA(int i, int &sum) {
        for (int f = 0; f < features; ++f)
          sum += walls.touches(walls.segment(i), walls.feature(f)) ? 1 : 0;
      },
      count);
  if (count == 0)
    return 0;
  Kokkos::resize(row, first + count);
  View<ContactRow *> const out = row;
  Kokkos::parallel_scan(
      "Harmos::constrain::fillWallRows", RangePolicy(0, num_segments), KOKKOS_LAMBDA(int i, int &sum, bool final) {
        for (int f = 0; f < features; ++f)
          if (walls.touches(walls.segment(i), walls.feature(f)))
          {
            if (final)
              out(first + sum) = walls.makeRow(walls.segment(i), f);
            ++sum;
          }
      });
  return count;
}

} // namespace

OutlineRows findOutlineRows(Mesh const &mesh, InterfaceSegments const &segments, BoundaryConditions const &conditions,
                            std::vector<Shape> const &outline, std::vector<RigidBody> const &bodies,
                            std::vector<Bond> const &bonds, ConstraintOptions const &options, Exchange const &exchange,
                            double reach, double dt)
{
  OutlineRows rows;
  if (std::none_of(bodies.begin(), bodies.end(), [](RigidBody const &b) { return b.motion == RigidMotion::Free; }))
    return rows;
  std::vector<ContactRow> const between = bodyRows(mesh, outline, bodies, bonds, options, reach, dt);
  if (exchange.rank() == 0)
  {
    rows.row = deviceCopy("Harmos::constrain::outline_row", between);
    rows.count = static_cast<int>(between.size());
  }
  std::vector<MovingFeature> const features = freeFeatures(outline, bodies, dt);
  if (!features.empty() && hasContactWall(conditions))
  {
    WallRows const walls{mesh,
                         segments.segment,
                         conditions.boundary,
                         deviceCopy("Harmos::constrain::feature", features),
                         deviceCopy("Harmos::constrain::moving_body", bodies),
                         dt};
    rows.count += addWallRows(walls, segments.count, rows.row, rows.count);
  }
  View<ContactRow *> const row = rows.row;
  Kokkos::parallel_reduce(
      "Harmos::constrain::countOutlineMultipliers", RangePolicy(0, rows.count),
      KOKKOS_LAMBDA(int i, long long &sum) { sum += directions(row(i)); }, rows.num_multipliers);
  return rows;
}

void appendRows(OutlineRows const &added, ContactRows &rows)
{
  if (added.count == 0)
    return;
  int const count = rows.count, own_count = rows.num_own;
  Kokkos::resize(rows.row, count + added.count);
  Kokkos::resize(rows.own, own_count + added.count);
  View<ContactRow *> const row = rows.row, from = added.row;
  View<int *> const own = rows.own;
  Kokkos::parallel_for(
      "Harmos::constrain::appendRows", RangePolicy(0, added.count), KOKKOS_LAMBDA(int i) {
        row(count + i) = from(i);
        own(own_count + i) = count + i;
      });
  rows.count += added.count;
  rows.num_own += added.count;
}

} // namespace Harmos
