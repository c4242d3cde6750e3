// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LAGRANGE_HPP
#define HARMOS_LAGRANGE_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_CutGradients.hpp>
#include <Harmos_Material.hpp>

#include <vector>

namespace Harmos
{

/// How the materials of a mixed cell of kinematics `single` share the cell's change of volume.
enum class Closure
{
  EqualStrain,
  Compressibility // closeMixedCells
};

struct LagrangeOptions
{
  CutCellStress cut_cell_stress = CutCellStress::FullCells;
  double shortest_bent_edge = 0.1; // of the cell size; that of bendOf
  Closure closure = Closure::EqualStrain;
  double linear_viscosity = 0.06;
  double quadratic_viscosity = 1.2;
  double hourglass_viscosity = 0.05; // Flanagan-Belytschko, viscous; 0.25 is critical at Courant 1, 0.5 unstable
  double subzonal_pressure = 0.05;   // lagrangian: merit of addSubzonalForces
  Vector2 gravity = {0.0, 0.0};      // [m/s^2]
  double courant = 0.5;
  double largest_travel = 0.45; // dt |v| over the smallest altitude of the cells around
  double light_node = 1e-3;     // dof nodes lighter than this part of a full one do not set the time step
  double energy_lag = 0.0;      // [s] of internal energies behind specific volumes; the cycle sets it to half a step
  double kick = 0.0;            // [s] of predictVelocities, which bounds the viscosity of cut cells; 0: no bound
};

/// Nodes that follow pieces of the cells (nodeEnds), of the mesh with these rows.
struct MeshPieces
{
  View<int *> of; // mesh.node_cell.offset
  int cells = 0;  // a piece
  std::vector<int> node_end;
};

/// Work arrays of one Lagrangian step. Their extents may exceed the numbers of pairs and dof nodes (prepareWork).
struct LagrangeWork
{
  View<double *[8]> corner_force; // num_pairs: fx, fy of corners 0..3, time level n [N/m]
  View<double *> dof_mass;        // num_dof_nodes [kg/m]
  View<double *[2]> predicted;    // num_dof_nodes: v* = v^{n-1/2} + kick a^n, node conditions applied
  View<double *[2]> half;         // num_dof_nodes: v^{n+1/2}, after the constraints; `constrained`, or `predicted`
  View<double *[2]> constrained;  // itself where nothing has changed that
  View<double *> node_altitude;   // num_nodes: least altitude of the cells around [length]
  double largest_cell = 0.0;      // volume; with the altitudes
  View<double *> largest_density; // by material, at the start: ten times that bounds what limitTravel takes for light;
                                  // extent 0: the laws' reference densities
  CutGradients cut;               // of this time's filled regions; empty: no cut cell is told from a pure one
  View<double *> gradient_square; // by row of cut: largest eigenvalue of sum_I B_I B_I^T [1/length^2]
  View<double *[3]> before;       // num_pairs, BeforeField: what failPairs needs of time n
  bool keeps_pressure = false;    // whether computeCornerForces writes:
  View<double *[3]> pressure;     // num_pairs, of fluids: p, without lag and viscosity [Pa]; volume m sv; mass
  MeshPieces pieces;              // of computeForcesAndPredict
  View<double *[8]> lumped;       // of locateCutFluids, for addLumpedForces
};

/// Columns of LagrangeWork::before.
enum BeforeField : int
{
  BeforeSpecificVolume = 0,
  BeforePlasticStrain = 1,
  BeforeBearing = 2 // part of the strain that met the forces: void takes the rest
};

/// Largest stable time step and the pair that sets it.
struct TimeStepLimit
{
  double dt = 0.0;
  int cell = -1; // local; -1: none
  int material = -1;
};

/// Sums over owned nodes of one prediction.
struct PredictionSums
{
  Vector2 wall_impulse = {0.0, 0.0}; // by node conditions on the bodies, sum m (v_bc - v_unconstrained) [N s/m]
  double wall_work = 0.0;            // that impulse . v_mean, v_mean with the predicted velocity [J/m]
  Vector2 gravity_impulse = {0.0, 0.0};
  double gravity_work = 0.0; // sum m g kick . v_mean with the predicted velocity: constraints add kick g . J / 2,
                             // J their external impulse [J/m]
  Vector2 driven_impulse = {0.0, 0.0}; // single: by which rigid materials hold shared nodes [N s/m]
  double driven_work = 0.0;            // that impulse . velocity [J/m]
};

/// First trouble of a Lagrangian update.
struct UpdateReport
{
  long long inverted = 0;     // owned pairs whose moved cell has a non-positive corner area
  long long not_a_number = 0; // owned pairs with a NaN, a negative mass or a non-positive specific volume
  long long out_of_range = 0; // owned pairs past the equation of state's range (eosInRange)
  int cell = -1;              // the first inverted or not-a-number one (lowest local number), with its material
  int material = -1;
  int range_cell = -1; // the first one out of range
  int range_material = -1;
  double range_energy = 0.0; // its specific internal energy [energy/mass]
  double range_mass = 0.0;
};

/// What limitTravel found and did.
struct TravelReport
{
  long long limited = 0;      // owned light dof nodes that were slowed to their pair's mean velocity
  double largest_ratio = 0.0; // afterwards: largest dt |v| / (0.9 altitude), 2 where a cell folds; > 1: repeat, dt / 2
  Vector2 wall_impulse = {0.0, 0.0}; // taken by node conditions in doing so
  double energy_loss = 0.0;          // kinetic energy removed; the ledger counts it as contact loss [J/m]
};

/// Totals over the owned nodes at one velocity (deformable materials: rigid ones have no nodal mass).
struct KineticSums
{
  double mass = 0.0;
  Vector2 momentum = {0.0, 0.0};
  double angular_momentum = 0.0; // about the origin
  double kinetic_energy = 0.0;
};

/// Columns of MaterialSums.
enum MaterialSum : int
{
  SumMass = 0,
  SumVolume, // geometric: volume fraction * cell volume
  SumMomentumX,
  SumMomentumY,
  SumAngularMomentum, // about the origin
  SumKineticEnergy,   // sum over corners of share * mass |v|^2 / 2 (mesh.corner_share)
  SumInternalEnergy,
  PlasticStrainMax,
  num_material_sums
};

/// (materials, num_material_sums), over owned pairs, rigid ones included.
using MaterialSums = Kokkos::View<double **, Kokkos::LayoutRight, Kokkos::HostSpace>;

/// Size the work arrays for a set of pairs and dof nodes; grows only, contents are lost where it grows.
void prepareWork(CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes, LagrangeWork &work);

/// Least altitude of the cells around each node -> work.node_altitude, and the largest volume of a cell ->
/// work.largest_cell; once, and whenever the nodes have moved.
void computeNodeAltitudes(Mesh const &mesh, LagrangeWork &work);

/// Lumped mass of the dof nodes: each deformable pair's mass goes to its four by mesh.corner_share (planar a quarter,
/// axisymmetric the integral of r N_I dA over that of r dA), gathered in the order of mesh.node_cell. Rigid materials
/// give none. predictVelocities does the same on its way.
void computeDofMass(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                    PairState const &state, View<Material *> const &materials, LagrangeWork &work);

/// Corner forces of all deformable pairs (on the nodes) -> work.corner_force; rigid pairs: zero.
///
/// f_I = - m sv (s - (p* + q) 1) B_I + hourglass, B_I the mean-quadrature gradient of the whole cell at x^n.
/// Axisymmetric (x = r, y = z, per radian): V B_I = integral of r grad N_I dA, and the hoop stress acts on the integral
/// of N_I dA in addition (detail/Harmos_RingQuadrature.hpp): f_I . v_I sums to - m sv sigma : D, tr D = V'/V.
/// Viscosity in compression (theta = tr D < 0, at v^{n-1/2}): q = rho (c1 c L |theta| + c2 L^2 theta^2), L^2 the cell's
/// area, c the longitudinal sound speed. In cut cells of `xfem` theta is that of what the pair fills, and L its extent
/// along the strongest compression (over its cell's, CutGradients::lost_extent): the velocities of the two sides of a
/// film differ by theta times its thickness, however fast its nodes, a cell apart, move. And q is at most what
/// reverses theta within `kick` of the nodes' masses from this pair alone,
///
///   q <= 2 rho |theta| / (kick sum_I |B_I|^2 / s_I), s_I the corners' shares,
///
/// so that m kick (q / rho) B B^T / |theta| <= 2 diag(m s_I), in sum twice the masses: viscosity takes no more kinetic
/// energy out than there is, and never cools (decision 0048; about an axis B_r counts as in the plane, by up to a
/// quarter less in the first column). p* = p - max(p, 0) min(Gamma theta energy_lag, 1/2),
/// theta of either sign: the internal energy lags half a step (decision 0009). p = 0 in tension that the pair cannot
/// bear: any where it has failed, beyond its spall strength elsewhere (decision 0006). Hourglass: f_I = - C gamma_I
/// (sum_J gamma_J v_J), C = kappa m c / (4 L), gamma_I = Gamma_I - (sum_J Gamma_J x_J) . B_I, Gamma = (1, -1, 1, -1):
/// orthogonal to linear fields. Flanagan & Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706; VonNeumann &
/// Richtmyer, J. Appl. Phys. 21 (1950) 232; Landshoff, LA-1930 (1955).
void computeCornerForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                         View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork &work);

