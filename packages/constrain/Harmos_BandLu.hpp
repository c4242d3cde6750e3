// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BAND_LU_HPP
#define HARMOS_BAND_LU_HPP

#include <Harmos_SkylineCholesky.hpp>

namespace Harmos
{

/// \brief Factors P A = L U of a band matrix, rows exchanged (P) for the largest pivot of each column.
///
/// Serial and in one order: n rows of bandwidth b cost 2 n b^2 operations or, with exchanges, up to twice that.
/// Golub & Van Loan, Matrix Computations, 4th ed., section 4.3.
class BandLu
{
public:
  /// \param entry Of the matrix, in any order; those at one place are added up.
  void factor(std::vector<MatrixEntry> const &entry, std::size_t size);

  /// x = A^-1 x
  void solve(std::vector<double> &x) const;

private:
  double &at(int row, int column) { return value_[static_cast<std::size_t>(row) * width_ + (column - row + below_)]; }
  double at(int row, int column) const
  {
    return value_[static_cast<std::size_t>(row) * width_ + (column - row + below_)];
  }

  int size_ = 0;
  int below_ = 0, above_ = 0; // diagonals that hold something; above: after exchanges
  int width_ = 0;
  std::vector<double> value_; // by rows, L below the diagonal
  std::vector<int> pivot_;    // by column: the row that came to its place
};

} // namespace Harmos

#endif
