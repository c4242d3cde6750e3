// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_ContactState.hpp"

#include <Harmos_EquationOfState.hpp>

namespace Harmos
{

namespace
{

/// Longitudinal wave speeds of the laws' reference states; 0: rigid. [m/s]
std::vector<double> waveSpeeds(Scene const &scene)
{
  auto const impedance = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.constraint.impedance);
  auto const material = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.materials);
  std::vector<double> speed;
  for (std::size_t m = 0; m < impedance.extent(0); ++m)
    speed.push_back(impedance(m) / material(m).density0);
  return speed;
}

} // namespace

void placeBonds(Scene const &scene, CycleState &s)
{
  s.bonds = findBonds(scene.mesh, s.pairs, s.dof_nodes, s.regions, scene.boundary, s.bodies, scene.constraint,
                      *scene.exchange);
  std::vector<double> const speed = waveSpeeds(scene);
  for (Bond &bond : s.bonds)
    for (int const material : {bond.material_a, bond.material_b})
      if (speed[material] > 0.0)
        bond.transit = Math::max(bond.transit, bond.cell_size / speed[material]);
  std::vector<Vector2> points;
  for (Bond const &bond : s.bonds)
    points.push_back(bond.point);
  std::vector<long long> const cell = locatePoints(scene.mesh, points, *scene.exchange);
  s.bond_tracers.clear();
  for (std::size_t i = 0; i < s.bonds.size(); ++i)
    s.bond_tracers.push_back({s.bonds[i].point, {0.0, 0.0}, cell[i], s.bonds[i].material_a});
}

View<double *[3]> pairStress(CycleState const &s, View<Material *> const &materials)
{
  View<double *[3]> const stress("Harmos::pairStress", s.pairs.num_pairs);
  auto const record = s.state.record;
  auto const material = s.pairs.material;
  Kokkos::parallel_for(
      "Harmos::pairStress", RangePolicy(0, s.pairs.num_pairs), KOKKOS_LAMBDA(int pair) {
        Material const &law = materials(material(pair));
        if (law.rigid_body >= 0)
          return;
        double const p = equationOfState(law, record(pair, SpecificVolume), record(pair, InternalEnergy)).pressure;
        stress(pair, 0) = record(pair, DeviatorXX) - p;
        stress(pair, 1) = record(pair, DeviatorYY) - p;
        stress(pair, 2) = record(pair, DeviatorXY);
      });
  return stress;
}

void moveBonds(Scene const &scene, CycleState &s, double dt)
{
  moveTracers(pointField(scene, s), s.work.half, dt, scene.kinematics == Kinematics::Lagrangian, *scene.exchange,
              s.bond_tracers);
  for (std::size_t i = 0; i < s.bonds.size(); ++i)
    s.bonds[i].point = s.bond_tracers[i].position;
}

} // namespace Harmos
