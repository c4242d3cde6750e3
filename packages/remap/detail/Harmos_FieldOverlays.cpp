// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_FieldOverlays.hpp>

#include <detail/Harmos_OverlayMoments.hpp>
#include <detail/Harmos_RangeLimit.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

constexpr double least_part = 1e-12; // of a donor: smaller overlays get its mean, their centroids being round-off

/// Cells first + lane, the last one again where there are no more.
struct CellPack
{
  int cell[pack_width];
};

KOKKOS_FORCEINLINE_FUNCTION CellPack cellPack(Mesh const &mesh, int block)
{
  CellPack c;
  for (int lane = 0; lane < pack_width; ++lane)
    c.cell[lane] = Math::min(block * pack_width + lane, mesh.num_cells - 1);
  return c;
}

/// Target corners in a row, shapes of the start's cells.
struct FieldShapes
{
  FieldStage stage;

  KOKKOS_INLINE_FUNCTION void operator()(int cell) const
  {
    Vector2 x[4];
    for (int k = 0; k < 4; ++k)
    {
      int const node = stage.mesh.cell_node(cell, k);
      stage.corner(cell, k) = stage.mesh.node_position(node, 0);
      stage.corner(cell, 4 + k) = stage.mesh.node_position(node, 1);
      x[k] = {stage.start(node, 0), stage.start(node, 1)};
    }
    AreaCentroid const shape = areaCentroid(x);
    stage.shape(cell, 0) = shape.centroid[0];
    stage.shape(cell, 1) = shape.centroid[1];
    stage.shape(cell, 2) = shape.area;
  }
};

struct FieldOverlays
{
  FieldStage stage;

  /// Donors at work; slots 1 .. slots - 1 are neighbours, slot 0 the donor's own cell.
  struct Donors
  {
    CellPack at;
    int slots = 1;
    int neighbour[most_slots][pack_width]; // the donor itself where it has less of them
    Pack x[4], y[4];                       // vertices about the centroid
    Pack centroid_x, centroid_y, area;
    Pack volume[most_slots], first_x[most_slots], first_y[most_slots]; // moments of the overlays about it
    Pack to_x[most_slots], to_y[most_slots];                           // weights of the gradient's components
    bool at_boundary[4];         // where the limiter guesses what lies beyond: face k of some of them
    int opposite[4][pack_width]; // the cell opposite of it; the donor itself where there is none
  };

