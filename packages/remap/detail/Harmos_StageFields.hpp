// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_STAGE_FIELDS_HPP
#define HARMOS_STAGE_FIELDS_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_SlipMirrors.hpp>
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

/// A symmetric tensor as seen in a mirror: R T R with R = 1 - 2 n n.
KOKKOS_INLINE_FUNCTION void mirrorTensor(Vector2 const &n, double &xx, double &xy, double &yy)
{
  double const x = 1.0 - 2.0 * n[0] * n[0], y = 1.0 - 2.0 * n[1] * n[1], z = -2.0 * n[0] * n[1];
  double const s = xx, t = yy, u = xy;
  xx = x * x * s + 2.0 * x * z * u + z * z * t;
  yy = z * z * s + 2.0 * z * y * u + y * y * t;
  xy = x * z * s + (x * y + z * z) * u + z * y * t;
}

/// Fields of a cell's image across the wall on face k: corner k of it, as seen from the cell, is that of k - 1.
KOKKOS_INLINE_FUNCTION void mirrorFields(StageFields &q, Vector2 const &normal, int k)
{
  double v[8], image[8], r[8];
  q.corner.store(v);
  int const from[4] = {(k + 3) & 3, (k + 2) & 3, (k + 1) & 3, k};
  for (int i = 0; i < 4; ++i)
  {
    int const to = (k + i) & 3;
    double const through = 2.0 * (v[2 * from[i]] * normal[0] + v[2 * from[i] + 1] * normal[1]);
    image[2 * to] = v[2 * from[i]] - through * normal[0];
    image[2 * to + 1] = v[2 * from[i] + 1] - through * normal[1];
  }
  q.corner = FieldPack(image);
  q.record.store(r);
  mirrorTensor(normal, r[DeviatorXX], r[DeviatorXY], r[DeviatorYY]);
  q.record = FieldPack(r);
}

} // namespace RemapDetail
} // namespace Harmos

#endif
