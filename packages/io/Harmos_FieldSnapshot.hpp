// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FIELD_SNAPSHOT_HPP
#define HARMOS_FIELD_SNAPSHOT_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_FilledRegions.hpp>
#include <Harmos_Material.hpp>

#include <vector>

namespace Harmos
{

/// The fields of one time on the host: what this rank owns, ascending by global number. SI units.
///
/// Vectors have three components (the last is zero), as viewers expect them.
struct FieldSnapshot
{
  Geometry geometry = Geometry::Planar;

  struct Nodes
  {
    std::vector<long long> global;
    std::vector<double> position; // (nodes, 2)
    std::vector<double> velocity; // (nodes, 3), mean over the node's materials by lumped mass; zero in void
  } nodes;

  struct Cells
  {
    std::vector<long long> global;
    std::vector<long long> node;         // (cells, 4), global numbers, counter-clockwise
    std::vector<double> volume_fraction; // sum over the materials: 1 - void
    std::vector<double> density;         // mass over filled volume; 0 in void
    std::vector<double> pressure;        // mean by volume; 0 in void
    std::vector<int> material;           // the one with most volume; -1: void has most
  } cells;

  struct Pairs
  {
    std::vector<long long> cell; // global
    std::vector<int> material;
    std::vector<long long> offset{0}; // of the filled region's vertices, pairs + 1
    std::vector<double> vertex;       // (vertices, 2), counter-clockwise
    std::vector<double> volume_fraction;
    std::vector<double> density;         // mass over geometric volume
    std::vector<double> pressure;        // equation of state
    std::vector<double> internal_energy; // per mass
    std::vector<double> plastic_strain;
    std::vector<double> deviator;  // (pairs, 3): xx, yy, xy
    std::vector<double> von_mises; // sqrt(3/2 s:s)
    std::vector<double> velocity;  // (pairs, 3), mean of its four dof nodes
    bool has_damage = false;
    std::vector<double> damage; // where the run tracks it, else empty: 0 sound .. 1 failed
  } pairs;

  /// Edges where two materials face each other (a < b), and free surfaces (b = -1).
  struct Interface
  {
    std::vector<long long> cell; // global, of side a
    std::vector<int> material_a, material_b;
    std::vector<double> vertex; // (segments, 4): x0, y0, x1, y1; a lies to the left
  } interface;
};

/// Copy the owned part of a state to the host.
///
/// \param regions   Of these pairs.
/// \param materials By material number; pressure = EOS(sv, e), zero for rigid ones.
/// Needs one halo layer: interfaces on cell faces look at the neighbour.
FieldSnapshot takeSnapshot(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                           PairState const &state, FilledRegions const &regions, View<Material *> const &materials);

} // namespace Harmos

#endif
