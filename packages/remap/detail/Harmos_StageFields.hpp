// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_STAGE_FIELDS_HPP
#define HARMOS_STAGE_FIELDS_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <detail/Harmos_FieldPack.hpp>
#include <detail/Harmos_SweptStage.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Fields of stage 2: StageField and PairField in one numbering, then the velocities of the four corners.
/// Enumerators, since Views take their indices by reference: CUDA's device code cannot refer to a host's constant.
enum StageFieldCount : int
{
  first_corner_field = 8, // u, v of corner 0, 1, 2, 3
  num_stage_fields = 16
};

/// One value of every field.
struct StageFields
{
  FieldPack record, corner;

  KOKKOS_FORCEINLINE_FUNCTION StageFields &operator+=(StageFields const &b)
  {
    record += b.record;
    corner += b.corner;
    return *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION StageFields &operator-=(StageFields const &b)
  {
    record -= b.record;
    corner -= b.corner;
    return *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(double *row) const
  {
    record.store(row);
    corner.store(row + first_corner_field);
  }
};

KOKKOS_FORCEINLINE_FUNCTION StageFields stageFields(double value)
{
  return {FieldPack(value), FieldPack(value)};
}
KOKKOS_FORCEINLINE_FUNCTION StageFields loadStageFields(double const *row)
{
  return {FieldPack(row), FieldPack(row + first_corner_field)};
}
KOKKOS_FORCEINLINE_FUNCTION StageFields operator-(StageFields a, StageFields const &b)
{
  return a -= b;
}

/// Add weight * b.
KOKKOS_FORCEINLINE_FUNCTION void addTimes(StageFields &a, double weight, StageFields const &b)
{
  FieldPack const w(weight);
  a.record += w * b.record;
  a.corner += w * b.corner;
}

KOKKOS_FORCEINLINE_FUNCTION void scale(StageFields &a, double factor)
{
  scale(a.record, factor);
  scale(a.corner, factor);
}
/// Zero of a type of fields.
KOKKOS_FORCEINLINE_FUNCTION StageFields zero(StageFields const &)
{
  return stageFields(0.0);
}

/// The values of another cell's corners in the order of one's own, which lag by `rotation`.
KOKKOS_FORCEINLINE_FUNCTION FieldPack rotatedCorners(double const *corner, int rotation)
{
  if (rotation == 0)
    return FieldPack(corner);
  double turned[8];
  for (int i = 0; i < 8; ++i)
    turned[i] = corner[(i + 2 * rotation) & 7];
  return FieldPack(turned);
}

} // namespace RemapDetail
} // namespace Harmos

#endif
