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

/// The cut gradients as the packed kernels read them.
struct CutPairs
{
  int const *cell_region; // null: there are none
  int const *offset;
  RowPointer<double, 12> gradient;

  CutPairs(CutGradients const &cut, CellMaterialPairs const &pairs)
      : cell_region(cut.cell_region.extent(0) > 0 ? cut.cell_region.data() : nullptr), offset(pairs.offset.data()),
        gradient(cut.gradient)
  {
  }

  /// Whether a pack has a pair of a mixed cell.
  KOKKOS_FORCEINLINE_FUNCTION bool any(int const cell[pack_width]) const
  {
    if (cell_region == nullptr)
      return false;
    int highest = -1;
    for (int lane = 0; lane < pack_width; ++lane)
      highest = Math::max(highest, cell_region[cell[lane]]);
    return highest >= 0;
  }

  /// Column of corner k of each lane's pair; zero in lanes of pure cells.
  KOKKOS_FORCEINLINE_FUNCTION Pack column(int const pair[pack_width], int const cell[pack_width], int k,
                                          CutGradientColumn which) const
  {
    return packOf(
        [&](int lane)
        {
          int const first = cell_region[cell[lane]];
          return first < 0 ? 0.0 : gradient.row(first + pair[lane] - offset[cell[lane]])[3 * k + which];
        });
  }

  HARMOS_RARE_FUNCTION CutVelocityGradient<Pack>
  velocityGradient(int const pair[pack_width], int const cell[pack_width], Corners<Pack> const &v) const
  {
    CutVelocityGradient<Pack> g = {};
    for (int k = 0; k < 4; ++k)
    {
      Pack const x = column(pair, cell, k, CutGradientX), y = column(pair, cell, k, CutGradientY);
      g.xx += x * v.x[k];
      g.xy += y * v.x[k];
      g.yx += x * v.y[k];
      g.yy += y * v.y[k];
      g.hoop += column(pair, cell, k, CutHoop) * v.x[k];
    }
    return g;
  }

  /// Forces of minus the stress (`s`, times the pair's over the cell's volume) on the corners, added to f.
  HARMOS_RARE_FUNCTION void addForces(int const pair[pack_width], int const cell[pack_width],
                                      ScaledStress<Pack> const &s, Pack const &cell_volume, Corners<Pack> &f) const
  {
    for (int k = 0; k < 4; ++k)
    {
      Pack const x = column(pair, cell, k, CutGradientX), y = column(pair, cell, k, CutGradientY);
      f.x[k] += cell_volume * (x * s.xx + y * s.xy + column(pair, cell, k, CutHoop) * s.hoop);
      f.y[k] += cell_volume * (x * s.xy + y * s.yy);
    }
  }
};

} // namespace detail
} // namespace Harmos

#endif
