// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckBodies.hpp>

#include <Harmos_EquationOfState.hpp>

#include <Teuchos_Array.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

namespace
{

using Teuchos::ParameterList;

/// Whether the body's bounding box (half-plane: its inside) reaches into the mesh.
bool reachesMesh(ShapeSpec const &shape, AxisSpec const &x, AxisSpec const &y)
{
  Vector2 const center = shape.reference();
  if (shape.kind == ShapeKind::HalfPlane)
  {
    double const c = std::cos(shape.angle), s = std::sin(shape.angle);
    Vector2 const normal = {c * shape.normal[0] - s * shape.normal[1], s * shape.normal[0] + c * shape.normal[1]};
    double lowest = std::numeric_limits<double>::infinity();
    for (double px : {x.from, x.to})
      for (double py : {y.from, y.to})
        lowest = std::min(lowest, dot(normal, Vector2{px, py} - center));
    return lowest < 0.0;
  }
  Vector2 low = center - Vector2{shape.outer_radius, shape.outer_radius};
  Vector2 high = center + Vector2{shape.outer_radius, shape.outer_radius};
  for (Vector2 const &p : outlinePoints(shape))
    for (int d = 0; d < 2; ++d)
    {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  return low[0] < x.to && high[0] > x.from && low[1] < y.to && high[1] > y.from;
}

/// Corners that the digits of their place make one bound nothing.
void refuseLostOutline(DeckChecker const &check, std::string const &path, ShapeSpec const &shape)
{
  std::vector<Vector2> const points = outlinePoints(shape);
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    twice += cross(points[i] - points[0], points[i + 1] - points[0]);
  bool const rectangle = shape.kind == ShapeKind::Rectangle;
  check.require(points.empty() || twice > 0.0, keyPath(path, rectangle ? "size" : "points"),
                (rectangle ? "[" + numberText(shape.size[0]) + ", " + numberText(shape.size[1]) + "] is" : "they are") +
                    std::string(" lost in the digits of the place; expected: a larger body"));
}

void convertMotion(DeckChecker const &check, ParameterList const &list, std::string const &path, Deck const &deck,
                   BodySpec &body)
{
  bool const rigid = deck.laws[body.law].rigid;
  if (list.isParameter("motion"))
  {
    std::string const motion = list.get<std::string>("motion");
    check.require(rigid, keyPath(path, "motion"),
                  "belongs to rigid bodies, and " + deck.laws[body.law].name + " is no rigid law");
    body.motion = motion == "free"         ? RigidMotion::Free
                  : motion == "prescribed" ? RigidMotion::Prescribed
                                           : RigidMotion::Fixed;
  }
  if (!rigid)
    return;
  bool const moves = body.velocity[0] != 0.0 || body.velocity[1] != 0.0 || body.angular_velocity != 0.0;
  check.require(body.motion != RigidMotion::Fixed || !moves, keyPath(path, "motion"),
                "a fixed body has no velocity; expected: prescribed or free");
  check.require(body.motion != RigidMotion::Free || deck.kinematics != Kinematics::Single, keyPath(path, "motion"),
                "a free rigid body needs a velocity field of its own, which kinematics single has not; expected: "
                "fixed or prescribed, or another kinematics");
  check.require(body.motion != RigidMotion::Free || body.shape.kind != ShapeKind::HalfPlane, keyPath(path, "motion"),
                "a half-plane has no finite mass; expected: fixed or prescribed");
  check.require(body.radial_velocity == 0.0, keyPath(path, "radial_velocity"), "means nothing for a rigid body");
  for (char const *key : {"density", "internal_energy", "pressure"})
    check.require(!list.isParameter(key), keyPath(path, key),
                  "means nothing for a rigid body, whose law has the density");
}

/// Quadrilateral sides along the axes of the body's frame as arcs, and the cells' grading.
void convertBlockSides(DeckChecker const &check, ParameterList const &list, std::string const &path, Deck const &deck,
                       BodySpec &body)
{
  auto const &grading = list.get<Teuchos::Array<double>>("cells_grading");
  for (int d = 0; d < 2; ++d)
    body.cells_grading[d] = grading[d];
  if (!list.isParameter("arc_radii"))
    return;
  std::string const where = keyPath(path, "arc_radii");
  check.require(deck.kinematics == Kinematics::Lagrangian, where,
                "the outline of another kinematics than lagrangian has none; expected: shape disc or annulus");
  check.require(body.shape.kind != ShapeKind::MeshPart, where, "a mesh part has its sides in the file");
  auto const &radii = list.get<Teuchos::Array<double>>("arc_radii");
  for (int k = 0; k < 4; ++k)
    body.arc_radius[k] = radii[k];
}

/// As fine as the mesh in the mean.
void setBlockCells(Deck const &deck, std::vector<Vector2> const &corners, BodySpec &body)
{
  double const size[2] = {(deck.x.to - deck.x.from) / deck.x.cells, (deck.y.to - deck.y.from) / deck.y.cells};
  for (int d = 0; d < 2; ++d)
  {
    Vector2 const a = corners[d + 1] - corners[d], b = corners[(d + 3) % 4] - corners[d + 2];
    double const length = 0.5 * (std::hypot(a[0], a[1]) + std::hypot(b[0], b[1]));
    body.cells[d] = static_cast<int>(std::max(1L, std::lround(length / size[d])));
  }
}

/// Convex blocks of four corners only.
void convertBlock(DeckChecker const &check, ParameterList const &list, std::string const &path, Deck const &deck,
                  BodySpec &body)
{
  if (list.isParameter("cells"))
  {
    auto const &cells = list.get<Teuchos::Array<double>>("cells");
    for (int d = 0; d < 2; ++d)
    {
      check.require(cells[d] == std::floor(cells[d]), keyPath(path, "cells"), "expected: two integers");
      check.require(cells[0] * cells[1] <= most_cells, keyPath(path, "cells"),
                    "more cells than 32-bit face numbers reach; expected: at most " + std::to_string(most_cells));
      body.cells[d] = static_cast<int>(cells[d]);
    }
  }
  convertBlockSides(check, list, path, deck, body);
  bool const fitted = deck.kinematics == Kinematics::Lagrangian;
  std::string const no_block = "a body of another kinematics than lagrangian is painted onto the cells of mesh";
  check.require(fitted || !list.isParameter("cells"), keyPath(path, "cells"), no_block);
  check.require(fitted || (body.cells_grading[0] == 1.0 && body.cells_grading[1] == 1.0),
                keyPath(path, "cells_grading"), no_block);
  bool const part = body.shape.kind == ShapeKind::MeshPart;
  check.require(!part || (fitted && !deck.mesh_file.empty()), keyPath(path, "shape"),
                "a mesh part needs kinematics lagrangian and mesh/file");
  check.require(!part || !list.isParameter("cells"), keyPath(path, "cells"), "a mesh part has its cells in the file");
  check.require(!part || !body.cut, keyPath(path, "cut"), "kinematics lagrangian cannot cut blocks");
  if (!fitted || part)
    return;
  std::vector<Vector2> const corners = outlinePoints(body.shape);
  check.require(corners.size() == 4, keyPath(path, "shape"),
                "kinematics lagrangian meshes blocks; expected: a rectangle, a polygon of four corners, or a mesh "
                "part");
  for (int k = 0; k < 4; ++k)
    check.require(cross(corners[(k + 1) % 4] - corners[k], corners[(k + 2) % 4] - corners[k]) > 0.0,
                  keyPath(path, "points"), "a lagrangian block must be convex");
  check.require(!body.cut, keyPath(path, "cut"), "kinematics lagrangian cannot cut blocks");
  if (!list.isParameter("cells"))
    setBlockCells(deck, corners, body);
  for (int d = 0; d < 2; ++d)
    check.require(AxisSpec{0.0, 1.0, body.cells[d], body.cells_grading[d]}.smallestCell() > 1e-12,
                  keyPath(path, "cells_grading"), numberText(body.cells_grading[d]) + " makes cells of no size");
}

void assignField(DeckChecker const &check, ParameterList const &list, std::string const &path, Deck &deck,
                 BodySpec &body)
{
  if (!list.isParameter("join"))
  {
    body.field = static_cast<int>(deck.fields.size());
    int const rigid_body = deck.laws[body.law].rigid ? deck.num_rigid_bodies++ : -1;
    deck.fields.push_back({body.name, body.law, rigid_body});
    return;
  }
  std::string const where = keyPath(path, "join");
  check.require(deck.kinematics != Kinematics::Lagrangian, where,
                "kinematics lagrangian does not weld the nodes of two blocks; expected: an interaction bonded, or one "
                "mesh part for both");
  std::string const name = list.get<std::string>("join");
  check.require(!deck.bodies.empty(), where, "the first body has none before it to join");
  BodySpec const &other = deck.bodies[requireIndex(check, deck.bodies, name, where, "earlier body")];
  check.require(other.law == body.law, where,
                "\"" + name + "\" has the law " + deck.laws[other.law].name + ", not " + deck.laws[body.law].name +
                    "; joined bodies share one law");
  check.require(!deck.laws[body.law].rigid, where, "rigid bodies cannot be joined");
  body.field = other.field;
}

/// Density at which a law whose pressure does not depend on energy has a pressure: Newton from the reference state.
double densityAtPressure(Material const &law, double internal_energy, double pressure)
{
  double density = law.density0;
  for (int i = 0; i < 100 && density > 0.0 && eosInRange(law, 1.0 / density, internal_energy); ++i)
  {
    EosState<double> const state = equationOfState(law, 1.0 / density, internal_energy);
    double const change = (pressure - state.pressure) / state.sound_speed_squared;
    density += change;
    if (std::fabs(change) <= 1e-15 * density)
      return density;
  }
  return -1.0;
}

/// Internal energy at which a law has a pressure: Newton with the slope between two energies, one step where p is
/// linear in e.
double energyAtPressure(Material law, double specific_volume, double pressure)
{
  law.tension_limit = 1e300;
  double const scale = 1e-3 * (law.eos == EosKind::Tillotson ? law.tillotson.energy : 1e6);
  double energy = law.energy0;
  for (int i = 0; i < 60; ++i)
  {
    double const here = equationOfState(law, specific_volume, energy).pressure;
    double const slope = (equationOfState(law, specific_volume, energy + scale).pressure - here) / scale;
    double const change = (pressure - here) / slope;
    energy += change;
    if (std::fabs(change) <= 1e-14 * (std::fabs(energy) + scale))
      break;
  }
  return energy;
}

/// Words of decks and of contact.csv.
void checkName(DeckChecker const &check, std::string const &name, Deck const &deck)
{
  std::vector<std::string> taken = {"void", "wall", "contact_wall"};
  if (deck.kinematics == Kinematics::Lagrangian)
    taken.insert(taken.end(), {"wall_left", "wall_right", "wall_bottom", "wall_top"});
  check.require(std::find(taken.begin(), taken.end(), name) == taken.end(), "bodies/" + name,
                "this name has a meaning of its own; taken are " + joined(taken));
}

} // namespace

InitialState initialState(DeckChecker const &check, ParameterList const &list, LawSpec const &law,
                          std::string const &path)
{
  Material const &m = law.law;
  InitialState state = {m.density0, m.energy0};
  bool const density_given = list.isParameter("density");
  bool const energy_given = list.isParameter("internal_energy");
  if (density_given)
    state.density = list.get<double>("density");
  if (energy_given)
    state.internal_energy = list.get<double>("internal_energy");
  if (law.rigid)
    return state;
  bool const by_pressure = list.isParameter("pressure"); // the energy is not known yet
  check.require(by_pressure || m.eos == EosKind::IdealGas || eosInRange(m, 1.0 / state.density, state.internal_energy),
                keyPath(path, "density"),
                numberText(state.density) + " is beyond the range of the law's equation of state");
  if (list.isParameter("pressure"))
  {
    std::string const where = keyPath(path, "pressure");
    double const pressure = list.get<double>("pressure");
    check.require(!energy_given, where, "given together with internal_energy; expected: one of them");
    check.require(pressure >= -m.tension_limit, where, numberText(pressure) + " is beyond the law's tension_limit");
    if (m.gruneisen > 0.0)
    {
      state.internal_energy = energyAtPressure(m, 1.0 / state.density, pressure);
      check.require(m.eos == EosKind::IdealGas || eosInRange(m, 1.0 / state.density, state.internal_energy), where,
                    numberText(pressure) + " is beyond the reach of the law");
    }
    else
    {
      check.require(!density_given, where, "follows from the density in this law; expected: one of them");
      state.density = densityAtPressure(m, m.energy0, pressure);
      check.require(state.density > 0.0, where, numberText(pressure) + " is beyond the reach of the law");
    }
  }
  check.require(m.eos != EosKind::IdealGas || state.internal_energy > 0.0, path,
                "an ideal gas needs a positive internal_energy or pressure");
  return state;
}

void convertBodies(DeckChecker const &check, ParameterList const &bodies, Deck &deck)
{
  check.require(bodies.numParams() > 0, "bodies", "none; expected: at least one");
  for (auto i = bodies.begin(); i != bodies.end(); ++i)
  {
    BodySpec body;
    body.name = bodies.name(i);
    std::string const path = "bodies/" + body.name;
    checkName(check, body.name, deck);
    ParameterList const &list = bodies.sublist(body.name);
    body.law = requireIndex(check, deck.laws, list.get<std::string>("material"), keyPath(path, "material"), "material");
    body.shape = shapeOf(check, list, path);
    refuseLostOutline(check, path, body.shape);
    body.velocity = vectorOf(list, "velocity");
    body.angular_velocity = list.get<double>("angular_velocity");
    body.radial_velocity = list.get<double>("radial_velocity");
    body.radial_radius = list.get<double>("radial_radius");
    body.radial_exponent = list.get<double>("radial_exponent");
    body.radial_centre = list.isParameter("radial_center") ? vectorOf(list, "radial_center") : body.shape.reference();
    body.cut = list.get<bool>("cut");
    InitialState const state = initialState(check, list, deck.laws[body.law], path);
    body.density = state.density;
    body.internal_energy = state.internal_energy;
    convertMotion(check, list, path, deck, body);
    convertBlock(check, list, path, deck, body);
    assignField(check, list, path, deck, body);
    check.require(body.shape.kind == ShapeKind::MeshPart || reachesMesh(body.shape, deck.x, deck.y), path,
                  "lies wholly outside of the mesh");
    deck.bodies.push_back(body);
  }
}

} // namespace Harmos
