// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_Select.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// The cells of a pack, and the cells beyond their faces: the cell itself where that one does not count, so that the
/// difference is nothing and the range does not grow.
struct FluxCells
{
  int cell[pack_width];
  int pair[pack_width];
  int beyond[4][pack_width];
  int beyond_pair[4][pack_width];
  unsigned lanes; // that are stored
};

/// The faces through which the cells lose material.
struct Outflow
{
  Pack volume[4];
  Pack x[4], y[4]; // swept centroids from the cell's; zero where nothing leaves
  bool leaves[4];  // in any lane
  Pack staying, moved_volume;
};

/// Two differences across the cell and the 2 x 2 matrix that makes a gradient of them, by columns.
struct Directions
{
  Pack x0, x1, y0, y1;
};

/// The centroids of the face neighbours from the cell's.
struct Beyond
{
  Pack x[4], y[4];
  Pack at_boundary; // 1 where a face has no cell beyond it
};

struct SweptFluxFunctor
{
  SweptStage stage;
  int begin, end;

  /// What the packs of one field need.
  struct Field
  {
    Pack q, gradient_x, gradient_y, lower, upper;
  };

  KOKKOS_FORCEINLINE_FUNCTION bool selectCells(int block, FluxCells &cells) const
  {
    int const first = begin + block * pack_width;
    int const count = Math::min(pack_width, end - first);
    int lead = -1;
    cells.lanes = 0u;
    for (int lane = 0; lane < count; ++lane)
      if ((stage.flags[first + lane] & all_swept_corners) != 0)
      {
        cells.lanes |= 1u << lane;
        lead = lead < 0 ? lane : lead;
      }
    if (cells.lanes == 0u)
      return false;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      int const cell = first + ((cells.lanes >> lane & 1u) != 0u ? lane : lead);
      int const flags = stage.flags[cell];
      cells.cell[lane] = cell;
      cells.pair[lane] = stage.first_pair[cell];
      for (int k = 0; k < 4; ++k)
      {
        bool const same = (flags & SameBeyondBit << k) != 0 && stage.second_order;
        int const beyond = same ? stage.face_neighbour(cell, k) >> 2 : cell;
        cells.beyond[k][lane] = beyond;
        cells.beyond_pair[k][lane] = stage.first_pair[beyond];
      }
    }
    return true;
  }

  KOKKOS_FORCEINLINE_FUNCTION void loadGeometry(int const cell[pack_width], Pack (&row)[8]) const
  {
    loadRows([&](int lane) { return stage.cellRow(cell[lane]); }, row);
  }

  /// Linear-exact gradient from the differences across the cell along its two directions (faces 0 -> 2 and 3 -> 1).
  KOKKOS_FORCEINLINE_FUNCTION static Directions invert(Pack const (&x)[4], Pack const (&y)[4])
  {
    Pack ax = x[2] - x[0], ay = y[2] - y[0];
    Pack bx = x[1] - x[3], by = y[1] - y[3];
    auto const no_a = ax * ax + ay * ay == Pack(0.0);
    ax = select(no_a, by, ax);
    ay = select(no_a, Pack(-bx), ay);
    auto const no_b = bx * bx + by * by == Pack(0.0);
    bx = select(no_b, Pack(-ay), bx);
    by = select(no_b, ax, by);
    Pack const det = ax * by - ay * bx;
    auto const flat = det == Pack(0.0);
    Pack const inverse = select(flat, Pack(0.0), Pack(1.0 / select(flat, Pack(1.0), det)));
    return {inverse * by, -(inverse * ay), -(inverse * bx), inverse * ax};
  }

  KOKKOS_FORCEINLINE_FUNCTION static Field differentiate(Directions const &d, Pack const &q, Pack const (&p)[4])
  {
    Pack const along = p[2] - p[0], across = p[1] - p[3];
    return {q, d.x0 * along + d.x1 * across, d.y0 * along + d.y1 * across,
            Math::min(Math::min(q, Math::min(p[0], p[1])), Math::min(p[2], p[3])),
            Math::max(Math::max(q, Math::max(p[0], p[1])), Math::max(p[2], p[3]))};
  }

  /// The largest part of the gradient, at most all, that halfway to each face neighbour keeps the value between theirs
  /// (van Leer, J. Comput. Phys. 23 (1977) 276).
  KOKKOS_FORCEINLINE_FUNCTION static Pack vanLeerPart(Field const &f, Beyond const &beyond, Pack const (&p)[4])
  {
    Pack part = 1.0;
    for (int k = 0; k < 4; ++k)
    {
      Pack const rise = 0.5 * (beyond.x[k] * f.gradient_x + beyond.y[k] * f.gradient_y);
      Pack const difference = p[k] - f.q;
      auto const outside = rise * (difference - rise) < Pack(0.0);
      part = Math::min(part, select(outside, Pack(difference / select(outside, rise, Pack(1.0))), Pack(1.0)));
    }
    return Math::max(part, Pack(0.0));
  }

  /// The part of the gradient that the limiter leaves, and the whole deviations from the mean at the faces.
  KOKKOS_FORCEINLINE_FUNCTION Pack limit(Field const &f, Beyond const &beyond, Pack const (&p)[4], Outflow const &out,
                                         Pack const (&weight)[4], Pack const &per_staying, Pack (&deviation)[4]) const
  {
    if (stage.limiter == RemapLimiter::Range)
      return rangePart(f, out, weight, per_staying, deviation);
    if (stage.limiter == RemapLimiter::RangeInside)
      return Math::max(rangePart(f, out, weight, per_staying, deviation), beyond.at_boundary);
    for (int k = 0; k < 4; ++k)
      deviation[k] = out.x[k] * f.gradient_x + out.y[k] * f.gradient_y;
    return stage.limiter == RemapLimiter::VanLeer ? vanLeerPart(f, beyond, p) : Pack(1.0);
  }

  /// The deviations from the mean at the faces, and the largest part of them, at most all, that keeps those and the
  /// mean of what stays within range.
  KOKKOS_FORCEINLINE_FUNCTION static Pack rangePart(Field const &f, Outflow const &out, Pack const (&weight)[4],
                                                    Pack const &per_staying, Pack (&deviation)[4])
  {
    Pack low = 0.0, high = 0.0, left = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      if (!out.leaves[k])
        continue;
      deviation[k] = out.x[k] * f.gradient_x + out.y[k] * f.gradient_y;
      low = Math::min(low, deviation[k]);
      high = Math::max(high, deviation[k]);
      left -= weight[k] * deviation[k];
    }
    left = left * per_staying;
    Pack const most = Math::max(high, left);
    Pack const drop = -Math::min(low, left);
    Pack const above = f.upper - f.q;
    Pack const below = f.q - f.lower;
    // The lesser of two quotients by one division, without a branch: noise would decide it.
    auto const up = most > above, down = drop > below;
    Pack const up_part = select(up, above, Pack(1.0)), up_whole = select(up, most, Pack(1.0));
    Pack const down_part = select(down, below, Pack(1.0)), down_whole = select(down, drop, Pack(1.0));
    auto const rising = up_part * down_whole < down_part * up_whole;
    return select(rising, up_part, down_part) / select(rising, up_whole, down_whole);
  }

  KOKKOS_FORCEINLINE_FUNCTION static Outflow outflow(Pack const (&row)[8], Pack const (&centre)[8])
  {
    Outflow out;
    out.moved_volume = out.staying = row[MovedVolume];
    for (int k = 0; k < 4; ++k)
    {
      auto const leaves = row[SweptVolume + k] > Pack(0.0);
      out.leaves[k] = any(leaves);
      out.volume[k] = select(leaves, row[SweptVolume + k], Pack(0.0));
      out.x[k] = select(leaves, centre[2 * k], Pack(0.0));
      out.y[k] = select(leaves, centre[2 * k + 1], Pack(0.0));
      out.staying = out.staying - out.volume[k];
    }
    return out;
  }

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int block) const
  {
    FluxCells cells;
    if (!selectCells(block, cells))
      return;
    Pack row[8], centre[8];
    loadGeometry(cells.cell, row);
    loadRows([&](int lane) { return stage.centroidRow(cells.cell[lane]); }, centre);
    Outflow const out = outflow(row, centre);
    if (!(out.leaves[0] || out.leaves[1] || out.leaves[2] || out.leaves[3]))
      return;
    Beyond offset;
    Pack density[4];
    for (int k = 0; k < 4; ++k)
    {
      Pack beyond[8];
      loadGeometry(cells.beyond[k], beyond);
      offset.x[k] = beyond[CentroidX] - row[CentroidX];
      offset.y[k] = beyond[CentroidY] - row[CentroidY];
      density[k] = beyond[MovedDensity];
    }
    constexpr int all_neighbours = 15 * NeighbourBit;
    offset.at_boundary = packOf(
        [&](int lane) { return (stage.flags[cells.cell[lane]] & all_neighbours) == all_neighbours ? 0.0 : 1.0; });
    Directions const directions = invert(offset.x, offset.y);

    // Density first: it gives the mass fluxes that weigh the primitives.
    Pack const rho = row[MovedDensity];
    // Where all of a cell leaves, no mean of what stays bounds anything (largestSweptPart).
    auto const remains = out.staying > Pack(0.0);
    Pack const per_volume = select(remains, Pack(1.0 / select(remains, out.staying, Pack(1.0))), Pack(0.0));
    Pack deviation[4] = {}, mass[4], flux[4][pack_width];
    Pack const part =
        limit(differentiate(directions, rho, density), offset, density, out, out.volume, per_volume, deviation);
    Pack staying_mass = out.moved_volume * rho;
    for (int k = 0; k < 4; ++k)
    {
      mass[k] = 0.0;
      if (out.leaves[k])
        mass[k] = out.volume[k] * (rho + part * deviation[k]);
      staying_mass -= mass[k];
    }
    Pack const per_mass = 1.0 / staying_mass;

    for (int first = 0; first < num_pair_fields; first += pack_width)
    {
      Pack q[pack_width], p[4][pack_width];
      loadFields(cells.pair, first, q);
      for (int k = 0; k < 4; ++k)
        loadFields(cells.beyond_pair[k], first, p[k]);
      for (int i = 0; i < pack_width; ++i)
      {
        int const field = first + i;
        if (field == DensityField || (field == KineticField && !stage.carries()))
        {
          for (int k = 0; k < 4; ++k)
            flux[k][i] = mass[k];
          continue;
        }
        bool const by_volume = field >= DeviatorXX;
        Pack const beyond[4] = {p[0][i], p[1][i], p[2][i], p[3][i]};
        Pack const a = limit(differentiate(directions, q[i], beyond), offset, beyond, out,
                             by_volume ? out.volume : mass, by_volume ? per_volume : per_mass, deviation);
        for (int k = 0; k < 4; ++k)
          if (out.leaves[k])
            flux[k][i] = (by_volume ? out.volume[k] : mass[k]) * (q[i] + a * deviation[k]);
      }
      for (int k = 0; k < 4; ++k)
        if (out.leaves[k])
          storeFluxes(cells, k, first, flux[k]);
    }
  }

  /// Fields first .. first + pack_width - 1 of the records; kinetic energy in place of the volume fraction.
  KOKKOS_FORCEINLINE_FUNCTION void loadFields(int const pair[pack_width], int first, Pack (&q)[pack_width]) const
  {
    for (int lane = 0; lane < pack_width; ++lane)
      q[lane] = loadPack(stage.record.row(pair[lane]) + first);
    transpose(q);
    if (stage.carries() && first <= KineticField && KineticField < first + pack_width)
      q[KineticField - first] = packOf([&](int lane) { return stage.kinetic[pair[lane]]; });
  }

  KOKKOS_FORCEINLINE_FUNCTION void storeFluxes(FluxCells const &cells, int k, int first, Pack (&flux)[pack_width]) const
  {
    transpose(flux);
    if (cells.lanes == all_lanes)
      for (int lane = 0; lane < pack_width; ++lane)
        storePack(stage.fluxRow(cells.cell[lane], k) + first, flux[lane]);
    else
      for (int lane = 0; lane < pack_width; ++lane)
        if ((cells.lanes >> lane & 1u) != 0u)
          storePack(stage.fluxRow(cells.cell[lane], k) + first, flux[lane]);
  }
};

} // namespace

void sweptFluxes(SweptStage const &stage, int begin, int end)
{
  Kokkos::parallel_for("Harmos::remap::sweptFluxes", RangePolicy(0, numPacks(end - begin)),
                       SweptFluxFunctor{stage, begin, end});
}

} // namespace RemapDetail
} // namespace Harmos
