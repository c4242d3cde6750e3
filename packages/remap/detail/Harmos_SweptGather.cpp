// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptFluxes.hpp>

#include <detail/Harmos_FieldPack.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// Monotonised central difference of two neighbouring differences.
KOKKOS_INLINE_FUNCTION double limitedDifference(double upstream, double downstream)
{
  double const central = 0.5 * Math::fabs(upstream + downstream);
  double const bound = 2.0 * Math::min(Math::fabs(upstream), Math::fabs(downstream));
  double const size = upstream * downstream > 0.0 ? Math::min(central, bound) : 0.0;
  return upstream > 0.0 ? size : -size;
}

struct SweptGatherFunctor
{
  Input in;
  Classes classes;
  View<double *> kinetic;
  View<double *[8]> moved_record;
  View<double *[16]> geometry;
  View<double *[4][8]> flux;
  View<double *[8]> increment;
  View<double *[num_pair_fields]> record1;
  View<double *> kinetic1;

  /// Mass that leaves through each face; change[] sums what all fluxes bring. False where nothing flows.
  KOKKOS_INLINE_FUNCTION bool gather(int cell, double outflow[4], FieldPack &change, double &volume) const
  {
    bool flows = false;
    for (int k = 0; k < 4; ++k)
    {
      double const swept = geometry(cell, FirstFace + 3 * k);
      outflow[k] = 0.0;
      if (swept == 0.0)
        continue;
      flows = true;
      volume -= swept;
      if (swept > 0.0)
      {
        outflow[k] = flux(cell, k, DensityField);
        change -= FieldPack(&flux(cell, k, 0));
      }
      else
      {
        int const face = in.mesh.face_neighbour(cell, k);
        outflow[k] = -flux(face / 4, face % 4, DensityField);
        change += FieldPack(&flux(face / 4, face % 4, 0));
      }
    }
    return flows;
  }

  KOKKOS_INLINE_FUNCTION void newRecord(int cell, int pair, double const outflow[4], double moved_volume, double volume,
                                        FieldPack const &change) const
  {
    double const mass = in.state.record(pair, Mass);
    double const mass1 = mass - ((outflow[0] + outflow[1]) + (outflow[2] + outflow[3]));
    FieldPack const q(&moved_record(cell, 0));
    double q1[FieldPack::fields];
    ((fieldWeights(moved_volume, mass) * q + change) * fieldWeights(1.0 / volume, 1.0 / mass1)).store(q1);
    if (kinetic1.extent(0) > 0)
      kinetic1(pair) = q1[KineticField];
    q1[Mass] = mass1;
    q1[VolumeFraction] = 1.0;
    returnToYield(in.materials(classes.pure_material(cell)), q1);
    for (int f = 0; f < num_pair_fields; ++f)
      record1(pair, f) = q1[f];
  }

  KOKKOS_INLINE_FUNCTION Vector2 velocity(int pair, int corner) const
  {
    int const dof = in.pairs.dof_node(pair, corner);
    return {in.half(dof, 0), in.half(dof, 1)};
  }

  /// The mass G flows along two parallel edges of a cell, edge[0] -> edge[1] and edge[2] -> edge[3]. The nodes where
  /// they begin share the face `behind`, those where they end share `ahead`.
  KOKKOS_INLINE_FUNCTION void advect(int cell, double mass, double G, int const edge[4], int behind, int ahead,
                                     Vector2 const v[4], Vector2 gain[4]) const
  {
    if (G == 0.0)
      return;
    bool const forward = G > 0.0;
    int const upwind_face = forward ? behind : ahead;
    double const flow = Math::fabs(G);
    int beyond_face = -1;
    if (in.options.order > 1)
    {
      beyond_face = in.mesh.face_neighbour(cell, upwind_face);
      if (beyond_face >= 0 && classes.pure_material(beyond_face / 4) != classes.pure_material(cell))
        beyond_face = -1;
    }
    double const courant = Math::min(1.0, 2.0 * flow / mass);
    for (int e = 0; e < 2; ++e)
    {
      int const up = forward ? edge[2 * e] : edge[2 * e + 1];
      int const down = forward ? edge[2 * e + 1] : edge[2 * e];
      Vector2 face_velocity = v[up];
      if (beyond_face >= 0)
      {
        // our node k of the face is the neighbour's f + 1, beyond it f + 2; our k + 1 is its f, beyond it f + 3
        int const corner = (beyond_face % 4 + (up == upwind_face ? 2 : 3)) % 4;
        Vector2 const beyond = velocity(in.pairs.offset(beyond_face / 4), corner);
        for (int d = 0; d < 2; ++d)
          face_velocity[d] += 0.5 * (1.0 - courant) * limitedDifference(v[up][d] - beyond[d], v[down][d] - v[up][d]);
      }
      gain[down] += flow * (face_velocity - v[down]);
      gain[up] -= flow * (face_velocity - v[up]);
    }
  }

