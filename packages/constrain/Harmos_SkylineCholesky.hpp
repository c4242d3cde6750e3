// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SKYLINE_CHOLESKY_HPP
#define HARMOS_SKYLINE_CHOLESKY_HPP

#include <cstddef>
#include <vector>

namespace Harmos
{

/// Lower triangle of a symmetric sparse matrix by rows, with its diagonal.
struct LowerTriangle
{
  std::vector<int> offset = {0}; // rows + 1
  std::vector<int> column;       // <= row
  std::vector<double> value;

  int size() const { return static_cast<int>(offset.size()) - 1; }

  /// out = the whole matrix times x
  void multiply(std::vector<double> const &x, std::vector<double> &out) const;
};

/// a . b, summed from the first entry on.
double dot(std::vector<double> const &a, std::vector<double> const &b);

struct MatrixEntry
{
  int row, column;
  double value;
};

/// The matrix of these entries (column <= row), in any order; those at one place are added up by who reads it.
LowerTriangle byRows(std::vector<MatrixEntry> const &entry, std::size_t size);

/// An order of unknowns in which neighbours are near each other (reverse Cuthill-McKee): a pure function of the graph.
///
/// \param offset, item Neighbours of each unknown, CRS, symmetric.
/// Cuthill & McKee, Proc. 24th Nat. Conf. ACM (1969) 157-172.
std::vector<int> reverseCuthillMcKee(std::vector<int> const &offset, std::vector<int> const &item);

/// \brief Cholesky factor L L^T of a principal submatrix of A + S, S diagonal, each row of L held from its first entry
/// on.
///
/// Serial and in one order: n rows of bandwidth b cost n b^2 operations, and give the same bits wherever they are done.
/// George & Liu, Computer Solution of Large Sparse Positive Definite Systems, Prentice-Hall 1981.
class SkylineCholesky
{
public:
  /// Pivots are at least their shift, as those of a positive semidefinite A are.
  /// \param kept By row of a: whether it belongs to the submatrix.
  /// \param shift By row of a: S (> 0).
  /// \param least Diagonal entries of A + S below it, of what hardly moves, are replaced by one.
  void factor(LowerTriangle const &a, std::vector<char> const &kept, std::vector<double> const &shift, double least);

  /// x = (L L^T)^-1 x on the submatrix; other entries of x become zero.
  void solve(std::vector<double> &x) const;

private:
  std::vector<int> kept_;            // rows of a
  std::vector<int> place_;           // by row of a: where it is in kept_, -1: not
  std::vector<int> first_;           // column of the first entry of a row of L
  std::vector<std::ptrdiff_t> base_; // L(i, j) = value_[base_[i] + j]
  std::vector<double> value_;
  mutable std::vector<double> work_;
};

} // namespace Harmos

#endif
