// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_HOST_MESH_HPP
#define HARMOS_HOST_MESH_HPP

#include <array>
#include <vector>

namespace Harmos
{

/// A whole mesh of bilinear quadrilaterals on the host: what generators make and partitioners read.
///
/// Every rank holds the whole of it while it sets up; Harmos_MeshBuilder.hpp makes the local meshes from it.
struct HostMesh
{
  std::vector<std::array<double, 2>> node;       // positions [length]
  std::vector<std::array<int, 4>> cell;          // nodes, counter-clockwise; face k joins nodes k and (k + 1) % 4
  std::vector<std::array<int, 4>> face_boundary; // boundary number of each face, -1: inside or free
};

/// Which cells touch each node: compressed rows over nodes, items 4 * cell + corner, ascending.
struct HostRows
{
  std::vector<int> offset; // rows + 1
  std::vector<int> item;
};

/// Cells around the nodes of a whole mesh.
HostRows cellsAroundNodes(HostMesh const &mesh);

/// The face (4 * cell + face number) on the other side of a cell's face, or -1.
int oppositeFace(HostMesh const &mesh, HostRows const &node_cell, int cell, int face);

/// \throw std::runtime_error naming the cell: a node number out of range, a corner that is not strictly convex
///        (so that the area is positive), a face that more than two cells or two of the same orientation share, a
///        boundary number on an inner face or below -1, arrays of different lengths; or the node that no cell touches.
void checkHostMesh(HostMesh const &mesh);

/// Two cells of different bodies that lie in each other by more than `part` of the smaller one's shortest side; {-1,
/// -1} where there are none. Sides that bend are chords in cells: bodies that fit along an arc overlap by their
/// sagittas.
///
/// \param body By cell.
/// Separating edges of convex polygons: Gottschalk, Lin & Manocha, Proc. SIGGRAPH 1996, 171-180.
std::array<int, 2> overlappingCells(HostMesh const &mesh, std::vector<int> const &body, double part);

/// Its two parts: arrays, node numbers and corners, without which cellsAroundNodes cannot be made; and a cell's faces.
void checkCells(HostMesh const &mesh);
void checkFaces(HostMesh const &mesh, HostRows const &node_cell, int cell);

/// Cells between coordinate lines, numbered row by row from the lower left.
///
/// \param x, y  Strictly ascending, two or more values each. [length]
/// Boundary numbers: 0 left (least x), 1 right, 2 bottom (least y), 3 top. \throw std::runtime_error
HostMesh rectilinearMesh(std::vector<double> const &x, std::vector<double> const &y);

/// The same with inner nodes moved at random: each coordinate by up to `jitter` of the smaller cell beside the line,
/// equally likely. Cells stay convex, and no node moves out of the cells around where it was.
///
/// \param jitter  In [0, 0.25). \param seed Of std::mt19937: the same mesh on every machine. \throw std::runtime_error
HostMesh jitteredMesh(std::vector<double> const &x, std::vector<double> const &y, double jitter, unsigned seed);

/// cells + 1 coordinates in geometric progression: h_{i+1} = h_i ratio^(1 / (cells - 1)).
///
/// \param ratio  Last over first cell size, > 0; 1 is uniform. Both ends are exact. \throw std::runtime_error
std::vector<double> gradedCoordinates(double from, double to, int cells, double ratio);

using Corner = std::array<double, 2>;

/// A quadrilateral to be meshed. Straight sides: bilinearly, x(xi, eta) = sum N_I(xi, eta) corner_I; else by
/// transfinite interpolation of the sides c_0 (corner 0 -> 1), c_1 (1 -> 2), c_2 (3 -> 2), c_3 (0 -> 3): x = (1 - eta)
/// c_0(xi) + eta c_2(xi) + (1 - xi) c_3(eta) + xi c_1(eta) - sum N_I corner_I. Gordon & Hall, Int. J. Numer. Meth.
/// Engng 7 (1973) 461-477.
struct MappedBlock
{
  std::array<Corner, 4> corner;             // counter-clockwise, strictly convex [length]
  std::array<int, 2> cells;                 // along corner 0 -> 1 and along corner 0 -> 3
  std::array<double, 2> grading = {1., 1.}; // last cell over first, likewise (gradedCoordinates)
  // radius of the arc from corner k to k + 1: 0 straight, positive bulging outwards, negative inwards; at least half
  // of the chord [length]
  std::array<double, 4> arc_radius = {0., 0., 0., 0.};
};

struct BlockMesh
{
  HostMesh mesh;
  std::vector<int> cell_block; // number of each cell's block
};

/// Structured blocks that share no nodes (body-fitted meshes, kinematics `lagrangian`).
///
/// Cells and nodes are numbered block by block, row-wise within a block. Boundary numbers: 4 * block + side, side 0
/// left (corners 3, 0), 1 right (1, 2), 2 bottom (0, 1), 3 top (2, 3).
/// \throw std::runtime_error where a block is not strictly convex, has no cells, an arc cannot span its side, a cell is
///        not strictly convex, or two blocks of straight sides overlap (touching is allowed).
BlockMesh mappedBlocks(std::vector<MappedBlock> const &blocks);

} // namespace Harmos

#endif
