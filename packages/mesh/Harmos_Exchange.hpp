// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_EXCHANGE_HPP
#define HARMOS_EXCHANGE_HPP

#include <Harmos_Mesh.hpp>

#include <vector>

namespace Harmos
{

/// The cells whose data travel, in the order of the messages. A cell that several ranks hold is listed once for each.
struct HaloCells
{
  View<int *> sent;     // owned cells
  View<int *> received; // halo cells
};

/// Rows of the entries of a list of cells: entry i has the rows offset(i) .. offset(i + 1) - 1, of `width` numbers
/// each.
struct PackedRows
{
  View<int *> offset; // entries + 1
  View<double *> value;
  int width = 0;

  KOKKOS_INLINE_FUNCTION double &operator()(int row, int column) const
  {
    return value(static_cast<std::size_t>(row) * width + column);
  }
};

/// How ranks talk. The kernels know this interface alone; `parallel` implements it with Tpetra. This base class is
/// the serial one: every operation is the identity.
class Exchange
{
public:
  virtual ~Exchange() = default;

  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }

  virtual double min(double value) const { return value; }
  virtual double max(double value) const { return value; }
  /// In-place sums over ranks, in rank order (the same on every rank).
  virtual void sum(double *, int) const {}
  virtual void sum(long long *, int) const {}
  /// The bytes of all ranks, in rank order; ranks may give different numbers of them.
  virtual std::vector<char> gather(std::vector<char> const &mine) const { return mine; }

  /// Owned cells that other ranks hold with a depth <= `depth`, and the halo cells of this rank up to that depth.
  virtual HaloCells haloCells(int /*depth*/) const { return {}; }
  /// A number for each entry of the lists of haloCells(depth).
  virtual void exchangeCounts(View<int *> const & /*sent*/, View<int *> const & /*received*/, int /*depth*/) const {}
  /// Packed rows of the lists of haloCells(depth); the offsets of both ends are known, the received values are filled.
  virtual void exchangePacked(PackedRows const & /*sent*/, PackedRows const & /*received*/, int /*depth*/) const {}
};

/// Order-independent sum: quantised to 2^-62 of `bound` >= sum of |value| over all ranks and items.
///
/// Integer addition is associative, so that the result does not depend on ranks, threads or numbering.
struct ReproducibleSum
{
  double scale = 0.0; // quanta per unit

  KOKKOS_INLINE_FUNCTION long long quanta(double value) const { return static_cast<long long>(value * scale); }
  KOKKOS_INLINE_FUNCTION double value(long long sum) const
  {
    return scale > 0.0 ? static_cast<double>(sum) / scale : 0.0;
  }
};

/// \param largest Largest |value| over all ranks; \param items number of summands over all ranks (or more).
inline ReproducibleSum reproducibleSum(double largest, long long items)
{
  ReproducibleSum sum;
  if (largest > 0.0 && items > 0)
    sum.scale = 4.0e18 / (largest * static_cast<double>(items));
  return sum;
}

} // namespace Harmos

#endif
