// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BLOCK_MESH_HPP
#define HARMOS_BLOCK_MESH_HPP

#include "Harmos_Setup.hpp"

#include <vector>

namespace Harmos
{

/// Contact walls of kinematics lagrangian, in the order of the sides: each is a rigid material after the deck's fields.
std::vector<int> wallSides(Deck const &deck);

/// What a contact wall of kinematics lagrangian fills: the outline of its rigid cells.
Shape wallShape(Deck const &deck, int side);

/// The body-fitted mesh of a deck: a block for each body, the physical surfaces of its Gmsh file for mesh parts, rigid
/// cells behind contact walls. Bodies share no nodes, parts of one field do. Faces of blocks on the domain's sides are
/// boundaries there, edges of a file by the name of their physical curve.
/// \throw DeckError, std::runtime_error: a block or the file is wrong.
DeckMesh makeBlockMesh(Deck const &deck);

} // namespace Harmos

#endif
