// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SWEPT_COLUMNS_HPP
#define HARMOS_SWEPT_COLUMNS_HPP

#include <detail/Harmos_StageFields.hpp>
#include <detail/Harmos_SweptStage.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// The centroids and fields beyond the faces, column by column as in the window; the cell's own where what is there
/// does not count, so that the difference is nothing and the range does not grow.
struct Columns
{
  double const *face[4];
  double const *own;

  KOKKOS_FORCEINLINE_FUNCTION Pack load(int k, int column) const { return loadPack(face[k] + column * column_stride); }
  KOKKOS_FORCEINLINE_FUNCTION Pack ofCell(int column) const { return loadPack(own + column * column_stride); }
};
using GatheredColumns = double[num_neighbour_columns][column_stride]; // face k's from 4 k on; strides as in the window

/// Finds what is beyond the faces of a block's cells.
struct ColumnGatherer
{
  SweptStage const &stage;
  int end; // of the cells

  KOKKOS_FORCEINLINE_FUNCTION Columns columnsBeyond(int first, int block, GatheredColumns &gathered) const
  {
    Columns beyond;
    beyond.own = stage.at(0, first);
    for (int k = 0; k < 4; ++k)
    {
      bool const in_run = (block & RunBit << k) != 0;
      beyond.face[k] = stage.at(CentroidX, stage.second_order && in_run ? stage.face_neighbour(first, k) >> 2 : first);
      if (!stage.second_order || in_run)
        continue;
      if ((block & AcrossBit << k) != 0)
      {
        int const cell = stage.face_neighbour(first, k) >> 2, rows = stage.rowsLeft(cell);
        joinColumns(stage.at(CentroidX, cell), stage.at(CentroidX, cell + rows), rows, num_neighbour_columns,
                    &gathered[0][k * pack_width]);
      }
      else
        gather(first, k, gathered);
      beyond.face[k] = &gathered[0][k * pack_width];
    }
    return beyond;
  }

  /// Lane by lane, where the neighbours beyond a face are no run of cells, in the order of the faces.
  HARMOS_RARE_FUNCTION void gather(int first, int k, GatheredColumns &gathered) const
  {
    int const count = Math::min(pack_width, end - first);
    for (int lane = 0; lane < pack_width; ++lane)
    {
      int const cell = first + lane;
      bool const same = lane < count && stage.sameBeyond(cell, k);
      double const *column = stage.at(CentroidX, same ? stage.face_neighbour(cell, k) >> 2 : cell);
      for (int c = 0; c < num_neighbour_columns; ++c, column += column_stride)
        gathered[c][k * pack_width + lane] = *column;
      Vector2 normal;
      if (!same && lane < count && stage.pure_material[cell] >= 0 && stage.mirrorsAt(cell, k, normal))
        mirror(stage.cell_node(cell, k), normal, k * pack_width + lane, gathered);
    }
  }

  /// What is gathered for a lane, the cell's own, becomes its image beyond a wall through a node.
  KOKKOS_INLINE_FUNCTION void mirror(int node, Vector2 const &normal, int lane, GatheredColumns &gathered) const
  {
    double &x = gathered[CentroidX][lane], &y = gathered[CentroidX + 1][lane];
    double const across = 2.0 * ((x - stage.position(node, 0)) * normal[0] + (y - stage.position(node, 1)) * normal[1]);
    x -= across * normal[0];
    y -= across * normal[1];
    mirrorTensor(normal, gathered[FieldColumn + DeviatorXX][lane], gathered[FieldColumn + DeviatorXY][lane],
                 gathered[FieldColumn + DeviatorYY][lane]);
  }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
