// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_DonorPolynomial.hpp>
#include <detail/Harmos_QuadraticFit.hpp>
#include <detail/Harmos_SweptStage.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// Of the cell: what faces sweep beyond it. Less has a centroid (sweptGeometry), but round-off for corners: it counts
/// as a point. (Ahead of a wave velocities fade to 1e-100 of its own.)
constexpr double least_spread_part = 1e-10;

/// A pure cell with all nodes moved, and where stage 1 takes them.
struct SweptCorners
{
  Vector2 moved[4], home[4];
};

KOKKOS_INLINE_FUNCTION SweptCorners sweptCorners(SweptStage const &stage, int cell)
{
  SweptCorners c;
  int const pair = stage.first_pair[cell];
  for (int k = 0; k < 4; ++k)
  {
    int const node = stage.cell_node(cell, k), dof = stage.dof_node(pair, k);
    Vector2 const x{stage.position(node, 0), stage.position(node, 1)};
    c.moved[k] = x + stage.dt * Vector2{stage.half(dof, 0), stage.half(dof, 1)};
    bool const swept = (stage.flags[cell] & SweptCornerBit << k) != 0;
    Vector2 const home = stage.retargeted ? Vector2{stage.target(node, 0), stage.target(node, 1)} : x;
    c.home[k] = swept ? home : c.moved[k];
  }
  return c;
}

/// Central second moments of a polygon over its volume, which is known but for its sign, as is the centroid.
template <int Capacity>
KOKKOS_INLINE_FUNCTION void spreadOfPolygon(Polygon<Capacity> const &q, Geometry geometry, Vector2 const &centroid,
                                            double volume, double (&second)[3])
{
  Moments<2> const m = moments<2>(q, centroid, areaWeight(geometry, centroid));
  second[0] = m.second(0, 0) / volume;
  second[1] = m.second(0, 1) / volume;
  second[2] = m.second(1, 1) / volume;
}

/// Covariance of what face k sweeps out of the cell, whose volume and centroid are known: the quadrilateral between the
/// face before and after, or one of two triangles where these cross, with the end that goes out and the crossing as
/// corners (sweptGeometry finds them alike).
KOKKOS_INLINE_FUNCTION Spread spreadOfSwept(SweptCorners const &c, int k, Geometry geometry, double volume,
                                            Vector2 const &centroid)
{
  int const l = (k + 1) % 4;
  Spread s{centroid, {}};
  Vector2 const u_k = c.moved[k] - c.home[k], u_l = c.moved[l] - c.home[l], start = 0.5 * (c.moved[k] + c.home[k]);
  Vector2 const edge = 0.5 * (c.moved[l] + c.home[l]) - start;
  double const at_k = cross(u_k, edge), at_l = cross(u_l, edge);
  if (at_k * at_l < 0.0)
  {
    double const along = at_k / (at_k - at_l), back = 1.0 - along;
    double const apart = -dot(back * u_k + along * u_l, edge) / dot(edge, edge), q = 0.25 * apart * apart;
    int const out = at_k > 0.0 ? k : l;
    if (along * along > q && back * back > q)
    {
      Polygon<3> triangle;
      triangle.size = 3;
      triangle[0] = c.home[out];
      triangle[1] = c.moved[out];
      triangle[2] = start + along * edge + (0.25 * apart) * (u_l - u_k);
      spreadOfPolygon(triangle, geometry, centroid, out == k ? volume : -volume, s.second);
      return s;
    }
  }
  Quadrilateral q;
  q.size = 4;
  q[0] = c.home[k];
  q[1] = c.home[l];
  q[2] = c.moved[l];
  q[3] = c.moved[k];
  spreadOfPolygon(q, geometry, centroid, at_k + at_l > 0.0 ? -volume : volume, s.second);
  return s;
}

struct SweptSpreadFunctor
{
  SweptStage stage;

  KOKKOS_INLINE_FUNCTION void operator()(int cell) const
  {
    if ((stage.flags[cell] & PureCellBit) == 0)
      return;
    SweptCorners const c = sweptCorners(stage, cell);
    Quadrilateral q;
    q.size = 4;
    for (int k = 0; k < 4; ++k)
      q[k] = c.moved[k];
    double second[3];
    spreadOfPolygon(q, stage.geometry, {*stage.at(CentroidX, cell), *stage.at(CentroidY, cell)},
                    *stage.at(MovedVolume, cell), second);
    for (int i = 0; i < 3; ++i)
      stage.spread(cell & stage.mask, i) = second[i];
  }
};

