// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_Select.hpp>
#include <detail/Harmos_FieldPack.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// Velocities at the corners of a pack's cells.
struct PackedCorners
{
  Pack x[4], y[4];
};

/// Monotonised central difference of two neighbouring differences.
KOKKOS_FORCEINLINE_FUNCTION Pack limitedDifference(Pack const &upstream, Pack const &downstream)
{
  Pack const central = 0.5 * Math::fabs(upstream + downstream);
  Pack const bound = 2.0 * Math::min(Math::fabs(upstream), Math::fabs(downstream));
  Pack const size = select(upstream * downstream > Pack(0.0), Math::min(central, bound), Pack(0.0));
  return select(upstream > Pack(0.0), size, Pack(-size));
}

/// Two parallel edges of a cell, edge[0] -> edge[1] and edge[2] -> edge[3]. The nodes where they begin share the face
/// `behind`, those where they end share `ahead`.
struct EdgePair
{
  int edge[4];
  int behind, ahead;
};

struct SweptGatherFunctor
{
  SweptStage stage;
  int begin, end;

  /// What the lanes' cells exchange with their neighbours.
  struct Exchanged
  {
    FieldPack change[pack_width];  // sums what all fluxes bring
    double outflow[4][pack_width]; // mass that leaves through each face
    double volume[pack_width], moved_volume[pack_width], mass[pack_width];
  };

  /// False where nothing flows.
  KOKKOS_FORCEINLINE_FUNCTION bool gather(int cell, int lane, Exchanged &e) const
  {
    double const *geometry = stage.cellRow(cell);
    FieldPack change(0.0);
    double volume = geometry[MovedVolume];
    e.moved_volume[lane] = volume;
    bool flows = false;
    int const flags = stage.flags[cell];
    bool const swept = (flags & all_swept_corners) != 0;
    for (int k = 0; k < 4; ++k)
    {
      e.outflow[k][lane] = 0.0;
      if (!swept || (flags & SameBeyondBit << k) == 0)
        continue;
      int const face = stage.face_neighbour(cell, k);
      double const leaves = geometry[SweptVolume + k];
      double const enters = stage.cellRow(face >> 2)[SweptVolume + (face & 3)];
      if (leaves > 0.0)
      {
        flows = true;
        double const *flux = stage.fluxRow(cell, k);
        volume -= leaves;
        e.outflow[k][lane] = flux[DensityField];
        change -= FieldPack(flux);
      }
      if (enters > 0.0)
      {
        flows = true;
        double const *flux = stage.fluxRow(face >> 2, face & 3);
        volume += enters;
        e.outflow[k][lane] -= flux[DensityField];
        change += FieldPack(flux);
      }
    }
    e.volume[lane] = volume;
    e.change[lane] = change;
    return flows;
  }

  KOKKOS_FORCEINLINE_FUNCTION void copyPair(int pair) const
  {
    FieldPack(stage.record.row(pair)).store(stage.record1.row(pair));
    if (stage.carries())
      stage.kinetic1[pair] = stage.kinetic[pair];
  }

  KOKKOS_FORCEINLINE_FUNCTION void newRecord(int cell, int pair, int lane, Exchanged const &e, double mass1,
                                             double per_volume, double per_mass) const
  {
    FieldPack q(stage.record.row(pair));
    q.set<DensityField>(stage.cellRow(cell)[MovedDensity]);
    if (stage.carries())
      q.set<KineticField>(stage.kinetic[pair]);
    FieldPack q1 =
        (fieldWeights(e.moved_volume[lane], e.mass[lane]) * q + e.change[lane]) * fieldWeights(per_volume, per_mass);
    if (stage.carries())
      stage.kinetic1[pair] = q1[KineticField];
    q1.set<Mass>(mass1);
    q1.set<VolumeFraction>(1.0);
    double *record = stage.record1.row(pair);
    q1.store(record);
    returnToYield(stage.materials[stage.pure_material[cell]], record);
  }

