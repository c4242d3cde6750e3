// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_NEIGHBOUR_FACES_HPP
#define HARMOS_NEIGHBOUR_FACES_HPP

#include <detail/Harmos_EdgeMomentum.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// The columns of a face, then x, y of the two velocities; those of face k from lane pack_width k on. From lane
/// pack_width (4 + i) on: what enters through two opposite faces together.
using GatheredFaces = double[num_face_columns + 4][column_stride];

/// What lies beyond the faces of a block of cells, for the gather of stage 1.
struct NeighbourFaces
{
  SweptStage stage;

  /// Lane by lane, where the neighbours beyond a face are no run of cells, in the order of the faces.
  HARMOS_RARE_FUNCTION void gatherFace(int const cells[pack_width], int k, GatheredFaces &gathered) const
  {
    for (int i = 0; i < pack_width; ++i)
    {
      int const cell = cells[i], lane = k * pack_width + i;
      bool const same = stage.sameBeyond(cell, k);
      int const face = same ? stage.face_neighbour(cell, k) : 4 * cell + k;
      gathered[0][lane] = same ? stage.sweptOut(face >> 2, face & 3) : 0.0;
      double const *column = stage.at(FaceColumn + 1 + num_face_columns * stage.slotOf(face >> 2, face & 3), face >> 2);
      for (int c = 1; c < num_face_columns; ++c, column += column_stride)
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
    int const swept = sweptColumn(face) * column_stride, fluxes = fluxColumn(face) * column_stride;
    joinColumns(begin + swept, rest + swept, rows, 1, joined);
    joinColumns(begin + fluxes, rest + fluxes, rows, num_face_columns - 1, joined + column_stride);
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

  KOKKOS_FORCEINLINE_FUNCTION static int sweptColumn(int face) { return FaceColumn + num_face_columns * (face & 3); }
  /// Of the first slot.
  KOKKOS_FORCEINLINE_FUNCTION static int fluxColumn(int face) { return FaceColumn + 1 + num_face_columns * (face & 1); }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
