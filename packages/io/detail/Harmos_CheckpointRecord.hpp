// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CHECKPOINT_RECORD_HPP
#define HARMOS_CHECKPOINT_RECORD_HPP

#include <Harmos_Checkpoint.hpp>

#include <detail/Harmos_GlobalOrder.hpp>
#include <detail/Harmos_Hdf5File.hpp>

#include <cstring>

namespace Harmos
{

/// Number of the layout; raised with every change that an older reader would misread.
constexpr int checkpoint_format = 4;

/// A sum over elements of a mixed hash of (bits, index) modulo 2^64: any order and any split give the same number, any
/// change of a bit or an exchange of two elements another one.
class Checksum
{
public:
  template <class T>
  void add(std::vector<T> const &value, long long first_element)
  {
    for (std::size_t i = 0; i < value.size(); ++i)
    {
      unsigned long long bits = 0;
      std::memcpy(&bits, &value[i], sizeof(T));
      sum_ += mix(bits ^ mix(static_cast<unsigned long long>(first_element) + i + 1));
    }
  }
  unsigned long long value() const { return sum_; }

private:
  /// The finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
  static unsigned long long mix(unsigned long long x)
  {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }
  unsigned long long sum_ = 0;
};

/// Write an arranged array with its checksum as an attribute. Collective; empty arrays are left out.
template <class T>
void writeChecked(Hdf5File &file, GlobalOrder const &order, std::string const &name, std::vector<T> const &value,
                  int width)
{
  if (order.total() == 0)
    return;
  file.write(name, value, width, order.first(), order.total());
  Checksum checksum;
  checksum.add(value, order.first() * width);
  unsigned long long sum = checksum.value();
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, order.comm());
  file.writeAttribute(name, "checksum", sum);
}

void writeScalars(Hdf5File &file, MPI_Comm comm, CheckpointScalars const &scalars);

} // namespace Harmos

#endif
