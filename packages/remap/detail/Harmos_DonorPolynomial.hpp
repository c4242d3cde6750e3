// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DONOR_POLYNOMIAL_HPP
#define HARMOS_DONOR_POLYNOMIAL_HPP

#include <detail/Harmos_Donors.hpp>

#include <Harmos_AreaWeight.hpp>
#include <detail/Harmos_OverlayList.hpp>
#include <detail/Harmos_RangeLimit.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Linear polynomials of a donor's fields: density and deviator about the centroid c, primitives about the mass
/// centroid c + e.
struct DonorPolynomial
{
  StageFields mean, x, y; // mean, gradient
  Vector2 mass_offset;    // e
};

KOKKOS_INLINE_FUNCTION DonorPolynomial constantPolynomial(StageFields const &mean)
{
  return {mean, stageFields(0.0), stageFields(0.0), {0.0, 0.0}};
}

/// Vertices relative to the donor's centroid.
struct MovedVertices
{
  int size;
  double x[max_region_vertices], y[max_region_vertices];
};

KOKKOS_INLINE_FUNCTION MovedVertices verticesAbout(Region const &region, Vector2 const &centre)
{
  MovedVertices v;
  v.size = region.size;
  for (int i = 0; i < region.size; ++i)
  {
    v.x[i] = region[i][0] - centre[0];
    v.y[i] = region[i][1] - centre[1];
  }
  return v;
}

/// Weights of a linear polynomial's mean and gradient in its integrals over a part of a donor: by volume, by mass.
struct LinearWeights
{
  double volume, mass;
  Vector2 by_volume, by_mass; // of the gradients
};

/// Finds polynomials: gradients from least squares over the same-material pairs of the vertex neighbours, limited
/// in the mean of every overlay to their range.
///
/// Gradients of the corner velocities come from velocities before stage 1, so that they need no wider halo.
struct PolynomialFinder
{
  using Polynomial = DonorPolynomial;
  using OverlayMoments = Moments<2>;
  using PlaneMoments = Moments<2>; // what an overlay is integrated by
  static KOKKOS_INLINE_FUNCTION constexpr bool overlaysInPacks() { return true; }

  Input in;
  Classes classes;
  StageState stage;
  Donors donors;

  KOKKOS_INLINE_FUNCTION static Polynomial constant(StageFields const &mean) { return constantPolynomial(mean); }

  /// The moments of an overlay, plane ones about the donor's centroid at `radius` given.
  KOKKOS_INLINE_FUNCTION static OverlayMoments const &measured(PlaneMoments const &m, double) { return m; }

  KOKKOS_INLINE_FUNCTION OverlayMoments wholeMoments(int donor, MovedVertices const &) const
  {
    OverlayMoments m;
    for (int i = 0; i < OverlayMoments::count; ++i)
      m.value[i] = i == 1 || i == 2 ? 0.0 : donors.shape(donor, i);
    return m;
  }

  /// Of a density rho + g.d, mass centroid at e, over a part with moments V, S, T about the donor's centroid:
  /// mass = rho V + g.S; gradients by mass: rho S + T g - e mass.
  KOKKOS_INLINE_FUNCTION static LinearWeights weights(double rho, Vector2 const &g, Vector2 const &e,
                                                      OverlayMoments const &m)
  {
    LinearWeights w;
    w.volume = m.volume();
    w.mass = rho * m.volume() + (g[0] * m.first(0) + g[1] * m.first(1));
    w.by_volume = {m.first(0), m.first(1)};
    w.by_mass = {rho * m.first(0) + (m.second(0, 0) * g[0] + m.second(0, 1) * g[1]) - e[0] * w.mass,
                 rho * m.first(1) + (m.second(0, 1) * g[0] + m.second(1, 1) * g[1]) - e[1] * w.mass};
    return w;
  }

  /// Integrals of the donor's fields over one overlay: density and deviator by volume, primitives phi as rho phi.
  KOKKOS_INLINE_FUNCTION static StageFields integrate(Polynomial const &p, OverlayMoments const &m)
  {
    LinearWeights const w =
        weights(p.mean.record[DensityField], {p.x.record[DensityField], p.y.record[DensityField]}, p.mass_offset, m);
    StageFields out;
    out.record =
        p.mean.record * fieldWeights(w.volume, w.mass) + (p.x.record * fieldWeights(w.by_volume[0], w.by_mass[0]) +
                                                          p.y.record * fieldWeights(w.by_volume[1], w.by_mass[1]));
    out.corner = p.mean.corner * FieldPack(w.mass) +
                 (p.x.corner * FieldPack(w.by_mass[0]) + p.y.corner * FieldPack(w.by_mass[1]));
    return out;
  }