/// Means of the monomials x, y, xx, xy, yy from a centroid, over a region.
struct FiveMeans
{
  double value[5];
};

KOKKOS_INLINE_FUNCTION FiveMeans fiveMeans(Spread const &s, Vector2 const &from)
{
  Vector2 const d = s.centroid - from;
  return {{d[0], d[1], s.second[0] + d[0] * d[0], s.second[1] + d[0] * d[1], s.second[2] + d[1] * d[1]}};
}

struct SweptQuadraticFunctor
{
  SweptStage stage;

  /// A cell that loses material.
  struct Donor
  {
    int cell;
    Spread spread;
    FieldPack q, lower, upper; // SpecificVolume: its ratio to the volume that it fills, until boundSpecificVolume
    double least, largest;     // specific volume around
    FieldPack coefficient[5];
    double volume, density;
    double swept_volume[4], swept_mass[4];
    Spread swept[4];
    FieldPack deviation[4]; // of the means over the swept areas
  };

  KOKKOS_INLINE_FUNCTION Spread spreadOf(int cell) const
  {
    double const *second = stage.spread.row(cell & stage.mask);
    return {{*stage.at(CentroidX, cell), *stage.at(CentroidY, cell)}, {second[0], second[1], second[2]}};
  }

  KOKKOS_INLINE_FUNCTION double fieldOf(int cell, int field) const { return *stage.at(FieldColumn + field, cell); }

  /// The fields of a cell, with rho s in place of the specific volume s (SweptFluxFunctor::remapSpecificVolume).
  KOKKOS_INLINE_FUNCTION FieldPack valueOf(int cell) const
  {
    double q[FieldPack::fields];
    for (int f = 0; f < FieldPack::fields; ++f)
      q[f] = fieldOf(cell, f);
    q[SpecificVolume] *= q[DensityField];
    return FieldPack(q);
  }

  KOKKOS_INLINE_FUNCTION void fit(Donor &d) const
  {
    QuadraticFit<FieldPack> fit(d.spread, d.volume);
    d.lower = d.upper = d.q;
    d.least = d.largest = fieldOf(d.cell, SpecificVolume);
    for (int j = stage.first_neighbour[d.cell]; j < stage.first_neighbour[d.cell + 1]; ++j)
    {
      int const neighbour = stage.neighbour[j];
      if ((stage.flags[neighbour] & PureCellBit) == 0 || stage.pure_material[neighbour] != stage.pure_material[d.cell])
        continue;
      FieldPack const value = valueOf(neighbour);
      d.lower = lesser(d.lower, value);
      d.upper = greater(d.upper, value);
      d.least = Math::min(d.least, fieldOf(neighbour, SpecificVolume));
      d.largest = Math::max(d.largest, fieldOf(neighbour, SpecificVolume));
      fit.add(spreadOf(neighbour), 1.0, value - d.q);
    }
    double const least_ratio = d.lower[SpecificVolume], largest_ratio = d.upper[SpecificVolume];
    for (int k = 0; k < 4; ++k)
      if (stage.endsAt(d.cell, k) && stage.sameBeyond(d.cell, (k + 2) & 3))
      {
        int const opposite = stage.face_neighbour(d.cell, (k + 2) & 3) >> 2;
        double const *least = stage.leastOf(d.cell), *largest = stage.largestOf(d.cell);
        PolynomialFinder::widenFields(d.q, valueOf(opposite), least, largest, d.lower, d.upper);
        widenByDensity(d.q[SpecificVolume], d.lower[DensityField], d.upper[DensityField], least[SpecificVolume],
                       largest[SpecificVolume], d.least, d.largest);
      }
    d.lower.set<SpecificVolume>(least_ratio);
    d.upper.set<SpecificVolume>(largest_ratio);
    bool const fitted = fit.solve();
    for (int i = 0; i < 5; ++i)
      d.coefficient[i] = fitted ? fit.right[i] : FieldPack(0.0);
  }