/// v* = v^{n-1/2} + kick (f / m + g), node conditions applied -> work.predicted; lumped mass -> work.dof_mass.
///
/// \param kick From v^{n-1/2} to v^{n+1/2}: half the last cycle's dt and half of this one's, in the first cycle half of
///             its own, for its velocities are those of t = 0. [s]
/// A dof node that a rigid material moves (its own one; where all materials share it, any around it) keeps its
/// velocity. \return Sums over owned nodes.
PredictionSums predictVelocities(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                                 PairState const &state, BoundaryConditions const &boundary,
                                 View<Material *> const &materials, LagrangeOptions const &options, double kick,
                                 LagrangeWork &work);

/// computeCornerForces and predictVelocities in one, to the bit: piece by piece of the cells, with the nodes all of
/// whose cells have forces, while those are in the cache. Sums are added piece by piece.
PredictionSums computeForcesAndPredict(Mesh const &mesh, CellMaterialPairs const &pairs,
                                       NodeMaterialPairs const &dof_nodes, PairState const &state,
                                       BoundaryConditions const &boundary, View<Material *> const &materials,
                                       LagrangeOptions const &options, double kick, LagrangeWork &work);

/// Keep every dof node within 0.9 of the least altitude of the cells around: dt |v_half| <= 0.9 altitude.
///
/// A light dof node (below options.light_node of a full one) that would not, or that would within the step move by more
/// than a quarter of that altitude against the mean of the heaviest pair around it, takes that mean velocity; the
/// pair's other nodes take up the difference of momentum. (A splinter between two bodies that close would otherwise be
/// flung out and heated without bound by nodes which are a whole cell apart.) A heavy one is reported by the largest
/// ratio. Where nothing is wrong (nearly always) one pass over the dof nodes is all. Uses work.node_altitude, dof_mass,
/// predicted.
TravelReport limitTravel(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                         PairState const &state, BoundaryConditions const &boundary, View<Material *> const &materials,
                         LagrangeOptions const &options, double dt, LagrangeWork &work);

