// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_HPP
#define HARMOS_REMAP_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_Exchange.hpp>
#include <Harmos_FilledRegions.hpp>
#include <Harmos_Material.hpp>

#include <memory>

namespace Harmos
{

/// What bounds the gradients (doc/theory/remap.md).
enum class RemapLimiter : int
{
  Range = 0,       // no value that is remapped leaves the range of the donor and its neighbours; by intersection,
                   // velocities of solids go as far beyond it as they are linear around (decision 0040)
  RangeInside = 1, // at the mesh's boundary that goes on to the mirrored value of the cell opposite (decision 0011);
                   // the default of decks
  VanLeer = 2,     // halfway to each neighbour beyond a face, between the two values; overshoots in two dimensions
  None = 3
};

/// Gradients and Hessians of the third order.
enum class RemapHessian : int
{
  LeastSquares = 0, // a fit that is exact for quadratics
  Contour = 1       // contour integrals (Dukowicz & Kodis 1987): of less order on irregular meshes
};

struct RemapOptions
{
  int order = 2; // 1, 2, 3; momentum in swept regions at most 2
  RemapLimiter limiter = RemapLimiter::Range;
  RemapHessian hessian = RemapHessian::LeastSquares; // order 3
  double merge_below = 1e-6;      // fragments below this volume fraction merge with same-material neighbours; 0: never
  double close_void_below = 1e-8; // spurious void below this part of a cell, with no void around, is closed
  double close_void_beside_gas = 0.01; // void below this part of a cell (and a tenth of the gas there) that a gas
                                       // fills, which gives way to overlaps too and does the work of both, where
                                       // it meets other materials or contact walls; 0: never
  double cool_gas_below = 0.1; // gas that fills less than this part of a cell is no warmer than twice what is around or
                               // was there at the start (start_energy); the rest heats liquids and solids of the cell
  View<double *> start_energy; // by material: internal energy per mass of its warmest body [J/kg]; none: energy0
  bool swept_faces = true;     // pure regions by swept faces; false: intersection everywhere
  bool return_kinetic_defect = false; // kinetic energy lost by the remap becomes internal energy, pair by pair; not
                                      // where damage is tracked, which is carried in its place
  bool mirrored_walls = false; // fields go on beyond slip walls as their mirror images (gradients, ranges): of scenes.
                               // Without it they end there, and linear ones are exact
  double shortest_bent_edge = 0.1; // of the cell size; edges inside cells below it stay straight (bendOf)
  bool part_overlaps = true;       // what moved regions of bodies that pass each other have in common is divided
  bool measure_overlap = false;    // RemapReport::moved_overlap, remapped_overlap; changes nothing else
};

/// What the moved regions of different materials have in common, polygon by polygon and whatever void is left beside
/// them: every two regions once, of the same cell and of others, rigid bodies' filled regions included. Of all ranks;
/// what lies outside of the mesh does not count.
struct MovedOverlap
{
  double volume = 0.0;        // sum over the cells [length^2, or per radian length^3]
  double largest = 0.0;       // in any one cell of the target mesh, over its volume [1]
  Vector2 place = {0.0, 0.0}; // centroid of that cell; the lowest where several have as much [length]
};

/// Sums over owned cells of one remap, for the history; with the overlaps, which are of all ranks.
struct RemapReport
{
  double overlap_volume = 0.0; // overlap of moved regions that was scaled away (>= 0) [length^2]
  double void_volume = 0.0;    // spurious void opened and not closed [length^2]
  double closed_volume = 0.0;  // spurious void that was closed
  double gas_work = 0.0;       // by gas on what gave way to it, less what it gave way (RemapOptions::
                               // close_void_beside_gas); its internal energy lacks as much [J/m]
  double gas_heat = 0.0;       // that thin gas gave to what lies beside it (cool_gas_below) [J/m]
  long long merged = 0;        // fragments merged
  long long bounded = 0;       // pairs whose specific volume was bounded by twice the cell's
  double outflow_mass = 0.0, outflow_energy = 0.0; // kinetic + internal, net of inflow
  Vector2 outflow_momentum = {0.0, 0.0};
  Vector2 wall_impulse = {0.0,
                          0.0};  // by node conditions on the bodies when the remapped velocities are projected [N s/m]
  double kinetic_loss = 0.0;     // before - after - outflow, less what became heat
  double returned_heat = 0.0;    // kinetic energy that became internal energy (return_kinetic_defect)
  MovedOverlap moved_overlap;    // as velocities move the regions, in the last remap; zero unless
                                 // RemapOptions::measure_overlap
  MovedOverlap remapped_overlap; // the same after RemapOptions::part_overlaps: of the regions that are remapped
  long long failures = 0;        // owned donors whose overlays do not add up to 1e-10 of their volume
  int first_failed_cell = -1;    // with the material of its first such donor; -1: the cell gets too many materials
  int first_failed_material = -1;
};

/// What the remap makes: the next cycle's pairs, dof nodes and state.
struct RemapResult
{
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
};

/// The rigid bodies' exact share of the cells at their new pose: compressed rows over cells, materials ascending.
struct RigidRows
{
  View<int *> offset; // num_cells + 1; extent 0: no rigid bodies
  View<int *> material;
  View<double *> volume_fraction; // > 0, of the cell
  View<double *[2]> centroid;     // of the body's part of the cell [length]
};

namespace RemapDetail
{
struct Kept;
}

/// What a caller may keep from cycle to cycle: work arrays, two of every array that a RemapResult holds, the order of
/// the kernels for a mesh, and the classes of cells for as long as no cell changes. Copies share it.
struct RemapWork
{
  std::shared_ptr<RemapDetail::Kept> kept;
};

/// Remap the moved pairs back to the mesh in two stages (doc/decisions/0002): swept faces where all is pure and of one
/// material, exact intersection elsewhere. Conserves mass, momentum and internal energy to round-off.
///
/// \param mesh        The target mesh. Runs over all local cells.
/// \param kinematics  Xfem or Single.
/// \param pairs, dof_nodes  Of time n.
/// \param state       Records after the Lagrangian update (volume fractions of time n), centroids of time n; velocity
///                    is not read.
/// \param regions     Filled regions at time n.
/// \param half        v^{n+1/2} of all dof nodes: moves the regions by dt half, and is remapped itself.
/// \param rigid       Rigid bodies at their new pose. Rigid materials are never donors; their pairs are built anew
///                    from these rows (mass density0 * volume) and their dof velocities are zero.
/// \param report      Sums of owned cells, added to what it holds.
/// \param start       Node positions where the motion began, when that is another mesh of the same connectivity
///                    (regions and centroids belong to it, rigid rows to `mesh`); extent 0: it began on `mesh`. Moved
///                    nodes (start + dt half) stay within the cells around their node of `mesh`; boundary nodes may
///                    slide along straight slip or fixed walls, others stay. Throws where one does not.
/// \param exchange    Between the ranks: RangeInside needs the fields' ranges on all of them.
/// \return Pairs, dof nodes and state of time n+1, right on owned cells and on the nodes around them where the input is
///         right to depth 7 (5 without merging; doc/decisions/0003). Where no cell changes its set of materials, rows
///         and dof nodes are shared with the input.
///
/// Swept fluxes: Margolin & Shashkov, J. Comput. Phys. 184 (2003) 266-298; intersection: Dukowicz & Kodis, SIAM J. Sci.
/// Stat. Comput. 8 (1987) 305-321; half-index shift: Benson, Comput. Methods Appl. Mech. Engrg. 99 (1992) 235-394.
RemapResult remap(Mesh const &mesh, Kinematics kinematics, CellMaterialPairs const &pairs,
                  NodeMaterialPairs const &dof_nodes, PairState const &state, FilledRegions const &regions,
                  BoundaryConditions const &conditions, View<Material *> const &materials,
                  View<double *[2]> const &half, double dt, RigidRows const &rigid, RemapOptions const &options,
                  RemapReport &report);

/// The same with work arrays that live longer than one call.
RemapResult remap(Mesh const &mesh, Kinematics kinematics, CellMaterialPairs const &pairs,
                  NodeMaterialPairs const &dof_nodes, PairState const &state, FilledRegions const &regions,
                  BoundaryConditions const &conditions, View<Material *> const &materials,
                  View<double *[2]> const &half, double dt, RigidRows const &rigid, RemapOptions const &options,
                  RemapReport &report, RemapWork &work, View<double *[2]> const &start = {},
                  Exchange const &exchange = {});

/// The largest part of its moved volume that a pure cell gives away through its faces: their swept
/// volumes out of it over it. Above 1 (nodes that move along the cells' diagonals by more than half of them) swept
/// faces leave the range of the donors and amplify noise: the caller repeats the step with a smaller one. Owned cells
/// of this rank; arguments as of `remap`. \return [1], 0 where no cell is pure.
double largestSweptPart(Mesh const &mesh, CellMaterialPairs const &pairs, View<double *[2]> const &half, double dt,
                        View<double *[2]> const &start = {});

} // namespace Harmos

#endif
