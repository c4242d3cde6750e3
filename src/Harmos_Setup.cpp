// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Setup.hpp"

#include "Harmos_BlockMesh.hpp"
#include "Harmos_PrescribedCycle.hpp"
#include "Harmos_SmoothedMesh.hpp"

#include <Harmos_DeckSchema.hpp>
#include <Harmos_EquationOfState.hpp>
#include <Harmos_Failure.hpp>
#include <Harmos_FlowStress.hpp>
#include <Harmos_Paint.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{
namespace
{

std::vector<double> gridLines(AxisSpec const &axis)
{
  std::vector<double> lines;
  for (int i = 0; i <= axis.cells; ++i)
    lines.push_back(axis.position(i));
  return lines;
}

/// What a body fills.
struct Extent
{
  Vector2 centroid = {0.0, 0.0};
  double volume = 0.0;  // or per radian of the ring
  double inertia = 0.0; // polar second moment of area about the centroid [m^4]
};

/// Of the cells of a body.
Extent extentOfCells(DeckMesh const &whole, int body, Geometry geometry)
{
  std::vector<Shape> cells;
  for (std::size_t c = 0; c < whole.cell_body.size(); ++c)
    if (whole.cell_body[c] == body)
    {
      std::vector<Vector2> corners;
      for (int const node : whole.mesh.cell[c])
        corners.push_back({whole.mesh.node[node][0], whole.mesh.node[node][1]});
      cells.push_back(Shape::polygon(corners));
    }
  Extent extent;
  double area = 0.0;
  for (Shape const &cell : cells)
  {
    extent.volume += cell.volume(geometry);
    extent.centroid += cell.area() * cell.centroid();
    area += cell.area();
  }
  extent.centroid = (1.0 / area) * extent.centroid;
  for (Shape const &cell : cells)
  {
    Vector2 const arm = cell.centroid() - extent.centroid;
    extent.inertia += cell.inertia() + cell.area() * dot(arm, arm);
  }
  return extent;
}

/// Whether the outline of a body is that of its shape: not of blocks with arcs and of parts of a file's mesh.
bool isOutlined(BodySpec const &spec)
{
  auto const &radii = spec.arc_radius;
  return spec.shape.kind != ShapeKind::MeshPart &&
         std::all_of(std::begin(radii), std::end(radii), [](double radius) { return radius == 0.0; });
}

RigidBody rigidBody(Deck const &deck, BodySpec const &spec, Extent const &extent)
{
  RigidBody body;
  body.material = spec.field;
  body.motion = spec.motion;
  body.centre = extent.centroid;
  double const density = deck.laws[spec.law].law.density0;
  body.mass = density * extent.volume;
  body.inertia = density * extent.inertia;
  body.angular_velocity = spec.angular_velocity;
  body.velocity = spec.velocity + spec.angular_velocity * perpendicular(body.centre - spec.shape.reference());
  return body;
}

void addRigidBodies(Deck const &deck, DeckMesh const &whole, Scene &scene)
{
  scene.rigid_start.resize(deck.num_rigid_bodies);
  scene.rigid_shape.resize(deck.num_rigid_bodies);
  for (std::size_t i = 0; i < deck.bodies.size(); ++i)
  {
    BodySpec const &spec = deck.bodies[i];
    int const number = deck.fields[spec.field].rigid_body;
    if (number < 0)
      continue;
    Extent extent;
    if (isOutlined(spec))
    {
      Shape const shape = makeShape(spec.shape);
      scene.rigid_shape[number] = shape;
      extent = {shape.centroid(), shape.volume(deck.geometry), shape.inertia()};
    }
    else
      extent = extentOfCells(whole, static_cast<int>(i), deck.geometry);
    scene.rigid_start[number] = rigidBody(deck, spec, extent);
  }
}

/// With a prescribed field: the largest step with which end_time is a multiple of it and no node moves farther than
/// `courant` of the shortest cell side (with jitter: of the least width that its cells may have).
double equalStep(Deck const &deck, double max_dt)
{
  double const speed = deck.prescribed.largestSpeed({deck.x.from, deck.y.from}, {deck.x.to, deck.y.to});
  double const shortest = (1.0 - 2.0 * deck.jitter) * std::min(deck.x.smallestCell(), deck.y.smallestCell());
  double const largest = std::min(max_dt, speed > 0.0 ? deck.lagrange.courant * shortest / speed : deck.run.end_time);
  return deck.run.end_time / std::ceil(deck.run.end_time / largest * (1.0 - 1e-12));
}

/// The motion of a body at time zero; no shape.
Body movingBody(BodySpec const &spec)
{
  Body body;
  body.velocity = spec.velocity;
  body.angular_velocity = spec.angular_velocity;
  body.radial_velocity = spec.radial_velocity;
  body.radial_radius = spec.radial_radius;
  body.radial_exponent = spec.radial_exponent;
  body.radial_centre = spec.radial_centre;
  body.rotation_centre = spec.shape.reference();
  return body;
}

/// One pair a cell, filled; velocities of the body at the nodes.
void fillBlocks(Deck const &deck, DeckMesh const &whole, Scene const &scene, CycleState &s)
{
  Mesh const &mesh = scene.mesh;
  int const n = mesh.num_cells;
  s.pairs.num_pairs = n;
  s.pairs.offset = View<int *>("offset", n + 1);
  s.pairs.material = View<int *>("material", n);
  s.pairs.cell = View<int *>("cell", n);
  s.state.record = View<double *[num_pair_fields]>("record", n);
  s.state.centroid = View<double *[2]>("centroid", n);
  auto offset = Kokkos::create_mirror_view(s.pairs.offset);
  auto material = Kokkos::create_mirror_view(s.pairs.material);
  auto cell = Kokkos::create_mirror_view(s.pairs.cell);
  auto record = Kokkos::create_mirror_view(s.state.record);
  auto const volume = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_volume);
  auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_global);
  int const num_bodies = static_cast<int>(deck.bodies.size());
  for (int c = 0; c < n; ++c)
  {
    int const block = whole.cell_body[global(c)];
    bool const wall = block >= num_bodies;
    double const density = wall ? 1.0 : deck.bodies[block].density;
    offset(c) = cell(c) = c;
    material(c) = wall ? static_cast<int>(deck.fields.size()) + block - num_bodies : deck.bodies[block].field;
    record(c, Mass) = density * volume(c);
    record(c, VolumeFraction) = 1.0;
    record(c, SpecificVolume) = 1.0 / density;
    record(c, InternalEnergy) = wall ? 0.0 : deck.bodies[block].internal_energy;
  }
  offset(n) = n;
  Kokkos::deep_copy(s.pairs.offset, offset);
  Kokkos::deep_copy(s.pairs.material, material);
  Kokkos::deep_copy(s.pairs.cell, cell);
  Kokkos::deep_copy(s.state.record, record);

  s.dof_nodes = buildDofNodes(mesh, Kinematics::Lagrangian, s.state.record, s.pairs);
  s.state.velocity = View<double *[2]>("velocity", s.dof_nodes.num_dof_nodes);
  auto velocity = Kokkos::create_mirror_view(s.state.velocity);
  auto const position = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_position);
  auto const dof_node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.pairs.dof_node);
  auto const cell_node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_node);
  for (int c = 0; c < n; ++c)
  {
    int const block = whole.cell_body[global(c)];
    if (block >= num_bodies)
      continue;
    Body const body = movingBody(deck.bodies[block]);
    for (int k = 0; k < 4; ++k)
    {
      Vector2 const v = body.velocityAt({position(cell_node(c, k), 0), position(cell_node(c, k), 1)});
      for (int d = 0; d < 2; ++d)
        velocity(dof_node(c, k), d) = v[d];
    }
  }
  Kokkos::deep_copy(s.state.velocity, velocity);
}

} // namespace