/// Compressibility-weighted closure of the mixed cells of kinematics `single`: what makes updatePairs, which strains
/// all materials of a cell alike, strain each as it should. To be called before it; needs work.half.
///
/// The cell's area goes from A to A' = A (1 + theta). Materials with volumes V_m = f_m A and moduli K_m = rho c^2 take
/// dV_m = V_m eps_m, sum dV_m + dV_void = A' - A (rigid materials keep their part of the cell), where
///  - with void, eps_m first brings the pressures towards zero (p_m of the sign of theta), then the void takes all
///  until
///    it has gone;
///  - what is left, and all of it without void, is shared as eps_m ~ 1 / K_m, |eps_m| <= max(0.2, |theta|).
/// sv and f are scaled by (1 + eps_m) / (1 + theta), so that the update leaves sv (1 + eps_m) and the moved regions
/// fill f A' = V_m (1 + eps_m): the regions must be refilled for the remap. Energy: each material does its
/// own work, m de += p m sv (theta - eps_m), the sum of which is taken from all alike by mass: the cell's energy is
/// kept. Benson, Comput. Methods Appl. Mech. Engrg. 99 (1992) 235-394; Kamm, Shashkov, Fung, Harrison & Canfield, Int.
/// J. Numer. Meth. Fluids (2010), doi 10.1002/fld.2354.
void closeMixedCells(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                     View<Material *> const &materials, double dt, LagrangeWork const &work);

