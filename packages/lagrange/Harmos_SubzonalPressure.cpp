// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_SubzonalPressure.hpp>

#include <Harmos_EquationOfState.hpp>

namespace Harmos
{
namespace
{

/// The subzone of a corner has the diagonals d1 (corner to centre) and d2 (between the middles of its edges):
/// area = cross(d1, d2) / 2.
struct Subzone
{
  Vector2 d1, d2;

  KOKKOS_INLINE_FUNCTION Subzone(Quadrilateral const &q, int corner)
      : d1(0.25 * ((q[0] + q[1]) + (q[2] + q[3])) - q[corner]), d2(0.5 * (q[(corner + 3) % 4] - q[(corner + 1) % 4]))
  {
  }
  KOKKOS_INLINE_FUNCTION double area() const { return 0.5 * cross(d1, d2); }
};

/// force[J] += pressure dA/dx_J: d1 moves by a quarter of every corner, less the own one; d2 by half of its neighbours.
KOKKOS_INLINE_FUNCTION void addPressure(Subzone const &zone, int corner, double pressure, Vector2 force[4])
{
  Vector2 const by_d1 = (-0.5 * pressure) * perpendicular(zone.d2);
  Vector2 const by_d2 = (0.25 * pressure) * perpendicular(zone.d1);
  for (int k = 0; k < 4; ++k)
    force[k] += 0.25 * by_d1;
  force[corner] -= by_d1;
  force[(corner + 3) % 4] += by_d2;
  force[(corner + 1) % 4] -= by_d2;
}

} // namespace

View<double *[4]> subzoneFractions(Mesh const &mesh)
{
  View<double *[4]> const fraction("Harmos::lagrange::subzone_fraction", mesh.num_cells);
  Kokkos::parallel_for(
      "Harmos::lagrange::subzoneFractions", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        Quadrilateral const q = cellQuadrilateral(mesh, cell);
        for (int k = 0; k < 4; ++k)
          fraction(cell, k) = Subzone(q, k).area() / mesh.cell_area(cell);
      });
  return fraction;
}

void addSubzonalForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                       View<Material *> const &materials, View<double *[4]> const &fraction, double merit,
                       LagrangeWork &work)
{
  auto const record = state.record;
  auto const corner_force = work.corner_force;
  Kokkos::parallel_for(
      "Harmos::lagrange::subzonalForces", RangePolicy(0, pairs.num_pairs), KOKKOS_LAMBDA(int pair) {
        Material const &material = materials(pairs.material(pair));
        if (material.rigid_body >= 0)
          return;
        int const cell = pairs.cell(pair);
        Quadrilateral const q = cellQuadrilateral(mesh, cell);
        double const sv = record(pair, SpecificVolume);
        double const c2 = equationOfState(material, sv, record(pair, InternalEnergy)).sound_speed_squared;
        // planar: 1; axisymmetric: the mean radius
        double const depth = mesh.cell_volume(cell) / mesh.cell_area(cell);
        double const stiffness = depth * merit * c2 / sv;
        Vector2 force[4] = {};
        for (int k = 0; k < 4; ++k)
        {
          Subzone const zone(q, k);
          addPressure(zone, k, stiffness * (fraction(cell, k) * mesh.cell_area(cell) / zone.area() - 1.0), force);
        }
        for (int k = 0; k < 4; ++k)
          for (int d = 0; d < 2; ++d)
            corner_force(pair, 2 * k + d) += force[k][d];
      });
}

} // namespace Harmos
