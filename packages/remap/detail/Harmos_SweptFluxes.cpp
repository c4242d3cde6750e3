// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_Select.hpp>
#include <detail/Harmos_RangeLimit.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// What faces take out of the cells of a block: those through which any leaves, one after the other.
struct Outflow
{
  int count;
  double *face[4]; // its columns
  Pack volume[4];
  Pack x[4], y[4]; // swept centroids from the cell's; zero where nothing leaves
  Pack staying, moved_volume;
};

/// The centroids and fields beyond the faces, column by column as in the window; the cell's own where what is there
/// does not count, so that the difference is nothing and the range does not grow.
struct Columns
{
  double const *face[4];
  std::ptrdiff_t stride[4];

  KOKKOS_FORCEINLINE_FUNCTION Pack load(int k, int column) const { return loadPack(face[k] + column * stride[k]); }
};
using GatheredColumns = double[num_neighbour_columns][pack_width];

/// Two differences across the cell and the 2 x 2 matrix that makes a gradient of them, by columns.
struct Directions
{
  Pack x0, x1, y0, y1;
};

/// The centroids of the face neighbours from the cell's.
struct Beyond
{
  Pack x[4], y[4];
  bool at_boundary = false; // some cells are
};

template <RemapLimiter limiter>
struct SweptFluxFunctor
{
  SweptStage stage;
  int begin, end;

  /// What the packs of one field need.
  struct Field
  {
    Pack q, gradient_x, gradient_y, lower, upper;
  };

