// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LAGRANGE_HPP
#define HARMOS_LAGRANGE_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_Material.hpp>

namespace Harmos
{

struct LagrangeOptions
{
  double linear_viscosity = 0.06;
  double quadratic_viscosity = 1.2;
  double hourglass_viscosity = 0.05; // Flanagan-Belytschko, viscous
  Vector2 gravity = {0.0, 0.0};      // [m/s^2]
  double courant = 0.5;
  double largest_travel = 0.45;      // dt |v| over the smallest altitude of the cells around
  double light_node = 1e-3;          // dof nodes lighter than this part of a full one do not set the time step
};

/// Work arrays of one Lagrangian step.
struct LagrangeWork
{
  View<double *[8]> corner_force;        // num_pairs: fx, fy of corners 0..3, time level n [N/m]
  View<double *> dof_mass;               // num_dof_nodes [kg/m]
  View<double *[2]> predicted;           // num_dof_nodes: v* = v^{n-1/2} + dt a^n, node conditions applied
  View<double *[2]> half;                // num_dof_nodes: v^{n+1/2}, after the constraints
};

/// Largest stable time step and the pair that sets it.
struct TimeStepLimit
{
  double dt = 0.0;
  int cell = -1;     // local; -1: none
  int material = -1;
};

/// Sums over owned nodes of one prediction.
struct PredictionSums
{
  Vector2 wall_impulse = {0.0, 0.0}; // by node conditions on the bodies, sum m (v_bc - v_unconstrained) [N s/m]
  double wall_work = 0.0;            // that impulse . v_mean, v_mean with the predicted velocity [J/m]
  Vector2 gravity_impulse = {0.0, 0.0};
  double gravity_work = 0.0;
};

/// First trouble of a Lagrangian update.
struct UpdateReport
{
  long long inverted = 0;      // owned pairs whose moved cell has a non-positive corner area
  long long not_a_number = 0;  // owned pairs with a NaN, or a negative specific volume
  int cell = -1;               // the first such (lowest local number), with its material
  int material = -1;
};

/// Internal forces of all deformable pairs: f_I = -m sv (B_I^T (s - (p + q) 1)) + hourglass, B_I the mean-quadrature
/// gradient of the whole cell.
void computeCornerForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                         View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork &work);

} // namespace Harmos

#endif
