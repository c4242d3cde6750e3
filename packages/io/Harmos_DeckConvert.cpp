// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckBodies.hpp>
#include <Harmos_DeckContact.hpp>
#include <Harmos_DeckLaws.hpp>
#include <Harmos_DeckReader.hpp>
#include <Harmos_Failure.hpp>

#include <Teuchos_Array.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Harmos
{

namespace
{

using Teuchos::ParameterList;

AxisSpec axisOf(DeckChecker const &check, ParameterList const &list, std::string const &path)
{
  AxisSpec axis;
  axis.from = list.get<double>("from");
  axis.to = list.get<double>("to");
  axis.cells = list.get<int>("cells");
  axis.grading = list.get<double>("grading");
  check.require(axis.to > axis.from, keyPath(path, "to"),
                numberText(axis.to) + " is not above from = " + numberText(axis.from));
  check.require(axis.smallestCell() > 1e-12 * (axis.to - axis.from), keyPath(path, "grading"),
                numberText(axis.grading) + " makes cells of no size");
  return axis;
}

/// \throw DeckError where damage would have to share its place in the remap.
void checkDamage(DeckChecker const &check, Deck const &deck)
{
  for (LawSpec const &law : deck.laws)
    check.require(!canFail(law.law) || !deck.remap.return_kinetic_defect, "numerics/remap/return_kinetic_defect",
                  "true does not go with materials that can fail (" + law.name +
                      "): the remap carries their damage in its place; expected: false");
}

void convertInflow(DeckChecker const &check, ParameterList const &list, std::string const &path, Vector2 const &outward,
                   Deck const &deck, Boundary &boundary)
{
  BodySpec const &body =
      deck.bodies[requireIndex(check, deck.bodies, list.get<std::string>("body"), keyPath(path, "body"), "body")];
  LawSpec const &law = deck.laws[body.law];
  check.require(!law.rigid, keyPath(path, "body"), "a rigid body cannot flow in");
  boundary.material = body.field;
  boundary.velocity = vectorOf(list, "velocity");
  check.require(dot(boundary.velocity, outward) < 0.0, keyPath(path, "velocity"),
                "does not point into the mesh; expected: an inflow");
  InitialState const state = initialState(check, list, law, path);
  boundary.specific_volume = 1.0 / state.density;
  boundary.internal_energy = state.internal_energy;
}

void convertBoundaries(DeckChecker const &check, ParameterList const &boundaries, Deck &deck)
{
  Vector2 const outward[num_boundary_sides] = {{-1.0, 0.0}, {1.0, 0.0}, {0.0, -1.0}, {0.0, 1.0}};
  bool const lagrangian = deck.kinematics == Kinematics::Lagrangian;
  for (int side = 0; side < num_boundary_sides; ++side)
  {
    ParameterList const &list = boundaries.sublist(side_name[side]);
    std::string const path = std::string("boundaries/") + side_name[side];
    std::string const type = list.get<std::string>("type");
    Boundary &boundary = deck.boundary[side];
    if (type == "contact wall")
    {
      boundary.kind = BoundaryKind::ContactWall;
      boundary.friction = list.get<double>("friction");
      boundary.restitution = list.get<double>("restitution");
    }
    else if (type == "fixed")
      boundary.kind = BoundaryKind::Fixed;
    else if (type == "outflow")
      boundary.kind = BoundaryKind::Outflow;
    else if (type == "inflow")
    {
      check.require(!lagrangian, keyPath(path, "type"), "kinematics lagrangian has no inflow: its mesh moves along");
      boundary.kind = BoundaryKind::Inflow;
      convertInflow(check, list, path, outward[side], deck, boundary);
    }
    else if (type == "prescribed")
    {
      check.require(lagrangian, keyPath(path, "type"), "a prescribed velocity needs kinematics lagrangian");
      boundary.kind = BoundaryKind::Prescribed;
      boundary.velocity = list.get<double>("normal_velocity") * outward[side];
    }
  }
}

void convertRemovalOrder(DeckChecker const &check, Teuchos::Array<std::string> const &names, Deck &deck)
{
  std::string const path = "numerics/reconstruction/removal_order";
  if (names.empty())
    return;
  for (std::string const &name : names)
  {
    int const field = name == "void" ? -1 : indexOf(deck.fields, name);
    check.require(name == "void" || field >= 0, path,
                  "\"" + name + "\" is no field (a body that joins none); expected one of: " +
                      joined(namesOf(deck.fields)) + ", void");
    auto const &order = deck.removal_order;
    check.require(std::find(order.begin(), order.end(), field) == order.end(), path, "\"" + name + "\" comes twice");
    deck.removal_order.push_back(field);
  }
  for (int field = 0; field < static_cast<int>(deck.fields.size()); ++field)
    check.require(std::find(deck.removal_order.begin(), deck.removal_order.end(), field) != deck.removal_order.end(),
                  path, "\"" + deck.fields[field].name + "\" is not in it; expected: every field once");
}

void convertNumerics(DeckChecker const &check, ParameterList const &list, Deck &deck)
{
  deck.lagrange.courant = list.get<double>("courant");
  deck.lagrange.linear_viscosity = list.get<double>("linear_viscosity");
  deck.lagrange.quadratic_viscosity = list.get<double>("quadratic_viscosity");
  deck.lagrange.hourglass_viscosity = list.get<double>("hourglass_viscosity");
  deck.lagrange.subzonal_pressure = list.get<double>("subzonal_pressure");
  std::string const where = list.get<std::string>("cut_cell_stress");
  deck.lagrange.cut_cell_stress = where == "cell mean"        ? CutCellStress::CellMean
                                  : where == "full cells"     ? CutCellStress::FullCells
                                  : where == "filled regions" ? CutCellStress::FilledRegions
                                                              : CutCellStress::Fluids;
  check.require(where == "full cells" || deck.kinematics == Kinematics::Xfem, "numerics/cut_cell_stress",
                '"' + where + "\" needs kinematics: xfem");
  bool const by_compressibility = list.get<std::string>("closure") == "compressibility";
  check.require(!by_compressibility || deck.kinematics == Kinematics::Single, "numerics/closure",
                "\"compressibility\" closes mixed cells with one velocity; expected: kinematics single");
  if (by_compressibility)
    deck.lagrange.closure = Closure::Compressibility;

  ParameterList const &reconstruction = list.sublist("reconstruction");
  std::string const method = reconstruction.get<std::string>("method");
  deck.reconstruction.method = method == "youngs" ? ReconstructionMethod::Youngs : ReconstructionMethod::MomentOfFluid;
  // Least squares is what moment-of-fluid does with slivers, and here every part is one.
  deck.reconstruction.sliver = method == "moment of fluid" ? reconstruction.get<double>("sliver") : 1.0;
  convertRemovalOrder(check, reconstruction.get<Teuchos::Array<std::string>>("removal_order"), deck);

  convertConstraint(check, list.sublist("constraint"), deck);

  ParameterList const &remap = list.sublist("remap");
  deck.remap.order = remap.get<int>("order");
  std::string const limiter = remap.get<std::string>("limiter");
  deck.remap.limiter = limiter == "range"          ? RemapLimiter::Range
                       : limiter == "range inside" ? RemapLimiter::RangeInside
                       : limiter == "van leer"     ? RemapLimiter::VanLeer
                                                   : RemapLimiter::None;
  deck.remap.swept_faces = remap.get<bool>("swept_faces");
  bool const by_contour = remap.get<std::string>("hessian") == "contour";
  deck.remap.hessian = by_contour ? RemapHessian::Contour : RemapHessian::LeastSquares;
  check.require(!by_contour || deck.remap.order == 3, "numerics/remap/hessian",
                "\"contour\" is for the third order; expected: numerics/remap/order 3");
  check.require(!by_contour || !deck.remap.swept_faces, "numerics/remap/hessian",
                "\"contour\" is by intersection alone; expected: numerics/remap/swept_faces false");
  deck.remap.merge_below = remap.get<double>("merge_below");
  deck.remap.close_void_below = remap.get<double>("close_void_below");
  deck.remap.close_void_beside_gas = remap.get<double>("close_void_beside_gas");
  deck.remap.cool_gas_below = remap.get<double>("cool_gas_below");
  deck.remap.part_overlaps = remap.get<bool>("part_overlaps");
  deck.remap.return_kinetic_defect = remap.get<bool>("return_kinetic_defect");
}

/// What has no meaning about an axis, or is planar only, is refused.
void checkAxisymmetric(DeckChecker const &check, Deck const &deck)
{
  std::string const why = " with geometry axisymmetric";
  check.require(deck.x.from >= 0.0, "mesh/x/from", numberText(deck.x.from) + " is a radius" + why + "; expected: >= 0");
  if (deck.x.from == 0.0)
    check.require(deck.boundary[Left].kind == BoundaryKind::SlipWall, "boundaries/left/type",
                  "the side is the axis" + why + " and mesh/x/from 0; expected: slip wall");
  check.require(deck.lagrange.gravity[0] == 0.0, "gravity", "it has a radial part" + why + "; expected: [0, g]");
  check.require(deck.prescribed.kind == FieldKind::None, "prescribed_velocity/field",
                "the fields are planar" + why + "; expected: none");
  for (BodySpec const &body : deck.bodies)
  {
    std::string const path = "bodies/" + body.name;
    check.require(body.angular_velocity == 0.0, keyPath(path, "angular_velocity"), "a ring does not turn" + why);
    check.require(!deck.laws[body.law].rigid || body.velocity[0] == 0.0, keyPath(path, "velocity"),
                  "a rigid ring moves along the axis alone" + why + "; expected: [0, v]");
  }
}

/// What a prescribed field leaves no meaning to is refused.
void checkPrescribed(DeckChecker const &check, ParameterList const &complete, Deck const &deck)
{
  std::string const why = " means nothing with a prescribed_velocity";
  check.require(deck.kinematics != Kinematics::Lagrangian, "kinematics", "lagrangian" + why + ": it has no remap");
  check.require(deck.lagrange.gravity[0] == 0.0 && deck.lagrange.gravity[1] == 0.0, "gravity", "it" + why);
  check.require(deck.lagrange.closure == Closure::EqualStrain, "numerics/closure", "compressibility" + why);
  check.require(!deck.remap.return_kinetic_defect, "numerics/remap/return_kinetic_defect", "true" + why);
  check.require(!deck.smoother.moves(), "mesh/smoother", "it" + why + ", which keeps the volumes of the cells");
  for (int side = 0; side < num_boundary_sides; ++side)
    check.require(complete.sublist("boundaries").sublist(side_name[side]).get<std::string>("type") == "slip wall",
                  std::string("boundaries/") + side_name[side] + "/type",
                  "material that moves with a prescribed_velocity stays inside of the mesh; expected: slip wall");
  for (PairInteraction const &interaction : deck.interaction)
    check.require(interaction.kind == Interaction::Sliding, "interactions", "a bond or friction" + why);
  for (BodySpec const &body : deck.bodies)
  {
    std::string const path = "bodies/" + body.name;
    check.require(!deck.laws[body.law].rigid, keyPath(path, "material"), "a rigid law" + why);
    check.require(body.velocity[0] == 0.0 && body.velocity[1] == 0.0, keyPath(path, "velocity"), "it" + why);
    check.require(body.angular_velocity == 0.0, keyPath(path, "angular_velocity"), "it" + why);
    check.require(body.radial_velocity == 0.0, keyPath(path, "radial_velocity"), "it" + why);
    check.require(body.density == deck.laws[body.law].law.density0, keyPath(path, "density"),
                  "with a prescribed_velocity the density is and stays that of the law");
  }
}

void convertPrescribed(DeckChecker const &check, ParameterList const &complete, Deck &deck)
{
  ParameterList const &list = complete.sublist("prescribed_velocity");
  std::string const field = list.get<std::string>("field");
  if (field == "none")
    return;
  PrescribedField &prescribed = deck.prescribed;
  prescribed.period = list.get<double>("period");
  if (field == "translation")
  {
    prescribed.kind = FieldKind::Translation;
    prescribed.velocity = vectorOf(list, "velocity");
  }
  else if (field == "rotation")
  {
    prescribed.kind = FieldKind::Rotation;
    prescribed.centre = vectorOf(list, "center");
    prescribed.angular_velocity = list.get<double>("angular_velocity");
  }
  else
  {
    prescribed.kind = field == "vortex" ? FieldKind::Vortex : FieldKind::Deformation;
    prescribed.speed = list.get<double>("speed");
    prescribed.corner = vectorOf(list, "corner");
    prescribed.length = list.get<double>("length");
  }
  checkPrescribed(check, complete, deck);
}

/// What comes every cycle by itself does so only where the deck names no other rhythm; the list keeps what was chosen.
Cadence cadenceOf(ParameterList &list)
{
  Cadence cadence;
  cadence.every_time = list.get<double>("every_time");
  cadence.every_wall_seconds = list.get<double>("every_wall_seconds");
  cadence.every_cycles = list.get("every_cycles", cadence.every_time > 0.0 || cadence.every_wall_seconds > 0.0 ? 0 : 1);
  cadence.at_end = list.get<bool>("at_end");
  return cadence;
}

void convertRunAndOutput(DeckChecker const &check, ParameterList const &run, ParameterList &output, Deck &deck)
{
  deck.run.end_time = run.get<double>("end_time");
  deck.run.max_cycles = run.get<int>("max_cycles");
  deck.run.max_dt = run.get<double>("max_dt");
  deck.run.initial_dt = run.get<double>("initial_dt");
  deck.output.xdmf = output.get<bool>("xdmf");
  deck.output.vtu = output.get<bool>("vtu");
  deck.output.history = cadenceOf(output.sublist("history"));
  deck.remap.measure_overlap = output.sublist("history").get<bool>("polygon_overlap");
  check.require(!deck.remap.measure_overlap || deck.kinematics != Kinematics::Lagrangian,
                "output/history/polygon_overlap",
                "true in kinematics lagrangian: its meshes are the bodies, and no cells that several of them are moved "
                "into; expected: false");
  deck.output.fields = cadenceOf(output.sublist("fields"));
  deck.output.checkpoint = cadenceOf(output.sublist("checkpoint"));
}

std::vector<PointSpec> pointsOf(DeckChecker const &check, ParameterList const &list, std::string const &kind,
                                Deck const &deck)
{
  std::vector<PointSpec> points;
  for (auto i = list.begin(); i != list.end(); ++i)
  {
    Vector2 const p = vectorOf(list.sublist(list.name(i)), "position");
    bool const inside = p[0] >= deck.x.from && p[0] <= deck.x.to && p[1] >= deck.y.from && p[1] <= deck.y.to;
    check.require(inside, kind + "/" + list.name(i) + "/position",
                  "[" + numberText(p[0]) + ", " + numberText(p[1]) + "] lies outside of the mesh");
    points.push_back({list.name(i), p});
  }
  return points;
}

/// Largest speed that the deck names; without one, a thousandth of the largest sound speed; without that, 1 m/s.
double speedScale(Deck const &deck)
{
  Vector2 const g = deck.lagrange.gravity;
  double speed = std::sqrt(std::hypot(g[0], g[1]) * std::hypot(deck.x.to - deck.x.from, deck.y.to - deck.y.from));
  double sound = 0.0;
  for (BodySpec const &body : deck.bodies)
    speed = std::max(speed, std::max(std::hypot(body.velocity[0], body.velocity[1]), std::fabs(body.radial_velocity)));
  for (Boundary const &boundary : deck.boundary)
    speed = std::max(speed, std::hypot(boundary.velocity[0], boundary.velocity[1]));
  for (BodySpec const &body : deck.bodies)
  {
    double reach = body.shape.outer_radius;
    for (Vector2 const &p : outlinePoints(body.shape))
      reach = std::max(reach, std::hypot(p[0] - body.shape.reference()[0], p[1] - body.shape.reference()[1]));
    speed = std::max(speed, std::fabs(body.angular_velocity) * reach);
  }
  for (LawSpec const &law : deck.laws)
    sound = std::max(sound, law.law.sound_speed0);
  if (speed > 0.0)
    return speed;
  return sound > 0.0 ? 1e-3 * sound : 1.0;
}

} // namespace

Deck convertDeck(ParameterList complete, std::string const &file)
{
  DeckChecker const check(file);
  Deck deck;
  deck.title = complete.get<std::string>("title");
  std::string const kinematics = complete.get<std::string>("kinematics");
  deck.kinematics = kinematics == "single"       ? Kinematics::Single
                    : kinematics == "lagrangian" ? Kinematics::Lagrangian
                                                 : Kinematics::Xfem;
  deck.geometry = complete.get<std::string>("geometry") == "axisymmetric" ? Geometry::Axisymmetric : Geometry::Planar;
  deck.lagrange.gravity = vectorOf(complete, "gravity");
  deck.x = axisOf(check, complete.sublist("mesh").sublist("x"), "mesh/x");
  deck.y = axisOf(check, complete.sublist("mesh").sublist("y"), "mesh/y");
  deck.jitter = complete.sublist("mesh").get<double>("jitter");
  deck.jitter_seed = complete.sublist("mesh").get<int>("jitter_seed");
  if (complete.sublist("mesh").isParameter("file"))
  {
    check.require(deck.kinematics == Kinematics::Lagrangian, "mesh/file",
                  "the mesh of another kinematics than lagrangian is its grid; expected: no file");
    std::size_t const slash = file.find_last_of('/');
    std::string const name = complete.sublist("mesh").get<std::string>("file");
    deck.mesh_file = name[0] == '/' || slash == std::string::npos ? name : file.substr(0, slash + 1) + name;
  }
  ParameterList const &smoother = complete.sublist("mesh").sublist("smoother");
  deck.smoother = {smoother.get<double>("follow"), smoother.get<double>("relax")};
  check.require(!deck.smoother.moves() || deck.kinematics != Kinematics::Lagrangian, "mesh/smoother",
                "the mesh of kinematics lagrangian is the material's; expected: follow and relax 0");
  check.require(deck.jitter == 0.0 || deck.kinematics != Kinematics::Lagrangian, "mesh/jitter",
                "the blocks of kinematics lagrangian have none; expected: 0");
  check.require(static_cast<long long>(deck.x.cells) * deck.y.cells <= most_cells, "mesh",
                "more cells than 32-bit face numbers reach; expected: at most " + std::to_string(most_cells));
  convertLaws(check, complete.sublist("materials"), deck);
  check.require(!deck.laws.empty(), "materials", "none; expected: at least one");
  convertBodies(check, complete.sublist("bodies"), deck);
  long long block_cells = 0;
  for (BodySpec const &body : deck.bodies)
    block_cells += static_cast<long long>(body.cells[0]) * body.cells[1];
  check.require(block_cells <= most_cells, "bodies",
                std::to_string(block_cells) + " cells in all, more than 32-bit face numbers reach; expected: at most " +
                    std::to_string(most_cells));
  convertBoundaries(check, complete.sublist("boundaries"), deck);
  convertInteractions(check, complete.sublist("interactions"), deck);
  convertNumerics(check, complete.sublist("numerics"), deck);
  checkDamage(check, deck);
  convertPrescribed(check, complete, deck);
  if (deck.geometry == Geometry::Axisymmetric)
    checkAxisymmetric(check, deck);
  convertRunAndOutput(check, complete.sublist("run"), complete.sublist("output"), deck);
  check.require(deck.output.xdmf || !deck.output.vtu, "output/vtu",
                "true without output/xdmf: a restart finds the times of the .vtu files in the HDF5 files; expected: "
                "output/xdmf: true");
  Cadence const &fields = deck.output.fields;
  check.require(deck.output.xdmf ||
                    !(fields.every_cycles > 0 || fields.every_time > 0.0 || fields.every_wall_seconds > 0.0),
                "output/fields", "every_... without output/xdmf writes nothing; expected: 0, or output/xdmf: true");
  deck.probes = pointsOf(check, complete.sublist("probes"), "probes", deck);
  deck.tracers = pointsOf(check, complete.sublist("tracers"), "tracers", deck);
  for (BodySpec const &body : deck.bodies)
    check.require(deck.tracers.empty() || body.name != "outside", "bodies/" + body.name,
                  "in tracers.csv this name means that a tracer has left the mesh; expected: another one");
  deck.constraint.speed_scale = speedScale(deck);
  deck.yaml = deckAsYaml(complete);
  deck.json = deckAsJson(complete);
  return deck;
}

} // namespace Harmos
