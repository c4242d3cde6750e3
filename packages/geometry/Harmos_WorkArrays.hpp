// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_WORK_ARRAYS_HPP
#define HARMOS_WORK_ARRAYS_HPP

#include <Harmos_Launch.hpp>

#include <algorithm>
#include <memory>

namespace Harmos
{

/// \brief Where the arrays of a step come from: memory that is kept from one call of the step to the next.
///
/// An array of its own costs some 1,500 instructions to make and to free, and lies in memory that no cache holds. After
/// begin() arrays are pieces of one block instead, which grows to what a call needs; they are valid until the next
/// begin(). Before the first begin() arrays own their memory, as Views do: nobody needs to keep anything.
/// Copies share the memory.
class WorkArrays
{
public:
  /// A call of the step begins: the arrays of the last one are void.
  void begin()
  {
    if (!memory_)
      memory_ = std::make_shared<Memory>();
    memory_->begin();
  }

  /// An array that the next kernel fills. \param extents The View's dynamic ones.
  template <class T, class... Extents>
  View<T> unset(char const *label, Extents... extents) const
  {
    if (!memory_)
      return View<T>(Kokkos::view_alloc(Kokkos::WithoutInitializing, std::string(label)), extents...);
    std::size_t const bytes = View<T>::required_allocation_size(static_cast<std::size_t>(extents)...);
    return View<T>(reinterpret_cast<typename View<T>::pointer_type>(memory_->take(bytes)), extents...);
  }

  /// An array of zeros.
  template <class T, class... Extents>
  View<T> zeros(char const *label, Extents... extents) const
  {
    if (!memory_)
      return View<T>(std::string(label), extents...);
    View<T> const view = unset<T>(label, extents...);
    constexpr int piece = 256; // compilers make one call of each
    auto *const value = view.data();
    int const count = static_cast<int>(view.span());
    launchFor(
        "Harmos::zeros", (count + piece - 1) / piece, KOKKOS_LAMBDA(int p) {
          int const end = p * piece + piece < count ? p * piece + piece : count;
          for (int i = p * piece; i < end; ++i)
            value[i] = {};
        });
    return view;
  }

  /// The values in the device's memory, in their order.
  template <class T>
  View<T *> copyOf(char const *label, std::vector<T> const &values) const
  {
    View<T *> const view = unset<T *>(label, values.size());
    Kokkos::View<T const *, Kokkos::HostSpace, Kokkos::MemoryUnmanaged> const host(values.data(), values.size());
    launchCopy(view, host);
    return view;
  }

private:
  struct Memory
  {
    static constexpr std::size_t alignment = 128; // two cache lines; what devices ask for
    std::vector<View<char *>> block;              // in the order of their making; the last is not full
    std::size_t used = 0;                         // of the last block

    static View<char *> newBlock(std::size_t bytes)
    {
      return View<char *>(Kokkos::view_alloc(Kokkos::WithoutInitializing, std::string("Harmos::work_arrays")),
                          bytes + alignment);
    }

    /// One block in the place of several.
    void begin()
    {
      used = 0;
      if (block.size() < 2)
        return;
      std::size_t total = 0;
      for (View<char *> const &b : block)
        total += b.extent(0);
      block.clear();
      block.push_back(newBlock(total));
    }

    char *take(std::size_t bytes)
    {
      bytes = (bytes + alignment - 1) / alignment * alignment;
      if (block.empty() || used + bytes + alignment > block.back().extent(0))
      {
        constexpr std::size_t least = 1 << 16;
        block.push_back(newBlock(std::max({bytes, least, block.empty() ? 0 : 2 * block.back().extent(0)})));
        used = 0;
      }
      char *const first = block.back().data();
      std::size_t const skip = (alignment - reinterpret_cast<std::size_t>(first) % alignment) % alignment;
      char *const piece = first + skip + used;
      used += bytes;
      return piece;
    }
  };

  std::shared_ptr<Memory> memory_;
};

} // namespace Harmos

#endif
