// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SWEPT_STAGE_HPP
#define HARMOS_SWEPT_STAGE_HPP

#include <Harmos_Pack.hpp>
#include <Harmos_RowPointer.hpp>
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
  KineticField = 1  // damage where that is tracked; else, in stage 2, where asked for: kinetic energy (also by mass)
};

/// Columns of SweptWindow.
enum SweptColumn : int
{
  CentroidX = 0, // of the cell with all its nodes at x'
  CentroidY = 1,
  FieldColumn = 2, // + field: what is remapped, the density that of the moved cell
  MovedVolume = 10,
  OldMass = 11,
  NewMass = 12,
  CornerColumn = 13, // + 2 * corner: x, y of the velocity
  // + 9 * face: the volume that it sweeps out of the cell; the neighbour's is what it sweeps into the cell. With the
  // sign changed where something leaves through the opposite face 0 or 1 as well.
  // + 9 * slot + 1 + field: the outgoing fluxes, where any of the block leaves (LeaveBit); zero in cells where nothing
  // does. As a rule things leave through one of two opposite faces: slot 0 serves the faces 0 and 2, slot 1 serves 1
  // and 3. Where they leave through both, slots 2 and 3 serve the faces 2 and 3 (SecondBit).
  FaceColumn = 21,
  OffsetColumn = 57,              // + 2 * slot: x, y of the swept centroid from the cell's; where and when as fluxes
  IncrementColumn = OffsetColumn, // + 2 * corner: momentum gained by the corners, when the offsets have served
  num_swept_columns = 65
};
constexpr int num_neighbour_columns = 10; // what fluxes need of neighbours: centroid and fields
constexpr int num_face_columns = 9;

/// What stage 1 knows of a block of cells, pack_width of them, as bits.
enum SweptBlock : int
{
  RunBit = 1,           // << k: beyond face k lies a run of cells, all pure and of the material on this side
  LeaveBit = 1 << 4,    // material leaves one of the cells
  SecondBit = 1 << 5,   // << i: and through the opposite face i + 2 as well as i = 0, 1
  BoundaryBit = 1 << 8, // some cell has no neighbour beyond one of its faces
  WholeBit = 1 << 9,    // there are pack_width cells, all pure
  AcrossBit = 1 << 10,  // << k: as RunBit, but the run's rows begin in one tile and end in another
  OwnedBit = 1 << 14    // no pure cell is another rank's
};

/// Rows of a tile of SweptWindow, and what lies between its columns: a row's fall on different sets of the cache.
constexpr int tile_rows = pack_width > 1 ? 128 : 32; // a device's threads keep a column's row for what they gather
constexpr int column_stride = tile_rows + 8;

/// What the kernels of stage 1 hand to one another, column by column, so that packs are loaded and stored whole. Cells
/// share rows: cell c uses row c & mask, for as long as it is needed (SweptChunks), so that all stays in the cache.
/// The rows of a block's other cells repeat a pure one. Tiles of rows have their columns one after the other: in
/// columns of all rows those of a cell lie on more pages of memory than the machine keeps the addresses of.
struct SweptWindow
{
  int mask = 0;
  View<double *> columns;   // of tiles
  View<int *> block;        // SweptBlock, a number for pack_width rows
  View<double *[4]> spread; // order 3: the moved cell's central second moments xx, xy, yy over its volume
};

/// Cells or nodes from `begin` to `end`.
struct SweptRange
{
  int begin = 0, end = 0;
};

/// Order of stage 1: cells in chunks, so large that vertex neighbours are at most one chunk apart. While the geometry
/// of chunk t is computed, fluxes follow in t - 1 and the new records in t - 2; then come the nodes whose cells all
/// have theirs. Four chunks of rows are in use at a time. Devices take all cells as one chunk.
struct SweptChunks
{
  int chunk = 0; // cells, a power of two
  int count = 0;
  std::vector<int> node_end; // count: nodes below have no cell beyond the chunk
  SweptRange all_cells, all_nodes;
  SweptRange within[4]; // where the cells up to k layers from owned ones lie, in whole packs
  SweptRange own_nodes; // where the nodes of owned cells lie
};

SweptChunks sweptChunks(Mesh const &mesh);

/// Rows for the chunks; those of order 3 alone are `spreads`.
SweptWindow sweptWindow(SweptChunks const &chunks);
View<double *[4]> sweptSpreads(SweptChunks const &chunks);

/// `columns` columns of pack_width rows, the first `rows` of them at `begin`, what is left at `rest` in another tile.
/// `joined` and what follows a column of it for pack_width rows are overwritten; columns are column_stride apart.
HARMOS_RARE_FUNCTION inline void joinColumns(double const *begin, double const *rest, int rows, int columns,
                                             double *joined)
{
  for (int c = 0; c < columns; ++c, begin += column_stride, rest += column_stride, joined += column_stride)
  {
    storePack(joined, loadPack(begin)); // reads beyond the tile's rows: the 8 between columns
    storePack(joined + rows, loadPack(rest));
  }
}