  /// Deviations by volume (then the density's are right), or by volume and mass.
  KOKKOS_INLINE_FUNCTION static void deviate(Donor &d, Vector2 const &slope, bool by_mass)
  {
    FiveMeans const whole = fiveMeans(d.spread, d.spread.centroid);
    for (int k = 0; k < 4; ++k)
    {
      d.deviation[k] = FieldPack(0.0);
      if (!(d.swept_volume[k] > 0.0))
        continue;
      FiveMeans const part = fiveMeans(d.swept[k], d.spread.centroid);
      Vector2 shift{0.0, 0.0};
      if (by_mass)
        shift =
            massOffset(d.swept[k], slope, d.swept_mass[k] / d.swept_volume[k]) - massOffset(d.spread, slope, d.density);
      for (int i = 0; i < 5; ++i)
      {
        double const mean = part.value[i] - whole.value[i];
        d.deviation[k] += d.coefficient[i] * fieldWeights(mean, i < 2 ? mean + shift[i] : mean);
      }
    }
  }

  /// The mass centroid from the centroid.
  KOKKOS_INLINE_FUNCTION static Vector2 massOffset(Spread const &s, Vector2 const &slope, double density)
  {
    double const per_density = 1.0 / density;
    return {per_density * (s.second[0] * slope[0] + s.second[1] * slope[1]),
            per_density * (s.second[1] * slope[0] + s.second[2] * slope[1])};
  }

  /// Limits the deviations: each into the range by itself, then all by one factor so far that the mean of what stays is
  /// in it too (SweptFluxFunctor::keepWithin). \param staying Volume and mass that stay.
  KOKKOS_INLINE_FUNCTION void limit(Donor &d, double staying_volume, double staying_mass) const
  {
    RemapLimiter const limiter = stage.limiter;
    if (limiter == RemapLimiter::None)
      return;
    if (limiter == RemapLimiter::VanLeer)
    {
      FieldPack part = vanLeer(d);
      part.set<SpecificVolume>(1.0); // boundSpecificVolume's deviations hold it already
      for (int k = 0; k < 4; ++k)
        d.deviation[k] = part * d.deviation[k];
      return;
    }
    FieldPack const above = d.upper - d.q, below = d.lower - d.q;
    FieldPack left(0.0);
    for (int k = 0; k < 4; ++k)
    {
      d.deviation[k] = greater(below, lesser(d.deviation[k], above));
      left -= fieldWeights(d.swept_volume[k], d.swept_mass[k]) * d.deviation[k];
    }
    // Where all of a cell leaves, no mean of what stays bounds anything (largestSweptPart).
    left = left * fieldWeights(staying_volume > 0.0 ? 1.0 / staying_volume : 0.0,
                               staying_mass > 0.0 ? 1.0 / staying_mass : 0.0);
    for (int p = 0; p < FieldPack::parts; ++p)
    {
      Pack const least = Math::min(left.part[p], Pack(0.0)), most = Math::max(left.part[p], Pack(0.0));
      Pack const part = partWithin<Pack>(least, most, d.q.part[p], d.lower.part[p], d.upper.part[p]);
      for (int k = 0; k < 4; ++k)
        d.deviation[k].part[p] = part * d.deviation[k].part[p];
    }
  }

  /// The specific volume in place of its ratio: deviations of what is swept, value and range.
  /// \param ratio Deviations of the ratio by volume.
  KOKKOS_INLINE_FUNCTION void boundSpecificVolume(Donor &d, double const ratio[4]) const
  {
    bool const by_range = stage.limiter == RemapLimiter::Range || stage.limiter == RemapLimiter::RangeInside;
    double const own = fieldOf(d.cell, SpecificVolume), mean = d.q[SpecificVolume];
    double const part = stage.limiter == RemapLimiter::VanLeer ? vanLeer(d)[SpecificVolume] : 1.0;
    for (int k = 0; k < 4; ++k)
    {
      double swept = mean + part * ratio[k];
      if (by_range)
        swept = Math::max(d.lower[SpecificVolume], Math::min(swept, d.upper[SpecificVolume]));
      d.deviation[k].set<SpecificVolume>(d.swept_mass[k] > 0.0 ? d.swept_volume[k] * swept / d.swept_mass[k] - own
                                                               : 0.0);
    }
    d.q.set<SpecificVolume>(own);
    d.lower.set<SpecificVolume>(d.least);
    d.upper.set<SpecificVolume>(d.largest);
  }

