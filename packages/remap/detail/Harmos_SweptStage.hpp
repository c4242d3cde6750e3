// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SWEPT_STAGE_HPP
#define HARMOS_SWEPT_STAGE_HPP

#include <detail/Harmos_RemapClasses.hpp>

#include <vector>

namespace Harmos
{
namespace RemapDetail
{

/// Fluxes and stage records hold the fields of a record, with these two in place of mass and volume fraction.
enum StageField : int
{
  DensityField = 0, // fluxes: mass
  KineticField = 1  // kinetic energy per mass, where it is carried
};

/// Columns of SweptWindow::cell.
enum SweptCell : int
{
  MovedVolume = 0, // of the cell with all its nodes at x'
  CentroidX = 1,
  CentroidY = 2,
  MovedDensity = 3,
  SweptVolume = 4 // of the faces 0..3, positive out of the cell
};

/// What the kernels of stage 1 hand to one another. Cells share rows: cell c uses row c & mask, for as long as it is
/// needed (SweptChunks), so that the arrays stay in the cache.
struct SweptWindow
{
  int mask = 0;
  View<double *[8]> cell;          // SweptCell
  View<double *[8]> face_centroid; // x, y of the faces' swept centroids, from the cell's
  View<double *[4][8]> flux;       // outgoing fluxes of the faces
  View<double *[8]> increment;     // momentum gained by the corners

  KOKKOS_INLINE_FUNCTION int row(int of_cell) const { return of_cell & mask; }
};

/// Order of stage 1: cells in chunks, so large that face neighbours are at most one chunk apart. While the geometry of
/// chunk t is computed, fluxes follow in t - 1 and the new records in t - 2; then come the nodes whose cells all have
/// theirs. Four chunks of rows are in use at a time. Devices take all cells as one chunk.
struct SweptChunks
{
  int chunk = 0; // cells, a power of two
  int count = 0;
  std::vector<int> node_end; // count: nodes below have no cell beyond the chunk
};

SweptChunks sweptChunks(Mesh const &mesh);

/// Rows for the chunks; `carries`: fluxes hold kinetic energy.
SweptWindow sweptWindow(SweptChunks const &chunks);

/// Input and output of stage 1.
struct SweptStage
{
  Input in;
  Classes classes;
  SweptWindow window;
  View<double *> kinetic;                  // num_pairs: kinetic energy per mass before; extent 0: not carried
  View<double *[num_pair_fields]> record1; // num_pairs: records after stage 1, a copy where nothing flows
  View<double *> kinetic1;                 // after; extent as `kinetic`
  View<double *[2]> velocity1;             // dof nodes

  KOKKOS_INLINE_FUNCTION bool carries() const { return kinetic.extent(0) > 0; }
};

/// Sums over owned cells and nodes.
struct SweptSums
{
  double kinetic_before = 0.0; // of the pure cells
  double kinetic_after = 0.0;  // of the final nodes
  Vector2 wall_impulse = {0.0, 0.0};
};

/// Moved volume, centroid and density of the pure cells, and the volumes that their faces sweep on the way back.
///
/// Only swept nodes go back, by u = dt v; face k with ends a, b sweeps (u_a + u_b)/2 x E out of the cell, E the edge
/// at mid-step: both cells see the same number with opposite signs, and the four add up to the change of area exactly.
void sweptGeometry(SweptStage const &stage, int begin, int end);

/// Fluxes of the faces through which cells lose material: a limited linear polynomial per cell at the swept centroids.
/// Density and deviator are weighted by volume; the primitives by mass, with the face's mass flux.
///
/// One scalar limiter a field and cell keeps the values at all outgoing faces, and the mean of what stays in the cell,
/// within the range of the cell and its face neighbours: so the new values are means of values within range.
void sweptFluxes(SweptStage const &stage, int begin, int end);

/// Records after stage 1, and the momentum that corners gain from the others of their cell by dual mass fluxes.
///
/// With F_k the mass that leaves through face k: (F1 - F3)/4 flows along 0->1 and 3->2, (F2 - F0)/4 along 0->3 and
/// 1->2. The upwind velocity is limited (monotonised central). \return Kinetic energy before, of the pure owned cells.
double sweptGather(SweptStage const &stage, int begin, int end);

/// Velocities after stage 1: v + sum of increments / new nodal mass, summed over the cells around. Node conditions are
/// imposed where the node is final (no interface cell around) and has moved.
void sweptNodes(SweptStage const &stage, int begin, int end, SweptSums &sums);

/// All of stage 1.
SweptSums sweep(SweptStage const &stage, SweptChunks const &chunks);

} // namespace RemapDetail
} // namespace Harmos

#endif
