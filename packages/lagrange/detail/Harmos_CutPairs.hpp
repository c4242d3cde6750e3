// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CUT_PAIRS_HPP
#define HARMOS_CUT_PAIRS_HPP

#include <Harmos_CutGradients.hpp>
#include <detail/Harmos_PairAccess.hpp>
#include <detail/Harmos_RingQuadrature.hpp>

namespace Harmos
{
namespace detail
{

/// Velocity gradient of a filled region beyond its cell's mean, with the part of u_r / r. [1/s]
template <class T>
struct CutVelocityGradient
{
  T xx, xy, yx, yy, hoop;

  KOKKOS_FORCEINLINE_FUNCTION T trace() const { return xx + yy + hoop; }
};

/// What the square of a filled region's extent lacks of its cell's, a symmetric tensor. [length^2]
template <class T>
struct LostExtent
{
  T xx, xy, yy;
};

/// Rows of a pack's pairs in the cut gradients; null where a pair has none.
struct CutRows
{
  double const *row[pack_width];
  double const *lost[pack_width];

  KOKKOS_FORCEINLINE_FUNCTION Pack column(int k, CutGradientColumn which) const
  {
    return packOf([&](int lane) { return row[lane] == nullptr ? 0.0 : row[lane][3 * k + which]; });
  }
  KOKKOS_FORCEINLINE_FUNCTION Pack lostColumn(LostExtentColumn which) const
  {
    return packOf([&](int lane) { return lost[lane] == nullptr ? 0.0 : lost[lane][which]; });
  }
};

/// The cut gradients as the packed kernels read them.
struct CutPairs
{
  int const *first_row; // null: there are none
  int const *offset;
  RowPointer<double, 12> gradient;
  RowPointer<double, 3> lost_extent;

  CutPairs(CutGradients const &cut, CellMaterialPairs const &pairs)
      : first_row(cut.first_row.extent(0) > 0 ? cut.first_row.data() : nullptr), offset(pairs.offset.data()),
        gradient(cut.gradient), lost_extent(cut.lost_extent)
  {
  }

  /// Whether a pack has a pair with a row.
  KOKKOS_FORCEINLINE_FUNCTION bool any(int const cell[pack_width]) const
  {
    if (first_row == nullptr)
      return false;
    int highest = -1;
    for (int lane = 0; lane < pack_width; ++lane)
      highest = Math::max(highest, first_row[cell[lane]]);
    return highest >= 0;
  }

  KOKKOS_FORCEINLINE_FUNCTION CutRows rowsOf(int const pair[pack_width], int const cell[pack_width]) const
  {
    CutRows rows;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      int const first = first_row[cell[lane]];
      int const row = first + pair[lane] - offset[cell[lane]];
      rows.row[lane] = first < 0 ? nullptr : gradient.row(row);
      rows.lost[lane] = first < 0 ? nullptr : lost_extent.row(row);
    }
    return rows;
  }

  template <Geometry geometry>
  HARMOS_RARE_FUNCTION CutVelocityGradient<Pack>
  velocityGradient(int const pair[pack_width], int const cell[pack_width], Corners<Pack> const &v) const
  {
    CutRows const rows = rowsOf(pair, cell);
    CutVelocityGradient<Pack> g = {};
    for (int k = 0; k < 4; ++k)
    {
      Pack const x = rows.column(k, CutGradientX), y = rows.column(k, CutGradientY);
      g.xx += x * v.x[k];
      g.xy += y * v.x[k];
      g.yx += x * v.y[k];
      g.yy += y * v.y[k];
      if (geometry == Geometry::Axisymmetric)
        g.hoop += rows.column(k, CutHoop) * v.x[k];
    }
    return g;
  }

  HARMOS_RARE_FUNCTION LostExtent<Pack> lostExtent(int const pair[pack_width], int const cell[pack_width]) const
  {
    CutRows const rows = rowsOf(pair, cell);
    return {rows.lostColumn(LostExtentXX), rows.lostColumn(LostExtentXY), rows.lostColumn(LostExtentYY)};
  }

  /// sum_I |B_I|^2 / s_I of the filled regions, s_I the corners' shares of the mass, with the hoop's part: what a
  /// pressure over the density changes tr D by, a second, where the nodes have no mass of others. About an axis the
  /// radial part counts by what a whole cell of the plane has over a whole one there (at the axis two thirds), so that
  /// columns of cells along it are alike. [1/length^2]
  template <Geometry geometry>
  HARMOS_RARE_FUNCTION Pack answerToPressure(int const pair[pack_width], int const cell[pack_width],
                                             Corners<Pack> const &x, RowPointer<double, 4> const &share) const
  {
    auto const b = cellGradient<geometry>(x);
    ScaledStress<Pack> const unit = {1.0, 1.0, 0.0, 1.0};
    Corners<Pack> f = stressForces(b, unit, HourglassVector<Pack>{0.0, 0.0}, Pack(0.0), Pack(0.0));
    addForces<geometry>(pair, cell, unit, volumeOf(b), f);
    Pack along_x = 0.0, along_y = 0.0, of_cell = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      Pack const of_mass =
          geometry == Geometry::Planar ? Pack(0.25) : packOf([&](int lane) { return share(cell[lane], k); });
      along_x += f.x[k] * f.x[k] / of_mass;
      along_y += f.y[k] * f.y[k] / of_mass;
      if constexpr (geometry == Geometry::Axisymmetric)
        of_cell += (b.x[k] + b.hoop[k]) * (b.x[k] + b.hoop[k]) / of_mass;
    }
    if constexpr (geometry == Geometry::Axisymmetric)
    {
      Pack const per_area = volumeOf(b) / b.plane.area;
      along_x = along_x * (8.0 * (b.plane.x0 * b.plane.x0 + b.plane.x1 * b.plane.x1) * per_area * per_area / of_cell);
    }
    return (along_x + along_y) / (volumeOf(b) * volumeOf(b));
  }

  /// Forces of minus the stress (`s`, times the pair's over the cell's volume) on the corners, added to f.
  template <Geometry geometry>
  HARMOS_RARE_FUNCTION void addForces(int const pair[pack_width], int const cell[pack_width],
                                      ScaledStress<Pack> const &s, Pack const &cell_volume, Corners<Pack> &f) const
  {
    CutRows const rows = rowsOf(pair, cell);
    for (int k = 0; k < 4; ++k)
    {
      Pack const x = rows.column(k, CutGradientX), y = rows.column(k, CutGradientY);
      f.x[k] += cell_volume * (x * s.xx + y * s.xy);
      f.y[k] += cell_volume * (x * s.xy + y * s.yy);
      if (geometry == Geometry::Axisymmetric)
        f.x[k] += cell_volume * (rows.column(k, CutHoop) * s.hoop);
    }
  }
};

} // namespace detail
} // namespace Harmos

#endif
