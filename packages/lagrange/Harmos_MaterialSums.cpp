// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <Harmos_JoinReducer.hpp>
#include <detail/Harmos_PairAccess.hpp>

#include <algorithm>

namespace Harmos
{
namespace
{

struct Kinetic : KineticSums
{
  KOKKOS_INLINE_FUNCTION void join(Kinetic const &other)
  {
    mass += other.mass;
    momentum += other.momentum;
    angular_momentum += other.angular_momentum;
    kinetic_energy += other.kinetic_energy;
  }
};

/// Add one pair to its material's row of sums.
KOKKOS_INLINE_FUNCTION void addPair(Mesh const &mesh, CellMaterialPairs const &pairs,
                                    View<double *[num_pair_fields]> const &record, View<double *[2]> const &velocity,
                                    int pair, double *row)
{
  int const cell = pairs.cell(pair);
  auto const x = detail::cellCorners(mesh, cell);
  auto const v = detail::cornerVelocities(pairs, velocity, pair);
  double const mass = record(pair, Mass);
  double px = 0.0, py = 0.0, turning = 0.0, speed2 = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    double const share = mesh.corner_share(cell, k);
    px += share * v.x[k];
    py += share * v.y[k];
    turning += share * (x.x[k] * v.y[k] - x.y[k] * v.x[k]);
    speed2 += share * (v.x[k] * v.x[k] + v.y[k] * v.y[k]);
  }
  row[SumMass] += mass;
  row[SumVolume] += record(pair, VolumeFraction) * mesh.cell_volume(cell);
  row[SumMomentumX] += mass * px;
  row[SumMomentumY] += mass * py;
  row[SumAngularMomentum] += mass * turning;
  row[SumKineticEnergy] += 0.5 * mass * speed2;
  row[SumInternalEnergy] += mass * record(pair, InternalEnergy);
  row[PlasticStrainMax] = Math::max(row[PlasticStrainMax], record(pair, PlasticStrain));
}

} // namespace

KineticSums kineticSums(Mesh const &mesh, NodeMaterialPairs const &dof_nodes, View<double *> const &dof_mass,
                        View<double *[2]> const &velocity)
{
  Kinetic result;
  Kokkos::parallel_reduce(
      "Harmos::lagrange::kineticSums", RangePolicy(0, dof_nodes.num_dof_nodes),
      KOKKOS_LAMBDA(int dof, Kinetic &sums) {
        int const node = dof_nodes.node(dof);
        if (!mesh.node_owned(node))
          return;
        double const mass = dof_mass(dof);
        Vector2 const v{velocity(dof, 0), velocity(dof, 1)};
        Vector2 const x{mesh.node_position(node, 0), mesh.node_position(node, 1)};
        sums.mass += mass;
        sums.momentum += mass * v;
        sums.angular_momentum += mass * cross(x, v);
        sums.kinetic_energy += 0.5 * mass * dot(v, v);
      },
      JoinReducer<Kinetic>(result));
  return result;
}

MaterialSums materialSums(Mesh const &mesh, CellMaterialPairs const &pairs,
                          View<double *[num_pair_fields]> const &record, View<double *[2]> const &velocity,
                          int num_materials)
{
  // chunks of fixed size, each summed in order, then added in order: the same bits for any number of threads
  int const chunk = std::max(256, pairs.num_pairs / 4096 + 1);
  int const num_chunks = (pairs.num_pairs + chunk - 1) / chunk;
  View<double ***> const partial("Harmos::lagrange::partial_sums", num_chunks, num_materials, num_material_sums);
  Kokkos::parallel_for(
      "Harmos::lagrange::materialSums", RangePolicy(0, num_chunks), KOKKOS_LAMBDA(int c) {
        int const last = Math::min((c + 1) * chunk, pairs.num_pairs);
        for (int pair = c * chunk; pair < last; ++pair)
          if (mesh.cell_depth(pairs.cell(pair)) == 0)
            addPair(mesh, pairs, record, velocity, pair, &partial(c, pairs.material(pair), 0));
      });
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), partial);
  MaterialSums sums("Harmos::lagrange::material_sums", num_materials, num_material_sums);
  for (int c = 0; c < num_chunks; ++c)
    for (int material = 0; material < num_materials; ++material)
      for (int field = 0; field < num_material_sums; ++field)
        if (field == PlasticStrainMax)
          sums(material, field) = std::max(sums(material, field), host(c, material, field));
        else
          sums(material, field) += host(c, material, field);
  return sums;
}

} // namespace Harmos
