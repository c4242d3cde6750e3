// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONSTRAIN_TEST_ROWS_OF_SCENE_HPP
#define HARMOS_CONSTRAIN_TEST_ROWS_OF_SCENE_HPP

#include "TinyScene.hpp"

#include <Harmos_ContactRows.hpp>

namespace HarmosTest
{

/// \param dt The step, in which ends of segments may go through what they face; 0: none do.
inline std::vector<ContactRow> rowsOf(TinyScene const &scene, double dt = 0.0)
{
  InterfaceSegments const s = findInterfaceSegments(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions,
                                                    scene.conditions, Placement::Midpoint);
  SegmentBins const bins = binSegments(s, largestSegment(scene.mesh, s));
  BodyTable bodies = buildBodyTable(scene.bodies_n, static_cast<int>(scene.options.interaction.extent(0)));
  bodies.surfaces = rigidSurfaces(scene.outline);
  ContactRows const rows =
      buildContactRows(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, s, castRays(scene.mesh, s, bins), bins,
                       scene.conditions, bodies, scene.bonds, scene.options, {scene.velocity_n, bodies}, dt);
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.row);
  return std::vector<ContactRow>(host.data(), host.data() + rows.count);
}

} // namespace HarmosTest

#endif