  struct Gradient
  {
    StageFields x, y, lower, upper;
  };

  /// What Van Leer's limiter compares with: same-material pairs beyond the faces.
  struct FaceNeighbours
  {
    int size = 0;
    Vector2 offset[4];
    StageFields difference[4];
  };

  /// A same-material pair of a neighbour between the stages.
  struct Neighbour
  {
    StageFields value; // corner velocities before stage 1, in the order of the donor's corners
    double filled;     // part of its cell before the move: that of the target cell would make the weights lopsided
    Vector2 centroid;
  };

  KOKKOS_INLINE_FUNCTION bool fromDonor(int index, int material, int rotation, Neighbour &n) const
  {
    int const other = donors.find(index, material);
    if (other < 0)
      return false;
    n.filled = in.state.record(donors.head(other).pair, VolumeFraction);
    n.centroid = {donors.shape(other, 1), donors.shape(other, 2)};
    n.value = {FieldPack(&donors.value(other, 0)), rotatedCorners(&donors.half(other, 0), rotation)};
    return true;
  }

  /// A pure cell that is at home.
  KOKKOS_INLINE_FUNCTION bool fromCell(int cell, int material, int rotation, Neighbour &n) const
  {
    if (classes.pure_material(cell) != material)
      return false;
    int const pair = in.pairs.offset(cell);
    n.filled = 1.0;
    n.centroid = cellCentroid(in.mesh, cell);
    FieldPack record(&stage.record(pair, 0));
    record.set<DensityField>(stage.record(pair, Mass) / in.mesh.cell_volume(cell));
    record.set<KineticField>(stage.kineticEnergy(in.pairs, pair));
    double corner[8];
    cornerVelocities(in.pairs, in.half, pair, corner);
    n.value = {record, rotatedCorners(corner, rotation)};
    return true;
  }

  KOKKOS_INLINE_FUNCTION bool isAtBoundary(int cell) const
  {
    bool any = false;
    for (int k = 0; k < 4; ++k)
      any = any || in.mesh.face_neighbour(cell, k) < 0;
    return any;
  }

  KOKKOS_INLINE_FUNCTION bool isBeyondFace(int cell, int neighbour) const
  {
    bool any = false;
    for (int k = 0; k < 4; ++k)
      any = any || (in.mesh.face_neighbour(cell, k) >= 0 && in.mesh.face_neighbour(cell, k) / 4 == neighbour);
    return any;
  }

  /// What the same material holds in item j of the cells' neighbours; false where that is nothing.
  KOKKOS_INLINE_FUNCTION bool findNeighbour(int j, int material, Neighbour &n) const
  {
    int const cell = in.mesh.cell_neighbour.item(j);
    int const index = classes.interface_index(cell);
    int const rotation = in.links.rotation(j);
    return index >= 0 ? fromDonor(index, material, rotation, n) : fromCell(cell, material, rotation, n);
  }