DeckMesh makeMesh(Deck const &deck)
{
  if (deck.kinematics == Kinematics::Lagrangian)
    return makeBlockMesh(deck);
  return {jitteredMesh(gridLines(deck.x), gridLines(deck.y), deck.jitter, static_cast<unsigned>(deck.jitter_seed)), {}};
}

Shape makeShape(ShapeSpec const &spec)
{
  switch (spec.kind)
  {
  case ShapeKind::Rectangle:
    return Shape::rectangle(spec.reference(), spec.size, spec.angle);
  case ShapeKind::Disc:
    return Shape::disc(spec.reference(), spec.outer_radius);
  case ShapeKind::Annulus:
    return Shape::annulus(spec.reference(), spec.inner_radius, spec.outer_radius);
  case ShapeKind::Polygon:
    return Shape::polygon(spec.points).moved(spec.shift, spec.angle);
  case ShapeKind::HalfPlane:
    return Shape::halfPlane(spec.center, spec.normal).moved(spec.shift, spec.angle);
  case ShapeKind::MeshPart: // it has cells, and is never painted
    break;
  }
  throw std::logic_error("a body without an outline is not painted");
}

Body paintedBody(BodySpec const &spec)
{
  Body body = movingBody(spec);
  body.shape = makeShape(spec.shape);
  body.material = spec.field;
  body.density = spec.density;
  body.specific_volume = 1.0 / spec.density;
  body.internal_energy = spec.internal_energy;
  body.cut_from_earlier = spec.cut;
  body.name = spec.name;
  return body;
}