/// Kinetic energy that stage 1 loses, where it is asked for; else empty.
///
/// A node of mass m and velocity v gains the masses G_i with velocities v_i (upwind, at the faces between nodes; those
/// below zero it gives away), sum G_i = m' - m, and then has m' v' = m v + sum G_i v_i. With the kinetic energy
/// G_i v_i^2 / 2 of each going from node to node, what is missing at the node is
///   m v^2 / 2 + sum G_i v_i^2 / 2 - m' v'^2 / 2 = sum G_i (v_i - v)^2 / 2 - m' (v' - v)^2 / 2:
/// all nodes together lose just what the kinetic energy falls by, and each what is the same in all frames of reference.
/// (A kinetic energy of the cells, remapped as a field of its own, differs by errors of first order in the velocity's:
/// it lags behind the momentum by another phase. In cold gas they grow to waves.)
struct SweptHeat
{
  View<double *[4]> corner; // cells: sum of G_i (v_i - v)^2 / 2 over the edges within the cell, by corner [J/m]
  View<double *> node;      // dof nodes: what is missing over m' [J/kg]
};

/// Input and output of stage 1, as the kernels see it: many short launches, which Views would have to be copied for.
struct SweptStage
{
  SweptStage(Input const &in, Classes const &classes, SweptWindow const &window, View<double *> const &damage_before,
             View<double *[num_pair_fields]> const &record_after, View<double *> const &damage_after,
             View<double *[2]> const &velocity_after, View<double *[8]> const &corner_after,
             View<double *[2]> const &part_after, SweptHeat const &heat);

  Geometry geometry;
  double dt;
  bool second_order; // or third
  bool third_order;
  RemapLimiter limiter;
  double const *ranges;     // fieldRanges: rows of 32 by material; null unless RangeInside
  Boundary const *boundary; // null: fields end at walls (RemapOptions::mirrored_walls)

  RowPointer<int, 4> cell_node, face_neighbour, face_boundary;
  RowPointer<double, 2> position; // at the start of the motion
  RowPointer<double, 2> target;   // of the mesh
  bool retargeted;                // these are not the same
  int const *node_owned;
  int const *first_item, *item;           // mesh.node_cell
  int const *first_neighbour, *neighbour; // mesh.cell_neighbour
  int const *node_condition;
  NodeCondition const *condition;

  int const *first_pair, *pair_material, *first_dof;
  RowPointer<int, 4> dof_node;
  Material const *materials;
  RowPointer<double, num_pair_fields> record; // before
  RowPointer<double, 4> share;                // axisymmetric: Input::share
  RowPointer<double, 2> half;
  double const *damage; // of the pairs; null: not tracked

  int const *flags, *pure_material, *node_return, *node_final, *node_sweep; // of Classes

  int mask; // of the window, as what follows
  double *columns;
  int *block;
  RowPointer<double, 4> spread;

  RowPointer<double, num_pair_fields> record1; // after; a copy where nothing flows
  RowPointer<double, 2> velocity1;
  RowPointer<double, 8> corner1;  // StageState::corner
  RowPointer<double, 2> own_part; // StageState::own_part
  double *damage1;
  RowPointer<double, 4> corner_heat; // of SweptHeat
  double *node_heat;                 // null: not asked for

