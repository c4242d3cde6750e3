// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptColumns.hpp>

#include <Harmos_Select.hpp>
#include <detail/Harmos_RangeLimit.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// What leaves the cells of a block, by slots (SweptColumn). The second slot of opposite faces is seldom in use, and
/// empty for a cell that does not need it: it adds nothing there, so that no result hangs on the block's other cells.
struct Outflow
{
  int block;      // SweptBlock
  double *column; // of the first flux
  Pack volume[4];
  Pack x[4], y[4]; // swept centroids from the cell's; zero where nothing leaves
  Pack side[2];    // 1 where it is face 1 or 2 that things leave through, -1 for face 3 or 0
  Pack staying, moved_volume;

  KOKKOS_FORCEINLINE_FUNCTION bool takes(int slot) const { return slot < 2 || (block & SecondBit << (slot - 2)) != 0; }
  KOKKOS_FORCEINLINE_FUNCTION void store(int slot, int field, Pack const &flux) const
  {
    storePack(column + (num_face_columns * slot + field) * column_stride, flux);
  }
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
  bool at_boundary; // some cells are, and the limiter minds it
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

  KOKKOS_INLINE_FUNCTION bool endsAt(int cell, int k) const
  {
    Vector2 normal;
    return stage.endsAt(cell, k) && !stage.mirrorsAt(cell, k, normal);
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

  /// The deviations from the mean in what leaves.
  KOKKOS_FORCEINLINE_FUNCTION static void deviate(Field const &f, Outflow const &out, Pack (&deviation)[4])
  {
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
      if (out.takes(k))
        deviation[k] = out.x[k] * f.gradient_x + out.y[k] * f.gradient_y;
  }

  /// Brings them into range face by face, where the limiter does. \return The part of them that it then leaves.
  KOKKOS_FORCEINLINE_FUNCTION static Pack limit(Field const &f, Beyond const &beyond, Pack const (&p)[4],
                                                Outflow const &out, Pack const (&weight)[4], Pack const &per_staying,
                                                Pack (&deviation)[4])
  {
    if constexpr (limiter == RemapLimiter::None)
      return Pack(1.0);
    else if constexpr (limiter == RemapLimiter::VanLeer)
      return vanLeerPart(f, beyond, p);
    else
      return keepWithin(f, out, weight, per_staying, deviation);
  }

  /// Brings what leaves through each face into the range by itself. \return The part of all deviations, at most all,
  /// that then keeps the mean of what stays in it too. So a face counts by what it takes: one that sweeps next to
  /// nothing, at a corner of the cell, does not bound what the others take (noise would decide where the flow is along
  /// it).
  KOKKOS_FORCEINLINE_FUNCTION static Pack keepWithin(Field const &f, Outflow const &out, Pack const (&weight)[4],
                                                     Pack const &per_staying, Pack (&deviation)[4])
  {
    Pack const above = f.upper - f.q, below = f.lower - f.q;
    Pack left = 0.0;
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      if (!out.takes(k))
        continue;
      deviation[k] = Math::max(below, Math::min(deviation[k], above));
      left -= weight[k] * deviation[k];
    }
    left = left * per_staying;
    Pack const bounded = Math::max(below, Math::min(left, above));
    auto const whole = left == bounded;
    return select(whole, Pack(1.0), bounded) / select(whole, Pack(1.0), left);
  }

