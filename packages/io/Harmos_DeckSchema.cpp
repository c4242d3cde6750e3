// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckSchema.hpp>

#include <detail/Harmos_SchemaRules.hpp>

#include <Harmos_ConstraintOptions.hpp>
#include <Harmos_Lagrange.hpp>
#include <Harmos_Reconstruct.hpp>
#include <Harmos_Remap.hpp>

#include <Teuchos_Array.hpp>

#include <ostream>

namespace Harmos
{

using namespace SchemaRules;

namespace
{

void addTop(ParameterList &list)
{
  add(list, "title", std::string(), rulesOf(KeyType::Text), "what the run is about");
  add(list, "kinematics", std::string("xfem"), choice({"xfem", "single", "lagrangian"}),
      "xfem: every field has its own velocity; single: one velocity in a mixed cell; lagrangian: body-fitted blocks "
      "that move with the material, no remap");
  add(list, "geometry", std::string("planar"), choice({"planar", "axisymmetric"}),
      "planar: per unit depth; axisymmetric: x is the radius, y the axis of symmetry, all amounts per radian");
  add(list, "gravity", pair(0.0, 0.0), numbers(2, 2, "m/s^2"), "acceleration of every deformable and free body");
}

void addMesh(ParameterList &mesh)
{
  for (char const *axis : {"x", "y"})
  {
    ParameterList &list = mesh.sublist(axis);
    add(list, "from", 0.0, required(number(any, "m")), "first grid line");
    add(list, "to", 0.0, required(number(any, "m")), "last grid line, above `from`");
    add(list, "cells", 0, required(integer({1.0, infinity, false, false})), "number of cells");
    add(list, "grading", 1.0, number(positive), "size of the last cell over the first; sizes grow geometrically");
  }
  add(mesh, "jitter", 0.0, number({0.0, 0.25, false, true}),
      "inner nodes move at random by up to this part of the smaller cell beside them, in x and in y");
  add(mesh, "file", std::string(), optional(rulesOf(KeyType::Text), "no file"),
      "lagrangian: Gmsh mesh of quadrilaterals (MSH 2.2 or 4.1, ASCII), from the deck's folder: bodies of shape mesh "
      "part are its physical surfaces; physical curves named left, right, bottom, top are boundaries");
  add(mesh, "jitter_seed", 1, integer(not_negative), "of the random numbers");
  ParameterList &smoother = mesh.sublist("smoother");
  add(smoother, "follow", 0.0, number(between(0.0, 1.0)),
      "part of the materials' mean motion that the nodes follow each cycle; 0: the mesh follows nothing");
  add(smoother, "relax", 0.0, number(between(0.0, 1.0)),
      "part of the way to the mean of its neighbours that each node then goes, each cycle; 0: no way");
}

void addState(ParameterList &list, std::string const &whose)
{
  add(list, "density", 0.0, optional(number(plausible_density, "kg/m^3"), "of the law"), "density of " + whose);
  add(list, "internal_energy", 0.0, optional(number(any, "J/kg"), "of the law"),
      "internal energy of " + whose + ", per mass; not together with pressure");
  add(list, "pressure", 0.0, optional(number(any, "Pa"), "follows from density and energy"),
      "pressure of " + whose +
          ", met by the internal energy, or by the density where the law's pressure does not depend on energy");
}

void addBoundaries(ParameterList &boundaries)
{
  for (char const *side : {"left", "right", "bottom", "top"})
  {
    ParameterList &list = boundaries.sublist(side);
    add(list, "type", std::string("slip wall"),
        choice({"slip wall", "contact wall", "fixed", "inflow", "outflow", "prescribed"}),
        "slip wall: no normal velocity (symmetry); contact wall: one-sided, a body can leave it; "
        "fixed: no velocity; inflow: given state; outflow: free of traction; prescribed: given normal velocity "
        "(lagrangian only)");
    add(list.sublist("type = contact wall"), "friction", 0.0, number(not_negative),
        "Coulomb's coefficient of the wall");
    add(list.sublist("type = contact wall"), "restitution", 0.0, number(between(0.0, 1.0)),
        "part of the closing speed that bodies part with from the wall; 1: the impact loses no energy (with friction "
        "corners that strike may gain some)");
    ParameterList &inflow = list.sublist("type = inflow");
    add(inflow, "body", std::string(), required(rulesOf(KeyType::Name)), "body whose material flows in");
    add(inflow, "velocity", pair(0.0, 0.0), required(numbers(2, 2, "m/s")), "velocity, into the mesh");
    addState(inflow, "what flows in");
    ParameterList &prescribed = list.sublist("type = prescribed");
    add(prescribed, "normal_velocity", 0.0, required(number(any, "m/s")), "velocity out of the mesh");
  }
}

void addPrescribedVelocity(ParameterList &list)
{
  add(list, "field", std::string("none"), choice({"none", "translation", "rotation", "vortex", "deformation"}),
      "none: mechanics; else all material moves with a given velocity field, without forces and constraints: vortex: "
      "one vortex that fills the box; deformation: sixteen vortices of alternating sense");
  for (char const *field : {"translation", "rotation", "vortex", "deformation"})
    add(list.sublist(std::string("field = ") + field), "period", 0.0, number(not_negative, "s"),
        "the velocity varies as cos(pi t / period), so that all is back at t = period; 0: steady");
  add(list.sublist("field = translation"), "velocity", pair(0.0, 0.0), required(numbers(2, 2, "m/s")), "velocity");
  ParameterList &rotation = list.sublist("field = rotation");
  add(rotation, "center", pair(0.0, 0.0), required(numbers(2, 2, "m")), "centre of the rotation");
  add(rotation, "angular_velocity", 0.0, required(number(any, "rad/s")), "counter-clockwise");
  for (char const *field : {"vortex", "deformation"})
  {
    ParameterList &box = list.sublist(std::string("field = ") + field);
    add(box, "speed", 1.0, number(positive, "m/s"), "largest speed");
    add(box, "corner", pair(0.0, 0.0), numbers(2, 2, "m"), "lower left corner of the square box of the field");
    add(box, "length", 1.0, number(positive, "m"), "side of the box");
  }
}

void addShapes(ParameterList &list)
{
  add(list, "shape", std::string(),
      required(choice({"rectangle", "disc", "annulus", "polygon", "half-plane", "mesh part"})),
      "outline of the body; mesh part: a physical surface of mesh/file (lagrangian)");
  add(list.sublist("shape = mesh part"), "part", std::string(), required(rulesOf(KeyType::Text)),
      "name of the physical surface");
  ParameterList &rectangle = list.sublist("shape = rectangle");
  add(rectangle, "center", pair(0.0, 0.0), required(numbers(2, 2, "m")), "centre");
  add(rectangle, "size", pair(0.0, 0.0), required(numbers(2, 2, "m", positive)), "width and height before rotation");
  ParameterList &disc = list.sublist("shape = disc");
  add(disc, "center", pair(0.0, 0.0), required(numbers(2, 2, "m")), "centre");
  add(disc, "radius", 0.0, required(number(positive, "m")), "radius");
  ParameterList &annulus = list.sublist("shape = annulus");
  add(annulus, "center", pair(0.0, 0.0), required(numbers(2, 2, "m")), "centre");
  add(annulus, "inner_radius", 0.0, required(number(positive, "m")), "radius of the hole");
  add(annulus, "outer_radius", 0.0, required(number(positive, "m")), "outer radius");
  ParameterList &polygon = list.sublist("shape = polygon");
  add(polygon, "points", pair(0.0, 0.0), required(numbers(6, 0, "m")),
      "corners x0, y0, x1, y1, ... in either sense, without crossing edges");
  ParameterList &half_plane = list.sublist("shape = half-plane");
  add(half_plane, "point", pair(0.0, 0.0), required(numbers(2, 2, "m")), "a point on its edge");
  add(half_plane, "normal", pair(0.0, 0.0), required(numbers(2, 2, "")),
      "direction out of the material, of any length");
}

void addBodies(ParameterList &bodies)
{
  ParameterList &list = bodies.sublist("NAME");
  add(list, "material", std::string(), required(rulesOf(KeyType::Name)), "law, a name in `materials`");
  addShapes(list);
  add(list, "angle", 0.0, number(any, "degrees"),
      "rotation, counter-clockwise about the centre (polygon: centroid, half-plane: point)");
  add(list, "shift", pair(0.0, 0.0), numbers(2, 2, "m"), "displacement after the rotation");
  add(list, "velocity", pair(0.0, 0.0), numbers(2, 2, "m/s"), "initial velocity of the centre");
  add(list, "angular_velocity", 0.0, number(any, "rad/s"), "initial rotation about the centre");
  add(list, "radial_velocity", 0.0, number(any, "m/s"),
      "initial speed away from radial_center, at the distance radial_radius from it");
  add(list, "radial_center", pair(0.0, 0.0), optional(numbers(2, 2, "m"), "the body's centre"),
      "where the radial velocity leads away from");
  add(list, "radial_radius", 1.0, number(positive, "m"), "where the radial velocity is radial_velocity");
  add(list, "radial_exponent", 0.0, number(between(-10.0, 10.0)),
      "the radial velocity varies with this power of the distance: -1 keeps the area of rings, 1 is uniform expansion");
  addState(list, "the body at the start");
  add(list, "cut", false, rulesOf(KeyType::Bool),
      "cut this body out of the bodies before it (rigid ones cannot be cut)");
  add(list, "join", std::string(), optional(rulesOf(KeyType::Name), "a velocity field of its own"),
      "earlier body of the same law whose velocity field this one shares (they weld)");
  add(list, "motion", std::string("fixed"), optional(choice({"fixed", "prescribed", "free"}), "fixed (rigid law)"),
      "of a rigid body. fixed: at rest; prescribed: keeps its velocities; free: follows from impulse and torque");
  add(list, "cells", Teuchos::Array<double>(Teuchos::tuple(1.0, 1.0)),
      optional(numbers(2, 2, "", {1.0, 1e6, false, false}), "from the size of the mesh's cells"),
      "lagrangian only: cells of the block along its first and second side");
  add(list, "cells_grading", pair(1.0, 1.0), numbers(2, 2, "", positive),
      "lagrangian only: size of the last cell over the first along the same sides");
  add(list, "arc_radii", Teuchos::Array<double>(4, 0.0), optional(numbers(4, 4, "m"), "straight"),
      "lagrangian: the block's sides as arcs with these radii; 0: straight, positive: bulging outwards");
}

void addInteractions(ParameterList &list)
{
  KeyRules const kind = choice({"sliding", "bonded", "friction"});
  auto const addLaws = [](ParameterList &where, std::string const &key)
  {
    ParameterList &friction = where.sublist(key + " = friction");
    add(friction, "coefficient", 0.0, required(number(positive)), "Coulomb's: tangential over normal force at most");
    for (char const *kind : {"sliding", "friction"})
      add(where.sublist(key + " = " + kind), "restitution", 0.0, number(between(0.0, 1.0)),
          "part of the closing speed that surfaces part with when they touch; 1: the impact loses no energy (with "
          "friction corners that strike may gain some)");
    ParameterList &bonded = where.sublist(key + " = bonded");
    for (char const *way : {"tensile", "shear"})
      add(bonded, std::string(way) + "_strength", 0.0, optional(number(positive, "Pa"), "without limit"),
          std::string("largest ") + way + " traction; what has broken slides from then on");
  };
  add(list, "default", std::string("sliding"), kind,
      "between any two fields. sliding: frictionless, free to separate; bonded: no relative velocity; friction: "
      "Coulomb, free to separate");
  addLaws(list, "default");
  ParameterList &exception = list.sublist("NAME");
  add(exception, "between", std::string(), required(rulesOf(KeyType::Name)), "a body");
  add(exception, "and", std::string(), required(rulesOf(KeyType::Name)), "another body");
  add(exception, "type", std::string(), required(kind), "how these two interact");
  addLaws(exception, "type");
}

void addNumerics(ParameterList &list)
{
  LagrangeOptions const lagrange;
  add(list, "courant", lagrange.courant, number({1e-6, 1.0, false, true}),
      "part of the time in which a wave crosses a cell that a step takes, or less where parts of cut cells or free "
      "edges ask for it");
  add(list, "linear_viscosity", lagrange.linear_viscosity, number(between(0.0, 10.0)), "artificial, in compression");
  add(list, "quadratic_viscosity", lagrange.quadratic_viscosity, number(between(0.0, 10.0)),
      "artificial, in compression");
  add(list, "hourglass_viscosity", lagrange.hourglass_viscosity, number(between(0.0, 0.25)),
      "Flanagan-Belytschko coefficient; 0.25 is critical at Courant 1");
  add(list, "subzonal_pressure", lagrange.subzonal_pressure, number(between(0.0, 1.0)),
      "kinematics lagrangian: stiffness of cells against becoming wedges, part of the bulk modulus "
      "(Caramana-Shashkov)");
  add(list, "cut_cell_stress", std::string("full cells"),
      choice({"cell mean", "fluids", "full cells", "filled regions"}),
      "xfem: where the stress of a material in a mixed cell acts. cell mean: along the cell's mean gradients; filled "
      "regions: over the part that it fills, in balance with the tractions; fluids: so for materials without strength; "
      "full cells: for the others too as far as their cell holds no void, none at 1% of it");
  add(list, "closure", std::string("equal strain"), choice({"equal strain", "compressibility"}),
      "of mixed cells in `single`. equal strain: all materials of a cell strain alike; compressibility: they share its "
      "change of volume in proportion to volume over bulk modulus, void first");

  ReconstructionOptions const reconstruction;
  ParameterList &r = list.sublist("reconstruction");
  add(r, "method", std::string("moment of fluid"), choice({"moment of fluid", "least squares", "youngs"}),
      "interface normals. moment of fluid: from centroids; least squares: the line that gives the neighbours their "
      "volume fractions best (LVIRA); youngs: gradient of the volume fraction");
  add(r.sublist("method = moment of fluid"), "sliver", reconstruction.sliver, number(between(0.0, 0.5)),
      "below this volume fraction normals come from least squares; where it is less than 1e-3, void below that and "
      "bodies that fill less than a tenth of every neighbour go by least squares too, void unless it is a tip of a "
      "void beyond");
  add(r, "removal_order", Teuchos::Array<std::string>(), rulesOf(KeyType::Names),
      "fixed order in which materials leave a mixed cell: every field once, by its first body, and void (last when "
      "not named). Empty: chosen by the method");

  ConstraintOptions const constraint;
  ParameterList &c = list.sublist("constraint");
  add(c, "method", std::string("multipliers"), choice({"multipliers", "penalty", "nitsche", "nodal", "merged"}),
      "what acts at the interfaces. multipliers: forward-increment Lagrange multipliers; penalty, nitsche: tractions "
      "from the closing velocity, without a solve; nodal: contact at nodes that several materials move; merged: all "
      "materials at a node stick");
  for (char const *method : {"penalty", "nitsche"})
    add(c.sublist(std::string("method = ") + method), "penalty", constraint.penalty, number(positive),
        "traction over impedance times closing velocity");
  add(c.sublist("method = multipliers"), "placement", std::string("midpoint"),
      choice({"midpoint", "gauss points", "segment ends", "vital vertices", "mortar"}),
      "of the multipliers: one on a segment (two where an end comes fast), two, or one for each vital cell edge that "
      "the interface crosses, against the approach of midpoints or (mortar) its integral");
  add(c, "solver", std::string("projected newton"), choice({"projected newton", "conjugate gradients", "row sums"}),
      "of the multipliers. projected newton: with a factor of the assembled matrix, on every rank the whole problem; "
      "conjugate gradients: with projections, without a matrix; row sums: the plain iteration with the row sums of the "
      "operator, for comparison");
  for (char const *method : {"multipliers", "nodal", "merged"})
  {
    ParameterList &solved = c.sublist(std::string("method = ") + method);
    add(solved, "tolerance", constraint.tolerance, number({0.0, 1e-2, true, false}),
        "relative residual of the multipliers");
    add(solved, "max_iterations", constraint.max_iterations, integer({1.0, infinity, false, false}),
        "limit for one cycle");
    add(solved, "warm_start", constraint.warm_start, rulesOf(KeyType::Bool),
        "whether the solver begins with the forces of the last cycle");
  }
  for (char const *method : {"multipliers", "penalty", "nitsche"})
  {
    ParameterList &on_segments = c.sublist(std::string("method = ") + method);
    add(on_segments, "shortest_segment", constraint.shortest_segment, number(between(0.0, 1.0)),
        "interface segments shorter than this part of a cell carry no multiplier, and are moved as straight edges");
    add(on_segments, "exposed_face", constraint.exposed_face, number(between(0.0, 1.0)),
        "least exposed part of a cell face that carries a multiplier, but where it lies along a wall, a straight rigid "
        "edge or a fluid");
  }

  RemapOptions const remap;
  ParameterList &m = list.sublist("remap");
  add(m, "order", remap.order, integer(between(1.0, 3.0)),
      "1: constant in a cell; 2: limited linear; 3: limited quadratic (momentum of swept regions stays linear)");
  add(m, "hessian", std::string("least squares"), choice({"least squares", "contour"}),
      "order 3: a fit that is exact for quadratics, or contour integrals (Dukowicz and Kodis)");
  add(m, "limiter", std::string("range inside"), choice({"range", "range inside", "van leer", "none"}),
      "of gradients. range: no new extrema; range inside: the same, at the mesh's boundary with mirrored values beyond "
      "it; van leer: towards neighbours; it and none overshoot, for smooth fields");
  add(m, "swept_faces", remap.swept_faces, rulesOf(KeyType::Bool),
      "pure regions by swept faces; false: intersection everywhere");
  add(m, "merge_below", remap.merge_below, number(between(0.0, 0.1)),
      "fragments below this volume fraction merge with neighbours of their material; 0: never");
  add(m, "close_void_below", remap.close_void_below, number(between(0.0, 0.01)),
      "spurious void below this part of a cell is closed");
  add(m, "close_void_beside_gas", remap.close_void_beside_gas, number(between(0.0, 0.1)),
      "a gas fills void below this part of a cell and a tenth of the gas there, gives way to overlaps as far, and does "
      "the work of that; 0: never");
  add(m, "cool_gas_below", remap.cool_gas_below, number(between(0.0, 0.5)),
      "gas that fills less than this part of a cell beside liquids or solids is no warmer than twice the gas around it "
      "or, if more, its warmest body at the start; they take the rest; 0: never");
  add(m, "part_overlaps", remap.part_overlaps, rulesOf(KeyType::Bool),
      "what moved regions have in common of bodies that have flowed (plastic strain above 0.1) and pass each other is "
      "divided between them before the remap");
  add(m, "return_kinetic_defect", remap.return_kinetic_defect, rulesOf(KeyType::Bool),
      "kinetic energy lost by the remap becomes internal energy (not beside materials that can fail): behind strong "
      "shocks some percent of it, at any resolution");
}

void addRun(ParameterList &list)
{
  add(list, "end_time", 0.0, required(number(positive, "s")), "the run starts at 0");
  add(list, "max_cycles", 0, integer(not_negative), "stop after this many cycles; 0: no limit");
  add(list, "max_dt", 0.0, number(not_negative, "s"), "largest time step; 0: no limit");
  add(list, "initial_dt", 0.0, number(not_negative, "s"), "largest step of the first cycle; 0: no limit");
}

/// \param by_itself It comes every cycle where nothing else is said.
void addCadence(ParameterList &list, bool by_itself, bool at_end, std::string const &what)
{
  add(list, "every_time", 0.0, number(not_negative, "s"), what + " every interval of simulated time; 0: not by time");
  add(list, "every_wall_seconds", 0.0, number(not_negative, "s"), what + " by the wall clock; 0: not so");
  add(list, "at_end", at_end, rulesOf(KeyType::Bool), what + " after the last cycle");
  KeyRules const count = integer(not_negative);
  // The last: so it stands where what convertDeck chooses does.
  add(list, "every_cycles", 0, by_itself ? optional(count, "1; beside every_time or every_wall_seconds 0") : count,
      what + " every so many cycles; 0: not by cycles");
}

void addOutput(ParameterList &list)
{
  add(list, "xdmf", true, rulesOf(KeyType::Bool), "fields as HDF5 with XDMF; false: no fields");
  add(list, "vtu", false, rulesOf(KeyType::Bool), "fields as VTK files too");
  add(list.sublist("history"), "polygon_overlap", false, rulesOf(KeyType::Bool),
      "columns of what moved regions of different materials overlap before the remap, polygon by polygon; not in "
      "kinematics lagrangian");
  addCadence(list.sublist("history"), true, true, "rows of history, contact, probes and tracers");
  addCadence(list.sublist("fields"), false, true, "fields");
  addCadence(list.sublist("checkpoint"), false, false, "a checkpoint");
}

} // namespace

ParameterList deckSchema()
{
  ParameterList schema("harmos");
  addTop(schema);
  addMesh(schema.sublist("mesh"));
  addBoundaries(schema.sublist("boundaries"));
  addPrescribedVelocity(schema.sublist("prescribed_velocity"));
  addMaterials(schema.sublist("materials"));
  addBodies(schema.sublist("bodies"));
  addInteractions(schema.sublist("interactions"));
  addNumerics(schema.sublist("numerics"));
  addRun(schema.sublist("run"));
  addOutput(schema.sublist("output"));
  for (char const *kind : {"probes", "tracers"})
    add(schema.sublist(kind).sublist("NAME"), "position", pair(0.0, 0.0), required(numbers(2, 2, "m")),
        std::string(kind) == "probes" ? "a fixed point whose state is recorded"
                                      : "start of a point that moves with its material");
  return schema;
}

void printSchema(std::ostream &out)
{
  printSchema(out, deckSchema());
}

void printSchema(std::ostream &out, ParameterList const &schema)
{
  out << "Keys of a deck, below its outermost key `harmos`. SI units. NAME: any number of named maps.\n";
  for (SchemaKey const &key : schemaKeys(schema))
  {
    out << "\n" << key.path;
    if (!key.condition.empty())
      out << "   (where " << key.condition << ")";
    out << "\n    type: " << key.expected << "\n    default: " << key.default_text << "\n    " << key.doc << "\n";
  }
}

} // namespace Harmos