  KOKKOS_FORCEINLINE_FUNCTION bool carries() const { return damage != nullptr; }
  KOKKOS_FORCEINLINE_FUNCTION bool returnsHeat() const { return node_heat != nullptr; }
  KOKKOS_FORCEINLINE_FUNCTION double *at(int column, int cell) const
  {
    unsigned const row = static_cast<unsigned>(cell & mask);
    constexpr std::ptrdiff_t tile = num_swept_columns * column_stride;
    return columns + (row / tile_rows) * tile + (row % tile_rows) + column * column_stride;
  }
  /// Whether the rows of the cells that a pack begins with `cell` are one after the other.
  KOKKOS_FORCEINLINE_FUNCTION static bool inTile(int cell)
  {
    return (cell & (tile_rows - 1)) + pack_width <= tile_rows;
  }
  /// Rows from a cell's on to the end of its tile.
  KOKKOS_FORCEINLINE_FUNCTION static int rowsLeft(int cell) { return tile_rows - (cell & (tile_rows - 1)); }
  KOKKOS_FORCEINLINE_FUNCTION int &blockOf(int cell) const { return block[(cell & mask) / pack_width]; }
  /// Whether the mesh ends at a face of a pure cell, and the limiter minds it.
  KOKKOS_FORCEINLINE_FUNCTION bool endsAt(int c, int face) const
  {
    return ranges != nullptr && pure_material[c] >= 0 && (flags[c] & NeighbourBit << face) == 0;
  }
  /// Whether the fields go on beyond a face as their mirror image: it is on a straight slip wall. A node that is free
  /// to slip along it has its normal alone. \param[out] normal Unit; out of the mesh.
  KOKKOS_INLINE_FUNCTION bool mirrorsAt(int cell, int face, Vector2 &normal) const
  {
    int const number = boundary == nullptr ? -1 : face_boundary(cell, face);
    if (number < 0 || face_neighbour(cell, face) >= 0 || boundary[number].kind != BoundaryKind::SlipWall)
      return false;
    int const a = cell_node(cell, face), b = cell_node(cell, (face + 1) & 3);
    Vector2 const along = normalised(Vector2{position(b, 0) - position(a, 0), position(b, 1) - position(a, 1)});
    normal = {along[1], -along[0]};
    for (int node : {a, b})
    {
      if (node_condition[node] < 0)
        return false;
      NodeCondition const &wall = condition[node_condition[node]];
      if (wall.count == 1 && !(Math::fabs(cross(wall.normal[0], normal)) < 1e-12))
        return false;
    }
    return true;
  }
  /// Rows of fieldRanges for the fields of a record.
  KOKKOS_FORCEINLINE_FUNCTION double const *leastOf(int c) const { return ranges + 32 * pure_material[c]; }
  KOKKOS_FORCEINLINE_FUNCTION double const *largestOf(int c) const { return leastOf(c) + 16; }
  KOKKOS_FORCEINLINE_FUNCTION bool sameBeyond(int cell, int face) const
  {
    return (flags[cell] & SameBeyondBit << face) != 0;
  }
  /// What leaves through a face, and the slot of its fluxes.
  KOKKOS_FORCEINLINE_FUNCTION double sweptOut(int cell, int face) const
  {
    return Math::fabs(*at(FaceColumn + num_face_columns * face, cell));
  }
  KOKKOS_FORCEINLINE_FUNCTION int slotOf(int cell, int face) const
  {
    return face < 2 || *at(FaceColumn + num_face_columns * face, cell) < 0.0 ? face : face - 2;
  }
  KOKKOS_FORCEINLINE_FUNCTION bool aboutAxis() const { return geometry == Geometry::Axisymmetric; }
  /// Four times the part of a cell's mass that a corner takes.
  KOKKOS_FORCEINLINE_FUNCTION double fourShares(int c, int corner) const
  {
    return aboutAxis() ? 4.0 * share(c, corner) : 1.0;
  }
  KOKKOS_FORCEINLINE_FUNCTION bool isRigid(int material) const { return materials[material].rigid_body >= 0; }
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
/// Only swept nodes go back, by u = dt v (to another mesh: x + dt v - y); face k with ends a, b sweeps (u_a + u_b)/2 x
/// E out of the cell, E the edge at mid-step: the four add up to the change of area exactly. Where the edges before and
/// after cross, one triangle goes out and another comes in. First moments are exact too: so is the remap of linear
/// fields. Axisymmetric: all weighted by the radius, as exactly.
void sweptGeometry(SweptStage const &stage, int begin, int end);

/// Fluxes of the faces through which cells lose material: a limited linear polynomial per cell at the swept centroids.
/// Density and deviator are weighted by volume; the primitives by mass, with the face's mass flux.
///
/// What each face takes is brought into the range of the cell and its face neighbours by itself, then all deviations
/// from the cell's mean by one factor so far that the mean of what stays is within it too: so the new values are means
/// of values within range, and a face bounds the others by no more than what it takes (RemapLimiter::Range; RangeInside
/// goes on to mirrored values at the boundary of the mesh; the others bound what their names say).
void sweptFluxes(SweptStage const &stage, int begin, int end);

/// The moved cells' spreads, and fluxes of limited quadratics: fitted over the vertex neighbours of the same material,
/// without the derivatives that those do not determine (QuadraticFit), integrated over the swept areas exactly by
/// volume; by mass to third order: the mass centroid of a part with covariance C is C grad rho / rho from its own.
/// Limited as in sweptFluxes, to the range of the vertex neighbours.
void sweptSpread(SweptStage const &stage, int begin, int end);
void sweptQuadraticFluxes(SweptStage const &stage, int begin, int end);

/// Records after stage 1, and the momentum that corners gain from the others of their cell by dual mass fluxes.
///
/// With F_k the mass that leaves through face k: (F1 - F3)/4 flows along 0->1 and 3->2, (F2 - F0)/4 along 0->3 and
/// 1->2. The upwind velocity is limited (monotonised central). \return Kinetic energy before, of the pure owned cells.
double sweptGather(SweptStage const &stage, int begin, int end);

/// Velocities after stage 1: v + sum of increments / new nodal mass, summed over the cells around. Node conditions are
/// imposed where the node is final (no interface cell around) and has moved. Where it is not final, the velocities of
/// the corners around it too.
void sweptNodes(SweptStage const &stage, int begin, int end, SweptSums &sums);

/// All of stage 1.
///
/// \param owned_alone Only what the velocities of owned cells' nodes depend on: records of one layer around these
///                    cells, fluxes of two, moved cells of three. Elsewhere records and velocities are not set.
SweptSums sweep(SweptStage const &stage, SweptChunks const &chunks, bool owned_alone);

} // namespace RemapDetail
} // namespace Harmos

#endif
