// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ROW_POINTER_HPP
#define HARMOS_ROW_POINTER_HPP

#include <Harmos_Kokkos.hpp>

namespace Harmos
{

/// A View of rows of N values, for the kernels over all cells: the row's length is known to the compiler there, where a
/// View multiplies by a stride that it reads, which is half of such a kernel's instructions.
///
/// Does not own its memory: a View must outlive it. The View's rows are contiguous (no padding, LayoutRight).
template <class T, int N>
class RowPointer
{
public:
  RowPointer() = default;
  RowPointer(View<T *[N]> const &view) : data_(view.data()) {}

  KOKKOS_FORCEINLINE_FUNCTION T &operator()(int i, int j) const
  {
    return data_[static_cast<std::ptrdiff_t>(i) * N + j];
  }
  KOKKOS_FORCEINLINE_FUNCTION T *row(int i) const { return data_ + static_cast<std::ptrdiff_t>(i) * N; }

private:
  T *data_ = nullptr;
};

} // namespace Harmos

#endif