/// Advance the records of the deformable pairs to t^{n+1}, in place, with v_half = work.half and
/// v_mean = (state.velocity + v_half) / 2:
/// m (e' - e) = - kick sum_I f_I . v_mean_I; sv' = sv A'/A; strain and spin from the mean-quadrature gradient at
/// mid-step; deviator rotated (Hughes-Winget), 2 G dev(D) dt added, returned to the yield surface (strainedDeviator),
/// whose temperature and pressure are those of sv', e'.
///
/// \param next The stable step of the new state, as stableTimeStep at v_half and x'.
/// \param kick As of predictVelocities: the work is that of the impulses kick f. [s]
UpdateReport updatePairs(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                         View<Material *> const &materials, LagrangeOptions const &options, double dt, double kick,
                         LagrangeWork const &work, TimeStepLimit &next);

/// Specific volume and plastic strain of time n -> work.before, for failPairs; nothing where no damage is tracked.
void keepForFailure(CellMaterialPairs const &pairs, PairState const &state, LagrangeWork &work);

/// What failPairs did.
struct FailureReport
{
  long long failed = 0;           // owned pairs that failed in this step
  bool fractions_changed = false; // of some cell on this rank: its regions must be refilled before the remap
};

/// After updatePairs: the damage of the pairs whose law can fail (damageAfter), and what failed pairs do. They have
/// no deviator, and no tension: where p(sv, e) < 0 the pair takes the volume at which p = 0, and its fraction falls by
/// the same factor: void opens. Mass, momentum and energy of the pair stay (what elastic energy it had is heat). When
/// it is compressed, void in its cell closes first, without work: of A'/A the pair takes (A'/A)^b, b the part of the
/// compression that computeCornerForces let its pressure meet (BeforeBearing). A pure cell that opens becomes mixed.
/// Where its cell has void a failed pair fills what its mass takes up, f V' = m sv, as far as others leave room.
///
/// \param pairs cell_kind comes in a new view where kinds change.
/// In `lagrangian` kinematics a cell keeps its region; its volume fraction is then the part that is no void.
FailureReport failPairs(Mesh const &mesh, Kinematics kinematics, CellMaterialPairs &pairs, PairState const &state,
                        View<Material *> const &materials, double dt, LagrangeWork const &work);

/// Largest stable step of the owned pairs at state.velocity and x^n (needs work.dof_mass); ties: the lowest pair.
///
/// dt = courant l / (Q + sqrt(Q^2 + c^2)), Q = (c1 c L + c2 L^2 max(-theta, 0)) / l, l = area / longest mid-line: the
/// altitude of a parallelogram. There the scheme's fastest plane wave has omega = 2 c / l exactly, whatever its
/// direction; and dt <= largest_travel l / |v| over the dof nodes that are not light. Rigid pairs: travel alone.
/// A free fragment of a single square cell without shear stiffness is stable to courant = 0.7 only (omega^2 = 8 c^2 /
/// l^2), on an axis to 0.63 (10 c^2 / l^2).
/// No pair at all: dt = +infinity, cell -1.
TimeStepLimit stableTimeStep(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                             View<Material *> const &materials, LagrangeOptions const &options,
                             LagrangeWork const &work);

