// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SETUP_HPP
#define HARMOS_SETUP_HPP

#include "Harmos_TimeStep.hpp"

#include <Harmos_Deck.hpp>
#include <Harmos_HostMesh.hpp>
#include <Harmos_Paint.hpp>

namespace Harmos
{

/// The whole mesh of a deck: its rectilinear grid, or the blocks of its bodies (lagrangian).
struct DeckMesh
{
  HostMesh mesh;
  std::vector<int> cell_body; // lagrangian: body of each cell; else empty
};
DeckMesh makeMesh(Deck const &deck);

/// The outline of a body.
Shape makeShape(ShapeSpec const &spec);

/// A body as it is painted at time zero.
Body paintedBody(BodySpec const &spec);

/// Everything that does not change: meshes and `exchange` are given, the rest comes from the deck.
Scene makeScene(Deck const &deck, DeckMesh const &whole, Mesh const &mesh, Exchange const &exchange);

/// Whether some law of the deck can fail, so that pairs carry damage.
bool tracksDamage(Deck const &deck);

/// The state at time zero, before startCycle: painted bodies (or blocks), their velocities. Not collective: what is
/// wrong with the bodies may show on some ranks alone.
CycleState makeInitialState(Deck const &deck, DeckMesh const &whole, Scene const &scene);

} // namespace Harmos

#endif