  /// The part of the gradient that is left in what the faces take, on the whole.
  KOKKOS_FORCEINLINE_FUNCTION static Pack partLeft(Outflow const &out, Pack const &part, Pack const (&deviation)[4],
                                                   Pack const (&whole)[4])
  {
    Pack left = 0.0, all = 0.0;
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      if (!out.takes(k))
        continue;
      left += out.volume[k] * Math::fabs(deviation[k]);
      all += out.volume[k] * Math::fabs(whole[k]);
    }
    auto const some = all > Pack(0.0);
    return part * (select(some, left, Pack(1.0)) / select(some, all, Pack(1.0)));
  }

  KOKKOS_FORCEINLINE_FUNCTION Outflow outflow(int first, int block) const
  {
    Outflow out;
    out.block = block;
    double *const own = stage.at(0, first);
    out.column = own + (FaceColumn + 1) * column_stride;
    out.moved_volume = out.staying = loadPack(own + MovedVolume * column_stride);
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      if (!out.takes(k))
        continue;
      int const axis = k & 1;
      Pack const volume = loadPack(own + (FaceColumn + num_face_columns * axis) * column_stride);
      Pack const opposite = loadPack(own + (FaceColumn + num_face_columns * (axis + 2)) * column_stride);
      if (k < 2)
      {
        auto const leaves = volume > Pack(0.0);
        out.volume[k] = select(leaves, volume, opposite);
        out.side[k] = select(leaves, Pack(2.0 * k - 1.0), Pack(1.0 - 2.0 * k));
      }
      else
        out.volume[k] = Math::max(-opposite, Pack(0.0));
      out.x[k] = loadPack(own + (OffsetColumn + 2 * k) * column_stride);
      out.y[k] = loadPack(own + (OffsetColumn + 2 * k + 1) * column_stride);
      out.staying = out.staying - out.volume[k];
    }
    return out;
  }

  /// At the boundary of the mesh.
  HARMOS_RARE_FUNCTION void widen(int first, int field, Columns const &columns, double (&lower)[pack_width],
                                  double (&upper)[pack_width]) const
  {
    Pack const q = columns.ofCell(FieldColumn + field);
    Pack p[4];
    for (int k = 0; k < 4; ++k)
      p[k] = columns.load(k, FieldColumn + field);
    for (int lane = 0; lane < pack_width && first + lane < end; ++lane)
      for (int k = 0; k < 4; ++k)
        if (endsAt(first + lane, k))
          widenByMirrored(laneOf(q, lane), laneOf(p[(k + 2) & 3], lane), stage.leastOf(first + lane)[field],
                          stage.largestOf(first + lane)[field], lower[lane], upper[lane]);
  }

  HARMOS_RARE_FUNCTION void widenSpecificVolume(int first, Pack const &ratio, Field const &density,
                                                double (&lower)[pack_width], double (&upper)[pack_width]) const
  {
    for (int lane = 0; lane < pack_width && first + lane < end; ++lane)
      for (int k = 0; k < 4; ++k)
        if (endsAt(first + lane, k))
          widenByDensity(laneOf(ratio, lane), laneOf(density.lower, lane), laneOf(density.upper, lane),
                         stage.leastOf(first + lane)[SpecificVolume], stage.largestOf(first + lane)[SpecificVolume],
                         lower[lane], upper[lane]);
  }

  /// A field of the cells and, in p, beyond their faces.
  KOKKOS_FORCEINLINE_FUNCTION Field fieldOf(int first, int field, Directions const &directions, Beyond const &offset,
                                            Columns const &columns, Pack (&p)[4]) const
  {
    for (int k = 0; k < 4; ++k)
      p[k] = columns.load(k, FieldColumn + field);
    Field f = differentiate(directions, columns.ofCell(FieldColumn + field), p);
    if (offset.at_boundary)
    {
      double lower[pack_width], upper[pack_width]; // what a call may change would leave its registers for all cells
      storePack(lower, f.lower);
      storePack(upper, f.upper);
      Columns const copy = columns;
      widen(first, field, copy, lower, upper);
      f.lower = loadPack(lower);
      f.upper = loadPack(upper);
    }
    return f;
  }

  /// The fluxes of a field that is weighted by what leaves, volume or mass.
  KOKKOS_FORCEINLINE_FUNCTION void remapField(int first, int field, Directions const &directions, Beyond const &offset,
                                              Columns const &columns, Outflow const &out, Pack const (&weight)[4],
                                              Pack const &per_staying) const
  {
    Pack p[4], deviation[4] = {0.0, 0.0, 0.0, 0.0};
    Field const f = fieldOf(first, field, directions, offset, columns, p);
    Pack const q = f.q;
    deviate(f, out, deviation);
    Pack const part = limit(f, offset, p, out, weight, per_staying, deviation);
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
      if (out.takes(k))
        out.store(k, field, weight[k] * (q + part * deviation[k]));
  }

  /// From the swept centroids to those of the mass in what is swept, as seen from the cell's: with density rho + g . x
  /// a region of central second moments S (over its volume) has its mass S g / rho off. S = (a a^T + b b^T) / 12 with
  /// the mid-lines a, b of the cell, (d - 2 x) in place of the one across a face, whose outward mid-line is d, for what
  /// passes through it (exact on parallelograms). \param part Of the gradient of f, the density. \param per_density
  /// Volume over mass of what leaves, or zero.
  KOKKOS_FORCEINLINE_FUNCTION static void moveToMassCentroids(Beyond const &offset, Field const &f, Pack const &part,
                                                              Pack const (&per_density)[4], Outflow &out)
  {
    Pack const gx = (part / 12.0) * f.gradient_x, gy = (part / 12.0) * f.gradient_y;
    Pack line_x[2], line_y[2], along[2]; // from face 0 to 2, from 3 to 1
    for (int i = 0; i < 2; ++i)
    {
      int const from = 3 * i, to = 2 - i;
      Pack const square_from = offset.x[from] * offset.x[from] + offset.y[from] * offset.y[from];
      Pack const square_to = offset.x[to] * offset.x[to] + offset.y[to] * offset.y[to];
      auto const both = square_from * square_to > Pack(0.0);
      Pack const x = offset.x[to] - offset.x[from], y = offset.y[to] - offset.y[from];
      line_x[i] = select(both, Pack(0.5 * x), x);
      line_y[i] = select(both, Pack(0.5 * y), y);
      along[i] = line_x[i] * gx + line_y[i] * gy;
    }
    Pack const per_mean = 1.0 / f.q;
    Pack const cell_x = per_mean * (along[0] * line_x[0] + along[1] * line_x[1]);
    Pack const cell_y = per_mean * (along[0] * line_y[0] + along[1] * line_y[1]);
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      if (!out.takes(k))
        continue;
      int const across = k & 1;
      Pack const sign = k < 2 ? out.side[k] : Pack(k == 2 ? 1.0 : -1.0);
      Pack const x = sign * line_x[across] - 2.0 * out.x[k], y = sign * line_y[across] - 2.0 * out.y[k];
      Pack const through = x * gx + y * gy;
      Pack const per_swept = per_density[k];
      auto const some = per_swept > Pack(0.0);
      out.x[k] = select(some, out.x[k] + per_swept * (through * x + along[1 - across] * line_x[1 - across]) - cell_x,
                        Pack(0.0));
      out.y[k] = select(some, out.y[k] + per_swept * (through * y + along[1 - across] * line_y[1 - across]) - cell_y,
                        Pack(0.0));
    }
  }

  /// The fluxes of thermodynamic volume, mass times specific volume s. What is linear is its ratio theta = rho s to the
  /// volume that it fills: where theta is one in the cell and around, what a face takes is the volume that it sweeps,
  /// and pure cells keep s = volume / mass however steep the density is. Bounds are those of s.
  /// \param density Of the cells, and beyond the faces. \param per_density Volume over mass of what leaves, or zero.
  KOKKOS_FORCEINLINE_FUNCTION void remapSpecificVolume(int first, Directions const &directions, Beyond const &offset,
                                                       Columns const &columns, Outflow const &out, Field const &density,
                                                       Pack const (&density_beyond)[4], Pack const (&mass)[4],
                                                       Pack const (&per_density)[4], Pack const &per_mass) const
  {
    Pack p[4], theta[4], deviation[4] = {0.0, 0.0, 0.0, 0.0};
    Beyond inside = offset;
    inside.at_boundary = false;
    Field f = fieldOf(first, SpecificVolume, directions, inside, columns, p);
    for (int k = 0; k < 4; ++k)
      theta[k] = density_beyond[k] * p[k];
    Field const t = differentiate(directions, density.q * f.q, theta);
    if (offset.at_boundary)
    {
      double lower[pack_width], upper[pack_width];
      storePack(lower, f.lower);
      storePack(upper, f.upper);
      Field const copy = density; // as in fieldOf
      widenSpecificVolume(first, t.q, copy, lower, upper);
      f.lower = loadPack(lower);
      f.upper = loadPack(upper);
    }
    Pack part = 1.0;
    if constexpr (limiter == RemapLimiter::VanLeer)
      part = vanLeerPart(t, offset, theta);
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      if (!out.takes(k))
        continue;
      Pack ratio = t.q + part * (out.x[k] * t.gradient_x + out.y[k] * t.gradient_y);
      if constexpr (limiter == RemapLimiter::Range || limiter == RemapLimiter::RangeInside)
        ratio = Math::max(t.lower, Math::min(ratio, t.upper));
      deviation[k] = select(per_density[k] > Pack(0.0), per_density[k] * ratio - f.q, Pack(0.0));
    }
    Pack left = 1.0;
    if constexpr (limiter == RemapLimiter::Range || limiter == RemapLimiter::RangeInside)
      left = keepWithin(f, out, mass, per_mass, deviation);
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
      if (out.takes(k))
        out.store(k, SpecificVolume, mass[k] * (f.q + left * deviation[k]));
  }

  KOKKOS_FORCEINLINE_FUNCTION static Beyond offsets(int block, Columns const &columns)
  {
    Beyond offset;
    offset.at_boundary = limiter == RemapLimiter::RangeInside && (block & BoundaryBit) != 0;
    Pack const x = columns.ofCell(CentroidX), y = columns.ofCell(CentroidY);
    for (int k = 0; k < 4; ++k)
    {
      offset.x[k] = columns.load(k, CentroidX) - x;
      offset.y[k] = columns.load(k, CentroidY) - y;
    }
    return offset;
  }

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int number) const
  {
    int const first = begin + number * pack_width;
    int const block = stage.blockOf(first);
    if ((block & LeaveBit) == 0)
      return;
    GatheredColumns gathered;
    Columns const columns = ColumnGatherer{stage, end}.columnsBeyond(first, block, gathered);
    Outflow out = outflow(first, block);
    Beyond const offset = offsets(block, columns);
    Directions const directions = invert(offset.x, offset.y);

    // Density first: it gives the mass fluxes that weigh the primitives.
    // Where all of a cell leaves, no mean of what stays bounds anything (largestSweptPart).
    auto const remains = out.staying > Pack(0.0);
    Pack const per_volume = select(remains, Pack(1.0 / select(remains, out.staying, Pack(1.0))), Pack(0.0));
    Pack density[4], whole[4] = {0.0, 0.0, 0.0, 0.0}, deviation[4] = {0.0, 0.0, 0.0, 0.0};
    Pack mass[4] = {0.0, 0.0, 0.0, 0.0}, per_density[4] = {0.0, 0.0, 0.0, 0.0};
    Field const f = fieldOf(first, DensityField, directions, offset, columns, density);
    Pack const rho = f.q;
    deviate(f, out, whole);
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
      if (out.takes(k))
        deviation[k] = whole[k];
    Pack const left = limit(f, offset, density, out, out.volume, per_volume, deviation);
    Pack const part = partLeft(out, left, deviation, whole);
    Pack staying_mass = out.moved_volume * rho;
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      if (!out.takes(k))
        continue;
      mass[k] = out.volume[k] * (rho + left * deviation[k]);
      out.store(k, DensityField, mass[k]);
      staying_mass -= mass[k];
      auto const some = mass[k] > Pack(0.0);
      per_density[k] = select(some, out.volume[k], Pack(0.0)) / select(some, mass[k], Pack(1.0));
    }

    // What goes by volume next: the mass fluxes are the end of a long chain, which it hides.
    for (int field = DeviatorXX; field < num_pair_fields; ++field)
      remapField(first, field, directions, offset, columns, out, out.volume, per_volume);
    Pack const per_mass = 1.0 / staying_mass;
    remapSpecificVolume(first, directions, offset, columns, out, f, density, mass, per_density, per_mass);
    moveToMassCentroids(offset, f, part, per_density, out);
    if (stage.carries())
      remapField(first, KineticField, directions, offset, columns, out, mass, per_mass);
    for (int field = SpecificVolume + 1; field < DeviatorXX; ++field)
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
