// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_POINTS_HPP
#define HARMOS_POINTS_HPP

#include <Harmos_Exchange.hpp>
#include <Harmos_FilledRegions.hpp>
#include <Harmos_Material.hpp>

#include <vector>

namespace Harmos
{

/// A point that moves with a material. All ranks hold all tracers alike.
struct Tracer
{
  Vector2 position = {0.0, 0.0}; // [length]
  Vector2 velocity = {0.0, 0.0}; // of its last move
  long long cell = -1;           // global number; -1: it has left the mesh
  int material = -1;             // that it moves with
};

/// What a state holds at a point.
struct PointSample
{
  bool inside = false;           // of the mesh
  int material = -1;             // -1: void
  double density = 0.0;          // mass over geometric volume
  double pressure = 0.0;         // positive in compression; 0 in rigid materials
  Vector2 velocity = {0.0, 0.0}; // bilinear from the pair's four dof nodes
  double internal_energy = 0.0;  // per mass
  double plastic_strain = 0.0;
  double von_mises = 0.0; // sqrt(3/2 s:s)
  double damage = 0.0;    // 0: sound, or no law can fail; 1: failed
};

/// One state, for the two functions below.
struct PointField
{
  Mesh mesh;
  CellMaterialPairs pairs;
  PairState state;
  FilledRegions regions;
  View<Material *> materials;
};

/// Global number of the cell that holds each point, the lowest where several do; -1: outside of the mesh. Collective.
/// Cost: cells times points.
std::vector<long long> locatePoints(Mesh const &mesh, std::vector<Vector2> const &points, Exchange const &exchange);

/// Samples of a state: at each point the pair whose filled region holds it (the lowest material on an interface).
///
/// \param cell      Of each point, from locatePoints; -1: outside.
/// \param material  Of each point: the pair to look at where the cell has one; -1: the region decides.
/// Collective; the cell's owner looks, all ranks get the same bits.
std::vector<PointSample> samplePoints(PointField const &field, std::vector<Vector2> const &points,
                                      std::vector<long long> const &cell, std::vector<int> const &material,
                                      Exchange const &exchange);

/// Move tracers as the cycle moves the material: x' = x + dt sum_I N_I(x) v_I, v = v^{n+1/2} of the pair's dof nodes.
///
/// Where the tracer's cell has no pair of its material (it runs along an interface), the nearest of the cells around
/// that has one extends its field; without any it keeps its last velocity. A tracer that leaves the mesh stays there.
/// \param field    Before the remap. \param half (num_dof_nodes, 2).
/// \param moving   The mesh moves with the material (kinematics lagrangian): a tracer then keeps its cell.
/// Collective; the owner of the cell moves it, all ranks get the same bits.
void moveTracers(PointField const &field, View<double *[2]> const &half, double dt, bool moving,
                 Exchange const &exchange, std::vector<Tracer> &tracers);

} // namespace Harmos

#endif