  /// The dof nodes one edge beyond the upwind nodes of two parallel edges; the upwind nodes themselves where the
  /// neighbour does not count: then the limited difference is zero.
  KOKKOS_FORCEINLINE_FUNCTION void dofsBeyond(int cell, int pair, int flags, bool forward, EdgePair const &edges,
                                              int &first, int &second) const
  {
    int const upwind_face = forward ? edges.behind : edges.ahead;
    int const up0 = edges.edge[forward ? 0 : 1];
    int const up1 = edges.edge[forward ? 2 : 3];
    if ((flags & SameBeyondBit << upwind_face) == 0 || !stage.second_order)
    {
      first = stage.dof_node(pair, up0);
      second = stage.dof_node(pair, up1);
      return;
    }
    // our node k of the face is the neighbour's f + 1, beyond it f + 2; our k + 1 is its f, beyond it f + 3
    int const face = stage.face_neighbour(cell, upwind_face);
    int const neighbour = stage.first_pair[face >> 2];
    first = stage.dof_node(neighbour, (face + (up0 == upwind_face ? 2 : 3)) & 3);
    second = stage.dof_node(neighbour, (face + (up1 == upwind_face ? 2 : 3)) & 3);
  }

  /// Momentum along one edge a -> b: the upwind velocity at the face between them goes with the mass.
  KOKKOS_FORCEINLINE_FUNCTION static void transfer(Pack::Mask const &forward, Pack const &flow, Pack const &part,
                                                   Pack const &va, Pack const &vb, Pack const &beyond, Pack &gain_a,
                                                   Pack &gain_b)
  {
    Pack const up = select(forward, va, vb);
    Pack const down = select(forward, vb, va);
    Pack const face = up + part * limitedDifference(up - beyond, down - up);
    Pack const to_down = flow * (face - down);
    Pack const to_up = flow * (up - face);
    gain_a += select(forward, to_up, to_down);
    gain_b += select(forward, to_down, to_up);
  }

