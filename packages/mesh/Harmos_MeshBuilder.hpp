// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MESH_BUILDER_HPP
#define HARMOS_MESH_BUILDER_HPP

#include <Harmos_HostMesh.hpp>
#include <Harmos_Mesh.hpp>

namespace Harmos
{

/// The mesh of a serial run: everything owned, local numbers are global numbers.
/// \throw std::runtime_error as checkHostMesh.
Mesh buildMesh(HostMesh const &whole);

/// The mesh as one rank sees it: its cells and `halo` layers of vertex neighbours, numbered in global order.
///
/// \param owner  Rank of each cell of the whole mesh, >= 0; that there are as many ranks is for startCycle to find. A
///               rank without cells gets an empty mesh.
/// \param halo   Layers, >= 0.
/// A node belongs to the owner of the lowest-numbered cell around it.
/// \throw std::runtime_error as checkHostMesh; faces of the cells that the rank holds alone: others need not throw.
Mesh buildLocalMesh(HostMesh const &whole, std::vector<int> const &owner, int rank, int halo);

/// Cell areas, volumes and corner shares from the node positions (which the caller has moved).
void updateGeometry(Mesh &mesh);

/// The same for a mesh that moves with its material: its corners keep their masses, and so their shares.
void updateVolumes(Mesh &mesh);

/// Lump masses anew: planar a quarter to each corner, axisymmetric by ringShares.
void updateCornerShares(Mesh &mesh);

/// Make (x, y) of a planar mesh (r, z), per radian, or the other way round: new cell volumes.
/// \throw std::runtime_error naming a node with r < 0.
void setGeometry(Mesh &mesh, Geometry geometry);

/// Arrays of one's own for areas, volumes and corner shares, not yet filled: for a copy whose nodes will be elsewhere.
void separateGeometry(Mesh &mesh);

/// Number of owned cells with a corner that is not strictly convex (or not a number).
int countInvertedCells(Mesh const &mesh);

/// Check geometry and connectivity of a local mesh.
/// \throw std::runtime_error naming the (global) cell or node and the table that is wrong.
void checkMesh(Mesh const &mesh);

} // namespace Harmos

#endif
