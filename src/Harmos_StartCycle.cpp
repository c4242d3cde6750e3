// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_CheckScene.hpp"
#include "Harmos_PrescribedCycle.hpp"
#include "Harmos_Require.hpp"

#include <Harmos_EquationOfState.hpp>
#include <Harmos_Failure.hpp>
#include <Harmos_FlowStress.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace Harmos
{
namespace
{

/// Density times longitudinal wave speed of the laws' reference states; 0: rigid. [kg/(m^2 s)]
std::vector<double> impedances(std::vector<Material> const &materials)
{
  std::vector<double> result;
  for (Material const &law : materials)
  {
    double const sv = 1.0 / law.density0;
    double const bulk = law.rigid_body >= 0 ? 0.0 : equationOfState(law, sv, law.energy0).sound_speed_squared;
    result.push_back(law.rigid_body >= 0
                         ? 0.0
                         : law.density0 * std::sqrt(longitudinalSoundSpeedSquared(law, bulk, sv, law.energy0)));
  }
  return result;
}

/// By material: the largest density of its law and of the state, on any rank. Collective. [kg/m^3]
std::vector<double> largestDensities(Scene const &scene, CycleState const &s, std::vector<Material> const &laws)
{
  std::vector<double> largest;
  for (Material const &law : laws)
    largest.push_back(law.density0);
  auto const record = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.state.record);
  auto const material = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.pairs.material);
  for (int pair = 0; pair < s.pairs.num_pairs; ++pair)
    if (record(pair, SpecificVolume) > 0.0)
      largest[material(pair)] = std::max(largest[material(pair)], 1.0 / record(pair, SpecificVolume));
  for (double &density : largest)
    density = scene.exchange->max(density);
  return largest;
}

/// Rows balance the stress of what acts over what it fills.
std::vector<ShortSegments> shortSegments(Scene const &scene, std::vector<Material> const &laws)
{
  std::vector<ShortSegments> kept;
  for (Material const &law : laws)
    kept.push_back(!actsOnFilledRegion(scene.lagrange.cut_cell_stress, law) ? ShortSegments::Dropped
                   : actsInFullCells(scene.lagrange.cut_cell_stress, law)   ? ShortSegments::Shared
                                                                            : ShortSegments::Kept);
  return kept;
}

/// 1 for each material whose pressure acts on all of its outline.
std::vector<int> pressingFluids(Scene const &scene, std::vector<Material> const &laws)
{
  std::vector<int> fluid;
  for (Material const &law : laws)
    fluid.push_back(law.strength == StrengthKind::None && actsOnFilledRegion(scene.lagrange.cut_cell_stress, law));
  return fluid;
}

/// By boundary number: 1 where it is a contact wall.
std::vector<int> contactWalls(Scene const &scene)
{
  auto const boundary = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.boundary.boundary);
  std::vector<int> wall;
  for (std::size_t b = 0; b < boundary.extent(0); ++b)
    wall.push_back(boundary(b).kind == BoundaryKind::ContactWall ? 1 : 0);
  return wall;
}

} // namespace

ReconstructionReport startCycle(Scene &scene, CycleState &s)
{
  checkScene(scene, s);
  auto const materials = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.materials);
  std::vector<Material> const laws(materials.data(), materials.data() + materials.extent(0));
  if (scene.constraint.impedance.extent(0) == 0)
  {
    std::vector<double> const z = impedances(laws);
    if (scene.constraint.method == ConstraintMethod::Penalty || scene.constraint.method == ConstraintMethod::Nitsche)
      for (std::size_t m = 0; m < z.size(); ++m)
        detail::require(
            z[m] > 0.0 || laws[m].rigid_body >= 0,
            "scene.constraint.method penalty and nitsche scale with the impedance of the laws' reference states, and "
            "material " +
                std::to_string(m) + " has none there; expected: another method, or scene.constraint.impedance");
    scene.constraint.impedance = deviceCopy("impedance", z);
  }
  // Blocks meet with their sides, which are the outlines but for arcs and parts of a file's mesh.
  scene.constraint.outline_rows = scene.constraint.outline_rows && scene.kinematics != Kinematics::Lagrangian;
  if (scene.constraint.short_segments.extent(0) == 0 && scene.kinematics == Kinematics::Xfem)
    scene.constraint.short_segments = deviceCopy("short_segments", shortSegments(scene, laws));
  if (scene.reconstruction.wall.extent(0) == 0)
    scene.reconstruction.wall = deviceCopy("wall", contactWalls(scene));
  if (scene.kinematics == Kinematics::Xfem)
  {
    std::vector<int> const fluid = pressingFluids(scene, laws);
    bool const any = std::find(fluid.begin(), fluid.end(), 1) != fluid.end();
    s.work.keeps_pressure = any;
    if (any && scene.constraint.fluid.extent(0) == 0)
      scene.constraint.fluid = deviceCopy("fluid", fluid);
  }
  if (scene.kinematics == Kinematics::Lagrangian && scene.subzone_fraction.extent(0) == 0)
    scene.subzone_fraction = subzoneFractions(scene.mesh);
  if (scene.reconstruction.exact.extent(0) == 0)
  {
    std::vector<int> exact;
    for (Material const &law : laws)
      exact.push_back(law.rigid_body >= 0 ? 1 : 0);
    scene.reconstruction.exact = deviceCopy("exact", exact);
  }
  if (scene.reconstruction.fluid.extent(0) == 0)
  {
    std::vector<int> fluid;
    for (Material const &law : laws)
      fluid.push_back(isFluid(law) ? 1 : 0);
    scene.reconstruction.fluid = deviceCopy("fluid", fluid);
  }
  bool can_fail = false;
  for (Material const &law : laws)
    can_fail = can_fail || canFail(law);
  if (can_fail && !s.state.tracks_damage)
  {
    s.state.tracks_damage = true;
    s.state.damage = View<double *>("damage", s.pairs.num_pairs);
  }
  if (s.bodies.empty())
    s.bodies = scene.rigid_start;
  for (RigidBody &body : s.bodies)
    body.axial = scene.mesh.geometry == Geometry::Axisymmetric;
  setRigidVelocities(scene, s);
  if (scene.prescribed.kind != FieldKind::None)
    setPrescribedVelocities(scene, s);

  prepareWork(s.pairs, s.dof_nodes, s.work);
  computeNodeAltitudes(scene.mesh, s.work);
  if (s.start_density.empty())
    s.start_density = largestDensities(scene, s, laws);
  s.work.largest_density = deviceCopy("largest_density", s.start_density);
  computeDofMass(scene.mesh, s.pairs, s.dof_nodes, s.state, scene.materials, s.work);
  s.limit = stableTimeStep(scene.mesh, s.pairs, s.state, scene.materials, scene.lagrange, s.work);
  s.dt = scene.max_dt;
  if (scene.prescribed.kind == FieldKind::None)
    s.dt = Math::min(scene.exchange->min(s.limit.dt), s.dt);
  ReconstructionReport report;
  reconstructState(scene, s, report);
  s.started = true;
  return report;
}

} // namespace Harmos