  /// Least-squares gradient weighted by filled part over distance squared; along a line where all neighbours lie on
  /// one. Widens the range by the neighbours' values.
  KOKKOS_INLINE_FUNCTION void gradient(int cell, int material, Vector2 const &centroid, StageFields const &q,
                                       Gradient &g, FaceNeighbours &beyond) const
  {
    double xx = 0.0, xy = 0.0, yy = 0.0;
    StageFields bx = stageFields(0.0), by = stageFields(0.0);
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
    {
      Neighbour n;
      if (!findNeighbour(j, material, n))
        continue;
      Vector2 const d = n.centroid - centroid;
      double const distance2 = dot(d, d);
      if (!(distance2 > 0.0))
        continue;
      double const w = n.filled / distance2;
      xx += w * d[0] * d[0];
      xy += w * d[0] * d[1];
      yy += w * d[1] * d[1];
      StageFields const difference = n.value - q;
      if (in.options.limiter == RemapLimiter::VanLeer && isBeyondFace(cell, in.mesh.cell_neighbour.item(j)) &&
          beyond.size < 4)
      {
        beyond.offset[beyond.size] = d;
        beyond.difference[beyond.size++] = difference;
      }
      addTimes(bx, w * d[0], difference);
      addTimes(by, w * d[1], difference);
      g.lower = {lesser(g.lower.record, n.value.record), lesser(g.lower.corner, n.value.corner)};
      g.upper = {greater(g.upper.record, n.value.record), greater(g.upper.corner, n.value.corner)};
    }
    double const trace = xx + yy;
    double const det = xx * yy - xy * xy;
    bool const line = det < 1e-6 * trace * trace;
    double const scale = trace > 0.0 ? 1.0 / (line ? trace : det) : 0.0;
    g.x = g.y = stageFields(0.0);
    addTimes(g.x, scale * (line ? 1.0 : yy), bx);
    addTimes(g.x, scale * (line ? 0.0 : -xy), by);
    addTimes(g.y, scale * (line ? 1.0 : xx), by);
    addTimes(g.y, scale * (line ? 0.0 : -xy), bx);
  }

  /// The largest part of gradients, at most all, that halfway to each neighbour keeps the values between theirs.
  KOKKOS_INLINE_FUNCTION static Pack vanLeerPart(FaceNeighbours const &beyond, bool corner, int p, Pack const &gx,
                                                 Pack const &gy)
  {
    Pack part = 1.0;
    for (int k = 0; k < beyond.size; ++k)
    {
      FieldPack const &all = corner ? beyond.difference[k].corner : beyond.difference[k].record;
      Pack const difference = all.part[p];
      Pack const rise = 0.5 * (Pack(beyond.offset[k][0]) * gx + Pack(beyond.offset[k][1]) * gy);
      auto const outside = rise * (difference - rise) < Pack(0.0);
      part = Math::min(part, select(outside, Pack(difference / select(outside, rise, Pack(1.0))), Pack(1.0)));
    }
    return Math::max(part, Pack(0.0));
  }

  KOKKOS_INLINE_FUNCTION static void limitVanLeer(FaceNeighbours const &beyond, bool corner, FieldPack &gx,
                                                  FieldPack &gy)
  {
    for (int p = 0; p < FieldPack::parts; ++p)
    {
      Pack const part = vanLeerPart(beyond, corner, p, gx.part[p], gy.part[p]);
      gx.part[p] = part * gx.part[p];
      gy.part[p] = part * gy.part[p];
    }
  }

  KOKKOS_INLINE_FUNCTION bool limitsToRange(int cell) const
  {
    return in.options.limiter == RemapLimiter::Range ||
           (in.options.limiter == RemapLimiter::RangeInside && !isAtBoundary(cell));
  }

  /// Deviations of the parts' means from the donor's.
  struct Deviations
  {
    FieldPack least{0.0}, most{0.0};

    KOKKOS_FORCEINLINE_FUNCTION void add(FieldPack const &d)
    {
      least = lesser(least, d);
      most = greater(most, d);
    }
  };

  /// Scale the gradient of eight fields so that the deviations, which it is proportional to, stay within range.
  KOKKOS_INLINE_FUNCTION static void limit(Deviations const &d, FieldPack const &q, FieldPack const &lower,
                                           FieldPack const &upper, FieldPack &gx, FieldPack &gy)
  {
    for (int p = 0; p < FieldPack::parts; ++p)
    {
      Pack const a = partWithin<Pack>(d.least.part[p], d.most.part[p], q.part[p], lower.part[p], upper.part[p]);
      gx.part[p] = a * gx.part[p];
      gy.part[p] = a * gy.part[p];
    }
  }

  /// The part of a density's gradient that keeps the means of all parts within range.
  KOKKOS_INLINE_FUNCTION static double densityPart(OverlayList<OverlayMoments> const &overlays, double rho,
                                                   Vector2 const &g, double lower, double upper)
  {
    double least = 0.0, most = 0.0;
    for (int o = 0; o < overlays.parts(); ++o)
    {
      OverlayMoments const m = overlays.fieldMoments(o);
      double const deviation = (g[0] * m.first(0) + g[1] * m.first(1)) / m.volume();
      least = Math::min(least, deviation);
      most = Math::max(most, deviation);
    }
    return partWithin<double>(least, most, rho, lower, upper);
  }

