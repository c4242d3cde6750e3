// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_Prefetch.hpp>
#include <Harmos_Select.hpp>
#include <detail/Harmos_FieldPack.hpp>
#include <detail/Harmos_NeighbourFaces.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

struct SweptGatherFunctor : NeighbourFaces
{
  int begin, end;

  SweptGatherFunctor(SweptStage const &swept_stage, int first, int last)
      : NeighbourFaces{swept_stage}, begin(first), end(last)
  {
  }

  /// The cells of a block. Those that are not pure repeat one that is.
  struct Block
  {
    int first;
    double *own; // its rows of the window
    int cell[pack_width], pair[pack_width];
    unsigned pure; // lanes
    int bits;      // SweptBlock
  };

  /// What the cells exchange with their neighbours.
  struct Exchanged
  {
    double const *entering[2]; // fluxes into the cells through face 0 or 2, through 1 or 3; of the first field
    LaneMask enters[2];        // where they count
    Pack outflow[4];           // mass that leaves through each face
    Pack volume;               // after
    Pack flow;                 // zero where nothing moves
  };

  KOKKOS_FORCEINLINE_FUNCTION static Pack own(Block const &block, int column)
  {
    return loadPack(block.own + column * column_stride);
  }

  KOKKOS_FORCEINLINE_FUNCTION void findNeighbours(Block const &block, Neighbours &beyond, GatheredFaces &gathered) const
  {
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      bool in_run = (block.bits & RunBit << k) != 0;
      if (in_run)
      {
        int const face = stage.face_neighbour(block.first, k);
        double const *const cell = stage.at(0, face >> 2);
        beyond.swept[k] = cell + sweptColumn(face) * column_stride;
        beyond.flux[k] = cell + fluxColumn(face) * column_stride;
        double const *const from = stage.second_order ? cell : block.own;
        for (int i = 0; i < 2; ++i)
          beyond.velocity[k][i] = from + velocityColumn(face, k, i, stage.second_order) * column_stride;
        in_run = !any(loadPack(beyond.swept[k]) < Pack(0.0));
      }
      if (in_run)
        continue;
      bool gathers = true;
      if ((block.bits & AcrossBit << k) != 0)
      {
        joinFace(block.first, k, gathered);
        gathers = any(loadPack(&gathered[0][k * pack_width]) < Pack(0.0));
      }
      if (gathers)
      {
        Block const copy = block; // what a call sees would leave its registers for all blocks
        gatherFace(copy.cell, k, gathered);
      }
      beyond.swept[k] = &gathered[0][k * pack_width];
      beyond.flux[k] = &gathered[1][k * pack_width];
      for (int i = 0; i < 2; ++i)
        beyond.velocity[k][i] = &gathered[num_face_columns + 2 * i][k * pack_width];
    }
  }

  /// The fields but density.
  template <class Visitor>
  KOKKOS_FORCEINLINE_FUNCTION void forFields(Visitor const &visit) const
  {
    if (stage.carries())
      visit(KineticField);
    HARMOS_UNROLL
    for (int f = KineticField + 1; f < num_pair_fields; ++f)
      visit(f);
  }

  KOKKOS_FORCEINLINE_FUNCTION static bool leaves(Block const &block) { return (block.bits & LeaveBit) != 0; }
  KOKKOS_FORCEINLINE_FUNCTION static bool leavesTwice(Block const &block, int i)
  {
    return (block.bits & SecondBit << i) != 0;
  }
  KOKKOS_FORCEINLINE_FUNCTION static Pack ownFlux(Block const &block, int slot, int field)
  {
    return own(block, FaceColumn + 1 + num_face_columns * slot + field);
  }

  /// What enters through two opposite faces, of all fields.
  HARMOS_RARE_FUNCTION static void addFluxes(double const *one, double const *one_swept, double const *other,
                                             double const *other_swept, double *sum)
  {
    auto const enters = loadPack(one_swept) > Pack(0.0), enters_other = loadPack(other_swept) > Pack(0.0);
    for (int f = 0; f < num_pair_fields; ++f)
    {
      int const column = f * column_stride;
      storePack(sum + column, select(enters, loadPack(one + column), Pack(0.0)) +
                                  select(enters_other, loadPack(other + column), Pack(0.0)));
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION static Exchanged exchange(Block const &block, Neighbours const &beyond,
                                                        GatheredFaces &gathered)
  {
    Exchanged e;
    e.volume = own(block, MovedVolume);
    e.flow = 0.0;
    HARMOS_UNROLL
    for (int i = 0; i < 2; ++i)
    {
      e.outflow[i] = e.outflow[i + 2] = 0.0;
      if (leaves(block))
      {
        Pack const one = own(block, FaceColumn + num_face_columns * i);
        Pack const other = Math::fabs(own(block, FaceColumn + num_face_columns * (i + 2)));
        auto const leaves_one = one > Pack(0.0);
        e.flow += one + other;
        e.volume -= one;
        e.volume -= other;
        Pack const mass = ownFlux(block, i, DensityField);
        e.outflow[i] = select(leaves_one, mass, Pack(0.0));
        e.outflow[i + 2] = select(leaves_one, Pack(0.0), mass);
        if (leavesTwice(block, i))
          e.outflow[i + 2] += ownFlux(block, i + 2, DensityField);
      }
      bool enters[2];
      LaneMask mask[2];
      HARMOS_UNROLL
      for (int j = 0; j < 2; ++j)
      {
        int const k = i + 2 * j;
        Pack const swept = loadPack(beyond.swept[k]);
        mask[j] = swept > Pack(0.0);
        enters[j] = any(mask[j]);
        e.flow += swept;
        e.volume += swept;
        e.outflow[k] -= select(mask[j], loadPack(beyond.flux[k] + DensityField * column_stride), Pack(0.0));
      }
      int const from = enters[1] ? i + 2 : i;
      e.entering[i] = beyond.flux[from];
      e.enters[i] = enters[1] ? mask[1] : mask[0];
      if (enters[0] && enters[1])
      {
        double *const sum = &gathered[0][(4 + i) * pack_width];
        addFluxes(beyond.flux[i], beyond.swept[i], beyond.flux[i + 2], beyond.swept[i + 2], sum);
        e.entering[i] = sum;
        e.enters[i] = Pack(0.0) == Pack(0.0);
      }
    }
    return e;
  }

  /// What all fluxes bring of a field.
  KOKKOS_FORCEINLINE_FUNCTION static Pack changeOf(int field, Block const &block, Exchanged const &e)
  {
    Pack change = 0.0;
    HARMOS_UNROLL
    for (int i = 0; i < 2; ++i)
    {
      if (leaves(block))
        change -= ownFlux(block, i, field);
      if (leavesTwice(block, i))
        change -= ownFlux(block, i + 2, field);
      change += select(e.enters[i], loadPack(e.entering[i] + field * column_stride), Pack(0.0));
    }
    return change;
  }

  KOKKOS_FORCEINLINE_FUNCTION void copyPair(int pair) const
  {
    FieldPack(stage.record.row(pair)).store(stage.record1.row(pair));
    if (stage.carries())
      stage.damage1[pair] = stage.damage[pair];
  }

  /// Of the materials of the lanes, one after the other.
  KOKKOS_FORCEINLINE_FUNCTION void returnAllToYield(Block const &block, Pack (&q)[num_pair_fields]) const
  {
    unsigned left = all_lanes;
    do
    {
      int lead = 0;
      while ((left >> lead & 1u) == 0u)
        ++lead;
      int const number = stage.pure_material[block.cell[lead]];
      unsigned mine = 0u;
      for (int lane = 0; lane < pack_width; ++lane)
        mine |= (stage.pure_material[block.cell[lane]] == number ? 1u : 0u) << lane;
      Pack s[3] = {q[DeviatorXX], q[DeviatorYY], q[DeviatorXY]};
      returnToYield(stage.materials[number], q[PlasticStrain], s[0], s[1], s[2]);
      auto const take = packOf([&](int lane) { return (mine >> lane & 1u) != 0u ? 1.0 : 0.0; }) > Pack(0.0);
      for (int i = 0; i < 3; ++i)
        q[DeviatorXX + i] = select(take, s[i], q[DeviatorXX + i]);
      left &= ~mine;
    } while (left != 0u);
  }

  KOKKOS_FORCEINLINE_FUNCTION void newRecords(Block const &block, Exchanged const &e, Pack const &mass,
                                              Pack const &mass1) const
  {
    Pack const moved_volume = own(block, MovedVolume);
    Pack const per_mass = 1.0 / mass1, per_volume = 1.0 / e.volume;
    Pack q[num_pair_fields];
    forFields(
        [&](int f)
        {
          bool const by_volume = f >= DeviatorXX;
          q[f] = ((by_volume ? moved_volume : mass) * own(block, FieldColumn + f) + changeOf(f, block, e)) *
                 (by_volume ? per_volume : per_mass);
        });
    returnAllToYield(block, q);
    unsigned flowing = block.pure;
    if (any(e.flow <= Pack(0.0)))
      for (int lane = 0; lane < pack_width; ++lane)
        if (!(laneOf(e.flow, lane) > 0.0) && (block.pure >> lane & 1u) != 0u)
        {
          flowing &= ~(1u << lane);
          copyPair(block.pair[lane]);
        }
    if (stage.carries())
      for (int lane = 0; lane < pack_width; ++lane)
        if ((flowing >> lane & 1u) != 0u)
          stage.damage1[block.pair[lane]] = laneOf(q[KineticField], lane);
    q[Mass] = mass1;
    q[VolumeFraction] = 1.0;
    storeIndexedRows(q, flowing, stage.record1, block.pair, (block.bits & WholeBit) != 0);
  }

  /// What the corners of the pure cells add to the heat of their nodes (SweptHeat).
  HARMOS_RARE_FUNCTION void storeHeat(Block const &block, Pack const heat[4]) const
  {
    for (int lane = 0; lane < pack_width; ++lane)
      for (int k = 0; k < 4; ++k)
        if ((block.pure >> lane & 1u) != 0u)
          stage.corner_heat(block.cell[lane], k) = laneOf(heat[k], lane);
  }

  HARMOS_RARE_FUNCTION void advectWithHeat(Block const &block, Pack const out[4], Pack const &per_mass,
                                           Neighbours const &beyond, PackedCorners const &v, PackedCorners &gain) const
  {
    Pack heat[4] = {0.0, 0.0, 0.0, 0.0};
    advect(0.25 * (out[1] - out[3]), per_mass, {{0, 1, 3, 2}, 3, 1}, beyond, v, gain, heat);
    advect(0.25 * (out[2] - out[0]), per_mass, {{0, 3, 1, 2}, 0, 2}, beyond, v, gain, heat);
    storeHeat(block, heat);
  }

  /// The momentum that the corners gain. \return The kinetic energy before, of the pure owned cells.
  KOKKOS_FORCEINLINE_FUNCTION double moveMomentum(Block const &block, Neighbours const &beyond, Exchanged const &e,
                                                  Pack const &mass) const
  {
    PackedCorners v, gain;
    Pack share[4];
    Pack speed2 = 0.0;
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      v.x[k] = own(block, CornerColumn + 2 * k);
      v.y[k] = own(block, CornerColumn + 2 * k + 1);
      gain.x[k] = gain.y[k] = 0.0;
      Pack const square = v.x[k] * v.x[k] + v.y[k] * v.y[k];
      if (!stage.aboutAxis())
      {
        speed2 += square;
        continue;
      }
      share[k] = packOf([&](int lane) { return stage.share(block.cell[lane], k); });
      speed2 += (4.0 * share[k]) * square;
    }
    Pack const per_mass = 1.0 / mass;
    if (stage.aboutAxis())
    {
      Neighbours const around = beyond; // copies, as in findNeighbours
      PackedCorners const velocity = v;
      PackedCorners gained = gain;
      Pack const part[4] = {share[0], share[1], share[2], share[3]};
      Pack const out[4] = {e.outflow[0], e.outflow[1], e.outflow[2], e.outflow[3]};
      Pack radius[4], heat[4] = {0.0, 0.0, 0.0, 0.0};
      for (int k = 0; k < 4; ++k)
        radius[k] = packOf([&](int lane) { return stage.position(stage.cell_node(block.cell[lane], k), 0); });
      advectShares(radius, part, out, per_mass, around, velocity, gained, heat);
      gain = gained;
      if (stage.returnsHeat())
        storeHeat(block, heat);
    }
    else if (stage.returnsHeat())
    {
      Block const copy = block; // copies, as in findNeighbours
      Neighbours const around = beyond;
      PackedCorners const velocity = v;
      PackedCorners gained = gain;
      Pack const out[4] = {e.outflow[0], e.outflow[1], e.outflow[2], e.outflow[3]};
      advectWithHeat(copy, out, per_mass, around, velocity, gained);
      gain = gained;
    }
    else
    {
      advect(0.25 * (e.outflow[1] - e.outflow[3]), per_mass, {{0, 1, 3, 2}, 3, 1}, beyond, v, gain);
      advect(0.25 * (e.outflow[2] - e.outflow[0]), per_mass, {{0, 3, 1, 2}, 0, 2}, beyond, v, gain);
    }
    for (int k = 0; k < 4; ++k)
    {
      storePack(block.own + (IncrementColumn + 2 * k) * column_stride, gain.x[k]);
      storePack(block.own + (IncrementColumn + 2 * k + 1) * column_stride, gain.y[k]);
    }
    Pack const kinetic = 0.125 * mass * speed2;
    bool const owned = (block.bits & OwnedBit) != 0;
    if (owned && block.pure == all_lanes)
      return laneSum(kinetic);
    double sum = 0.0;
    for (int lane = 0; lane < pack_width; ++lane)
      if ((block.pure >> lane & 1u) != 0u && (owned || (stage.flags[block.cell[lane]] & OwnedCellBit) != 0))
        sum += laneOf(kinetic, lane);
    return sum;
  }

  /// Lanes of pure cells; the others repeat the first of those, and their pairs stay as they are.
  HARMOS_RARE_FUNCTION unsigned selectPure(int first, int (&from)[pack_width]) const
  {
    unsigned pure = 0u;
    int const count = Math::min(pack_width, end - first);
    int lead = -1;
    for (int lane = 0; lane < count; ++lane)
      if ((stage.flags[first + lane] & PureCellBit) != 0)
      {
        pure |= 1u << lane;
        lead = lead < 0 ? lane : lead;
      }
      else
        for (int pair = stage.first_pair[first + lane]; pair < stage.first_pair[first + lane + 1]; ++pair)
          copyPair(pair);
    for (int lane = 0; lane < pack_width; ++lane)
      from[lane] = (pure >> lane & 1u) != 0u ? lane : Math::max(lead, 0);
    return pure;
  }

  KOKKOS_FORCEINLINE_FUNCTION Block selectCells(int first) const
  {
    Block block;
    block.first = first;
    block.own = stage.at(0, first);
    block.bits = stage.blockOf(first);
    if ((block.bits & WholeBit) != 0)
    {
      block.pure = all_lanes;
      int const pair = stage.first_pair[first];
      for (int lane = 0; lane < pack_width; ++lane)
      {
        block.cell[lane] = first + lane;
        block.pair[lane] = pair + lane;
      }
      return block;
    }
    int from[pack_width]; // lane
    block.pure = selectPure(first, from);
    for (int lane = 0; lane < pack_width; ++lane)
    {
      block.cell[lane] = first + from[lane];
      block.pair[lane] = stage.first_pair[block.cell[lane]];
    }
    return block;
  }

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int number, double &kinetic) const
  {
    Block const block = selectCells(begin + number * pack_width);
    if (block.pure == 0u)
      return;
    writeAhead(stage.record1, block.pair[0]);
    readAhead(stage.first_pair, block.first);
    readAhead(stage.face_neighbour, block.first);
    readAhead(stage.pure_material, block.first);
    Neighbours beyond;
    GatheredFaces gathered;
    findNeighbours(block, beyond, gathered);
    Exchanged const e = exchange(block, beyond, gathered);
    Pack const mass = own(block, OldMass);
    Pack const mass1 = mass - ((e.outflow[0] + e.outflow[1]) + (e.outflow[2] + e.outflow[3]));
    storePack(block.own + NewMass * column_stride, mass1);
    newRecords(block, e, mass, mass1);
    kinetic += moveMomentum(block, beyond, e, mass);
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
