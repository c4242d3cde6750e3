// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DECK_HPP
#define HARMOS_DECK_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_ConstraintOptions.hpp>
#include <Harmos_Lagrange.hpp>
#include <Harmos_Material.hpp>
#include <Harmos_MeshSmoother.hpp>
#include <Harmos_PrescribedField.hpp>
#include <Harmos_Reconstruct.hpp>
#include <Harmos_Remap.hpp>
#include <Harmos_RigidBody.hpp>

#include <string>
#include <vector>

/// What a deck says, checked and with all defaults filled in: plain host values, SI units, angles in radians.
/// readDeck (Harmos_DeckReader.hpp) makes it.

namespace Harmos
{

/// Cells along one axis. Sizes grow geometrically: last / first = grading.
struct AxisSpec
{
  double from = 0.0; // [m]
  double to = 0.0;   // [m], > from
  int cells = 0;
  double grading = 1.0;

  /// Position of grid line i = 0..cells; exact at both ends.
  double position(int i) const;
  double smallestCell() const;
};

enum BoundarySide : int
{
  Left = 0,
  Right = 1,
  Bottom = 2,
  Top = 3,
  num_boundary_sides = 4
};

enum class ShapeKind
{
  Rectangle,
  Disc,
  Annulus,
  Polygon,
  HalfPlane,
  MeshPart // lagrangian: a physical surface of Deck::mesh_file
};

/// An outline: first as its own numbers say, then rotated by `angle` about reference(), then moved by `shift`.
struct ShapeSpec
{
  ShapeKind kind = ShapeKind::Rectangle;
  Vector2 center = {0.0, 0.0}; // rectangle, disc, annulus; half-plane: a point on its edge; polygon: its centroid [m]
  Vector2 size = {0.0, 0.0};   // rectangle: width, height [m]
  double inner_radius = 0.0;   // annulus [m]
  double outer_radius = 0.0;   // disc, annulus [m]
  std::vector<Vector2> points; // polygon, counter-clockwise [m]
  std::string part;            // mesh part: name of the physical surface
  Vector2 normal = {0.0, 1.0}; // half-plane: unit vector that leaves the material
  double angle = 0.0;          // [rad], counter-clockwise
  Vector2 shift = {0.0, 0.0};  // [m]

  /// The point that the rotation keeps, moved: where the body's angular velocity turns about.
  Vector2 reference() const { return center + shift; }
};

/// An entry of the deck's `materials`: a law that any number of bodies may name.
struct LawSpec
{
  std::string name;
  bool rigid = false;
  Material law; // rigid: density0 alone means something
};

/// A material number: one velocity field, shared by the bodies that join it.
struct FieldSpec
{
  std::string name;    // of its first body
  int law = -1;        // in Deck::laws
  int rigid_body = -1; // running number of the rigid body that it is; -1: deformable
};

struct BodySpec
{
  std::string name;
  int law = -1;   // in Deck::laws
  int field = -1; // in Deck::fields
  ShapeSpec shape;
  Vector2 velocity = {0.0, 0.0}; // of the shape's reference point [m/s]
  double angular_velocity = 0.0; // [rad/s]
  double radial_velocity = 0.0;  // of Body (Harmos_Paint.hpp) [m/s]
  double radial_radius = 1.0;    // [m]
  double radial_exponent = 0.0;
  Vector2 radial_centre = {0.0, 0.0};      // [m]
  double density = 0.0;                    // initial [kg/m^3]
  double internal_energy = 0.0;            // initial, per mass [J/kg]; an initial pressure is turned into it
  bool cut = false;                        // cut out of the bodies before it
  RigidMotion motion = RigidMotion::Fixed; // rigid laws only
  int cells[2] = {0, 0};                   // lagrangian: cells along the block's sides (0->1, 1->2), >= 1
  double cells_grading[2] = {1.0, 1.0};    // lagrangian: last over first cell along them
  double arc_radius[4] = {};               // lagrangian: of the block's sides (MappedBlock) [m]
};

/// When to do something: any of the criteria that are > 0.
struct Cadence
{
  int every_cycles = 0;
  double every_time = 0.0;         // [s], simulated
  double every_wall_seconds = 0.0; // [s], of the wall clock
  bool at_end = false;             // after the last cycle too
};

/// A named point: a probe stays, a tracer moves with a material.
struct PointSpec
{
  std::string name;
  Vector2 position = {0.0, 0.0}; // [m]
};

struct OutputSpec
{
  Cadence history; // of history.csv, contact.csv, probes and tracers
  Cadence fields;
  Cadence checkpoint;
  bool xdmf = true; // HDF5 + XDMF
  bool vtu = false;
};

struct RunSpec
{
  double end_time = 0.0;   // [s]
  int max_cycles = 0;      // 0: no limit
  double max_dt = 0.0;     // [s]; 0: no limit
  double initial_dt = 0.0; // [s], largest step of the first cycle; 0: no limit
};

struct Deck
{
  std::string file; // as it was named, for messages
  std::string title;
  Kinematics kinematics = Kinematics::Xfem;
  Geometry geometry = Geometry::Planar;
  AxisSpec x, y;
  std::string mesh_file; // lagrangian: Gmsh mesh of the mesh parts; empty: none
  double jitter = 0.0;   // of the inner nodes, part of the smaller cell beside a grid line
  int jitter_seed = 1;
  MeshSmoother smoother;                 // xfem, single
  Boundary boundary[num_boundary_sides]; // Inflow: `material` is a field
  std::vector<LawSpec> laws;
  std::vector<BodySpec> bodies;  // in the order of the deck
  std::vector<FieldSpec> fields; // the material numbers
  int num_rigid_bodies = 0;
  std::vector<PairInteraction> interaction; // (fields, fields), row-major, symmetric
  std::vector<std::string> exception;       // (fields, fields), the smaller first: the entry that names the pair

  LagrangeOptions lagrange;             // with gravity and Courant number
  ReconstructionOptions reconstruction; // without `order`, which is
  std::vector<int> removal_order;       // fields, -1: void; empty: chosen by the method
  ConstraintOptions constraint;         // without `interaction`; with speed_scale
  RemapOptions remap;
  PrescribedField prescribed; // with a kind: no mechanics

  RunSpec run;
  OutputSpec output;
  std::vector<PointSpec> probes;
  std::vector<PointSpec> tracers;

  std::vector<std::string> idle_keys; // given, and without effect in these kinematics (idleKeys)

  std::string yaml; // the whole deck with defaults, as YAML that reads back to this deck
  std::string json; // the same as a JSON object

  /// Law of a field as the kernels want it (with its rigid_body).
  Material fieldMaterial(int field) const;
};

/// Outline's polygon (rectangle, polygon) after rotation and shift, counter-clockwise; empty for other shapes.
std::vector<Vector2> outlinePoints(ShapeSpec const &shape);

} // namespace Harmos

#endif