namespace
{

/// Of a body with a contact wall that is a block.
PairInteraction wallInteraction(Boundary const &wall)
{
  PairInteraction interaction;
  interaction.kind = wall.friction > 0.0 ? Interaction::Friction : Interaction::Sliding;
  interaction.friction = wall.friction;
  interaction.restitution = wall.restitution;
  return interaction;
}

/// By field: internal energy per mass of its warmest body, or of what flows in.
std::vector<double> warmestBodies(Deck const &deck)
{
  std::vector<double> warmest(deck.fields.size(), 0.0);
  for (BodySpec const &body : deck.bodies)
    warmest[body.field] = std::max(warmest[body.field], body.internal_energy);
  for (Boundary const &side : deck.boundary)
    if (side.kind == BoundaryKind::Inflow)
      warmest[side.material] = std::max(warmest[side.material], side.internal_energy);
  return warmest;
}

} // namespace

Scene makeScene(Deck const &deck, DeckMesh const &whole, Mesh const &mesh, Exchange const &exchange)
{
  Scene scene;
  scene.kinematics = deck.kinematics;
  scene.mesh = mesh;
  scene.exchange = &exchange;
  scene.boundary = buildBoundaryConditions(
      mesh, deviceCopy("boundary", std::vector<Boundary>(deck.boundary, deck.boundary + num_boundary_sides)));
  addRigidBodies(deck, whole, scene);

  std::vector<Material> materials;
  for (std::size_t field = 0; field < deck.fields.size(); ++field)
    materials.push_back(deck.fieldMaterial(static_cast<int>(field)));
  std::vector<int> const walls = wallSides(deck);
  for (std::size_t w = 0; w < walls.size(); ++w)
  {
    RigidBody body;
    body.material = static_cast<int>(materials.size());
    Material wall;
    wall.rigid_body = static_cast<int>(scene.rigid_start.size());
    wall.density0 = 1.0;
    scene.rigid_start.push_back(body);
    scene.rigid_shape.push_back(wallShape(deck, walls[w]));
    materials.push_back(wall);
  }
  scene.materials = deviceCopy("materials", materials);

  int const m = static_cast<int>(materials.size()), f = static_cast<int>(deck.fields.size());
  scene.lagrange = deck.lagrange;
  scene.reconstruction = deck.reconstruction;
  if (!deck.removal_order.empty())
    scene.reconstruction.order = deviceCopy("removal_order", deck.removal_order);
  scene.constraint = deck.constraint;
  scene.constraint.interaction = View<PairInteraction **>("interaction", m, m);
  auto interaction = Kokkos::create_mirror_view(scene.constraint.interaction);
  for (int a = 0; a < m; ++a)
    for (int b = 0; b < m; ++b)
    {
      int const wall = std::max(a, b) - f;
      interaction(a, b) = wall < 0 ? deck.interaction[a * f + b] : wallInteraction(deck.boundary[walls[wall]]);
    }
  Kokkos::deep_copy(scene.constraint.interaction, interaction);
  scene.remap = deck.remap;
  scene.remap.mirrored_walls = deck.prescribed.kind == FieldKind::None;
  scene.remap.start_energy = deviceCopy("start_energy", warmestBodies(deck));
  scene.prescribed = deck.prescribed;
  if (deck.smoother.moves())
    scene.target_mesh = smoothedMesh(deck.smoother, scene.boundary, exchange);
  if (deck.kinematics == Kinematics::Lagrangian)
    scene.subzone_fraction = subzoneFractions(mesh); // before a restart moves it
  if (deck.run.max_dt > 0.0)
    scene.max_dt = deck.run.max_dt;
  if (deck.prescribed.kind != FieldKind::None)
    scene.max_dt = equalStep(deck, scene.max_dt);
  return scene;
}

bool tracksDamage(Deck const &deck)
{
  return std::any_of(deck.laws.begin(), deck.laws.end(), [](LawSpec const &law) { return canFail(law.law); });
}

CycleState makeInitialState(Deck const &deck, DeckMesh const &whole, Scene const &scene)
{
  CycleState s;
  if (deck.kinematics == Kinematics::Lagrangian)
    fillBlocks(deck, whole, scene, s);
  else
  {
    std::vector<Body> bodies;
    for (BodySpec const &spec : deck.bodies)
      bodies.push_back(paintedBody(spec));
    Painting painting = paint(scene.mesh, bodies);
    s.state.record = painting.record;
    s.state.centroid = painting.centroid;
    s.dof_nodes = buildDofNodes(scene.mesh, deck.kinematics, s.state.record, painting.pairs);
    s.pairs = painting.pairs;
    s.state.velocity = paintedVelocity(scene.mesh, bodies, painting, s.dof_nodes);
  }
  return s;
}

} // namespace Harmos
