// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONTACT_STATE_HPP
#define HARMOS_CONTACT_STATE_HPP

#include "Harmos_TimeStep.hpp"

namespace Harmos
{

/// The bonds of the start, each with the tracer of its first material that moves it. Collective.
void placeBonds(Scene const &scene, CycleState &s);

/// Move the bonds with v^{n+1/2} of the materials that carry them. Collective.
void moveBonds(Scene const &scene, CycleState &s, double dt);

/// Cauchy stress xx, yy, xy of the pairs [Pa]; rigid ones have none.
View<double *[3]> pairStress(CycleState const &s, View<Material *> const &materials);

} // namespace Harmos

#endif