  KOKKOS_FORCEINLINE_FUNCTION void load(int block, Donors &d) const
  {
    d.at = cellPack(stage.mesh, block);
    int const *const cell = d.at.cell;
    int first[pack_width], count[pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
    {
      first[lane] = stage.mesh.cell_neighbour.offset(cell[lane]);
      count[lane] = 1 + stage.mesh.cell_neighbour.offset(cell[lane] + 1) - first[lane];
      d.slots = Math::max(d.slots, count[lane]);
    }
    for (int s = 1; s < d.slots; ++s)
      for (int lane = 0; lane < pack_width; ++lane)
        d.neighbour[s][lane] = s < count[lane] ? stage.mesh.cell_neighbour.item(first[lane] + s - 1) : cell[lane];
    d.centroid_x = packOf([&](int lane) { return stage.shape(cell[lane], 0); });
    d.centroid_y = packOf([&](int lane) { return stage.shape(cell[lane], 1); });
    d.area = packOf([&](int lane) { return stage.shape(cell[lane], 2); });
    for (int k = 0; k < 4; ++k)
    {
      int node[pack_width];
      for (int lane = 0; lane < pack_width; ++lane)
        node[lane] = stage.mesh.cell_node(cell[lane], k);
      d.x[k] = packOf([&](int lane) { return stage.start(node[lane], 0); }) - d.centroid_x;
      d.y[k] = packOf([&](int lane) { return stage.start(node[lane], 1); }) - d.centroid_y;
    }
  }

  /// A donor that a side cuts into pieces, one by one.
  HARMOS_RARE_FUNCTION void cutAlone(Donors const &d, int lane, WindowPack const &w, double (&m)[3]) const
  {
    double x[4], y[4];
    Window window;
    for (int k = 0; k < 4; ++k)
    {
      x[k] = laneOf(d.x[k], lane);
      y[k] = laneOf(d.y[k], lane);
      window.x[k] = laneOf(w.x[k], lane);
      window.y[k] = laneOf(w.y[k], lane);
    }
    bool whole;
    Moments<2> const cut = momentsInside<Moments<2>, 4>(4, x, y, window, whole);
    Moments<2> const all = momentsOfVertices<Moments<2>>(4, x, y);
    for (int i = 0; i < 3; ++i)
      m[i] = whole ? all.value[i] : cut.value[i];
  }

  /// Moments of the overlay with the neighbours of a slot; none where there is no neighbour.
  KOKKOS_FORCEINLINE_FUNCTION void cut(Donors &d, int s) const
  {
    Pack corner[8];
    loadRows([&](int lane) { return &stage.corner(d.neighbour[s][lane], 0); }, corner);
    WindowPack w;
    for (int k = 0; k < 4; ++k)
    {
      w.x[k] = corner[k] - d.centroid_x;
      w.y[k] = corner[4 + k] - d.centroid_y;
    }
    OverlayPackOf<1> m = momentsInWindows<1>(4, d.x, d.y, w);
    if (any(m.pieces > Pack(1.0)))
      for (int lane = 0; lane < pack_width; ++lane)
      {
        if (!(laneOf(m.pieces, lane) > 1.0))
          continue;
        double one[3];
        cutAlone(d, lane, w, one);
        for (int i = 0; i < 3; ++i)
          m.value[i] = packOf([&](int l) { return l == lane ? one[i] : laneOf(m.value[i], l); });
      }
    Pack const there = packOf([&](int lane) { return d.neighbour[s][lane] != d.at.cell[lane] ? 1.0 : 0.0; });
    auto const counts = there * m.value[0] > Pack(least_part) * d.area;
    d.volume[s] = there * Math::max(m.value[0], Pack(0.0));
    d.first_x[s] = select(counts, m.value[1], Pack(0.0));
    d.first_y[s] = select(counts, m.value[2], Pack(0.0));
  }

  /// What the neighbours do not get stays.
  KOKKOS_FORCEINLINE_FUNCTION static void keepRest(Donors &d)
  {
    d.volume[0] = d.area;
    d.first_x[0] = d.first_y[0] = 0.0;
    for (int s = 1; s < d.slots; ++s)
    {
      d.volume[0] -= d.volume[s];
      d.first_x[0] -= d.first_x[s];
      d.first_y[0] -= d.first_y[s];
    }
  }

  /// Least squares: the weights of the neighbours' differences in the gradient.
  KOKKOS_FORCEINLINE_FUNCTION void weigh(Donors &d) const
  {
    Pack xx = 0.0, xy = 0.0, yy = 0.0;
    for (int s = 1; s < d.slots; ++s)
    {
      Pack const x = packOf([&](int lane) { return stage.shape(d.neighbour[s][lane], 0); }) - d.centroid_x;
      Pack const y = packOf([&](int lane) { return stage.shape(d.neighbour[s][lane], 1); }) - d.centroid_y;
      Pack const distance2 = x * x + y * y;
      auto const apart = distance2 > Pack(0.0);
      Pack const w = select(apart, Pack(1.0), Pack(0.0)) / select(apart, distance2, Pack(1.0));
      d.to_x[s] = w * x;
      d.to_y[s] = w * y;
      xx += d.to_x[s] * x;
      xy += d.to_x[s] * y;
      yy += d.to_y[s] * y;
    }
    // along a line where all neighbours lie on one
    Pack const trace = xx + yy, det = xx * yy - xy * xy;
    auto const line = det < 1e-6 * trace * trace;
    auto const some = trace > Pack(0.0);
    Pack const scale = select(some, Pack(1.0), Pack(0.0)) / select(some, select(line, trace, det), Pack(1.0));
    Pack const a = scale * select(line, Pack(1.0), yy), b = scale * select(line, Pack(0.0), -xy);
    Pack const c = scale * select(line, Pack(1.0), xx);
    for (int s = 1; s < d.slots; ++s)
    {
      Pack const x = d.to_x[s], y = d.to_y[s];
      d.to_x[s] = a * x + b * y;
      d.to_y[s] = b * x + c * y;
    }
  }

  /// Of the faces at which the mesh ends.
  KOKKOS_FORCEINLINE_FUNCTION void findOpposites(Donors &d) const
  {
    for (int k = 0; k < 4; ++k)
    {
      d.at_boundary[k] = false;
      for (int lane = 0; lane < pack_width; ++lane)
      {
        int const cell = d.at.cell[lane], face = stage.mesh.face_neighbour(cell, (k + 2) & 3);
        bool const ends = stage.range.extent(0) > 0 && stage.mesh.face_neighbour(cell, k) < 0 && face >= 0;
        d.opposite[k][lane] = ends ? face / 4 : cell;
        d.at_boundary[k] = d.at_boundary[k] || ends;
      }
    }
  }

  /// The part of a gradient that keeps the means of all overlays within range.
  KOKKOS_FORCEINLINE_FUNCTION static Pack limit(Donors const &d, Pack const &gx, Pack const &gy, Pack const &q,
                                                Pack const &lower, Pack const &upper)
  {
    Pack least = 0.0, most = 0.0;
    for (int s = 0; s < d.slots; ++s)
    {
      auto const counts = d.volume[s] > Pack(least_part) * d.area;
      Pack const change = (gx * d.first_x[s] + gy * d.first_y[s]) / select(counts, d.volume[s], Pack(1.0));
      least = Math::min(least, change);
      most = Math::max(most, change);
    }
    return partWithin(least, most, q, lower, upper);
  }

  /// Integrals of field f over the overlays.
  KOKKOS_FORCEINLINE_FUNCTION void integrate(int block, Donors const &d, int f) const
  {
    Pack const q = packOf([&](int lane) { return stage.fields.value(d.at.cell[lane], f); });
    Pack gx = 0.0, gy = 0.0;
    if (stage.order == 2)
    {
      Pack lower = q, upper = q;
      for (int s = 1; s < d.slots; ++s)
      {
        Pack const other = packOf([&](int lane) { return stage.fields.value(d.neighbour[s][lane], f); });
        gx += d.to_x[s] * (other - q);
        gy += d.to_y[s] * (other - q);
        lower = Math::min(lower, other);
        upper = Math::max(upper, other);
      }
      for (int k = 0; k < 4; ++k)
        if (d.at_boundary[k])
        {
          Pack const other = packOf([&](int lane) { return stage.fields.value(d.opposite[k][lane], f); });
          widenByMirrored(q, other, Pack(stage.range(f, 0)), Pack(stage.range(f, 1)), lower, upper);
        }
      if (stage.limiter != RemapLimiter::None)
      {
        Pack const part = limit(d, gx, gy, q, lower, upper);
        gx = part * gx;
        gy = part * gy;
      }
    }
    Pack rest = q * d.area;
    for (int s = 1; s < d.slots; ++s)
    {
      Pack const part = q * d.volume[s] + (gx * d.first_x[s] + gy * d.first_y[s]);
      rest -= part;
      storePack(stage.column(s, 1 + f) + block * pack_width, part);
    }
    storePack(stage.column(0, 1 + f) + block * pack_width, rest);
  }

  KOKKOS_INLINE_FUNCTION void operator()(int block) const
  {
    Donors d;
    load(block, d);
    for (int s = 1; s < d.slots; ++s)
      cut(d, s);
    keepRest(d);
    for (int s = 0; s < d.slots; ++s)
      storePack(stage.column(s, 0) + block * pack_width, d.volume[s]);
    if (stage.order == 2)
      weigh(d);
    findOpposites(d);
    for (int f = 0; f + 1 < stage.columns; ++f)
      integrate(block, d, f);
  }
};

/// New averages: the own part first, the neighbours' in ascending order, so that ranks add alike.
struct FieldGather
{
  FieldStage stage;