  KOKKOS_INLINE_FUNCTION void operator()(int cell) const
  {
    FieldPack change(0.0);
    double outflow[4];
    int const first = in.pairs.offset(cell);
    bool flows = false;
    if (classes.pure_material(cell) >= 0)
    {
      double volume = geometry(cell, MovedVolume);
      double const moved_volume = volume;
      flows = gather(cell, outflow, change, volume);
      if (flows)
        newRecord(cell, first, outflow, moved_volume, volume, change);
    }
    if (!flows)
    {
      for (int pair = first; pair < in.pairs.offset(cell + 1); ++pair)
      {
        for (int f = 0; f < 8; ++f)
          record1(pair, f) = in.state.record(pair, f);
        if (kinetic.extent(0) > 0)
          kinetic1(pair) = kinetic(pair);
      }
      if (classes.pure_material(cell) >= 0)
        for (int i = 0; i < 8; ++i)
          increment(cell, i) = 0.0;
      return;
    }
    Vector2 v[4];
    Vector2 gain[4];
    for (int k = 0; k < 4; ++k)
    {
      v[k] = velocity(first, k);
      gain[k] = {0.0, 0.0};
    }
    double const mass = in.state.record(first, Mass);
    int const along[4] = {0, 1, 3, 2};
    int const across[4] = {0, 3, 1, 2};
    advect(cell, mass, 0.25 * (outflow[1] - outflow[3]), along, 3, 1, v, gain);
    advect(cell, mass, 0.25 * (outflow[2] - outflow[0]), across, 0, 2, v, gain);
    for (int k = 0; k < 4; ++k)
    {
      increment(cell, 2 * k) = gain[k][0];
      increment(cell, 2 * k + 1) = gain[k][1];
    }
  }
};

} // namespace

void sweptGather(Input const &in, Classes const &classes, View<double *> const &kinetic, RemapWork const &work,
                 View<double *[num_pair_fields]> const &record1, View<double *> const &kinetic1)
{
  Kokkos::parallel_for("Harmos::remap::sweptGather", RangePolicy(0, in.mesh.num_cells),
                       SweptGatherFunctor{in, classes, kinetic, work.moved_record, work.geometry, work.flux,
                                          work.corner_increment, record1, kinetic1});
}

void sweptMomentum(Input const &in, Classes const &classes, RemapWork const &work,
                   View<double *[num_pair_fields]> const &record1, View<double *[2]> const &velocity1)
{
  View<double *[8]> const increment = work.corner_increment;
  Kokkos::parallel_for(
      "Harmos::remap::sweptMomentum", RangePolicy(0, in.mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        for (int dof = in.dof_nodes.offset(node); dof < in.dof_nodes.offset(node + 1); ++dof)
        {
          double four_mass = 0.0;
          Vector2 gain{0.0, 0.0};
          for (int j = in.mesh.node_cell.offset(node); j < in.mesh.node_cell.offset(node + 1); ++j)
          {
            int const cell = in.mesh.node_cell.item(j) / 4;
            int const corner = in.mesh.node_cell.item(j) % 4;
            int const pure = classes.pure_material(cell);
            if (pure == -2)
              continue;
            for (int pair = in.pairs.offset(cell); pair < in.pairs.offset(cell + 1); ++pair)
            {
              if (in.pairs.dof_node(pair, corner) != dof)
                continue;
              if (pure < 0 && in.isRigid(in.pairs.material(pair)))
                continue;
              four_mass += record1(pair, Mass);
              if (pure >= 0)
                gain += {increment(cell, 2 * corner), increment(cell, 2 * corner + 1)};
            }
          }
          double const per_mass = four_mass > 0.0 ? 4.0 / four_mass : 0.0;
          velocity1(dof, 0) = in.half(dof, 0) + per_mass * gain[0];
          velocity1(dof, 1) = in.half(dof, 1) + per_mass * gain[1];
        }
      });
}

} // namespace RemapDetail
} // namespace Harmos