  /// Lane by lane, where the neighbours beyond a face are no run of cells.
  HARMOS_RARE_FUNCTION void gather(int first, int k, GatheredColumns &gathered) const
  {
    int const count = Math::min(pack_width, end - first);
    for (int lane = 0; lane < pack_width; ++lane)
    {
      int const cell = first + lane;
      bool const same = lane < count && stage.sameBeyond(cell, k);
      double const *column = stage.at(CentroidX, same ? stage.face_neighbour(cell, k) >> 2 : cell);
      for (int c = 0; c < num_neighbour_columns; ++c, column += column_stride)
        gathered[c][lane] = *column;
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION Columns columnsBeyond(int first, int block, GatheredColumns (&gathered)[4]) const
  {
    Columns beyond;
    for (int k = 0; k < 4; ++k)
    {
      bool const in_run = (block & RunBit << k) != 0;
      beyond.face[k] = stage.at(CentroidX, stage.second_order && in_run ? stage.face_neighbour(first, k) >> 2 : first);
      beyond.stride[k] = column_stride;
      if (!stage.second_order || in_run)
        continue;
      gather(first, k, gathered[k]);
      beyond.face[k] = gathered[k][0];
      beyond.stride[k] = pack_width;
    }
    return beyond;
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
  KOKKOS_FORCEINLINE_FUNCTION static Pack limit(Field const &f, Beyond const &beyond, Pack const (&p)[4],
                                                Outflow const &out, Pack const (&weight)[4], Pack const &per_staying,
                                                Pack (&deviation)[4])
  {
    for (int i = 0; i < out.count; ++i)
      deviation[i] = out.x[i] * f.gradient_x + out.y[i] * f.gradient_y;
    if constexpr (limiter == RemapLimiter::None)
      return Pack(1.0);
    else if constexpr (limiter == RemapLimiter::VanLeer)
      return vanLeerPart(f, beyond, p);
    else
      return rangePart(f, out.count, weight, per_staying, deviation);
  }

  /// The largest part of the deviations from the mean at the faces, at most all, that keeps those and the mean of what
  /// stays within range.
  KOKKOS_FORCEINLINE_FUNCTION static Pack rangePart(Field const &f, int count, Pack const (&weight)[4],
                                                    Pack const &per_staying, Pack const (&deviation)[4])
  {
    Pack low = 0.0, high = 0.0, left = 0.0;
    for (int i = 0; i < count; ++i)
    {
      low = Math::min(low, deviation[i]);
      high = Math::max(high, deviation[i]);
      left -= weight[i] * deviation[i];
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

  KOKKOS_FORCEINLINE_FUNCTION Outflow outflow(int first, int block) const
  {
    Outflow out;
    out.count = 0;
    out.moved_volume = out.staying = loadPack(stage.at(MovedVolume, first));
    for (int k = 0; k < 4; ++k)
    {
      if ((block & LeaveBit << k) == 0)
        continue;
      int const i = out.count++;
      out.face[i] = stage.at(FaceColumn + num_face_columns * k, first);
      out.volume[i] = loadPack(out.face[i]);
      out.x[i] = loadPack(stage.at(OffsetColumn + 2 * k, first));
      out.y[i] = loadPack(stage.at(OffsetColumn + 2 * k + 1, first));
      out.staying = out.staying - out.volume[i];
    }
    return out;
  }

  /// At the boundary of the mesh. \param p Beyond the faces.
  HARMOS_RARE_FUNCTION void widen(int first, int field, Pack const (&p)[4], Field &f) const
  {
    double lower[pack_width], upper[pack_width];
    storePack(lower, f.lower);
    storePack(upper, f.upper);
    for (int lane = 0; lane < pack_width && first + lane < end; ++lane)
      for (int k = 0; k < 4; ++k)
        if (stage.endsAt(first + lane, k))
          widenByMirrored(laneOf(f.q, lane), laneOf(p[(k + 2) & 3], lane), stage.leastOf(first + lane)[field],
                          stage.largestOf(first + lane)[field], lower[lane], upper[lane]);
    f.lower = loadPack(lower);
    f.upper = loadPack(upper);
  }

  /// The fluxes of a field that is weighted by what leaves, volume or mass.
  KOKKOS_FORCEINLINE_FUNCTION void remapField(int first, int field, Directions const &directions, Beyond const &offset,
                                              Columns const &columns, Outflow const &out, Pack const (&weight)[4],
                                              Pack const &per_staying) const
  {
    Pack const q = loadPack(stage.at(FieldColumn + field, first));
    Pack p[4], deviation[4];
    for (int k = 0; k < 4; ++k)
      p[k] = columns.load(k, FieldColumn + field);
    Field f = differentiate(directions, q, p);
    if (offset.at_boundary)
      widen(first, field, p, f);
    Pack const part = limit(f, offset, p, out, weight, per_staying, deviation);
    for (int i = 0; i < out.count; ++i)
      storePack(out.face[i] + (1 + field) * column_stride, weight[i] * (q + part * deviation[i]));
  }

  KOKKOS_FORCEINLINE_FUNCTION Beyond offsets(int first, Columns const &columns) const
  {
    Beyond offset;
    Pack const x = loadPack(stage.at(CentroidX, first)), y = loadPack(stage.at(CentroidY, first));
    for (int k = 0; k < 4; ++k)
    {
      offset.x[k] = columns.load(k, CentroidX) - x;
      offset.y[k] = columns.load(k, CentroidY) - y;
    }
    for (int cell = first; limiter == RemapLimiter::RangeInside && cell < first + pack_width && cell < end; ++cell)
      offset.at_boundary = offset.at_boundary || stage.isAtBoundary(cell);
    return offset;
  }

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int number) const
  {
    int const first = begin + number * pack_width;
    int const block = stage.blockOf(first);
    if ((block & all_leave_bits) == 0)
      return;
    GatheredColumns gathered[4];
    Columns const columns = columnsBeyond(first, block, gathered);
    Outflow const out = outflow(first, block);
    Beyond const offset = offsets(first, columns);
    Directions const directions = invert(offset.x, offset.y);

    // Density first: it gives the mass fluxes that weigh the primitives.
    Pack const rho = loadPack(stage.at(FieldColumn + DensityField, first));
    // Where all of a cell leaves, no mean of what stays bounds anything (largestSweptPart).
    auto const remains = out.staying > Pack(0.0);
    Pack const per_volume = select(remains, Pack(1.0 / select(remains, out.staying, Pack(1.0))), Pack(0.0));
    Pack deviation[4], density[4], mass[4];
    for (int k = 0; k < 4; ++k)
      density[k] = columns.load(k, FieldColumn + DensityField);
    Field f = differentiate(directions, rho, density);
    if (offset.at_boundary)
      widen(first, DensityField, density, f);
    Pack const part = limit(f, offset, density, out, out.volume, per_volume, deviation);
    Pack staying_mass = out.moved_volume * rho;
    for (int i = 0; i < out.count; ++i)
    {
      mass[i] = out.volume[i] * (rho + part * deviation[i]);
      storePack(out.face[i] + (1 + DensityField) * column_stride, mass[i]);
      staying_mass -= mass[i];
    }

    // What goes by volume next: the mass fluxes are the end of a long chain, which it hides.
    for (int field = DeviatorXX; field < num_pair_fields; ++field)
      remapField(first, field, directions, offset, columns, out, out.volume, per_volume);
    Pack const per_mass = 1.0 / staying_mass;
    for (int field = stage.carries() ? KineticField : KineticField + 1; field < DeviatorXX; ++field)
      remapField(first, field, directions, offset, columns, out, mass, per_mass);
  }
};

template <RemapLimiter limiter>
void launch(SweptStage const &stage, int begin, int end)
{
  Kokkos::parallel_for("Harmos::remap::sweptFluxes", RangePolicy(0, numPacks(end - begin)),
                       SweptFluxFunctor<limiter>{stage, begin, end});
}

} // namespace

void sweptFluxes(SweptStage const &stage, int begin, int end)
{
  switch (stage.limiter)
  {
  case RemapLimiter::Range:
    return launch<RemapLimiter::Range>(stage, begin, end);
  case RemapLimiter::RangeInside:
    return launch<RemapLimiter::RangeInside>(stage, begin, end);
  case RemapLimiter::VanLeer:
    return launch<RemapLimiter::VanLeer>(stage, begin, end);
  case RemapLimiter::None:
    return launch<RemapLimiter::None>(stage, begin, end);
  }
}

} // namespace RemapDetail
} // namespace Harmos
