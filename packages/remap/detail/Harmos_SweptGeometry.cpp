// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_LoadPoints.hpp>
#include <Harmos_Prefetch.hpp>
#include <Harmos_Select.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

struct PackedVector
{
  Pack x, y;
};

KOKKOS_FORCEINLINE_FUNCTION PackedVector operator+(PackedVector const &a, PackedVector const &b)
{
  return {a.x + b.x, a.y + b.y};
}
KOKKOS_FORCEINLINE_FUNCTION PackedVector operator-(PackedVector const &a, PackedVector const &b)
{
  return {a.x - b.x, a.y - b.y};
}
KOKKOS_FORCEINLINE_FUNCTION PackedVector operator*(Pack const &s, PackedVector const &a)
{
  return {s * a.x, s * a.y};
}
KOKKOS_FORCEINLINE_FUNCTION Pack cross(PackedVector const &a, PackedVector const &b)
{
  return a.x * b.y - a.y * b.x;
}

/// What an edge a -> b, ends moved by u_a and u_b, sweeps out of the cell on its left.
struct Swept
{
  Pack volume;         // >= 0
  PackedVector centre; // from a at mid-step unless said; zero where nothing leaves
};

/// The volume of either sign (sweptWhole, sweptRing).
template <Geometry geometry>
KOKKOS_FORCEINLINE_FUNCTION Pack sweptVolume(Pack const &radius, PackedVector const &edge, PackedVector const &u_a,
                                             PackedVector const &u_b, Pack const &d_a, Pack const &d_b)
{
  Pack const area = 0.5 * (d_a + d_b);
  if constexpr (geometry == Geometry::Planar)
    return area;
  else
    return radius * area +
           ((d_a + 2.0 * d_b) * (1.0 / 6.0) * edge.x + cross(u_a, u_b) * (1.0 / 24.0) * (u_a.x + u_b.x));
}

/// With E the edge at mid-step, d_a = u_a x E, d_b = u_b x E: the signed area between the edge before and after has
/// V = (d_a + d_b) / 2 and the first moment E (d_a + 2 d_b) / 6 + (u_a x u_b) (u_a + u_b) / 24 about a, both exactly.
KOKKOS_FORCEINLINE_FUNCTION Swept sweptWhole(Pack const &volume, PackedVector const &edge, PackedVector const &u_a,
                                             PackedVector const &u_b, Pack const &d_a, Pack const &d_b)
{
  // What is no more than round-off, or too small for its reciprocal (ahead of a wave velocities fade that far), has no
  // centroid.
  auto const leaves = volume > Math::max(Pack(1e-280), Pack(1e-14 * Math::fabs(d_a - d_b)));
  Pack const per_volume = select(leaves, Pack(1.0), Pack(0.0)) / select(leaves, volume, Pack(1.0));
  Pack const along = (d_a + 2.0 * d_b) * (per_volume * (1.0 / 6.0));
  Pack const across = cross(u_a, u_b) * (per_volume * (1.0 / 24.0));
  return {select(leaves, volume, Pack(0.0)), along * edge + across * (u_a + u_b)};
}

