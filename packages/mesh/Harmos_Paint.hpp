// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PAINT_HPP
#define HARMOS_PAINT_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_OutlineCorner.hpp>
#include <Harmos_Shape.hpp>

#include <string>
#include <vector>

namespace Harmos
{

/// The velocities of a body when it is painted.
struct BodyMotion
{
  Vector2 velocity = {0.0, 0.0};        // [m/s]; v(x): velocityAt
  double angular_velocity = 0.0;        // [rad/s]
  double radial_velocity = 0.0;         // away from radial_centre, at radial_radius from it [m/s]
  double radial_radius = 1.0;           // [m]
  double radial_exponent = 0.0;         // of the distance
  Vector2 rotation_centre = {0.0, 0.0}; // [m]
  Vector2 radial_centre = {0.0, 0.0};   // [m]

  /// velocity + angular_velocity z x (x - rotation_centre) + radial_velocity (|d| / radial_radius)^radial_exponent
  /// d / |d|, d = x - radial_centre; no radial part at d = 0.
  KOKKOS_INLINE_FUNCTION Vector2 velocityAt(Vector2 const &x) const
  {
    Vector2 const v = velocity + angular_velocity * perpendicular(x - rotation_centre);
    Vector2 const d = x - radial_centre;
    double const r = norm(d);
    if (radial_velocity == 0.0 || r == 0.0)
      return v;
    return v + (radial_velocity * Math::pow(r / radial_radius, radial_exponent) / r) * d;
  }
};

/// A region filled with one material in a uniform initial state. Bodies may share a material number: they are then one
/// velocity field.
struct Body : BodyMotion
{
  Shape shape;
  int material = 0;
  double density = 0.0;          // > 0 [kg/m^3]
  double specific_volume = 0.0;  // thermodynamic, > 0 [m^3/kg]: 1 / density where unloaded
  double internal_energy = 0.0;  // per mass [J/kg]
  bool cut_from_earlier = false; // the bodies before this one lose the region that it fills
  std::string name;              // for messages
};

/// The initial pairs and their state.
struct Painting
{
  CellMaterialPairs pairs;                // offset, material and cell; buildDofNodes fills in the rest
  View<double *[num_pair_fields]> record; // Mass, VolumeFraction, SpecificVolume, InternalEnergy; the rest is zero
  View<double *[2]> centroid;             // of the filled region; of the cell where it is pure
  Rows pair_body;                         // pair -> the bodies that make it up, ascending
  View<double *> body_mass;               // mass of each item of pair_body [kg/m, or kg per radian]
};

/// Paint bodies into exact volume fractions of all local cells (halo cells alike), by the mesh's geometry.
///
/// Region of body i: shape_i without the shapes of all later bodies that are cut from earlier ones.
/// Fractions below 1e-14 make no pair; a cell whose fractions sum to one within 1e-13 sums to one exactly (a lone pair
/// has exactly 1); a sum never exceeds one. Specific volume and internal energy of merged bodies are averaged by mass.
/// \throw std::runtime_error, naming the global cell and both bodies, where two bodies share more than 1e-9 of a cell
/// and
///        the later one is not cut from the earlier; or naming the body whose density or specific volume is not
///        positive or whose material is negative.
/// Cost: a box test per cell and body, clipping only in cells that a boundary crosses.
Painting paint(Mesh const &mesh, std::vector<Body> const &bodies);

/// Velocities of the dof nodes: of the body at the node, averaged by the bodies' corner masses where several meet.
///
/// \param pairs As painted (offset, material). \param dof_nodes Of these pairs, any kinematics.
/// \return num_dof_nodes, [m/s].
View<double *[2]> paintedVelocity(Mesh const &mesh, std::vector<Body> const &bodies, Painting const &painting,
                                  NodeMaterialPairs const &dof_nodes);

/// Rows over cells of what shapes fill, materials ascending within a cell.
struct PaintedRows
{
  View<int *> offset;   // num_cells + 1
  View<int *> material; // items
  View<double *> volume_fraction;
  View<double *[2]> centroid; // of the filled part
  View<OutlineCorner *> corner;
};

/// Volume fractions and centroids of rigid bodies at their current poses, with the rules of `paint` (fractions below
/// 1e-14 left out, sums at most one).
///
/// \param shapes    At their current pose (Shape::moved).
/// \param materials Material of each shape; shapes of one material add up.
/// Only cells in the shapes' bounding boxes are looked at beyond one box test. Shapes that do not move need no new
/// call.
PaintedRows rigidVolumes(Mesh const &mesh, std::vector<Shape> const &shapes, std::vector<int> const &materials);

} // namespace Harmos

#endif
