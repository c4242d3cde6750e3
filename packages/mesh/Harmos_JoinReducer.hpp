// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_JOIN_REDUCER_HPP
#define HARMOS_JOIN_REDUCER_HPP

#include <Harmos_Kokkos.hpp>

namespace Harmos
{

/// Kokkos reducer for a small struct whose default value is the identity and whose `join(other)` merges in another.
///
/// The volatile overload is what Kokkos 3 asks for; the objects behind it are not volatile themselves.
template <class Value>
class JoinReducer
{
public:
  using reducer = JoinReducer;
  using value_type = Value;
  using result_view_type = Kokkos::View<Value, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

  explicit JoinReducer(Value &result) : value_(&result) {}

  KOKKOS_INLINE_FUNCTION void join(Value &destination, Value const &source) const { destination.join(source); }
  KOKKOS_INLINE_FUNCTION void join(volatile Value &destination, volatile Value const &source) const
  {
    const_cast<Value &>(destination).join(const_cast<Value const &>(source));
  }
  KOKKOS_INLINE_FUNCTION void init(Value &value) const { value = Value(); }
  KOKKOS_INLINE_FUNCTION Value &reference() const { return *value_.data(); }
  KOKKOS_INLINE_FUNCTION result_view_type view() const { return value_; }
  KOKKOS_INLINE_FUNCTION bool references_scalar() const { return true; }

private:
  result_view_type value_;
};

} // namespace Harmos

#endif