/// sweptWhole for rings, a at mid-step at `radius`. With V and F its plane volume and first moment about a, the plane
/// second moments are, c = u_a x u_b and xy standing for (x y + y x) / 2 (points s E + t (u_a + s (u_b - u_a)),
/// Jacobian d_a + s (d_b - d_a) + t c, 0 < s < 1, |t| < 1/2): S = EE (d_a + 3 d_b) / 12 + c E(u_a + 2 u_b) / 36
///   + ((3 d_a + d_b) u_a u_a + 2 (d_a + d_b) u_a u_b + (d_a + 3 d_b) u_b u_b) / 144;
/// the volume is radius V + F_x (sweptVolume), its first moment radius F + S_x. Zero without motion, to the bit.
KOKKOS_FORCEINLINE_FUNCTION Swept sweptRing(Pack const &volume, Pack const &radius, PackedVector const &edge,
                                            PackedVector const &u_a, PackedVector const &u_b, Pack const &d_a,
                                            Pack const &d_b)
{
  Pack const turn = cross(u_a, u_b);
  PackedVector const first = Pack((d_a + 2.0 * d_b) * (1.0 / 6.0)) * edge + Pack(turn * (1.0 / 24.0)) * (u_a + u_b);
  PackedVector const later = u_a + Pack(2.0) * u_b;
  Pack const ee = (d_a + 3.0 * d_b) * (1.0 / 12.0), eu = turn * (1.0 / 72.0);
  Pack const aa = (3.0 * d_a + d_b) * (1.0 / 144.0), ab = (d_a + d_b) * (1.0 / 144.0), bb = ee * (1.0 / 12.0);
  Pack const xx = ee * edge.x * edge.x + 2.0 * eu * edge.x * later.x + aa * u_a.x * u_a.x + 2.0 * ab * u_a.x * u_b.x +
                  bb * u_b.x * u_b.x;
  Pack const xy = ee * edge.x * edge.y + eu * (edge.x * later.y + edge.y * later.x) + aa * u_a.x * u_a.y +
                  ab * (u_a.x * u_b.y + u_a.y * u_b.x) + bb * u_b.x * u_b.y;
  auto const leaves =
      volume > Math::max(Pack(1e-280), Pack(1e-14 * Math::fabs(d_a - d_b) * (radius + Math::fabs(edge.x))));
  Pack const per_volume = select(leaves, Pack(1.0), Pack(0.0)) / select(leaves, volume, Pack(1.0));
  return {select(leaves, volume, Pack(0.0)), per_volume * PackedVector{radius * first.x + xx, radius * first.y + xy}};
}

/// Per radian: integrals of r and of r x over triangles, x from some base at radius `base`. Over one of area A,
/// A (sum r_i) / 3 and A ((sum r_i) (sum x_i) + sum r_i x_i) / 12.
struct RingSum
{
  Pack base;
  Pack volume = 0.0;
  PackedVector first = {Pack(0.0), Pack(0.0)};

  KOKKOS_FORCEINLINE_FUNCTION explicit RingSum(Pack const &radius) : base(radius) {}

  KOKKOS_FORCEINLINE_FUNCTION void add(Pack const &area, PackedVector const &a, PackedVector const &b,
                                       PackedVector const &c)
  {
    Pack const ra = base + a.x, rb = base + b.x, rc = base + c.x;
    Pack const sum = ra + rb + rc;
    volume += area * sum * (1.0 / 3.0);
    Pack const twelfth = area * (1.0 / 12.0);
    first.x += twelfth * (sum * (a.x + b.x + c.x) + (ra * a.x + rb * b.x + rc * c.x));
    first.y += twelfth * (sum * (a.y + b.y + c.y) + (ra * a.y + rb * b.y + rc * c.y));
  }
};