  KOKKOS_FORCEINLINE_FUNCTION void advect(int const cell[pack_width], int const pair[pack_width],
                                          int const flags[pack_width], Pack const &G, Pack const &per_mass,
                                          EdgePair const &edges, PackedCorners const &v, PackedCorners &gain) const
  {
    auto const forward = G > Pack(0.0);
    int first[pack_width], second[pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
      dofsBeyond(cell[lane], pair[lane], flags[lane], laneOf(forward, lane), edges, first[lane], second[lane]);
    RowPointer<double, 2> const half = stage.half;
    Pack const flow = Math::fabs(G);
    Pack const part = 0.5 * (1.0 - Math::min(Pack(1.0), Pack(2.0 * flow * per_mass)));
    for (int e = 0; e < 2; ++e)
    {
      int const a = edges.edge[2 * e], b = edges.edge[2 * e + 1];
      int const *dof = e == 0 ? first : second;
      Pack const beyond_x = packOf([&](int lane) { return half(dof[lane], 0); });
      Pack const beyond_y = packOf([&](int lane) { return half(dof[lane], 1); });
      transfer(forward, flow, part, v.x[a], v.x[b], beyond_x, gain.x[a], gain.x[b]);
      transfer(forward, flow, part, v.y[a], v.y[b], beyond_y, gain.y[a], gain.y[b]);
    }
  }

  /// The pure cells of a pack: records and increments. Returns their kinetic energy before.
  KOKKOS_FORCEINLINE_FUNCTION double exchange(int const cell[pack_width], unsigned pure) const
  {
    Exchanged e;
    int pair[pack_width], flags[pack_width];
    unsigned flowing = 0u;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      pair[lane] = stage.first_pair[cell[lane]];
      flags[lane] = stage.flags[cell[lane]];
      e.mass[lane] = stage.record(pair[lane], Mass);
      flowing |= (gather(cell[lane], lane, e) ? 1u : 0u) << lane;
    }
    Pack const mass = packOf([&](int lane) { return e.mass[lane]; });
    Pack out[4];
    for (int k = 0; k < 4; ++k)
      out[k] = packOf([&](int lane) { return e.outflow[k][lane]; });
    Pack const mass1 = mass - ((out[0] + out[1]) + (out[2] + out[3]));
    Pack const per_mass1 = 1.0 / mass1;
    Pack const per_volume = 1.0 / packOf([&](int lane) { return e.volume[lane]; });
    for (int lane = 0; lane < pack_width; ++lane)
      if ((pure >> lane & 1u) == 0u)
        continue;
      else if ((flowing >> lane & 1u) != 0u)
        newRecord(cell[lane], pair[lane], lane, e, laneOf(mass1, lane), laneOf(per_volume, lane),
                  laneOf(per_mass1, lane));
      else
        copyPair(pair[lane]);

    PackedCorners v, gain;
    Pack speed2 = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      int dof[pack_width];
      for (int lane = 0; lane < pack_width; ++lane)
        dof[lane] = stage.dof_node(pair[lane], k);
      v.x[k] = packOf([&](int lane) { return stage.half(dof[lane], 0); });
      v.y[k] = packOf([&](int lane) { return stage.half(dof[lane], 1); });
      gain.x[k] = 0.0;
      gain.y[k] = 0.0;
      speed2 += v.x[k] * v.x[k] + v.y[k] * v.y[k];
    }
    if (flowing != 0u)
    {
      Pack const per_mass = 1.0 / mass;
      advect(cell, pair, flags, 0.25 * (out[1] - out[3]), per_mass, {{0, 1, 3, 2}, 3, 1}, v, gain);
      advect(cell, pair, flags, 0.25 * (out[2] - out[0]), per_mass, {{0, 3, 1, 2}, 0, 2}, v, gain);
    }
    Pack const row[8] = {gain.x[0], gain.y[0], gain.x[1], gain.y[1], gain.x[2], gain.y[2], gain.x[3], gain.y[3]};
    storeRows(row, pure, [&](int lane) { return stage.incrementRow(cell[lane]); });
    for (int lane = 0; lane < pack_width; ++lane)
      stage.mass[cell[lane] & stage.mask] = laneOf(mass1, lane);

    Pack const kinetic = 0.125 * mass * speed2;
    double sum = 0.0;
    for (int lane = 0; lane < pack_width; ++lane)
      if ((pure >> lane & 1u) != 0u && stage.cell_depth[cell[lane]] == 0)
        sum += laneOf(kinetic, lane);
    return sum;
  }

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int block, double &kinetic) const
  {
    int const first = begin + block * pack_width;
    int const count = Math::min(pack_width, end - first);
    unsigned pure = 0u;
    int lead = -1;
    for (int lane = 0; lane < count; ++lane)
    {
      int const cell = first + lane;
      if ((stage.flags[cell] & PureCellBit) != 0)
      {
        pure |= 1u << lane;
        lead = lead < 0 ? lane : lead;
      }
      else
        for (int pair = stage.first_pair[cell]; pair < stage.first_pair[cell + 1]; ++pair)
          copyPair(pair);
    }
    if (pure == 0u)
      return;
    int cell[pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
      cell[lane] = first + ((pure >> lane & 1u) != 0u ? lane : lead);
    kinetic += exchange(cell, pure);
  }
};

} // namespace

double sweptGather(SweptStage const &stage, int begin, int end)
{
  double kinetic = 0.0;
  Kokkos::parallel_reduce("Harmos::remap::sweptGather", RangePolicy(0, numPacks(end - begin)),
                          SweptGatherFunctor{stage, begin, end}, kinetic);
  return kinetic;
}

} // namespace RemapDetail
} // namespace Harmos
