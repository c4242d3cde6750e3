// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RemapStudyMeasures.hpp"

#include <Harmos_Lagrange.hpp>

namespace Harmos
{

Sums sumsOf(Mesh const &mesh, View<double *> const &value, View<double *> const &exact, Exchange const &exchange)
{
  Sums s;
  Kokkos::parallel_reduce(
      "Harmos::sumsOf", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, double &total, double &l1, double &l2) {
        double const v = mesh.cell_depth(cell) == 0 ? mesh.cell_volume(cell) : 0.0;
        double const difference = value(cell) - exact(cell);
        total += v * value(cell);
        l1 += v * Math::fabs(difference);
        l2 += v * difference * difference;
      },
      s.total, s.l1, s.l2);
  double linf = 0.0, low = 1e300, high = -1e300;
  Kokkos::parallel_reduce(
      "Harmos::extremaOf", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, double &a, double &b, double &c) {
        if (mesh.cell_depth(cell) != 0)
          return;
        a = Math::max(a, Math::fabs(value(cell) - exact(cell)));
        b = Math::min(b, value(cell));
        c = Math::max(c, value(cell));
      },
      Kokkos::Max<double>(linf), Kokkos::Min<double>(low), Kokkos::Max<double>(high));
  double sums[3] = {s.total, s.l1, s.l2};
  exchange.sum(sums, 3);
  return {sums[0], sums[1], std::sqrt(sums[2]), exchange.max(linf), exchange.min(low), exchange.max(high)};
}

Swirl swirlOf(Study const &s, Exchange const &exchange)
{
  MaterialSums const m = materialSums(s.mesh, s.pairs, s.state.record, s.state.velocity, 1);
  double sums[7] = {m(0, SumMomentumX), m(0, SumMomentumY), m(0, SumAngularMomentum), m(0, SumKineticEnergy),
                    m(0, SumMass),      s.wall_impulse[0],  s.wall_impulse[1]};
  exchange.sum(sums, 7);
  return {{sums[0], sums[1]}, {sums[5], sums[6]}, sums[2], sums[3], sums[4]};
}

void noteSwirl(Swirl const &before, Swirl const &now, Geometry geometry, StudyRow &row)
{
  Vector2 change = (now.momentum - before.momentum) - now.wall_impulse;
  bool const planar = geometry == Geometry::Planar;
  if (!planar)
    change[0] = 0.0;
  // sum m |v| <= root of (2 E_kin m)
  double const scale = std::sqrt(2.0 * before.kinetic_energy * before.mass);
  row.momentum = std::fmax(row.momentum, norm(change) / scale);
  if (planar)
    row.angular_momentum =
        std::fmax(row.angular_momentum, std::fabs(now.angular_momentum / before.angular_momentum - 1.0));
  row.kinetic_energy = now.kinetic_energy / before.kinetic_energy;
}

double courantOf(Mesh const &from, Mesh const &to)
{
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::courantOf", RangePolicy(0, from.num_cells),
      KOKKOS_LAMBDA(int cell, double &most) {
        Quadrilateral const a = cellQuadrilateral(from, cell), b = cellQuadrilateral(to, cell);
        double altitude = 1e300, shift = 0.0;
        for (int k = 0; k < 4; ++k)
        {
          Vector2 const d = b[k] - a[k], ea = a[(k + 1) % 4] - a[k], eb = b[(k + 1) % 4] - b[k];
          altitude = Math::min(altitude, Math::min(from.cell_area(cell) / Math::sqrt(dot(ea, ea)),
                                                   to.cell_area(cell) / Math::sqrt(dot(eb, eb))));
          shift = Math::max(shift, dot(d, d));
        }
        most = Math::max(most, Math::sqrt(shift) / altitude);
      },
      Kokkos::Max<double>(largest));
  return largest;
}

} // namespace Harmos