/// Where the edges before and after cross, in a point p, one of the triangles between them leaves the cell and the
/// other enters it: each has its own donor. At mid-step the crossing is the part alpha = d_a / (d_a - d_b) along the
/// edge; before and after it is half of delta = -w.E / E.E apart, w the motion there:
/// p = alpha E + delta (u_b - u_a) / 4, V_a = (alpha^2 - delta^2/4) (d_a - d_b) / 2, V_b likewise with 1 - alpha.
/// `radius` is that of a at mid-step.
template <Geometry geometry>
KOKKOS_FORCEINLINE_FUNCTION void splitWhereEdgesCross(Pack const &radius, PackedVector const &edge,
                                                      PackedVector const &u_a, PackedVector const &u_b, Pack const &d_a,
                                                      Pack const &d_b, Swept &swept)
{
  auto const opposite = d_a * d_b < Pack(0.0);
  if (!any(opposite))
    return;
  Pack const difference = select(opposite, Pack(d_a - d_b), Pack(1.0));
  Pack const alpha = d_a / difference, beta = -d_b / difference;
  PackedVector const w = beta * u_a + alpha * u_b;
  Pack const length2 = edge.x * edge.x + edge.y * edge.y;
  Pack const delta = -(w.x * edge.x + w.y * edge.y) / select(opposite, length2, Pack(1.0));
  Pack const q = 0.25 * delta * delta;
  Pack const part_a = alpha * alpha - q, part_b = beta * beta - q;
  auto const crosses = both(both(opposite, part_a > Pack(0.0)), part_b > Pack(0.0));
  PackedVector const p = alpha * edge + Pack(0.25 * delta) * (u_b - u_a);
  auto const at_a = d_a > Pack(0.0);
  Pack const volume = 0.5 * Math::fabs(difference) * select(at_a, part_a, part_b);
  if constexpr (geometry == Geometry::Axisymmetric)
  {
    // one corner is the crossing, the others are the end before and after
    Pack const end = select(at_a, Pack(0.0), Pack(1.0)), start = Pack(1.0) - end;
    PackedVector const half = Pack(0.5) * (start * u_a + end * u_b), at = end * edge;
    RingSum sum(radius);
    sum.add(select(crosses, volume, Pack(0.0)), p, at + half, at - half);
    auto const leaves = sum.volume > Pack(1e-280); // as in sweptRing: else it has no centroid
    Pack const per_volume = 1.0 / select(leaves, sum.volume, Pack(1.0));
    swept.volume = select(leaves, sum.volume, swept.volume);
    swept.centre = {select(leaves, Pack(per_volume * sum.first.x), swept.centre.x),
                    select(leaves, Pack(per_volume * sum.first.y), swept.centre.y)};
    return;
  }
  Pack const third = 1.0 / 3.0, end = select(at_a, Pack(0.0), Pack(2.0));
  PackedVector const centre = third * (p + end * edge);
  swept.volume = select(crosses, volume, swept.volume);
  swept.centre = {select(crosses, centre.x, swept.centre.x), select(crosses, centre.y, swept.centre.y)};
}

template <Geometry geometry>
struct SweptGeometryFunctor
{
  SweptStage stage;
  int begin, end;

