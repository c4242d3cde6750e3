// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_QUADRATIC_FIT_HPP
#define HARMOS_QUADRATIC_FIT_HPP

#include <detail/Harmos_StageFields.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// A region's centroid and its central second moments xx, xy, yy over its volume.
struct Spread
{
  Vector2 centroid;
  double second[3];
};

/// Least-squares fit of g.d + d.H d / 2 about a donor to the differences of averages, weighted by a part over distance
/// squared; exact for quadratics. Normal equations for x / h, y / h and the second moments over h^2, h^2 the donor's
/// volume; unknowns g_x, g_y, H_xx / 2, H_xy, H_yy / 2.
/// \tparam Fields FieldPack or StageFields
template <class Fields>
struct QuadraticFit
{
  double matrix[5][5] = {};
  Fields right[5];
  Spread donor;
  double per_h, per_h2;

  KOKKOS_INLINE_FUNCTION QuadraticFit(Spread const &of_donor, double volume)
      : donor(of_donor), per_h(1.0 / Math::sqrt(volume)), per_h2(1.0 / volume)
  {
    for (Fields &field : right)
      field = zero(field);
  }

  /// Weighted by `part`; at the donor's centroid it counts for nothing.
  KOKKOS_INLINE_FUNCTION void add(Spread const &neighbour, double part, Fields const &difference)
  {
    Vector2 const d = neighbour.centroid - donor.centroid;
    double const distance2 = dot(d, d);
    if (!(distance2 > 0.0))
      return;
    double const row[5] = {per_h * d[0], per_h * d[1], per_h2 * (neighbour.second[0] - donor.second[0] + d[0] * d[0]),
                           per_h2 * (neighbour.second[1] - donor.second[1] + d[0] * d[1]),
                           per_h2 * (neighbour.second[2] - donor.second[2] + d[1] * d[1])};
    double const w = part / (per_h2 * distance2);
    for (int i = 0; i < 5; ++i)
    {
      for (int j = 0; j <= i; ++j)
        matrix[i][j] += w * row[i] * row[j];
      addTimes(right[i], w * row[i], difference);
    }
  }

  /// Solve for the unknowns in `right`. A second derivative that the neighbours do not determine (across a boundary) is
  /// zero, as is any derivative along an axis along which none of them lies (a strip of single cells).
  /// \return False where they do not determine the rest of the gradient.
  KOKKOS_INLINE_FUNCTION bool solve()
  {
    if (!factorise())
      return false;
    for (int i = 0; i < 5; ++i)
    {
      for (int k = 0; k < i; ++k)
        addTimes(right[i], -matrix[i][k], right[k]);
      scale(right[i], 1.0 / matrix[i][i]);
    }
    for (int i = 4; i >= 0; --i)
    {
      for (int k = i + 1; k < 5; ++k)
        addTimes(right[i], -matrix[k][i], right[k]);
      scale(right[i], 1.0 / matrix[i][i]);
    }
    for (int i = 0; i < 5; ++i)
      scale(right[i], i < 2 ? per_h : per_h2);
    return true;
  }

private:
  /// Cholesky's factors in place.
  KOKKOS_INLINE_FUNCTION bool factorise()
  {
    constexpr double least_pivot = 0.05; // of the diagonal; 0.75 inside a regular mesh, none where a side is missing
    constexpr double negligible = 1e-10; // of the sum of the parts: differences of positions that are round-off
    double const least_diagonal = negligible * (matrix[0][0] + matrix[1][1]);
    if (!(least_diagonal > 0.0))
      return false;
    for (int i = 0; i < 5; ++i)
    {
      if (!(matrix[i][i] > least_diagonal))
      {
        drop(i);
        matrix[i][i] = 1.0;
        continue;
      }
      double pivot = matrix[i][i];
      for (int j = 0; j < i; ++j)
      {
        double sum = matrix[i][j];
        for (int k = 0; k < j; ++k)
          sum -= matrix[i][k] * matrix[j][k];
        matrix[i][j] = sum / matrix[j][j];
        pivot -= matrix[i][j] * matrix[i][j];
      }
      bool const determined = pivot > least_pivot * matrix[i][i];
      if (!determined && i < 2)
        return false;
      if (!determined)
        drop(i);
      matrix[i][i] = determined ? Math::sqrt(pivot) : 1.0;
    }
    return true;
  }

  /// Make unknown i zero: its factors and those of the ones to come.
  KOKKOS_INLINE_FUNCTION void drop(int i)
  {
    right[i] = zero(right[i]);
    for (int j = 0; j < i; ++j)
      matrix[i][j] = 0.0;
    for (int k = i + 1; k < 5; ++k)
      matrix[k][i] = 0.0;
  }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