  KOKKOS_INLINE_FUNCTION FieldPack vanLeer(Donor const &d) const
  {
    PolynomialFinder::FaceNeighbours beyond;
    for (int k = 0; k < 4; ++k)
    {
      if ((stage.flags[d.cell] & SameBeyondBit << k) == 0)
        continue;
      int const neighbour = stage.face_neighbour(d.cell, k) >> 2;
      beyond.offset[beyond.size] = spreadOf(neighbour).centroid - d.spread.centroid;
      beyond.difference[beyond.size++] = {valueOf(neighbour) - d.q, FieldPack(0.0)};
    }
    FieldPack part;
    for (int p = 0; p < FieldPack::parts; ++p)
      part.part[p] =
          PolynomialFinder::vanLeerPart(beyond, false, p, d.coefficient[0].part[p], d.coefficient[1].part[p]);
    return part;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int cell) const
  {
    if ((stage.flags[cell] & PureCellBit) == 0)
      return;
    double swept_volume = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      swept_volume += stage.sweptOut(cell, k);
      storeFlux(cell, k, FieldPack(0.0));
    }
    if (!(swept_volume > 0.0))
      return;
    Donor d;
    d.cell = cell;
    d.spread = spreadOf(cell);
    d.volume = *stage.at(MovedVolume, cell);
    d.density = fieldOf(cell, DensityField);
    d.q = valueOf(cell);
    SweptCorners const corners = sweptCorners(stage, cell);
    double staying_volume = d.volume;
    for (int k = 0; k < 4; ++k)
    {
      d.swept_volume[k] = stage.sweptOut(cell, k);
      d.swept_mass[k] = 0.0;
      staying_volume -= d.swept_volume[k];
      if (!(d.swept_volume[k] > 0.0))
      {
        d.swept[k] = {d.spread.centroid, {0.0, 0.0, 0.0}};
        continue;
      }
      int const column = OffsetColumn + 2 * stage.slotOf(cell, k);
      Vector2 const offset{*stage.at(column, cell), *stage.at(column + 1, cell)};
      if (!(d.swept_volume[k] > least_spread_part * d.volume))
        d.swept[k] = {d.spread.centroid + offset, {0.0, 0.0, 0.0}};
      else
        d.swept[k] = spreadOfSwept(corners, k, stage.geometry, d.swept_volume[k], d.spread.centroid + offset);
    }
    fit(d);

    // Density first: it gives the mass fluxes that weigh the primitives.
    deviate(d, {0.0, 0.0}, false);
    double staying_mass = d.volume * d.density, ratio[4], whole[4];
    for (int k = 0; k < 4; ++k)
    {
      ratio[k] = d.deviation[k][SpecificVolume];
      whole[k] = d.deviation[k][DensityField];
    }
    limit(d, staying_volume, 0.0);
    double left = 0.0, all = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      left += d.swept_volume[k] * Math::fabs(d.deviation[k][DensityField]);
      all += d.swept_volume[k] * Math::fabs(whole[k]);
      d.swept_mass[k] = d.swept_volume[k] * (d.density + d.deviation[k][DensityField]);
      staying_mass -= d.swept_mass[k];
    }
    double const part = all > 0.0 ? left / all : 1.0; // of the slope, on the whole
    deviate(d, part * Vector2{d.coefficient[0][DensityField], d.coefficient[1][DensityField]}, true);
    boundSpecificVolume(d, ratio);
    limit(d, staying_volume, staying_mass);
    for (int k = 0; k < 4; ++k)
    {
      if (!(d.swept_volume[k] > 0.0))
        continue;
      FieldPack flux = fieldWeights(d.swept_volume[k], d.swept_mass[k]) * (d.q + d.deviation[k]);
      flux.set<DensityField>(d.swept_mass[k]);
      storeFlux(cell, stage.slotOf(cell, k), flux);
    }
  }

  KOKKOS_INLINE_FUNCTION void storeFlux(int cell, int slot, FieldPack const &flux) const
  {
    for (int f = 0; f < FieldPack::fields; ++f)
      *stage.at(FaceColumn + num_face_columns * slot + 1 + f, cell) = flux[f];
  }
};

} // namespace

void sweptSpread(SweptStage const &stage, int begin, int end)
{
  Kokkos::parallel_for("Harmos::remap::sweptSpread", RangePolicy(begin, end), SweptSpreadFunctor{stage});
}

void sweptQuadraticFluxes(SweptStage const &stage, int begin, int end)
{
  Kokkos::parallel_for("Harmos::remap::sweptQuadraticFluxes", RangePolicy(begin, end), SweptQuadraticFunctor{stage});
}

} // namespace RemapDetail
} // namespace Harmos