  /// 1 in the lanes whose bit is set.
  KOKKOS_FORCEINLINE_FUNCTION static Pack bitOf(int const flags[pack_width], int common, int bit)
  {
    return (common & bit) != 0 ? Pack(1.0) : packOf([&](int lane) { return (flags[lane] & bit) != 0 ? 1.0 : 0.0; });
  }

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int block) const
  {
    int const first = begin + block * pack_width;
    int const count = Math::min(pack_width, end - first);
    int common = ~0; // of the cells at work
    for (int lane = 0; lane < count; ++lane)
      common &= stage.flags[first + lane];
    bool const whole = count == pack_width && (common & PureCellBit) != 0;
    stage.blockOf(first) = 0;
    int cell[pack_width], pair[pack_width], flags[pack_width];
    if (whole)
      for (int lane = 0; lane < pack_width; ++lane)
      {
        cell[lane] = first + lane;
        pair[lane] = stage.first_pair[first] + lane;
        flags[lane] = stage.flags[cell[lane]];
      }
    else if (!selectPure(first, count, cell, pair, flags, common))
      return;
    int const leaving = compute(first, cell, pair, whole, flags, common);
    constexpr int all_neighbours = 15 * NeighbourBit;
    stage.blockOf(first) = leaving | (whole ? WholeBit | runsBeyond(first, common) : 0) |
                           ((common & all_neighbours) == all_neighbours ? 0 : BoundaryBit) |
                           ((common & OwnedCellBit) != 0 ? OwnedBit : 0);
  }

  /// The pure cells; the other lanes repeat the first of those. \return Whether there is one.
  HARMOS_RARE_FUNCTION bool selectPure(int first, int count, int cell[pack_width], int pair[pack_width],
                                       int flags[pack_width], int &common) const
  {
    int lead = 0;
    while (lead < count && (stage.flags[first + lead] & PureCellBit) == 0)
      ++lead;
    if (lead == count)
      return false;
    common = ~0;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      bool const pure = lane < count && (stage.flags[first + lane] & PureCellBit) != 0;
      cell[lane] = first + (pure ? lane : lead);
      pair[lane] = stage.first_pair[cell[lane]];
      flags[lane] = stage.flags[cell[lane]];
      common &= flags[lane];
    }
    return true;
  }

  /// RunBit of the faces beyond which the neighbours are a run of cells on a run of rows, AcrossBit of those beyond
  /// which the rows are in two tiles.
  KOKKOS_FORCEINLINE_FUNCTION int runsBeyond(int first, int common) const
  {
    int const *face = stage.face_neighbour.row(first);
    CornerNumbers const differs = differencesFromCount(face, 4); // a face's number is four times its cell's and more
    int runs = 0;
    for (int k = 0; k < 4; ++k)
      if ((common & SameBeyondBit << k) != 0 && differs[k] == 0)
        runs |= (stage.inTile(face[k] >> 2) ? RunBit : AcrossBit) << k;
    return runs;
  }

  struct Volume
  {
    Pack volume, inverse;
    PackedVector centroid;
  };

  KOKKOS_FORCEINLINE_FUNCTION static Volume volumeOf(PackedVector const (&moved)[4])
  {
    PackedVector const d1 = moved[1] - moved[0];
    PackedVector const d2 = moved[2] - moved[0];
    PackedVector const d3 = moved[3] - moved[0];
    if constexpr (geometry == Geometry::Axisymmetric)
    {
      RingSum sum(moved[0].x);
      PackedVector const none = {Pack(0.0), Pack(0.0)};
      sum.add(0.5 * cross(d1, d2), none, d1, d2);
      sum.add(0.5 * cross(d2, d3), none, d2, d3);
      Pack const inverse = 1.0 / sum.volume;
      return {sum.volume, inverse, moved[0] + inverse * sum.first};
    }
    else
    {
      Pack const lower = 0.5 * cross(d1, d2);
      Pack const upper = 0.5 * cross(d2, d3);
      Pack const area = lower + upper;
      Pack const inverse = 1.0 / area;
      Pack const third = inverse * (1.0 / 3.0);
      return {area, inverse, moved[0] + ((lower * third) * (d1 + d2) + (upper * third) * (d2 + d3))};
    }
  }

  /// \return LeaveBit, SecondBit.
  KOKKOS_FORCEINLINE_FUNCTION int compute(int first, int const cell[pack_width], int const pair[pack_width], bool whole,
                                          int const flags[pack_width], int common) const
  {
    double *const own = stage.at(0, first); // once: what is stored might be the stage's numbers, for all compilers know
    auto const store = [&](int column, Pack const &value) { storePack(own + column * column_stride, value); };
    readAhead(stage.record, pair[0]);
    readAhead(stage.cell_node, cell[0]);
    readAhead(stage.dof_node, pair[0]);
    readAhead(stage.face_neighbour, cell[0]);
    readAhead(stage.position, stage.cell_node(cell[0], 2));
    readAhead(stage.half, stage.dof_node(pair[0], 2));
    readAhead(stage.flags, cell[0]);
    readAhead(stage.first_pair, cell[0]);
    PackedVector moved[4], middle[4], back[4];
    PackedCornerRows const nodes(stage.cell_node, cell, whole), dofs(stage.dof_node, pair, whole);
    HARMOS_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      PackedVector x, v;
      loadCorner(nodes, stage.position, k, x.x, x.y);
      loadCorner(dofs, stage.half, k, v.x, v.y);
      store(CornerColumn + 2 * k, v.x);
      store(CornerColumn + 2 * k + 1, v.y);
      PackedVector const u = Pack(stage.dt) * v;
      moved[k] = x + u;
      PackedVector homeward = u;
      if (stage.retargeted)
      {
        PackedVector home;
        loadCorner(nodes, stage.target, k, home.x, home.y);
        homeward = u + (x - home);
      }
      back[k] = bitOf(flags, common, SweptCornerBit << k) * homeward;
      middle[k] = moved[k] - Pack(0.5) * back[k];
    }
    Volume const cell_volume = volumeOf(moved);
    PackedVector const centroid = cell_volume.centroid;
    store(CentroidX, centroid.x);
    store(CentroidY, centroid.y);
    store(MovedVolume, cell_volume.volume);
    storeFields(own, pair, whole, cell_volume.inverse);

    int leaving = 0;
    HARMOS_UNROLL
    for (int k = 0; k < 2; ++k)
    {
      Swept const one = sweptOut(k, back, middle, centroid, flags, common);
      Swept const other = sweptOut(k + 2, back, middle, centroid, flags, common);
      auto const leaves = one.volume > Pack(0.0), leaves_other = other.volume > Pack(0.0);
      auto const second = both(leaves, leaves_other);
      store(FaceColumn + num_face_columns * k, one.volume);
      store(FaceColumn + num_face_columns * (k + 2), select(second, -other.volume, other.volume));
      store(OffsetColumn + 2 * k, select(leaves, one.centre.x, other.centre.x));
      store(OffsetColumn + 2 * k + 1, select(leaves, one.centre.y, other.centre.y));
      leaving |= any(either(leaves, leaves_other)) ? LeaveBit : 0;
      if (!any(second))
        continue;
      leaving |= SecondBit << k;
      store(OffsetColumn + 2 * (k + 2), select(second, other.centre.x, Pack(0.0)));
      store(OffsetColumn + 2 * (k + 2) + 1, select(second, other.centre.y, Pack(0.0)));
    }
    return leaving;
  }

  /// What face k sweeps out of the cell, its centroid from the cell's; zero where nothing leaves.
  KOKKOS_FORCEINLINE_FUNCTION Swept sweptOut(int k, PackedVector const (&back)[4], PackedVector const (&middle)[4],
                                             PackedVector const &centroid, int const flags[pack_width],
                                             int common) const
  {
    PackedVector const none = {Pack(0.0), Pack(0.0)};
    int const next = (k + 1) % 4;
    PackedVector const edge = middle[next] - middle[k];
    Pack const d_a = cross(back[k], edge), d_b = cross(back[next], edge);
    Pack const volume = sweptVolume<geometry>(middle[k].x, edge, back[k], back[next], d_a, d_b);
    if (!any(either(volume > Pack(0.0), d_a * d_b < Pack(0.0))))
      return {Pack(0.0), none};
    Swept swept;
    if constexpr (geometry == Geometry::Planar)
      swept = sweptWhole(volume, edge, back[k], back[next], d_a, d_b);
    else
      swept = sweptRing(volume, middle[k].x, edge, back[k], back[next], d_a, d_b);
    splitWhereEdgesCross<geometry>(middle[k].x, edge, back[k], back[next], d_a, d_b, swept);
    Pack const out = bitOf(flags, common, NeighbourBit << k) * swept.volume;
    auto const leaves = out > Pack(0.0);
    PackedVector const c = (middle[k] - centroid) + swept.centre;
    return {out, {select(leaves, c.x, Pack(0.0)), select(leaves, c.y, Pack(0.0))}};
  }

  /// What is remapped, and the mass.
  KOKKOS_FORCEINLINE_FUNCTION void storeFields(double *own, int const pair[pack_width], bool run,
                                               Pack const &per_volume) const
  {
    Pack field[num_pair_fields];
    loadIndexedRows(stage.record, pair, run, field);
    storePack(own + OldMass * column_stride, field[Mass]);
    field[DensityField] = field[Mass] * per_volume;
    if (stage.carries())
      field[KineticField] = packOf([&](int lane) { return stage.damage[pair[lane]]; });
    for (int f = 0; f < num_pair_fields; ++f)
      storePack(own + (FieldColumn + f) * column_stride, field[f]);
  }
};

} // namespace

void sweptGeometry(SweptStage const &stage, int begin, int end)
{
  RangePolicy const range(0, numPacks(end - begin));
  if (stage.geometry == Geometry::Planar)
    Kokkos::parallel_for("Harmos::remap::sweptGeometry", range,
                         SweptGeometryFunctor<Geometry::Planar>{stage, begin, end});
  else
    Kokkos::parallel_for("Harmos::remap::sweptGeometry", range,
                         SweptGeometryFunctor<Geometry::Axisymmetric>{stage, begin, end});
}

} // namespace RemapDetail
} // namespace Harmos