  /// Limit the gradients of all fields but the density, which is rho + g.d with the mass centroid at e.
  KOKKOS_INLINE_FUNCTION static void limitToRange(OverlayList<OverlayMoments> const &overlays, StageFields const &q,
                                                  Vector2 const &g, Vector2 const &e, Gradient &all)
  {
    Deviations of_record, of_corner;
    for (int o = 0; o < overlays.parts(); ++o)
    {
      LinearWeights const w = weights(q.record[DensityField], g, e, overlays.fieldMoments(o));
      double const per_volume = 1.0 / w.volume, per_mass = 1.0 / w.mass;
      Vector2 const v = per_volume * w.by_volume, m = per_mass * w.by_mass;
      of_record.add(all.x.record * fieldWeights(v[0], m[0]) + all.y.record * fieldWeights(v[1], m[1]));
      of_corner.add(all.x.corner * FieldPack(m[0]) + all.y.corner * FieldPack(m[1]));
    }
    limit(of_record, q.record, all.lower.record, all.upper.record, all.x.record, all.y.record);
    limit(of_corner, q.corner, all.lower.corner, all.upper.corner, all.x.corner, all.y.corner);
  }

  /// The gradient of a donor of mean q, not yet limited; the range g starts with its values before and after stage 1.
  /// \return Its mean before stage 1: differences of corner velocities are taken between like times.
  KOKKOS_INLINE_FUNCTION StageFields donorGradient(int donor, int cell, StageFields const &q, Gradient &g,
                                                   FaceNeighbours &beyond) const
  {
    StageFields const before{q.record, FieldPack(&donors.half(donor, 0))};
    g.lower = {q.record, lesser(q.corner, before.corner)};
    g.upper = {q.record, greater(q.corner, before.corner)};
    gradient(cell, donors.head(donor).material, {donors.shape(donor, 1), donors.shape(donor, 2)}, before, g, beyond);
    return before;
  }

  /// Of a moving donor of `cell`.
  KOKKOS_INLINE_FUNCTION DonorPolynomial polynomial(int donor, int cell,
                                                    OverlayList<OverlayMoments> const &overlays) const
  {
    DonorPolynomial result = constantPolynomial(loadStageFields(&donors.value(donor, 0)));
    if (in.options.order == 1)
      return result;
    StageFields const &q = result.mean;
    Gradient g;
    FaceNeighbours beyond;
    donorGradient(donor, cell, q, g, beyond);
    if (in.options.limiter == RemapLimiter::VanLeer)
    {
      limitVanLeer(beyond, false, g.x.record, g.y.record);
      limitVanLeer(beyond, true, g.x.corner, g.y.corner);
    }
    bool const to_range = limitsToRange(cell);
    double const rho = q.record[DensityField], volume = donors.shape(donor, 0);
    Vector2 slope{g.x.record[DensityField], g.y.record[DensityField]};
    if (to_range)
      slope = densityPart(overlays, rho, slope, g.lower.record[DensityField], g.upper.record[DensityField]) * slope;
    double const per_mass = 1.0 / (rho * volume);
    Vector2 const e{per_mass * (donors.shape(donor, 3) * slope[0] + donors.shape(donor, 4) * slope[1]),
                    per_mass * (donors.shape(donor, 4) * slope[0] + donors.shape(donor, 5) * slope[1])};
    if (to_range)
      limitToRange(overlays, q, slope, e, g);
    g.x.record.set<DensityField>(slope[0]);
    g.y.record.set<DensityField>(slope[1]);
    result.x = g.x;
    result.y = g.y;
    result.mass_offset = e;
    return result;
  }
};

/// The same where areas are weighted by the radius: rings.
struct RingPolynomialFinder : PolynomialFinder
{
  using PlaneMoments = Moments<3>;
  static KOKKOS_INLINE_FUNCTION constexpr bool overlaysInPacks() { return false; }

  KOKKOS_INLINE_FUNCTION explicit RingPolynomialFinder(PolynomialFinder const &finder) : PolynomialFinder(finder) {}
  KOKKOS_INLINE_FUNCTION static OverlayMoments measured(PlaneMoments const &m, double radius)
  {
    return weighted<2>(m, AreaWeight{radius, 1.0});
  }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
