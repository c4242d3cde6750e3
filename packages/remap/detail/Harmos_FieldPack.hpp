// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FIELD_PACK_HPP
#define HARMOS_FIELD_PACK_HPP

#include <Harmos_Kokkos.hpp>

#include <cstring>
#include <utility>

namespace Harmos
{
namespace RemapDetail
{

// Compilers do not vectorise the short loops over a record's fields. Their own vector type, as wide as the machine's
// registers, makes them do it; where there is none (devices) the loops stay scalar.
#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__HIPCC__) && !defined(__SYCL_DEVICE_ONLY__)
#define HARMOS_FIELD_VECTORS
#endif

/// The eight fields of a record as one value, with arithmetic by field.
struct FieldPack
{
  static constexpr int fields = 8;
#ifdef HARMOS_FIELD_VECTORS
#if defined(__AVX512F__)
  static constexpr int width = 8;
#elif defined(__AVX__)
  static constexpr int width = 4;
#else
  static constexpr int width = 2;
#endif
  typedef double Lanes __attribute__((vector_size(width * sizeof(double))));
  KOKKOS_INLINE_FUNCTION static Lanes lanes(double x)
  {
    return x - Lanes{};
  }
  KOKKOS_INLINE_FUNCTION static Lanes least(Lanes const &a, Lanes const &b)
  {
    return a < b ? a : b;
  }
  KOKKOS_INLINE_FUNCTION static Lanes choose(Lanes const &a, Lanes const &b, Lanes const &x, Lanes const &y)
  {
    return a < b ? x : y;
  }
#else
  static constexpr int width = 1;
  typedef double Lanes;
  KOKKOS_INLINE_FUNCTION static Lanes lanes(double x)
  {
    return x;
  }
  KOKKOS_INLINE_FUNCTION static Lanes least(Lanes a, Lanes b)
  {
    return a < b ? a : b;
  }
  KOKKOS_INLINE_FUNCTION static Lanes choose(Lanes a, Lanes b, Lanes x, Lanes y)
  {
    return a < b ? x : y;
  }
#endif
  static constexpr int parts = fields / width;
  Lanes part[parts];

  using Lane = std::make_integer_sequence<int, width>;
#if defined(HARMOS_FIELD_VECTORS) && (defined(__clang__) || __GNUC__ >= 12)
  template <int At, int... L>
  KOKKOS_INLINE_FUNCTION static Lanes replaced(Lanes const &a, double x, std::integer_sequence<int, L...>)
  {
    return __builtin_shufflevector(a, lanes(x), (L == At ? width + L : L)...);
  }
#elif defined(HARMOS_FIELD_VECTORS)
  template <int At, int... L>
  KOKKOS_INLINE_FUNCTION static Lanes replaced(Lanes a, double x, std::integer_sequence<int, L...>)
  {
    a[At] = x;
    return a;
  }
#else
  template <int At, int... L>
  KOKKOS_INLINE_FUNCTION static Lanes replaced(Lanes, double x, std::integer_sequence<int, L...>)
  {
    return x;
  }
#endif

  KOKKOS_INLINE_FUNCTION FieldPack() {}
  KOKKOS_INLINE_FUNCTION explicit FieldPack(double x)
  {
    for (int p = 0; p < parts; ++p)
      part[p] = lanes(x);
  }
  KOKKOS_INLINE_FUNCTION explicit FieldPack(double const *x)
  {
    for (int p = 0; p < parts; ++p)
      std::memcpy(&part[p], x + p * width, sizeof(Lanes));
  }
#ifdef HARMOS_FIELD_VECTORS
  KOKKOS_INLINE_FUNCTION double operator[](int field) const { return part[field / width][field % width]; }
#else
  KOKKOS_INLINE_FUNCTION double operator[](int field) const { return part[field]; }
#endif
  /// One field replaced, within registers: a value stored into a vector in memory would hold up the next load of it.
  template <int Field>
  KOKKOS_INLINE_FUNCTION void set(double x)
  {
    part[Field / width] = replaced<Field % width>(part[Field / width], x, Lane());
  }
  KOKKOS_INLINE_FUNCTION void store(double *x) const
  {
    for (int p = 0; p < parts; ++p)
      std::memcpy(x + p * width, &part[p], sizeof(Lanes));
  }
  KOKKOS_INLINE_FUNCTION FieldPack &operator+=(FieldPack const &b)
  {
    for (int p = 0; p < parts; ++p)
      part[p] += b.part[p];
    return *this;
  }
  KOKKOS_INLINE_FUNCTION FieldPack &operator-=(FieldPack const &b)
  {
    for (int p = 0; p < parts; ++p)
      part[p] -= b.part[p];
    return *this;
  }
  KOKKOS_INLINE_FUNCTION FieldPack &operator*=(FieldPack const &b)
  {
    for (int p = 0; p < parts; ++p)
      part[p] *= b.part[p];
    return *this;
  }
  KOKKOS_INLINE_FUNCTION FieldPack &operator/=(FieldPack const &b)
  {
    for (int p = 0; p < parts; ++p)
      part[p] /= b.part[p];
    return *this;
  }
};

KOKKOS_INLINE_FUNCTION FieldPack operator+(FieldPack a, FieldPack const &b)
{
  return a += b;
}
KOKKOS_INLINE_FUNCTION FieldPack operator-(FieldPack a, FieldPack const &b)
{
  return a -= b;
}
KOKKOS_INLINE_FUNCTION FieldPack operator*(FieldPack a, FieldPack const &b)
{
  return a *= b;
}
KOKKOS_INLINE_FUNCTION FieldPack operator*(double a, FieldPack const &b)
{
  return FieldPack(a) *= b;
}
KOKKOS_INLINE_FUNCTION FieldPack operator/(FieldPack a, FieldPack const &b)
{
  return a /= b;
}

KOKKOS_INLINE_FUNCTION FieldPack min(FieldPack const &a, FieldPack const &b)
{
  FieldPack r;
  for (int p = 0; p < FieldPack::parts; ++p)
    r.part[p] = FieldPack::least(a.part[p], b.part[p]);
  return r;
}

KOKKOS_INLINE_FUNCTION FieldPack max(FieldPack const &a, FieldPack const &b)
{
  FieldPack r;
  for (int p = 0; p < FieldPack::parts; ++p)
    r.part[p] = FieldPack::choose(a.part[p], b.part[p], b.part[p], a.part[p]);
  return r;
}

/// x where a < b, else y.
KOKKOS_INLINE_FUNCTION FieldPack select(FieldPack const &a, FieldPack const &b, FieldPack const &x, FieldPack const &y)
{
  FieldPack r;
  for (int p = 0; p < FieldPack::parts; ++p)
    r.part[p] = FieldPack::choose(a.part[p], b.part[p], x.part[p], y.part[p]);
  return r;
}

/// Whether a < b in any field.
KOKKOS_INLINE_FUNCTION bool anyLess(FieldPack const &a, FieldPack const &b)
{
  bool any = false;
#ifdef HARMOS_FIELD_VECTORS
  auto mask = a.part[0] < b.part[0];
  for (int p = 1; p < FieldPack::parts; ++p)
    mask |= a.part[p] < b.part[p];
  for (int lane = 0; lane < FieldPack::width; ++lane)
    any = any || mask[lane] != 0;
#else
  for (int p = 0; p < FieldPack::parts; ++p)
    any = any || a.part[p] < b.part[p];
#endif
  return any;
}

/// The weights of a record's fields: volume for density and deviator, mass for the primitives.
KOKKOS_INLINE_FUNCTION FieldPack fieldWeights(double volume, double mass)
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
