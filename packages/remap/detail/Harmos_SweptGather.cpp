// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_LoadPoints.hpp>
#include <Harmos_Prefetch.hpp>
#include <Harmos_Select.hpp>
#include <detail/Harmos_EdgeMomentum.hpp>
#include <detail/Harmos_FieldPack.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// The columns of a face, then x, y of the two velocities; those of face k from lane pack_width k on.
using GatheredFaces = double[num_face_columns + 4][column_stride];

struct SweptGatherFunctor
{
  SweptStage stage;
  int begin, end;

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
    LaneMask enters[4]; // something does, through each face
    int entering;       // 1 << k: through face k of some cell
    Pack outflow[4];    // mass that leaves through each face
    Pack volume;        // after
    Pack flow;          // zero where nothing moves
  };

  KOKKOS_FORCEINLINE_FUNCTION static Pack own(Block const &block, int column)
  {
    return loadPack(block.own + column * column_stride);
  }

  /// Lane by lane, where the neighbours beyond a face are no run of cells, in the order of the faces.
  HARMOS_RARE_FUNCTION void gatherFace(Block const &block, int k, GatheredFaces &gathered) const
  {
    for (int i = 0; i < pack_width; ++i)
    {
      int const cell = block.cell[i], lane = k * pack_width + i;
      bool const same = stage.sameBeyond(cell, k);
      int const face = same ? stage.face_neighbour(cell, k) : 4 * cell + k;
      double const *column = stage.at(FaceColumn + num_face_columns * (face & 3), face >> 2);
      for (int c = 0; c < num_face_columns; ++c, column += column_stride)
        gathered[c][lane] = same ? *column : 0.0;
      int const mixed = same || !stage.second_order ? -1 : mixedPairBeyond(cell, k);
      if (mixed >= 0)
      {
        gatherMixed(mixed, stage.face_neighbour(cell, k), lane, gathered);
        continue;
      }
      bool const goes_beyond = same && stage.second_order;
      int const from = goes_beyond ? face >> 2 : cell;
      bool const ends = !same && stage.second_order && stage.face_neighbour(cell, k) < 0;
      for (int j = 0; j < 2; ++j)
      {
        if (ends && mirrorBeyond(cell, k, j, lane, gathered))
          continue;
        double const *velocity = stage.at(velocityColumn(face, k, j, goes_beyond), from);
        gathered[num_face_columns + 2 * j][lane] = velocity[0];
        gathered[num_face_columns + 2 * j + 1][lane] = velocity[column_stride];
      }
    }
  }

  /// The same where they are a run of cells on two tiles.
  HARMOS_RARE_FUNCTION void joinFace(int first, int k, GatheredFaces &gathered) const
  {
    int const face = stage.face_neighbour(first, k), rows = stage.rowsLeft(face >> 2);
    double const *const begin = stage.at(0, face >> 2), *const rest = stage.at(0, (face >> 2) + rows);
    double *const joined = &gathered[0][k * pack_width];
    int const columns = (FaceColumn + num_face_columns * (face & 3)) * column_stride;
    joinColumns(begin + columns, rest + columns, rows, num_face_columns, joined);
    bool const goes_beyond = stage.second_order;
    for (int i = 0; i < 2; ++i)
    {
      int const column = velocityColumn(face, k, i, goes_beyond) * column_stride;
      double *const velocity = joined + (num_face_columns + 2 * i) * column_stride;
      if (goes_beyond)
        joinColumns(begin + column, rest + column, rows, 2, velocity);
      else
        joinColumns(stage.at(0, first) + column, stage.at(0, first) + column, 0, 2, velocity);
    }
  }

  /// The pair of a pure cell's material in a mixed cell beyond a face; -1: none.
  KOKKOS_INLINE_FUNCTION int mixedPairBeyond(int cell, int k) const
  {
    int const neighbour = stage.face_neighbour(cell, k) >> 2;
    if (neighbour < 0)
      return -1;
    for (int pair = stage.first_pair[neighbour]; pair < stage.first_pair[neighbour + 1]; ++pair)
      if (stage.pair_material[pair] == stage.pure_material[cell])
        return pair;
    return -1;
  }

  /// Beyond a wall at rest along which the node k + i of face k slips: the velocity of the node behind it, mirrored, so
  /// that what grows from zero away from the wall keeps its slope there. \return false: no such wall.
  KOKKOS_INLINE_FUNCTION bool mirrorBeyond(int cell, int k, int i, int lane, GatheredFaces &gathered) const
  {
    int const a = stage.cell_node(cell, k), b = stage.cell_node(cell, (k + 1) & 3);
    int const condition = stage.node_condition[i == 0 ? a : b];
    if (condition < 0)
      return false;
    Vector2 const along =
        normalised(Vector2{stage.position(b, 0) - stage.position(a, 0), stage.position(b, 1) - stage.position(a, 1)});
    Vector2 const normal{along[1], -along[0]};
    NodeCondition const &wall = stage.condition[condition];
    bool slips = false;
    for (int j = 0; j < wall.count; ++j)
      slips = slips || (wall.value[j] == 0.0 && Math::fabs(cross(wall.normal[j], normal)) < 1e-12);
    if (!slips)
      return false;
    int const inner = i == 0 ? (k + 3) & 3 : (k + 2) & 3;
    double const *velocity = stage.at(CornerColumn + 2 * inner, cell);
    Vector2 const v{velocity[0], velocity[column_stride]};
    Vector2 const mirrored = v - (2.0 * dot(v, normal)) * normal;
    gathered[num_face_columns + 2 * i][lane] = mirrored[0];
    gathered[num_face_columns + 2 * i + 1][lane] = mirrored[1];
    return true;
  }

  KOKKOS_INLINE_FUNCTION void gatherMixed(int pair, int face, int lane, GatheredFaces &gathered) const
  {
    for (int i = 0; i < 2; ++i)
    {
      int const dof = stage.dof_node(pair, beyondCorner(face, i));
      gathered[num_face_columns + 2 * i][lane] = stage.half(dof, 0);
      gathered[num_face_columns + 2 * i + 1][lane] = stage.half(dof, 1);
    }
  }

  /// Corner of the neighbour at its face f, beyond our node k + i of face k. Our node k is its f + 1, beyond it f + 2;
  /// our k + 1 is its f, beyond it f + 3.
  KOKKOS_FORCEINLINE_FUNCTION static int beyondCorner(int face, int i) { return (face + 2 + i) & 3; }

  /// Of the velocity beyond our node k + i of face k, or of that node's own.
  KOKKOS_FORCEINLINE_FUNCTION static int velocityColumn(int face, int k, int i, bool goes_beyond)
  {
    return CornerColumn + 2 * (goes_beyond ? beyondCorner(face, i) : (k + i) & 3);
  }

  KOKKOS_FORCEINLINE_FUNCTION void findNeighbours(Block const &block, Neighbours &beyond, GatheredFaces &gathered) const
  {
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      double const *velocity[2];
      if ((block.bits & RunBit << k) != 0)
      {
        int const face = stage.face_neighbour(block.first, k);
        double const *const cell = stage.at(0, face >> 2);
        beyond.face[k] = cell + (FaceColumn + num_face_columns * (face & 3)) * column_stride;
        double const *const from = stage.second_order ? cell : block.own;
        for (int i = 0; i < 2; ++i)
          velocity[i] = from + velocityColumn(face, k, i, stage.second_order) * column_stride;
      }
      else
      {
        if ((block.bits & AcrossBit << k) != 0)
          joinFace(block.first, k, gathered);
        else
        {
          Block const copy = block; // what a call sees would leave its registers for all blocks
          gatherFace(copy, k, gathered);
        }
        beyond.face[k] = &gathered[0][k * pack_width];
        for (int i = 0; i < 2; ++i)
          velocity[i] = &gathered[num_face_columns + 2 * i][k * pack_width];
      }
      for (int i = 0; i < 2; ++i)
      {
        beyond.velocity_x[k][i] = loadPack(velocity[i]);
        beyond.velocity_y[k][i] = loadPack(velocity[i] + column_stride);
      }
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

  KOKKOS_FORCEINLINE_FUNCTION static bool leaves(Block const &block, int k)
  {
    return (block.bits & LeaveBit << k) != 0;
  }

  KOKKOS_FORCEINLINE_FUNCTION static Exchanged exchange(Block const &block, Neighbours const &beyond)
  {
    Exchanged e;
    e.volume = own(block, MovedVolume);
    e.flow = 0.0;
    e.entering = 0;
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      e.outflow[k] = 0.0;
      int const face = FaceColumn + num_face_columns * k;
      if (leaves(block, k))
      {
        Pack const volume = own(block, face);
        e.flow += volume;
        e.volume -= volume;
        e.outflow[k] = own(block, face + 1 + DensityField);
      }
      Pack const swept = beyond.load(k, 0);
      e.enters[k] = swept > Pack(0.0);
      if (!any(e.enters[k]))
        continue;
      e.entering |= 1 << k;
      e.flow += swept;
      e.volume += swept;
      e.outflow[k] -= select(e.enters[k], beyond.load(k, 1 + DensityField), Pack(0.0));
    }
    return e;
  }

  /// What all fluxes bring of a field.
  KOKKOS_FORCEINLINE_FUNCTION static Pack changeOf(int field, Block const &block, Neighbours const &beyond,
                                                   Exchanged const &e)
  {
    Pack change = 0.0;
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      if (leaves(block, k))
        change -= own(block, FaceColumn + num_face_columns * k + 1 + field);
      if ((e.entering & 1 << k) != 0)
        change += select(e.enters[k], beyond.load(k, 1 + field), Pack(0.0));
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

  KOKKOS_FORCEINLINE_FUNCTION void newRecords(Block const &block, Neighbours const &beyond, Exchanged const &e,
                                              Pack const &mass, Pack const &mass1) const
  {
    Pack const moved_volume = own(block, MovedVolume);
    Pack const per_mass = 1.0 / mass1, per_volume = 1.0 / e.volume;
    Pack q[num_pair_fields];
    forFields(
        [&](int f)
        {
          bool const by_volume = f >= DeviatorXX;
          q[f] = ((by_volume ? moved_volume : mass) * own(block, FieldColumn + f) + changeOf(f, block, beyond, e)) *
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
    if (stage.all_owned && block.pure == all_lanes)
      return laneSum(kinetic);
    double sum = 0.0;
    for (int lane = 0; lane < pack_width; ++lane)
      if ((block.pure >> lane & 1u) != 0u && stage.cell_depth[block.cell[lane]] == 0)
        sum += laneOf(kinetic, lane);
    return sum;
  }

  /// Lanes of pure cells; the others repeat the first of those, and their pairs stay as they are.
  KOKKOS_FORCEINLINE_FUNCTION unsigned selectPure(int first, int (&from)[pack_width]) const
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
    int from[pack_width]; // lane
    for (int lane = 0; lane < pack_width; ++lane)
      from[lane] = lane;
    if ((block.bits & WholeBit) != 0)
      block.pure = all_lanes;
    else
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
    Exchanged const e = exchange(block, beyond);
    Pack const mass = own(block, OldMass);
    Pack const mass1 = mass - ((e.outflow[0] + e.outflow[1]) + (e.outflow[2] + e.outflow[3]));
    storePack(block.own + NewMass * column_stride, mass1);
    newRecords(block, beyond, e, mass, mass1);
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
