// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CHECK_SCENE_HPP
#define HARMOS_CHECK_SCENE_HPP

#include "Harmos_TimeStep.hpp"

#include <string>
#include <vector>

namespace Harmos
{

/// What a host code can leave out or get wrong in a scene and the state that is to start on it, and kernels would not
/// notice or fall over. \throw std::runtime_error naming the entry, its value and what is expected: the same on all
/// ranks, of the first rank where something is wrong. Collective.
void checkScene(Scene const &scene, CycleState const &state);

/// Its parts, each for this rank alone: nothing in them is collective.
void checkMaterials(std::vector<Material> const &laws);
void checkBodies(Scene const &scene, CycleState const &state, std::vector<Material> const &laws);
void checkBoundaries(Scene const &scene, std::vector<Material> const &laws);
void checkState(Scene const &scene, CycleState const &state);

/// "cell 812 on rank 3": by its global number.
std::string placeOf(char const *what, View<long long *> const &global, int local, Exchange const &exchange);

} // namespace Harmos

#endif
