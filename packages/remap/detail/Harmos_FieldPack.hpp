// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FIELD_PACK_HPP
#define HARMOS_FIELD_PACK_HPP

#include <Harmos_Pack.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// The eight fields of one record as a value, with arithmetic by field.
struct FieldPack
{
  static constexpr int fields = 8;
  static constexpr int parts = fields / pack_width;
  Pack part[parts];

  FieldPack() = default;
  KOKKOS_FORCEINLINE_FUNCTION explicit FieldPack(double x)
  {
    for (int p = 0; p < parts; ++p)
      part[p] = x;
  }
  KOKKOS_FORCEINLINE_FUNCTION explicit FieldPack(double const *x)
  {
    for (int p = 0; p < parts; ++p)
      part[p] = loadPack(x + p * pack_width);
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(double *x) const
  {
    for (int p = 0; p < parts; ++p)
      storePack(x + p * pack_width, part[p]);
  }
  KOKKOS_FORCEINLINE_FUNCTION double operator[](int field) const
  {
    return laneOf(part[field / pack_width], field % pack_width);
  }
  template <int Field>
  KOKKOS_FORCEINLINE_FUNCTION void set(double x)
  {
    part[Field / pack_width] = withLane<Field % pack_width>(part[Field / pack_width], x);
  }
  KOKKOS_FORCEINLINE_FUNCTION FieldPack &operator+=(FieldPack const &b)
  {
    for (int p = 0; p < parts; ++p)
      part[p] += b.part[p];
    return *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION FieldPack &operator-=(FieldPack const &b)
  {
    for (int p = 0; p < parts; ++p)
      part[p] -= b.part[p];
    return *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION FieldPack &operator*=(FieldPack const &b)
  {
    for (int p = 0; p < parts; ++p)
      part[p] = part[p] * b.part[p];
    return *this;
  }
};

KOKKOS_FORCEINLINE_FUNCTION FieldPack operator+(FieldPack a, FieldPack const &b)
{
  return a += b;
}
KOKKOS_FORCEINLINE_FUNCTION FieldPack operator-(FieldPack a, FieldPack const &b)
{
  return a -= b;
}
KOKKOS_FORCEINLINE_FUNCTION FieldPack operator*(FieldPack a, FieldPack const &b)
{
  return a *= b;
}

/// Add weight * b.
KOKKOS_FORCEINLINE_FUNCTION void addTimes(FieldPack &a, double weight, FieldPack const &b)
{
  a += FieldPack(weight) * b;
}
KOKKOS_FORCEINLINE_FUNCTION void scale(FieldPack &a, double factor)
{
  a *= FieldPack(factor);
}
KOKKOS_FORCEINLINE_FUNCTION FieldPack zero(FieldPack const &)
{
  return FieldPack(0.0);
}

KOKKOS_FORCEINLINE_FUNCTION FieldPack lesser(FieldPack a, FieldPack const &b)
{
  for (int p = 0; p < FieldPack::parts; ++p)
    a.part[p] = Math::min(a.part[p], b.part[p]);
  return a;
}
KOKKOS_FORCEINLINE_FUNCTION FieldPack greater(FieldPack a, FieldPack const &b)
{
  for (int p = 0; p < FieldPack::parts; ++p)
    a.part[p] = Math::max(a.part[p], b.part[p]);
  return a;
}

/// The weights of a record's fields: volume for density and deviator, mass for the primitives.
KOKKOS_FORCEINLINE_FUNCTION FieldPack fieldWeights(double volume, double mass)
{
  FieldPack w(volume);
  w.set<1>(mass);
  w.set<2>(mass);
  w.set<3>(mass);
  w.set<4>(mass);
  return w;
}

} // namespace RemapDetail
} // namespace Harmos

#endif