  KOKKOS_INLINE_FUNCTION void operator()(int cell, int &failures) const
  {
    int const begin = stage.mesh.cell_neighbour.offset(cell), end = stage.mesh.cell_neighbour.offset(cell + 1);
    double const volume = stage.mesh.cell_volume(cell);
    double const per_volume = 1.0 / volume;
    for (int c = 0; c < stage.columns; ++c)
    {
      double sum = stage.column(0, c)[cell];
      for (int j = begin; j < end; ++j)
        sum += stage.column(stage.links.slotBack(j), c)[stage.mesh.cell_neighbour.item(j)];
      if (c > 0)
        stage.remapped.value(cell, c - 1) = sum * per_volume;
      else if (stage.mesh.cell_depth(cell) == 0 && !(Math::fabs(sum - volume) <= 1e-10 * volume))
        ++failures;
    }
  }
};

} // namespace

int intersectFields(FieldStage const &stage)
{
  int const cells = stage.mesh.num_cells;
  int failures = 0;
  Kokkos::parallel_for("Harmos::remapFields::shapes", RangePolicy(0, cells), FieldShapes{stage});
  Kokkos::parallel_for("Harmos::remapFields::overlays", RangePolicy(0, numPacks(cells)), FieldOverlays{stage});
  Kokkos::parallel_reduce("Harmos::remapFields::gather", RangePolicy(0, cells), FieldGather{stage}, failures);
  return failures;
}

} // namespace RemapDetail
} // namespace Harmos