/// Largest stable step below `dt` of the owned pairs at edges, at state.velocity: of cut cells whose stress acts over
/// what they fill (work.cut of these regions; empty: none), and, where `courant` is above 0.6, of whole cells with free
/// edges. Where none asks for less than dt: +infinity, cell -1.
///
/// A pair's element frequencies bound the scheme's, whatever parts of its dof nodes' masses M it is given, as long as
/// those of a node sum to one. With parts in proportion to s m S, s the corner's share of the pair's mass m, S the
/// largest eigenvalue of sum_I B_I B_I^T,
///
///   omega^2 <= 4 c^2 lambda, lambda the largest eigenvalue of W = sum_I w_I B_I B_I^T, w_I = <S>_I / (4 s_I S),
///
/// <S>_I the mean of S over what moves with dof node I (by s m), counts waves of one direction: in a full mesh 1 / l^2,
/// as in stableTimeStep. About an axis W has the hoop, H = N / r: W_rr = sum w (B_r^2 + H^2 + 2 (1 - 2 g) B_r H),
/// W_rz = sum w (B_r + (1 - 2 g) H) B_z, g = G / (rho c^2). Where the nodes have no mass of neighbours, motions of two
/// directions meet: lambda + (1 - 2 g) phi (tr W - lambda), phi from 0 in a body to 1 in a fragment of one cell (the
/// mean over the corners, by their parts of tr W, of what its part of M has beyond its part of the volume around;
/// beyond free sides of the mesh there is void; 0 where conditions hold all corners). A step of 1 / (c sqrt(lambda)),
/// with viscosity as in stableTimeStep, is 0.80 to 0.97 of the largest stable one (half planes and discs of 0.3 to 3
/// cells' radius, g = 0, 0.1, 0.29).
///
/// A pair that by this asks for less than dt gets the frequency of its patch: what shares its dof nodes and two more
/// layers of what shares theirs, node conditions and each pair's own stiffness included (stiffer ones count as the pair
/// itself: they are looked at by themselves), by eight turns of a Lanczos iteration. Where edges are free something is
/// added, as far as the term with phi goes: 0.5%, since a motion exactly at its limit grows with the cycles, and, up to
/// 1.1 times the square of a whole cell, at most 0.03 of that for what reaches beyond the patch. dt is then 0 to 1%
/// below the largest stable one. More than 64 pairs or 72 dof nodes: the bound. `courant` plays no part in what is
/// found.
///
/// \param work Overwrites dof_mass where a pair asks for less than dt.
/// Hughes, The Finite Element Method (1987), 9.3: element frequencies bound those of the assembly.
/// Parlett, The Symmetric Eigenvalue Problem (1980), 13: Lanczos.
TimeStepLimit edgeStepLimit(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                            PairState const &state, FilledRegions const &regions, BoundaryConditions const &boundary,
                            View<Material *> const &materials, LagrangeOptions const &options, double dt,
                            LagrangeWork &work);

/// Mass, momentum and kinetic energy of the owned nodes at a velocity (extent >= num_dof_nodes).
KineticSums kineticSums(Mesh const &mesh, NodeMaterialPairs const &dof_nodes, View<double *> const &dof_mass,
                        View<double *[2]> const &velocity);

/// Sums by material over the owned pairs at a velocity. The same bits for any number of threads.
MaterialSums materialSums(Mesh const &mesh, CellMaterialPairs const &pairs,
                          View<double *[num_pair_fields]> const &record, View<double *[2]> const &velocity,
                          int num_materials);

} // namespace Harmos

#endif
